//! Ends the mission when it must end.

use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

use crate::{device::TICK_HZ, mission::Mission, parameters::Parameters};

/// Why a mission ended early (append only).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Abort {
    /// Deeper than the mission's abort depth.
    Overdepth,
    /// The mission took longer than its time allowed.
    MissionTimeout,
    /// No fresh depth for too long.
    StaleDepth,
    /// No fresh attitude for too long.
    StaleAttitude,
}

/// Limits of one mission, in ticks and millimetres.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Supervisor {
    abort_depth_mm: i32,
    max_ticks: u32,
    stale_depth_ticks: u32,
    stale_attitude_ticks: u32,
}

/// What the supervisor looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vitals {
    /// Ticks since the mission began.
    pub tick: u32,
    /// Depth last measured, mm.
    pub depth_mm: i32,
    /// Tick of the last fresh depth.
    pub depth_tick: u32,
    /// Tick of the last fresh attitude.
    pub attitude_tick: u32,
}

impl Supervisor {
    /// Watches over one mission.
    #[must_use]
    pub fn new(mission: &Mission, parameters: &Parameters) -> Self {
        let ticks = |seconds: u32| seconds.saturating_mul(TICK_HZ);
        Self {
            abort_depth_mm: mission.abort_depth_mm,
            max_ticks: ticks(mission.max_duration_s),
            stale_depth_ticks: ticks(parameters.stale_depth_s.unsigned_abs()),
            stale_attitude_ticks: ticks(parameters.stale_attitude_s.unsigned_abs()),
        }
    }

    /// The reason to abort now, the gravest first.
    #[must_use]
    pub fn judge(&self, vitals: &Vitals) -> Option<Abort> {
        let age = |since: u32| vitals.tick.saturating_sub(since);
        let rows = [
            (vitals.depth_mm > self.abort_depth_mm, Abort::Overdepth),
            (age(vitals.depth_tick) > self.stale_depth_ticks, Abort::StaleDepth),
            (age(vitals.attitude_tick) > self.stale_attitude_ticks, Abort::StaleAttitude),
            (vitals.tick > self.max_ticks, Abort::MissionTimeout),
        ];
        rows.into_iter().find(|(met, _)| *met).map(|(_, abort)| abort)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use heapless::Vec;

    const WELL: Vitals = Vitals { tick: 1_000, depth_mm: 150_000, depth_tick: 1_000, attitude_tick: 1_000 };

    fn supervisor() -> Supervisor {
        let mission = Mission {
            yos: 1,
            dive_to_mm: 200_000,
            climb_to_mm: 3_000,
            dive_path_angle_cdeg: -2_600,
            climb_path_angle_cdeg: 2_600,
            dive_net_mass_g: 250,
            climb_net_mass_g: -250,
            headings_cdeg: Vec::new(),
            surface_time_s: 0,
            abort_depth_mm: 215_000,
            max_duration_s: 3_600,
        };
        Supervisor::new(&mission, &Parameters::default())
    }

    #[test]
    fn a_healthy_dive_goes_on() {
        assert_eq!(supervisor().judge(&WELL), None);
    }

    #[test]
    fn each_limit_aborts_just_beyond_it() {
        let judge = |vitals| supervisor().judge(&vitals);
        assert_eq!(judge(Vitals { depth_mm: 215_000, ..WELL }), None);
        assert_eq!(judge(Vitals { depth_mm: 215_001, ..WELL }), Some(Abort::Overdepth));
        let late = 3_600 * TICK_HZ;
        let fresh = Vitals { depth_tick: late, attitude_tick: late, ..WELL };
        assert_eq!(judge(Vitals { tick: late, ..fresh }), None);
        assert_eq!(judge(Vitals { tick: late + 1, ..fresh }), Some(Abort::MissionTimeout));
        assert_eq!(judge(Vitals { depth_tick: 1_000 - 60 * TICK_HZ, ..WELL }), None);
        assert_eq!(judge(Vitals { depth_tick: 999 - 60 * TICK_HZ, ..WELL }), Some(Abort::StaleDepth));
        assert_eq!(judge(Vitals { attitude_tick: 999 - 120 * TICK_HZ, ..WELL }), Some(Abort::StaleAttitude));
    }

    #[test]
    fn the_gravest_reason_is_given_first() {
        let all = Vitals { tick: 1_000_000, depth_mm: 300_000, depth_tick: 0, attitude_tick: 0 };
        assert_eq!(supervisor().judge(&all), Some(Abort::Overdepth));
    }
}
