//! Pitch by the axial position of the moving mass: the trim table leads, slow corrections follow.
//!
//! Fielded gliders let the period of their corrections adapt (Slocum: 2 to 60 s). Here it is constant, since an
//! adaptive one did not pay: the table and what was learned leave little to correct, and a mean that is taken early is
//! that of a glide which still settles. A period of 10 s after an inflection or a correction, doubled up to 80 s while
//! the error stayed in its deadband, made the rms of the path angle 0.24° instead of 0.14° with a constant 40 s,
//! and 3 % more moves, on dives to 1000 m (16 vehicles); on dives to 200 m (24 vehicles) there was no difference.

use crate::device::{RAD_PER_CDEG, TICK_HZ, UM_PER_M};
use crate::math;
use crate::model::{table::TrimTable, vehicle::Range};
use crate::parameters::Parameters;

/// Half the step over which the table's slope is taken, rad.
const SLOPE_STEP_RAD: f32 = 0.01;
/// Time after a change of phase before pitch errors mean anything, s.
const SETTLE_S: u32 = 40;

/// A glide that shall be held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Steady {
    /// Path angle, rad.
    pub path_angle_rad: f32,
    /// Net mass, kg.
    pub net_mass_kg: f32,
}

impl Steady {
    /// Pitch of the wings-level glide, rad.
    #[must_use]
    pub fn pitch_rad(&self, table: &TrimTable<'_>) -> f32 {
        table.look_up(self.path_angle_rad, self.net_mass_kg, 0.0).pitch_rad
    }
}

/// Tuning, in the units of the loop.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PitchLoop {
    deadband_cdeg: i32,
    gain_percent: i32,
    period_ticks: u32,
    trim_limit_um: i32,
}

/// What one side (dives, climbs) has learned.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PitchTrim {
    /// Correction of the table's axial position, µm.
    pub trim_um: i32,
    error_sum_cdeg: i32,
    samples: i32,
}

impl PitchLoop {
    /// Takes its tuning.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            deadband_cdeg: parameters.pitch_deadband_cdeg,
            gain_percent: parameters.pitch_gain_percent,
            period_ticks: parameters.pitch_period_s.unsigned_abs().saturating_mul(TICK_HZ),
            trim_limit_um: parameters.pitch_trim_limit_um,
        }
    }

    /// Axial position that the table gives for a glide with the mass rotated, µm.
    #[must_use]
    pub fn feed_forward_um(table: &TrimTable<'_>, steady: &Steady, mu_rad: f32) -> i32 {
        let glide = table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad);
        math::round_to_i32(glide.r_px_m * UM_PER_M)
    }

    /// Takes one tick's pitch error; corrects the trim when a period is over and its mean error is worth it.
    ///
    /// There is no error to take while the drive moves or waits for its turn: a correction is made before the next is
    /// judged.
    pub fn update(
        &self,
        trim: &mut PitchTrim,
        table: &TrimTable<'_>,
        steady: &Steady,
        ticks_in_phase: u32,
        error_cdeg: Option<i32>,
    ) {
        if ticks_in_phase < SETTLE_S * TICK_HZ {
            (trim.error_sum_cdeg, trim.samples) = (0, 0);
            return;
        }
        let Some(error_cdeg) = error_cdeg else { return };
        trim.error_sum_cdeg = trim.error_sum_cdeg.saturating_add(error_cdeg);
        trim.samples = trim.samples.saturating_add(1);
        if trim.samples.unsigned_abs() >= self.period_ticks {
            self.correct(trim, table, steady);
            (trim.error_sum_cdeg, trim.samples) = (0, 0);
        }
    }

    fn correct(&self, trim: &mut PitchTrim, table: &TrimTable<'_>, steady: &Steady) {
        let mean_cdeg = trim.error_sum_cdeg.checked_div(trim.samples).unwrap_or(0);
        if mean_cdeg.saturating_abs() <= self.deadband_cdeg {
            return;
        }
        let share = self.gain_percent as f32 / 100.0 * mean_cdeg as f32 * RAD_PER_CDEG;
        let change_um = math::round_to_i32(share * slope_m_per_rad(table, steady) * UM_PER_M);
        let trimmed_um = trim.trim_um.saturating_add(change_um);
        let limits = Range { min: self.trim_limit_um.saturating_neg(), max: self.trim_limit_um };
        trim.trim_um = limits.clamp(trimmed_um);
    }
}

/// Axial position per pitch along the glides of the table, m/rad: negative, since the mass goes forward to pitch down.
fn slope_m_per_rad(table: &TrimTable<'_>, steady: &Steady) -> f32 {
    let at = |path_angle_rad: f32| {
        let glide = table.look_up(path_angle_rad, steady.net_mass_kg, 0.0);
        (glide.pitch_rad, glide.r_px_m)
    };
    // A step inwards at the table's edge would fold; both sides of the step then share the edge's value.
    let (pitch_low, r_low) = at(steady.path_angle_rad - SLOPE_STEP_RAD);
    let (pitch_high, r_high) = at(steady.path_angle_rad + SLOPE_STEP_RAD);
    math::finite_or((r_high - r_low) / (pitch_high - pitch_low), 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::table::tests::file;

    const STEADY: Steady = Steady { path_angle_rad: -0.45, net_mass_kg: 0.25 };

    /// The made-up vehicle pitches by −1/0.42 rad per metre; an offset of the mass by 10 mm must be found.
    #[test]
    fn an_offset_of_the_mass_is_trimmed_out_in_a_few_moves() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let pitch_loop = PitchLoop::new(&Parameters::default());
        let mut trim = PitchTrim::default();
        let mut moves = 0;
        for tick in 0..400 * TICK_HZ {
            let before = trim.trim_um;
            let pitch_error_rad = (10_000 + trim.trim_um) as f32 / UM_PER_M / 0.42;
            pitch_loop.update(&mut trim, &table, &STEADY, tick, Some((pitch_error_rad / RAD_PER_CDEG) as i32));
            moves += i32::from(trim.trim_um != before);
        }
        // The deadband of 1° is 7.3 mm of travel.
        assert!((trim.trim_um + 10_000).abs() < 7_300, "{trim:?}");
        assert!((1..=4).contains(&moves), "{moves} moves");
    }

    /// The supply may keep the axial drive waiting for longer than a period.
    #[test]
    fn a_correction_that_waits_is_not_made_twice() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let pitch_loop = PitchLoop::new(&Parameters::default());
        let mut trim = PitchTrim::default();
        let mut corrections = 0;
        for tick in 0..1_000 * TICK_HZ {
            let before = trim.trim_um;
            pitch_loop.update(&mut trim, &table, &STEADY, tick, (corrections == 0).then_some(500));
            corrections += i32::from(trim.trim_um != before);
        }
        assert_eq!(corrections, 1);
    }

    #[test]
    fn the_trim_is_bounded_and_transients_teach_nothing() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let pitch_loop = PitchLoop::new(&Parameters::default());
        let mut trim = PitchTrim::default();
        for tick in 0..SETTLE_S * TICK_HZ {
            pitch_loop.update(&mut trim, &table, &STEADY, tick, Some(3_000));
        }
        assert_eq!(trim.trim_um, 0);
        for tick in SETTLE_S * TICK_HZ..4_000 {
            pitch_loop.update(&mut trim, &table, &STEADY, tick, Some(3_000));
        }
        assert_eq!(trim.trim_um, -Parameters::default().pitch_trim_limit_um);
    }
}
