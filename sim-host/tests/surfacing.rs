//! Where the vehicle comes up against where it expects to, in a current that it does not know.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use std::{num::NonZero, thread};

use shared::{autopilot::Autopilot, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{Outcome, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
    studies::campaign::{self, Campaign, Flyer, METRICS, Water},
};

/// Enough that the ninth decile is not just the worst.
const SEEDS: u64 = 20;
/// An unknown steady current, half the glider's own speed, m/s.
const CURRENT_M_S: f64 = 0.2;

/// Errors of the last surfacing, least first, % of the way over ground since the fix before.
fn errors_percent(mission: &str, surfacings: u16) -> Vec<f64> {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut file = MissionFile::load(mission).unwrap().resolve(&table).unwrap();
    file.mission.surfacings = surfacings;
    let autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let pilots = vec![Flyer::Autopilot(Box::new(autopilot))];
    let waters = [Water { name: "still".into(), ocean: Ocean::still(&vehicle.water), pilots }];
    let campaign = Campaign { vehicle: &vehicle, file: &file, waters: &waters, seeds: SEEDS, current_m_s: CURRENT_M_S };
    let flown = campaign::run(&campaign, thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN), |_| {});
    let index = METRICS.iter().position(|metric| metric.name == "surfacing_error_percent").unwrap();
    let mut errors_percent: Vec<f64> = (flown.unwrap().iter())
        .inspect(|flight| assert_eq!(flight.outcome, Outcome::Completed))
        .map(|flight| flight.values[index].unwrap())
        .collect();
    errors_percent.sort_by(f64::total_cmp);
    errors_percent
}

fn quantile(sorted: &[f64], share: f64) -> f64 {
    sorted[(share * (sorted.len() - 1) as f64).round() as usize]
}

#[test]
fn the_first_dive_in_an_unknown_current_misses_and_the_next_on_its_heading_does_not() {
    let (first, third) = (errors_percent("legs", 1), errors_percent("legs", 3));
    // 0.2 m/s against the 0.4 to 0.6 m/s that the vehicle makes over ground.
    assert!(quantile(&first, 0.1) > 20.0, "{first:?}");
    assert!(quantile(&third, 0.9) < 5.0, "{third:?}");
}

#[test]
fn two_headings_tell_current_from_compass() {
    let (turned, back) = (errors_percent("zigzag", 2), errors_percent("zigzag", 3));
    assert!(quantile(&turned, 0.5) < 5.0, "right after the turn: {turned:?}");
    assert!(quantile(&back, 0.9) < 5.0, "after two headings: {back:?}");
}
