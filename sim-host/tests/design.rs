//! `glider design`: what must come out by the paper's closed forms, and what a user meets.

use std::{fs, process::Command};

use sim_host::{
    analysis::design::{Design, Objective, Spec, design, vehicle_toml},
    model::{coefficients::BoundaryLayer, vehicle::Vehicle},
};

/// A design of three numbers, without limits. A lung of 0.2 % leaves every flow laminar.
fn spec(objective: &str, drive: &str, more: &str) -> String {
    format!(
        "name = \"found\"\nvehicle = \"from-geometry\"\nobjective = \"{objective}\"\n\
         [given]\ndisplaced_mass_kg = 52\n{drive}\ndepth_m = 200\nbattery_j = 540e3\n\
         [bounds]\nhull = {{ length_m = [1.3, 1.8] }}\nwing = {{ aspect_ratio = [9, 13], span_ratio = [5, 7] }}\n{more}"
    )
}

fn read(text: &str) -> Spec {
    Spec::from_toml(text, "design.toml").unwrap()
}

fn found(text: &str) -> Design {
    let spec = read(text);
    design(&spec, &Vehicle::load(&spec.vehicle).unwrap()).unwrap()
}

/// Which bound each parameter reached, in the file's order.
fn reached(design: &Design) -> Vec<Option<&'static str>> {
    design.parameters.iter().map(|placed| placed.reached).collect()
}

fn is_laminar(design: &Design) -> bool {
    let size = &design.best.size;
    [size.hull_flow, size.wing_flow, size.fin_flow] == [BoundaryLayer::Laminar; 3]
}

/// Section 6 of the paper: "longer hull, smaller span, higher fineness and aspect ratio" for speed.
#[test]
fn at_one_mass_and_lung_the_fastest_is_long_and_fine_with_a_short_slender_wing() {
    let fast = found(&spec("speed", "lung_capacity = 0.002", ""));
    assert_eq!(reached(&fast), [Some("most"), Some("most"), Some("least")]);
    assert!(is_laminar(&fast));
    let start = fast.start.unwrap();
    assert!(fast.best.vehicle.hull.fineness > start.vehicle.hull.fineness);
}

/// Section 6: a shorter hull and a larger span for lift to drag, and with one lung that is the ideal range, too.
#[test]
fn at_one_mass_and_lung_the_flattest_is_short_with_a_wide_wing() {
    for objective in ["lift_to_drag", "range"] {
        let flat = found(&spec(objective, "lung_capacity = 0.002", ""));
        let [length, _, span] = reached(&flat)[..] else { panic!() };
        assert_eq!([length, span], [Some("least"), Some("most")], "{objective}");
        assert!(is_laminar(&flat));
    }
}

/// At one speed a dive pays for drag alone: ρV²S C_D0 at the flattest glide, over its slope.
#[test]
fn at_one_speed_the_smallest_wing_goes_farthest_though_it_glides_worst() {
    let far = found(&spec("range", "speed_m_s = 0.15", ""));
    let size = &far.best.size;
    let drag_n = 1000.0 * 0.15 * 0.15 * far.best.vehicle.hydrodynamics.area_m2 * size.c_d_zero;
    let range_m = 540e3 * size.glide.descent_rad.cos() / drag_n;
    assert!((far.best.range_m / range_m - 1.0).abs() < 1e-12);
    assert_eq!(reached(&far)[2], Some("least"));
    let flat = found(&spec("lift_to_drag", "speed_m_s = 0.15", ""));
    assert_eq!(reached(&flat)[2], Some("most"));
    assert!(flat.best.size.glide.lift_to_drag > size.glide.lift_to_drag && flat.best.range_m < far.best.range_m);
}

/// The identified K is five times the estimate: most of it stays when the wing grows slender.
#[test]
fn anchored_on_slocum_the_flattest_has_the_least_aspect_ratio() {
    let text = spec("lift_to_drag", "speed_m_s = 0.6", "").replace("from-geometry", "slocum-paper");
    let text =
        text.replace("[1.3, 1.8]", "[1.45, 1.55]").replace("[5, 7]", "[5.8, 6.2]").replace("[9, 13]", "[10.5, 11.5]");
    let flat = found(&format!("coefficients = \"anchored\"\n{text}"));
    assert_eq!(reached(&flat)[1], Some("least"));
}

