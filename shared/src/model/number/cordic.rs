//! Sine, cosine and arctangent with shifts and sums alone (CORDIC: Volder, IRE Trans. Electronic Computers EC-8, 1959).
//!
//! A vector is turned by ±arctan 2⁻ⁱ, i = 0, 1, …, which takes two shifts and two sums a turn, and makes it longer by a
//! factor that depends on nothing. What is left of the angle after the last turn is at most arctan 2⁻²⁴, 6e-8 rad.

/// Fraction bits of the angles here: ±2 rad in an `i32`.
pub(super) const ANGLE_BITS: u32 = 30;
/// arctan 2⁻ⁱ.
const TURNS: [i32; 25] = [
    843_314_857,
    497_837_829,
    263_043_837,
    133_525_159,
    67_021_687,
    33_543_516,
    16_775_851,
    8_388_437,
    4_194_283,
    2_097_149,
    1_048_576,
    524_288,
    262_144,
    131_072,
    65_536,
    32_768,
    16_384,
    8_192,
    4_096,
    2_048,
    1_024,
    512,
    256,
    128,
    64,
];
/// Length that the turns make 1.
const SHRUNK: i32 = 652_032_874;

/// Sine and cosine, both with [`ANGLE_BITS`], of an angle in ±π/2; within 1.5e-7.
pub(super) fn sin_cos(angle: i32) -> (i32, i32) {
    let (mut x, mut y, mut left) = (SHRUNK, 0_i32, angle);
    for (shift, turn) in (0_u32..).zip(TURNS) {
        let (dx, dy) = (y >> shift, x >> shift);
        if left < 0 {
            (x, y, left) = (x.wrapping_add(dx), y.wrapping_sub(dy), left.wrapping_add(turn));
        } else {
            (x, y, left) = (x.wrapping_sub(dx), y.wrapping_add(dy), left.wrapping_sub(turn));
        }
    }
    (y, x)
}

/// arctan y/x with [`ANGLE_BITS`], for 0 ≤ x < 2²⁹ and |y| < 2²⁹, the larger of them at least 2²⁸; within 2.5e-7.
///
/// The vector grows by the root of two and by the turns' 1.65, which stays below 2³¹.
pub(super) fn atan2(y: i32, x: i32) -> i32 {
    let (mut x, mut y, mut turned) = (x, y, 0_i32);
    for (shift, turn) in (0_u32..).zip(TURNS) {
        let (dx, dy) = (y >> shift, x >> shift);
        if y < 0 {
            (x, y, turned) = (x.wrapping_sub(dx), y.wrapping_add(dy), turned.wrapping_sub(turn));
        } else {
            (x, y, turned) = (x.wrapping_add(dx), y.wrapping_sub(dy), turned.wrapping_add(turn));
        }
    }
    turned
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_turns_are_the_arctangents_of_powers_of_two() {
        let scale = f64::from(1_i32 << ANGLE_BITS);
        let mut length = 1.0;
        for (i, turn) in (0..).zip(TURNS) {
            let tangent = 0.5_f64.powi(i);
            assert!((f64::from(turn) - tangent.atan() * scale).abs() <= 0.5, "turn {i}");
            length /= (1.0 + tangent * tangent).sqrt();
        }
        assert!((f64::from(SHRUNK) - length * scale).abs() <= 0.5);
    }

    #[test]
    fn errors_stay_below_what_is_stated() {
        let scale = f64::from(1_i32 << ANGLE_BITS);
        let quarter = (core::f64::consts::FRAC_PI_2 * scale) as i32;
        for angle in (-quarter..=quarter).step_by(9_973) {
            let exact = f64::from(angle) / scale;
            let (sine, cosine) = sin_cos(angle);
            assert!((f64::from(sine) / scale - exact.sin()).abs() < 1.5e-7, "sin {exact}");
            assert!((f64::from(cosine) / scale - exact.cos()).abs() < 1.5e-7, "cos {exact}");
            for length in [f64::from(1 << 28), f64::from(1 << 29) - 1.0] {
                let larger = exact.sin().abs().max(exact.cos());
                let (y, x) = ((length * exact.sin() / larger) as i32, (length * exact.cos() / larger) as i32);
                let found = f64::from(atan2(y, x)) / scale;
                assert!((found - f64::from(y).atan2(f64::from(x))).abs() < 2.5e-7, "atan2 {y} {x}");
            }
        }
    }
}
