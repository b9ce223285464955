//! What ends a phase.

use super::{AFLOAT_DEPTH_M, Autopilot, PASS_SHARE};
use crate::commands::Phase;
use crate::device::{MM_PER_M, Measurements};
use crate::estimate::reversal::{Forecast, STEP_S};
use crate::math;
use crate::mission::Event;
use crate::model::reduced::Model;
use crate::safety::streak::Streak;

/// Vertical speed below which the vehicle counts as at rest at the surface, m/s.
const AFLOAT_RATE_M_S: f32 = 0.1;

impl Autopilot<'_> {
    /// What happened that may end the phase.
    pub(super) fn event(&mut self, tick: u32, measurements: &Measurements) -> Option<Event> {
        let near_bottom = self.is_near_bottom(measurements);
        let (config, navigator, executive) = (&self.config, &self.state.navigator, &self.state.executive);
        let mission = &config.mission;
        let arrived = self.state.guide.is_over(mission);
        let net_mass_kg = config.table.vehicle().net_mass_kg(measurements.vbd_ul);
        let depth_mm = navigator.depth_mm();
        let ahead_mm = depth_mm.saturating_add(self.lead_mm());
        let (met, event) = match executive.phase {
            // The fix may show that the last waypoint was reached after all.
            Phase::Surface if arrived && executive.yo > 0 => (true, Event::LastAfloat),
            Phase::Surface => (self.is_ready_to_dive(tick), Event::ReadyToDive),
            Phase::Dive | Phase::Drift if near_bottom => (true, Event::NearBottom),
            Phase::Dive if mission.drift_time_s > 0 => (ahead_mm >= mission.dive_to_mm, Event::DeepEnoughToDrift),
            Phase::Dive => (ahead_mm >= mission.dive_to_mm, Event::DeepEnough),
            Phase::Drift => (executive.has_lasted_s(tick, mission.drift_time_s), Event::DriftOver),
            Phase::Apogee => (net_mass_kg <= PASS_SHARE * config.climb.steady.net_mass_kg, Event::Light),
            // Nothing reverses at the last top.
            Phase::Climb if arrived || mission.surfaces_after(executive.yo) => {
                // A surfaced vehicle floats some centimetres deep.
                (depth_mm <= mission.climb_to_mm || self.is_at_rest(), Event::LastTopReached)
            }
            Phase::Climb => (ahead_mm <= mission.climb_to_mm, Event::TopReached),
            Phase::Crest => (net_mass_kg >= PASS_SHARE * config.dive.steady.net_mass_kg, Event::Heavy),
            Phase::Surfacing if arrived || mission.ends_after(executive.yo) => (self.is_at_rest(), Event::LastAfloat),
            Phase::Surfacing => (self.is_at_rest(), Event::Afloat),
            Phase::Complete | Phase::Recovery => (false, Event::Abort),
        };
        met.then_some(event)
    }

    fn is_at_rest(&self) -> bool {
        let navigator = &self.state.navigator;
        navigator.depth_m < AFLOAT_DEPTH_M && math::abs(navigator.depth_rate_m_s) < AFLOAT_RATE_M_S
    }

    /// Goes on to find out where a reversal that begins now would turn.
    pub(super) fn forecast(&mut self) {
        let state = &mut self.state;
        let phase = state.executive.phase;
        if phase != Phase::Dive && phase != Phase::Climb {
            state.forecast = Forecast::default();
            return;
        }
        let plan = self.config.reversal(phase, &state.navigator);
        let vehicle = self.config.table.vehicle();
        let model = Model::new(&vehicle.glide, vehicle.gravity_m_s2, STEP_S);
        let (motion, drive) = state.navigator.motion();
        state.forecast.advance(&model, &plan, motion, drive);
    }

    /// Depth between the begin of a reversal and its turning point, mm, down positive.
    fn lead_mm(&self) -> i32 {
        math::round_to_i32(self.state.forecast.lead_m() * MM_PER_M)
    }

    /// Whether a vehicle that turns now comes as near to the sea floor as it may; one false echo does not say so.
    fn is_near_bottom(&mut self, measurements: &Measurements) -> bool {
        let least_mm = self.config.mission.altitude_mm;
        if least_mm == 0 || !matches!(self.state.executive.phase, Phase::Dive | Phase::Drift) {
            self.state.bottom = Streak::default();
            return false;
        }
        let lead_mm = self.lead_mm();
        let near = measurements.altitude_mm.map(|height_mm| height_mm.saturating_sub(lead_mm) <= least_mm);
        self.state.bottom.take(near, self.config.altitude_samples)
    }

    fn is_ready_to_dive(&self, tick: u32) -> bool {
        let (navigator, executive) = (&self.state.navigator, &self.state.executive);
        executive.has_lasted_s(tick, self.config.mission.surface_time_s.into())
            && self.state.fix_tick.is_some_and(|fix_tick| fix_tick >= executive.since_tick)
            && navigator.depth_tick == Some(tick)
            && navigator.attitude_tick == Some(tick)
    }
}
