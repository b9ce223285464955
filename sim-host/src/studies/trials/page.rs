//! The trials in words, tables and pictures.

use super::{Claim, Flights, GlideMargins, Picture, Trials};
use crate::analysis::margins::Margins;
use crate::pages::document::{Block, Column, Document, Row, Table};
use crate::studies::campaign::{FACTORS, METRICS, Tally, cells, distributions, share};

/// What differs from flight to flight.
const DRAWN: &str = "Every seed is one vehicle on one day. It draws, evenly, the coefficients of forces and moments within \
    10 %, those of damping within 20 %, and the ballast within 30 g; a compass that deviates by 2° rms and keeps its \
    deviation over the flight; and all other errors of its instruments. Nobody tells the pilots: they know the \
    vehicle's file and the mean density of the charted water.";
/// Who flies, and where.
const PILOTS: &str = "Two pilots fly every seed: the autopilot, and a baseline: a classical PID without a model of the \
    vehicle, told which way the mass turns it. Waters are at rest (still, of one density; calm, compressed by its own \
    weight), stratified (temperate) and sheared (tropical), with the swell, currents and internal waves that \
    their files say.";

/// Why some numbers cannot be better.
const REMARKS: [&str; 3] = [
    "Heading is judged against the truth over all flights, as the compass' deviation is: one of 2° rms is more than \
     3.3° off in a tenth of the flights, which no controller knows of. What the compass shows is judged flight by flight.",
    "A current is learned from the position fix after a dive, and surfacings are judged on the last dive. A first dive \
     in an unknown current misses by the current times its duration. The drift at the surface before that dive stands \
     apart: surface_drift_m.",
    "Per km is per km over ground, as the vehicle drifts; the baseline drifts alike on the same seed.",
];

/// Figures in the missions' tables; trials.csv has all.
const SHOWN: [&str; 13] = [
    "apogee_over_percent",
    "apogee_under_percent",
    "pitch_settling_s",
    "turn_settling_s",
    "heading_rms_deg",
    "compass_rms_deg",
    "path_angle_rms_deg",
    "pump_moves_per_km",
    "pitch_moves_per_km",
    "roll_moves_per_km",
    "energy_j_per_km",
    "surfacing_error_percent",
    "surface_drift_m",
];

pub(super) fn document(trials: &Trials) -> Document {
    let mut blocks = vec![
        Block::Text(flown(trials)),
        Block::Text(DRAWN.into()),
        Block::Text(PILOTS.into()),
        Block::Code(format!("cargo run --release -- trials --seeds {} # the same numbers", trials.seeds)),
        Block::Heading("What is promised, and what is so".into()),
        Block::Text(in_short(&trials.claims)),
        Block::Table(claims(&trials.claims)),
        Block::List(REMARKS.map(str::to_owned).into()),
    ];
    let pictures = trials.pictures.iter().cloned();
    blocks.extend(
        pictures
            .flat_map(|Picture { name, about, figure }| [Block::Text(about), Block::Figure(name, Box::new(figure))]),
    );
    blocks.extend(trials.flights.iter().flat_map(mission));
    blocks.extend([
        Block::Heading("Stability margins in each mission's glides".into()),
        Block::Text("Missions of one vehicle that share their glides stand once, by the first of them.".into()),
        Block::Table(margins(&trials.margins)),
        Block::Heading("What the figures mean".into()),
        Block::List(METRICS.iter().map(|metric| format!("{}: {}", metric.name, metric.about)).collect()),
    ]);
    Document { title: "Sea trials of the autopilot".into(), blocks }
}

fn flown(trials: &Trials) -> String {
    let flights: usize = trials.flights.iter().map(|trial| trial.flown.len()).sum();
    format!(
        "{flights} simulated flights of {} missions, {} seeds each in every water and for either pilot. The command below \
         flies them again, and writes every flight into trials.csv, with the {} coefficients that its seed drew.",
        trials.flights.len(),
        trials.seeds,
        FACTORS.len()
    )
}

/// How many promises hold.
pub(super) fn in_short(claims: &[Claim]) -> String {
    let holds = claims.iter().filter(|claim| claim.holds).count();
    format!(
        "{holds} of {} hold. A number of flights is taken for each mission in each water, and the worst of these \
         is shown.",
        claims.len()
    )
}

