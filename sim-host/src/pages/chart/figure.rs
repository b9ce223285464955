//! A figure: panels of lines and places side by side, as one SVG with its text as text.

use std::io::{self, Write};

use svg::{
    Document, Node,
    node::element::{Rectangle, SVG, Style, Text},
};

use super::{
    KEY_GAP_PX, key, key_px, place,
    plot::{self, Anchor, Axis, BELOW_PX, Curve, LEFT_PX, Plot, Shape, Spot},
    words,
};

const MARGIN_PX: f64 = 20.0;
/// Room for the figure's title.
const TITLE_PX: f64 = 52.0;
/// A panel's plot.
const PLOT_PX: [f64; 2] = [400.0, 280.0];
/// Room for the upright label, left of the axis' words.
const LABEL_PX: f64 = 22.0;
/// From a panel's title to its plot.
const NAME_PX: f64 = 22.0;
/// Height of one line of the key.
const KEY_PX: f64 = 19.0;
/// About how many marks an axis carries.
const MARKS: f64 = 6.0;

const SOLID: [&str; 7] = ["s0", "s1", "s2", "s3", "s4", "s5", "s6"];
const BARS: [&str; 2] = ["b0", "b1"];
const DASHED: [&str; 7] = ["d0", "d1", "d2", "d3", "d4", "d5", "d6"];

/// Panels, row by row.
#[derive(Clone, Debug)]
pub struct Figure {
    /// What it shows.
    pub title: String,
    /// Panels in a row.
    pub columns: usize,
    /// The panels.
    pub panels: Vec<Panel>,
}

/// One plot with its axes' names and its key.
#[derive(Clone, Debug)]
pub struct Panel {
    /// What it shows.
    pub title: String,
    /// The level axis.
    pub x: Scale,
    /// The upright axis.
    pub y: Scale,
    /// Its lines, the hindmost first.
    pub lines: Vec<Line>,
    /// Its marked places, in front of the lines.
    pub places: Vec<Place>,
}

/// An axis: its name with the unit, and its range.
#[derive(Clone, Debug)]
pub struct Scale {
    /// Quantity and unit.
    pub label: String,
    /// Least and greatest value; without it, those of the lines and places.
    pub range: Option<[f64; 2]>,
    /// Larger values stand lower: depth.
    pub downwards: bool,
    /// Whether values are marked; not those of rows that have names.
    pub marked: bool,
}

impl Scale {
    /// An axis from one value to another.
    pub fn exactly(label: impl Into<String>, range: [f64; 2]) -> Self {
        Self { label: label.into(), range: Some(range), downwards: false, marked: true }
    }

    /// An axis around all values.
    pub fn around(label: impl Into<String>) -> Self {
        Self { label: label.into(), range: None, downwards: false, marked: true }
    }

    /// An upright axis of so many rows, from the top: row 0 stands at 0.
    pub fn rows(count: usize) -> Self {
        Self { label: String::new(), range: Some([-0.7, count as f64 - 0.3]), downwards: true, marked: false }
    }

    /// Both axes around all points, a unit as long on one as on the other: a map.
    pub fn equal([x, y]: [&str; 2], points: impl Iterator<Item = [f64; 2]>) -> [Self; 2] {
        let points: Vec<[f64; 2]> = points.collect();
        let [level, upright] = [0, 1].map(|axis| {
            let axis = Axis::around(points.iter().map(|point| point[axis]), f64::MIN_POSITIVE, MARKS);
            [(axis.min + axis.max) / 2.0, axis.max - axis.min]
        });
        let unit = (level[1] / PLOT_PX[0]).max(upright[1] / PLOT_PX[1]);
        let around = |[middle, _]: [f64; 2], px: f64| [middle - unit * px / 2.0, middle + unit * px / 2.0];
        [Self::exactly(x, around(level, PLOT_PX[0])), Self::exactly(y, around(upright, PLOT_PX[1]))]
    }

    fn axis(&self, values: impl Iterator<Item = f64>) -> Axis {
        let axis = match self.range {
            Some([min, max]) => Axis::exactly(min, max, MARKS),
            None => Axis::around(values, f64::MIN_POSITIVE, MARKS),
        };
        let axis = if self.marked { axis } else { axis.unmarked() };
        if self.downwards { axis.downwards() } else { axis }
    }
}

/// A line; it breaks where a value is not finite.
#[derive(Clone, Debug)]
pub struct Line {
    /// What the key says; lines of one name have one entry, and none without a name.
    pub name: Option<String>,
    /// How it is drawn.
    pub stroke: Stroke,
    /// Its points [x, y].
    pub points: Vec<[f64; 2]>,
}

