//! Surface swell: linear (Airy) theory of one wave in deep water.
//!
//! Water particles go round in orbits that shrink with depth as `e^(−k z)`, `k = ω²/g`. An orbit is faster at its top than at its
//! bottom, and so whatever floats along drifts by Stokes' `a² ω k e^(−2 k z)`: the drift comes out of the orbits by
//! itself, and adding it again would count it twice. Above depth 0 the orbital velocity is held at its value there.

use nalgebra::{Matrix3, Vector3};

use super::motion::{Motion, towards};

/// One wave train.
#[derive(Clone, Debug)]
pub(super) struct Swell {
    amplitude_m: f64,
    /// ω, rad/s.
    frequency_rad_s: f64,
    /// k, rad/m.
    wavenumber_rad_m: f64,
    gravity_m_s2: f64,
    /// Unit vector towards which it runs.
    direction: Vector3<f64>,
}

/// What the swell does at one place and time.
#[derive(Clone, Copy, Debug)]
pub(super) struct Orbit {
    pub(super) motion: Motion,
    /// Height of the surface above depth 0, m.
    pub(super) surface_m: f64,
    /// Pressure beyond the hydrostatic one, over the density, m²/s².
    pub(super) pressure_per_density: f64,
}

impl Swell {
    /// Of a height from trough to crest, m, and a period, s.
    pub(super) fn new(height_m: f64, period_s: f64, direction_deg: f64, gravity_m_s2: f64) -> Self {
        let frequency_rad_s = std::f64::consts::TAU / period_s;
        Self {
            amplitude_m: 0.5 * height_m,
            frequency_rad_s,
            wavenumber_rad_m: frequency_rad_s * frequency_rad_s / gravity_m_s2,
            gravity_m_s2,
            direction: towards(direction_deg),
        }
    }

    /// Wavelength, m.
    pub(super) fn wavelength_m(&self) -> f64 {
        std::f64::consts::TAU / self.wavenumber_rad_m
    }

    pub(super) fn at(&self, position_m: &Vector3<f64>, time_s: f64) -> Orbit {
        let (k, omega) = (self.wavenumber_rad_m, self.frequency_rad_s);
        let (sin, cos) = libm::sincos(k * self.direction.dot(position_m) - omega * time_s);
        let decay = libm::exp(-k * position_m.z.max(0.0));
        let speed_m_s = self.amplitude_m * omega * decay;
        let (along, down) = (self.direction, Vector3::z());
        let below = if position_m.z < 0.0 { 0.0 } else { 1.0 };
        let by_distance = (along * -sin - down * cos) * (speed_m_s * k);
        let by_depth = (down * sin - along * cos) * (speed_m_s * k * below);
        let gradient_per_s: Matrix3<f64> = by_distance * along.transpose() + by_depth * down.transpose();
        let motion = Motion {
            velocity_m_s: (along * cos - down * sin) * speed_m_s,
            rate_m_s2: (along * sin + down * cos) * (speed_m_s * omega),
            gradient_per_s,
        };
        let surface_m = self.amplitude_m * cos;
        Orbit { motion, surface_m, pressure_per_density: self.gravity_m_s2 * surface_m * decay }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ocean::motion::tests::assert_derivatives;

    fn swell() -> Swell {
        Swell::new(2.0, 8.0, 37.0, 9.81)
    }

    #[test]
    fn the_orbits_are_divergence_free_irrotational_and_fade_with_depth() {
        let swell = swell();
        assert_derivatives(|at, time_s| swell.at(at, time_s).motion, 1.0);
        let at = |depth_m: f64| swell.at(&Vector3::new(3.0, 5.0, depth_m), 2.0).motion;
        let gradient = at(4.0).gradient_per_s;
        assert!((gradient - gradient.transpose()).amax() < 1e-15);
        // Half a wavelength down, e^(−π) is left.
        let left = at(0.5 * swell.wavelength_m()).velocity_m_s.norm() / at(0.0).velocity_m_s.norm();
        assert!((left - (-std::f64::consts::PI).exp()).abs() < 1e-12);
    }

    /// The equation of motion of the water itself, linearised: ∂c/∂t = −∇p/ρ.
    #[test]
    fn pressure_and_velocity_belong_together() {
        let (swell, at, time_s) = (swell(), Vector3::new(3.0, 5.0, 4.0), 2.0);
        let pressure = |step: Vector3<f64>| swell.at(&(at + step), time_s).pressure_per_density;
        let slope =
            Vector3::from_fn(|i, _| (pressure(Vector3::ith(i, 1e-3)) - pressure(Vector3::ith(i, -1e-3))) / 2e-3);
        assert!((swell.at(&at, time_s).motion.rate_m_s2 + slope).amax() < 1e-8);
    }

    #[test]
    fn a_particle_drifts_with_stokes_and_no_further() {
        let swell = Swell::new(0.4, 8.0, 90.0, 9.81);
        let (a, k, omega) = (0.2, swell.wavenumber_rad_m, swell.frequency_rad_s);
        let dt_s = 8.0 / 400.0;
        let mut at = Vector3::new(0.0, 0.0, 6.0);
        for step in 0..4_000 {
            let time_s = f64::from(step) * dt_s;
            let velocity = |at: &Vector3<f64>, time_s: f64| swell.at(at, time_s).motion.velocity_m_s;
            let middle = at + velocity(&at, time_s) * (0.5 * dt_s);
            at += velocity(&middle, time_s + 0.5 * dt_s) * dt_s;
        }
        let expected_m = a * a * omega * k * (-2.0 * k * 6.0).exp() * 4_000.0 * dt_s;
        // Ten periods; Stokes' drift is the leading order in the steepness k a = 0.013.
        assert!((at.y / expected_m - 1.0).abs() < 0.05, "{} m, by Stokes {expected_m} m", at.y);
        assert!(at.x.abs() < 1e-12);
    }
}
