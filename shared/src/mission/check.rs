//! Whether a vehicle can fly a mission.

use super::{Course, MAX_HEADINGS, MAX_WAYPOINTS, Mission};
use crate::device::{GpsFix, RAD_PER_CDEG};
use crate::math;
use crate::model::{table::TrimTable, vehicle::Range};

/// Greatest height above the sea floor to ask for, mm: altimeters of gliders reach 100 m.
pub const MAX_ALTITUDE_MM: i32 = 100_000;
/// Largest radius about a waypoint or a station, mm.
pub const MAX_RADIUS_MM: i32 = 100_000_000;
/// Smallest one, mm: dead reckoning is no better after a dive.
const MIN_RADIUS_MM: i32 = 10_000;
const KG_PER_G: f32 = 1e-3;
/// A quarter turn, and so the northernmost latitude, 1e-7°.
const QUARTER_E7: i32 = 900_000_000;
/// Half a turn, 1e-7°.
const HALF_E7: i32 = 1_800_000_000;

/// A value of a mission that cannot be flown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Unflyable {
    /// The field of [`Mission`], or the path to it.
    pub field: &'static str,
    /// What was asked.
    pub value: i32,
    /// The least that would do.
    pub min: i32,
    /// The most that would do.
    pub max: i32,
}

/// A field, its value, and the least and the most that would do.
type Row = (&'static str, i32, i32, i32);

impl Mission {
    /// Checks every value against the vehicle and the envelope of its trim table.
    ///
    /// # Errors
    /// The first field that cannot be flown, and what would be right.
    pub fn check(&self, table: &TrimTable<'_>) -> Result<(), Unflyable> {
        let working_depth_mm = table.vehicle().working_depth_mm;
        let (dive, climb) = (table.dive_envelope(), table.climb_envelope());
        let within = |field, value: i16, range: Range| (field, i32::from(value), range.min, range.max);
        let most_surfacings = i32::from(u16::MAX).checked_div(self.yos.into()).unwrap_or(1);
        let rows = [
            ("yos", i32::from(self.yos), 1, i32::from(u16::MAX)),
            ("surfacings", i32::from(self.surfacings), 1, most_surfacings),
            ("dive_to_mm", self.dive_to_mm, 1_000, working_depth_mm),
            ("climb_to_mm", self.climb_to_mm, 0, self.dive_to_mm.saturating_sub(1_000)),
            within("dive_path_angle_cdeg", self.dive_path_angle_cdeg, dive.path_angle_cdeg),
            within("climb_path_angle_cdeg", self.climb_path_angle_cdeg, climb.path_angle_cdeg),
            within("dive_net_mass_g", self.dive_net_mass_g, dive.net_mass_g),
            within("climb_net_mass_g", self.climb_net_mass_g, climb.net_mass_g),
            ("flare_depth_mm", self.flare_depth_mm, 0, self.climb_to_mm),
            ("altitude_mm", self.altitude_mm, 0, MAX_ALTITUDE_MM),
            ("abort_depth_mm", self.abort_depth_mm, self.dive_to_mm.saturating_add(1), i32::MAX),
            ("max_duration_s", saturated(self.max_duration_s), 1, i32::MAX - 1),
            ("drift_time_s", saturated(self.drift_time_s), 0, saturated(self.max_duration_s)),
        ];
        first_wrong(rows)?;
        self.check_course(table)
    }

    fn check_course(&self, table: &TrimTable<'_>) -> Result<(), Unflyable> {
        match &self.course {
            Course::Headings(headings) => {
                first_wrong([number("number of headings", headings.len(), MAX_HEADINGS)])?;
                first_wrong(headings.iter().map(|heading| ("headings_cdeg", i32::from(*heading), 0, 35_999)))
            }
            Course::Waypoints(route) => {
                first_wrong([
                    number("waypoints.number of places", route.places.len(), MAX_WAYPOINTS),
                    ("waypoints.capture_radius_mm", route.capture_radius_mm, MIN_RADIUS_MM, MAX_RADIUS_MM),
                    ("waypoints.leg_time_s", saturated(route.leg_time_s), 0, saturated(self.max_duration_s)),
                ])?;
                first_wrong(route.places.iter().flat_map(|place| on_earth("waypoints.places_e7", place)))
            }
            Course::Spiral(mooring) => {
                let reach = self.turn_rates_cdeg_s(table);
                first_wrong([
                    ("spiral.turn_rate_cdeg_s", mooring.turn_rate_cdeg_s.into(), reach.min, reach.max),
                    ("spiral.radius_mm", mooring.radius_mm, MIN_RADIUS_MM, MAX_RADIUS_MM),
                ])?;
                first_wrong(on_earth("spiral.station_e7", &mooring.station))
            }
        }
    }

    /// Turn rates that dives and climbs both reach, left to right, 0.01 °/s.
    fn turn_rates_cdeg_s(&self, table: &TrimTable<'_>) -> Range {
        let rate_cdeg_s = |path_cdeg: i16, net_mass_g: i16, mu_rad: f32| {
            let path_rad = f32::from(path_cdeg) * RAD_PER_CDEG;
            table.look_up(path_rad, f32::from(net_mass_g) * KG_PER_G, mu_rad).turn_rate_rad_s / RAD_PER_CDEG
        };
        let limit_rad = table.mu_limit_rad();
        let side = |path_cdeg, net_mass_g| {
            let (one, other) =
                (rate_cdeg_s(path_cdeg, net_mass_g, limit_rad), rate_cdeg_s(path_cdeg, net_mass_g, -limit_rad));
            if one < other { (one, other) } else { (other, one) }
        };
        let dive = side(self.dive_path_angle_cdeg, self.dive_net_mass_g);
        let climb = side(self.climb_path_angle_cdeg, self.climb_net_mass_g);
        let left = if dive.0 > climb.0 { dive.0 } else { climb.0 };
        let right = if dive.1 < climb.1 { dive.1 } else { climb.1 };
        // Towards zero, so that what is said to be within reach is.
        Range { min: math::round_to_i32(left + 0.5), max: math::round_to_i32(right - 0.5) }
    }
}

fn first_wrong(rows: impl IntoIterator<Item = Row>) -> Result<(), Unflyable> {
    match rows.into_iter().find(|(_, value, min, max)| !(min..=max).contains(&value)) {
        Some((field, value, min, max)) => Err(Unflyable { field, value, min, max }),
        None => Ok(()),
    }
}

fn number(field: &'static str, count: usize, most: usize) -> Row {
    let integer = |count: usize| i32::try_from(count).unwrap_or(i32::MAX);
    (field, integer(count), 1, integer(most))
}

const fn on_earth(field: &'static str, place: &GpsFix) -> [Row; 2] {
    [(field, place.lat_e7, -QUARTER_E7, QUARTER_E7), (field, place.lon_e7, -HALF_E7, HALF_E7)]
}

fn saturated(value: u32) -> i32 {
    i32::try_from(value).unwrap_or(i32::MAX)
}
