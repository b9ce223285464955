//! How eigenvalues move: dλ = wᵀ dA v/(wᵀ v).

use nalgebra::{Complex, Matrix4};

use super::{Value, value};
use crate::analysis::{
    helix::{Along, rate, with_rate},
    modes::{ModeSet, null_vector},
};

/// |wᵀ v| of unit vectors below which two modes are one: the eigenvalue then moves with a root of the change.
const DEFECTIVE: f64 = 1e-7;

/// Real part of every mode of a set, and the damping ratio of those that oscillate; `matrix` is the set's own, along a parameter.
pub(super) fn values(title: &str, set: &ModeSet, matrix: Option<&Matrix4<Along>>) -> Vec<Value> {
    let upper = set.eigenvalues.iter().zip(set.names).enumerate().filter(|(_, ([_, im], _))| *im >= 0.0);
    upper
        .flat_map(|(place, ([re, im], name))| {
            let at = Complex::new(*re, *im);
            let change = matrix.and_then(|matrix| change(matrix, at));
            let real = change.map(|change| with_rate(at.re, change.re));
            let ratio = change.filter(|_| *im > 0.0).map(|change| damping_ratio(at, change));
            let number = place + 1;
            let named = |what: &str| format!("{title}_{number}_{what}");
            let real = value(&named("real_per_s"), &format!("{title} {number}, {name}: real part, 1/s"), real);
            let damping = (*im > 0.0)
                .then(|| value(&named("damping_ratio"), &format!("{title} {number}, {name}: damping ratio"), ratio));
            std::iter::once(real).chain(damping)
        })
        .collect()
}

/// Of one eigenvalue; none where two coincide.
fn change(matrix: &Matrix4<Along>, at: Complex<f64>) -> Option<Complex<f64>> {
    let (value, rates) = (matrix.map(|entry| entry.re), matrix.map(rate));
    let (right, left) = (null_vector(&value, at), null_vector(&value.transpose(), at));
    let product = left.dot(&right);
    let moved = left.dot(&(rates.map(|entry| Complex::new(entry, 0.0)) * right));
    (product.norm() > DEFECTIVE).then(|| moved / product)
}

/// ζ = −Re λ/|λ|.
fn damping_ratio(at: Complex<f64>, change: Complex<f64>) -> Along {
    let size = at.norm();
    let growth = (at.conj() * change).re / size;
    with_rate(-at.re / size, -change.re / size + at.re * growth / (size * size))
}
