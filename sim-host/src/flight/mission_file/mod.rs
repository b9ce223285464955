//! The mission file: TOML, human units in the names.
//!
//! `[mission]`, depths in m, times in s, angles in deg, masses in kg; what has a default may be left out:
//!
//! | key | meaning | default |
//! |---|---|---|
//! | `yos`, `surfacings` | dive-and-climb cycles before surfacing, and how often the glider surfaces | `surfacings` 1 |
//! | `dive_to_m`, `climb_to_m`, `abort_depth_m` | where dives and climbs turn, and where the mission is aborted | |
//! | `dive_path_angle_deg` or `dive_pitch_deg`, and for the climbs | the angle of the glides, positive up | |
//! | `dive_net_mass_kg` or `dive_vertical_speed_m_s`, and for the climbs | the drive of the glides, positive down | |
//! | `headings_deg` | heading of each dive and each climb, on over the surfacings; the last one holds on | |
//! | `[mission.waypoints]` | `places_deg = [[north, east], …]`, or `places_m` from the start; `capture_radius_m` | 200 |
//! | | `leg_time_s` after which a waypoint is given up for the next one | 0: never |
//! | `[mission.spiral]` | `turn_rate_deg_s`, right positive; `station_deg` or `station_m` from the start | the start |
//! | | `radius_m` about the station, outside which a half-yo glides back towards it | 500 |
//! | `drift_time_s` | time to drift at `dive_to_m` before each climb | 0: none |
//! | `flare_depth_m` | above it the way to the surface is flown nearly level | 0: no flare |
//! | `surface_time_s`, `max_duration_s` | shortest stay at the surface before a dive, longest mission | |
//! | `altitude_m` | height above the sea floor at which a dive turns | 0: none |
//!
//! Exactly one of `headings_deg`, `[mission.waypoints]` and `[mission.spiral]` says where to go. Pitch and vertical speed
//! become path angle and net mass through the vehicle's trim table ([`MissionFile::resolve`]).

mod course;
mod energy;
mod glide;

use serde::{Deserialize, de::value::MapDeserializer};
use shared::{
    mission::{MAX_ALTITUDE_MM, Mission},
    parameters::{Parameters, ROWS},
};

use crate::files::toml_file::{self, FileError, Rule, Section};
use glide::Asked;

/// Missions that need no file: name, file it comes from, text.
const EMBEDDED: &[(&str, &str, &str)] = &[
    ("default", "missions/default.toml", include_str!("../../../missions/default.toml")),
    ("fast-50", "missions/fast-50.toml", include_str!("../../../missions/fast-50.toml")),
    ("slow-50", "missions/slow-50.toml", include_str!("../../../missions/slow-50.toml")),
    ("slow-200", "missions/slow-200.toml", include_str!("../../../missions/slow-200.toml")),
    ("slow-1000", "missions/slow-1000.toml", include_str!("../../../missions/slow-1000.toml")),
    ("legs", "missions/legs.toml", include_str!("../../../missions/legs.toml")),
    ("zigzag", "missions/zigzag.toml", include_str!("../../../missions/zigzag.toml")),
    ("waypoints", "missions/waypoints.toml", include_str!("../../../missions/waypoints.toml")),
    ("mooring", "missions/mooring.toml", include_str!("../../../missions/mooring.toml")),
    ("drift", "missions/drift.toml", include_str!("../../../missions/drift.toml")),
];

/// Metres per degree of latitude, on the sphere of 6371 km that the controller uses.
pub const M_PER_DEG: f64 = 111_194.93;

/// Longest path to a vehicle, characters.
const PATH_CHARS: usize = 4096;
/// Deepest depth a file may name, m.
const DEEPEST_M: f64 = 12_000.0;
/// Greatest height above the floor that a mission may ask for, m.
const MAX_ALTITUDE_M: f64 = MAX_ALTITUDE_MM as f64 / 1e3;

/// A mission, where it starts, who flies it and how the controller is tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct MissionFile {
    /// Name or path of the vehicle.
    pub vehicle: String,
    /// Where and how it starts.
    pub start: Start,
    /// What to fly; path angles and net masses are zero where the file names pitch or vertical speed, until
    /// [`Self::resolve`].
    pub mission: Mission,
    /// Tuning of the controller; defaults where the file says nothing.
    pub parameters: Parameters,
    /// What it asks of dives and climbs.
    glides: [Asked; 2],
    /// Its name in errors.
    file: String,
    text: String,
}

/// Position and heading before the first dive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Start {
    /// Latitude, deg, north positive.
    pub latitude_deg: f64,
    /// Longitude, deg, east positive.
    pub longitude_deg: f64,
    /// Heading, deg clockwise from true north, 0 to below 360.
    pub heading_deg: f64,
}

