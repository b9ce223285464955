//! The equations of motion derived anew: Lagrange's equations in Euler angles, from nothing but the two energies.
//!
//! `d/dt ∂L/∂q̇ − ∂L/∂q = Q` with q = (north, east, down, φ, θ, ψ, r_px, μ), the derivatives of L by second-order dual numbers.
//! Nothing of the plant's own algebra (momenta, M, Ṁ, quasi-velocities) is used.

mod common;

use common::{lopsided, random_states};
use nalgebra::{Matrix3, SMatrix, SVector, Vector3};
use num_dual::{Dual2SVec64, DualNum, hessian};
use sim_host::model::{
    plant::{Input, Plant, State, euler_from_quaternion, rotation_from_quaternion},
    vehicle::Vehicle,
};

type Eight = SVector<f64, 8>;
type Sixteen = SVector<f64, 16>;
/// A function of (q, q̇) with its gradient and Hessian.
type D = Dual2SVec64<16>;

/// T − U at (q, q̇).
fn lagrangian(vehicle: &Vehicle, displaced_volume_m3: f64, x: &SVector<D, 16>) -> D {
    let constant = |m: &Matrix3<f64>| m.map(D::from);
    let (body, added, mass) = (&vehicle.body, &vehicle.added_mass, &vehicle.moving_mass);
    let to_inertial = rotation(x);
    let velocity = to_inertial.transpose() * Vector3::new(x[8], x[9], x[10]);
    let rate = body_rate(x);
    let half = D::from(0.5);
    let square = |v: &Vector3<D>| v.dot(v);

    let centre = body.centre_of_mass_m;
    let hat = centre.cross_matrix();
    let about_centre = constant(&(body.inertia_kg_m2 + hat * hat * body.mass_kg));
    let rigid = square(&(velocity + rate.cross(&centre.map(D::from)))) * D::from(body.mass_kg)
        + rate.dot(&(about_centre * rate))
        + square(&velocity) * D::from(body.ballast_kg);
    let water = velocity.dot(&(constant(&added.mass_kg) * velocity))
        + rate.dot(&(constant(&added.coupling_kg_m) * velocity)) * D::from(2.0)
        + rate.dot(&(constant(&added.inertia_kg_m2) * rate));

    let (r_px, mu, r_px_rate, mu_rate) = (x[6], x[7], x[14], x[15]);
    let radius = D::from(mass.radius_m);
    let place = Vector3::new(r_px, -radius * mu.sin(), radius * mu.cos());
    let drift = Vector3::new(r_px_rate, -radius * mu.cos() * mu_rate, -radius * mu.sin() * mu_rate);
    let zero = D::from(0.0);
    let from_particle = Matrix3::new(D::from(1.0), zero, zero, zero, -mu.sin(), -mu.cos(), zero, mu.cos(), -mu.sin());
    let spin = from_particle.transpose() * (rate + Vector3::new(mu_rate, zero, zero));
    let own = spin.component_mul(&mass.inertia_kg_m2.map(D::from)).dot(&spin);
    let particle = square(&(velocity + rate.cross(&place) + drift)) * D::from(mass.mass_kg) + own;

    let gravity = D::from(vehicle.water.gravity_m_s2);
    let net_mass = D::from(vehicle.mass_kg() - vehicle.water.density_kg_m3 * displaced_volume_m3);
    let depth_of = |point: &Vector3<D>| (to_inertial * point).z;
    let mut held = net_mass * x[2]
        + depth_of(&centre.map(D::from)) * D::from(body.mass_kg)
        + depth_of(&place) * D::from(mass.mass_kg);
    if let Some(engine) = vehicle.buoyancy.as_ref().filter(|engine| engine.acts_at_station) {
        let beyond_neutral_m3 = displaced_volume_m3 - vehicle.neutral_volume_m3();
        let station = Vector3::new(engine.position_m, 0.0, 0.0).map(D::from);
        held -= depth_of(&station) * D::from(vehicle.water.density_kg_m3 * beyond_neutral_m3);
    }
    let potential = -gravity * held;
    (rigid + water + particle) * half - potential
}

/// R_IB = exp(ê3 ψ) exp(ê2 θ) exp(ê1 φ).
fn rotation(x: &SVector<D, 16>) -> Matrix3<D> {
    let (phi, theta, psi) = (x[3], x[4], x[5]);
    let (zero, one) = (D::from(0.0), D::from(1.0));
    let about_1 = Matrix3::new(one, zero, zero, zero, phi.cos(), -phi.sin(), zero, phi.sin(), phi.cos());
    let about_2 = Matrix3::new(theta.cos(), zero, theta.sin(), zero, one, zero, -theta.sin(), zero, theta.cos());
    let about_3 = Matrix3::new(psi.cos(), -psi.sin(), zero, psi.sin(), psi.cos(), zero, zero, zero, one);
    about_3 * about_2 * about_1
}

