//! Charts as SVG: plots with axes, and figures of such plots that stand alone.

mod contour;
mod figure;
pub(crate) mod plot;

use svg::{
    Node,
    node::element::{Line as Rule, SVG, Text},
};

pub use contour::contours;
pub use figure::{Figure, Line, Mark, Panel, Place, Scale, Stroke};
use plot::Plot;

/// The styles of what stands around a plot.
pub(crate) const CSS: &str = include_str!("chart.css");
/// Between two entries of a key, px.
pub(crate) const KEY_GAP_PX: f64 = 16.0;

/// Puts a plot into a box of its sheet, px.
pub(crate) fn place(sheet: &mut SVG, plot: &Plot, [x, y]: [f64; 2], [width, height]: [f64; 2]) {
    sheet.append(plot.svg().set("x", x).set("y", y).set("width", width).set("height", height));
}

/// About how wide an entry of a key is, px.
pub(crate) fn key_px(meaning: &str) -> f64 {
    26.0 + 6.3 * meaning.chars().count() as f64
}

/// An entry of a key: a stroke in its style, and what it means.
pub(crate) fn key(sheet: &mut SVG, class: &str, [x, y]: [f64; 2], meaning: &str) {
    let line = Rule::new().set("class", format!("key {class}"));
    sheet.append(line.set("x1", x).set("x2", x + 20.0).set("y1", y - 4.0).set("y2", y - 4.0));
    words(sheet, "meaning", [x + 26.0, y], meaning);
}

/// Words that begin at a place.
pub(crate) fn words(sheet: &mut SVG, class: &str, [x, y]: [f64; 2], words: &str) {
    sheet.append(Text::new(words).set("class", class).set("x", x).set("y", y));
}