fn words(name: &str) -> Column {
    Column::Words(name.into())
}

fn number(name: &str) -> Column {
    Column::Number(name.into())
}

fn claims(claims: &[Claim]) -> Table {
    let row = |claim: &Claim| {
        let measured = claim.measured.map_or_else(|| "none".into(), in_digits);
        let cells = [claim.what.clone(), claim.limit.to_string(), measured, claim.over.clone(), claim.place.clone()];
        Row { cells: cells.into_iter().chain([claim.verdict().into()]).collect(), missed: !claim.holds }
    };
    Table {
        columns: vec![
            words("what"),
            number("limit"),
            number("measured"),
            words("over"),
            words("worst in"),
            words("verdict"),
        ],
        rows: claims.iter().map(row).collect(),
    }
}

/// Three digits or so.
pub(super) fn in_digits(value: f64) -> String {
    let decimals = match value.abs() {
        size if size >= 99.95 => 0,
        size if size >= 9.995 => 1,
        size if size >= 0.9995 || size == 0.0 => 2,
        size if size >= 0.0995 => 3,
        _ => 4,
    };
    format!("{value:.decimals$}")
}

/// A mission's figures, water by water and pilot by pilot.
fn mission(trial: &Flights) -> Vec<Block> {
    let Flights { name, vehicle, current_m_s, flown, results, .. } = trial;
    let current = if *current_m_s > 0.0 { format!(", an unknown current of {current_m_s} m/s") } else { String::new() };
    let figure = distributions(&format!("{name}: share of flights below a value"), flown);
    vec![
        Block::Heading(format!("{name}: {vehicle}{current}")),
        Block::Text("Median / p90 / worst of the flights that completed the mission; less is better.".into()),
        Block::Table(figures(results)),
        Block::Folded("Distributions".into(), vec![Block::Figure(format!("{name}-distributions"), Box::new(figure))]),
    ]
}

fn figures(results: &[Tally]) -> Table {
    let head = |tally: &Tally| number(&format!("{}, {}", tally.environment, tally.pilot));
    let plain = |cells: Vec<String>| Row { cells, missed: false };
    let row = |name: &str, of: &dyn Fn(&Tally) -> String| {
        plain(std::iter::once(name.to_owned()).chain(results.iter().map(of)).collect())
    };
    let completed = row("completed", &share);
    let shown = METRICS.iter().enumerate().filter(|(_, metric)| SHOWN.contains(&metric.name));
    let metrics = shown.map(|(index, metric)| {
        row(metric.name, &|tally| {
            let [_, median, p90, worst] = cells(tally.spreads.get(index).copied().flatten());
            if median.is_empty() { "none".into() } else { format!("{median} / {p90} / {worst}") }
        })
    });
    let rows = std::iter::once(completed).chain(metrics).collect();
    Table { columns: std::iter::once(words("")).chain(results.iter().map(head)).collect(), rows }
}

fn margins(glides: &[GlideMargins]) -> Table {
    let cells = |margins: &Margins| {
        let or_none = |value: Option<f64>| value.map_or_else(|| "none".into(), in_digits);
        [or_none(margins.gain_margin), or_none(margins.delay_margin_s)]
    };
    let row = |GlideMargins { mission, node }: &GlideMargins| {
        let glide = [node.path_angle_rad.to_degrees(), node.net_mass_kg, node.speed_m_s];
        let loops = [cells(&node.pitch), cells(&node.heading)].concat();
        let all = std::iter::once((*mission).to_owned()).chain(glide.map(in_digits)).chain(loops);
        Row { cells: all.collect(), missed: !(node.pitch.is_stable() && node.heading.is_stable()) }
    };
    Table {
        columns: vec![
            words("mission"),
            number("path angle, °"),
            number("net mass, kg"),
            number("speed, m/s"),
            number("pitch: gain margin"),
            number("delay margin, s"),
            number("heading: gain margin"),
            number("delay margin, s"),
        ],
        rows: glides.iter().map(row).collect(),
    }
}
