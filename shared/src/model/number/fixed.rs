//! Fixed point in 32 bits, with 64-bit products.

use core::ops::{Add, Mul, Neg, Sub};

use super::{Number, cordic};
use crate::math;

/// A number in steps of 2⁻²⁰ (9.5e-7), up to ±2048. Every operation saturates.
///
/// | operation | error at most |
/// |---|---|
/// | + − | 0 |
/// | × | half a step |
/// | `hypot` | one step |
/// | `sin_cos` | 6.5e-7 |
/// | `atan2` | 8e-7 rad |
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fixed(i32);

const FRACTION_BITS: u32 = 20;
const ONE: f32 = 1_048_576.0;
/// π and 2π in steps of 2⁻⁴⁰.
const PI_40: i64 = 3_454_217_652_358;
const TAU_40: i64 = 6_908_435_304_715;
/// π/2 in steps of 2⁻⁴⁰.
const QUARTER_40: i64 = 1_727_108_826_179;

impl Fixed {
    /// The largest number.
    pub const MAX: Self = Self(i32::MAX);

    /// The nearest number to `value` in steps of 2⁻ᵇⁱᵗˢ, `bits` from 21 to 60.
    fn rounded(value: i64, bits: u32) -> Self {
        let finer = bits.saturating_sub(FRACTION_BITS);
        let half = 1_i64 << finer.saturating_sub(1);
        let steps = value.saturating_add(half) >> finer;
        Self(i32::try_from(steps).unwrap_or(if steps < 0 { i32::MIN } else { i32::MAX }))
    }
}

impl Add for Fixed {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sub for Fixed {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl Mul for Fixed {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        // |product| ≤ 2⁶²: it fits.
        Self::rounded(i64::from(self.0).wrapping_mul(i64::from(other.0)), FRACTION_BITS.wrapping_mul(2))
    }
}

impl Neg for Fixed {
    type Output = Self;
    fn neg(self) -> Self {
        Self(self.0.saturating_neg())
    }
}

impl Number for Fixed {
    fn new(value: f32) -> Self {
        Self(math::round_to_i32(value * ONE))
    }

    fn value(self) -> f32 {
        self.0 as f32 / ONE
    }

    fn sin_cos(self) -> (Self, Self) {
        // −π to π, then −π/2 to π/2 with the cosine's sign apart.
        let whole = i64::from(self.0) << FRACTION_BITS;
        let angle = whole.wrapping_add(PI_40).rem_euclid(TAU_40).wrapping_sub(PI_40);
        let (folded, behind) = if angle > QUARTER_40 {
            (PI_40.wrapping_sub(angle), true)
        } else if angle < QUARTER_40.wrapping_neg() {
            (PI_40.wrapping_neg().wrapping_sub(angle), true)
        } else {
            (angle, false)
        };
        // ±π/2 in steps of 2⁻³⁰ fits.
        let (sine, cosine) = cordic::sin_cos((folded >> 10) as i32);
        let number = |value: i32| Self::rounded(i64::from(value), cordic::ANGLE_BITS);
        (number(sine), number(if behind { cosine.wrapping_neg() } else { cosine }))
    }

    fn atan2(self, x: Self) -> Self {
        let size = self.0.unsigned_abs().max(x.0.unsigned_abs());
        if size == 0 {
            return Self(0);
        }
        // The larger one gets 29 bits; scaled so, both fit. A vector that points back is turned about first.
        let fit = |value: i32| (i64::from(value) << 29 >> (32_u32.saturating_sub(size.leading_zeros()))) as i32;
        let (y_fit, x_fit) = (fit(self.0), fit(x.0));
        let number = |angle: i64| Self::rounded(angle, cordic::ANGLE_BITS);
        if x_fit >= 0 {
            return number(i64::from(cordic::atan2(y_fit, x_fit)));
        }
        let half_turn = if y_fit < 0 { PI_40.wrapping_neg() } else { PI_40 } >> 10;
        number(half_turn.wrapping_add(i64::from(cordic::atan2(y_fit.wrapping_neg(), x_fit.wrapping_neg()))))
    }