/// How a line is drawn; colours go round after seven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Unbroken, in a colour.
    Solid(usize),
    /// Dashed, in a colour.
    Dashed(usize),
    /// As thick as a bar, in one of two colours.
    Bar(usize),
    /// A thin dotted line to read by.
    Aid,
}

impl Stroke {
    fn class(self) -> &'static str {
        match self {
            Self::Solid(colour) => SOLID[colour % SOLID.len()],
            Self::Dashed(colour) => DASHED[colour % DASHED.len()],
            Self::Bar(colour) => BARS[colour % BARS.len()],
            Self::Aid => "axis",
        }
    }
}

/// A marked place.
#[derive(Clone, Debug)]
pub struct Place {
    /// [x, y].
    pub at: [f64; 2],
    /// What stands there.
    pub mark: Mark,
}

/// What marks a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Where a branch begins: a red circle.
    From,
    /// Where it ends: a blue square.
    To,
    /// A value of ours: a full dot.
    Point,
    /// One of many values: a small dot.
    Dot,
    /// A printed value: an open circle.
    Printed,
    /// A few words.
    Note(String),
    /// Words that end there.
    Before(String),
    /// Words that begin there.
    After(String),
}

impl Mark {
    fn spot(&self, at: [f64; 2]) -> Spot {
        let (class, shape) = match self {
            Self::From => ("from", Shape::Circle),
            Self::To => ("to", Shape::Square),
            Self::Point => ("point", Shape::Circle),
            Self::Dot => ("point", Shape::Dot),
            Self::Printed => ("printed", Shape::Circle),
            Self::Note(words) => ("note", Shape::Words(words.clone(), Anchor::Middle)),
            Self::Before(words) => ("note", Shape::Words(words.clone(), Anchor::End)),
            Self::After(words) => ("note", Shape::Words(words.clone(), Anchor::Start)),
        };
        Spot { class, at, shape }
    }
}

impl Figure {
    /// The figure as an SVG document.
    #[must_use]
    pub fn svg(&self) -> String {
        let columns = self.columns.max(1);
        let cell_width = LABEL_PX + LEFT_PX + PLOT_PX[0] + MARGIN_PX;
        let rows: Vec<&[Panel]> = self.panels.chunks(columns).collect();
        let row_height = |row: &&[Panel]| row.iter().map(Panel::height_px).fold(0.0, f64::max);
        let width = MARGIN_PX + cell_width * columns as f64;
        let height = TITLE_PX + rows.iter().map(row_height).sum::<f64>();
        let mut sheet = Document::new()
            .set("viewBox", format!("0 0 {width} {height}"))
            .set("width", width)
            .set("height", height)
            .set("role", "img")
            .set("aria-label", self.title.as_str());
        sheet.append(Style::new([plot::CSS, super::CSS, include_str!("figure.css")].concat()));
        sheet.append(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"));
        words(&mut sheet, "title", [MARGIN_PX, 32.0], &self.title);
        let mut top = TITLE_PX;
        for row in rows {
            for (column, panel) in row.iter().enumerate() {
                panel.draw(&mut sheet, [MARGIN_PX + cell_width * column as f64, top]);
            }
            top += row_height(&row);
        }
        sheet.to_string()
    }
}

impl Figure {
    /// Its lines as CSV: panel, line, x, y; nothing where a line breaks.
    ///
    /// # Errors
    /// As the writer.
    pub fn write_csv(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        csv.write_record(["panel", "line", "x", "y"])?;
        for panel in &self.panels {
            let named = panel.lines.iter().filter_map(|line| Some((line.name.as_ref()?, &line.points)));
            for (name, [x, y]) in named.flat_map(|(name, points)| points.iter().map(move |point| (name, point))) {
                let y = if y.is_finite() { y.to_string() } else { String::new() };
                csv.write_record([&panel.title, name, &x.to_string(), &y])?;
            }
        }
        csv.flush()
    }
}

impl Panel {
    fn height_px(&self) -> f64 {
        NAME_PX + PLOT_PX[1] + 2.0 * BELOW_PX + KEY_PX * self.key_rows().len() as f64 + MARGIN_PX
    }

