//! Sine and cosine in single precision from end to end.
//!
//! `libm` computes them in double precision, which a part with an FPU for `f32` has to emulate: 1200 instructions for a sine,
//! and four fifths of all that a step of the autopilot took. Method and coefficients: Moshier, Cephes Mathematical Library
//! 2.2, `single/sinf.c`.

/// Angles up to which the reduction below is exact to single precision, rad; no angle in flight is larger.
const WIDEST_RAD: f32 = 1e3;
/// π/2 in three parts: the first two have so few digits that their product with a number of quarter turns is exact.
const QUARTER_TURN: [f32; 3] = [1.570_312_5, 4.837_513e-4, 7.549_79e-8];

/// Sine and cosine of an angle in rad, each within 1e-7.
pub(super) fn sin_cos(x: f32) -> (f32, f32) {
    if !(-WIDEST_RAD..=WIDEST_RAD).contains(&x) {
        return libm::sincosf(x);
    }
    let half = if x < 0.0 { -0.5 } else { 0.5 };
    // Nearest quarter turn: the cast truncates.
    let quarters = (x * core::f32::consts::FRAC_2_PI + half) as i32;
    let [high, middle, low] = QUARTER_TURN.map(|part| part * quarters as f32);
    let (sine, cosine) = near_zero(x - high - middle - low);
    match quarters & 3 {
        0 => (sine, cosine),
        1 => (cosine, -sine),
        2 => (-sine, -cosine),
        _ => (-cosine, sine),
    }
}

/// Minimax polynomials on [−π/4, π/4].
fn near_zero(x: f32) -> (f32, f32) {
    let z = x * x;
    let sine = x + x * z * (-1.666_665_5e-1 + z * (8.332_161e-3 - z * 1.951_529_6e-4));
    let cosine = 1.0 - 0.5 * z + z * z * (4.166_664_6e-2 + z * (-1.388_731_6e-3 + z * 2.443_315_7e-5));
    (sine, cosine)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Half a unit in the last place of 1 is 6e-8; the polynomials add as much as they round once more.
    const ERROR: f64 = 1.0e-7;

    fn check(x: f32) {
        let (sine, cosine) = sin_cos(x);
        let (true_sine, true_cosine) = libm::sincos(f64::from(x));
        assert!((f64::from(sine) - true_sine).abs() < ERROR, "sine of {x}: {sine}, in truth {true_sine}");
        assert!((f64::from(cosine) - true_cosine).abs() < ERROR, "cosine of {x}: {cosine}, in truth {true_cosine}");
    }

    #[test]
    fn angles_of_a_few_turns_are_right_to_single_precision() {
        for step in -2_000_000..=2_000_000 {
            check(step as f32 * 7e-6);
        }
    }

    #[test]
    fn every_part_of_the_line_has_its_sine() {
        for exponent in -140..=127 {
            let x = libm::exp2f(exponent as f32);
            for x in [x, 1.3 * x, 1.9 * x] {
                check(x);
                check(-x);
            }
        }
        for x in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
            assert!(sin_cos(x).0.is_nan() && sin_cos(x).1.is_nan(), "{x}");
        }
    }

    /// A small angle is its own sine, relative to itself too: headings and rolls are small differences.
    #[test]
    fn small_sines_keep_their_digits() {
        for step in 1..=1_000_000 {
            let x = step as f32 * 1e-7;
            let relative = f64::from(sin_cos(x).0) / libm::sin(f64::from(x)) - 1.0;
            assert!(relative.abs() < 2e-7, "sine of {x}: {relative:e} off");
        }
    }

    #[test]
    fn quarter_turns_land_on_the_axes() {
        for quarters in -400_i16..=400 {
            check(f32::from(quarters) * core::f32::consts::FRAC_PI_2);
        }
        assert_eq!(sin_cos(0.0), (0.0, 1.0));
    }
}
