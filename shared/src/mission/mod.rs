//! What to fly: depths, glides and the course over ground; and the executive that goes through it.

mod check;
mod executive;
pub mod guidance;

pub use check::{MAX_ALTITUDE_MM, MAX_RADIUS_MM, Unflyable};
pub use executive::{Event, Executive, TRANSITIONS};

use heapless::Vec;
use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

use crate::device::GpsFix;

/// Largest number of headings in a mission.
pub const MAX_HEADINGS: usize = 32;
/// Largest number of waypoints in a mission.
pub const MAX_WAYPOINTS: usize = 16;

/// A mission: some yos between two depths, up to the surface, and that again.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Mission {
    /// Dive-and-climb cycles before surfacing, from 1.
    pub yos: u16,
    /// How often the vehicle surfaces, from 1; it waits for a position each time before it dives again.
    pub surfacings: u16,
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
    /// Where to go.
    pub course: Course,
    /// Time to drift at the apogee's depth before each climb, s; 0 for none.
    pub drift_time_s: u32,
    /// Depth above which the way to the surface is flown nearly level, mm; 0 to hold the climb's pitch.
    pub flare_depth_mm: i32,
    /// Shortest stay at the surface before a dive, s.
    pub surface_time_s: u16,
    /// Height above the sea floor at which a dive turns, mm; 0 for none.
    pub altitude_mm: i32,
    /// Depth at which the mission is aborted, mm.
    pub abort_depth_mm: i32,
    /// Time after which the mission is aborted, s.
    pub max_duration_s: u32,
}

/// Where a mission goes.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub enum Course {
    /// Heading of each half-yo (dive, climb, dive, …), 0.01°, 0 to 35999; the last one holds on.
    Headings(Vec<u16, MAX_HEADINGS>),
    /// From place to place; the mission ends at the surfacing after the last one.
    Waypoints(Route),
    /// Round and round, near one place.
    Spiral(Mooring),
}

/// Waypoints, reached in their order.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Route {
    /// Where to go.
    pub places: Vec<GpsFix, MAX_WAYPOINTS>,
    /// Distance at which a waypoint counts as reached, mm.
    pub capture_radius_mm: i32,
    /// Time after which a waypoint is given up for the next one, s; 0 for none.
    pub leg_time_s: u32,
}

/// A virtual mooring: spirals while near the station, and glides back to it from afar.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
pub struct Mooring {
    /// Turn rate of dives and climbs, 0.01 °/s, right positive.
    pub turn_rate_cdeg_s: i16,
    /// Where to stay.
    pub station: GpsFix,
    /// Distance from the station beyond which a half-yo glides back towards it, mm.
    pub radius_mm: i32,
}

impl Mission {
    /// Whether this yo is the last one before the vehicle surfaces. Yos count from 1, on over the surfacings.
    #[must_use]
    pub fn surfaces_after(&self, yo: u16) -> bool {
        yo.checked_rem(self.yos).is_none_or(|into| into == 0)
    }

    /// Whether this yo is the last one of all.
    #[must_use]
    pub fn ends_after(&self, yo: u16) -> bool {
        u32::from(yo) >= self.total_yos()
    }

    /// Dive-and-climb cycles in the whole mission.
    #[must_use]
    pub fn total_yos(&self) -> u32 {
        u32::from(self.yos).saturating_mul(self.surfacings.into())
    }
}

/// Heading of one half-yo out of a list: its dive or its climb.
#[must_use]
pub fn heading_of(headings_cdeg: &[u16], yo: u16, climbing: bool) -> u16 {
    let half = usize::from(yo.saturating_sub(1)).saturating_mul(2).saturating_add(usize::from(climbing));
    headings_cdeg.get(half).or(headings_cdeg.last()).copied().unwrap_or(0)
}
