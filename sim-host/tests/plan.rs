//! Plans: an ellipse that holds what it says, the same answer on any number of threads, and limits that are told.

use std::{fs, num::NonZero, ops::RangeInclusive, path::Path, process::Command, sync::LazyLock};

use serde_json::Value;
use shared::{autopilot::Autopilot, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{NorthEast, Outcome, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
    studies::plan::{self, Plan, Planned, Scatter},
};

fn plan(mission: &str, current_m_s: f64, seeds: RangeInclusive<u64>, threads: usize) -> Plan {
    let file = MissionFile::load(mission).unwrap();
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let ocean = Ocean::load("still", &vehicle.water).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let autopilot = &Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let planned = Planned { vehicle: &vehicle, file: &file, ocean: &ocean, autopilot, current_m_s, seeds };
    plan::plan(&planned, NonZero::new(threads).unwrap(), |_| {}).unwrap()
}

/// Speeds of unknown currents, m/s, and a plan of 300 members with each.
static PLANS: LazyLock<[(f64, Plan); 2]> =
    LazyLock::new(|| [0.0, 0.2].map(|current_m_s| (current_m_s, plan("fast-50", current_m_s, 1..=300, 2))));

fn surfacings(plan: &Plan) -> Vec<NorthEast> {
    plan.members.iter().filter_map(|member| member.surfacing).collect()
}

/// An ellipse fitted to 300 members, judged by 300 others. The share inside scatters by √(0.9·0.1/300) = 1.7 % from counting
/// and, since the variances of 300 places are known to √(2/300) each, by 1.3 % from the ellipse: three of their root sum square.
#[test]
fn nine_tenths_of_other_seeds_surface_in_the_ellipse() {
    for (current_m_s, fitted) in &*PLANS {
        let others = plan("fast-50", *current_m_s, 301..=600, 2);
        let ellipse = Scatter::of(&surfacings(fitted)).unwrap().ellipse(0.9);
        let others = surfacings(&others);
        let share = others.iter().filter(|place| ellipse.holds(place)).count() as f64 / others.len() as f64;
        assert!((share - 0.9).abs() < 0.065, "{current_m_s} m/s: {share} of {} in {ellipse:?}", others.len());
    }
}

/// A current of 0.2 m/s (root mean square, both directions together) spreads the end of a flight by 0.2 m/s times its
/// duration, on top of all else. The sum of two variances of 300 members is known to √(1/300), its root to half of that:
/// three of these.
#[test]
fn an_unknown_current_spreads_the_surfacings_by_its_speed_times_the_time() {
    let [(_, still), (_, carried)] = &*PLANS;
    let variance_m2 = |plan: &Plan| {
        let [[north, _], [_, east]] = plan.surfacing.as_ref().unwrap().covariance_m2;
        north + east
    };
    let added_m = (variance_m2(carried) - variance_m2(still)).sqrt();
    let duration_s = still.duration_s.unwrap().median;
    // Of the duration the last minute is spent waiting at the surface, position known.
    let expected_m = 0.2 * (duration_s - 60.0);
    assert!((added_m / expected_m - 1.0).abs() < 0.1, "{added_m} m, not {expected_m} m");
}

#[test]
fn the_number_of_threads_changes_nothing() {
    assert_eq!(plan("fast-50", 0.1, 1..=5, 1), plan("fast-50", 0.1, 1..=5, 3));
}

/// The nominal flight has no errors to be off by: its members scatter around it.
#[test]
fn the_nominal_flight_lies_within_the_ensemble() {
    let plan = plan("fast-50", 0.0, 1..=50, 2);
    assert_eq!((plan.nominal.outcome, plan.completed_share), (Outcome::Completed, 1.0));
    let ellipse = Scatter::of(&surfacings(&plan)).unwrap().ellipse(0.9);
    assert!(ellipse.holds(&plan.nominal.surfacing.unwrap()), "{:?} in {ellipse:?}", plan.nominal.surfacing);
    let last = plan.track.last().unwrap();
    assert!((last.time_s - plan.nominal.duration_s).abs() <= 5.0 && last.depth_m < 1.0, "{last:?}");
}

fn glider(arguments: &[&str], out: &Path) -> std::process::Output {
    Command::new(env!("CARGO_BIN_EXE_glider")).arg("plan").args(arguments).arg("--out").arg(out).output().unwrap()
}

#[test]
fn a_folder_for_people_machines_and_maps() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("plan");
    let output = glider(&["fast-50", "--members", "8", "--environment", "temperate", "--json"], &out);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
    let read = |name: &str| fs::read_to_string(out.join(name)).unwrap();
    assert_eq!(serde_json::from_str::<Value>(&read("plan.json")).unwrap(), answer);
    assert!(!String::from_utf8_lossy(&output.stdout).contains("NaN"));
    assert_eq!(answer["members"].as_array().map(Vec::len), Some(8));
    let limits: Vec<_> = answer["limits"].as_array().unwrap().iter().map(|l| (&l["name"], &l["holds"])).collect();
    let held = |name: &str| limits.contains(&(&Value::from(name), &Value::from(true)));
    assert!(["depth", "energy", "duration", "altitude"].into_iter().all(held), "{limits:?}");

    let map: Value = serde_json::from_str(&read("track.geojson")).unwrap();
    let of = |kind: &str| -> Vec<&Value> {
        let features = map["features"].as_array().unwrap().iter().map(|feature| &feature["geometry"]);
        features.filter(|geometry| geometry["type"] == kind).map(|geometry| &geometry["coordinates"]).collect()
    };
    // RFC 7946: longitude first; a polygon's ring closes.
    let start = &of("LineString")[0][0];
    let file = MissionFile::load("fast-50").unwrap();
    assert!((start[0].as_f64().unwrap() - file.start.longitude_deg).abs() < 1e-3, "{start}");
    assert!((start[1].as_f64().unwrap() - file.start.latitude_deg).abs() < 1e-3, "{start}");
    for ring in of("Polygon") {
        let ring = ring[0].as_array().unwrap();
        assert_eq!(ring.first(), ring.last());
    }
    assert_eq!((of("Polygon").len(), of("Point").len(), of("MultiPoint").len()), (2, 1, 1));
    for picture in ["plan.svg", "plan.html"] {
        let text = read(picture);
        assert!(["<script", "<link", "<img", "src=", "href=", "NaN"].into_iter().all(|load| !text.contains(load)));
    }
}

