//! The scalar that the plant is written in: `f64` to fly, dual numbers for exact derivatives.

use std::ops::Neg;

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Scalar};
use num_dual::{DualNum, DualSVec64};

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
}

impl<const N: usize> Real for DualSVec64<N> {
    fn constant(value: f64) -> Self {
        Self::from_re(value)
    }
    fn value(&self) -> f64 {
        self.re
    }
    fn sqrt(self) -> Self {
        DualNum::sqrt(&self)
    }
    fn sin(self) -> Self {
        DualNum::sin(&self)
    }
    fn cos(self) -> Self {
        DualNum::cos(&self)
    }
    fn atan2(self, x: Self) -> Self {
        DualNum::atan2(&self, x)
    }
}
