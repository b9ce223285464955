//! The executive: which phase follows which, and when the mission is over.
//!
//! ```text
//!   another surfacing
//!    ┌───────────────────────────────────────────────────────┐
//!    │       ┌───────────── Crest ◄────────────┐ another yo  │
//!    ▼       ▼                                 │             │
//! Surface ─► Dive ─┬──────────► Apogee ─► Climb ─► Surfacing ─┴─► Complete
//!                  └─► Drift ────┘
//!
//! any of these but Complete ─► Recovery, for good
//! ```

use crate::commands::Phase;
use crate::device::TICK_HZ;

/// What may end a phase.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Event {
    /// Sensors are fresh, the position was fixed and the stay at the surface is over.
    ReadyToDive,
    /// The apogee depth will be reached if the reversal starts now.
    DeepEnough,
    /// The same, and the mission drifts there.
    DeepEnoughToDrift,
    /// It has drifted for as long as it shall.
    DriftOver,
    /// The sea floor will be as near as it may come if the reversal starts now.
    NearBottom,
    /// Light enough to climb.
    Light,
    /// The top of the yo will be reached if the reversal starts now, and another yo follows.
    TopReached,
    /// The same, and the vehicle surfaces before it dives again.
    LastTopReached,
    /// Heavy enough to dive.
    Heavy,
    /// At the surface, and dives follow.
    Afloat,
    /// At the surface, and nothing is left to fly: as dead reckoning has it, or as a position fix there shows.
    LastAfloat,
    /// The supervisor ends the mission.
    Abort,
}

/// Which event takes the executive from which phase to which. Anything else changes nothing.
pub const TRANSITIONS: &[(Phase, Event, Phase)] = &[
    (Phase::Surface, Event::ReadyToDive, Phase::Dive),
    (Phase::Surface, Event::LastAfloat, Phase::Complete),
    (Phase::Dive, Event::DeepEnough, Phase::Apogee),
    (Phase::Dive, Event::NearBottom, Phase::Apogee),
    (Phase::Dive, Event::DeepEnoughToDrift, Phase::Drift),
    (Phase::Drift, Event::DriftOver, Phase::Apogee),
    (Phase::Drift, Event::NearBottom, Phase::Apogee),
    (Phase::Apogee, Event::Light, Phase::Climb),
    (Phase::Climb, Event::TopReached, Phase::Crest),
    (Phase::Climb, Event::LastTopReached, Phase::Surfacing),
    (Phase::Crest, Event::Heavy, Phase::Dive),
    (Phase::Surfacing, Event::Afloat, Phase::Surface),
    (Phase::Surfacing, Event::LastAfloat, Phase::Complete),
    (Phase::Surface, Event::Abort, Phase::Recovery),
    (Phase::Dive, Event::Abort, Phase::Recovery),
    (Phase::Drift, Event::Abort, Phase::Recovery),
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
    /// The phase before it.
    pub before: Phase,
}

impl Executive {
    /// Before the first dive.
    #[must_use]
    pub const fn new() -> Self {
        Self { phase: Phase::Surface, yo: 0, since_tick: 0, before: Phase::Surface }
    }

    /// Takes an event; tells whether it began another phase.
    pub fn take(&mut self, tick: u32, event: Event) -> bool {
        let Some((_, _, next)) = TRANSITIONS.iter().find(|(from, on, _)| *from == self.phase && *on == event) else {
            return false;
        };
        if *next == Phase::Dive {
            self.yo = self.yo.saturating_add(1);
        }
        self.before = self.phase;
        self.phase = *next;
        self.since_tick = tick;
        true
    }

    /// Whether the phase has lasted for this time.
    #[must_use]
    pub const fn has_lasted_s(&self, tick: u32, seconds: u32) -> bool {
        tick.saturating_sub(self.since_tick) >= seconds.saturating_mul(TICK_HZ)
    }

    /// Whether a phase was left at this tick.
    #[must_use]
    pub fn has_left(&self, phase: Phase, tick: u32) -> bool {
        self.phase != phase && self.before == phase && self.since_tick == tick
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
        use Event::{DeepEnough, Heavy, LastAfloat, LastTopReached, Light, NearBottom, ReadyToDive, TopReached};
        let end =
            fly(&[ReadyToDive, DeepEnough, Light, TopReached, Heavy, NearBottom, Light, LastTopReached, LastAfloat]);
        assert_eq!(end, Executive { phase: Phase::Complete, yo: 2, since_tick: 9, before: Phase::Surfacing });
    }

    #[test]
    fn a_vehicle_that_surfaces_between_dives_counts_on() {
        use Event::{Afloat, DeepEnough, LastAfloat, LastTopReached, Light, ReadyToDive};
        let dive = [ReadyToDive, DeepEnough, Light, LastTopReached];
        let once = [&dive[..], &[Afloat]].concat();
        assert_eq!(fly(&once), Executive { phase: Phase::Surface, yo: 1, since_tick: 5, before: Phase::Surfacing });
        let twice = [&once[..], &dive, &[LastAfloat]].concat();
        assert_eq!(fly(&twice), Executive { phase: Phase::Complete, yo: 2, since_tick: 10, before: Phase::Surfacing });
    }

    #[test]
    fn a_drift_lies_between_dive_and_apogee_and_the_sea_floor_ends_it() {
        use Event::{DeepEnoughToDrift, DriftOver, Light, NearBottom, ReadyToDive};
        assert_eq!(fly(&[ReadyToDive, DeepEnoughToDrift]).phase, Phase::Drift);
        for end in [DriftOver, NearBottom] {
            assert_eq!(fly(&[ReadyToDive, DeepEnoughToDrift, end]).phase, Phase::Apogee);
            assert_eq!(fly(&[ReadyToDive, DeepEnoughToDrift, end, Light]).phase, Phase::Climb);
        }
    }

    #[test]
    fn an_event_out_of_place_changes_nothing() {
        use Event::{Afloat, DeepEnough, DriftOver, Heavy, Light, ReadyToDive};
        assert_eq!(fly(&[Light, Heavy, Afloat, DeepEnough, DriftOver]), Executive::new());
        assert_eq!(fly(&[ReadyToDive, ReadyToDive, Light]).phase, Phase::Dive);
    }

    #[test]
    fn every_unfinished_phase_can_be_aborted_and_recovery_is_never_left() {
        use Phase::{Apogee, Climb, Complete, Crest, Dive, Drift, Recovery, Surface, Surfacing};
        for phase in [Surface, Dive, Drift, Apogee, Climb, Crest, Surfacing] {
            assert!(TRANSITIONS.contains(&(phase, Event::Abort, Recovery)), "{phase:?} cannot be aborted");
        }
        assert!(TRANSITIONS.iter().all(|(from, ..)| *from != Recovery && *from != Complete));
    }

    /// Each phase but the first is entered, and each but the two ends is left without an abort.
    #[test]
    fn no_phase_is_a_dead_end_or_out_of_reach() {
        use Phase::{Apogee, Climb, Complete, Crest, Dive, Drift, Recovery, Surface, Surfacing};
        for phase in [Surface, Dive, Drift, Apogee, Climb, Crest, Surfacing, Complete, Recovery] {
            let is_left = TRANSITIONS.iter().any(|(from, on, _)| *from == phase && *on != Event::Abort);
            assert_eq!(is_left, phase != Complete && phase != Recovery, "{phase:?}");
            assert!(TRANSITIONS.iter().any(|(.., to)| *to == phase), "{phase:?} is never entered");
        }
    }
}
