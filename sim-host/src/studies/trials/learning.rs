//! What the autopilot learns on a flight, beside what is so.

use crate::flight::record::{Record, Sample};
use crate::pages::chart::{Figure, Line, Panel, Scale, Stroke};
use crate::studies::campaign::{Campaign, Drawn, recorded};

/// The seed that is shown.
const SEED: u64 = 1;
/// One sample in so many is drawn: a minute.
const EVERY: usize = 240;

/// One quantity of a sample.
type Quantity<'a> = &'a dyn Fn(&Sample) -> f64;

/// Current, weight, compass and the error of the position over the first autopilot's flight in the first water.
pub(super) fn figure(name: &str, campaign: &Campaign<'_>) -> Result<Figure, String> {
    let water = campaign.waters.first().ok_or("no water to fly in")?;
    let flyer = water.pilots.first().ok_or("nobody to fly")?;
    let (record, _) = recorded(campaign, water, flyer, SEED)?;
    let drawn = Drawn::new(SEED, campaign.current_m_s);
    let learned = |name: &str, colour, of: Quantity<'_>| line(name, Stroke::Solid(colour), &record, of);
    let so = |name: &str, colour, value: f64| line(name, Stroke::Dashed(colour), &record, &|_| value);
    let [north_m_s, east_m_s] = drawn.current_m_s;
    let panel = |title: &str, label: &str, lines: Vec<Line>| Panel {
        title: title.into(),
        x: Scale::around("time, h"),
        y: Scale::around(label),
        lines,
        places: Vec::new(),
    };
    let thousandths = |value: i16| f64::from(value) / 1e3;
    let panels = vec![
        panel(
            "Current",
            "m/s",
            vec![
                learned("north, learned", 0, &|s| thousandths(s.commands.learned.current_north_mm_s)),
                so("north, so", 0, north_m_s),
                learned("east, learned", 1, &|s| thousandths(s.commands.learned.current_east_mm_s)),
                so("east, so", 1, east_m_s),
            ],
        ),
        panel("Position, dead reckoned against the truth", "m", vec![learned("error", 0, &position_error_m)]),
        panel(
            "Weight beyond the file's",
            "g",
            vec![
                learned("learned", 0, &|s| s.commands.learned.weight_g.into()),
                so("ballast drawn", 0, 1e3 * drawn.ballast_kg),
            ],
        ),
        panel(
            "Speed, drag and compass",
            "%, °",
            vec![
                learned("speed beyond the model's, %", 0, &|s| f64::from(s.commands.learned.speed_permille) / 10.0),
                learned("drag beyond the file's, %", 1, &|s| f64::from(s.commands.learned.drag_permille) / 10.0),
                learned("true heading less the compass's, °", 2, &|s| {
                    f64::from(s.commands.learned.compass_cdeg) / 100.0
                }),
            ],
        ),
    ];
    Ok(Figure { title: format!("What is learned: {name}, {}, seed {SEED}", water.name), columns: 2, panels })
}

fn line(name: &str, stroke: Stroke, record: &Record, of: Quantity<'_>) -> Line {
    let points = record.samples.iter().step_by(EVERY).map(|sample| [sample.time_s() / 3600.0, of(sample)]).collect();
    Line { name: Some(name.into()), stroke, points }
}

fn position_error_m(sample: &Sample) -> f64 {
    let reckoned_m = [sample.commands.north_mm, sample.commands.east_mm].map(|mm| f64::from(mm) / 1e3);
    let truth = sample.truth.position_m;
    (reckoned_m[0] - truth.x).hypot(reckoned_m[1] - truth.y)
}
