//! What several tests of the plant need.

#[allow(dead_code, reason = "not every test file needs it")]
mod interval;

#[allow(unused_imports, reason = "not every test file needs it")]
pub(crate) use interval::Interval;

use nalgebra::{Matrix3, Vector3};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sim_host::model::{
    plant::{Input, Plant, State, quaternion_from_euler},
    vehicle::Vehicle,
};

/// The paper's Slocum made lopsided, so that no term of the equations vanishes by symmetry.
#[allow(dead_code, reason = "not every test file needs it")]
pub(crate) fn lopsided() -> Vehicle {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    let skew = Matrix3::new(0.0, 0.3, -0.2, 0.3, 0.0, 0.4, -0.2, 0.4, 0.0);
    vehicle.name = "lopsided".into();
    vehicle.body.centre_of_mass_m = Vector3::new(-0.02, 0.03, 0.07);
    vehicle.body.inertia_kg_m2 += skew;
    vehicle.added_mass.mass_kg += skew * 10.0;
    vehicle.added_mass.inertia_kg_m2 -= skew;
    vehicle.added_mass.coupling_kg_m = Matrix3::new(0.5, -1.0, 0.8, 1.2, 0.4, -2.0, 0.7, 3.0, -0.6);
    vehicle.moving_mass.inertia_kg_m2 = Vector3::new(0.02, 0.4, 0.17);
    vehicle
}

/// The vehicle without gravity, and in a fluid that has inertia but exerts no force: zero area, no gravity.
#[allow(dead_code, reason = "not every test file needs it")]
pub(crate) fn unforced(mut vehicle: Vehicle) -> Plant<f64> {
    vehicle.hydrodynamics.area_m2 = 0.0;
    vehicle.water.gravity_m_s2 = 0.0;
    Plant::new(&vehicle)
}

/// General states with inputs: every degree of freedom moves.
#[allow(dead_code, reason = "not every test file needs it")]
pub(crate) fn random_states(plant: &Plant<f64>, count: usize) -> Vec<(State<f64>, Input<f64>)> {
    let mut random = Pcg64Mcg::seed_from_u64(20_130_501);
    let mut within = move |size: f64| random.random_range(-size..size);
    let mut vector = |size: f64| Vector3::new(within(size), within(size), within(size));
    (0..count)
        .map(|_| {
            let (drives, euler) = (vector(1.0), vector(1.4));
            let (particle, net_mass_kg) = (vector(0.5), vector(0.3).x);
            let state = State {
                position_m: vector(10.0),
                quaternion: quaternion_from_euler(&euler),
                velocity_m_s: vector(1.0),
                rate_rad_s: vector(0.6),
                r_px_m: particle.x,
                r_px_rate_m_s: 0.2 * particle.y,
                mu_rad: 3.0 * euler.x,
                mu_rate_rad_s: particle.z,
                ..State::at_rest(plant.displaced_volume_m3(net_mass_kg))
            };
            (state, Input { u_px_n: 10.0 * drives.x, u_mu_nm: drives.y, u_b_m3_s: 1e-5 * drives.z })
        })
        .collect()
}
