//! The design file: what is given, what may vary, what must be kept, what is wanted.

use crate::files::toml_file::{self, FileError, Rule, Section};
use crate::model::coefficients::{Anchoring, Parameter};

/// Designs that need no file: name, file it comes from, text.
const EMBEDDED: &[(&str, &str, &str)] =
    &[("default", "designs/default.toml", include_str!("../../../designs/default.toml"))];
/// Longest path to a vehicle, characters.
const PATH_CHARS: usize = 4096;
/// Longest name of a vehicle, characters.
const NAME_CHARS: usize = 32;

/// What is wanted most.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Objective {
    /// Ideal range of the battery.
    Range,
    /// Lift to drag at the flattest glide.
    LiftToDrag,
    /// Speed at the flattest glide.
    Speed,
    /// Fastest right turn at that glide.
    TurnRate,
}

/// What drives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Drive {
    /// η, as a fraction of the neutral displacement.
    LungCapacity(f64),
    /// m̃, kg.
    NetMass(f64),
    /// V at the flattest glide, m/s; the lung follows.
    Speed(f64),
}

/// What must be kept; nothing where it is not asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limits {
    /// m/s.
    pub least_speed_m_s: Option<f64>,
    /// m.
    pub least_range_m: Option<f64>,
    /// Of all modes, 1/s.
    pub largest_real_part_per_s: Option<f64>,
    /// Of the modes that oscillate.
    pub least_damping_ratio: Option<f64>,
    /// deg.
    pub largest_angle_of_attack_deg: Option<f64>,
    /// deg/s.
    pub least_turn_rate_deg_s: Option<f64>,
}

/// A design file.
#[derive(Clone, Debug, PartialEq)]
pub struct Spec {
    /// Name of the vehicle that is found.
    pub name: String,
    /// Name or path of the vehicle that it starts from.
    pub vehicle: String,
    /// What is wanted most.
    pub objective: Objective,
    /// Where coefficients come from.
    pub anchoring: Anchoring,
    /// Mass of the water that the hull displaces at its largest, kg.
    pub displaced_mass_kg: f64,
    /// What drives it.
    pub drive: Drive,
    /// Depth of a dive, m.
    pub depth_m: f64,
    /// J.
    pub battery_j: f64,
    /// What may vary, and within which bounds.
    pub bounds: Vec<(Parameter, [f64; 2])>,
    /// What must be kept.
    pub limits: Limits,
    /// Points of the front; 0 for none.
    pub front_points: usize,
}

impl Spec {
    /// Reads a design from the text of its file; `source_name` stands in the errors.
    ///
    /// # Errors
    /// The first mistake, with its place and what would be right.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, FileError> {
        toml_file::read(text, source_name, read)
    }

    /// Reads an embedded design by its name, or else a file by its path.
    ///
    /// # Errors
    /// As [`Spec::from_toml`], or one line that lists the embedded names.
    pub fn load(name_or_path: &str) -> Result<Self, FileError> {
        let (text, file) = toml_file::load(name_or_path, EMBEDDED)?;
        Self::from_toml(&text, &file)
    }
}

fn read(file: &mut Section<'_>) -> Spec {
    let objectives = [
        ("range", Objective::Range),
        ("lift_to_drag", Objective::LiftToDrag),
        ("speed", Objective::Speed),
        ("turn_rate", Objective::TurnRate),
    ];
    let coefficients = [("geometry", Anchoring::Unanchored), ("anchored", Anchoring::Anchored)];
    let objective = file.choice_or_first("objective", &objectives).unwrap_or(Objective::Range);
    let (displaced_mass_kg, drive, depth_m, battery_j) = file.section("given", |given| {
        let displaced_mass_kg = given.number("displaced_mass_kg", Rule::Positive);
        let least = f64::MIN_POSITIVE;
        let drive = drive(given, displaced_mass_kg.max(least), objective);
        (displaced_mass_kg, drive, given.number("depth_m", Rule::Positive), given.number("battery_j", Rule::Positive))
    });
    let bounds: Vec<_> = file.section("bounds", bounds);
    file.refuse_if(bounds.is_empty(), "bounds", "a range for at least one parameter");
    Spec {
        name: file.text("name", NAME_CHARS),
        vehicle: file.text("vehicle", PATH_CHARS),
        objective,
        anchoring: file.choice_or_first("coefficients", &coefficients).unwrap_or(Anchoring::Unanchored),
        displaced_mass_kg,
        drive,
        depth_m,
        battery_j,
        bounds,
        limits: file.optional_section("limits", limits).unwrap_or_default(),
        front_points: file
            .optional_section("front", |front| usize::try_from(front.integer("points", 2..=50)).unwrap_or(0))
            .unwrap_or(0),
    }
}

/// One of the three.
fn drive(given: &mut Section<'_>, displaced_mass_kg: f64, objective: Objective) -> Drive {
    let lung = given.optional_number("lung_capacity", Rule::Within(1e-6, 1.0)).map(Drive::LungCapacity);
    let net_mass =
        given.optional_number("net_mass_kg", Rule::Within(1e-6, 0.5 * displaced_mass_kg)).map(Drive::NetMass);
    let speed = given.optional_number("speed_m_s", Rule::Positive).map(Drive::Speed);
    given.refuse_if(
        speed.is_some() && objective == Objective::Speed,
        "speed_m_s",
        "left out where speed is the objective",
    );
    let all: Vec<Drive> = [lung, net_mass, speed].into_iter().flatten().collect();
    match all[..] {
        [drive] => drive,
        [] => Drive::LungCapacity(given.number("lung_capacity", Rule::Within(1e-6, 1.0))),
        [drive, ..] => {
            let second = if lung.is_some() && net_mass.is_some() { "net_mass_kg" } else { "speed_m_s" };
            given.refuse_if(true, second, "left out: one of lung_capacity, net_mass_kg and speed_m_s gives the others");
            drive
        }
    }
}

fn bounds(bounds: &mut Section<'_>) -> Vec<(Parameter, [f64; 2])> {
    ["hull", "wing", "fin"]
        .into_iter()
        .flat_map(|part| bounds.optional_section(part, |section| of_part(part, section)).unwrap_or_default())
        .collect()
}

fn of_part(part: &str, section: &mut Section<'_>) -> Vec<(Parameter, [f64; 2])> {
    let keys = Parameter::ALL.into_iter().filter_map(|parameter| Some((parameter, parameter.key().split_once('.')?)));
    keys.filter(|(_, (of, _))| *of == part)
        .filter_map(|(parameter, (_, key))| {
            let range = section.optional_range(key)?;
            let rule = parameter.rule();
            let possible = range.iter().all(|value| value.is_nan() || rule.holds(*value));
            section.refuse_if(!possible, key, &format!("[min, max], each {rule}"));
            Some((parameter, range))
        })
        .collect()
}

fn limits(limits: &mut Section<'_>) -> Limits {
    Limits {
        least_speed_m_s: limits.optional_number("least_speed_m_s", Rule::Positive),
        least_range_m: limits.optional_number("least_range_m", Rule::Positive),
        largest_real_part_per_s: limits.optional_number("largest_real_part_per_s", Rule::Finite),
        least_damping_ratio: limits.optional_number("least_damping_ratio", Rule::Within(-1.0, 1.0)),
        largest_angle_of_attack_deg: limits.optional_number("largest_angle_of_attack_deg", Rule::Positive),
        least_turn_rate_deg_s: limits.optional_number("least_turn_rate_deg_s", Rule::Positive),
    }
}
