//! The scalar that the plant is written in: `f64` to fly, dual numbers for exact derivatives.

use std::ops::Neg;

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};
use num_dual::{DualNum, DualSVec};

/// A real number, or something that computes like one.
///
/// Transcendental functions come from libm, so that a flight has the same bits on every host.
pub trait Real:
    Scalar
    + Copy
    + num_traits::Zero
    + num_traits::One
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Neg<Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The value without its derivatives.
    fn value(&self) -> f64;
    /// Square root; its derivative is infinite at 0.
    fn sqrt(self) -> Self;
    /// Sine.
    fn sin(self) -> Self;
    /// Cosine.
    fn cos(self) -> Self;
    /// Angle of the vector (x, self).
    fn atan2(self, x: Self) -> Self;
    /// Natural logarithm, of a positive number.
    fn ln(self) -> Self;
    /// A positive number to a constant power.
    fn powf(self, exponent: f64) -> Self;

    /// √(x² + y²), and a constant 0 at the origin, where it has no derivative.
    fn hypot(x: Self, y: Self) -> Self {
        let square = x * x + y * y;
        if square.value() > 0.0 { square.sqrt() } else { Self::constant(0.0) }
    }
}

impl Real for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(&self) -> f64 {
        *self
    }
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn sin(self) -> Self {
        libm::sin(self)
    }
    fn cos(self) -> Self {
        libm::cos(self)
    }
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
    fn ln(self) -> Self {
        libm::log(self)
    }
    fn powf(self, exponent: f64) -> Self {
        libm::pow(self, exponent)
    }
}

/// Nests: a dual number of dual numbers carries second derivatives.
impl<T: Real + DualNum, const N: usize> Real for DualSVec<T, N> {
    fn constant(value: f64) -> Self {
        Self::from_re(T::constant(value))
    }
    fn value(&self) -> f64 {
        self.re.value()
    }
    fn sqrt(self) -> Self {
        let root = Real::sqrt(self.re);
        Self::new(root, self.eps * (T::constant(0.5) / root))
    }
    fn sin(self) -> Self {
        Self::new(Real::sin(self.re), self.eps * Real::cos(self.re))
    }
    fn cos(self) -> Self {
        Self::new(Real::cos(self.re), self.eps * -Real::sin(self.re))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.re * self.re + x.re * x.re;
        Self::new(Real::atan2(self.re, x.re), self.eps * (x.re / square) - x.eps * (self.re / square))
    }
    fn ln(self) -> Self {
        Self::new(Real::ln(self.re), self.eps * (T::constant(1.0) / self.re))
    }
    fn powf(self, exponent: f64) -> Self {
        let slope = T::constant(exponent) * Real::powf(self.re, exponent - 1.0);
        Self::new(Real::powf(self.re, exponent), self.eps * slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::DualSVec64;

    /// Our own chain rules against num-dual's.
    #[test]
    fn derivatives_of_the_transcendental_functions_agree_with_the_librarys() {
        let [x, y] = [(0.7, 0), (-1.3, 1)].map(|(re, place)| DualSVec64::<2>::from_re(re).derivative(place));
        let pairs = [
            (Real::sqrt(x), DualNum::sqrt(&x)),
            (Real::sin(x * y), DualNum::sin(&(x * y))),
            (Real::cos(x * y), DualNum::cos(&(x * y))),
            (Real::atan2(y, x), DualNum::atan2(&y, x)),
            (Real::ln(x * x * x), DualNum::ln(&(x * x * x))),
            (Real::powf(x, 1.5), DualNum::powf(&x, 1.5)),
        ];
        let both = |dual: DualSVec64<2>| dual.eps.unwrap_generic(nalgebra::Const::<2>, nalgebra::Const::<1>);
        for (ours, theirs) in pairs {
            assert!((ours.re - theirs.re).abs() < 1e-15 && (both(ours) - both(theirs)).amax() < 1e-15);
        }
    }

    /// Second derivatives of the same: ours of ours against the library's hyper-dual numbers.
    #[test]
    fn nested_numbers_carry_the_second_derivatives_of_the_library() {
        use num_dual::{Derivative, HyperDual64};
        let nested = |re: f64, inner: f64, outer: f64| {
            let inner = DualSVec64::<1>::new(re, Derivative::some(nalgebra::SVector::from([inner])));
            let outer = nalgebra::SVector::from([DualSVec64::<1>::from_re(outer)]);
            DualSVec::<DualSVec64<1>, 1>::new(inner, Derivative::some(outer))
        };
        let second = |value: DualSVec<DualSVec64<1>, 1>| {
            let [first] = value.eps.unwrap_generic(nalgebra::U1, nalgebra::U1).into();
            let first: DualSVec64<1> = first;
            first.eps.unwrap_generic(nalgebra::U1, nalgebra::U1)[0]
        };
        let ([x, y], [u, v]) = (
            [nested(0.7, 1.1, 0.4), nested(-1.3, 0.3, 2.0)],
            [HyperDual64::new(0.7, 1.1, 0.4, 0.0), HyperDual64::new(-1.3, 0.3, 2.0, 0.0)],
        );
        let pairs = [
            (Real::sqrt(x), DualNum::sqrt(&u)),
            (Real::sin(x * y), DualNum::sin(&(u * v))),
            (Real::cos(x * y), DualNum::cos(&(u * v))),
            (Real::atan2(y, x), DualNum::atan2(&v, u)),
            (Real::ln(x * x * x), DualNum::ln(&(u * u * u))),
            (Real::powf(x, 1.5), DualNum::powf(&u, 1.5)),
        ];
        for (ours, theirs) in pairs {
            assert!((second(ours) - theirs.eps1eps2).abs() < 1e-14, "{} {}", second(ours), theirs.eps1eps2);
        }
    }
}
