//! Heading by the rotation of the moving mass; how much it turns, and which way, stands in the trim table.

use crate::control::pitch::Steady;
use crate::device::{RAD_PER_CDEG, TICK_HZ, TICK_S};
use crate::math;
use crate::model::table::{Axis, TrimTable};
use crate::parameters::Parameters;

/// Tuning, in the units of the loop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HeadingLoop {
    deadband_cdeg: i32,
    time_s: Option<f32>,
    period_ticks: u32,
    mu_limit_rad: f32,
    mu_deadband_cdeg: i32,
    bias_limit_rad_s: f32,
}

/// What one side (dives, climbs) has learned, and the turn under way.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TurnTrim {
    bias_rad_s: f32,
    turning: bool,
    error_sum_cdeg: i32,
    samples: i32,
    /// Mean error of the period before, if the mass has stood still since it began.
    still_cdeg: Option<i32>,
}

impl TurnTrim {
    /// Turn rate beyond the table's, rad/s: of a vehicle that is not as its file says, or of a current that shears.
    #[must_use]
    pub const fn bias_rad_s(&self) -> f32 {
        self.bias_rad_s
    }

    /// Forgets the turn under way: another glide began.
    pub const fn begin(&mut self) {
        *self = Self { bias_rad_s: self.bias_rad_s, turning: false, error_sum_cdeg: 0, samples: 0, still_cdeg: None };
    }

    /// Mean error since the last look, 0.01°.
    fn look(&mut self) -> i32 {
        let mean_cdeg = self.error_sum_cdeg.checked_div(self.samples).unwrap_or(0);
        self.error_sum_cdeg = 0;
        self.samples = 0;
        mean_cdeg
    }
}

/// A turn begins beyond this many deadbands; what is less, a slow correction takes away.
const TURN: i32 = 2;
/// A turn goes on until its error is this part of the deadband: at its edge it would begin again and again.
const ENOUGH: i32 = 4;
/// A correction takes this many times as long as a turn: so slow that the mass need not go back at its end.
const SLOWER: f32 = 4.0;
/// How far ahead, in times of a correction, the heading must stay in its deadband.
const AHEAD: f32 = 0.7;
/// Within this part of the deadband there is nothing to correct: the mass goes where the vehicle flies straight. More than
/// 1/(1 + [`AHEAD`]), the error at which a correction that went through zero is stopped: else each would call for the next.
const NEAR: f32 = 0.75;
/// Period of the loop whose critical gains a trim table knows, s.
pub const GAIN_PERIOD_S: i32 = 8;
/// Part of the critical gain: 6 dB below it, and a tenth for what the table rounds.
const GAIN_SHARE: f32 = 0.45;
/// A turn that would take longer is not begun: the mass has no authority, s.
const LONGEST_TIME_S: f32 = 600.0;
/// Rotation over which the authority of the mass is taken, rad.
const SMALL_MU_RAD: f32 = 0.02;
/// Part of a difference of turn rates that is believed at once.
const BIAS_SHARE: f32 = 0.1;

