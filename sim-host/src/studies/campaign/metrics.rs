//! What a flight is judged by: one function per figure, over its record. Less is better in all of them.

use shared::{commands::Phase, math::wrap_cdeg, mission::Mission};

use crate::flight::{
    Summary, TICK_S,
    record::{Record, Sample},
};
use crate::pages::report::figures::{self, ON_HEADING_DEG, heading_error_deg};

/// Time after an inflection or a turn's entry from which a leg counts as steady, s.
const STEADY_AFTER_S: f64 = 120.0;
/// Depth at which a dive has left the surface, and may turn, m.
const SUBMERGED_M: f64 = 2.0;
/// Pitch error within which an inflection counts as over, deg.
const SETTLED_PITCH_DEG: f64 = 2.0;
/// A value that stays within its band for so long has settled, s.
const STAYS_S: f64 = 60.0;

/// Everything that is known of a flight.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// What was to be flown.
    pub mission: &'a Mission,
    /// What was flown.
    pub record: &'a Record,
    /// What came of it.
    pub summary: &'a Summary,
}

/// One figure.
#[derive(Clone, Copy, Debug)]
pub struct Metric {
    /// Its name with its unit: the column of the table.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
    /// How to get it; nothing where the flight did not come to it.
    pub of: fn(&Seen<'_>) -> Option<f64>,
}

const fn metric(name: &'static str, about: &'static str, of: fn(&Seen<'_>) -> Option<f64>) -> Metric {
    Metric { name, about, of }
}

/// Every figure, in order.
pub const METRICS: &[Metric] = &[
    metric("apogee_over_percent", "apogee below its target, worst yo, of the target depth", |s| {
        apogee_error_percent(s).map(|error| error.max(0.0)).reduce(f64::max)
    }),
    metric("apogee_under_percent", "apogee above its target, worst yo, of the target depth", |s| {
        apogee_error_percent(s).map(|error| (-error).max(0.0)).reduce(f64::max)
    }),
    metric(
        "pitch_settling_s",
        "from a reversal's end until pitch is within 2° for a minute, slowest glide",
        pitch_settling_s,
    ),
    metric(
        "turn_settling_s",
        "from a turn's entry until heading is within 5° for a minute, slowest turn",
        turn_settling_s,
    ),
    metric(
        "heading_rms_deg",
        "true heading against its target on steady glides, 120 s after they began or left the surface",
        heading_rms_deg,
    ),
    metric(
        "compass_rms_deg",
        "heading that the compass shows against its target on steady glides: without the compass' deviation",
        compass_rms_deg,
    ),
    metric(
        "path_angle_rms_deg",
        "path angle through the water against its target on steady glides",
        path_angle_rms_deg,
    ),
    metric("pump_moves_per_km", "starts of pump or bleed per km over ground", |s| {
        per_km(s, moves(s, |sample| sample.commands.vbd_rate_ul_s))
    }),
    metric("pitch_moves_per_km", "starts of the axial drive", |s| {
        per_km(s, moves(s, |sample| sample.commands.r_px_rate_um_s))
    }),
    metric("roll_moves_per_km", "starts of the rotation drive", |s| {
        per_km(s, moves(s, |sample| sample.commands.mu_rate_cdeg_s.into()))
    }),
    metric("pump_j_per_km", "energy of pump and bleed per km over ground", |s| per_km(s, s.summary.energy_j.pump)),
    metric("pitch_j_per_km", "energy of the axial drive", |s| per_km(s, s.summary.energy_j.pitch)),
    metric("roll_j_per_km", "energy of the rotation drive", |s| per_km(s, s.summary.energy_j.roll)),
    metric("hotel_j_per_km", "energy of everything else", |s| per_km(s, s.summary.energy_j.hotel)),
    metric("energy_j_per_km", "energy of all together", |s| per_km(s, s.summary.energy_j.total())),
    metric(
        "surfacing_error_percent",
        "where it came up last against where it expected to, of its way over ground since the fix before that dive",
        surfacing_error_percent,
    ),
    metric("surface_drift_m", "way over ground at the surface before its last dive", |s| Some(surface_drift_m(s))),
];

/// Depth error of each apogee, % of the target depth, too deep positive.
fn apogee_error_percent(seen: &Seen<'_>) -> impl Iterator<Item = f64> {
    let target_m = f64::from(seen.mission.dive_to_mm) / 1e3;
    let dives = figures::legs(seen.record).into_iter().filter(|leg| !leg.climbing);
    dives.map(move |leg| 100.0 * (leg.turning_depth_m / target_m - 1.0))
}

/// The glides, one after another: from the end of one reversal, or from the surface, to the begin of the next.
fn glides<'a>(seen: &Seen<'a>) -> impl Iterator<Item = &'a [Sample]> {
    let same = |a: &Sample, b: &Sample| (a.commands.phase, a.commands.yo) == (b.commands.phase, b.commands.yo);
    let is_glide = |samples: &&[Sample]| {
        samples.first().is_some_and(|first| matches!(first.commands.phase, Phase::Dive | Phase::Climb))
    };
    seen.record.samples.chunk_by(same).filter(is_glide).map(submerged)
}

/// A glide from where it left the surface: until then a heavy vehicle only waits for the water to take it.
fn submerged(glide: &[Sample]) -> &[Sample] {
    let left = glide.iter().position(|sample| sample.truth.position_m.z >= SUBMERGED_M);
    glide.get(left.unwrap_or(glide.len())..).unwrap_or_default()
}

/// The steady part of a glide.
fn steady(glide: &[Sample]) -> &[Sample] {
    glide.get((STEADY_AFTER_S / TICK_S) as usize..).unwrap_or_default()
}

