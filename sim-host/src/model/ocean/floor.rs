//! The sea floor: a plane.

use nalgebra::Vector3;

use super::motion::towards;

/// A sloping floor.
#[derive(Clone, Debug)]
pub(super) struct Floor {
    depth_m: f64,
    /// Gain of depth per metre north and east.
    slope: Vector3<f64>,
}

impl Floor {
    /// Of a depth at the origin, m; `slope_deg` down towards `direction_deg`.
    pub(super) fn new(depth_m: f64, slope_deg: f64, direction_deg: f64) -> Self {
        Self { depth_m, slope: towards(direction_deg) * libm::tan(slope_deg.to_radians()) }
    }

    pub(super) fn depth_m(&self, north_m: f64, east_m: f64) -> f64 {
        self.depth_m + self.slope.x * north_m + self.slope.y * east_m
    }
}

#[cfg(test)]
mod tests {
    use super::Floor;

    #[test]
    fn it_falls_off_towards_its_direction() {
        let floor = Floor::new(100.0, 45.0, 90.0);
        assert!((floor.depth_m(77.0, 10.0) - 110.0).abs() < 1e-9);
        assert!((floor.depth_m(-77.0, -10.0) - 90.0).abs() < 1e-9);
    }
}