/// Each limit with a mission that breaks it: an hour's dive in half an hour, and a floor above its apogee.
#[test]
fn a_limit_that_is_not_kept_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        fs::write(&path, text).unwrap();
        path.display().to_string()
    };
    let default = include_str!("../missions/default.toml");
    let line = default.lines().find(|line| line.starts_with("max_duration_s")).unwrap();
    let short = write("short.toml", &default.replace(line, "max_duration_s = 1200"));
    let shallow = write("shallow.toml", "[floor]\ndepth_m = 120\nslope_deg = 0\ndirection_deg = 0\n");
    for (arguments, name, says) in [
        (vec![short.as_str()], "limit: duration", "longer than the mission's `max_duration_s`"),
        (vec!["default", "--environment", shallow.as_str()], "limit: altitude", "it runs aground"),
    ] {
        let output = glider(&[&arguments[..], &["--members", "3"]].concat(), &folder.path().join("out"));
        let text = String::from_utf8(output.stdout).unwrap();
        let line = text.lines().find(|line| line.starts_with(name)).unwrap();
        assert!(line.ends_with(&format!("NOT KEPT: {says}")), "{text}");
        assert!(text.contains("fewer than three members complete"), "{text}");
    }
}

#[test]
fn bad_input_is_one_line_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out");
    for (arguments, says) in [
        (&["default", "--current", "-1"][..], "--current -1: a speed from 0 to 3 m/s"),
        (&["default", "--current", "NaN"], "a speed from 0 to 3 m/s"),
        (&["slow-1000", "--vehicle", "slocum-paper"], "`mission.dive_to_m` is 1000, but this vehicle"),
        (&["default", "--environment", "stil"], "nor an embedded one (`still`"),
        (&["no-such-mission"], "no-such-mission"),
    ] {
        let output = glider(arguments, &out);
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && output.stdout.is_empty() && !out.exists(), "{arguments:?}");
        assert!(text.contains(says) && text.lines().count() == 1, "{arguments:?}: {text}");
    }
}
