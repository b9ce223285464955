//! Impulse, energy and symmetry: what the plant must keep, whatever its numbers.

mod common;

use common::{lopsided, random_states, unforced};
use nalgebra::{Matrix3, Vector3};
use num_dual::DualSVec64;
use sim_host::model::{
    plant::{
        Input, Particle, Plant, State, euler_from_quaternion, quaternion_from_euler, rk4_step, rotation_from_quaternion,
    },
    real::Real,
    vehicle::Vehicle,
};

type Dual = DualSVec64<1>;

/// Linear impulse, and angular impulse about the inertial origin: Kirchhoff's, added mass and all.
fn impulses(plant: &Plant<f64>, state: &State<f64>) -> (Vector3<f64>, Vector3<f64>) {
    let momentum = plant.momentum(state);
    let to_inertial = rotation_from_quaternion(&state.quaternion);
    let linear = to_inertial * momentum.fixed_rows::<3>(0);
    (linear, state.position_m.cross(&linear) + to_inertial * momentum.fixed_rows::<3>(3))
}

/// Without forces both impulses are constant; fourth order at 1 ms leaves 1e-9 of them over 5 s.
#[test]
fn linear_and_angular_impulse_are_kept_without_forces() {
    for vehicle in [Vehicle::load("slocum-paper").unwrap(), lopsided()] {
        let plant = unforced(vehicle);
        let (mut state, _) = random_states(&plant, 1)[0];
        let before = impulses(&plant, &state);
        for _ in 0..5_000 {
            state = rk4_step(&plant, &state, &Particle::Free(Input::none()), 1e-3, &plant.still());
        }
        let after = impulses(&plant, &state);
        assert!((after.0 - before.0).norm() < 1e-9 * before.0.norm(), "linear: {before:?} to {after:?}");
        assert!((after.1 - before.1).norm() < 1e-9 * before.1.norm(), "angular: {before:?} to {after:?}");
    }
}

/// With gravity the impulse grows by the net weight, and its moment about the vertical does not grow at all.
#[test]
fn gravity_adds_impulse_downwards_only() {
    let mut vehicle = lopsided();
    vehicle.hydrodynamics.area_m2 = 0.0;
    let plant = Plant::<f64>::new(&vehicle);
    let (mut state, _) = random_states(&plant, 1)[0];
    let weight_n = plant.net_mass_kg(state.displaced_volume_m3) * vehicle.water.gravity_m_s2;
    let before = impulses(&plant, &state);
    for _ in 0..2_000 {
        state = rk4_step(&plant, &state, &Particle::Free(Input::none()), 1e-3, &plant.still());
    }
    let after = impulses(&plant, &state);
    let expected = Vector3::new(0.0, 0.0, 2.0 * weight_n);
    assert!((after.0 - before.0 - expected).norm() < 1e-8 * before.0.norm());
    assert!((after.1 - before.1).z.abs() < 1e-8 * before.1.norm());
}

fn as_dual(state: &State<f64>, rate: &State<f64>) -> State<Dual> {
    let along = |value: f64, rate: f64| Dual::from_re(value) + Dual::from_re(0.0).derivative(0) * Dual::from_re(rate);
    State {
        position_m: state.position_m.zip_map(&rate.position_m, along),
        quaternion: state.quaternion.zip_map(&rate.quaternion, along),
        velocity_m_s: state.velocity_m_s.zip_map(&rate.velocity_m_s, along),
        rate_rad_s: state.rate_rad_s.zip_map(&rate.rate_rad_s, along),
        r_px_m: along(state.r_px_m, rate.r_px_m),
        r_px_rate_m_s: along(state.r_px_rate_m_s, rate.r_px_rate_m_s),
        mu_rad: along(state.mu_rad, rate.mu_rad),
        mu_rate_rad_s: along(state.mu_rate_rad_s, rate.mu_rate_rad_s),
        displaced_volume_m3: along(state.displaced_volume_m3, rate.displaced_volume_m3),
    }
}

