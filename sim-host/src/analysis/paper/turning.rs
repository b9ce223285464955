//! Figure 11: what a turn takes, over fin and dihedral, and the caveat that a turn which takes less roll suffers more from an
//! error in roll.

use super::{
    Reproduction,
    comparison::{Reading, Trend},
};
use crate::analysis::{
    locus::Varied,
    trim::{Condition, Scale, glide},
    turn::{Sensitivity, Turns, equations_14_to_16},
};
use crate::model::{
    coefficients::{Anchoring, Parameter, Study},
    vehicle::Vehicle,
};
use crate::pages::chart::{Figure, Line, Mark, Panel, Place, Scale as Axis, Stroke};

/// The glide of section 5.1.
const CONDITION: Condition = Condition::PathAngle(-35.0 * std::f64::consts::PI / 180.0);
const SCALE: Scale = Scale::Speed(0.77);
const POINTS: usize = 121;
/// A plot shows this many times the median size: a pole goes beyond every axis.
const SHOWN: f64 = 8.0;

/// One of the three sensitivities.
type Part = fn(&Sensitivity) -> f64;

struct Sweep {
    panel: &'static str,
    axis: &'static str,
    varied: Varied,
    range: [f64; 2],
    says: &'static str,
    /// Whether less roll and μ are said to be needed at the end of the range.
    end_takes_less: bool,
}

const SWEEPS: [Sweep; 3] = [
    Sweep {
        panel: "(a) fin position",
        axis: "l_v",
        varied: Varied::Shape(Parameter::FinPosition),
        range: [0.5, 1.0],
        says: "a smaller l_v takes less μ and φ for a given turn rate",
        end_takes_less: false,
    },
    Sweep {
        panel: "(b) fin area",
        axis: "S_v over the frontal area",
        varied: Varied::Shape(Parameter::FinAreaRatio),
        range: [0.5, 1.2],
        says: "a smaller S_v takes less μ and φ for a given turn rate",
        end_takes_less: false,
    },
    Sweep {
        panel: "(c) dihedral effect",
        axis: "C_lβ",
        varied: Varied::RollBySideslip,
        range: [-0.8, -0.2],
        says: "a less negative C_lβ takes less μ and φ for a given turn rate",
        end_takes_less: true,
    },
];

/// One value of a sweep.
#[derive(Clone, Copy, Debug)]
struct Point {
    value: f64,
    closed_form: Sensitivity,
    exact: Sensitivity,
}

/// The figure and the trends.
///
/// # Errors
/// One line if a shape on the way is impossible or does not glide.
pub fn reproduce(vehicle: &Vehicle) -> Result<Reproduction, String> {
    let mut turning = Vec::new();
    let mut caveat = Vec::new();
    let mut trends = Vec::new();
    for sweep in &SWEEPS {
        let points = sweep.points(vehicle, Anchoring::Anchored)?;
        turning.push(sweep.panel(&points));
        caveat.push(sweep.caveat(&points));
        let mut readings = sweep.readings(&points, "anchored");
        readings.extend(sweep.readings(&sweep.points(vehicle, Anchoring::Unanchored)?, "from geometry alone"));
        trends.push(Trend { place: "4.2.2, 6 (fig11)".into(), says: sweep.says.into(), readings });
    }
    let title =
        "Fig 11  Per rad/s of turn rate, at γ −35° and 0.77 m/s; below, the turn rate's error per error in roll";
    let panels = turning.into_iter().chain(caveat).collect();
    let figure = Figure { title: title.into(), columns: 3, panels };
    Ok(Reproduction { figures: vec![("fig11".to_owned(), figure)], rows: Vec::new(), trends })
}

impl Sweep {
    fn points(&self, vehicle: &Vehicle, anchoring: Anchoring) -> Result<Vec<Point>, String> {
        let study = Study { anchoring, ..Study::new(vehicle) };
        let lift_coefficient = glide(vehicle, CONDITION, SCALE)?.lift_coefficient;
        let [from, to] = self.range;
        let points = (0..POINTS).map(|i| {
            let value = from + (to - from) * i as f64 / (POINTS - 1) as f64;
            let changed = self.varied.vehicle(&study, value, lift_coefficient)?;
            let level = glide(&changed, CONDITION, SCALE)?;
            let ways = Turns::new(&changed, &level)?.sensitivities(&level);
            let undefined = Sensitivity { mu_s: f64::NAN, phi_s: f64::NAN, beta_s: f64::NAN };
            let exact = ways.numeric.unwrap_or(undefined);
            Ok(Point { value, closed_form: equations_14_to_16(&changed, &level), exact })
        });
        points.collect()
    }

    /// Values of the parameter between which the required bank goes through infinity: there the control reverses.
    fn pole(points: &[Point]) -> Option<f64> {
        let jumps = |pair: &&[Point]| {
            let [a, b] = [pair[0].exact.phi_s, pair[1].exact.phi_s];
            a * b < 0.0 && a.abs().min(b.abs()) > 1.0
        };
        points.windows(2).find(jumps).map(|pair| 0.5 * (pair[0].value + pair[1].value))
    }

