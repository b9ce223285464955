//! A CTD cast as CSV: one line of column names, then one line per level, downwards.
//!
//! Needed are `pressure_dbar` (sea pressure) or `depth_m`, `temperature_c` (in situ, ITS-90) and `salinity` (practical); the
//! names `PRES`, `DEPTH`, `TEMP`, `PSAL` mean the same. Other columns and empty lines are left alone; quotes are not understood.

use super::{
    column::Level,
    teos10::{self, Composition},
};
use crate::files::toml_file::{FileError, Rule};

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

/// A column that is read: its number, name and rule.
#[derive(Clone, Copy)]
struct Column<'a> {
    index: usize,
    name: &'a str,
    rule: Rule,
}

/// One line of the file, from 1.
#[derive(Clone, Copy)]
struct Line<'a> {
    file: &'a str,
    number: usize,
    text: &'a str,
}

/// Reads a cast; `file` stands in the errors.
pub(super) fn read(
    text: &str,
    file: &str,
    composition: Composition,
    gravity_m_s2: f64,
) -> Result<Vec<Level>, FileError> {
    let text = text.trim_start_matches('\u{feff}');
    let lines = text.lines().zip(1..).map(|(text, number)| Line { file, number, text });
    let mut lines = lines.filter(|line| !line.text.trim().is_empty());
    let header = lines.next().unwrap_or(Line { file, number: 1, text: "" });
    let pressure = header.column(["pressure_dbar", "PRES"], PRESSURE_DBAR);
    let down = pressure.or_else(|| header.column(["depth_m", "DEPTH"], DEPTH_M));
    let down = down.ok_or_else(|| header.lacks("pressure_dbar` or `depth_m"))?;
    let temperature = header.column(["temperature_c", "TEMP"], TEMPERATURE_C);
    let temperature = temperature.ok_or_else(|| header.lacks("temperature_c"))?;
    let salinity = header.column(["salinity", "PSAL"], SALINITY).ok_or_else(|| header.lacks("salinity"))?;

    let mut levels: Vec<Level> = Vec::new();
    for line in lines {
        let level = Level {
            depth_m: line.number(down)?,
            temperature_c: line.number(temperature)?,
            salinity: line.number(salinity)?,
        };
        if let Some(above) = levels.last().filter(|above| level.depth_m <= above.depth_m) {
            let message =
                format!("`{}` is {}, but must be more than the {} above", down.name, level.depth_m, above.depth_m);
            return Err(line.mistake(down.index, message));
        }
        levels.push(level);
    }
    if levels.is_empty() {
        return Err(header.mistake(0, "this cast has a header and no levels".into()));
    }
    if pressure.is_some() {
        to_depths(&mut levels, composition, gravity_m_s2).map_err(|error| {
            header.mistake(down.index, format!("the equation of state refuses the cast: {error:?}"))
        })?;
    }
    Ok(levels)
}

impl<'a> Line<'a> {
    /// The column under either name.
    fn column(&self, names: [&str; 2], rule: Rule) -> Option<Column<'a>> {
        let headings = self.text.split(',').map(str::trim).enumerate();
        let mut headings = headings.filter(|(_, name)| names.iter().any(|known| known.eq_ignore_ascii_case(name)));
        headings.next().map(|(index, name)| Column { index, name, rule })
    }

    /// The number in a column.
    fn number(&self, column: Column<'_>) -> Result<f64, FileError> {
        let written = self.text.split(',').nth(column.index).unwrap_or_default().trim();
        let read = written.parse().ok().filter(|value| column.rule.holds(*value));
        let message = || format!("`{}` is `{written}`, but must be {}", column.name, column.rule);
        read.ok_or_else(|| self.mistake(column.index, message()))
    }

    fn lacks(&self, name: &str) -> FileError {
        self.mistake(0, format!("this cast has no column `{name}`"))
    }

    /// A mistake at the beginning of some column, or at the end of a line that does not reach there.
    fn mistake(&self, index: usize, message: String) -> FileError {
        let before: Vec<_> = self.text.split(',').take(index).collect();
        let padding = self.text.split(',').nth(index).map_or(0, |cell| cell.len() - cell.trim_start().len());
        let column = before.iter().map(|cell| cell.chars().count() + 1).sum::<usize>() + padding + 1;
        FileError { file: self.file.into(), place: Some((self.number, column)), message }
    }
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
        const HEADER: &str = "depth_m,temperature_c,salinity\n";
        let rows = [
            ("depth_m,salinity\n1,35\n".into(), "cast.csv:1:1: this cast has no column `temperature_c`"),
            ("a,b\n1,2\n".into(), "cast.csv:1:1: this cast has no column `pressure_dbar` or `depth_m`"),
            (String::new(), "cast.csv:1:1: this cast has no column `pressure_dbar` or `depth_m`"),
            (HEADER.into(), "cast.csv:1:1: this cast has a header and no levels"),
            (
                HEADER.to_owned() + "0,10,35\n5, warm,35\n",
                "cast.csv:3:4: `temperature_c` is `warm`, but must be a number from -3 to 40",
            ),
            (
                HEADER.to_owned() + "0,10,350\r\n",
                "cast.csv:2:6: `salinity` is `350`, but must be a number from 0 to 42",
            ),
            (HEADER.to_owned() + "0,10\n", "cast.csv:2:6: `salinity` is ``, but must be a number from 0 to 42"),
            (
                HEADER.to_owned() + "nan,10,35\n",
                "cast.csv:2:1: `depth_m` is `nan`, but must be a number from 0 to 12000",
            ),
            (
                HEADER.to_owned() + "0,10,35\n9,9,35\n\n9,9,35\n",
                "cast.csv:5:1: `depth_m` is 9, but must be more than the 9 above",
            ),
        ];
        for (text, expected) in rows {
            assert_eq!(parse(&text).unwrap_err(), expected, "{text}");
        }
    }
}
