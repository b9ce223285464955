//! A CTD cast as CSV: one line of column names, then one line per level, downwards.
//!
//! Needed are `pressure_dbar` (sea pressure) or `depth_m`, `temperature_c` (in situ, ITS-90) and `salinity` (practical); the
//! names `PRES`, `DEPTH`, `TEMP`, `PSAL` mean the same. Other columns are left alone.

use super::{
    column::Level,
    teos10::{self, Composition},
};
use crate::toml_file::{FileError, Rule};

/// Temperatures of seawater, °C.
pub(super) const TEMPERATURE_C: Rule = Rule::Within(-3.0, 40.0);
/// Practical salinities for which the equation of state is made.
pub(super) const SALINITY: Rule = Rule::Within(0.0, 42.0);
/// Deepest level, m; the deepest trench is shallower.
pub(super) const DEPTH_M: Rule = Rule::Within(0.0, 12_000.0);
/// The same as pressure, dbar.
const PRESSURE_DBAR: Rule = Rule::Within(0.0, 12_000.0);
/// Pascals per decibar.
const PA_PER_DBAR: f64 = 1e4;

/// Where a column stands and what it may hold.
#[derive(Clone, Copy)]
struct Field {
    index: usize,
    rule: Rule,
}

/// Reads a cast; `file` stands in the errors.
pub(super) fn read(
    text: &str,
    file: &str,
    composition: Composition,
    gravity_m_s2: f64,
) -> Result<Vec<Level>, FileError> {
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).flexible(true).from_reader(text.as_bytes());
    let fail = |line: u64, column: usize, message: String| FileError {
        file: file.into(),
        place: Some((line as usize, column + 1)),
        message,
    };
    let header = reader.headers().map_err(|error| fail(1, 0, error.to_string()))?.clone();
    let find = |names: [&str; 2], rule: Rule| {
        let index = header.iter().position(|name| names.iter().any(|known| known.eq_ignore_ascii_case(name)))?;
        Some(Field { index, rule })
    };
    let missing = |name: &str| fail(1, 0, format!("no column `{name}` in this cast"));
    let pressure = find(["pressure_dbar", "PRES"], PRESSURE_DBAR);
    let down = pressure.or_else(|| find(["depth_m", "DEPTH"], DEPTH_M));
    let down = down.ok_or_else(|| missing("pressure_dbar` or `depth_m"))?;
    let temperature = find(["temperature_c", "TEMP"], TEMPERATURE_C).ok_or_else(|| missing("temperature_c"))?;
    let salinity = find(["salinity", "PSAL"], SALINITY).ok_or_else(|| missing("salinity"))?;

    let mut levels: Vec<Level> = Vec::new();
    let mut deepest = f64::NEG_INFINITY;
    for record in reader.records() {
        let record = record.map_err(|error| fail(0, 0, error.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let value = |field: Field| {
            let written = record.get(field.index).unwrap_or_default();
            let read = written.parse::<f64>().ok().filter(|value| field.rule.holds(*value));
            let name = header.get(field.index).unwrap_or_default();
            read.ok_or_else(|| fail(line, field.index, format!("`{name}` is `{written}`, but must be {}", field.rule)))
        };
        let level = Level { depth_m: value(down)?, temperature_c: value(temperature)?, salinity: value(salinity)? };
        if level.depth_m <= deepest {
            let message = format!("{} does not go down from the line above, {deepest}", level.depth_m);
            return Err(fail(line, down.index, message));
        }
        deepest = level.depth_m;
        levels.push(level);
    }
    if levels.is_empty() {
        return Err(fail(2, 0, "no levels in this cast".into()));
    }
    if pressure.is_some() {
        to_depths(&mut levels, composition, gravity_m_s2).map_err(|error| fail(2, 0, format!("{error:?}")))?;
    }
    Ok(levels)
}

/// Turns pressures in dbar, standing in the place of depths, into depths: dz = dp/(ρ g) from the surface down.
fn to_depths(levels: &mut [Level], composition: Composition, gravity_m_s2: f64) -> Result<(), gsw::Error> {
    let mut above: Option<(f64, f64, f64)> = None;
    for level in levels {
        let pressure_pa = level.depth_m * PA_PER_DBAR;
        let density = teos10::density_kg_m3(level.salinity, level.temperature_c, pressure_pa, composition)?;
        let (pressure_above_pa, depth_above_m, density_above) = above.unwrap_or((0.0, 0.0, density));
        let mean = 0.5 * (density + density_above);
        level.depth_m = depth_above_m + (pressure_pa - pressure_above_pa) / (mean * gravity_m_s2);
        above = Some((pressure_pa, level.depth_m, density));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Vec<Level>, String> {
        read(text, "cast.csv", Composition::Standard, 9.81).map_err(|error| error.to_string())
    }

    #[test]
    fn columns_are_found_by_their_names() {
        let by_depth = parse("station,salinity, depth_m ,temperature_c\nA,35.0,0,17.5\nA,35.1,20,12\n").unwrap();
        assert_eq!(by_depth[1], Level { depth_m: 20.0, temperature_c: 12.0, salinity: 35.1 });
        let by_pressure = parse("PRES,TEMP,PSAL\n2,17.5,35\n1000,5,35\n").unwrap();
        // 1000 dbar of water of mean density 1028.9 kg/m³ (1025.4 above, 1032.3 below).
        assert!((by_pressure[1].depth_m - 1e7 / (1028.9 * 9.81)).abs() < 0.1, "{:?}", by_pressure[1]);
    }

    #[test]
    fn mistakes_are_answered_with_their_place() {
        let rows = [
            ("depth_m,salinity\n1,35\n", "cast.csv:1:1: no column `temperature_c` in this cast"),
            ("a,b\n1,2\n", "cast.csv:1:1: no column `pressure_dbar` or `depth_m` in this cast"),
            ("depth_m,temperature_c,salinity\n", "cast.csv:2:1: no levels in this cast"),
            (
                "depth_m,temperature_c,salinity\n0,10,35\n5,warm,35\n",
                "cast.csv:3:2: `temperature_c` is `warm`, but must be a number from -3 to 40",
            ),
            (
                "depth_m,temperature_c,salinity\n0,10,350\n",
                "cast.csv:2:3: `salinity` is `350`, but must be a number from 0 to 42",
            ),
            (
                "depth_m,temperature_c,salinity\n0,10\n",
                "cast.csv:2:3: `salinity` is ``, but must be a number from 0 to 42",
            ),
            (
                "depth_m,temperature_c,salinity\n0,10,35\n9,9,35\n\n9,9,35\n",
                "cast.csv:5:1: 9 does not go down from the line above, 9",
            ),
        ];
        for (text, expected) in rows {
            assert_eq!(parse(text).unwrap_err(), expected, "{text}");
        }
    }
}
