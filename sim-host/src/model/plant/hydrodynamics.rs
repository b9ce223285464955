//! Section 4 of the equations: viscous force and moment.

use nalgebra::Vector3;

use super::{Plant, State};
use crate::model::{real::Real, vehicle::MomentFrame};

/// Direction of the oncoming flow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow<T: Real> {
    /// V, m/s.
    pub speed_m_s: T,
    /// α = atan2(w, u), rad.
    pub alpha_rad: T,
    /// β = asin(v/V), rad.
    pub beta_rad: T,
    /// Cosine and sine of α: from the velocity, since it has them already.
    alpha_unit: (T, T),
    /// Cosine and sine of β.
    beta_unit: (T, T),
}

impl<T: Real> Flow<T> {
    /// Of a velocity in body axes; all angles zero at rest.
    #[must_use]
    pub fn new(velocity_m_s: &Vector3<T>) -> Self {
        let (u, v, w) = (velocity_m_s.x, velocity_m_s.y, velocity_m_s.z);
        let in_plane = T::hypot(u, w);
        let speed_m_s = T::hypot(in_plane, v);
        let (alpha_rad, alpha_unit) = direction(u, w, in_plane);
        let (beta_rad, beta_unit) = direction(in_plane, v, speed_m_s);
        Self { speed_m_s, alpha_rad, beta_rad, alpha_unit, beta_unit }
    }

    /// R_BC(α, β): a vector from the axes of the oncoming flow to body axes.
    fn to_body(self, vector: &Vector3<T>) -> Vector3<T> {
        let ((ca, sa), (cb, sb)) = (self.alpha_unit, self.beta_unit);
        Vector3::new(
            ca * cb * vector.x - ca * sb * vector.y - sa * vector.z,
            sb * vector.x + cb * vector.y,
            sa * cb * vector.x - sa * sb * vector.y + ca * vector.z,
        )
    }
}

/// Angle, and its cosine and sine, of the vector (x, y) of that length; zero and (1, 0) for no vector.
fn direction<T: Real>(x: T, y: T, length: T) -> (T, (T, T)) {
    if length.value() > 0.0 {
        (y.atan2(x), (x / length, y / length))
    } else {
        (T::constant(0.0), (T::constant(1.0), T::constant(0.0)))
    }
}

/// Viscous force and moment, body axes, with the coefficients they come from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viscous<T: Real> {
    /// f_v, N.
    pub force_n: Vector3<T>,
    /// m_v, N m.
    pub moment_nm: Vector3<T>,
    /// C_L of attached flow.
    pub lift_coefficient: T,
    /// C_D of attached flow.
    pub drag_coefficient: T,
}

impl<T: Real> Plant<T> {
    /// Viscous force and moment at a velocity and a rate (body axes, relative to the water) in water of some density.
    ///
    /// The rate derivatives are scaled by the constant nominal speed, so a damping moment grows with V² times the rate.
    #[must_use]
    pub fn viscous(&self, velocity_m_s: &Vector3<T>, rate_rad_s: &Vector3<T>, density_kg_m3: T) -> Viscous<T> {
        let c = &self.coefficients;
        let flow = Flow::new(velocity_m_s);
        let (alpha, beta) = (flow.alpha_rad, flow.beta_rad);
        let per_speed = T::constant(0.5) / self.nominal_speed_m_s;
        let p = rate_rad_s.x * c.span_m * per_speed;
        let q = rate_rad_s.y * c.chord_m * per_speed;
        let r = rate_rad_s.z * c.span_m * per_speed;
        let lateral = |[b, by_p, by_r]: [T; 3]| b * beta + by_p * p + by_r * r;
        let longitudinal = |[zero, a, by_q]: [T; 3]| zero + a * alpha + by_q * q;

        let lift_coefficient = longitudinal(c.lift);
        let drag_coefficient = c.drag[0] + c.drag[1] * lift_coefficient * lift_coefficient;
        // Y is positive along b2; lift and drag oppose the flow axes 3 and 1.
        let in_flow_axes = Vector3::new(-drag_coefficient, lateral(c.side), -lift_coefficient);
        let moment =
            Vector3::new(lateral(c.roll) * c.span_m, longitudinal(c.pitch) * c.chord_m, lateral(c.yaw) * c.span_m);

        let pressure_n = T::constant(0.5) * density_kg_m3 * flow.speed_m_s * flow.speed_m_s * c.area_m2;
        let moment = match self.moment_frame {
            MomentFrame::Body => moment,
            MomentFrame::Current => flow.to_body(&moment),
        };
        let attached = (flow.to_body(&in_flow_axes) * pressure_n, moment * pressure_n);
        let (force_n, moment_nm) = self.blended(attached, density_kg_m3, velocity_m_s, rate_rad_s);
        Viscous { force_n, moment_nm, lift_coefficient, drag_coefficient }
    }

    /// Viscous force and moment in a state, in the static water.
    #[must_use]
    pub fn viscous_in(&self, state: &State<T>) -> Viscous<T> {
        self.viscous(&state.velocity_m_s, &state.rate_rad_s, self.density_kg_m3)
    }
}
