//! The plant in moving water: what a current must not change, what it must, and energy where it is kept.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

mod common;

use common::lopsided;
use nalgebra::{Matrix3, Vector3};
use sim_host::model::{
    ocean::Ocean,
    plant::{
        Input, Medium, Particle, Plant, State, Surroundings, Unrest, quaternion_from_euler, rk4_step,
        rotation_from_quaternion,
    },
    vehicle::Vehicle,
};

const DRIVEN: Particle<f64> = Particle::Driven { u_b_m3_s: 0.0 };

/// A state that gives every term something to do.
fn gliding(plant: &Plant<f64>, net_mass_kg: f64) -> State<f64> {
    State {
        position_m: Vector3::new(3.0, -2.0, 40.0),
        quaternion: quaternion_from_euler(&Vector3::new(0.2, -0.5, 1.1)),
        velocity_m_s: Vector3::new(0.5, -0.05, 0.06),
        rate_rad_s: Vector3::new(0.03, -0.02, 0.05),
        r_px_m: 0.1,
        mu_rad: 0.2,
        ..State::at_rest(plant.displaced_volume_m3(net_mass_kg))
    }
}

#[test]
fn a_uniform_current_shifts_the_track_and_nothing_else() {
    let plant = Plant::<f64>::new(&lopsided());
    let current_m_s = Vector3::new(0.3, -0.4, 0.02);
    let carrying = Surroundings { current_m_s, ..plant.still() };
    let (mut still, mut carried) = (gliding(&plant, 0.2), gliding(&plant, 0.2));
    for step in 1..=8_000 {
        still = rk4_step(&plant, &still, &DRIVEN, 0.125, &plant.still());
        carried = rk4_step(&plant, &carried, &DRIVEN, 0.125, &carrying);
        let relative = State { position_m: still.position_m, ..carried };
        assert_eq!(relative, still, "the same bits at step {step}");
    }
    let shift = carried.position_m - still.position_m - current_m_s * 1_000.0;
    // Positions of some 500 m are summed up in 8000 steps.
    assert!(shift.amax() < 1e-9, "{shift}");
}

/// Uniform in space, swinging in time.
struct Swinging {
    still: Surroundings<f64>,
    time_s: f64,
}

impl Medium<f64> for Swinging {
    fn around(&self, _: &Vector3<f64>, into_step_s: f64) -> Surroundings<f64> {
        let (sin, cos) = (0.7 * (self.time_s + into_step_s)).sin_cos();
        let along = Vector3::new(1.0, 0.5, -0.3);
        let unrest = Unrest { acceleration_m_s2: along * (0.7 * cos), gradient_per_s: Matrix3::zeros() };
        Surroundings { current_m_s: along * sin, unrest: Some(unrest), ..self.still }
    }
}

/// Neutral, and its masses balanced about the centre of buoyancy: a drop of water with a hull.
fn like_water() -> (Plant<f64>, State<f64>) {
    let mut vehicle = lopsided();
    let (mass, r_px_m, mu_rad) = (&vehicle.moving_mass, 0.1, 0.2_f64);
    let r_p = Vector3::new(r_px_m, -mass.radius_m * mu_rad.sin(), mass.radius_m * mu_rad.cos());
    vehicle.body.centre_of_mass_m = -r_p * mass.mass_kg / vehicle.body.mass_kg;
    let plant = Plant::new(&vehicle);
    let state = State { velocity_m_s: Vector3::zeros(), rate_rad_s: Vector3::zeros(), ..gliding(&plant, 0.0) };
    (plant, state)
}

#[test]
fn what_weighs_like_water_stays_at_rest_in_an_accelerating_current() {
    let (plant, mut state) = like_water();
    let from = state.position_m;
    for step in 0..2_000 {
        let water = Swinging { still: plant.still(), time_s: f64::from(step) * 0.05 };
        state = rk4_step(&plant, &state, &DRIVEN, 0.05, &water);
    }
    // Forces of 50 N cancel to 1e-14 of themselves, 2000 times.
    assert!(state.velocity_m_s.amax() < 1e-13 && state.rate_rad_s.amax() < 1e-12, "{state:?}");
    let carried = Vector3::new(1.0, 0.5, -0.3) * ((1.0 - (70.0_f64).cos()) / 0.7);
    // Simpson's rule in steps of 0.05 s: 1e-8 of a metre.
    assert!((state.position_m - from - carried).amax() < 1e-7);
}

#[test]
fn what_weighs_like_water_goes_round_with_the_swell_and_along_with_the_shear() {
    let (plant, mut state) = like_water();
    let text = "[swell]\nheight_m = 2\nperiod_s = 8\ndirection_deg = 40\n[current]\nprofile = [[0, 0.3, -0.1], [50, 0, 0.2]]\n";
    let water = Vehicle::load("slocum-paper").unwrap().water;
    let ocean = Ocean::from_toml(text, "e.toml", &water).unwrap();
    state.position_m.z = 5.0;
    for step in 0..2_000 {
        state = rk4_step(&plant, &state, &DRIVEN, 0.05, &ocean.from_time(f64::from(step) * 0.05));
    }
    assert!(state.velocity_m_s.amax() < 1e-13 && state.rate_rad_s.amax() < 1e-12, "{state:?}");
    assert!(state.position_m.xy().norm() > 10.0, "it must really be carried");
}

