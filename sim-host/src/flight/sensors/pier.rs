//! The compass of a vehicle that stands on a pier.

use nalgebra::Vector3;
use shared::device::Attitude;

use super::{Compass, FlyingVehicle, Noise, Sensors};
use crate::flight::mission_file::Start;
use crate::model::plant::{State, quaternion_from_euler};

/// The very compass that a flight with the same seed has, out of the water: what depth does to it does not show.
#[derive(Clone, Debug)]
pub struct PierCompass {
    compass: Compass,
    noise: Noise,
}

impl PierCompass {
    /// The compass of a vehicle and a seed.
    #[must_use]
    pub fn new(flying: &FlyingVehicle<'_>, seed: u64) -> Self {
        let anywhere = Start { latitude_deg: 0.0, longitude_deg: 0.0, heading_deg: 0.0 };
        let sensors = Sensors::new(flying, &anywhere, seed);
        Self { compass: sensors.compass, noise: sensors.noise }
    }

    /// What it shows at rest: true roll, pitch and heading in rad, and where the moving mass is.
    pub fn read(&mut self, euler_rad: &Vector3<f64>, r_px_m: f64, mu_rad: f64) -> Attitude {
        let quaternion = quaternion_from_euler(euler_rad);
        self.compass.settle();
        self.compass.read(&State { quaternion, r_px_m, mu_rad, ..State::at_rest(0.0) }, &mut self.noise)
    }
}