/// ω from the rates of the Euler angles.
fn body_rate(x: &SVector<D, 16>) -> Vector3<D> {
    let (phi, theta) = (x[3], x[4]);
    let (roll, pitch, turn) = (x[11], x[12], x[13]);
    Vector3::new(
        roll - turn * theta.sin(),
        pitch * phi.cos() + turn * theta.cos() * phi.sin(),
        -pitch * phi.sin() + turn * theta.cos() * phi.cos(),
    )
}

/// (q, q̇) of a state.
fn coordinates(state: &State<f64>) -> Sixteen {
    let euler = euler_from_quaternion(&state.quaternion);
    let (sin_roll, cos_roll) = euler.x.sin_cos();
    let (p, q, r) = (state.rate_rad_s.x, state.rate_rad_s.y, state.rate_rad_s.z);
    let turn = (q * sin_roll + r * cos_roll) / euler.y.cos();
    let rates = Vector3::new(p + turn * euler.y.sin(), q * cos_roll - r * sin_roll, turn);
    let ground = rotation_from_quaternion(&state.quaternion) * state.velocity_m_s;
    let x = state.position_m;
    Sixteen::from([
        x.x,
        x.y,
        x.z,
        euler.x,
        euler.y,
        euler.z,
        state.r_px_m,
        state.mu_rad,
        ground.x,
        ground.y,
        ground.z,
        rates.x,
        rates.y,
        rates.z,
        state.r_px_rate_m_s,
        state.mu_rate_rad_s,
    ])
}

/// Accelerations (v̇, ω̇, r̈_px, μ̈) by Lagrange's equations.
fn by_lagrange(vehicle: &Vehicle, plant: &Plant<f64>, state: &State<f64>, input: &Input<f64>) -> Eight {
    let x = coordinates(state);
    let rates: Eight = x.fixed_rows::<8>(8).into();
    let (_, gradient, second) = hessian(|x| lagrangian(vehicle, state.displaced_volume_m3, &x), &x);
    let inertia: SMatrix<f64, 8, 8> = second.fixed_view::<8, 8>(8, 8).into();
    let mixed: SMatrix<f64, 8, 8> = second.fixed_view::<8, 8>(8, 0).into();

    // How each ω depends on (q, q̇): its rows give virtual work and, later, ω̇.
    let rows: [Sixteen; 3] = std::array::from_fn(|i| hessian(|x| body_rate(&x)[i], &x).1);
    let viscous = plant.viscous_in(state);
    let to_inertial = rotation_from_quaternion(&state.quaternion);
    let mut forces = Eight::zeros();
    forces.fixed_rows_mut::<3>(0).copy_from(&(to_inertial * viscous.force_n));
    for (row, moment) in rows.iter().zip(viscous.moment_nm.iter()) {
        forces += row.fixed_rows::<8>(8) * *moment;
    }
    forces[6] += input.u_px_n;
    forces[7] += input.u_mu_nm;

    let acceleration = inertia.lu().solve(&(forces + gradient.fixed_rows::<8>(0) - mixed * rates)).unwrap();
    let ground: Vector3<f64> = acceleration.fixed_rows::<3>(0).into();
    let velocity = to_inertial.transpose() * ground - state.rate_rad_s.cross(&state.velocity_m_s);
    let mut all = Eight::zeros();
    all.fixed_rows_mut::<3>(0).copy_from(&velocity);
    for (i, row) in rows.iter().enumerate() {
        all[3 + i] = row.fixed_rows::<8>(0).dot(&rates) + row.fixed_rows::<8>(8).dot(&acceleration);
    }
    all[6] = acceleration[6];
    all[7] = acceleration[7];
    all
}

/// The two derivations agree to rounding: 1e-12 of the largest acceleration, which the light swinging mass has.
#[test]
fn the_plant_obeys_lagranges_equations_at_random_states() {
    let mut in_the_nose = lopsided();
    in_the_nose.buoyancy.as_mut().unwrap().acts_at_station = true;
    for vehicle in [Vehicle::load("slocum-paper").unwrap(), lopsided(), in_the_nose] {
        let plant = Plant::<f64>::new(&vehicle);
        let mut worst = 0.0_f64;
        for (state, input) in random_states(&plant, 200) {
            let reference = by_lagrange(&vehicle, &plant, &state, &input);
            let rates = plant.derivative(&state, &input, &plant.still());
            let (v, w) = (rates.velocity_m_s, rates.rate_rad_s);
            let ours = Eight::from([v.x, v.y, v.z, w.x, w.y, w.z, rates.r_px_rate_m_s, rates.mu_rate_rad_s]);
            worst = worst.max((ours - reference).amax() / reference.amax().max(1.0));
        }
        assert!(worst < 1e-12, "{}: {worst:.1e}", vehicle.name);
    }
}