/// dE/dt = f_v·v + m_v·ω + u_px ṙ_px + u_μ μ̇ + ρ g z u_b, with dE/dt taken exactly along the motion; z is the depth at which
/// the buoyancy engine works: the centre of buoyancy's, or its station's.
#[test]
fn energy_changes_by_the_work_that_is_done() {
    let mut in_the_nose = lopsided();
    let engine = in_the_nose.buoyancy.as_mut().unwrap();
    engine.acts_at_station = true;
    let station_m = engine.position_m;
    for (vehicle, station_m) in
        [(Vehicle::load("slocum-paper").unwrap(), 0.0), (lopsided(), 0.0), (in_the_nose, station_m)]
    {
        let plant = Plant::<f64>::new(&vehicle);
        let exact = Plant::<Dual>::new(&vehicle);
        for (state, input) in random_states(&plant, 200) {
            let moving = as_dual(&state, &plant.derivative(&state, &input, &plant.still()));
            let energy = exact.kinetic_energy_j(&moving) + exact.potential_energy_j(&moving);
            let rate_w = energy.eps.unwrap_generic(nalgebra::Const::<1>, nalgebra::Const::<1>)[0];
            let viscous = plant.viscous_in(&state);
            let ahead = rotation_from_quaternion(&state.quaternion).column(0) * station_m;
            let depth_m = state.position_m.z + ahead.z;
            let buoyant_w = vehicle.water.density_kg_m3 * vehicle.water.gravity_m_s2 * depth_m * input.u_b_m3_s;
            let work_w = viscous.force_n.dot(&state.velocity_m_s)
                + viscous.moment_nm.dot(&state.rate_rad_s)
                + input.u_px_n * state.r_px_rate_m_s
                + input.u_mu_nm * state.mu_rate_rad_s
                + buoyant_w;
            // Terms of some 100 W cancel.
            assert!((rate_w - work_w).abs() < 1e-11, "{rate_w} W gained, {work_w} W done");
        }
    }
}

/// Left and right are alike for a symmetric vehicle: mirrored states have mirrored rates, to the last bit but rounding.
#[test]
fn a_mirrored_state_moves_as_a_mirror_image() {
    let plant = Plant::<f64>::new(&Vehicle::load("slocum-paper").unwrap());
    let across = Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0));
    let mirrored = |state: &State<f64>| State {
        position_m: across * state.position_m,
        quaternion: {
            let euler = euler_from_quaternion(&state.quaternion);
            quaternion_from_euler(&Vector3::new(-euler.x, euler.y, -euler.z))
        },
        velocity_m_s: across * state.velocity_m_s,
        rate_rad_s: -(across * state.rate_rad_s),
        mu_rad: -state.mu_rad,
        mu_rate_rad_s: -state.mu_rate_rad_s,
        ..*state
    };
    for (state, input) in random_states(&plant, 100) {
        let reversed = Input { u_mu_nm: -input.u_mu_nm, ..input };
        let water = plant.still();
        let (one, other) =
            (plant.derivative(&state, &input, &water), plant.derivative(&mirrored(&state), &reversed, &water));
        let size = one.mu_rate_rad_s.abs().max(1.0);
        assert!((across * one.velocity_m_s - other.velocity_m_s).amax() < 1e-12 * size);
        assert!((across * one.rate_rad_s + other.rate_rad_s).amax() < 1e-12 * size);
        assert!((one.mu_rate_rad_s + other.mu_rate_rad_s).abs() < 1e-12 * size);
    }
}

/// Where other simulators blow up: at rest, flow from behind and abeam, 90° of incidence, with added mass above the body's.
///
/// The linear law of moments may feed rotation, so energy need not fall; but it changes by the work done and by nothing else.
#[test]
fn strange_flow_is_finite_and_its_energy_balances() {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    vehicle.added_mass.mass_kg *= 10.0;
    vehicle.water.gravity_m_s2 = 0.0;
    let plant = Plant::<f64>::new(&vehicle);
    let particle = Particle::Driven { u_b_m3_s: 0.0 };
    let directions =
        [[0.0; 3], [-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [-0.3, 0.0, -1.0], [1e-12, -1e-12, 1e-12]];
    for velocity in directions {
        let mut state = State { velocity_m_s: velocity.into(), ..State::at_rest(plant.displaced_volume_m3(0.0)) };
        let before_j = plant.kinetic_energy_j(&state);
        let (dt_s, mut work_j) = (5e-3, 0.0);
        let power_w = |state: &State<f64>| {
            let viscous = plant.viscous_in(state);
            viscous.force_n.dot(&state.velocity_m_s) + viscous.moment_nm.dot(&state.rate_rad_s)
        };
        for _ in 0..2_000 {
            let middle = rk4_step(&plant, &state, &particle, 0.5 * dt_s, &plant.still());
            let next = rk4_step(&plant, &middle, &particle, 0.5 * dt_s, &plant.still());
            // Simpson's rule.
            work_j += dt_s / 6.0 * (power_w(&state) + 4.0 * power_w(&middle) + power_w(&next));
            state = next;
        }
        let gained_j = plant.kinetic_energy_j(&state) - before_j;
        assert!(gained_j.is_finite() && state.velocity_m_s.norm() < 2.0, "{velocity:?} ends as {state:?}");
        assert!(
            (gained_j - work_j).abs() < 1e-6 * before_j.max(1e-6),
            "{velocity:?}: {gained_j} J gained, {work_j} J done"
        );
    }
    let hot = Dual::constant(0.0).derivative(0);
    let still = State { velocity_m_s: Vector3::new(hot, hot, hot), ..State::at_rest(Dual::constant(0.05)) };
    let plant = Plant::<Dual>::new(&vehicle);
    let rates = plant.derivative(&still, &Input::none(), &plant.still());
    assert!(rates.velocity_m_s.iter().all(|rate| rate.re.is_finite()), "derivatives at rest exist");
}
