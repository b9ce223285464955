//! Internal waves: the first vertical mode of evenly stratified water between surface and floor.
//!
//! `w = W sin(m z) cos(k s − ω t)`, m = π/H, with the horizontal velocity that keeps the water's volume. Layers go up and down with
//! the water: temperature and salinity at a depth are those of `z − ξ`. Period and wavelength are taken as given; the period of
//! a real one is longer than the buoyancy period. Its pressure, some 1e-3 of the swell's, is neglected.

use nalgebra::{Matrix3, Vector3};

use super::motion::{Motion, towards};

/// One wave train.
#[derive(Clone, Debug)]
pub(super) struct InternalWave {
    /// W, m/s.
    vertical_velocity_m_s: f64,
    /// ω, rad/s.
    frequency_rad_s: f64,
    /// k, rad/m.
    wavenumber_rad_m: f64,
    /// m, rad/m.
    mode_rad_m: f64,
    floor_m: f64,
    direction: Vector3<f64>,
}

impl InternalWave {
    pub(super) fn new(
        vertical_velocity_m_s: f64,
        period_s: f64,
        wavelength_m: f64,
        direction_deg: f64,
        floor_m: f64,
    ) -> Self {
        use std::f64::consts::{PI, TAU};
        Self {
            vertical_velocity_m_s,
            frequency_rad_s: TAU / period_s,
            wavenumber_rad_m: TAU / wavelength_m,
            mode_rad_m: PI / floor_m,
            floor_m,
            direction: towards(direction_deg),
        }
    }

    /// Its motion, and the downward displacement ξ of the layers, m.
    pub(super) fn at(&self, position_m: &Vector3<f64>, time_s: f64) -> (Motion, f64) {
        let (k, m, omega) = (self.wavenumber_rad_m, self.mode_rad_m, self.frequency_rad_s);
        let (sin, cos) = libm::sincos(k * self.direction.dot(position_m) - omega * time_s);
        let (mode, slope) = libm::sincos(m * position_m.z.clamp(0.0, self.floor_m));
        let w = self.vertical_velocity_m_s;
        let (along, down) = (self.direction, Vector3::z());
        // Beyond surface and floor the mode is held at its end.
        let inside = if (0.0..=self.floor_m).contains(&position_m.z) { 1.0 } else { 0.0 };
        let u = -w * m / k * slope;
        let by_distance = (along * (u * cos) - down * (w * mode * sin)) * k;
        let by_depth = (along * (w * m / k * mode * sin) + down * (w * slope * cos)) * (m * inside);
        let gradient_per_s: Matrix3<f64> = by_distance * along.transpose() + by_depth * down.transpose();
        let motion = Motion {
            velocity_m_s: along * (u * sin) + down * (w * mode * cos),
            rate_m_s2: (along * (-u * cos) + down * (w * mode * sin)) * omega,
            gradient_per_s,
        };
        (motion, -w / omega * mode * sin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ocean::motion::tests::assert_derivatives;

    #[test]
    fn it_is_divergence_free_and_still_at_surface_and_floor() {
        let wave = InternalWave::new(0.03, 1200.0, 900.0, 215.0, 300.0);
        assert_derivatives(|at, time_s| wave.at(at, time_s).0, 1e-3);
        let down = |depth_m: f64, time_s: f64| wave.at(&Vector3::new(0.0, 0.0, depth_m), time_s).0.velocity_m_s.z;
        for time_s in [0.0, 100.0, 555.0] {
            assert!(down(0.0, time_s).abs() < 1e-16 && down(300.0, time_s).abs() < 1e-16);
        }
        assert_eq!(down(150.0, 0.0), 0.03);
    }

    #[test]
    fn layers_follow_the_water() {
        let wave = InternalWave::new(0.03, 1200.0, 900.0, 0.0, 300.0);
        let at = |time_s: f64| wave.at(&Vector3::new(40.0, 0.0, 80.0), time_s);
        let rate = (at(200.5).1 - at(199.5).1) / 1.0;
        // ∂ξ/∂t is the vertical velocity; a difference over 1 s of a period of 1200 s is good to 5e-6.
        assert!((rate / at(200.0).0.velocity_m_s.z - 1.0).abs() < 1e-5);
    }
}