    fn panel(&self, points: &[Point]) -> Panel {
        let quantities: [(&str, Part); 3] = [("μ₁", |s| s.mu_s), ("φ₁", |s| s.phi_s), ("β₁ × 10", |s| 10.0 * s.beta_s)];
        let mut lines = Vec::new();
        for (colour, (name, quantity)) in quantities.into_iter().enumerate() {
            let exact = points.iter().map(|point| [point.value, quantity(&point.exact)]).collect();
            let closed = points.iter().map(|point| [point.value, quantity(&point.closed_form)]).collect();
            lines.push((format!("{name}, full equations"), Stroke::Solid(colour), exact));
            lines.push((format!("{name}, eqs (14)–(16)"), Stroke::Dashed(colour), closed));
        }
        self.broken(self.panel.into(), "s", lines, points)
    }

    /// dΩ/dφ = 1/φ₁.
    fn caveat(&self, points: &[Point]) -> Panel {
        let line = points.iter().map(|point| [point.value, 1.0 / point.exact.phi_s]).collect();
        let title = format!("{}: error of the turn rate per error in roll", self.panel);
        self.broken(title, "1/s", vec![("1/φ₁".to_owned(), Stroke::Solid(1), line)], &[])
    }

    /// A panel whose lines break at the pole, which is marked.
    fn broken(
        &self,
        title: String,
        unit: &str,
        lines: Vec<(String, Stroke, Vec<[f64; 2]>)>,
        points: &[Point],
    ) -> Panel {
        let mut sizes: Vec<f64> =
            lines.iter().flat_map(|(_, _, line)| line.iter().map(|point| point[1].abs())).collect();
        sizes.sort_by(f64::total_cmp);
        let shown = SHOWN * sizes.get(sizes.len() / 2).copied().unwrap_or(1.0);
        let largest = sizes.last().copied().unwrap_or(1.0).min(shown) * 1.1;
        let pole = Self::pole(points);
        let cut = |(name, stroke, line): (String, Stroke, Vec<[f64; 2]>)| Line {
            name: Some(name),
            stroke,
            points: broken_at_poles(line, largest),
        };
        let mut panel = Panel {
            title,
            x: Axis::exactly(self.axis, self.range),
            y: Axis::exactly(unit, [-largest, largest]),
            lines: lines.into_iter().map(cut).collect(),
            places: Vec::new(),
        };
        if let Some(pole) = pole {
            panel.lines.push(Line { name: None, stroke: Stroke::Aid, points: vec![[pole, -largest], [pole, largest]] });
            let notes = [(0.88, format!("pole {pole:.3}")), (0.78, "control reversal".to_owned())];
            panel.places.extend(notes.map(|(height, note)| Place {
                at: [pole + 0.13 * (self.range[1] - self.range[0]), height * largest],
                mark: Mark::Note(note),
            }));
        }
        panel
    }

    /// Over the whole range, and only beyond the pole if there is one.
    fn readings(&self, points: &[Point], held: &str) -> Vec<Reading> {
        let over = |points: &[Point], part: &str| {
            let (first, last) = (points.first()?, points.last()?);
            let [more, less] = if self.end_takes_less { [first, last] } else { [last, first] };
            let sizes = |point: &Point| [point.exact.mu_s.abs(), point.exact.phi_s.abs()];
            let ([mu_more, phi_more], [mu_less, phi_less]) = (sizes(more), sizes(less));
            Some(Reading {
                reading: format!("{held}, {} from {:.3} to {:.3}{part}", self.axis, first.value, last.value),
                holds: mu_less < mu_more && phi_less < phi_more,
                found: format!(
                    "at {:.3}: |μ₁| {mu_more:.1} s, |φ₁| {phi_more:.1} s; at {:.3}: {mu_less:.1} s, {phi_less:.1} s",
                    more.value, less.value
                ),
            })
        };
        let beyond = Self::pole(points).map(|pole| points.partition_point(|point| point.value < pole));
        let parts =
            [over(points, ""), beyond.and_then(|first| over(points.get(first..)?, ", beyond the control reversal"))];
        parts.into_iter().flatten().collect()
    }
}

/// A line without the strokes that would join the two sides of a pole: points beyond the axis on opposite sides.
fn broken_at_poles(line: Vec<[f64; 2]>, largest: f64) -> Vec<[f64; 2]> {
    let mut broken: Vec<[f64; 2]> = Vec::with_capacity(line.len());
    for point in line {
        if let Some(before) = broken.last().copied()
            && before[1] * point[1] < 0.0
            && before[1].abs().min(point[1].abs()) > largest
        {
            broken.push([0.5 * (before[0] + point[0]), f64::NAN]);
        }
        broken.push(point);
    }
    broken
}
