//! The environment file: TOML, or a CTD cast alone.

use std::{fs, path::Path};

use super::{
    Ocean,
    cast::{self, DEPTH_M, SALINITY, TEMPERATURE_C},
    column::{Column, Level},
    current::Current,
    floor::Floor,
    internal_wave::InternalWave,
    swell::Swell,
    teos10::Composition,
};
use crate::files::toml_file::{self, FileError, Rule, Section};
use crate::model::vehicle::Water;

/// Environments that need no file: name, file it comes from, text.
pub const EMBEDDED: &[(&str, &str, &str)] = &[
    ("still", "environments/still.toml", include_str!("../../../environments/still.toml")),
    ("calm", "environments/calm.toml", include_str!("../../../environments/calm.toml")),
    ("tropical", "environments/tropical.toml", include_str!("../../../environments/tropical.toml")),
    ("temperate", "environments/temperate.toml", include_str!("../../../environments/temperate.toml")),
    ("polar", "environments/polar.toml", include_str!("../../../environments/polar.toml")),
    ("baltic", "environments/baltic.toml", include_str!("../../../environments/baltic.toml")),
];

/// Longest path to a cast, characters.
const PATH_CHARS: usize = 4096;
/// Fastest current, m/s: the strongest tidal streams reach 8.
const CURRENT_M_S: Rule = Rule::Within(-10.0, 10.0);
const DIRECTION_DEG: Rule = Rule::Within(-360.0, 360.0);

/// What a file says of the water.
struct Described {
    composition: Composition,
    profile: Vec<Level>,
    cast: Option<String>,
    ballast_density_kg_m3: Option<f64>,
}

impl Ocean {
    /// Still water of the vehicle's own density: the water of the static analyses.
    #[must_use]
    pub fn still(water: &Water) -> Self {
        Self {
            column: Column::uniform(water.density_kg_m3, water.gravity_m_s2),
            current: None,
            internal_wave: None,
            swell: None,
            floor: None,
            ballast_density_kg_m3: None,
        }
    }

    /// Reads an embedded environment by its name, or else a file by its path: TOML, or a CTD cast that ends in `.csv`.
    ///
    /// `water` gives gravity, and the density where the file gives none.
    ///
    /// # Errors
    /// The first mistake, with its place and what would be right, or one line that lists the embedded names.
    pub fn load(name_or_path: &str, water: &Water) -> Result<Self, FileError> {
        let (text, file) = toml_file::load(name_or_path, EMBEDDED)?;
        if Path::new(&file).extension().is_some_and(|extension| extension.eq_ignore_ascii_case("csv")) {
            let standard = Composition::Standard;
            let levels = cast::read(&text, &file, standard, water.gravity_m_s2)?;
            return Ok(Self { column: tabulated(&levels, standard, water, &file)?, ..Self::still(water) });
        }
        Self::from_toml(&text, &file, water)
    }

    /// Reads an environment from the text of its file; `source_name` stands in the errors, and casts are sought beside it.
    ///
    /// # Errors
    /// As [`Ocean::load`].
    pub fn from_toml(text: &str, source_name: &str, water: &Water) -> Result<Self, FileError> {
        let (described, mut ocean) = toml_file::read(text, source_name, |file| environment(file, water))?;
        let Some(described) = described else { return Ok(ocean) };
        let levels = match &described.cast {
            None => described.profile,
            Some(cast) => {
                let path = Path::new(source_name).with_file_name(cast);
                let name = path.display().to_string();
                let text = fs::read_to_string(&path).map_err(|error| FileError {
                    file: source_name.into(),
                    place: None,
                    message: format!("`water.cast`: {name}: {error}"),
                })?;
                cast::read(&text, &name, described.composition, water.gravity_m_s2)?
            }
        };
        ocean.column = tabulated(&levels, described.composition, water, source_name)?;
        ocean.ballast_density_kg_m3 = described.ballast_density_kg_m3;
        Ok(ocean)
    }
}

fn tabulated(levels: &[Level], composition: Composition, water: &Water, file: &str) -> Result<Column, FileError> {
    Column::tabulated(levels, composition, water.gravity_m_s2).map_err(|error| FileError {
        file: file.into(),
        place: None,
        message: format!("the equation of state refuses the profile: {error:?}"),
    })
}

