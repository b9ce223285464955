//! The mission file: TOML, human units in the names.

use serde::{Deserialize, de::value::MapDeserializer};
use shared::{
    mission::{MAX_ALTITUDE_MM, MAX_HEADINGS, Mission},
    parameters::{Parameters, ROWS},
};

use crate::toml_file::{self, FileError, Rule, Section};

/// Missions that need no file: name, file it comes from, text.
const EMBEDDED: &[(&str, &str, &str)] = &[
    ("default", "missions/default.toml", include_str!("../missions/default.toml")),
    ("fast-50", "missions/fast-50.toml", include_str!("../missions/fast-50.toml")),
    ("slow-50", "missions/slow-50.toml", include_str!("../missions/slow-50.toml")),
    ("slow-200", "missions/slow-200.toml", include_str!("../missions/slow-200.toml")),
    ("slow-1000", "missions/slow-1000.toml", include_str!("../missions/slow-1000.toml")),
];

/// Metres per degree of latitude, on the sphere of 6371 km that the controller uses.
pub const M_PER_DEG: f64 = 111_194.93;

/// Longest path to a vehicle, characters.
const PATH_CHARS: usize = 4096;
/// Deepest depth a file may name, m.
const DEEPEST_M: f64 = 12_000.0;
/// Greatest height above the floor that a mission may ask for, m.
const MAX_ALTITUDE_M: f64 = MAX_ALTITUDE_MM as f64 / 1e3;
/// Largest net mass that the mission's integers hold, kg.
const NET_MASS_KG: f64 = 32.0;

/// A mission, where it starts, who flies it and how the controller is tuned.
#[derive(Clone, Debug, PartialEq)]
pub struct MissionFile {
    /// Name or path of the vehicle.
    pub vehicle: String,
    /// Where and how it starts.
    pub start: Start,
    /// What to fly.
    pub mission: Mission,
    /// Tuning of the controller; defaults where the file says nothing.
    pub parameters: Parameters,
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
    MissionFile {
        vehicle: file.text("vehicle", PATH_CHARS),
        start: file.section("start", start),
        mission: file.section("mission", mission),
        parameters: file.optional_section("parameters", parameters).unwrap_or_default(),
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

fn mission(mission: &mut Section<'_>) -> Mission {
    let dive_to_m = mission.number("dive_to_m", Rule::Within(1.0, DEEPEST_M));
    let climb_to_m = mission.number("climb_to_m", Rule::Within(0.0, DEEPEST_M));
    let abort_depth_m = mission.number("abort_depth_m", Rule::Within(1.0, DEEPEST_M));
    mission.refuse_if(climb_to_m >= dive_to_m, "climb_to_m", "less than `dive_to_m`");
    mission.refuse_if(abort_depth_m <= dive_to_m, "abort_depth_m", "more than `dive_to_m`");
    let headings_deg = mission.list("headings_deg", Rule::Within(-360.0, 360.0), MAX_HEADINGS);
    Mission {
        yos: whole(mission.integer("yos", 1..=i64::from(u16::MAX))),
        dive_to_mm: scaled(dive_to_m, 1e3),
        climb_to_mm: scaled(climb_to_m, 1e3),
        dive_path_angle_cdeg: scaled(mission.number("dive_path_angle_deg", Rule::Within(-90.0, 0.0)), 1e2),
        climb_path_angle_cdeg: scaled(mission.number("climb_path_angle_deg", Rule::Within(0.0, 90.0)), 1e2),
        dive_net_mass_g: scaled(mission.number("dive_net_mass_kg", Rule::Within(0.0, NET_MASS_KG)), 1e3),
        climb_net_mass_g: scaled(mission.number("climb_net_mass_kg", Rule::Within(-NET_MASS_KG, 0.0)), 1e3),
        headings_cdeg: headings_deg
            .iter()
            .map(|heading| scaled::<u16>(heading.rem_euclid(360.0), 1e2) % 36_000)
            .collect(),
        surface_time_s: whole(mission.integer("surface_time_s", 0..=i64::from(u16::MAX))),
        altitude_mm: scaled(mission.number_or("altitude_m", Rule::Within(0.0, MAX_ALTITUDE_M), 0.0), 1e3),
        abort_depth_mm: scaled(abort_depth_m, 1e3),
        max_duration_s: whole(mission.integer("max_duration_s", 1..=i64::from(u32::MAX))),
    }
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
