//! Where to head: along the mission's headings, from waypoint to waypoint across a current, or round a station.
//!
//! The vehicle glides at one speed through water that carries it. To go straight to a place it heads up into the current by
//! the ferry angle, at which the current across the line is made up for: sin(angle) = −(current across)/(speed).
//! A current that leaves no way made good cannot be stemmed; then it heads straight at the place, where it closes fastest or
//! is carried off slowest. Such a waypoint is given up for the next one when a surfacing finds the vehicle farther off than
//! the surfacing before, and any waypoint when its time is up.

use crate::commands::Aim;
use crate::commands::Phase;
use crate::device::{MM_PER_M, RAD_PER_CDEG, TICK_HZ, TURN_CDEG};
use crate::estimate::navigator::Navigator;
use crate::math;
use crate::mission::{Course, Executive, Mission, Mooring, Route, heading_of};

/// Time between two looks at where a place lies, s: at 0.4 m/s a place 200 m off has then moved by 3°.
const PERIOD_S: u32 = 30;
/// Share of the mooring's radius within which gliding back to the station ends.
const BACK_AT_STATION: f32 = 0.5;

/// A heading across a current.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ferry {
    /// Heading, rad clockwise from north, −π to π.
    pub heading_rad: f32,
    /// Speed over ground towards the place, m/s.
    pub made_good_m_s: f32,
    /// Whether the way over ground leads to the place.
    pub stemmed: bool,
}

impl Ferry {
    /// To a place `to` north and east of here (any unit), at a horizontal speed through water that moves with `current_m_s`
    /// to north and east.
    #[must_use]
    pub fn new(to: (f32, f32), speed_m_s: f32, current_m_s: (f32, f32)) -> Self {
        let bearing_rad = math::atan2(to.1, to.0);
        let (north, east) = (math::cos(bearing_rad), math::sin(bearing_rad));
        let along_m_s = current_m_s.0 * north + current_m_s.1 * east;
        let across_m_s = current_m_s.1 * north - current_m_s.0 * east;
        let sine = math::finite_or(-across_m_s / speed_m_s, 0.0);
        let made_good_m_s = math::sqrt(1.0 - sine * sine) * speed_m_s + along_m_s;
        if math::abs(sine) < 1.0 && made_good_m_s > 0.0 {
            Self { heading_rad: bearing_rad + math::asin(sine), made_good_m_s, stemmed: true }
        } else {
            Self { heading_rad: bearing_rad, made_good_m_s: speed_m_s + along_m_s, stemmed: false }
        }
    }
}

/// What guidance looks at.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// Ticks since the mission began.
    pub tick: u32,
    /// Where the mission stands.
    pub executive: &'a Executive,
    /// Where the vehicle is.
    pub navigator: &'a Navigator,
    /// The water's motion to north and east, as far as it is known, m/s.
    pub current_m_s: (f32, f32),
    /// Horizontal speed of the glide under way or next through the water, m/s.
    pub speed_m_s: f32,
}

/// Where the vehicle is heading.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Guide {
    /// What for.
    pub aim: Aim,
    /// 0.01°, 0 to 35999.
    pub heading_cdeg: u16,
    /// Waypoints that are done with, reached or not.
    passed: u8,
    /// Tick from which on the next waypoint is headed for.
    leg_since_tick: u32,
    /// Distance to the waypoint at the last surfacing on the way to it, m.
    surfaced_at_m: Option<f32>,
    /// Tick of the last look at where a place lies.
    looked_tick: Option<u32>,
}

impl Guide {
    /// Takes one tick.
    pub fn update(&mut self, mission: &Mission, sight: &Sight<'_>) {
        match &mission.course {
            Course::Headings(headings) => self.heading_cdeg = listed_cdeg(headings, sight.executive),
            Course::Waypoints(route) => self.follow(route, sight),
            Course::Spiral(mooring) => self.moor(mooring, sight),
        }
    }

    /// Whether there is nothing left to go to.
    #[must_use]
    pub fn is_over(&self, mission: &Mission) -> bool {
        matches!(&mission.course, Course::Waypoints(route) if usize::from(self.passed) >= route.places.len())
    }

