//! A plot as SVG that fits any box: places are percentages, strokes and letters keep their size.
//!
//! The axes' words stand outside the plot's own box, so its surroundings leave room: [`LEFT_PX`] and [`BELOW_PX`].

use svg::{
    Node,
    node::element::{Circle, Line as Rule, Polygon, Polyline, Rectangle, SVG, Text},
};

/// The styles of everything in a plot.
pub(crate) const CSS: &str = include_str!("plot.css");
/// Room for the words of the upright axis, px.
pub(crate) const LEFT_PX: f64 = 48.0;
/// Room for the words of the level axis, px.
pub(crate) const BELOW_PX: f64 = 22.0;
/// Size of the box in which curves are drawn before they are stretched.
const BOX: f64 = 1000.0;
/// Buckets along the level axis, of each of which the extremes are drawn.
const BUCKETS: usize = 700;
/// Room beyond the values, over their range.
const ROOM: f64 = 0.06;
/// From a place to words that begin or end there, px.
const WORDS_PX: f64 = 5.0;
/// Steps between marked directions, deg.
const TURN_PARTS_DEG: [f64; 10] = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 45.0, 90.0, 180.0, 360.0];

/// A range of values with marks at round ones.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) min: f64,
    pub(crate) max: f64,
    /// Values that carry a mark, and what it says.
    pub(crate) marks: Vec<(f64, String)>,
    /// Larger values stand lower: depth.
    pub(crate) downwards: bool,
}

/// A curve of a named style; it breaks where a value is not finite.
#[derive(Clone, Debug)]
pub(crate) struct Curve {
    pub(crate) class: &'static str,
    pub(crate) points: Vec<[f64; 2]>,
}

/// A stretch of the level axis in a named style.
#[derive(Clone, Debug)]
pub(crate) struct Band {
    pub(crate) class: &'static str,
    pub(crate) from: f64,
    pub(crate) to: f64,
}

/// A place in a named style.
#[derive(Clone, Debug)]
pub(crate) struct Spot {
    pub(crate) class: &'static str,
    pub(crate) at: [f64; 2],
    pub(crate) shape: Shape,
}

/// What stands at a place.
#[derive(Clone, Debug)]
pub(crate) enum Shape {
    Circle,
    Dot,
    Square,
    Words(String, Anchor),
}

/// Which part of words stands at their place.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// What one plot shows.
#[derive(Clone, Debug)]
pub(crate) struct Plot {
    pub(crate) level: Axis,
    pub(crate) upright: Axis,
    pub(crate) bands: Vec<Band>,
    /// Filled down to the level axis, the hindmost first.
    pub(crate) areas: Vec<Curve>,
    pub(crate) curves: Vec<Curve>,
    pub(crate) spots: Vec<Spot>,
}

impl Axis {
    /// From the least to the greatest value with some room around; about `count` marks.
    pub(crate) fn around(values: impl Iterator<Item = f64>, least_width: f64, count: f64) -> Self {
        let (min, max) = extent(values);
        let width = (max - min).max(least_width);
        let middle = (min + max) / 2.0;
        let half = (0.5 + ROOM) * width;
        Self::exactly(middle - half, middle + half, count)
    }

    /// From zero to the greatest value with some room above; about `count` marks.
    pub(crate) fn from_zero(values: impl Iterator<Item = f64>, least_width: f64, count: f64) -> Self {
        let (_, max) = extent(values);
        Self::exactly(0.0, (1.0 + ROOM) * max.max(least_width), count)
    }

    /// From one value to another, with about `count` marks at round values.
    pub(crate) fn exactly(min: f64, max: f64, count: f64) -> Self {
        let step = round_step((max - min) / count);
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let words = |value: f64| format!("{value:.decimals$}").replace('-', "−");
        let marks = marks(min, max, step).map(|value| (value, words(value))).collect();
        Self { min, max, marks, downwards: false }
    }

    /// The same without marks.
    pub(crate) fn unmarked(self) -> Self {
        Self { marks: Vec::new(), ..self }
    }

    /// The same, larger values lower.
    pub(crate) fn downwards(self) -> Self {
        Self { downwards: true, ..self }
    }

    /// Like [`Axis::around`], for unwrapped directions in degrees: marks at parts of a turn, named 0 to 360.
    pub(crate) fn around_directions(values: impl Iterator<Item = f64>, least_width: f64, count: f64) -> Self {
        let Self { min, max, .. } = Self::around(values, least_width, count);
        let step = TURN_PARTS_DEG.into_iter().find(|step| *step >= (max - min) / count).unwrap_or(360.0);
        let marks = marks(min, max, step).map(|value| (value, format!("{}", value.rem_euclid(360.0)))).collect();
        Self { min, max, marks, downwards: false }
    }

