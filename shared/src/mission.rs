//! What to fly, and the executive that goes through it.
//!
//! ```text
//!            ┌──────────────── Crest ◄───────────────┐ another yo
//!            ▼                                       │
//! Surface ─► Dive ─► Apogee ─► Climb ────────────────┤
//!            │          │        │                   │ last yo
//!            └──────────┴────────┴──► Recovery       ▼
//!                                        │       Surfacing ─► Complete
//!                                        └──► (stays; afloat)
//! ```

use heapless::Vec;
use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

use crate::{table::TrimTable, vehicle::FlightVehicle};

/// Largest number of headings in a mission.
pub const MAX_HEADINGS: usize = 32;
/// Greatest height above the sea floor to ask for, mm: altimeters of gliders reach 100 m.
pub const MAX_ALTITUDE_MM: i32 = 100_000;

/// A mission of yos: dives and climbs between two depths, then back to the surface.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Mission {
    /// Dive-and-climb cycles before surfacing, from 1.
    pub yos: u16,
    /// Depth of the apogee, mm.
    pub dive_to_mm: i32,
    /// Depth at which a climb turns into the next dive, mm.
    pub climb_to_mm: i32,
    /// Path angle of the dives, 0.01°, negative.
    pub dive_path_angle_cdeg: i16,
    /// Path angle of the climbs, 0.01°, positive.
    pub climb_path_angle_cdeg: i16,
    /// Net mass of the dives, g, positive.
    pub dive_net_mass_g: i16,
    /// Net mass of the climbs, g, negative.
    pub climb_net_mass_g: i16,
    /// Heading of each half-yo (dive, climb, dive, …), 0.01°, 0 to 35999; the last one holds on.
    pub headings_cdeg: Vec<u16, MAX_HEADINGS>,
    /// Shortest stay at the surface before the first dive, s.
    pub surface_time_s: u16,
    /// Height above the sea floor at which a dive turns, mm; 0 for none.
    pub altitude_mm: i32,
    /// Depth at which the mission is aborted, mm.
    pub abort_depth_mm: i32,
    /// Time after which the mission is aborted, s.
    pub max_duration_s: u32,
}

/// A value of a mission that cannot be flown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unflyable {
    /// The field of [`Mission`].
    pub field: &'static str,
    /// What was asked.
    pub value: i32,
    /// The least that would do.
    pub min: i32,
    /// The most that would do.
    pub max: i32,
}

impl Mission {
    /// Checks every value against the vehicle and the envelope of its trim table.
    ///
    /// # Errors
    /// The first field that cannot be flown, and what would be right.
    pub fn check(&self, table: &TrimTable<'_>) -> Result<(), Unflyable> {
        let vehicle: &FlightVehicle = table.vehicle();
        let working_depth_mm = vehicle.working_depth_mm;
        let dive = table.dive_envelope();
        let climb = table.climb_envelope();
        let rows = [
            ("yos", i32::from(self.yos), 1, i32::from(u16::MAX)),
            ("dive_to_mm", self.dive_to_mm, 1_000, working_depth_mm),
            ("climb_to_mm", self.climb_to_mm, 0, self.dive_to_mm.saturating_sub(1_000)),
            (
                "dive_path_angle_cdeg",
                i32::from(self.dive_path_angle_cdeg),
                dive.path_angle_cdeg.min,
                dive.path_angle_cdeg.max,
            ),
            (
                "climb_path_angle_cdeg",
                i32::from(self.climb_path_angle_cdeg),
                climb.path_angle_cdeg.min,
                climb.path_angle_cdeg.max,
            ),
            ("dive_net_mass_g", i32::from(self.dive_net_mass_g), dive.net_mass_g.min, dive.net_mass_g.max),
            ("climb_net_mass_g", i32::from(self.climb_net_mass_g), climb.net_mass_g.min, climb.net_mass_g.max),
            ("altitude_mm", self.altitude_mm, 0, MAX_ALTITUDE_MM),
            ("abort_depth_mm", self.abort_depth_mm, self.dive_to_mm.saturating_add(1), i32::MAX),
            ("max_duration_s", i32::try_from(self.max_duration_s).unwrap_or(i32::MAX), 1, i32::MAX - 1),
            ("number of headings", i32::try_from(self.headings_cdeg.len()).unwrap_or(i32::MAX), 1, 32),
        ];
        let headings = self.headings_cdeg.iter().map(|heading| ("headings_cdeg", i32::from(*heading), 0, 35_999));
        match rows.into_iter().chain(headings).find(|(_, value, min, max)| !(min..=max).contains(&value)) {
            Some((field, value, min, max)) => Err(Unflyable { field, value, min, max }),
            None => Ok(()),
        }
    }

    /// Heading of one half-yo: its dive or its climb.
    #[must_use]
    pub fn heading_cdeg(&self, yo: u16, climbing: bool) -> u16 {
        let half = usize::from(yo.saturating_sub(1)).saturating_mul(2).saturating_add(usize::from(climbing));
        self.headings_cdeg.get(half).or(self.headings_cdeg.last()).copied().unwrap_or(0)
    }
}

