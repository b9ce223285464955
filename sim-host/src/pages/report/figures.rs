//! The figures of a dive: what each leg, each drive and the navigation came to.

use shared::commands::Phase;

use crate::flight::record::{Record, Sample};

/// Heading error at which a leg counts as on its heading, deg.
pub const ON_HEADING_DEG: f64 = 5.0;

/// One dive or one climb, with the reversal that ends it.
#[derive(Clone, Debug, PartialEq)]
pub struct Leg {
    /// The yo it belongs to, from 1.
    pub yo: u16,
    /// A climb, not a dive.
    pub climbing: bool,
    /// From its first to its last tick, s.
    pub duration_s: f64,
    /// Greatest depth of a dive, least depth of a climb, m.
    pub turning_depth_m: f64,
    /// Mean vertical speed, m/s, down positive.
    pub vertical_speed_m_s: f64,
    /// Mean horizontal speed, m/s.
    pub horizontal_speed_m_s: f64,
    /// Heading aimed at until the reversal, deg.
    pub target_heading_deg: f64,
    /// Time until the heading was first within [`ON_HEADING_DEG`], s.
    pub on_heading_after_s: Option<f64>,
    /// Root mean square of the heading error from then until the reversal, deg.
    pub heading_rms_deg: Option<f64>,
}

/// What one drive did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moves {
    /// Runs from standstill to standstill.
    pub count: u32,
    /// Ticks under way.
    pub ticks: u32,
}

/// The legs of a flight, in order.
#[must_use]
pub fn legs(record: &Record) -> Vec<Leg> {
    let leg_of = |sample: &Sample| match sample.commands.phase {
        Phase::Dive | Phase::Drift | Phase::Apogee => Some((sample.commands.yo, false)),
        Phase::Climb | Phase::Crest | Phase::Surfacing => Some((sample.commands.yo, true)),
        Phase::Surface | Phase::Complete | Phase::Recovery => None,
    };
    let chunks: Vec<&[Sample]> = record.samples.chunk_by(|a, b| leg_of(a) == leg_of(b)).collect();
    let following = chunks.iter().skip(1).copied().chain([&[][..]]);
    chunks
        .iter()
        .zip(following)
        .filter_map(|(samples, next)| {
            let (yo, climbing) = leg_of(samples.first()?)?;
            leg(yo, climbing, samples, next)
        })
        .collect()
}

/// One leg from its samples; it turns only in the `next` one's first seconds, since a vehicle does not stop at once.
fn leg(yo: u16, climbing: bool, samples: &[Sample], next: &[Sample]) -> Option<Leg> {
    let (first, last) = (samples.first()?, samples.last()?);
    let duration_s = last.time_s() - first.time_s();
    if duration_s <= 0.0 {
        return None;
    }
    let depths = samples.iter().chain(next).map(|sample| sample.truth.position_m.z);
    let turning_depth_m = if climbing { depths.fold(f64::MAX, f64::min) } else { depths.fold(f64::MIN, f64::max) };
    let way_m: f64 =
        samples.windows(2).map(|pair| (pair[1].truth.position_m - pair[0].truth.position_m).xy().norm()).sum();
    let glide = samples.chunk_by(|a, b| a.commands.phase == b.commands.phase).next()?;
    let on_heading = glide.iter().position(is_on_heading);
    Some(Leg {
        yo,
        climbing,
        duration_s,
        turning_depth_m,
        vertical_speed_m_s: (last.truth.position_m.z - first.truth.position_m.z) / duration_s,
        horizontal_speed_m_s: way_m / duration_s,
        target_heading_deg: f64::from(glide.last()?.commands.target_heading_cdeg) / 100.0,
        on_heading_after_s: on_heading.map(|index| glide[index].time_s() - first.time_s()),
        heading_rms_deg: on_heading.map(|index| heading_rms_deg(&glide[index..])),
    })
}

/// Root mean square of the heading error on one yo, from its first entry into [`ON_HEADING_DEG`] on, deg.
#[must_use]
pub fn yo_heading_rms_deg(record: &Record, yo: u16) -> Option<f64> {
    let under_way = |sample: &&Sample| {
        sample.commands.yo == yo && !matches!(sample.commands.phase, Phase::Surface | Phase::Complete | Phase::Recovery)
    };
    let samples: Vec<Sample> =
        record.samples.iter().filter(under_way).skip_while(|sample| !is_on_heading(sample)).copied().collect();
    (!samples.is_empty()).then(|| heading_rms_deg(&samples))
}

fn heading_rms_deg(samples: &[Sample]) -> f64 {
    let squares: f64 = samples.iter().map(|sample| heading_error_deg(sample).powi(2)).sum();
    (squares / samples.len() as f64).sqrt()
}

fn is_on_heading(sample: &Sample) -> bool {
    heading_error_deg(sample).abs() <= ON_HEADING_DEG
}

/// True heading minus the one aimed at, deg, −180 to 180.
#[must_use]
pub fn heading_error_deg(sample: &Sample) -> f64 {
    let target_deg = f64::from(sample.commands.target_heading_cdeg) / 100.0;
    (sample.truth.euler_rad.z.to_degrees() - target_deg + 180.0).rem_euclid(360.0) - 180.0
}

/// How often and how long a drive ran; `rate` is what the commands asked of it.
#[must_use]
pub fn moves(record: &Record, rate: impl Fn(&Sample) -> i32) -> Moves {
    let mut moves = Moves::default();
    let mut moving = false;
    for sample in &record.samples {
        let moves_now = rate(sample) != 0;
        moves.count += u32::from(moves_now && !moving);
        moves.ticks += u32::from(moves_now);
        moving = moves_now;
    }
    moves
}
