//! Exact sensitivities against central differences of everything computed anew.

use std::process::Command;

use sim_host::{
    analysis::{
        helix::Scale,
        locus::Varied,
        modes::{ModeSet, RollKinematics, modes},
        performance::Polar,
        sensitivity::{Sensitivities, sensitivities},
        trim::{Condition, glide},
        turn::Turns,
    },
    model::{
        coefficients::{Anchoring, Parameter, Shape, Study},
        vehicle::Vehicle,
    },
};

const ROLL: RollKinematics = RollKinematics::Exact;
const CONDITIONS: [(Condition, Scale); 3] = [
    (Condition::PathAngle(-0.61), Scale::Speed(0.77)),
    (Condition::MinGlideAngle, Scale::NetMass(0.2)),
    (Condition::MaxHorizontalSpeed, Scale::Speed(0.5)),
];

fn of_modes(set: &ModeSet) -> Vec<f64> {
    let upper = set.eigenvalues.iter().filter(|[_, im]| *im >= 0.0);
    upper.flat_map(|[re, im]| [Some(*re), (*im > 0.0).then(|| -re / re.hypot(*im))]).flatten().collect()
}

/// Every figure of a vehicle, in the order of the sensitivities; `net_mass_kg` is held for the speed.
fn figures(vehicle: &Vehicle, condition: Condition, scale: Scale, net_mass_kg: f64) -> Vec<f64> {
    let trim = glide(vehicle, condition, scale).unwrap();
    let range = -1.0 / (trim.path_angle_rad.tan() * trim.net_mass_kg * vehicle.water.gravity_m_s2);
    let speed = glide(vehicle, condition, Scale::NetMass(net_mass_kg)).unwrap().speed_m_s;
    let modes = modes(vehicle, &trim, ROLL).unwrap();
    let turns = Turns::new(vehicle, &trim).unwrap();
    let per_mu = 1.0 / turns.sensitivities(&trim).numeric.unwrap().mu_s.abs();
    let mut all = vec![Polar::from(&vehicle.hydrodynamics).best_glide().lift_to_drag, range, speed];
    all.extend(of_modes(&modes.longitudinal));
    all.extend(of_modes(&modes.lateral));
    all.extend([per_mu, turns.authorities().right.within_travel_rad_s]);
    all
}

fn found(study: &Study<'_>, (condition, scale): (Condition, Scale)) -> Sensitivities {
    sensitivities(study, condition, scale, ROLL).unwrap()
}

/// A step that is small, yet leaves every flow as it is: the fin of slocum-paper would turn turbulent 8 % farther.
fn step(value: f64, parameter: Parameter) -> f64 {
    match parameter {
        Parameter::WingSweep | Parameter::WingDihedral => 0.05,
        Parameter::WingHeight | Parameter::FinHeight => 5e-4,
        _ => 2e-3 * value,
    }
}

fn agrees(study: &Study<'_>, at: (Condition, Scale)) {
    let found = found(study, at);
    let (condition, scale) = at;
    let lift_coefficient = glide(study.vehicle, condition, scale).unwrap().lift_coefficient;
    let net_mass_kg = found.glide.net_mass_kg;
    for (place, parameter) in Parameter::ALL.into_iter().enumerate() {
        let value = *parameter.of(&mut Shape::of(study.vehicle));
        let anew = |change: f64| {
            let vehicle = Varied::Shape(parameter).vehicle(study, value + change, lift_coefficient).unwrap();
            figures(&vehicle, condition, scale, net_mass_kg)
        };
        let (wide, step) = (step(value, parameter), 0.5 * step(value, parameter));
        let [near, far] = [step, wide].map(|step| {
            let slope = |(high, low): (f64, f64)| (high - low) / (2.0 * step);
            anew(step).into_iter().zip(anew(-step)).map(slope).collect::<Vec<_>>()
        });
        assert_eq!(near.len(), found.figures.len(), "{parameter}");
        for ((merit, near), far) in found.figures.iter().zip(near).zip(far) {
            let exact = merit.effects[place].derivative.unwrap();
            // Half the step has a quarter of the error of the third derivative: a third of the difference is what is left.
            let truncation = (near - far).abs();
            // Of trims and eigenvalues that are found to 1e-9.
            let rounding = 2e-9 * merit.value.unwrap().abs().max(1e-3) / step;
            let (what, tolerance) = (&merit.name, truncation + rounding);
            assert!((exact - near).abs() <= tolerance, "{parameter}, {what}: {exact}, not {near} ± {tolerance}");
            // The differences must be good for something.
            assert!(truncation <= 0.02 * near.abs() + 10.0 * rounding, "{parameter}, {what}: {near} and {far}");
        }
    }
}

