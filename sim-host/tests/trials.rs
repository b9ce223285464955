//! Sea trials: a promise is judged by where it is worst, it can fail, and every flight stands in the table.

use std::{fs, num::NonZero, process::Command};

use sim_host::{
    flight::Outcome,
    studies::{
        campaign::{Drawn, Flown, METRICS},
        trials::{Claim, Flights, Limit, Measure, PROMISES, Promise, Quantile, TRIALS, Trial, count, judge, run},
    },
};

const APOGEE: &str = "apogee_over_percent";

/// A flight that is known by one of its figures.
fn flown(water: &str, pilot: &'static str, seed: u64, value: f64) -> Flown {
    Flown {
        water: water.into(),
        pilot,
        seed,
        drawn: Drawn::nominal(),
        outcome: Outcome::Completed,
        reason: String::new(),
        values: METRICS.iter().map(|metric| (metric.name == APOGEE).then_some(value)).collect(),
    }
}

fn flights(flown: Vec<Flown>) -> [Flights; 1] {
    let vehicle = "slocum-paper".into();
    [Flights { name: "fast-50", mission: "fast-50", vehicle, current_m_s: 0.0, flown, results: Vec::new() }]
}

fn judged(measure: Measure, limit: Limit, flown: Vec<Flown>) -> Claim {
    judge(&Promise { what: "x", trials: &["fast-50"], measure, limit }, &flights(flown)).unwrap()
}

/// Eleven flights of 0 to 1.0 in one water, and of 0 to 2.0 in another.
fn two_waters() -> Vec<Flown> {
    let water = |name, scale: f64| (0..=10).map(move |seed| flown(name, "autopilot", seed, scale * seed as f64));
    water("still", 0.1).chain(water("rough", 0.2)).collect()
}

#[test]
fn a_promise_is_judged_by_the_water_where_it_is_worst() {
    let claim = |quantile, most| judged(Measure::Figure(APOGEE, quantile), Limit::AtMost(most), two_waters());
    let all = claim(Quantile::Worst, 2.0);
    assert!(all.holds && all.measured == Some(2.0) && all.place == "fast-50, rough", "{all:?}");
    assert!(!claim(Quantile::Worst, 1.9).holds);
    // Of eleven evenly spaced flights the tenth has nine tenths at or below it, and the sixth half.
    let (most, half) = (claim(Quantile::P90, 1.9), claim(Quantile::Median, 1.1));
    assert!((most.measured.unwrap() - 1.8).abs() < 1e-12 && (half.measured.unwrap() - 1.0).abs() < 1e-12);
    assert!(most.holds && half.holds && !claim(Quantile::P90, 1.7).holds && !claim(Quantile::Median, 0.9).holds);
}

#[test]
fn a_flight_that_does_not_come_back_breaks_its_promise() {
    let completed = |flown| judged(Measure::Completed, Limit::AtLeast(100.0), flown);
    assert!(completed(two_waters()).holds);
    let mut some = two_waters();
    some[3].outcome = Outcome::Lost;
    let claim = completed(some);
    assert!(!claim.holds && claim.place == "fast-50, still", "{claim:?}");
}

/// Nobody to judge by is no reason to believe.
#[test]
fn a_water_from_which_nobody_comes_back_breaks_every_promise() {
    let mut none = two_waters();
    for flight in none.iter_mut().filter(|flight| flight.water == "still") {
        flight.outcome = Outcome::Aborted;
    }
    let claim = judged(Measure::Figure(APOGEE, Quantile::Worst), Limit::AtMost(100.0), none);
    assert!(!claim.holds && claim.measured.is_none() && claim.place == "fast-50, still", "{claim:?}");
}

/// A quarter of the baseline's on one seed, four times of it on the other: as a whole they are alike.
#[test]
fn all_flights_together_count_by_their_squares() {
    let flights = [3.0, 4.0].map(|value| flown("still", "autopilot", value as u64, value)).to_vec();
    let claim = |most| judged(Measure::Figure(APOGEE, Quantile::Rms), Limit::AtMost(most), flights.clone());
    assert!(claim(12.5_f64.sqrt() + 1e-9).holds && !claim(12.5_f64.sqrt() - 1e-9).holds);
}