    /// Where a value stands, 0 to 1 along the axis.
    fn share(&self, value: f64) -> f64 {
        (value - self.min) / (self.max - self.min)
    }
}

/// The least and the greatest finite value; zeros for none.
fn extent(values: impl Iterator<Item = f64>) -> (f64, f64) {
    values
        .filter(|value| value.is_finite())
        .map(|value| (value, value))
        .reduce(|(min, max), (value, _)| (min.min(value), max.max(value)))
        .unwrap_or((0.0, 0.0))
}

/// The multiples of a step in a range.
fn marks(min: f64, max: f64, step: f64) -> impl Iterator<Item = f64> {
    let (first, last) = ((min / step - 1e-6).ceil() as i64, (max / step + 1e-6).floor() as i64);
    (first..=last).map(move |index| index as f64 * step)
}

/// The 1, 2 or 5 times a power of ten nearest above a step; 1 for none.
fn round_step(step: f64) -> f64 {
    if !(step.is_finite() && step > 0.0) {
        return 1.0;
    }
    let power = 10_f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|digit| digit * power).find(|round| *round >= step * 0.999).unwrap_or(10.0 * power)
}

impl Plot {
    /// The plot as an SVG element without a size of its own.
    pub(crate) fn svg(&self) -> SVG {
        let mut curves = SVG::new()
            .set("class", "curves")
            .set("viewBox", format!("0 0 {BOX} {BOX}"))
            .set("preserveAspectRatio", "none")
            .set("width", "100%")
            .set("height", "100%");
        for area in &self.areas {
            for points in self.stretches(&area.points) {
                let ([first, ..], [.., last]) = (&points[..], &points[..]) else { continue };
                let floor = if self.upright.downwards { 0.0 } else { BOX };
                let closed = format!("{:.1},{floor} {} {:.1},{floor}", first[0], joined(&points), last[0]);
                curves.append(Polygon::new().set("class", area.class).set("points", closed));
            }
        }
        for curve in &self.curves {
            for points in self.stretches(&curve.points) {
                curves.append(Polyline::new().set("class", curve.class).set("points", joined(&points)));
            }
        }
        let mut plot = SVG::new().set("class", "plot").set("overflow", "visible");
        self.draw_bands(&mut plot);
        self.draw_axes(&mut plot);
        plot.append(curves);
        self.draw_spots(&mut plot);
        plot
    }

    fn draw_bands(&self, plot: &mut SVG) {
        for band in &self.bands {
            let (from, to) = (self.level.share(band.from), self.level.share(band.to));
            plot.append(
                Rectangle::new()
                    .set("class", format!("band {}", band.class))
                    .set("x", percent(from))
                    .set("width", percent(to - from))
                    .set("height", "100%"),
            );
        }
    }

    fn draw_axes(&self, plot: &mut SVG) {
        for (value, words) in &self.upright.marks {
            let y = percent(self.height(*value));
            plot.append(Rule::new().set("class", "grid").set("x2", "100%").set("y1", y.clone()).set("y2", y.clone()));
            let text = Text::new(words.clone()).set("class", "mark").set("text-anchor", "end");
            plot.append(text.set("dx", -7).set("y", y).set("dy", "0.33em"));
        }
        for (value, words) in &self.level.marks {
            let x = percent(self.level.share(*value));
            plot.append(Rule::new().set("class", "grid").set("y2", "100%").set("x1", x.clone()).set("x2", x.clone()));
            let text = Text::new(words.clone()).set("class", "mark").set("text-anchor", "middle");
            plot.append(text.set("x", x).set("y", "100%").set("dy", "1.35em"));
        }
        plot.append(Rectangle::new().set("class", "outline").set("width", "100%").set("height", "100%"));
    }

    fn draw_spots(&self, plot: &mut SVG) {
        for spot in &self.spots {
            let (x, y) = (percent(self.level.share(spot.at[0])), percent(self.height(spot.at[1])));
            match &spot.shape {
                Shape::Circle | Shape::Dot => {
                    let radius = if matches!(spot.shape, Shape::Dot) { 2.2 } else { 5.0 };
                    plot.append(Circle::new().set("class", spot.class).set("cx", x).set("cy", y).set("r", radius));
                }
                Shape::Square => {
                    let square = Rectangle::new().set("class", spot.class).set("x", x).set("y", y);
                    plot.append(square.set("width", 9).set("height", 9).set("transform", "translate(-4.5 -4.5)"));
                }
                Shape::Words(words, anchor) => {
                    let (anchor, dx) = match anchor {
                        Anchor::Start => ("start", WORDS_PX),
                        Anchor::Middle => ("middle", 0.0),
                        Anchor::End => ("end", -WORDS_PX),
                    };
                    let text = Text::new(words.clone()).set("class", spot.class).set("text-anchor", anchor);
                    plot.append(text.set("x", x).set("y", y).set("dx", dx).set("dy", "0.33em"));
                }
            }
        }
    }

