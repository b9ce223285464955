//! What range costs in agility: the longest range at each least turn rate, between the two extremes.

use serde::Serialize;

use super::{
    Candidate, Constraint, Maker, Objective, placed,
    search::{Found, MET, Search},
};
use crate::pages::chart::{Figure, Line, Mark, Panel, Place, Scale, Stroke};

/// Geometries of which none is better in both.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Front {
    /// By growing turn rate.
    pub points: Vec<FrontPoint>,
}

/// One of them.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FrontPoint {
    /// What it is judged by.
    #[serde(flatten)]
    pub candidate: Candidate,
    /// Its geometry.
    pub parameters: Vec<(&'static str, f64)>,
}

/// The front, from the best geometry found; none where no other turns faster.
pub(super) fn front(maker: &Maker<'_>, constraints: &[Constraint], best: &Found) -> Option<Front> {
    let asked = |least_deg_s: f64| {
        let new = Constraint::turn_rate(least_deg_s);
        let others = constraints.iter().filter(|constraint| !constraint.is_like(&new)).cloned();
        others.chain([new.clone()]).collect::<Vec<_>>()
    };
    let start = [best.place.clone()];
    let fastest = Search { maker, objective: Some(Objective::TurnRate), constraints }.run(&start)?;
    let without: Vec<_> = asked(0.0).into_iter().rev().skip(1).collect();
    let farthest = Search { maker, objective: Some(Objective::Range), constraints: &without }.run(&start)?;
    let turn = |found: &Found| found.candidate.turn_rate_rad_s.to_degrees();
    let [slow, fast] = [turn(&farthest), turn(&fastest)];
    let last = maker.spec.front_points.saturating_sub(1).max(1);
    let mut found = vec![farthest];
    for step in 1..last {
        let constraints = asked(slow + (fast - slow) * step as f64 / last as f64);
        let search = Search { maker, objective: Some(Objective::Range), constraints: &constraints };
        let near = found.last().map_or_else(|| fastest.place.clone(), |found| found.place.clone());
        found.extend(search.run_from(&[near, fastest.place.clone()]).filter(|found| found.shortfall <= MET));
    }
    found.push(fastest);
    let points = undominated(&found.into_iter().map(|found| found.candidate).collect::<Vec<_>>());
    let point = |candidate: Candidate| FrontPoint {
        parameters: placed(maker.spec, &candidate).iter().map(|placed| (placed.parameter, placed.value)).collect(),
        candidate,
    };
    Some(Front { points: points.into_iter().map(point).collect() })
}

/// Those that no other one beats in both, by growing turn rate.
fn undominated(all: &[Candidate]) -> Vec<Candidate> {
    let figures = |candidate: &Candidate| [candidate.range_m, candidate.turn_rate_rad_s];
    let beats = |a: &Candidate, b: &Candidate| {
        let ([a, b], [c, d]) = (figures(a), figures(b));
        a >= c && b >= d && (a > c || b > d)
    };
    let mut kept: Vec<Candidate> =
        all.iter().filter(|one| !all.iter().any(|other| beats(other, one))).cloned().collect();
    kept.sort_by(|a, b| a.turn_rate_rad_s.total_cmp(&b.turn_rate_rad_s));
    kept.dedup_by(|a, b| figures(a) == figures(b));
    kept
}

impl Front {
    /// Range over turn rate, and how the geometry changes along it: each parameter as a share of its bounds.
    #[must_use]
    pub fn figure(&self, title: &str, bounds: &[(&'static str, [f64; 2])]) -> Figure {
        let turn = |point: &FrontPoint| point.candidate.turn_rate_rad_s.to_degrees();
        let points: Vec<[f64; 2]> =
            self.points.iter().map(|point| [turn(point), point.candidate.range_m / 1e3]).collect();
        let front = Panel {
            title: "Range against agility".into(),
            x: Scale::around("turn rate, °/s"),
            y: Scale::around("ideal range, km"),
            places: points.iter().map(|at| Place { at: *at, mark: Mark::Point }).collect(),
            lines: vec![Line { name: Some("front".into()), stroke: Stroke::Solid(0), points }],
        };
        let line = |(place, (parameter, [least, most])): (usize, &(&'static str, [f64; 2]))| Line {
            name: Some((*parameter).into()),
            stroke: if place < 7 { Stroke::Solid(place) } else { Stroke::Dashed(place) },
            points: self
                .points
                .iter()
                .filter_map(|point| {
                    let (_, value) = point.parameters.get(place)?;
                    Some([turn(point), (value - least) / (most - least)])
                })
                .collect(),
        };
        let geometry = Panel {
            title: "Geometry along it".into(),
            x: Scale::around("turn rate, °/s"),
            y: Scale::exactly("place between its bounds", [-0.05, 1.05]),
            lines: bounds.iter().enumerate().map(line).collect(),
            places: Vec::new(),
        };
        Figure { title: title.into(), columns: 2, panels: vec![front, geometry] }
    }

    /// One row per point.
    ///
    /// # Errors
    /// As the writer.
    pub fn write_csv(&self, out: &mut dyn std::io::Write) -> std::io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let parameters = self.points.first().map_or(&[][..], |point| &point.parameters);
        let keys = parameters.iter().map(|(key, _)| *key);
        csv.write_record(["turn_rate_rad_s", "range_m", "speed_m_s", "lift_to_drag"].into_iter().chain(keys))?;
        for FrontPoint { candidate, parameters } in &self.points {
            let size = &candidate.size;
            let figures = [candidate.turn_rate_rad_s, candidate.range_m, size.speed_m_s, size.glide.lift_to_drag];
            let values = parameters.iter().map(|(_, value)| *value);
            csv.write_record(figures.into_iter().chain(values).map(|value| value.to_string()))?;
        }
        csv.flush()
    }
}
