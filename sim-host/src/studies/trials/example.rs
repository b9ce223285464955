//! A reversal as both pilots fly it: the same vehicle on the same day.

use shared::commands::Phase;

use crate::flight::record::{Record, Sample};
use crate::pages::{
    chart::{Figure, Line, Panel, Scale, Stroke},
    report::figures::heading_error_deg,
};
use crate::studies::campaign::{Campaign, recorded};

/// The seed that is shown.
const SEED: u64 = 1;
/// From this long before the first apogee begins to this long after, s.
const AROUND_S: [f64; 2] = [-60.0, 240.0];

/// One sample in so many is drawn.
const EVERY: usize = 4;

/// One quantity of a sample.
type Quantity = fn(&Sample) -> f64;

/// Pitch, roll, heading and depth around the first apogee in the first water.
pub(super) fn figure(mission: &str, campaign: &Campaign<'_>) -> Result<Figure, String> {
    let water = campaign.waters.first().ok_or("no water to fly in")?;
    let mut flown = Vec::new();
    for (flyer, stroke) in water.pilots.iter().zip([Stroke::Solid(0), Stroke::Dashed(1)]) {
        flown.push((flyer.name(), stroke, recorded(campaign, water, flyer, SEED)?.0));
    }
    let panel = |title: &str, label: &str, quantity: Quantity, downwards: bool| {
        let line = |(name, stroke, record): &(&str, Stroke, Record)| Line {
            name: Some((*name).to_owned()),
            stroke: *stroke,
            points: around_apogee(record).map(|(time_s, sample)| [time_s, quantity(sample)]).collect(),
        };
        Panel {
            title: title.into(),
            x: Scale::exactly("time since the apogee began, s", AROUND_S),
            y: Scale { downwards, ..Scale::around(label) },
            lines: flown.iter().map(line).collect(),
            places: Vec::new(),
        }
    };
    Ok(Figure {
        title: format!("A reversal and a turn: {mission}, {}, seed {SEED}", water.name),
        columns: 2,
        panels: vec![
            panel("Depth", "depth, m", |sample| sample.truth.position_m.z, true),
            panel("Pitch", "pitch, °", |sample| sample.truth.euler_rad.y.to_degrees(), false),
            panel("Roll", "roll, °", |sample| sample.truth.euler_rad.x.to_degrees(), false),
            panel("Heading off its target", "heading error, °", heading_error_deg, false),
        ],
    })
}

/// What was seen around the first apogee, with the time since it began, s.
fn around_apogee(record: &Record) -> impl Iterator<Item = (f64, &Sample)> {
    let apogee = record.samples.iter().find(|sample| sample.commands.phase == Phase::Apogee);
    let began_s = apogee.map_or(f64::NAN, Sample::time_s);
    let timed = record.samples.iter().step_by(EVERY).map(move |sample| (sample.time_s() - began_s, sample));
    timed.filter(|(time_s, _)| (AROUND_S[0]..=AROUND_S[1]).contains(time_s))
}