/// What the vehicle is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Phase {
    /// Afloat before the mission's first dive, antenna in air.
    Surface,
    /// Gliding down.
    Dive,
    /// Becoming light at depth, nearly level.
    Apogee,
    /// Gliding up.
    Climb,
    /// Becoming heavy at the top of a yo, nearly level.
    Crest,
    /// Last part of the way to the surface, fully light.
    Surfacing,
    /// Afloat after the last yo, antenna in air.
    Complete,
    /// Aborted: fully light, on the way to the surface or there.
    Recovery,
}

/// What may end a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Sensors are fresh, the position is known and the stay at the surface is over.
    ReadyToDive,
    /// The apogee depth will be reached if the reversal starts now.
    DeepEnough,
    /// The sea floor will be as near as it may come if the reversal starts now.
    NearBottom,
    /// Light enough to climb.
    Light,
    /// The top of the yo will be reached if the reversal starts now, and another yo follows.
    TopReached,
    /// The same, and this was the last yo.
    LastTopReached,
    /// Heavy enough to dive.
    Heavy,
    /// At the surface.
    Afloat,
    /// The supervisor ends the mission.
    Abort,
}

/// Which event takes the executive from which phase to which. Anything else changes nothing.
pub const TRANSITIONS: &[(Phase, Event, Phase)] = &[
    (Phase::Surface, Event::ReadyToDive, Phase::Dive),
    (Phase::Dive, Event::DeepEnough, Phase::Apogee),
    (Phase::Dive, Event::NearBottom, Phase::Apogee),
    (Phase::Apogee, Event::Light, Phase::Climb),
    (Phase::Climb, Event::TopReached, Phase::Crest),
    (Phase::Climb, Event::LastTopReached, Phase::Surfacing),
    (Phase::Crest, Event::Heavy, Phase::Dive),
    (Phase::Surfacing, Event::Afloat, Phase::Complete),
    (Phase::Surface, Event::Abort, Phase::Recovery),
    (Phase::Dive, Event::Abort, Phase::Recovery),
    (Phase::Apogee, Event::Abort, Phase::Recovery),
    (Phase::Climb, Event::Abort, Phase::Recovery),
    (Phase::Crest, Event::Abort, Phase::Recovery),
    (Phase::Surfacing, Event::Abort, Phase::Recovery),
];

/// Where the mission stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Executive {
    /// The phase under way.
    pub phase: Phase,
    /// The dive cycle under way, from 1; 0 before the first.
    pub yo: u16,
    /// Tick at which the phase began.
    pub since_tick: u32,
}

impl Executive {
    /// Before the first dive.
    #[must_use]
    pub const fn new() -> Self {
        Self { phase: Phase::Surface, yo: 0, since_tick: 0 }
    }

    /// Takes an event; tells whether it began another phase.
    pub fn take(&mut self, tick: u32, event: Event) -> bool {
        let Some((_, _, next)) = TRANSITIONS.iter().find(|(from, on, _)| *from == self.phase && *on == event) else {
            return false;
        };
        if *next == Phase::Dive {
            self.yo = self.yo.saturating_add(1);
        }
        self.phase = *next;
        self.since_tick = tick;
        true
    }
}

impl Default for Executive {
    fn default() -> Self {
        Self::new()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fly(events: &[Event]) -> Executive {
        let mut executive = Executive::new();
        for (tick, event) in (1..).zip(events) {
            executive.take(tick, *event);
        }
        executive
    }

    #[test]
    fn two_yos_go_through_every_phase_and_complete() {
        use Event::{Afloat, DeepEnough, Heavy, LastTopReached, Light, NearBottom, ReadyToDive, TopReached};
        let end = fly(&[ReadyToDive, DeepEnough, Light, TopReached, Heavy, NearBottom, Light, LastTopReached, Afloat]);
        assert_eq!(end, Executive { phase: Phase::Complete, yo: 2, since_tick: 9 });
    }

    #[test]
    fn an_event_out_of_place_changes_nothing() {
        use Event::{Afloat, DeepEnough, Heavy, Light, ReadyToDive};
        assert_eq!(fly(&[Light, Heavy, Afloat, DeepEnough]), Executive::new());
        assert_eq!(fly(&[ReadyToDive, ReadyToDive, Light]).phase, Phase::Dive);
    }

    #[test]
    fn every_unfinished_phase_can_be_aborted_and_recovery_is_never_left() {
        use Phase::{Apogee, Climb, Complete, Crest, Dive, Recovery, Surface, Surfacing};
        for phase in [Surface, Dive, Apogee, Climb, Crest, Surfacing] {
            assert!(TRANSITIONS.contains(&(phase, Event::Abort, Recovery)), "{phase:?} cannot be aborted");
        }
        assert!(TRANSITIONS.iter().all(|(from, ..)| *from != Recovery && *from != Complete));
    }
}
