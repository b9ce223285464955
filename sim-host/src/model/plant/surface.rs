//! The free surface: what emerges no longer displaces water.

use nalgebra::Vector3;

use super::{Plant, State, Surroundings, inertia::axis};
use crate::model::{real::Real, vehicle};

/// Slices along the hull. Eight give the buoyancy of a hull pitched through the surface within 1 %.
const SLICES: usize = 8;

/// The hull as a cylinder whose slices leave the water one by one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Hull<T: Real> {
    length_m: T,
    radius_m: T,
}

impl<T: Real> Hull<T> {
    pub(super) fn new(hull: &vehicle::Hull) -> Self {
        Self { length_m: T::constant(hull.length_m), radius_m: T::constant(0.5 * hull.diameter_m()) }
    }
}

impl<T: Real> Plant<T> {
    /// The same plant below a free surface, at depth 0 in calm water. Without it the water has no end.
    ///
    /// What emerges loses its buoyancy; its added mass and, in waves, its Froude–Krylov force stay as if submerged.
    #[must_use]
    pub fn below_surface(mut self, hull: &vehicle::Hull) -> Self {
        self.hull = Some(Hull::new(hull));
        self
    }

    /// Force and moment that are missing from buoyancy, body axes, N and N m. `zeta`: gravity's direction, body axes.
    pub(super) fn emerged(
        &self,
        state: &State<T>,
        zeta: &Vector3<T>,
        water: &Surroundings<T>,
    ) -> (Vector3<T>, Vector3<T>) {
        let mut lost = (Vector3::repeat(T::constant(0.0)), Vector3::repeat(T::constant(0.0)));
        let Some(hull) = &self.hull else { return lost };
        let reach_m = 0.5 * hull.length_m.value() + hull.radius_m.value();
        let centre_m = state.position_m.z + water.surface_m;
        if centre_m.value() > reach_m {
            return lost;
        }
        let weight_n = water.density_kg_m3 * self.gravity_m_s2 * self.volume_in(state, water);
        let share = T::constant(1.0 / SLICES as f64);
        for slice in 0..SLICES {
            let station_m = hull.length_m * T::constant((slice as f64 + 0.5) / SLICES as f64 - 0.5);
            let depth_m = centre_m + zeta.x * station_m;
            let force = zeta * (weight_n * share * emerged_share(depth_m / hull.radius_m));
            lost.0 += force;
            lost.1 += (axis() * station_m).cross(&force);
        }
        lost
    }
}

/// Part of a circle's area above a line, given the depth of its centre below the line over its radius.
fn emerged_share<T: Real>(depth: T) -> T {
    let one = T::constant(1.0);
    if depth.value() >= 1.0 {
        T::constant(0.0)
    } else if depth.value() <= -1.0 {
        one
    } else {
        let half_chord = (one - depth * depth).sqrt();
        (half_chord.atan2(depth) - depth * half_chord) * T::constant(std::f64::consts::FRAC_1_PI)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_circle_is_out_when_its_centre_lies_in_the_surface() {
        assert_eq!(emerged_share(1.0), 0.0);
        assert!((emerged_share(0.0_f64) - 0.5).abs() < 1e-15);
        assert_eq!(emerged_share(-1.0), 1.0);
        // The segment at half a radius: 1/3 − √3/(4π).
        assert!((emerged_share(0.5_f64) - (1.0 / 3.0 - 3f64.sqrt() / (4.0 * std::f64::consts::PI))).abs() < 1e-15);
    }
}