#[test]
fn the_baseline_is_met_seed_by_seed() {
    let both = [("autopilot", [1.0, 4.0]), ("baseline", [4.0, 1.0])];
    let flights = || {
        both.iter()
            .flat_map(|(pilot, values)| (1..).zip(values).map(|(seed, value)| flown("still", pilot, seed, *value)))
    };
    let claim = |most| judged(Measure::OverBaseline(APOGEE, Quantile::Worst), Limit::AtMost(most), flights().collect());
    assert!(claim(4.0).measured == Some(4.0) && claim(4.0).holds && !claim(3.9).holds);
}

#[test]
fn every_promise_speaks_of_what_is_flown_and_measured() {
    for promise in PROMISES {
        for name in promise.trials {
            assert!(TRIALS.iter().any(|trial| trial.name == *name), "{}: {name}", promise.what);
        }
        let (Measure::Figure(figure, _) | Measure::OverBaseline(figure, _)) = promise.measure else { continue };
        assert!(METRICS.iter().any(|metric| metric.name == figure), "{}: {figure}", promise.what);
    }
}

#[test]
fn every_flight_stands_in_the_table_and_every_picture_beside_the_page() {
    const SHORT: Trial = Trial {
        name: "short",
        mission: "fast-50",
        surfacings: None,
        waters: &["still", "temperate"],
        current_m_s: 0.1,
    };
    let folder = tempfile::tempdir().unwrap();
    let mut landed = 0;
    let trials = run(&[SHORT], 2, NonZero::new(2).unwrap(), |_| landed += 1).unwrap();
    trials.write(folder.path()).unwrap();
    let read = |name: &str| fs::read_to_string(folder.path().join(name)).unwrap();

    let csv = read("trials.csv");
    let rows: Vec<String> =
        csv.lines().skip(1).map(|row| row.split(',').take(4).collect::<Vec<_>>().join(",")).collect();
    let pilots = |water: &str| {
        ["autopilot", "baseline"].map(|pilot| [1, 2].map(|seed| format!("short,{water},{pilot},{seed}"))).concat()
    };
    assert_eq!(rows, [pilots("still"), pilots("temperate")].concat());
    assert_eq!((landed, count(&[SHORT], 2)), (8, 8));

    let (markdown, page) = (read("trials.md"), read("trials.html"));
    let pictures: Vec<&str> =
        markdown.lines().filter_map(|line| line.strip_suffix(".svg)")?.split("](").nth(1)).collect();
    assert_eq!(pictures, ["example", "learning", "plan", "margins-slocum-paper", "short-distributions"]);
    for name in pictures {
        let svg = read(&format!("{name}.svg"));
        let both = svg.contains("autopilot") && svg.contains("baseline");
        assert!(!svg.contains("NaN") && (both || !["example", "short-distributions"].contains(&name)), "{name}");
    }
    for claim in &trials.claims {
        assert!(markdown.contains(&claim.what) && page.contains(claim.verdict()), "{claim:?}");
    }
    for load in ["<script", "<link", "<img", "src=", "href=", "url(", "@import", "NaN"] {
        assert!(!page.contains(load), "`{load}`");
    }
}

#[test]
fn the_command_judges_every_promise_for_machines() {
    let folder = tempfile::tempdir().unwrap();
    let mut glider = Command::new(env!("CARGO_BIN_EXE_glider"));
    let output = glider.args(["trials", "--seeds", "1", "--json", "-o"]).arg(folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let claims = answer["claims"].as_array().unwrap();
    for promise in PROMISES {
        let claim = claims.iter().find(|claim| claim["what"] == promise.what);
        assert!(claim.is_some_and(|claim| claim["holds"].is_boolean() && claim["measured"].is_number()), "{claim:?}");
    }
    assert_eq!(answer["trials"].as_array().unwrap().len(), TRIALS.len());
    // A dive and a climb of each of the two vehicles: their missions share them.
    assert_eq!(answer["margins"].as_array().unwrap().len(), 2 * 2);
}

#[test]
fn a_folder_that_cannot_be_made_is_told_in_one_line_before_anything_flies() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let mut glider = Command::new(env!("CARGO_BIN_EXE_glider"));
    let output = glider.arg("trials").arg("-o").arg(file.path().join("out")).output().unwrap();
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(!output.status.success() && output.stdout.is_empty());
    assert!(text.starts_with("error: ") && text.contains("out") && text.lines().count() == 1, "{text}");
}