#[test]
fn limits_are_kept_and_cost_something() {
    let free = found(&spec("range", "lung_capacity = 0.002", ""));
    let least_deg_s = 1.2 * free.best.turn_rate_rad_s.to_degrees();
    let limits = format!("[limits]\nleast_turn_rate_deg_s = {least_deg_s}\n[front]\npoints = 3\n");
    let kept = found(&spec("range", "lung_capacity = 0.002", &limits));
    // To the share of it that counts as met.
    assert!(kept.best.turn_rate_rad_s.to_degrees() >= least_deg_s * (1.0 - 1e-5));
    assert!(kept.best.range_m < free.best.range_m);
    assert_eq!(kept.active.len(), 1, "{:?}", kept.active);
    let front = kept.front.unwrap().points;
    assert!(front.len() >= 2);
    for pair in front.windows(2) {
        let [a, b] = [&pair[0].candidate, &pair[1].candidate];
        assert!(a.turn_rate_rad_s < b.turn_rate_rad_s && a.range_m > b.range_m);
    }
    // Nothing on it goes farther than the farthest of all, but for the search's last step.
    assert!(front[0].candidate.range_m <= free.best.range_m * (1.0 + 1e-3));
}

#[test]
fn the_same_specification_gives_the_same_bits() {
    let text = spec("speed", "lung_capacity = 0.002", "");
    assert_eq!(found(&text), found(&text));
}

#[test]
fn the_vehicle_file_reads_back_as_the_vehicle_that_was_found() {
    let text = spec("speed", "lung_capacity = 0.002", "");
    let anchored = text.replace("from-geometry", "slocum-paper").replace("[1.3, 1.8]", "[1.45, 1.55]");
    let seawing = text.replace("from-geometry", "seawing").replace("= 52", "= 60");
    let anchored = format!("coefficients = \"anchored\"\n{}", anchored.replace("[5, 7]", "[5.8, 6.2]"));
    for text in [text, anchored, seawing] {
        let (spec, found) = (read(&text), found(&text));
        let file = vehicle_toml(&spec, &found.best, &Vehicle::text(&spec.vehicle).unwrap()).unwrap();
        let back = Vehicle::from_toml(&file, "found.toml").unwrap();
        assert_eq!(back, found.best.vehicle, "{}", spec.vehicle);
    }
}

#[test]
fn what_cannot_be_met_is_named_with_what_is_nearest() {
    let limits = "[limits]\nleast_speed_m_s = 3\nleast_damping_ratio = -1\n";
    let spec = read(&spec("range", "lung_capacity = 0.002", limits));
    let refusal = design(&spec, &Vehicle::load("from-geometry").unwrap()).unwrap_err();
    assert!(
        refusal.starts_with("no geometry within the bounds: least_speed_m_s = 3 cannot be met, at best 0."),
        "{refusal}"
    );
    assert!(!refusal.contains("least_damping_ratio") && refusal.contains("; nearest: hull.length_m = 1."), "{refusal}");
}

#[test]
fn mistakes_in_the_file_are_answered_with_their_place() {
    let good = spec("range", "lung_capacity = 0.002", "");
    let cases = [
        (good.replace("span_ratio = ", "spanratio = "), "design.toml:11:34: unknown key `spanratio`"),
        (good.replace("[9, 13]", "[13, 9]"), "design.toml:11:25: `bounds.wing.aspect_ratio` is [13, 9], but must be"),
        (good.replace("[9, 13]", "[-9, 13]"), "design.toml:11:25: `bounds.wing.aspect_ratio` is [-9, 13], but must be"),
        (
            good.replace("\"range\"", "\"beauty\""),
            "design.toml:3:13: `objective` is \"beauty\", but must be \"range\" or",
        ),
        (good.replace("lung_capacity = 0.002", ""), "missing key `given.lung_capacity`"),
        (good.replace("= 0.002", "= 0.002\nspeed_m_s = 0.4"), "`given.speed_m_s` is 0.4, but must be left out"),
    ];
    for (text, expected) in cases {
        let mistake = Spec::from_toml(&text, "design.toml").unwrap_err().to_string();
        assert!(mistake.contains(expected), "{mistake}");
    }
}

#[test]
fn the_embedded_design_is_one_and_the_command_writes_what_it_found() {
    assert_eq!(Spec::load("default").unwrap().objective, Objective::Range);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("design.toml");
    fs::write(&file, spec("lift_to_drag", "net_mass_kg = 0.1", "[front]\npoints = 3\n")).unwrap();
    let glider = |arguments: &[&str]| Command::new(env!("CARGO_BIN_EXE_glider")).args(arguments).output().unwrap();
    let out = folder.path().join("out");
    let output = glider(&["design", file.to_str().unwrap(), "--json", "--out", out.to_str().unwrap()]);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert!((answer["size"]["net_mass_kg"].as_f64().unwrap() - 0.1).abs() < 1e-9);
    let rows = fs::read_to_string(out.join("front.csv")).unwrap().lines().count();
    assert_eq!(rows - 1, answer["front"]["points"].as_array().unwrap().len());
    assert!(fs::read_to_string(out.join("front.svg")).unwrap().contains("ideal range, km"));
    let trim = glider(&["trim", out.join("vehicle.toml").to_str().unwrap(), "--min-glide-angle", "--json"]);
    let trim: serde_json::Value = serde_json::from_slice(&trim.stdout).unwrap();
    assert!((trim["net_mass_kg"].as_f64().unwrap() - 0.1).abs() < 1e-9);
}
