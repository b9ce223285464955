//! The drag polar C_D = C_D0 + K C_L² and its two marked points, in closed form.
//!
//! No division by K: both limits K → 0 and C_D0 → 0 are exact, and undefined numbers come out infinite.

use serde::Serialize;

use crate::model::{real::Real, vehicle::Hydrodynamics};

/// C_D = C_D0 + K C_L².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Polar<T = f64> {
    /// C_D0.
    pub c_d_zero: T,
    /// K.
    pub c_d_induced: T,
}

/// A glide on a polar.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PolarPoint<T = f64> {
    /// C_L.
    pub lift_coefficient: T,
    /// C_D.
    pub drag_coefficient: T,
    /// γ_d = arctan(C_D/C_L), rad, down positive.
    pub descent_rad: T,
    /// C_L/C_D.
    pub lift_to_drag: T,
}

impl From<&Hydrodynamics> for Polar {
    fn from(h: &Hydrodynamics) -> Self {
        Self { c_d_zero: h.c_d_zero, c_d_induced: h.c_d_induced }
    }
}

impl<T: Real> Polar<T> {
    /// The glide at a lift coefficient.
    #[must_use]
    pub fn at(&self, lift_coefficient: T) -> PolarPoint<T> {
        point(lift_coefficient, self.c_d_zero + self.c_d_induced * lift_coefficient * lift_coefficient)
    }

    /// The flattest glide: C_L = √(C_D0/K), C_D = 2 C_D0, tan γ = 2√(K C_D0).
    #[must_use]
    pub fn best_glide(&self) -> PolarPoint<T> {
        let [one, two] = [1.0, 2.0].map(T::constant);
        let least_slope = two * (self.c_d_induced * self.c_d_zero).sqrt();
        PolarPoint {
            lift_coefficient: (self.c_d_zero / self.c_d_induced).sqrt(),
            drag_coefficient: two * self.c_d_zero,
            descent_rad: least_slope.atan2(one),
            lift_to_drag: one / least_slope,
        }
    }

    /// The glide that goes farthest per time: C_L/(C_L² + C_D²)^¾ is largest.
    ///
    /// With δ = 2KC_D0 and s = 1 + δ + √((1 + δ)² + 8δ²), the paper's r is 8δ²/s, so C_L = 2C_D0/√s and C_D = C_D0 + 4KC_D0²/s.
    #[must_use]
    pub fn max_horizontal_speed(&self) -> PolarPoint<T> {
        let [one, two, eight] = [1.0, 2.0, 8.0].map(T::constant);
        let delta = two * self.c_d_induced * self.c_d_zero;
        let s = one + delta + ((one + delta) * (one + delta) + eight * delta * delta).sqrt();
        point(two * self.c_d_zero / s.sqrt(), self.c_d_zero * (one + two * delta / s))
    }
}

fn point<T: Real>(lift_coefficient: T, drag_coefficient: T) -> PolarPoint<T> {
    PolarPoint {
        lift_coefficient,
        drag_coefficient,
        descent_rad: drag_coefficient.atan2(lift_coefficient),
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
