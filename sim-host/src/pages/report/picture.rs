//! A dive in one picture of 900 px: depth, pitch and heading over time, and the track from above.

use svg::{
    Document, Node,
    node::element::{Rectangle, SVG, Style},
};

use super::{
    Flight,
    tables::duration,
    traces::{Trace, Traces},
    track,
};
use crate::pages::chart::{
    CSS as CHART_CSS, KEY_GAP_PX, key, key_px, place,
    plot::{self, BELOW_PX, LEFT_PX},
    words,
};

const WIDTH_PX: f64 = 900.0;
const HEIGHT_PX: f64 = 572.0;
const MARGIN_PX: f64 = 20.0;
/// Where the first plots begin.
const TOP_PX: f64 = 76.0;
/// From the words below one plot to the next.
const GAP_PX: f64 = 30.0;
/// Width of the plots over time, their words left out.
const TIME_PX: f64 = 500.0;
/// From the caption's base line to its plot.
const CAPTION_PX: f64 = 8.0;

/// The picture as an SVG document, text as text.
#[must_use]
pub fn picture(flight: &Flight<'_>) -> String {
    let mut sheet = Document::new()
        .set("viewBox", format!("0 0 {WIDTH_PX} {HEIGHT_PX}"))
        .set("width", WIDTH_PX)
        .set("height", HEIGHT_PX)
        .set("role", "img")
        .set("aria-label", format!("A dive of {}", flight.vehicle.name));
    sheet.append(Style::new([plot::CSS, CHART_CSS, include_str!("picture.css")].concat()));
    sheet.append(Rectangle::new().set("width", "100%").set("height", "100%").set("fill", "#ffffff"));
    let title = format!(
        "{}: {}, {:.0} m deep, {:.1} kJ",
        flight.vehicle.name,
        duration(flight.summary.duration_s),
        flight.summary.max_depth_m,
        1e-3 * flight.summary.energy_j.total()
    );
    words(&mut sheet, "title", [MARGIN_PX, 34.0], &title);

    let left = MARGIN_PX + LEFT_PX;
    let traces = Traces::new(flight.record);
    let column = [(traces.depth(&flight.depth_targets()), 190.0), (traces.pitch(), 82.0), (traces.heading(), 82.0)];
    let mut top = TOP_PX;
    for (trace, height) in &column {
        caption(&mut sheet, [left, top - CAPTION_PX], trace);
        place(&mut sheet, &trace.plot, [left, top], [TIME_PX, *height]);
        top += height + BELOW_PX + GAP_PX;
    }
    words(&mut sheet, "unit", [left, top - GAP_PX + 16.0], "minutes");

    let track = track::top(flight.record, &flight.summary.surfacing);
    let [x, mut y] = [left + TIME_PX + MARGIN_PX + LEFT_PX, TOP_PX];
    let width = WIDTH_PX - MARGIN_PX - x;
    words(&mut sheet, "name", [x, y - CAPTION_PX], "Track from above, m");
    place(&mut sheet, &track.plot, [x, y], [width, width / track.shape]);
    y += width / track.shape + BELOW_PX + 18.0;
    let mut right = x;
    for (class, meaning) in track::TRACK_KEY {
        key(&mut sheet, class, [right, y], meaning);
        right += key_px(meaning) + KEY_GAP_PX;
    }

    let energy = traces.energy();
    let bottom = top - BELOW_PX - GAP_PX;
    y += GAP_PX + 8.0;
    words(&mut sheet, "name", [x, y - CAPTION_PX], "Energy used, kJ");
    for (row, (class, meaning)) in energy.key.iter().rev().enumerate() {
        let line = y + 18.0 + 16.0 * row as f64;
        sheet.append(swatch(class, [x + 10.0, line - 10.0]));
        words(&mut sheet, "meaning", [x + 28.0, line], meaning);
    }
    place(&mut sheet, &energy.plot, [x, y], [width, bottom - y]);
    sheet.to_string()
}

/// Title, unit and key in one line above a plot.
fn caption(sheet: &mut SVG, [x, y]: [f64; 2], trace: &Trace) {
    words(sheet, "name", [x, y], &format!("{}, {}", trace.title, trace.unit));
    let mut right = x + TIME_PX;
    for (class, meaning) in trace.key.iter().rev() {
        right -= key_px(meaning);
        key(sheet, class, [right, y], meaning);
        right -= KEY_GAP_PX;
    }
}

fn swatch(class: &str, [x, y]: [f64; 2]) -> Rectangle {
    Rectangle::new().set("class", format!("swatch {class}")).set("x", x).set("y", y).set("width", 11).set("height", 11)
}
