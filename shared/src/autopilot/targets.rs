//! Where the actuators shall go in each phase.

use super::{AFLOAT_DEPTH_M, Autopilot, Side, Targets};
use crate::commands::{Aim, Phase};
use crate::control::pitch::PitchLoop;
use crate::device::{MM_PER_M, Measurements, RAD_PER_CDEG, TICK_HZ, UM_PER_M};
use crate::math;

/// Depth above which heading is left alone, since the wings are about to leave the water or just entered it, m.
const HEADING_DEPTH_M: f32 = 2.0;
/// Time after an inflection before heading is controlled again, s.
const TURN_SETTLE_S: u32 = 12;

impl Autopilot<'_> {
    pub(super) fn targets(&mut self, tick: u32, measurements: &Measurements) -> Targets {
        let config = &self.config;
        let (dive, climb) = (config.dive, config.climb);
        let actuators = config.actuators();
        let (lightest_ul, nose_down_um) = (actuators.vbd_ul.max, actuators.r_px_um.max);
        let mu_cdeg = config.heading.hanging_cdeg(self.state.mu_target_cdeg);
        let straight = |r_px_um, vbd_ul, pitch_cdeg| Targets { r_px_um, mu_cdeg, vbd_ul, pitch_cdeg };
        let (dive_trim, climb_trim) = (self.state.dive_trim, self.state.climb_trim);
        match self.state.executive.phase {
            // The antenna sits in the tail: nose down lifts it out of the water.
            Phase::Surface | Phase::Complete => straight(nose_down_um, lightest_ul, 0),
            Phase::Recovery if self.state.navigator.depth_m < AFLOAT_DEPTH_M => straight(nose_down_um, lightest_ul, 0),
            Phase::Recovery => {
                let r_px_um = PitchLoop::feed_forward_um(&config.table, &climb.steady, 0.0);
                straight(r_px_um, lightest_ul, climb.pitch_cdeg)
            }
            Phase::Apogee => {
                let r_px_um = config.level_off_um(&dive, dive_trim);
                straight(r_px_um, climb.vbd_ul, config.apogee_pitch_cdeg.saturating_neg())
            }
            Phase::Crest => straight(config.level_off_um(&climb, climb_trim), dive.vbd_ul, config.apogee_pitch_cdeg),
            Phase::Surfacing if self.state.navigator.depth_mm() < config.mission.flare_depth_mm => {
                straight(config.level_off_um(&climb, climb_trim), lightest_ul, config.apogee_pitch_cdeg)
            }
            Phase::Dive => self.glide(tick, measurements, dive, dive.vbd_ul),
            Phase::Climb => self.glide(tick, measurements, climb, climb.vbd_ul),
            Phase::Surfacing => self.glide(tick, measurements, climb, lightest_ul),
            Phase::Drift => self.drift(tick),
        }
    }

    /// Holds a steady glide on the heading of guidance, or in its spiral.
    fn glide(&mut self, tick: u32, measurements: &Measurements, side: Side, vbd_ul: i32) -> Targets {
        let (config, state) = (&self.config, &mut self.state);
        let Side { steady, .. } = side;
        let ticks_in_phase = tick.saturating_sub(state.executive.since_tick);
        let surfacing = state.executive.phase == Phase::Surfacing;
        let spiral = state.guide.aim == Aim::Spiral;
        let (attitude, moving) = (state.navigator.attitude, state.r_px_wanted);
        let (trim, turn) = if steady.path_angle_rad < 0.0 {
            (&mut state.dive_trim, &mut state.dive_turn)
        } else {
            (&mut state.climb_trim, &mut state.climb_turn)
        };
        let mu_rad = f32::from(measurements.mu_cdeg) * RAD_PER_CDEG;
        let expected = config.table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad);
        // A turn on the way to a heading is short; a spiral goes on, at the pitch of the turn.
        let pitch_cdeg = if spiral { math::round_to_i32(expected.pitch_rad / RAD_PER_CDEG) } else { side.pitch_cdeg };
        // Beyond the table its axial position is only the edge's: an error there teaches nothing about the trim.
        if !surfacing && !expected.saturated {
            let pitch_error_cdeg = pitch_cdeg.saturating_sub(i32::from(attitude.pitch_cdeg));
            config.pitch.update(trim, &config.table, &steady, ticks_in_phase, (!moving).then_some(pitch_error_cdeg));
        }
        let trim_um = trim.trim_um;
        if state.navigator.depth_m < HEADING_DEPTH_M || (spiral && surfacing) {
            state.mu_target_cdeg = config.heading.hanging_cdeg(state.mu_target_cdeg);
            turn.begin();
        } else if ticks_in_phase < TURN_SETTLE_S * TICK_HZ && !surfacing {
            turn.begin();
        } else if spiral {
            state.mu_target_cdeg = side.spiral_mu_cdeg;
            turn.begin();
        } else {
            let heading_cdeg = i32::from(state.guide.heading_cdeg);
            let error_cdeg = math::wrap_cdeg(heading_cdeg.saturating_sub(state.navigator.heading_cdeg()));
            state.mu_target_cdeg =
                config.heading.mu_cdeg(turn, &config.table, &steady, ticks_in_phase, error_cdeg, state.mu_target_cdeg);
        }
        let r_px_um = math::round_to_i32(expected.r_px_m * UM_PER_M).saturating_add(trim_um);
        Targets { r_px_um, mu_cdeg: state.mu_target_cdeg, vbd_ul, pitch_cdeg }
    }

    /// Stays level at the depth of the apogee.
    fn drift(&mut self, tick: u32) -> Targets {
        let (config, state) = (&self.config, &mut self.state);
        let navigator = &state.navigator;
        let ticks_in_phase = tick.saturating_sub(state.executive.since_tick);
        let pitch_error_cdeg = i32::from(navigator.attitude.pitch_cdeg).saturating_neg();
        // At rest as in a glide, pitch follows the mass by the lever of its weight: the table's slope will do.
        config.pitch.update(
            &mut state.drift_trim,
            &config.table,
            &config.dive.steady,
            ticks_in_phase,
            (!state.r_px_wanted).then_some(pitch_error_cdeg),
        );
        let error_m = config.mission.dive_to_mm as f32 / MM_PER_M - navigator.depth_m;
        let vehicle = config.table.vehicle();
        let vbd_ul = state.depth_hold.vbd_ul(vehicle, ticks_in_phase, error_m, navigator.depth_rate_m_s);
        Targets { r_px_um: state.drift_trim.trim_um, mu_cdeg: 0, vbd_ul, pitch_cdeg: 0 }
    }
}
