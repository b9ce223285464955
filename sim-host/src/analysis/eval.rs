//! `glider eval`: one state through the equations, every intermediate shown.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::model::{
    plant::{Input, Plant, State, quaternion_from_euler},
    vehicle::Vehicle,
};

/// A state and the inputs, applied raw: no motor, brake or limit.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Request {
    /// North, east, down, m.
    pub position_m: [f64; 3],
    /// Roll, pitch, heading, rad.
    pub euler_rad: [f64; 3],
    /// Body axes, m/s.
    pub velocity_m_s: [f64; 3],
    /// Body axes, rad/s.
    pub rate_rad_s: [f64; 3],
    /// Axial position of the particle, m.
    pub r_px_m: f64,
    /// Its rate, m/s.
    pub r_px_rate_m_s: f64,
    /// Polar angle of the particle, rad.
    pub mu_rad: f64,
    /// Its rate, rad/s.
    pub mu_rate_rad_s: f64,
    /// V_d, m³.
    pub displaced_volume_m3: f64,
    /// u_px, u_μ, u_b.
    pub input: RequestInput,
}

/// Inputs of the plant.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RequestInput {
    /// N.
    pub u_px_n: f64,
    /// N m.
    pub u_mu_nm: f64,
    /// m³/s.
    pub u_b_m3_s: f64,
}

/// What the equations make of it.
#[derive(Clone, Debug, Serialize)]
pub struct Answer {
    /// M, rows.
    pub mass_matrix: [[f64; 8]; 8],
    /// (p, h, p_px, h_px).
    pub momentum: [f64; 8],
    /// f_v, body axes, N.
    pub viscous_force_n: [f64; 3],
    /// m_v, body axes, N m.
    pub viscous_moment_nm: [f64; 3],
    /// T, J.
    pub kinetic_energy_j: f64,
    /// U, J.
    pub potential_energy_j: f64,
    /// Rates of the state.
    pub derivative: Derivative,
}

/// Rates of the state.
#[derive(Clone, Debug, Serialize)]
pub struct Derivative {
    /// Ẋ, north, east, down.
    pub position_m_s: [f64; 3],
    /// φ̇, θ̇, ψ̇; not a number at θ = ±90°, where they do not exist.
    pub euler_rad_s: [f64; 3],
    /// v̇, body axes.
    pub velocity_m_s2: [f64; 3],
    /// ω̇, body axes.
    pub rate_rad_s2: [f64; 3],
    /// r̈_px.
    pub r_px_m_s2: f64,
    /// μ̈.
    pub mu_rad_s2: f64,
    /// V̇_d.
    pub displaced_volume_m3_s: f64,
}

/// Evaluates a state in unbounded water, all eight degrees of freedom free.
#[must_use]
pub fn eval(vehicle: &Vehicle, request: &Request) -> Answer {
    let plant = Plant::<f64>::new(vehicle);
    let state = State {
        position_m: request.position_m.into(),
        quaternion: quaternion_from_euler(&request.euler_rad.into()),
        velocity_m_s: request.velocity_m_s.into(),
        rate_rad_s: request.rate_rad_s.into(),
        r_px_m: request.r_px_m,
        r_px_rate_m_s: request.r_px_rate_m_s,
        mu_rad: request.mu_rad,
        mu_rate_rad_s: request.mu_rate_rad_s,
        displaced_volume_m3: request.displaced_volume_m3,
    };
    let RequestInput { u_px_n, u_mu_nm, u_b_m3_s } = request.input;
    let rates = plant.derivative(&state, &Input { u_px_n, u_mu_nm, u_b_m3_s }, &plant.still());
    let viscous = plant.viscous_in(&state);
    Answer {
        mass_matrix: plant.mass_matrix(state.r_px_m, state.mu_rad).transpose().into(),
        momentum: plant.momentum(&state).into(),
        viscous_force_n: viscous.force_n.into(),
        viscous_moment_nm: viscous.moment_nm.into(),
        kinetic_energy_j: plant.kinetic_energy_j(&state),
        potential_energy_j: plant.potential_energy_j(&state),
        derivative: Derivative {
            position_m_s: rates.position_m.into(),
            euler_rad_s: euler_rates(&request.euler_rad.into(), &state.rate_rad_s).into(),
            velocity_m_s2: rates.velocity_m_s.into(),
            rate_rad_s2: rates.rate_rad_s.into(),
            r_px_m_s2: rates.r_px_rate_m_s,
            mu_rad_s2: rates.mu_rate_rad_s,
            displaced_volume_m3_s: rates.displaced_volume_m3,
        },
    }
}

/// Equation (2) for 3-2-1 Euler angles.
fn euler_rates(euler_rad: &Vector3<f64>, rate_rad_s: &Vector3<f64>) -> Vector3<f64> {
    let (sin_roll, cos_roll) = libm::sincos(euler_rad.x);
    let (p, q, r) = (rate_rad_s.x, rate_rad_s.y, rate_rad_s.z);
    let across = q * sin_roll + r * cos_roll;
    Vector3::new(p + across * libm::tan(euler_rad.y), q * cos_roll - r * sin_roll, across / libm::cos(euler_rad.y))
}
