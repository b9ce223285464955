//! The scalar that the plant is written in: `f64` to fly, dual numbers for exact derivatives.

use std::ops::Neg;

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};
use num_dual::DualSVec64;

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

impl<const N: usize> Real for DualSVec64<N> {
    fn constant(value: f64) -> Self {
        Self::from_re(value)
    }
    fn value(&self) -> f64 {
        self.re
    }
    fn sqrt(self) -> Self {
        let root = self.re.sqrt();
        Self::new(root, self.eps * (0.5 / root))
    }
    fn sin(self) -> Self {
        Self::new(libm::sin(self.re), self.eps * libm::cos(self.re))
    }
    fn cos(self) -> Self {
        Self::new(libm::cos(self.re), self.eps * -libm::sin(self.re))
    }
    fn atan2(self, x: Self) -> Self {
        let square = self.re * self.re + x.re * x.re;
        Self::new(libm::atan2(self.re, x.re), self.eps * (x.re / square) - x.eps * (self.re / square))
    }
    fn ln(self) -> Self {
        Self::new(libm::log(self.re), self.eps * (1.0 / self.re))
    }
    fn powf(self, exponent: f64) -> Self {
        let slope = exponent * libm::pow(self.re, exponent - 1.0);
        Self::new(libm::pow(self.re, exponent), self.eps * slope)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::DualNum;

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
}
