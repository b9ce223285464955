//! The reduced model: forward and downward speed, driven by what is measured.
//!
//! Rows 1 and 3 of the momentum balance (4) with the wings level, the attitude and its rate taken from the instruments and the
//! net mass from the buoyancy device. Its steady state is the glide polar; through an inflection it keeps the speed that the
//! quasi-steady balance forgets.

use crate::{math, vehicle::GlideConstants};

/// Velocity through the water in the body's plane of symmetry.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reduced {
    /// Forward, m/s.
    pub u_m_s: f32,
    /// Down through the belly, m/s.
    pub w_m_s: f32,
}

/// What drives the model.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Pitch, rad.
    pub pitch_rad: f32,
    /// Pitch rate, rad/s.
    pub pitch_rate_rad_s: f32,
    /// Net weight: net mass × gravity, N, positive sinks.
    pub net_weight_n: f32,
}

/// No glider is faster; beyond it the inputs were wrong, and a bounded answer is better than none.
const FASTEST_M_S: f32 = 5.0;

impl Reduced {
    /// The velocity `dt_s` later (midpoint rule). Stays finite whatever the drive.
    #[must_use]
    pub fn step(self, vehicle: &GlideConstants, drive: &Drive, dt_s: f32) -> Self {
        let (sin_pitch, cos_pitch) = (math::sin(drive.pitch_rad), math::cos(drive.pitch_rad));
        let weight = (-drive.net_weight_n * sin_pitch, drive.net_weight_n * cos_pitch);
        let (u_dot, w_dot) = self.acceleration(vehicle, weight, drive.pitch_rate_rad_s);
        let middle = self.advanced(u_dot, w_dot, 0.5 * dt_s);
        let (u_dot, w_dot) = middle.acceleration(vehicle, weight, drive.pitch_rate_rad_s);
        self.advanced(u_dot, w_dot, dt_s)
    }

    /// Speed through the water, m/s.
    #[must_use]
    pub fn speed_m_s(self) -> f32 {
        math::sqrt(self.u_m_s * self.u_m_s + self.w_m_s * self.w_m_s)
    }

    fn advanced(self, u_dot: f32, w_dot: f32, dt_s: f32) -> Self {
        let bounded = |x: f32| math::clamp(math::finite_or(x, 0.0), -FASTEST_M_S, FASTEST_M_S);
        Self { u_m_s: bounded(self.u_m_s + dt_s * u_dot), w_m_s: bounded(self.w_m_s + dt_s * w_dot) }
    }

    /// Body-axis accelerations, m/s², under a net weight given in body axes, N.
    fn acceleration(self, vehicle: &GlideConstants, weight: (f32, f32), pitch_rate_rad_s: f32) -> (f32, f32) {
        let (u, w) = (self.u_m_s, self.w_m_s);
        let speed = self.speed_m_s();
        let alpha = math::atan2(w, u);
        let lift_factor = vehicle.lift_zero + vehicle.lift_alpha * alpha;
        // Both per unit speed, so that no division by the speed is left.
        let lift = lift_factor * speed;
        let drag = (vehicle.drag_zero + vehicle.drag_induced * lift_factor * lift_factor) * speed;
        let x = lift * w - drag * u;
        let z = -lift * u - drag * w;
        let (weight_x, weight_z) = weight;
        (
            (x + weight_x - vehicle.mass_w_kg * w * pitch_rate_rad_s) / vehicle.mass_u_kg,
            (z + weight_z + vehicle.mass_u_kg * u * pitch_rate_rad_s) / vehicle.mass_w_kg,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The paper's Slocum: trim of section 5.1 is 0.77 m/s at −35° with 0.2129 kg, α 1.2247°.
    const SLOCUM: GlideConstants = GlideConstants {
        mass_u_kg: 55.0,
        mass_w_kg: 120.0,
        drag_zero: 2.0,
        drag_induced: 45.0 / (135.0 * 135.0),
        lift_zero: 0.0,
        lift_alpha: 135.0,
    };

    #[test]
    fn settles_on_the_papers_glide() {
        let pitch_rad = (-35.0_f32 + 1.2247).to_radians();
        let drive = Drive { pitch_rad, pitch_rate_rad_s: 0.0, net_weight_n: 0.2129 * 9.81 };
        let mut state = Reduced::default();
        for _ in 0..2_000 {
            state = state.step(&SLOCUM, &drive, 0.25);
        }
        // 0.2129 kg is given to four digits, and speed goes with its root: half of 2.3e-4, relative.
        assert!((state.speed_m_s() - 0.77).abs() < 3e-4, "{state:?}");
        assert!((state.w_m_s.atan2(state.u_m_s).to_degrees() - 1.2247).abs() < 1e-2);
    }

    #[test]
    fn stays_finite_under_any_drive() {
        for pitch_rad in [-1.5, 0.0, 1.5, f32::NAN] {
            for net_weight_n in [-1e6, 0.0, 3.0, f32::INFINITY] {
                let drive = Drive { pitch_rad, pitch_rate_rad_s: 10.0, net_weight_n };
                let mut state = Reduced { u_m_s: -3.0, w_m_s: 4.0 };
                for _ in 0..100 {
                    state = state.step(&SLOCUM, &drive, 0.25);
                    assert!(state.u_m_s.is_finite() && state.w_m_s.is_finite());
                }
            }
        }
    }
}