    fn follow(&mut self, route: &Route, sight: &Sight<'_>) {
        let Some(place) = route.places.get(usize::from(self.passed)) else { return };
        let Some(to_m) = sight.navigator.offset_mm(place).map(metres) else { return };
        let distance_m = length(to_m);
        let reached = distance_m <= route.capture_radius_mm as f32 / MM_PER_M;
        let leg_ticks = sight.tick.saturating_sub(self.leg_since_tick);
        let timed_out = route.leg_time_s > 0 && leg_ticks >= route.leg_time_s.saturating_mul(TICK_HZ);
        if reached || timed_out || self.falls_behind(distance_m, sight) {
            self.passed = self.passed.saturating_add(1);
            self.leg_since_tick = sight.tick;
            self.surfaced_at_m = None;
            self.looked_tick = None;
        } else if self.is_due(sight) {
            let number = self.passed.saturating_add(1);
            let stemmed = self.head_for(to_m, sight);
            self.aim = if stemmed { Aim::Waypoint(number) } else { Aim::UnstemmedWaypoint(number) };
        }
    }

    /// Whether a surfacing that ends now shows that the current carries the vehicle off. Only fixes are compared: on the way
    /// the position is only as good as what is known of the current.
    fn falls_behind(&mut self, distance_m: f32, sight: &Sight<'_>) -> bool {
        if !sight.executive.has_left(Phase::Surface, sight.tick) {
            return false;
        }
        let before_m = self.surfaced_at_m.replace(distance_m);
        matches!(self.aim, Aim::UnstemmedWaypoint(_)) && before_m.is_some_and(|before_m| distance_m >= before_m)
    }

    fn moor(&mut self, mooring: &Mooring, sight: &Sight<'_>) {
        let Some(to_m) = sight.navigator.offset_mm(&mooring.station).map(metres) else { return };
        let radius_m = mooring.radius_mm as f32 / MM_PER_M;
        let begins = sight.executive.since_tick == sight.tick
            && matches!(sight.executive.phase, Phase::Dive | Phase::Climb | Phase::Surface);
        let back = self.aim != Aim::Spiral && length(to_m) <= BACK_AT_STATION * radius_m;
        if begins || back {
            self.aim = if length(to_m) > radius_m { Aim::Station } else { Aim::Spiral };
            self.looked_tick = None;
        }
        if self.aim != Aim::Spiral && self.is_due(sight) {
            self.aim = if self.head_for(to_m, sight) { Aim::Station } else { Aim::UnstemmedStation };
        }
    }

    /// Whether it is time to look again: at once when a phase begins, else once per period.
    fn is_due(&mut self, sight: &Sight<'_>) -> bool {
        let begins = sight.executive.since_tick == sight.tick;
        let rested = self.looked_tick.is_none_or(|last| sight.tick.saturating_sub(last) >= PERIOD_S * TICK_HZ);
        if begins || rested {
            self.looked_tick = Some(sight.tick);
        }
        begins || rested
    }

    /// Heads for a place; whether it can be reached against the current.
    fn head_for(&mut self, to_m: (f32, f32), sight: &Sight<'_>) -> bool {
        let ferry = Ferry::new(to_m, sight.speed_m_s, sight.current_m_s);
        let heading_cdeg = math::round_to_i32(ferry.heading_rad / RAD_PER_CDEG).rem_euclid(TURN_CDEG);
        self.heading_cdeg = u16::try_from(heading_cdeg).unwrap_or(0);
        ferry.stemmed
    }
}

/// Heading of the half-yo under way; a turn between two already aims at the next one's.
fn listed_cdeg(headings_cdeg: &[u16], executive: &Executive) -> u16 {
    let yo = executive.yo;
    match executive.phase {
        Phase::Dive | Phase::Drift => heading_of(headings_cdeg, yo, false),
        Phase::Surface | Phase::Crest => heading_of(headings_cdeg, yo.saturating_add(1), false),
        Phase::Apogee | Phase::Climb | Phase::Surfacing | Phase::Complete | Phase::Recovery => {
            heading_of(headings_cdeg, yo, true)
        }
    }
}

fn metres((north_mm, east_mm): (i32, i32)) -> (f32, f32) {
    (north_mm as f32 / MM_PER_M, east_mm as f32 / MM_PER_M)
}

fn length((north, east): (f32, f32)) -> f32 {
    math::sqrt(north * north + east * east)
}

#[cfg(test)]
mod tests;
