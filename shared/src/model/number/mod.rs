//! The numbers that the reduced model computes with: `f32`, or [`Fixed`] on a part without an FPU.

mod cordic;
mod fixed;

pub use fixed::Fixed;

use core::ops::{Add, Mul, Neg, Sub};

use crate::math;

/// A real number of limited range. Nothing that it does panics; the operators of an integer kind saturate.
pub trait Number: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Neg<Output = Self> {
    /// The nearest representable value; 0 if `value` is not a number.
    fn new(value: f32) -> Self;
    /// The value as a float.
    fn value(self) -> f32;
    /// Sine and cosine of an angle in rad.
    fn sin_cos(self) -> (Self, Self);
    /// Cosine alone.
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Angle of the vector (x, self), rad; 0 for the zero vector.
    fn atan2(self, x: Self) -> Self;
    /// √(self² + other²).
    fn hypot(self, other: Self) -> Self;
    /// The nearest value in [low, high]; what is not finite counts as 0.
    fn clamp(self, low: Self, high: Self) -> Self;
}

impl Number for f32 {
    fn new(value: f32) -> Self {
        if value.is_nan() { 0.0 } else { value }
    }

    fn value(self) -> f32 {
        self
    }

    fn sin_cos(self) -> (Self, Self) {
        math::sin_cos(self)
    }

    fn cos(self) -> Self {
        math::cos(self)
    }

    fn atan2(self, x: Self) -> Self {
        math::atan2(self, x)
    }

    fn hypot(self, other: Self) -> Self {
        math::sqrt(self * self + other * other)
    }

    fn clamp(self, low: Self, high: Self) -> Self {
        math::clamp(math::finite_or(self, 0.0), low, high)
    }
}