/// Everything but the column, which may need another file.
fn environment(file: &mut Section<'_>, water: &Water) -> (Option<Described>, Ocean) {
    let described = file.optional_section("water", described);
    let current = file.optional_section("current", current);
    let wave = file.optional_section("internal_wave", internal_wave);
    let swell = file.optional_section("swell", |section| swell(section, water.gravity_m_s2));
    let (floor_m, floor) = match &wave {
        Some(_) => {
            let missing = "missing section `floor`: an internal wave fills the water from the surface to it";
            Some(file.section_or_else("floor", missing.into(), floor))
        }
        None => file.optional_section("floor", floor),
    }
    .unzip();
    if let (Some(swell), Some(depth_m)) = (&swell, floor_m) {
        let deep = format!("deep for the swell: at least half its wavelength, {:.0} m", 0.5 * swell.wavelength_m());
        file.refuse_if(2.0 * depth_m < swell.wavelength_m(), "floor", &deep);
    }
    let internal_wave = wave
        .zip(floor_m)
        .map(|([w, period, length, towards], depth)| InternalWave::new(w, period, length, towards, depth));
    (described, Ocean { current, internal_wave, swell, floor, ..Ocean::still(water) })
}

fn described(water: &mut Section<'_>) -> Described {
    let words = [("standard", Composition::Standard), ("baltic", Composition::Baltic)];
    let composition = water.choice_or_first("composition", &words).unwrap_or(Composition::Standard);
    let cast = water.optional_text("cast", PATH_CHARS);
    let rows = if cast.is_some() { Vec::new() } else { water.triples("profile") };
    let possible = rows.iter().all(|[depth_m, temperature_c, salinity]| {
        DEPTH_M.holds(*depth_m) && TEMPERATURE_C.holds(*temperature_c) && SALINITY.holds(*salinity)
    });
    let right = "rows of [depth in m, rising; temperature in °C, -3 to 40; practical salinity, 0 to 42]";
    water.refuse_if(cast.is_none() && !(possible && is_profile(&rows)), "profile", right);
    Described {
        composition,
        profile: rows
            .into_iter()
            .map(|[depth_m, temperature_c, salinity]| Level { depth_m, temperature_c, salinity })
            .collect(),
        cast,
        ballast_density_kg_m3: water.optional_number("ballast_density_kg_m3", Rule::Positive),
    }
}

fn current(current: &mut Section<'_>) -> Current {
    let rows = current.triples("profile");
    let possible = rows.iter().all(|[_, north, east]| CURRENT_M_S.holds(*north) && CURRENT_M_S.holds(*east));
    let right = "rows of [depth in m, rising; m/s north, -10 to 10; m/s east, -10 to 10]";
    current.refuse_if(!(possible && is_profile(&rows)), "profile", right);
    Current::new(rows)
}

fn internal_wave(wave: &mut Section<'_>) -> [f64; 4] {
    [
        wave.number("vertical_velocity_m_s", Rule::Within(0.0, 1.0)),
        wave.number("period_s", Rule::Positive),
        wave.number("wavelength_m", Rule::Positive),
        wave.number("direction_deg", DIRECTION_DEG),
    ]
}

fn swell(swell: &mut Section<'_>, gravity_m_s2: f64) -> Swell {
    let (height_m, period_s) = (swell.number("height_m", Rule::NotNegative), swell.number("period_s", Rule::Positive));
    let read = Swell::new(height_m, period_s, swell.number("direction_deg", DIRECTION_DEG), gravity_m_s2);
    // Stokes' limit in deep water.
    let breaks =
        format!("less than a seventh of the wavelength of {:.1} m, beyond which waves break", read.wavelength_m());
    swell.refuse_if(7.0 * height_m >= read.wavelength_m(), "height_m", &breaks);
    read
}

/// Depth at the start, and the floor.
fn floor(floor: &mut Section<'_>) -> (f64, Floor) {
    let depth_m = floor.number("depth_m", Rule::Positive);
    let slope_deg = floor.number_or("slope_deg", Rule::Within(0.0, 60.0), 0.0);
    let direction_deg = floor.number_or("direction_deg", DIRECTION_DEG, 0.0);
    (depth_m, Floor::new(depth_m, slope_deg, direction_deg))
}

fn is_profile(rows: &[[f64; 3]]) -> bool {
    !rows.is_empty() && rows.is_sorted_by(|[above, ..], [below, ..]| above < below)
}
