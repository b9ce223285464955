//! The plant against an independent model, and against itself.

mod common;

use common::{lopsided, unforced};
use nalgebra::{Vector3, Vector6};
use serde_json::Value;
use sim_host::{
    analysis::eval::eval,
    model::{
        plant::{Input, Particle, Plant, State, quaternion_from_euler, rk4_step},
        vehicle::Vehicle,
    },
};

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn tumbling(plant: &Plant<f64>) -> State<f64> {
    State {
        quaternion: quaternion_from_euler(&Vector3::new(0.4, -0.8, 1.1)),
        velocity_m_s: Vector3::new(0.8, -0.3, 0.5),
        rate_rad_s: Vector3::new(0.3, -0.2, 0.25),
        r_px_m: 0.1,
        r_px_rate_m_s: -0.05,
        mu_rad: 0.6,
        mu_rate_rad_s: 0.8,
        ..State::at_rest(plant.displaced_volume_m3(0.2))
    }
}

/// 1e-11 relative to the larger of 1 and the value: what two ways of computing in doubles leave.
fn assert_close(path: &str, ours: &Value, reference: &Value) {
    match reference {
        Value::Object(fields) => {
            fields.iter().for_each(|(key, value)| assert_close(&format!("{path}.{key}"), &ours[key], value))
        }
        Value::Array(items) => {
            for (index, value) in items.iter().enumerate() {
                assert_close(&format!("{path}[{index}]"), &ours[index], value);
            }
        }
        _ => {
            let (ours, reference) = (ours.as_f64().unwrap(), reference.as_f64().unwrap());
            assert!(
                (ours - reference).abs() < 1e-11 * reference.abs().max(1.0),
                "{path}: {ours}, reference {reference}"
            );
        }
    }
}

#[test]
fn two_states_agree_with_an_independent_lagrangian_model() {
    let file: Value = serde_json::from_str(include_str!("data/reference-states.json")).unwrap();
    for (number, case) in file["cases"].as_array().unwrap().iter().enumerate() {
        let request = serde_json::from_value(case["in"].clone()).unwrap();
        let answer = serde_json::to_value(eval(&slocum(), &request)).unwrap();
        assert_close(&format!("case {number}"), &answer, &case["out"]);
    }
}

#[test]
fn kinetic_energy_is_kept_while_tumbling_with_the_mass_moving() {
    for vehicle in [slocum(), lopsided()] {
        let plant = unforced(vehicle);
        let mut state = tumbling(&plant);
        let before = plant.kinetic_energy_j(&state);
        let (mut drift, mut travel_m, mut swing_rad) = (0.0_f64, 0.0_f64, 0.0_f64);
        // The free mass is flung out and spins at some 20 rad/s: the step is short for the fourth-order error to stay small.
        for _ in 0..20_000 {
            state = rk4_step(&plant, &state, &Particle::Free(Input::none()), 5e-4, &plant.still());
            drift = drift.max((plant.kinetic_energy_j(&state) / before - 1.0).abs());
            travel_m = travel_m.max((state.r_px_m - 0.1).abs());
            swing_rad = swing_rad.max((state.mu_rad - 0.6).abs());
        }
        assert!(drift < 1e-9, "kinetic energy drifts by {drift:.1e} of itself");
        assert!(travel_m > 0.1 && swing_rad > 1.0, "the mass must really move: {travel_m} m, {swing_rad} rad");
    }
}

#[test]
fn the_energy_is_half_the_velocity_times_the_mass_matrix_times_the_velocity() {
    let plant = unforced(lopsided());
    let state = tumbling(&plant);
    let (v, w) = (state.velocity_m_s, state.rate_rad_s);
    let eta = nalgebra::SVector::from([v.x, v.y, v.z, w.x, w.y, w.z, state.r_px_rate_m_s, state.mu_rate_rad_s]);
    let matrix = plant.mass_matrix(state.r_px_m, state.mu_rad);
    assert!((matrix - matrix.transpose()).amax() < 1e-13);
    assert!((matrix * eta - plant.momentum(&state)).amax() < 1e-12);
    assert!((0.5 * eta.dot(&(matrix * eta)) - plant.kinetic_energy_j(&state)).abs() < 1e-12);
}

/// A driven particle is a free one under the force that its drive gives.
#[test]
fn six_and_eight_degrees_of_freedom_agree_under_the_drives_reaction() {
    let plant = Plant::<f64>::new(&lopsided());
    let state = tumbling(&plant);
    let reaction = plant.reaction(&state, &plant.still());
    let input = Input { u_px_n: reaction.u_px_n, u_mu_nm: reaction.u_mu_nm, u_b_m3_s: 0.0 };
    let (free, driven) =
        (plant.derivative(&state, &input, &plant.still()), plant.derivative_driven(&state, 0.0, &plant.still()));
    // Accelerations are of order 10; rounding through an 8×8 solve leaves 1e-12.
    assert!((free.velocity_m_s - driven.velocity_m_s).amax() < 1e-11);
    assert!((free.rate_rad_s - driven.rate_rad_s).amax() < 1e-11);
    assert!(free.r_px_rate_m_s.abs() < 1e-11 && free.mu_rate_rad_s.abs() < 1e-11);
}

#[test]
fn starting_a_drive_keeps_the_momentum_of_the_whole() {
    let plant = Plant::<f64>::new(&lopsided());
    let state = tumbling(&plant);
    let after = plant.with_particle_rates(&state, 0.01, -0.26);
    let change = plant.momentum(&after) - plant.momentum(&state);
    assert!(change.fixed_rows::<6>(0).amax() < 1e-12, "{change}");
    assert!((after.r_px_rate_m_s, after.mu_rate_rad_s) == (0.01, -0.26));
}

#[test]
fn at_rest_and_neutral_nothing_is_not_a_number() {
    let plant = Plant::<f64>::new(&slocum());
    let state = State::at_rest(plant.displaced_volume_m3(0.0));
    let rates = plant.derivative(&state, &Input::none(), &plant.still());
    assert!(rates.velocity_m_s.iter().chain(rates.rate_rad_s.iter()).all(|rate| rate.is_finite()));
}

/// By hand: 1 l more than neutral, 0.55 m ahead of the centre of buoyancy, lifts the nose with ρ g ΔV x = 5.3955 N m.
#[test]
fn volume_at_its_station_pitches_and_at_the_centre_of_buoyancy_does_not() {
    let mut vehicle = slocum();
    let pitching_nm = |vehicle: &Vehicle, pitch_rad: f64| {
        let plant = Plant::<f64>::new(vehicle);
        let moment = |volume_m3: f64| {
            let quaternion = quaternion_from_euler(&Vector3::new(0.0, pitch_rad, 0.3));
            plant.body_residual(&State { quaternion, ..State::at_rest(volume_m3) })
        };
        moment(vehicle.neutral_volume_m3() + 1e-3) - moment(vehicle.neutral_volume_m3())
    };
    let up_n = -1000.0 * 9.81 * 1e-3;
    assert_eq!(pitching_nm(&vehicle, 0.0)[4], 0.0);
    vehicle.buoyancy.as_mut().unwrap().acts_at_station = true;
    // Weights of 490 N cancel in the difference.
    let level = pitching_nm(&vehicle, 0.0) - Vector6::new(0.0, 0.0, up_n, 0.0, -up_n * 0.55, 0.0);
    assert!(level.amax() < 1e-12, "{level}");
    // With the nose up by 60° the lever is half as long.
    assert!((pitching_nm(&vehicle, std::f64::consts::FRAC_PI_3)[4] + up_n * 0.275).abs() < 1e-12);
}