    fn hypot(self, other: Self) -> Self {
        let square = |value: i32| u64::from(value.unsigned_abs()).wrapping_pow(2);
        // Each square is at most 2⁶², so the sum fits, and its root has the fraction bits of the factors.
        let root = square(self.0).wrapping_add(square(other.0)).isqrt();
        Self(i32::try_from(root).unwrap_or(i32::MAX))
    }

    fn clamp(self, low: Self, high: Self) -> Self {
        self.max(low).min(high)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec;

    const STEP: f64 = 1.0 / ONE as f64;

    fn exact(number: Fixed) -> f64 {
        f64::from(number.0) * STEP
    }

    /// All sizes and signs: every power of two, what is beside it, and something in between.
    fn numbers() -> Vec<Fixed> {
        let sizes = (0..31).rev().zip(0..31).flat_map(|(rest, bits)| {
            let power = 1_i32 << bits;
            [power, power.wrapping_sub(1), power | 0x2a_aaaa >> rest]
        });
        sizes
            .chain([i32::MAX])
            .flat_map(|size| [Fixed(size), Fixed(size.wrapping_neg())])
            .chain([Fixed(i32::MIN)])
            .collect()
    }

    #[test]
    fn sums_and_products_are_right_or_saturate() {
        let held = |value: f64| value.clamp(exact(Fixed(i32::MIN)), exact(Fixed::MAX));
        for a in numbers() {
            assert_eq!(exact(-a), held(-exact(a)));
            for b in numbers() {
                assert_eq!(exact(a + b), held(exact(a) + exact(b)));
                assert_eq!(exact(a - b), held(exact(a) - exact(b)));
                let error = exact(a * b) - held(exact(a) * exact(b));
                assert!(error.abs() <= 0.5 * STEP, "{a:?} × {b:?}");
            }
        }
    }

    #[test]
    fn lengths_and_directions_are_within_what_is_stated() {
        for x in numbers() {
            for y in numbers() {
                let length = exact(x).hypot(exact(y)).min(exact(Fixed::MAX));
                assert!((exact(y.hypot(x)) - length).abs() <= STEP, "{y:?} {x:?}");
                let direction = exact(y).atan2(exact(x));
                // Straight back is π from one side and −π from the other.
                let error = (exact(y.atan2(x)) - direction).abs();
                assert!(error.min(core::f64::consts::TAU - error) < 8e-7, "atan2 {y:?} {x:?}: {error}");
            }
        }
    }

    #[test]
    fn sines_and_cosines_are_within_what_is_stated_at_every_angle() {
        // Every 97th of the angles within ±4 rad, and every 9973rd of all.
        let near = (-(4 << FRACTION_BITS)..4 << FRACTION_BITS).step_by(97);
        for angle in near.chain((i32::MIN..=i32::MAX).step_by(9_973)) {
            let (sine, cosine) = Fixed(angle).sin_cos();
            let angle = exact(Fixed(angle));
            assert!((exact(sine) - angle.sin()).abs() < 6.5e-7, "sin {angle}");
            assert!((exact(cosine) - angle.cos()).abs() < 6.5e-7, "cos {angle}");
        }
    }

    #[test]
    fn floats_become_the_nearest_number_and_nonsense_stays_in_range() {
        assert_eq!(Fixed::new(1.0), Fixed(1 << FRACTION_BITS));
        assert_eq!(Fixed::new(-0.3).value(), -314_573.0 / ONE);
        assert_eq!(Fixed::new(1e9), Fixed::MAX);
        assert_eq!(Fixed::new(f32::NAN), Fixed(0));
        assert_eq!(Fixed::new(f32::NEG_INFINITY), Fixed(i32::MIN));
    }
}
