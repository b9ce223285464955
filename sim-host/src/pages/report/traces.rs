//! What is plotted over time.

use shared::{
    commands::Phase,
    device::{RAD_PER_CDEG, UL_PER_M3, UM_PER_M},
};

use crate::flight::record::{Record, Sample};
use crate::pages::chart::plot::{Axis, Band, Curve, Plot};

/// Depth above which speed and angle of attack say nothing about gliding, m.
const GLIDING_DEPTH_M: f64 = 4.0;
/// Shortest time axis, min.
const SHORTEST_MIN: f64 = 0.1;
/// Marks on the time axis, about.
const TIME_MARKS: f64 = 10.0;
/// Marks on an upright axis, about.
pub(super) const MARKS: f64 = 5.0;

/// Consumers of energy, the lowermost of the stack first: style and name, and the energy used so far, J.
const CONSUMERS: [Consumer; 4] = [
    ("hotel", |s| s.energy_j.hotel),
    ("pump", |s| s.energy_j.pump),
    ("pitch", |s| s.energy_j.pitch),
    ("roll", |s| s.energy_j.roll),
];

type Consumer = (&'static str, fn(&Sample) -> f64);

/// One plot over time, with its title and its key.
pub(super) struct Trace {
    pub(super) title: &'static str,
    pub(super) unit: &'static str,
    /// Style and meaning of each curve.
    pub(super) key: Vec<(&'static str, String)>,
    pub(super) plot: Plot,
    pub(super) tall: bool,
}

/// Ranges of the mission that its depth is drawn against, m.
pub(super) struct DepthTargets {
    pub(super) dive_to_m: f64,
    pub(super) climb_to_m: f64,
}

/// A flight's samples, turned into curves over minutes.
pub(super) struct Traces<'a> {
    record: &'a Record,
    level: Axis,
    bands: Vec<Band>,
}

impl<'a> Traces<'a> {
    pub(super) fn new(record: &'a Record) -> Self {
        let end_min = record.samples.last().map_or(0.0, minutes).max(SHORTEST_MIN);
        Self { record, level: Axis::exactly(0.0, end_min, TIME_MARKS), bands: bands(record) }
    }

    /// Whether any phase is drawn in a style.
    pub(super) fn has_band(&self, class: &str) -> bool {
        self.bands.iter().any(|band| band.class == class)
    }

    /// All of them, in the order of the report.
    pub(super) fn all(&self, targets: &DepthTargets) -> Vec<Trace> {
        let mut all = vec![
            self.depth(targets),
            self.pitch(),
            self.heading(),
            self.roll(),
            self.speed(),
            self.alpha(),
            self.mass_position(),
            self.mass_rotation(),
            self.buoyancy(),
            self.energy(),
        ];
        all.extend(self.surroundings());
        all
    }

    pub(super) fn depth(&self, targets: &DepthTargets) -> Trace {
        let measured = self.curve("measured", |s| {
            let pressure_pa = f64::from(s.measurements.pressure_pa?);
            Some(pressure_pa / (self.record.water.density_kg_m3 * self.record.water.gravity_m_s2))
        });
        let limit =
            |depth_m: f64| Curve { class: "limit", points: vec![[self.level.min, depth_m], [self.level.max, depth_m]] };
        let curves = vec![limit(targets.dive_to_m), limit(targets.climb_to_m), measured];
        let axis = Axis::from_zero(values(&curves), 1.0, MARKS).downwards();
        let key = vec![("measured", "measured".into()), ("limit", "the mission's depths".into())];
        Trace { tall: true, ..self.trace("Depth", "m", key, axis, curves) }
    }

    pub(super) fn pitch(&self) -> Trace {
        self.angle(
            "Pitch",
            2.0,
            |s| Some(degrees(s.measurements.attitude?.pitch_cdeg)),
            |s| Some(degrees(s.commands.target_pitch_cdeg)),
        )
    }

    pub(super) fn heading(&self) -> Trace {
        let mut measured = Curve { class: "measured", points: Vec::new() };
        let mut target = Curve { class: "target", points: Vec::new() };
        let aimed = |s: &Sample| s.commands.target_heading_cdeg;
        for leg in self.record.samples.chunk_by(|a, b| aimed(a) == aimed(b)) {
            let mut flown = measured.points.last().map_or(0.0, |[_, heading]| *heading);
            for sample in leg {
                if let Some(attitude) = sample.measurements.attitude {
                    flown = nearest_turn(degrees(attitude.heading_cdeg), flown);
                    measured.points.push([minutes(sample), flown]);
                }
            }
            // A target stands on the turn on which it is reached.
            target.points.extend(leg.iter().map(|s| [minutes(s), nearest_turn(degrees(aimed(s)), flown)]));
        }
        let curves = vec![measured, target];
        let axis = Axis::around_directions(values(&curves), 10.0, MARKS);
        let key = vec![("measured", "measured".into()), ("target", "target".into())];
        self.trace("Heading", "° from true north", key, axis, curves)
    }

    fn roll(&self) -> Trace {
        let curves = vec![self.curve("measured", |s| Some(degrees(s.measurements.attitude?.roll_cdeg)))];
        let axis = Axis::around(values(&curves), 4.0, MARKS);
        self.trace("Roll", "°, right wing down positive", vec![("measured", "measured".into())], axis, curves)
    }

    fn speed(&self) -> Trace {
        let curves = vec![self.curve("true", |s| Some(under_water(s, s.truth.speed_m_s())))];
        let axis = Axis::from_zero(values(&curves), 0.1, MARKS);
        self.trace("Speed", "m/s", vec![("true", "true, under water".into())], axis, curves)
    }

    fn alpha(&self) -> Trace {
        let curves = vec![self.curve("true", |s| Some(under_water(s, s.truth.alpha_rad().to_degrees())))];
        let axis = Axis::around(values(&curves), 2.0, MARKS);
        self.trace("Angle of attack", "°", vec![("true", "true, under water".into())], axis, curves)
    }

    fn mass_position(&self) -> Trace {
        let curves =
            vec![self.curve("measured", |s| Some(1e3 * f64::from(s.measurements.r_px_um) / f64::from(UM_PER_M)))];
        let axis = Axis::around(values(&curves), 10.0, MARKS);
        self.trace(
            "Moving mass, axial position",
            "mm, forward positive",
            vec![("measured", "measured".into())],
            axis,
            curves,
        )
    }

    fn mass_rotation(&self) -> Trace {
        let curves = vec![self.curve("measured", |s| Some(degrees(s.measurements.mu_cdeg)))];
        let axis = Axis::around(values(&curves), 10.0, MARKS);
        self.trace("Moving mass, rotation", "°, left positive", vec![("measured", "measured".into())], axis, curves)
    }

    fn buoyancy(&self) -> Trace {
        let curves =
            vec![self.curve("measured", |s| Some(1e6 * f64::from(s.measurements.vbd_ul) / f64::from(UL_PER_M3)))];
        let axis = Axis::around(values(&curves), 10.0, MARKS);
        self.trace("Buoyancy engine", "mL beyond neutral", vec![("measured", "measured".into())], axis, curves)
    }

    /// Stacked: hotel below, then pump, axial drive and rotation drive.
    pub(super) fn energy(&self) -> Trace {
        let last = self.record.samples.last();
        let key = CONSUMERS
            .iter()
            .map(|(name, used)| (*name, format!("{name} {:.2} kJ", 1e-3 * last.map_or(0.0, used))))
            .collect();
        let areas: Vec<_> = (1..=CONSUMERS.len())
            .rev()
            .map(|count| {
                let stacked =
                    |s: &Sample| Some(1e-3 * CONSUMERS.iter().take(count).map(|(_, used)| used(s)).sum::<f64>());
                self.curve(CONSUMERS[count - 1].0, stacked)
            })
            .collect();
        let axis = Axis::from_zero(values(&areas), 0.01, MARKS);
        let mut trace = self.trace("Energy used", "kJ", key, axis, Vec::new());
        trace.plot.areas = areas;
        trace.plot.bands = Vec::new();
        Trace { tall: true, ..trace }
    }

    fn angle(
        &self,
        title: &'static str,
        least_width: f64,
        measured: impl Fn(&Sample) -> Option<f64>,
        target: impl Fn(&Sample) -> Option<f64>,
    ) -> Trace {
        let curves = vec![self.curve("measured", measured), self.curve("target", target)];
        let axis = Axis::around(values(&curves), least_width, MARKS);
        let key = vec![("measured", "measured".into()), ("target", "target".into())];
        self.trace(title, "°", key, axis, curves)
    }

    pub(super) fn trace(
        &self,
        title: &'static str,
        unit: &'static str,
        key: Vec<(&'static str, String)>,
        upright: Axis,
        curves: Vec<Curve>,
    ) -> Trace {
        let plot = Plot {
            level: self.level.clone(),
            upright,
            bands: self.bands.clone(),
            areas: Vec::new(),
            curves,
            spots: Vec::new(),
        };
        Trace { title, unit, key, plot, tall: false }
    }

    /// One point per sample that has a value; not a number breaks the curve.
    pub(super) fn curve(&self, class: &'static str, value: impl Fn(&Sample) -> Option<f64>) -> Curve {
        let points = self.record.samples.iter().filter_map(|s| Some([minutes(s), value(s)?])).collect();
        Curve { class, points }
    }
}

/// Style of a phase's band.
const fn phase_class(phase: Phase) -> &'static str {
    match phase {
        Phase::Surface | Phase::Complete => "surface",
        Phase::Dive => "dive",
        Phase::Apogee | Phase::Crest => "turn",
        Phase::Drift => "drift",
        Phase::Climb | Phase::Surfacing => "climb",
        Phase::Recovery => "recovery",
    }
}

fn bands(record: &Record) -> Vec<Band> {
    let class = |sample: &Sample| phase_class(sample.commands.phase);
    let mut bands: Vec<Band> = record
        .samples
        .chunk_by(|a, b| class(a) == class(b))
        .filter_map(|chunk| {
            let (first, last) = (chunk.first()?, chunk.last()?);
            Some(Band { class: class(first), from: minutes(first), to: minutes(last) })
        })
        .collect();
    // Each band reaches to the next.
    for index in 1..bands.len() {
        bands[index - 1].to = bands[index].from;
    }
    bands
}

fn minutes(sample: &Sample) -> f64 {
    sample.time_s() / 60.0
}

/// A value that means something only in a glide.
fn under_water(sample: &Sample, value: f64) -> f64 {
    if sample.truth.position_m.z > GLIDING_DEPTH_M { value } else { f64::NAN }
}

fn degrees(cdeg: impl Into<f64>) -> f64 {
    (cdeg.into() * f64::from(RAD_PER_CDEG)).to_degrees()
}

pub(super) fn values(curves: &[Curve]) -> impl Iterator<Item = f64> {
    curves.iter().flat_map(|curve| curve.points.iter().map(|[_, y]| *y))
}

/// The same direction, by whole turns as near to another as can be.
fn nearest_turn(direction_deg: f64, other_deg: f64) -> f64 {
    direction_deg - 360.0 * ((direction_deg - other_deg) / 360.0).round()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_cross_north_without_a_jump() {
        assert_eq!(nearest_turn(2.0, 358.0), 362.0);
        assert_eq!(nearest_turn(358.0, 362.0), 358.0);
        assert_eq!(nearest_turn(350.0, 3.0), -10.0);
    }
}
