//! Where the vehicle went: from above, and from the side.

use shared::device::MM_PER_M;

use crate::flight::{
    NorthEast, Surfacing,
    record::{Record, Sample},
};
use crate::pages::chart::plot::{Axis, Curve, Plot, Shape, Spot};

/// Points of a curve, at most about.
const POINTS: usize = 1500;
/// Room around the track, over its longer side.
const ROOM: f64 = 0.08;
/// Narrowest and widest shape of the top view, width over height.
const SHAPE: [f64; 2] = [0.8, 1.6];
/// Depth above which position fixes move the dead-reckoned place, m.
const SUBMERGED_M: f64 = 1.0;
/// Least room shown, m.
const LEAST_M: f64 = 20.0;
/// Marks along an axis, about.
const MARKS: f64 = 5.0;

/// Style and meaning of what a track shows.
pub(super) const TRACK_KEY: [(&str, &str); 2] = [("true", "true"), ("reckoned", "dead-reckoned")];
/// Style and meaning of its places.
pub(super) const PLACE_KEY: [(&str, &str); 3] =
    [("start", "start"), ("actual", "surfaced"), ("predicted", "expected to surface")];

/// The top view and the width over height of the box that gives it equal axes.
pub(super) struct TopView {
    pub(super) plot: Plot,
    pub(super) shape: f64,
}

/// East rightwards, north upwards, equal axes; true and dead-reckoned.
pub(super) fn top(record: &Record, surfacing: &Surfacing) -> TopView {
    let truth = |s: &Sample| [s.truth.position_m.y, s.truth.position_m.x];
    let true_track = curve("true", record, truth);
    let reckoned = curve("reckoned", record, |s| match s.measurements.gps {
        Some(_) => [f64::NAN; 2],
        None => [metres(s.commands.east_mm), metres(s.commands.north_mm)],
    });
    let curves = vec![true_track, reckoned];
    let [east, north] = [0, 1].map(|axis| extent(&curves, axis));
    let (shape, [east, north]) = shaped(east, north);
    let spot = |class, place: NorthEast| Spot { class, at: [place.east_m, place.north_m], shape: Shape::Circle };
    let start = Some(NorthEast { north_m: 0.0, east_m: 0.0 });
    let places = [("start", start), ("actual", surfacing.actual), ("predicted", surfacing.predicted)];
    let spots = places.into_iter().filter_map(|(class, place)| place.map(|place| spot(class, place))).collect();
    let plot = Plot {
        level: Axis::exactly(east[0], east[1], MARKS),
        upright: Axis::exactly(north[0], north[1], MARKS),
        bands: Vec::new(),
        areas: Vec::new(),
        curves,
        spots,
    };
    TopView { plot, shape }
}

/// Depth over the horizontal way under water, true and dead-reckoned.
pub(super) fn side(record: &Record) -> Plot {
    let under_way: Vec<&Sample> = record.samples.iter().filter(|s| s.truth.position_m.z > SUBMERGED_M).collect();
    let per_m = record.water.density_kg_m3 * record.water.gravity_m_s2;
    let true_track =
        along("true", &under_way, |s| [s.truth.position_m.x, s.truth.position_m.y], |s| Some(s.truth.position_m.z));
    let reckoned = along(
        "reckoned",
        &under_way,
        |s| [metres(s.commands.north_mm), metres(s.commands.east_mm)],
        |s| Some(f64::from(s.measurements.pressure_pa?) / per_m),
    );
    let curves = vec![true_track, reckoned];
    let way = extent(&curves, 0);
    let depths = curves.iter().flat_map(|curve| curve.points.iter().map(|[_, depth]| *depth));
    Plot {
        level: Axis::exactly(0.0, way[1].max(1.0), 2.0 * MARKS),
        upright: Axis::from_zero(depths, 1.0, MARKS).downwards(),
        bands: Vec::new(),
        areas: Vec::new(),
        curves,
        spots: Vec::new(),
    }
}

/// Depth over the horizontal way.
fn along(
    class: &'static str,
    samples: &[&Sample],
    place: impl Fn(&Sample) -> [f64; 2],
    depth: impl Fn(&Sample) -> Option<f64>,
) -> Curve {
    let mut way_m = 0.0;
    let mut before = samples.first().map(|sample| place(sample));
    let mut points = Vec::new();
    for sample in samples {
        let here = place(sample);
        if let Some([x, y]) = before.replace(here) {
            way_m += (here[0] - x).hypot(here[1] - y);
        }
        points.extend(depth(sample).map(|depth_m| [way_m, depth_m]));
    }
    Curve { class, points }
}

fn curve(class: &'static str, record: &Record, place: impl Fn(&Sample) -> [f64; 2]) -> Curve {
    let every = record.samples.len().div_ceil(POINTS).max(1);
    let mut points: Vec<_> = record.samples.iter().step_by(every).map(&place).collect();
    points.extend(record.samples.last().map(place));
    Curve { class, points }
}

fn metres(mm: i32) -> f64 {
    f64::from(mm) / f64::from(MM_PER_M)
}

fn extent(curves: &[Curve], axis: usize) -> [f64; 2] {
    let values = curves.iter().flat_map(|curve| curve.points.iter().map(|point| point[axis]));
    let start = [0.0, 0.0];
    values.filter(|value| value.is_finite()).fold(start, |[min, max], value| [min.min(value), max.max(value)])
}

/// Widens two ranges until they have room and their shape is within [`SHAPE`]: width over height, and the ranges.
fn shaped(east: [f64; 2], north: [f64; 2]) -> (f64, [[f64; 2]; 2]) {
    let width = |[min, max]: [f64; 2]| max - min;
    let room = ROOM * width(east).max(width(north)).max(LEAST_M);
    let [mut wide, mut high] = [width(east) + 2.0 * room, width(north) + 2.0 * room];
    wide = wide.max(SHAPE[0] * high);
    high = high.max(wide / SHAPE[1]);
    let around = |[min, max]: [f64; 2], width: f64| [(min + max - width) / 2.0, (min + max + width) / 2.0];
    (wide / high, [around(east, wide), around(north, high)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_straight_track_gets_a_box_of_some_width() {
        let (shape, [east, north]) = shaped([0.0, 0.0], [0.0, 1000.0]);
        assert!((shape - SHAPE[0]).abs() < 1e-12);
        assert!(((east[1] - east[0]) / (north[1] - north[0]) - shape).abs() < 1e-12);
        assert!(east[0] < 0.0 && north[0] < 0.0 && north[1] > 1000.0);
    }
}
