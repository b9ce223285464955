//! Margins: the linear loops against the full plant flown by the same laws, and how much margin there is.

use std::{num::NonZero, process::Command};

use shared::{
    control::{
        heading::{HeadingLoop, TurnTrim},
        pitch::Steady,
    },
    device::{RAD_PER_CDEG, TICK_HZ},
    math::wrap_cdeg,
    model::table::TrimTable,
    parameters::Parameters,
};
use sim_host::{
    analysis::{
        margins::{self, ENOUGH_GAIN},
        modes::{RollKinematics, linearised},
        table::{Envelope, generate},
        trim::{Condition, Scale, glide},
    },
    flight::mission_file::MissionFile,
    model::{
        plant::{Particle, Plant, State, euler_from_quaternion, rk4_step},
        vehicle::Vehicle,
    },
};

const TICK_S: f64 = 0.25;

/// The mass's place as an input, by central differences: their own error is some 1e-9 of the largest entry.
#[test]
fn the_masss_place_acts_as_the_full_equations_say() {
    const STEP: f64 = 1e-5;
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let plant = Plant::<f64>::new(&vehicle);
    for path_angle_deg in [-30.0_f64, -15.0, 20.0] {
        let net_mass_kg = -0.3 * path_angle_deg.signum();
        let condition = Condition::PathAngle(path_angle_deg.to_radians());
        let glide = glide(&vehicle, condition, Scale::NetMass(net_mass_kg)).unwrap();
        let exact = linearised(&vehicle, &glide, RollKinematics::Exact).inputs;
        for (column, [r_px_m, mu_rad]) in [[STEP, 0.0], [0.0, STEP]].into_iter().enumerate() {
            let rates = |sign: f64| {
                let state = glide.state();
                let moved =
                    State { r_px_m: state.r_px_m + sign * r_px_m, mu_rad: state.mu_rad + sign * mu_rad, ..state };
                let rates = plant.derivative_driven(&moved, 0.0, &plant.still());
                let (v, w) = (rates.velocity_m_s, rates.rate_rad_s);
                [v.x, v.z, w.y, 0.0, v.y, w.x, w.z, 0.0]
            };
            let (more, less) = (rates(1.0), rates(-1.0));
            for row in 0..8 {
                let difference = (more[row] - less[row]) / (2.0 * STEP);
                let off = (difference - exact[(row, column)]).abs();
                assert!(off < 1e-7 * exact.amax(), "{path_angle_deg}°, row {row}, column {column}: {off:e}");
            }
        }
    }
}

/// Root of the mean square of the heading, deg, over the last ten of 50 periods: the full plant, moved off its heading by 0.5°,
/// with the heading law that flies.
fn last_heading_deg(vehicle: &Vehicle, table: &TrimTable<'_>, parameters: &Parameters, steady: Steady) -> f64 {
    const PERIODS: usize = 50;
    let law = HeadingLoop::new(&Parameters {
        heading_deadband_cdeg: 0,
        mu_deadband_cdeg: 0,
        turn_bias_limit_mdeg_s: 0,
        ..*parameters
    });
    let condition = Condition::PathAngle(steady.path_angle_rad.into());
    let glide = glide(vehicle, condition, Scale::NetMass(steady.net_mass_kg.into())).unwrap();
    let plant = Plant::<f64>::new(vehicle);
    let locked = Particle::Driven { u_b_m3_s: 0.0 };
    let (half_sin, half_cos) = (0.25_f64.to_radians().sin(), 0.25_f64.to_radians().cos());
    let mut state = glide.state();
    // Turned by 0.5° about the vertical: (cos, 0, 0, sin) times the attitude.
    let q = state.quaternion;
    state.quaternion = nalgebra::Vector4::new(
        half_cos * q[0] - half_sin * q[3],
        half_cos * q[1] - half_sin * q[2],
        half_cos * q[2] + half_sin * q[1],
        half_cos * q[3] + half_sin * q[0],
    );
    let heading = |state: &State<f64>| euler_from_quaternion(&state.quaternion).z;
    assert!((heading(&state).to_degrees() - 0.5).abs() < 1e-9);
    let period_ticks = parameters.heading_period_s as usize * TICK_HZ as usize;
    let (mut mu_cdeg, mut trim) = (0, TurnTrim::default());
    let mut squares = Vec::new();
    for tick in 0..PERIODS * period_ticks {
        let before_cdeg = mu_cdeg;
        let error_cdeg = wrap_cdeg(-(heading(&state) / f64::from(RAD_PER_CDEG)).round() as i32);
        mu_cdeg = law.mu_cdeg(&mut trim, table, &steady, tick as u32, error_cdeg, mu_cdeg);
        // The mass arrives a tick after its order.
        state = State { mu_rad: f64::from(before_cdeg) * f64::from(RAD_PER_CDEG), ..state };
        state = rk4_step(&plant, &state, &locked, TICK_S, &plant.still());
        squares.push(heading(&state).powi(2));
    }
    let last = &squares[squares.len() - 10 * period_ticks..];
    (last.iter().sum::<f64>() / last.len() as f64).sqrt().to_degrees()
}

