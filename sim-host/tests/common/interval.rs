//! A number that stands for all between two, to prove bounds by running code over it (interval arithmetic: Moore, 1966).

use std::{
    cell::Cell,
    f64::consts::PI,
    ops::{Add, Mul, Neg, Sub},
};

use shared::model::number::{Fixed, Number};

/// All numbers from `low` to `high`. Making one that [`Fixed`] cannot hold panics.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Interval {
    low: f64,
    high: f64,
}

thread_local! {
    static LARGEST: Cell<f64> = const { Cell::new(0.0) };
}

impl Interval {
    fn checked(low: f64, high: f64) -> Self {
        assert!(low <= high, "{low} to {high} is no interval");
        let size = high.max(-low);
        // Rounding moves a result by a step at most.
        assert!(size < f64::from(Fixed::MAX.value()) - 1.0, "an intermediate result of {size} does not fit");
        LARGEST.set(LARGEST.get().max(size));
        Self { low, high }
    }

    pub(crate) fn between(low: f32, high: f32) -> Self {
        Self::checked(f64::from(low), f64::from(high))
    }

    pub(crate) fn within(size: f32) -> Self {
        Self::between(-size, size)
    }

    pub(crate) fn is_within(&self, size: f32) -> bool {
        -f64::from(size) <= self.low && self.high <= f64::from(size)
    }

    /// The largest size of any intermediate result in this thread.
    pub(crate) fn largest() -> f64 {
        LARGEST.get()
    }

    /// The sizes that its numbers have.
    fn sizes(self) -> (f64, f64) {
        let (a, b) = (self.low.abs(), self.high.abs());
        (if self.low <= 0.0 && self.high >= 0.0 { 0.0 } else { a.min(b) }, a.max(b))
    }
}

impl Add for Interval {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::checked(self.low + other.low, self.high + other.high)
    }
}

impl Sub for Interval {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::checked(self.low - other.high, self.high - other.low)
    }
}

impl Mul for Interval {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let corners = [self.low * other.low, self.low * other.high, self.high * other.low, self.high * other.high];
        Self::checked(
            corners.iter().copied().fold(f64::MAX, f64::min),
            corners.iter().copied().fold(f64::MIN, f64::max),
        )
    }
}

impl Neg for Interval {
    type Output = Self;
    fn neg(self) -> Self {
        Self::checked(-self.high, -self.low)
    }
}

impl Number for Interval {
    fn new(value: f32) -> Self {
        Self::between(value, value)
    }

    fn value(self) -> f32 {
        self.high as f32
    }

    /// Whatever the angle.
    fn sin_cos(self) -> (Self, Self) {
        (Self::within(1.0), Self::within(1.0))
    }

    /// Whatever the vector.
    fn atan2(self, _x: Self) -> Self {
        Self::checked(-PI, PI)
    }

    fn hypot(self, other: Self) -> Self {
        let ((a, b), (c, d)) = (self.sizes(), other.sizes());
        Self::checked(a.hypot(c), b.hypot(d))
    }

    fn clamp(self, low: Self, high: Self) -> Self {
        Self::checked(self.low.clamp(low.low, high.high), self.high.clamp(low.low, high.high))
    }
}