impl HeadingLoop {
    /// Takes its tuning.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            deadband_cdeg: parameters.heading_deadband_cdeg,
            time_s: (parameters.heading_time_s > 0).then_some(parameters.heading_time_s as f32),
            period_ticks: parameters.heading_period_s.unsigned_abs().saturating_mul(TICK_HZ),
            mu_limit_rad: parameters.mu_limit_cdeg as f32 * RAD_PER_CDEG,
            mu_deadband_cdeg: parameters.mu_deadband_cdeg,
            bias_limit_rad_s: parameters.turn_bias_limit_mdeg_s as f32 / 10.0 * RAD_PER_CDEG,
        }
    }

    /// Where the mass shall be rotated to, 0.01°, for a heading error (target − heading, short way round).
    ///
    /// It looks once per period, at the mean error. A large error begins a turn, which is as quick as the loop allows and ends
    /// well inside the deadband. Else the mass stands still, and what the heading does then teaches the turn's bias, until
    /// the heading is about to leave its deadband: one move then sets a turn so slow that it needs no second one to end it.
    pub fn mu_cdeg(
        &self,
        trim: &mut TurnTrim,
        table: &TrimTable<'_>,
        steady: &Steady,
        ticks_in_phase: u32,
        error_cdeg: i32,
        mu_cdeg: i32,
    ) -> i32 {
        trim.error_sum_cdeg = trim.error_sum_cdeg.saturating_add(error_cdeg);
        trim.samples = trim.samples.saturating_add(1);
        if ticks_in_phase.checked_rem(self.period_ticks) != Some(0) {
            return mu_cdeg;
        }
        let mean_cdeg = trim.look();
        let Some(turn_time_s) = self.time_s(table, steady) else { return mu_cdeg };
        let (begins_cdeg, ends_cdeg) = (self.deadband_cdeg.saturating_mul(TURN), self.deadband_cdeg / ENOUGH);
        trim.turning = mean_cdeg.saturating_abs() > if trim.turning { ends_cdeg } else { begins_cdeg };
        // An error beyond that comes from another target, not from a turn.
        if !trim.turning
            && let Some(before_cdeg) = trim.still_cdeg
        {
            self.learn(trim, table, steady, before_cdeg.saturating_sub(mean_cdeg), mu_cdeg);
        }
        let time_s = if trim.turning { turn_time_s } else { SLOWER * turn_time_s };
        let is_near = !trim.turning && math::abs(mean_cdeg as f32) < NEAR * self.deadband_cdeg as f32;
        let turn_rate_rad_s = if is_near { 0.0 } else { mean_cdeg as f32 * RAD_PER_CDEG / time_s };
        let wanted_cdeg = self.mu_for_turn_cdeg(table, steady, turn_rate_rad_s - trim.bias_rad_s, mu_cdeg);
        let moves = if trim.turning {
            wanted_cdeg.saturating_sub(mu_cdeg).saturating_abs() > self.mu_deadband_cdeg
        } else {
            let turns_rad = AHEAD * time_s * expected_rad_s(trim, table, steady, mu_cdeg);
            math::abs(mean_cdeg as f32 - turns_rad / RAD_PER_CDEG) > self.deadband_cdeg as f32
        };
        trim.still_cdeg = (!moves && !trim.turning).then_some(mean_cdeg);
        if moves { wanted_cdeg } else { mu_cdeg }
    }

    /// Where the mass hangs while nothing holds the heading, 0.01°: down, or where it is if that is too near to move for.
    #[must_use]
    pub const fn hanging_cdeg(&self, mu_cdeg: i32) -> i32 {
        if mu_cdeg.saturating_abs() > self.mu_deadband_cdeg { 0 } else { mu_cdeg }
    }

    fn mu_for_turn_cdeg(&self, table: &TrimTable<'_>, steady: &Steady, turn_rate_rad_s: f32, mu_cdeg: i32) -> i32 {
        let near_rad = mu_cdeg as f32 * RAD_PER_CDEG;
        let Steady { path_angle_rad, net_mass_kg } = *steady;
        let mu_rad = table.mu_for_turn(path_angle_rad, net_mass_kg, turn_rate_rad_s, near_rad, self.mu_limit_rad);
        math::round_to_i32(mu_rad / RAD_PER_CDEG)
    }

    /// Time in which an error shall be gone, s; nothing where the mass has no authority over the heading.
    ///
    /// A rotation swings the heading at once, as the vehicle rolls, and turns it later. The swing bounds the gain, rotation
    /// per error; towards the reversal of control it stays while the turn fades, so there the loop must be slow. The trim table
    /// knows the gain at which the linear loop swings on for ever (`glider margins`); this law stays [`GAIN_SHARE`] of it.
    fn time_s(&self, table: &TrimTable<'_>, steady: &Steady) -> Option<f32> {
        if self.time_s.is_some() {
            return self.time_s;
        }
        let turn_rate_rad_s =
            |mu_rad: f32| table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad).turn_rate_rad_s;
        let authority_per_s =
            math::abs(turn_rate_rad_s(SMALL_MU_RAD) - turn_rate_rad_s(-SMALL_MU_RAD)) / (2.0 * SMALL_MU_RAD);
        let gain = GAIN_SHARE * critical_gain(table, steady);
        // A mean that is longer by a factor lags by as much more.
        let periods = self.period_ticks as f32 * TICK_S / GAIN_PERIOD_S as f32;
        let time_s = (if periods > 1.0 { periods } else { 1.0 }) / (gain * authority_per_s);
        (time_s < LONGEST_TIME_S).then_some(time_s)
    }

    /// Takes the change of heading over a period in which the mass stood still.
    fn learn(&self, trim: &mut TurnTrim, table: &TrimTable<'_>, steady: &Steady, turned_cdeg: i32, mu_cdeg: i32) {
        let period_s = self.period_ticks as f32 * TICK_S;
        let turned_rad_s = turned_cdeg as f32 * RAD_PER_CDEG / period_s;
        let learned = trim.bias_rad_s + BIAS_SHARE * (turned_rad_s - expected_rad_s(trim, table, steady, mu_cdeg));
        trim.bias_rad_s = math::clamp(learned, -self.bias_limit_rad_s, self.bias_limit_rad_s);
    }
}

/// Turn rate with the mass rotated so far, as the table says and what was learned, rad/s.
fn expected_rad_s(trim: &TurnTrim, table: &TrimTable<'_>, steady: &Steady, mu_cdeg: i32) -> f32 {
    let mu_rad = mu_cdeg as f32 * RAD_PER_CDEG;
    table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad).turn_rate_rad_s + trim.bias_rad_s
}

/// Between the gains at the corners of the trim table, on its own axes.
fn critical_gain(table: &TrimTable<'_>, steady: &Steady) -> f32 {
    let [dives, climbs] = table.vehicle().critical_heading_gain;
    let header = table.header();
    let ([flat, steep], grid) =
        if steady.path_angle_rad < 0.0 { (dives, &header.dive) } else { (climbs, &header.climb) };
    let along = |axis: &Axis, value: f32| math::clamp((value - axis.first) / (axis.last - axis.first), 0.0, 1.0);
    let x = along(&grid.root_path_angle, math::sqrt(math::abs(steady.path_angle_rad)));
    let y = along(&grid.fourth_root_net_mass, math::sqrt(math::sqrt(math::abs(steady.net_mass_kg))));
    let [flat, steep] = [flat, steep].map(|[light, heavy]| light + y * (heavy - light));
    flat + x * (steep - flat)
}

#[cfg(test)]
mod tests;
