//! Heading by the rotation of the moving mass; how much it turns, and which way, stands in the trim table.

use crate::{
    device::{RAD_PER_CDEG, TICK_HZ},
    math,
    parameters::Parameters,
    pitch::Steady,
    table::TrimTable,
};

/// Tuning, in the units of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingLoop {
    deadband_cdeg: i32,
    time_s: f32,
    period_ticks: u32,
    mu_limit_rad: f32,
    mu_deadband_cdeg: i32,
}

impl HeadingLoop {
    /// Takes its tuning.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            deadband_cdeg: parameters.heading_deadband_cdeg,
            time_s: parameters.heading_time_s as f32,
            period_ticks: parameters.heading_period_s.unsigned_abs().saturating_mul(TICK_HZ),
            mu_limit_rad: parameters.mu_limit_cdeg as f32 * RAD_PER_CDEG,
            mu_deadband_cdeg: parameters.mu_deadband_cdeg,
        }
    }

    /// Where the mass shall be rotated to, 0.01°, for a heading error (target − heading, short way round).
    ///
    /// It looks once per period, and leaves the mass where it is unless the change is worth a move.
    pub fn mu_cdeg(
        &self,
        table: &TrimTable<'_>,
        steady: &Steady,
        ticks_in_phase: u32,
        error_cdeg: i32,
        mu_cdeg: i32,
    ) -> i32 {
        if ticks_in_phase.checked_rem(self.period_ticks) != Some(0) {
            return mu_cdeg;
        }
        let turn_rate_rad_s = if error_cdeg.saturating_abs() <= self.deadband_cdeg {
            0.0
        } else {
            error_cdeg as f32 * RAD_PER_CDEG / self.time_s
        };
        let near_rad = mu_cdeg as f32 * RAD_PER_CDEG;
        let wanted_rad =
            table.mu_for_turn(steady.path_angle_rad, steady.net_mass_kg, turn_rate_rad_s, near_rad, self.mu_limit_rad);
        let wanted_cdeg = math::round_to_i32(wanted_rad / RAD_PER_CDEG);
        if wanted_cdeg.saturating_sub(mu_cdeg).saturating_abs() > self.mu_deadband_cdeg { wanted_cdeg } else { mu_cdeg }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table::tests::file;

    fn mu_for(path_angle_rad: f32, error_cdeg: i32) -> i32 {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let steady = Steady { path_angle_rad, net_mass_kg: 0.25 };
        HeadingLoop::new(&Parameters::default()).mu_cdeg(&table, &steady, 0, error_cdeg, 0)
    }

    #[test]
    fn the_sense_of_the_turn_comes_from_the_table() {
        // The made-up vehicle turns right with mu < 0 on dives and mu > 0 on climbs.
        assert!(mu_for(-0.4, 3_000) < 0);
        assert!(mu_for(0.4, 3_000) > 0);
        assert_eq!(mu_for(0.4, 3_000), -mu_for(0.4, -3_000));
    }

    #[test]
    fn small_errors_are_left_alone_and_large_ones_stay_within_the_limit() {
        assert_eq!(mu_for(-0.4, 100), 0);
        assert_eq!(mu_for(-0.4, 17_000), -Parameters::default().mu_limit_cdeg);
    }
}
