//! A velocity field at one place and time, with the derivatives that a vehicle feels.

use std::ops::Add;

use nalgebra::{Matrix3, Vector3};

use crate::model::plant::Unrest;

/// Velocity of the water and its first derivatives; north, east, down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    /// c, m/s.
    pub(super) velocity_m_s: Vector3<f64>,
    /// ∂c/∂t at a fixed place, m/s².
    pub(super) rate_m_s2: Vector3<f64>,
    /// ∇c: row component, column direction, 1/s.
    pub(super) gradient_per_s: Matrix3<f64>,
}

impl Motion {
    /// As the plant takes it: Dc/Dt = ∂c/∂t + (∇c) c.
    pub(super) fn unrest(&self) -> Unrest<f64> {
        Unrest {
            acceleration_m_s2: self.rate_m_s2 + self.gradient_per_s * self.velocity_m_s,
            gradient_per_s: self.gradient_per_s,
        }
    }
}

impl Add for Motion {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            velocity_m_s: self.velocity_m_s + other.velocity_m_s,
            rate_m_s2: self.rate_m_s2 + other.rate_m_s2,
            gradient_per_s: self.gradient_per_s + other.gradient_per_s,
        }
    }
}

/// Unit vector north, east, down of a compass direction, deg.
pub(super) fn towards(direction_deg: f64) -> Vector3<f64> {
    let (sin, cos) = libm::sincos(direction_deg.to_radians());
    Vector3::new(cos, sin, 0.0)
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// The derivatives of a field against central differences: relative to `scale` (1/s), step 1e-3 m or s, so 1e-6 is left.
    pub(in crate::model::ocean) fn assert_derivatives(field: impl Fn(&Vector3<f64>, f64) -> Motion, scale: f64) {
        const STEP: f64 = 1e-3;
        for (at, time_s) in
            [(Vector3::new(12.0, -7.0, 3.0), 1.3), (Vector3::new(-410.0, 95.0, 41.5), 777.0), (Vector3::z(), 0.0)]
        {
            let motion = field(&at, time_s);
            let differences = Matrix3::from_fn(|row, column| {
                let step = Vector3::ith(column, STEP);
                let change = field(&(at + step), time_s).velocity_m_s - field(&(at - step), time_s).velocity_m_s;
                change[row] / (2.0 * STEP)
            });
            assert!((motion.gradient_per_s - differences).amax() < 1e-6 * scale, "{differences}");
            let rate = (field(&at, time_s + STEP).velocity_m_s - field(&at, time_s - STEP).velocity_m_s) / (2.0 * STEP);
            assert!((motion.rate_m_s2 - rate).amax() < 1e-6 * scale, "{rate}");
            assert!(motion.gradient_per_s.trace().abs() < 1e-15, "water is neither made nor lost");
        }
    }
}