/// Quicker and quicker heading laws, on both sides of the bound that the linear loop draws: the full plant settles where it says
/// stable, and oscillates ever more (as far as the mass goes) where it says unstable.
#[test]
fn the_full_plant_settles_where_the_linear_loop_is_stable() {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let (mut stable, mut unstable) = (0, 0);
    for (path_angle_deg, net_mass_kg) in [(-26.0_f32, 0.25), (-35.0, 0.05), (-35.0, 0.25), (24.0, -0.05)] {
        let steady = Steady { path_angle_rad: path_angle_deg.to_radians(), net_mass_kg };
        for heading_time_s in [3, 5, 8, 12, 20, 30, 60] {
            let parameters = Parameters { heading_time_s, ..Parameters::default() };
            let radius = margins::at(&vehicle, &table, &parameters, steady).unwrap().heading.spectral_radius;
            let heading_deg = last_heading_deg(&vehicle, &table, &parameters, steady);
            let told = format!("{path_angle_deg}°, {net_mass_kg} kg, {heading_time_s} s: {radius}, {heading_deg}°");
            // Over 45 periods 0.95 leaves a tenth and 1.05 makes nine of one; between them nothing is asserted.
            if radius < 0.95 {
                stable += 1;
                assert!(heading_deg < 0.25, "{told}");
            } else if radius > 1.05 {
                unstable += 1;
                assert!(heading_deg > 1.0, "{told}");
            }
        }
    }
    assert!(stable >= 5 && unstable >= 5, "{stable} stable, {unstable} unstable");
}

/// What the embedded missions fly: 6 dB, the usual least, in both loops.
#[test]
fn the_embedded_missions_fly_with_enough_margin() {
    for mission in ["default", "fast-50", "slow-50", "slow-200", "slow-1000"] {
        let file = MissionFile::load(mission).unwrap();
        let vehicle = Vehicle::load(&file.vehicle).unwrap();
        let bytes = generate(&vehicle, &Envelope::default()).unwrap();
        let table = TrimTable::parse(&bytes).unwrap();
        for steady in margins::glides(&file.mission) {
            let node = margins::at(&vehicle, &table, &file.parameters, steady).unwrap();
            for margins in [node.pitch, node.heading] {
                let enough = margins.gain_margin.is_none_or(|factor| factor >= ENOUGH_GAIN);
                assert!(margins.is_stable() && enough, "{mission}: {node:?}");
            }
        }
    }
}

/// 6 dB, the usual least, in the heading loop of every embedded vehicle that can fly, wherever its file says that it flies;
/// towards the reversal of control (−39.3° for slocum-paper's dives) too, where a turn takes ever more rotation of the mass.
/// Pitch as well, but for from-geometry, whose lightest and steepest climbs are unstable in themselves. Seawing has no engine.
#[test]
fn over_the_envelope_of_every_vehicle_heading_has_enough_margin() {
    let steady = Envelope { dive_deg: [20.0, 30.0], climb_deg: [20.0, 30.0], net_mass_kg: [0.15, 0.4], mu_deg: 45.0 };
    for (name, envelope, pitch_too) in [
        ("slocum-paper", Envelope::default(), true),
        ("slocum-deep", Envelope::default(), true),
        ("from-geometry", Envelope::default(), false),
        ("reversed-turn", steady, true),
    ] {
        let vehicle = Vehicle::load(name).unwrap();
        let bytes = generate(&vehicle, &envelope).unwrap();
        let table = TrimTable::parse(&bytes).unwrap();
        let run = |threads: usize| {
            margins::margins(&vehicle, &table, &Parameters::default(), NonZero::new(threads).unwrap()).unwrap()
        };
        let envelope = run(1);
        assert_eq!(envelope, run(3));
        for told in [Some(envelope.heading), pitch_too.then_some(envelope.pitch)].into_iter().flatten() {
            assert!(told.stable && told.weak_nodes == 0, "{name}: {told:?}");
            assert!(told.gain_margin.is_none_or(|margin| margin >= ENOUGH_GAIN), "{name}: {told:?}");
            assert!(told.longest_move_s < told.delay_margin_s.unwrap(), "{name}: {told:?}");
        }
        assert!(envelope.nodes.iter().all(|node| node.has_authority), "{name}");
        // A position loop that arrives in one tick bears twice its gain, whatever it drives.
        assert!((envelope.servo.gain_margin.unwrap() - 2.0).abs() < 1e-6, "{name}: {:?}", envelope.servo);
    }
}

#[test]
fn the_command_answers_people_and_machines() {
    let glider = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_glider")).arg("margins").args(arguments).output().unwrap()
    };
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("margins");
    let output = glider(&["slocum-paper", "--json", "--out", &out.display().to_string()]);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let written = std::fs::read_to_string(out.join("margins.json")).unwrap();
    assert_eq!(serde_json::from_str::<serde_json::Value>(&written).unwrap(), answer);
    assert!(answer["nodes"].as_array().unwrap().iter().all(|node| node["pitch"]["spectral_radius"].is_f64()));
    assert!(!std::fs::read_to_string(out.join("margins.svg")).unwrap().contains("NaN"));
    let refused = glider(&["seawing"]);
    assert!(!refused.status.success() && refused.stdout.is_empty());
    assert_eq!(String::from_utf8_lossy(&refused.stderr), "error: seawing: flying needs the section [buoyancy]\n");
}
