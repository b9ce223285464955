//! Where a mission goes: headings, waypoints or a spiral.

use shared::{
    device::GpsFix,
    mission::{Course, MAX_HEADINGS, MAX_RADIUS_MM, MAX_WAYPOINTS, Mooring, Route},
};

use super::{M_PER_DEG, Start, scaled, whole};
use crate::files::toml_file::{Rule, Section};

/// Distance at which a waypoint counts as reached where the file does not say, m.
const CAPTURE_RADIUS_M: f64 = 200.0;
/// Radius of a mooring where the file does not say, m.
const MOORING_RADIUS_M: f64 = 500.0;
/// Radii that a file may name, m; least as in [`shared::mission::Mission::check`].
const RADIUS: Rule = Rule::Within(10.0, MAX_RADIUS_MM as f64 / 1e3);
/// Fastest turn that the mission's integers hold, deg/s.
const TURN_RATE_DEG_S: f64 = 300.0;

/// Reads the one of the three that is there.
pub(super) fn read(mission: &mut Section<'_>, start: &Start) -> Course {
    let headings_deg = mission.optional_list("headings_deg", HEADING, MAX_HEADINGS);
    let route = mission.optional_section("waypoints", |waypoints| route(waypoints, start));
    let mooring = mission.optional_section("spiral", |spiral| mooring(spiral, start));
    mission.refuse_if(headings_deg.is_some() && route.is_some(), "headings_deg", "left out beside `waypoints`");
    mission.refuse_if(headings_deg.is_some() && mooring.is_some(), "headings_deg", "left out beside `spiral`");
    mission.refuse_if(route.is_some() && mooring.is_some(), "spiral", "left out beside `waypoints`");
    match (route, mooring) {
        (Some(route), _) => Course::Waypoints(route),
        (None, Some(mooring)) => Course::Spiral(mooring),
        (None, None) => {
            let headings_deg = headings_deg.unwrap_or_else(|| mission.list("headings_deg", HEADING, MAX_HEADINGS));
            let wrapped = |heading: &f64| scaled::<u16>(heading.rem_euclid(360.0), 1e2) % 36_000;
            Course::Headings(headings_deg.iter().map(wrapped).collect())
        }
    }
}

const HEADING: Rule = Rule::Within(-360.0, 360.0);

fn route(waypoints: &mut Section<'_>, start: &Start) -> Route {
    let degrees = waypoints.optional_pairs("places_deg");
    let metres = waypoints.optional_pairs("places_m");
    waypoints.refuse_if(degrees.is_some() && metres.is_some(), "places_m", "left out beside `places_deg`");
    let (key, places) = match (degrees, metres) {
        (Some(degrees), _) => ("places_deg", degrees),
        (None, Some(metres)) => ("places_m", metres.into_iter().map(|place| from_start_deg(start, place)).collect()),
        (None, None) => ("places_deg", waypoints.pairs("places_deg")),
    };
    let right = format!("1 to {MAX_WAYPOINTS} rows of [north, east] on the Earth");
    let fits = (1..=MAX_WAYPOINTS).contains(&places.len()) && places.iter().all(is_on_earth);
    waypoints.refuse_if(!fits, key, &right);
    Route {
        places: places.iter().take(MAX_WAYPOINTS).map(fix).collect(),
        capture_radius_mm: scaled(waypoints.number_or("capture_radius_m", RADIUS, CAPTURE_RADIUS_M), 1e3),
        leg_time_s: whole(waypoints.integer_or("leg_time_s", 0..=i64::from(u32::MAX), 0)),
    }
}

fn mooring(spiral: &mut Section<'_>, start: &Start) -> Mooring {
    let turn_rate_deg_s = spiral.number("turn_rate_deg_s", Rule::Within(-TURN_RATE_DEG_S, TURN_RATE_DEG_S));
    let degrees = spiral.optional_numbers("station_deg", Rule::Finite);
    let metres = spiral.optional_numbers("station_m", Rule::Finite);
    spiral.refuse_if(degrees.is_some() && metres.is_some(), "station_m", "left out beside `station_deg`");
    let key = if degrees.is_some() { "station_deg" } else { "station_m" };
    let station_deg = degrees.unwrap_or_else(|| from_start_deg(start, metres.unwrap_or_default()));
    spiral.refuse_if(!is_on_earth(&station_deg), key, "[north, east] on the Earth");
    Mooring {
        turn_rate_cdeg_s: scaled(turn_rate_deg_s, 1e2),
        station: fix(&station_deg),
        radius_mm: scaled(spiral.number_or("radius_m", RADIUS, MOORING_RADIUS_M), 1e3),
    }
}

/// Latitude and longitude, deg, of a place so many metres north and east of the start.
fn from_start_deg(start: &Start, [north_m, east_m]: [f64; 2]) -> [f64; 2] {
    let parallel_m = M_PER_DEG * start.latitude_deg.to_radians().cos();
    let longitude_deg = start.longitude_deg + east_m / parallel_m;
    [start.latitude_deg + north_m / M_PER_DEG, (longitude_deg + 180.0).rem_euclid(360.0) - 180.0]
}

fn is_on_earth([latitude_deg, longitude_deg]: &[f64; 2]) -> bool {
    latitude_deg.abs() <= 90.0 && longitude_deg.abs() <= 180.0
}

fn fix([latitude_deg, longitude_deg]: &[f64; 2]) -> GpsFix {
    GpsFix { lat_e7: scaled(*latitude_deg, 1e7), lon_e7: scaled(*longitude_deg, 1e7) }
}
