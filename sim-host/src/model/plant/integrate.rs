//! Classical Runge–Kutta of fourth order, fixed step.

use nalgebra::Vector4;

use super::{Input, Medium, Plant, State};
use crate::model::real::Real;

/// How the particle is held during a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Particle<T: Real> {
    /// Free under its inputs: eight degrees of freedom.
    Free(Input<T>),
    /// On its present speed, whatever force that takes: six degrees of freedom.
    Driven {
        /// Rate of displaced volume, m³/s.
        u_b_m3_s: T,
    },
}

/// The state `dt_s` later.
#[must_use]
pub fn rk4_step<T: Real>(
    plant: &Plant<T>,
    state: &State<T>,
    particle: &Particle<T>,
    dt_s: T,
    water: &impl Medium<T>,
) -> State<T> {
    // A particle at rest stays where it is for the whole step.
    let at_rest = state.r_px_rate_m_s.value() == 0.0 && state.mu_rate_rad_s.value() == 0.0;
    let held = at_rest.then(|| plant.held(state));
    let rate = |state: &State<T>, into_step_s: T| {
        let around = water.around(&state.position_m, into_step_s);
        match (particle, &held) {
            (Particle::Free(input), _) => plant.derivative(state, input, &around),
            (Particle::Driven { u_b_m3_s }, Some(held)) => plant.derivative_held(state, held, *u_b_m3_s, &around),
            (Particle::Driven { u_b_m3_s }, None) => plant.derivative_driven(state, *u_b_m3_s, &around),
        }
    };
    let half = dt_s * T::constant(0.5);
    let k1 = rate(state, T::constant(0.0));
    let k2 = rate(&state.plus(&k1, half), half);
    let k3 = rate(&state.plus(&k2, half), half);
    let k4 = rate(&state.plus(&k3, dt_s), dt_s);
    let (sixth, third) = (dt_s * T::constant(1.0 / 6.0), dt_s * T::constant(1.0 / 3.0));
    state.plus(&k1, sixth).plus(&k2, third).plus(&k3, third).plus(&k4, sixth).with_unit_quaternion()
}

impl<T: Real> State<T> {
    /// Every field plus `dt_s` times the same field of `rate`.
    fn plus(&self, rate: &Self, dt_s: T) -> Self {
        Self {
            position_m: self.position_m + rate.position_m * dt_s,
            quaternion: self.quaternion + rate.quaternion * dt_s,
            velocity_m_s: self.velocity_m_s + rate.velocity_m_s * dt_s,
            rate_rad_s: self.rate_rad_s + rate.rate_rad_s * dt_s,
            r_px_m: self.r_px_m + rate.r_px_m * dt_s,
            r_px_rate_m_s: self.r_px_rate_m_s + rate.r_px_rate_m_s * dt_s,
            mu_rad: self.mu_rad + rate.mu_rad * dt_s,
            mu_rate_rad_s: self.mu_rate_rad_s + rate.mu_rate_rad_s * dt_s,
            displaced_volume_m3: self.displaced_volume_m3 + rate.displaced_volume_m3 * dt_s,
        }
    }

    fn with_unit_quaternion(&self) -> Self {
        let q: Vector4<T> = self.quaternion;
        let norm = (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
        Self { quaternion: q / norm, ..*self }
    }
}
