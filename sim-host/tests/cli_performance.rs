//! `glider polar`, `size` and `endurance` as a user meets them.

use std::process::{Command, Output};

use serde_json::Value;

fn glider(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glider")).args(arguments).output().unwrap()
}

fn json(arguments: &[&str]) -> Value {
    let output = glider(arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn number(value: &Value, key: &str) -> f64 {
    value[key].as_f64().unwrap_or_else(|| panic!("{key} of {value}"))
}

/// The one line of an error, and nothing on stdout.
fn refusal(arguments: &[&str]) -> String {
    let output = glider(arguments);
    assert!(!output.status.success() && output.stdout.is_empty());
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn polar_answers_in_json_as_promised() {
    let answer = json(&["polar", "slocum-paper", "--json"]);
    let best = &answer["best_glide"];
    assert!((number(best, "descent_rad").to_degrees() - 8.0003).abs() < 5e-5);
    assert!((number(best, "lift_to_drag") * number(best, "descent_rad").tan() - 1.0).abs() < 1e-12);
    let fastest = &answer["max_horizontal_speed"];
    assert!((number(fastest, "descent_rad").to_degrees() - 35.66).abs() < 5e-3);
    let ratio = number(fastest, "lift_coefficient") / number(fastest, "drag_coefficient");
    assert!((ratio / number(fastest, "lift_to_drag") - 1.0).abs() < 1e-12);
}

#[test]
fn the_polar_of_a_vehicle_marks_the_glides_that_trim_finds() {
    for vehicle in ["slocum-paper", "from-geometry", "seawing"] {
        let polar = json(&["polar", vehicle, "--json"]);
        for (mark, flag) in [("best_glide", "--min-glide-angle"), ("max_horizontal_speed", "--max-horizontal-speed")] {
            let trim = json(&["trim", vehicle, flag, "--json"]);
            let descent = number(&polar[mark], "descent_rad");
            assert!((number(&trim, "path_angle_rad") + descent).abs() < 1e-12, "{vehicle} {mark}");
        }
    }
}

#[test]
fn size_answers_for_a_changed_shape_and_along_a_parameter() {
    let answer = json(&["size", "slocum-paper", "--set", "hull.length_m=1.8", "--displacement", "52", "--json"]);
    assert!((number(&answer, "displaced_mass_kg") - 52.0).abs() < 1e-9);
    let sweep = json(&["size", "slocum-paper", "--unanchored", "--vary", "wing.position", "-0.1", "0.2", "--json"]);
    let points = sweep["sweep"]["points"].as_array().unwrap();
    assert_eq!((points.len(), number(&points[0], "value"), number(&points[10], "value")), (11, -0.1, 0.2));
    // The place of the wing does not change its drag.
    assert_eq!(points[0]["lung_capacity"], points[10]["lung_capacity"]);
}

#[test]
fn what_does_not_exist_is_null() {
    assert_eq!(json(&["size", "slocum-paper", "--speed", "10", "--json"])["lung_capacity"], Value::Null);
    assert_eq!(json(&["endurance", "seawing", "--json"])["realistic"], Value::Null);
}

#[test]
fn endurance_sets_ideal_and_realistic_side_by_side() {
    let answer = json(&["endurance", "slocum-paper", "--speed", "0.4", "--battery", "540e3", "--json"]);
    let (ideal, realistic) = (&answer["ideal"], &answer["realistic"]);
    for key in ["dive_distance_m", "dive_duration_s", "dive_energy_j", "dives", "range_m", "endurance_s"] {
        assert!(number(ideal, key) > 0.0 && number(realistic, key) > 0.0, "{key}");
    }
    let energy = realistic["energy"].as_object().unwrap().values().filter_map(Value::as_f64).sum::<f64>();
    assert!((energy / number(realistic, "dive_energy_j") - 1.0).abs() < 1e-12);
}

#[test]
fn a_wrong_change_is_one_line_that_says_what_would_be_right() {
    let rows = [
        (vec!["--set", "wing.span_ratio=0.9"], "`wing.span_ratio` is 0.9, but must be a number above 1"),
        (vec!["--displacement", "0"], "displacement 0 kg: must be positive"),
        (vec!["--displacement", "1000000"], "must be a number above 1"),
        (vec!["--speed", "0"], "speed 0 m/s: must be positive"),
        (vec!["--speed", "NaN"], "speed NaN m/s: must be positive"),
        (vec!["--lung-capacity", "0"], "lung capacity 0: must be a positive fraction"),
        (vec!["--vary", "wing.position", "0", "2"], "`wing.position` is 1.2, but must be a number from -1 to 1"),
        (vec!["--vary", "wing.length", "0", "2"], "`wing.length` is no geometric parameter; known: hull.length_m,"),
    ];
    for (arguments, expected) in rows {
        let line = refusal(&[&["size", "slocum-paper"], arguments.as_slice()].concat());
        assert!(line.starts_with("error: ") && line.trim_end().lines().count() == 1, "{line}");
        assert!(line.contains(expected), "{line}");
    }
    let unknown = refusal(&["size", "slocum-paper", "--set", "wing.length=2"]);
    assert!(unknown.contains("`wing.length` is no geometric parameter"), "{unknown}");
    let depth = refusal(&["endurance", "slocum-paper", "--depth", "0"]);
    assert_eq!(depth, "error: depth 0: must be positive\n");
}
