//! Symmetric positive definite systems in the plant's scalar.
//!
//! nalgebra's Cholesky wants a `ComplexField`, which dual numbers and SIMD lanes do not share.

use nalgebra::{SMatrix, SVector};

use crate::model::real::Real;

/// L Lᵀ = A. Only the lower triangle of `a` is read.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cholesky<T: Real, const N: usize> {
    /// L, with the inverses of its diagonal on the diagonal.
    lower: SMatrix<T, N, N>,
}

impl<T: Real, const N: usize> Cholesky<T, N> {
    /// Factors a mass matrix. Mass matrices are positive definite by construction: `Vehicle` files are checked for it.
    pub(super) fn new(mut a: SMatrix<T, N, N>) -> Self {
        for j in 0..N {
            for k in 0..j {
                let factor = a[(j, k)];
                for i in j..N {
                    let product = a[(i, k)] * factor;
                    a[(i, j)] -= product;
                }
            }
            let inverse = T::constant(1.0) / a[(j, j)].sqrt();
            a[(j, j)] = inverse;
            for i in j + 1..N {
                a[(i, j)] *= inverse;
            }
        }
        Self { lower: a }
    }

    /// A⁻¹ b.
    pub(super) fn solve(&self, mut b: SVector<T, N>) -> SVector<T, N> {
        let l = &self.lower;
        for i in 0..N {
            for j in 0..i {
                let product = l[(i, j)] * b[j];
                b[i] -= product;
            }
            b[i] *= l[(i, i)];
        }
        for i in (0..N).rev() {
            for j in i + 1..N {
                let product = l[(j, i)] * b[j];
                b[i] -= product;
            }
            b[i] *= l[(i, i)];
        }
        b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_factored() {
        let seed = SMatrix::<f64, 8, 8>::from_fn(|i, j| ((3 * i + 7 * j) as f64).sin());
        let a = seed * seed.transpose() + SMatrix::identity();
        let x = SVector::<f64, 8>::from_fn(|i, _| i as f64 - 3.5);
        assert!((Cholesky::new(a).solve(a * x) - x).norm() < 1e-12);
    }
}