/// Time until a value is within its band and stays there, s; nothing if it never does.
fn settling_s(glide: &[Sample], is_within: impl Fn(&Sample) -> bool) -> Option<f64> {
    let stays = (STAYS_S / TICK_S) as usize;
    let mut since = 0;
    for (index, sample) in glide.iter().enumerate() {
        if !is_within(sample) {
            since = index + 1;
        } else if index - since >= stays {
            return Some(since as f64 * TICK_S);
        }
    }
    None
}

/// The slowest; a glide that never settled took all its time.
fn slowest_s<'a>(glides: impl Iterator<Item = &'a [Sample]>, is_within: impl Fn(&Sample) -> bool) -> Option<f64> {
    let took_s = |glide: &[Sample]| settling_s(glide, &is_within).unwrap_or(glide.len() as f64 * TICK_S);
    glides.map(took_s).reduce(f64::max)
}

fn pitch_settling_s(seen: &Seen<'_>) -> Option<f64> {
    slowest_s(glides(seen), |sample| {
        let target_deg = f64::from(sample.commands.target_pitch_cdeg) / 100.0;
        (sample.truth.euler_rad.y.to_degrees() - target_deg).abs() <= SETTLED_PITCH_DEG
    })
}

fn turn_settling_s(seen: &Seen<'_>) -> Option<f64> {
    let target_cdeg = |glide: &[Sample]| glide.first().map(|first| first.commands.target_heading_cdeg);
    let mut before_cdeg = Some((seen.record.start.heading_deg * 100.0) as u16);
    let turns = glides(seen).filter(|glide| {
        let turned = target_cdeg(glide) != before_cdeg;
        before_cdeg = target_cdeg(glide);
        turned
    });
    slowest_s(turns, |sample| heading_error_deg(sample).abs() <= ON_HEADING_DEG)
}

/// Root mean square of an error over all steady samples that have it.
fn steady_rms(seen: &Seen<'_>, error: impl Fn(&Sample) -> Option<f64>) -> Option<f64> {
    let (mut squares, mut count) = (0.0, 0_u32);
    for error in glides(seen).flat_map(steady).filter_map(error) {
        squares += error.powi(2);
        count += 1;
    }
    (count > 0).then(|| (squares / f64::from(count)).sqrt())
}

fn heading_rms_deg(seen: &Seen<'_>) -> Option<f64> {
    steady_rms(seen, |sample| Some(heading_error_deg(sample)))
}

fn compass_rms_deg(seen: &Seen<'_>) -> Option<f64> {
    steady_rms(seen, |sample| {
        let target_cdeg = i32::from(sample.commands.target_heading_cdeg);
        let attitude = sample.measurements.attitude?;
        Some(f64::from(wrap_cdeg(target_cdeg - i32::from(attitude.heading_cdeg))) / 100.0)
    })
}

fn path_angle_rms_deg(seen: &Seen<'_>) -> Option<f64> {
    steady_rms(seen, |sample| {
        let diving = sample.commands.phase == Phase::Dive;
        let mission = seen.mission;
        let target_cdeg = if diving { mission.dive_path_angle_cdeg } else { mission.climb_path_angle_cdeg };
        Some(sample.truth.path_angle_rad().to_degrees() - f64::from(target_cdeg) / 100.0)
    })
}

fn moves(seen: &Seen<'_>, rate: impl Fn(&Sample) -> i32) -> f64 {
    figures::moves(seen.record, rate).count.into()
}

/// Horizontal way over ground on all dives, m.
fn way_m(seen: &Seen<'_>) -> f64 {
    way_over_ground_m(&seen.record.samples, under_way)
}

/// From the beginning of a dive until the vehicle is afloat.
fn under_way(sample: &Sample) -> bool {
    !matches!(sample.commands.phase, Phase::Surface | Phase::Complete)
}

/// Horizontal way over ground in the steps that start from such samples, m.
fn way_over_ground_m(samples: &[Sample], counts: impl Fn(&Sample) -> bool) -> f64 {
    let steps = samples.array_windows().filter(|[from, _]| counts(from));
    steps.map(|[from, to]| (to.truth.position_m - from.truth.position_m).xy().norm()).sum()
}

fn per_km(seen: &Seen<'_>, value: f64) -> Option<f64> {
    let way_m = way_m(seen);
    (way_m > 0.0).then(|| 1e3 * value / way_m)
}

/// The flight before its last dive, and from there on.
fn last_dive<'a>(seen: &Seen<'a>) -> (&'a [Sample], &'a [Sample]) {
    let samples = &seen.record.samples;
    let afloat = samples.iter().rposition(|sample| sample.commands.phase == Phase::Surface);
    samples.split_at(afloat.map_or(0, |last| last + 1))
}

fn surfacing_error_percent(seen: &Seen<'_>) -> Option<f64> {
    let surfacing = seen.summary.surfacing;
    let (predicted, actual) = (surfacing.predicted?, surfacing.actual?);
    let miss_m = (predicted.north_m - actual.north_m).hypot(predicted.east_m - actual.east_m);
    let way_m = way_over_ground_m(last_dive(seen).1, under_way);
    (way_m > 0.0).then(|| 100.0 * miss_m / way_m)
}

fn surface_drift_m(seen: &Seen<'_>) -> f64 {
    let (before, _) = last_dive(seen);
    let came_up = before.iter().rposition(under_way).map_or(0, |last| last + 1);
    way_over_ground_m(before.get(came_up..).unwrap_or_default(), |_| true)
}