#[test]
fn identified_coefficients_changed_by_the_estimate() {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    CONDITIONS.into_iter().for_each(|at| agrees(&Study::new(&vehicle), at));
}

#[test]
fn coefficients_from_geometry_alone() {
    let vehicle = Vehicle::load("from-geometry").unwrap();
    CONDITIONS.into_iter().for_each(|at| agrees(&Study::new(&vehicle), at));
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    agrees(&Study { anchoring: Anchoring::Unanchored, ..Study::new(&vehicle) }, CONDITIONS[1]);
}

/// With cross flow, a station of the engine and coefficients that are referred to 1 m.
#[test]
fn a_vehicle_of_another_kind() {
    let vehicle = Vehicle::load("seawing").unwrap();
    agrees(&Study::new(&vehicle), (Condition::PathAngle(-0.6), Scale::Speed(0.5)));
}

/// V² ∝ 1/(S √(C_L² + C_D²)) and the ideal range is V² L/D over a speed: two closed forms of the same.
#[test]
fn at_the_flattest_glide_the_range_of_a_net_mass_goes_as_lift_over_drag() {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let found = found(&Study::new(&vehicle), CONDITIONS[1]);
    let [lift_to_drag, range] = [0, 1].map(|place| &found.figures[place]);
    for (a, b) in lift_to_drag.effects.iter().zip(&range.effects) {
        let relative = |derivative: Option<f64>, value: Option<f64>| derivative.unwrap() / value.unwrap();
        let [a, b] = [relative(a.derivative, lift_to_drag.value), relative(b.derivative, range.value)];
        assert!((a - b).abs() < 1e-12, "{a} {b}");
    }
}

/// At each switch the Reynolds number of the surface is the critical one.
#[test]
fn a_switch_stands_where_the_flow_changes() {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let study = Study::new(&vehicle);
    let switches = found(&study, CONDITIONS[0]).switches;
    assert!(switches.len() > 3);
    for switch in switches {
        let parameter: Parameter = switch.parameter.parse().unwrap();
        let drag = |share: f64| {
            let mut shape = Shape::of(&vehicle);
            *parameter.of(&mut shape) = switch.at * share;
            study.coefficients(&shape, 0.77, 0.0).drag[0]
        };
        let (jump, beside) = (drag(1.0 + 1e-9) - drag(1.0 - 1e-9), drag(1.0 + 1e-9) - drag(1.0 + 3e-9));
        assert!(jump.abs() > 1e4 * beside.abs(), "{switch:?}: {jump} {beside}");
    }
}

#[test]
fn the_command_answers_in_json_and_draws_a_panel_per_figure() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("bars.svg");
    let output = Command::new(env!("CARGO_BIN_EXE_glider"))
        .args(["sensitivity", "slocum-paper", "--path-angle-deg", "-35", "--json", "-o"])
        .arg(&file)
        .output()
        .unwrap();
    assert!(output.status.success());
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let figures = answer["figures"].as_array().unwrap();
    assert!(figures.iter().all(|figure| figure["effects"].as_array().unwrap().len() == Parameter::ALL.len()));
    // A parameter that is 0 has a derivative, but no elasticity.
    let sweep = &figures[0]["effects"][6];
    assert_eq!(sweep["parameter"], "wing.sweep_deg");
    assert!(sweep["derivative"].is_f64() && sweep["elasticity"].is_null());
    let svg = std::fs::read_to_string(file).unwrap();
    assert_eq!(svg.matches("class=\"name\"").count(), figures.len());
}
