//! The drag polar C_D = C_D0 + K C_L² and its two marked points, in closed form.
//!
//! No division by K: both limits K → 0 and C_D0 → 0 are exact, and undefined numbers come out infinite.

use serde::Serialize;

use crate::vehicle::Hydrodynamics;

/// C_D = C_D0 + K C_L².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar {
    /// C_D0.
    pub c_d_zero: f64,
    /// K.
    pub c_d_induced: f64,
}

/// A glide on a polar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PolarPoint {
    /// C_L.
    pub lift_coefficient: f64,
    /// C_D.
    pub drag_coefficient: f64,
    /// γ_d = arctan(C_D/C_L), rad, down positive.
    pub descent_rad: f64,
    /// C_L/C_D.
    pub lift_to_drag: f64,
}

impl From<&Hydrodynamics> for Polar {
    fn from(h: &Hydrodynamics) -> Self {
        Self { c_d_zero: h.c_d_zero, c_d_induced: h.c_d_induced }
    }
}

impl Polar {
    /// The glide at a lift coefficient.
    #[must_use]
    pub fn at(&self, lift_coefficient: f64) -> PolarPoint {
        point(lift_coefficient, self.c_d_zero + self.c_d_induced * lift_coefficient * lift_coefficient)
    }

    /// The flattest glide: C_L = √(C_D0/K), C_D = 2 C_D0, tan γ = 2√(K C_D0).
    #[must_use]
    pub fn best_glide(&self) -> PolarPoint {
        let least_slope = 2.0 * (self.c_d_induced * self.c_d_zero).sqrt();
        PolarPoint {
            lift_coefficient: (self.c_d_zero / self.c_d_induced).sqrt(),
            drag_coefficient: 2.0 * self.c_d_zero,
            descent_rad: libm::atan(least_slope),
            lift_to_drag: 1.0 / least_slope,
        }
    }

    /// The glide that goes farthest per time: C_L/(C_L² + C_D²)^¾ is largest.
    ///
    /// With δ = 2KC_D0 and s = 1 + δ + √((1 + δ)² + 8δ²), the paper's r is 8δ²/s, so C_L = 2C_D0/√s and C_D = C_D0 + 4KC_D0²/s.
    #[must_use]
    pub fn max_horizontal_speed(&self) -> PolarPoint {
        let delta = 2.0 * self.c_d_induced * self.c_d_zero;
        let s = 1.0 + delta + ((1.0 + delta) * (1.0 + delta) + 8.0 * delta * delta).sqrt();
        point(2.0 * self.c_d_zero / s.sqrt(), self.c_d_zero * (1.0 + 2.0 * delta / s))
    }
}

fn point(lift_coefficient: f64, drag_coefficient: f64) -> PolarPoint {
    PolarPoint {
        lift_coefficient,
        drag_coefficient,
        descent_rad: libm::atan2(drag_coefficient, lift_coefficient),
        lift_to_drag: lift_coefficient / drag_coefficient,
    }
}

impl PolarPoint {
    /// √(C_L² + C_D²).
    #[must_use]
    pub fn resultant(&self) -> f64 {
        libm::hypot(self.lift_coefficient, self.drag_coefficient)
    }
}
