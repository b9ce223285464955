//! A steady current that changes with depth: linear between the points of a profile, constant beyond them.

use nalgebra::{Matrix3, Vector3};

use super::motion::Motion;

/// The profile: depths rising.
#[derive(Clone, Debug)]
pub(super) struct Current {
    points: Vec<[f64; 3]>,
    uniform: bool,
}

impl Current {
    /// From rows of depth, m, and velocity north and east, m/s; depths rising.
    pub(super) fn new(points: Vec<[f64; 3]>) -> Self {
        let uniform = points.windows(2).all(|pair| pair[0][1..] == pair[1][1..]);
        Self { points, uniform }
    }

    /// With a velocity north and east, m/s, on top at every depth.
    pub(super) fn carried_along(self, [north, east]: [f64; 2]) -> Self {
        Self::new(self.points.into_iter().map(|[depth_m, n, e]| [depth_m, n + north, e + east]).collect())
    }

    /// Whether it is the same at every depth.
    pub(super) fn is_uniform(&self) -> bool {
        self.uniform
    }

    pub(super) fn at(&self, depth_m: f64) -> Motion {
        let after = self.points.partition_point(|[depth, ..]| *depth <= depth_m);
        let before = after.checked_sub(1).and_then(|index| self.points.get(index));
        let (velocity, shear) = match (before, self.points.get(after)) {
            (Some([z0, n0, e0]), Some([z1, n1, e1])) => {
                let shear = [(n1 - n0) / (z1 - z0), (e1 - e0) / (z1 - z0)];
                ([n0 + shear[0] * (depth_m - z0), e0 + shear[1] * (depth_m - z0)], shear)
            }
            (Some([_, north, east]), None) | (None, Some([_, north, east])) => ([*north, *east], [0.0; 2]),
            (None, None) => ([0.0; 2], [0.0; 2]),
        };
        let mut gradient_per_s = Matrix3::zeros();
        gradient_per_s.set_column(2, &Vector3::new(shear[0], shear[1], 0.0));
        Motion {
            velocity_m_s: Vector3::new(velocity[0], velocity[1], 0.0),
            rate_m_s2: Vector3::zeros(),
            gradient_per_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::ocean::motion::tests::assert_derivatives;

    #[test]
    fn it_is_linear_between_points_and_held_beyond() {
        let current = Current::new(vec![[0.5, 0.2, -0.1], [40.5, 0.0, 0.3], [90.0, 0.0, 0.0]]);
        assert_derivatives(|at, _| current.at(at.z), 1.0);
        let at = |depth_m: f64| current.at(depth_m).velocity_m_s;
        assert_eq!(at(-1.0), Vector3::new(0.2, -0.1, 0.0));
        assert!((at(20.5) - Vector3::new(0.1, 0.1, 0.0)).amax() < 1e-15);
        assert_eq!(at(500.0), Vector3::zeros());
        assert!(!current.is_uniform() && Current::new(vec![[0.0, 0.2, 0.1], [9.0, 0.2, 0.1]]).is_uniform());
    }
}