impl MissionFile {
    /// Reads a mission from the text of its file; `source_name` stands in the errors.
    ///
    /// # Errors
    /// The first mistake, with its place and what would be right.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, FileError> {
        let file = toml_file::read(text, source_name, read)?;
        Ok(Self { file: source_name.into(), text: text.into(), ..file })
    }

    /// The JSON Schema of mission files: with it an editor completes and checks them.
    #[must_use]
    pub fn schema() -> serde_json::Value {
        let mut schema = toml_file::schema("a glider's mission", read);
        for row in ROWS {
            schema["properties"]["parameters"]["properties"][row.name]["description"] = row.about.trim().into();
        }
        schema
    }

    /// Reads an embedded mission by its name, or else a file by its path.
    ///
    /// # Errors
    /// As [`MissionFile::from_toml`], or one line that lists the embedded names.
    pub fn load(name_or_path: &str) -> Result<Self, FileError> {
        let (text, file) = toml_file::load(name_or_path, EMBEDDED)?;
        Self::from_toml(&text, &file)
    }
}

impl MissionFile {
    /// What is wrong with the value of a dotted key, now that the vehicle is known.
    #[must_use]
    pub fn mistake(&self, dotted_key: &str, message: String) -> FileError {
        FileError { file: self.file.clone(), place: toml_file::place_of(&self.text, dotted_key), message }
    }
}

fn read(file: &mut Section<'_>) -> MissionFile {
    let vehicle = file.text("vehicle", PATH_CHARS);
    let start = file.section("start", start);
    let (mission, glides) = file.section("mission", |section| mission(section, &start));
    MissionFile {
        vehicle,
        start,
        mission,
        parameters: file.optional_section("parameters", parameters).unwrap_or_default(),
        glides,
        file: String::new(),
        text: String::new(),
    }
}

fn start(start: &mut Section<'_>) -> Start {
    Start {
        latitude_deg: start.number("latitude_deg", Rule::Within(-90.0, 90.0)),
        longitude_deg: start.number("longitude_deg", Rule::Within(-180.0, 180.0)),
        heading_deg: start.number("heading_deg", Rule::Within(-360.0, 360.0)).rem_euclid(360.0),
    }
}

fn mission(mission: &mut Section<'_>, start: &Start) -> (Mission, [Asked; 2]) {
    let dive_to_m = mission.number("dive_to_m", Rule::Within(1.0, DEEPEST_M));
    let climb_to_m = mission.number("climb_to_m", Rule::Within(0.0, DEEPEST_M));
    let abort_depth_m = mission.number("abort_depth_m", Rule::Within(1.0, DEEPEST_M));
    let flare_depth_m = mission.number_or("flare_depth_m", Rule::Within(0.0, DEEPEST_M), 0.0);
    mission.refuse_if(climb_to_m >= dive_to_m, "climb_to_m", "less than `dive_to_m`");
    mission.refuse_if(abort_depth_m <= dive_to_m, "abort_depth_m", "more than `dive_to_m`");
    mission.refuse_if(flare_depth_m > climb_to_m, "flare_depth_m", "no more than `climb_to_m`");
    let [dive, climb] = [glide::dive(mission), glide::climb(mission)];
    let read = Mission {
        yos: whole(mission.integer("yos", 1..=i64::from(u16::MAX))),
        surfacings: whole(mission.integer_or("surfacings", 1..=i64::from(u16::MAX), 1)),
        dive_to_mm: scaled(dive_to_m, 1e3),
        climb_to_mm: scaled(climb_to_m, 1e3),
        dive_path_angle_cdeg: dive.path_angle_cdeg(),
        climb_path_angle_cdeg: climb.path_angle_cdeg(),
        dive_net_mass_g: dive.net_mass_g(),
        climb_net_mass_g: climb.net_mass_g(),
        course: course::read(mission, start),
        drift_time_s: whole(mission.integer_or("drift_time_s", 0..=i64::from(u32::MAX), 0)),
        flare_depth_mm: scaled(flare_depth_m, 1e3),
        surface_time_s: whole(mission.integer("surface_time_s", 0..=i64::from(u16::MAX))),
        altitude_mm: scaled(mission.number_or("altitude_m", Rule::Within(0.0, MAX_ALTITUDE_M), 0.0), 1e3),
        abort_depth_mm: scaled(abort_depth_m, 1e3),
        max_duration_s: whole(mission.integer("max_duration_s", 1..=i64::from(u32::MAX))),
    };
    (read, [dive, climb])
}

fn parameters(section: &mut Section<'_>) -> Parameters {
    let values: Vec<_> = ROWS
        .iter()
        .map(|row| {
            let value = section.integer_or(row.name, row.min.into()..=row.max.into(), row.default.into());
            (row.name, whole::<i32>(value))
        })
        .collect();
    let read: Result<_, serde::de::value::Error> = Parameters::deserialize(MapDeserializer::new(values.into_iter()));
    read.unwrap_or_default()
}

/// A number of the file as the nearest integer of `scale` to the unit; bounds were checked before.
fn scaled<T: TryFrom<i64> + Default>(value: f64, scale: f64) -> T {
    whole((value * scale).round() as i64)
}

fn whole<T: TryFrom<i64> + Default>(value: i64) -> T {
    T::try_from(value).unwrap_or_default()
}