    fn draw(&self, sheet: &mut SVG, [x, y]: [f64; 2]) {
        let (left, top) = (x + LABEL_PX + LEFT_PX, y + NAME_PX);
        words(sheet, "name", [left, y + 12.0], &self.title);
        place(sheet, &self.plot(), [left, top], PLOT_PX);
        let middle = |words: &str| Text::new(words).set("class", "label").set("text-anchor", "middle");
        let [below, beside] = [top + PLOT_PX[1] + 2.0 * BELOW_PX - 6.0, top + PLOT_PX[1] / 2.0];
        sheet.append(middle(&self.x.label).set("x", left + PLOT_PX[0] / 2.0).set("y", below));
        sheet.append(middle(&self.y.label).set("transform", format!("translate({} {beside}) rotate(-90)", x + 12.0)));
        for (row, entries) in self.key_rows().iter().enumerate() {
            let mut right = left;
            for (class, meaning) in entries {
                key(sheet, class, [right, below + KEY_PX * (row + 1) as f64], meaning);
                right += key_px(meaning) + KEY_GAP_PX;
            }
        }
    }

    fn plot(&self) -> Plot {
        let values = |axis: usize| {
            let lines = self.lines.iter().flat_map(|line| line.points.iter());
            lines.chain(self.places.iter().map(|place| &place.at)).map(move |point| point[axis])
        };
        let (level, upright) = (self.x.axis(values(0)), self.y.axis(values(1)));
        let inside = |axis: &Axis, value: f64| (axis.min..=axis.max).contains(&value);
        let seen = |place: &&Place| inside(&level, place.at[0]) && inside(&upright, place.at[1]);
        let spots = self.places.iter().filter(seen).map(|place| place.mark.spot(place.at)).collect();
        let curve = |line: &Line| Curve { class: line.stroke.class(), points: line.points.clone() };
        let curves = self.lines.iter().map(curve).collect();
        Plot { level, upright, bands: Vec::new(), areas: Vec::new(), curves, spots }
    }

    /// Entries of the key in rows that fit the plot's width.
    fn key_rows(&self) -> Vec<Vec<(&'static str, &str)>> {
        let mut entries: Vec<(&'static str, &str)> = Vec::new();
        for line in &self.lines {
            let Some(name) = &line.name else { continue };
            if !entries.contains(&(line.stroke.class(), name.as_str())) {
                entries.push((line.stroke.class(), name));
            }
        }
        let mut rows: Vec<Vec<(&'static str, &str)>> = Vec::new();
        let mut left_px = 0.0;
        for entry in entries {
            let width = key_px(entry.1) + KEY_GAP_PX;
            match rows.last_mut() {
                Some(row) if width <= left_px => row.push(entry),
                _ => {
                    rows.push(vec![entry]);
                    left_px = PLOT_PX[0] + KEY_GAP_PX;
                }
            }
            left_px -= width;
        }
        rows
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(name: Option<&str>, stroke: Stroke) -> Line {
        Line { name: name.map(str::to_owned), stroke, points: vec![[0.0, 0.0], [1.0, 1.0]] }
    }

    fn panel(lines: Vec<Line>) -> Panel {
        let at = |x: f64| Place { at: [x, 0.5], mark: Mark::From };
        Panel {
            title: "(a)".into(),
            x: Scale::exactly("speed, m/s", [0.0, 1.0]),
            y: Scale::around("lift"),
            lines,
            places: vec![at(0.5), at(1.5)],
        }
    }

    #[test]
    fn lines_of_one_name_share_an_entry_and_long_keys_wrap() {
        let lines = vec![
            line(Some("one of them, said at length"), Stroke::Solid(0)),
            line(Some("one of them, said at length"), Stroke::Solid(0)),
            line(None, Stroke::Aid),
            line(Some("another one, said at length"), Stroke::Dashed(1)),
        ];
        let rows = panel(lines);
        let rows = rows.key_rows();
        assert_eq!(rows, [[("s0", "one of them, said at length")], [("d1", "another one, said at length")]]);
    }

    /// 400 × 280 px hold 112 m of north, 6 % of room on either side, in 280 px: 0.4 m per px both ways.
    #[test]
    fn a_map_is_as_wide_as_its_box_makes_it() {
        let [x, y] = Scale::equal(["east", "north"], [[10.0, 0.0], [30.0, 100.0]].into_iter());
        let width = |scale: &Scale| scale.range.map(|[min, max]| max - min).unwrap();
        assert!((width(&x) - 160.0).abs() < 1e-9 && (width(&y) - 112.0).abs() < 1e-9, "{x:?} {y:?}");
        assert_eq!(x.range.map(|[min, max]| min + max), Some(40.0));
    }

    #[test]
    fn places_beyond_the_axes_are_left_out_and_text_stays_text() {
        let figure =
            Figure { title: "A & B".into(), columns: 1, panels: vec![panel(vec![line(None, Stroke::Solid(0))])] };
        let svg = figure.svg();
        assert_eq!(svg.matches("<circle").count(), 1);
        assert!(svg.contains("speed, m/s") && svg.contains("A &amp; B"), "{svg}");
    }
}