    /// How far below the top a value stands, 0 to 1.
    fn height(&self, value: f64) -> f64 {
        let share = self.upright.share(value);
        if self.upright.downwards { share } else { 1.0 - share }
    }

    /// A curve's unbroken stretches in the box.
    fn stretches(&self, points: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
        let boxed: Vec<_> = points.iter().map(|[x, y]| [BOX * self.level.share(*x), BOX * self.height(*y)]).collect();
        let finite = |point: &[f64; 2]| point[0].is_finite() && point[1].is_finite();
        boxed
            .split(|point| !finite(point))
            .filter(|stretch| !stretch.is_empty())
            .map(|stretch| if stretch.is_sorted_by_key(|point| point[0]) { thinned(stretch) } else { stretch.to_vec() })
            .collect()
    }
}

/// Of a curve that runs rightwards: in each bucket its first, lowest, highest and last point.
fn thinned(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let bucket = |point: &[f64; 2]| (point[0] / BOX * BUCKETS as f64).floor();
    points
        .chunk_by(|a, b| bucket(a) == bucket(b))
        .flat_map(|chunk| {
            let by_height = |a: &usize, b: &usize| chunk[*a][1].total_cmp(&chunk[*b][1]);
            let indices = 0..chunk.len();
            let extremes = [indices.clone().min_by(by_height), indices.clone().max_by(by_height)];
            let mut kept: Vec<usize> =
                [Some(0), chunk.len().checked_sub(1)].into_iter().chain(extremes).flatten().collect();
            kept.sort_unstable();
            kept.dedup();
            kept.into_iter().map(|index| chunk[index])
        })
        .collect()
}

fn joined(points: &[[f64; 2]]) -> String {
    points.iter().map(|[x, y]| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

fn percent(share: f64) -> String {
    format!("{:.2}%", 100.0 * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn words(axis: &Axis) -> Vec<&str> {
        axis.marks.iter().map(|(_, words)| words.as_str()).collect()
    }

    #[test]
    fn marks_stand_at_round_values() {
        assert_eq!(words(&Axis::around([-23.0, 26.0].into_iter(), 1.0, 4.0)), ["−20", "0", "20"]);
        assert_eq!(words(&Axis::from_zero([0.73].into_iter(), 0.1, 4.0)), ["0.0", "0.2", "0.4", "0.6"]);
        assert_eq!(words(&Axis::exactly(0.0, 46.0, 10.0)), ["0", "5", "10", "15", "20", "25", "30", "35", "40", "45"]);
        let north = Axis::around_directions([349.0, 372.0].into_iter(), 1.0, 4.0);
        assert_eq!(words(&north), ["350", "0", "10"]);
        let turns = Axis::around_directions([-160.0, 200.0].into_iter(), 1.0, 4.0);
        assert_eq!(words(&turns), ["180", "0", "180"]);
    }

    #[test]
    fn nothing_to_show_still_has_an_axis() {
        let axis = Axis::around([f64::NAN].into_iter(), 2.0, 4.0);
        assert_eq!(words(&axis), ["−1", "0", "1"]);
    }

    #[test]
    fn thinning_keeps_every_extreme() {
        let points: Vec<_> = (0..100_000)
            .map(|index| [f64::from(index) / 100.0, if index == 54_321 { 999.0 } else { f64::from(index % 7) }])
            .collect();
        let few = thinned(&points);
        assert!(few.len() <= 4 * (BUCKETS + 1), "{}", few.len());
        assert!(few.contains(&[543.21, 999.0]));
        assert_eq!((few.first(), few.last()), (points.first(), points.last()));
    }

    #[test]
    fn a_curve_breaks_where_there_is_no_value() {
        let points = vec![[0.0, 0.0], [0.2, 1.0], [0.4, f64::NAN], [0.6, 1.0], [0.8, 0.0]];
        let plot = Plot {
            level: Axis::exactly(0.0, 1.0, 2.0),
            upright: Axis::exactly(0.0, 1.0, 2.0),
            bands: Vec::new(),
            areas: Vec::new(),
            curves: vec![Curve { class: "true", points }],
            spots: Vec::new(),
        };
        let svg = plot.svg().to_string();
        assert_eq!(svg.matches("<polyline").count(), 2);
        assert!(svg.contains("0.0,1000.0 200.0,0.0"));
    }
}
