//! The only place that calls libm, and the comparisons that mean the same on every machine.
//!
//! `f32::min` and `f32::max` differ between x86-64 and ARM at ±0 and NaN, so flight code compares with these instead.

mod sine;

/// π/2, rad.
pub const FRAC_PI_2: f32 = core::f32::consts::FRAC_PI_2;

/// Sine of an angle in rad.
#[must_use]
pub fn sin(x: f32) -> f32 {
    sin_cos(x).0
}

/// Cosine of an angle in rad.
#[must_use]
pub fn cos(x: f32) -> f32 {
    sin_cos(x).1
}

/// Both, each within 1e-7, for little more than one of them.
#[must_use]
pub fn sin_cos(x: f32) -> (f32, f32) {
    sine::sin_cos(x)
}

/// Angle of the vector (x, y), rad.
#[must_use]
pub fn atan2(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

/// Arcsine, rad; its argument is held to [−1, 1].
#[must_use]
pub fn asin(x: f32) -> f32 {
    let sine = clamp(x, -1.0, 1.0);
    // In single precision throughout, which libm's is not. The factors lose no digit where the cosine is small.
    atan2(sine, sqrt((1.0 - sine) * (1.0 + sine)))
}

/// Square root; 0 for anything that is not positive.
#[must_use]
pub fn sqrt(x: f32) -> f32 {
    if x > 0.0 { libm::sqrtf(x) } else { 0.0 }
}

/// Absolute value.
#[must_use]
pub fn abs(x: f32) -> f32 {
    libm::fabsf(x)
}

/// The nearest value in [low, high]; `low` if `x` is not a number.
#[must_use]
pub fn clamp(x: f32, low: f32, high: f32) -> f32 {
    if x > high {
        high
    } else if x >= low {
        x
    } else {
        low
    }
}

/// `value` if it is a finite number, else `fallback`.
#[must_use]
pub fn finite_or(value: f32, fallback: f32) -> f32 {
    if value.is_finite() { value } else { fallback }
}

/// Nearest integer, halves away from zero; saturates, and 0 if `x` is not a number.
#[must_use]
pub fn round_to_i32(x: f32) -> i32 {
    // `as` saturates and maps NaN to 0 by definition of the language.
    libm::roundf(x) as i32
}

/// An angle in hundredths of a degree brought into [−18000, 18000).
#[must_use]
pub const fn wrap_cdeg(angle_cdeg: i32) -> i32 {
    angle_cdeg.wrapping_add(18_000).rem_euclid(36_000).wrapping_sub(18_000)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arcsine_is_right_to_single_precision() {
        for step in -1_000_000..=1_000_000 {
            let x = step as f32 * 1e-6;
            // Two units in the last place of π/2.
            assert!((f64::from(asin(x)) - libm::asin(f64::from(x))).abs() < 2.4e-7, "{x}");
        }
        assert_eq!((asin(1.1), asin(-1.1)), (FRAC_PI_2, -FRAC_PI_2));
    }

    #[test]
    fn wraps_to_the_short_way_round() {
        assert_eq!(wrap_cdeg(18_000), -18_000);
        assert_eq!(wrap_cdeg(-18_001), 17_999);
        assert_eq!(wrap_cdeg(35_999 - 1), -2);
        assert_eq!(wrap_cdeg(72_100), 100);
    }

    #[test]
    fn clamp_turns_a_nan_into_the_lower_bound() {
        assert_eq!(clamp(f32::NAN, -1.0, 1.0), -1.0);
        assert_eq!(clamp(2.0, -1.0, 1.0), 1.0);
    }

    #[test]
    fn rounding_saturates() {
        assert_eq!(round_to_i32(1e20), i32::MAX);
        assert_eq!(round_to_i32(f32::NAN), 0);
        assert_eq!(round_to_i32(-2.5), -3);
    }
}