/// A steady irrotational flow, c = G X with G symmetric and without trace: its pressure is Bernoulli's.
struct Strain {
    still: Surroundings<f64>,
    gradient_per_s: Matrix3<f64>,
}

impl Medium<f64> for Strain {
    fn around(&self, position_m: &Vector3<f64>, _: f64) -> Surroundings<f64> {
        let current_m_s = self.gradient_per_s * position_m;
        let unrest =
            Unrest { acceleration_m_s2: self.gradient_per_s * current_m_s, gradient_per_s: self.gradient_per_s };
        Surroundings { current_m_s, unrest: Some(unrest), ..self.still }
    }
}

/// Without viscosity the Lagrangian `T_body(v + Rᵀc) + T_added(v) + ½ρV_d|c|² − U` does not depend on time, and so
/// `H = T_body + T_added + Rᵀc·p_added − ½ρV_d|c|² + U` is kept.
#[test]
fn energy_is_kept_in_a_steady_irrotational_flow() {
    let mut vehicle = lopsided();
    vehicle.hydrodynamics.area_m2 = 0.0;
    let plant = Plant::<f64>::new(&vehicle);
    let mut dry = vehicle.clone();
    dry.added_mass.mass_kg.fill(0.0);
    dry.added_mass.inertia_kg_m2.fill(0.0);
    dry.added_mass.coupling_kg_m.fill(0.0);
    let dry = Plant::<f64>::new(&dry);
    let gradient_per_s = Matrix3::new(0.03, 0.02, -0.01, 0.02, -0.04, 0.015, -0.01, 0.015, 0.01);
    let water = Strain { still: plant.still(), gradient_per_s };

    let energy = |state: &State<f64>| {
        let current = gradient_per_s * state.position_m;
        let in_body = rotation_from_quaternion(&state.quaternion).tr_mul(&current);
        let absolute = State { velocity_m_s: state.velocity_m_s + in_body, ..*state };
        let added_j = plant.kinetic_energy_j(state) - dry.kinetic_energy_j(state);
        let added_momentum = (plant.momentum(state) - dry.momentum(state)).fixed_rows::<3>(0).into_owned();
        let displaced_kg = vehicle.water.density_kg_m3 * state.displaced_volume_m3;
        dry.kinetic_energy_j(&absolute) + added_j + in_body.dot(&added_momentum)
            - 0.5 * displaced_kg * current.norm_squared()
            + plant.potential_energy_j(state)
    };
    let mut state = gliding(&plant, 0.2);
    let (before, kinetic_j) = (energy(&state), plant.kinetic_energy_j(&state));
    let mut drift = 0.0_f64;
    for _ in 0..4_000 {
        state = rk4_step(&plant, &state, &DRIVEN, 0.005, &water);
        drift = drift.max((energy(&state) - before).abs());
    }
    // Fourth order at 0.005 s leaves 1e-9 of the kinetic energy; a wrong term is of order 1.
    assert!(drift < 1e-7 * kinetic_j, "{drift:.1e} J of {kinetic_j:.1} J");
    assert!((plant.kinetic_energy_j(&state) / kinetic_j - 1.0).abs() > 0.1, "energy must really change hands");
}

#[test]
fn pressure_and_cold_make_the_hull_smaller() {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    let rigid = Plant::<f64>::new(&vehicle);
    let elasticity = &mut vehicle.buoyancy.as_mut().unwrap().elasticity;
    // A Seaglider's, from its parameter files.
    (elasticity.compressibility_per_pa, elasticity.thermal_expansion_per_c) = (4.2e-10, 7.05e-5);
    elasticity.reference_temperature_c = 15.0;
    let elastic = Plant::<f64>::new(&vehicle);
    let deep = Surroundings { pressure_pa: 1e7, temperature_c: Some(5.0), ..rigid.still() };
    let state = gliding(&rigid, 0.2);
    let smaller =
        State { displaced_volume_m3: state.displaced_volume_m3 * (1.0 - 4.2e-10 * 1e7 - 7.05e-5 * 10.0), ..state };
    let rates = |plant: &Plant<f64>, state: &State<f64>| plant.derivative(state, &Input::none(), &deep);
    let difference = rates(&elastic, &state).velocity_m_s - rates(&rigid, &smaller).velocity_m_s;
    assert!(difference.amax() < 1e-13, "{difference}");
    assert_eq!(rates(&elastic, &state).displaced_volume_m3, 0.0, "the state keeps the volume at the surface");
}
