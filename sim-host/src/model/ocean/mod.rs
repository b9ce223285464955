//! The ocean: density from a cast, currents, internal waves, swell and a floor.
//!
//! Positions north, east, down, m, from the start of the flight; depth 0 is the mean surface; velocities of the water north,
//! east, down, m/s. The motions add up; waves do not feel the current (no Doppler shift, no refraction) nor each other.
//!
//! # Environment file
//! TOML; every section may be left out:
//! ```toml
//! [water]                    # without it: the density of the vehicle file, everywhere
//! composition = "standard"   # or "baltic"
//! profile = [[0, 17.0, 35.0], [200, 9.5, 35.2]] # depth in m, temperature in °C (ITS-90), practical salinity
//! # cast = "cast.csv"        # instead of `profile`: a CTD cast
//! # ballast_density_kg_m3 = 1026 # water in which the vehicle was made neutral; without it see `Ocean::ballast_density_kg_m3`
//! [current]                  # north and east, m/s, at depths in m; linear between, constant beyond
//! profile = [[0, 0.1, 0.2], [100, 0, 0]]
//! [internal_wave]            # towards `direction_deg`, between surface and floor
//! vertical_velocity_m_s = 0.02
//! period_s = 1200
//! wavelength_m = 800
//! direction_deg = 90
//! [swell]                    # crest to trough; towards `direction_deg`
//! height_m = 1.5
//! period_s = 9
//! direction_deg = 60
//! [floor]                    # depth at the start; slopes down towards `direction_deg`
//! depth_m = 1000
//! slope_deg = 1
//! direction_deg = 270
//! ```

mod altered;
mod cast;
mod column;
mod current;
mod file;
mod floor;
mod internal_wave;
mod motion;
mod swell;
mod teos10;

use nalgebra::Vector3;

use crate::model::plant::{Medium, Surroundings};
use column::Column;
use current::Current;
use floor::Floor;
use internal_wave::InternalWave;
use swell::Swell;

pub use file::EMBEDDED;
pub use teos10::{Composition, absolute_salinity, conservative_temperature, density_kg_m3};

/// A piece of ocean.
#[derive(Clone, Debug)]
pub struct Ocean {
    column: Column,
    current: Option<Current>,
    internal_wave: Option<InternalWave>,
    swell: Option<Swell>,
    floor: Option<Floor>,
    ballast_density_kg_m3: Option<f64>,
}

/// The water at one place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// What the vehicle feels of it: density, pressure, temperature, velocity and how that changes.
    pub around: Surroundings<f64>,
    /// Practical salinity, where the water has one.
    pub salinity: Option<f64>,
}

impl Ocean {
    /// The water at a position (north, east, down, m) and time since the start, s.
    #[must_use]
    #[inline]
    pub fn sample(&self, position_m: &Vector3<f64>, time_s: f64) -> Sample {
        let mut here = if self.current.is_none() && self.internal_wave.is_none() && self.swell.is_none() {
            self.column.at(position_m.z, 0.0)
        } else {
            self.moving(position_m, time_s)
        };
        here.around.pressure_pa = here.around.pressure_pa.max(0.0);
        here
    }

    fn moving(&self, position_m: &Vector3<f64>, time_s: f64) -> Sample {
        let wave = self.internal_wave.as_ref().map(|wave| wave.at(position_m, time_s));
        let displaced_m = wave.as_ref().map_or(0.0, |(_, displaced_m)| *displaced_m);
        let Sample { mut around, salinity } = self.column.at(position_m.z, displaced_m);
        let mut motion = wave.map(|(motion, _)| motion);
        if let Some(swell) = &self.swell {
            let orbit = swell.at(position_m, time_s);
            around.pressure_pa += around.density_kg_m3 * orbit.pressure_per_density;
            around.surface_m = orbit.surface_m;
            motion = Some(motion.map_or(orbit.motion, |motion| motion + orbit.motion));
        }
        if let Some(current) = &self.current {
            let flow = current.at(position_m.z);
            // A current that does not change with depth keeps still water's equations.
            if motion.is_none() && current.is_uniform() {
                around.current_m_s = flow.velocity_m_s;
            } else {
                motion = Some(motion.map_or(flow, |motion| motion + flow));
            }
        }
        if let Some(motion) = motion {
            around.current_m_s = motion.velocity_m_s;
            around.unrest = Some(motion.unrest());
        }
        Sample { around, salinity }
    }

    /// The water column at a depth, without currents and waves.
    #[must_use]
    pub fn at_rest(&self, depth_m: f64) -> Sample {
        self.column.at(depth_m, 0.0)
    }

    /// Depth of the sea floor, m; none in an ocean without one.
    #[must_use]
    pub fn floor_depth_m(&self, north_m: f64, east_m: f64) -> Option<f64> {
        self.floor.as_ref().map(|floor| floor.depth_m(north_m, east_m))
    }

    /// Density in which a vehicle that dives to some depth is made neutral, kg/m³.
    ///
    /// The file's, or else half-way between the lightest and the heaviest water on its way: as a pilot ballasts after a cast.
    #[must_use]
    pub fn ballast_density_kg_m3(&self, dive_to_m: f64) -> f64 {
        self.ballast_density_kg_m3.unwrap_or_else(|| self.column.middle_density_kg_m3(dive_to_m))
    }

    /// Density that makes depth of the pressure at some depth, kg/m³: the mean down to it.
    #[must_use]
    pub fn mean_density_kg_m3(&self, depth_m: f64, gravity_m_s2: f64) -> f64 {
        self.at_rest(depth_m).around.pressure_pa / (gravity_m_s2 * depth_m)
    }

    /// The ocean from some moment on.
    #[must_use]
    pub fn from_time(&self, time_s: f64) -> OceanFrom<'_> {
        OceanFrom { ocean: self, time_s }
    }
}

/// The ocean during a step that begins at some time.
#[derive(Clone, Copy, Debug)]
pub struct OceanFrom<'a> {
    ocean: &'a Ocean,
    time_s: f64,
}

impl Medium<f64> for OceanFrom<'_> {
    fn around(&self, position_m: &Vector3<f64>, into_step_s: f64) -> Surroundings<f64> {
        self.ocean.sample(position_m, self.time_s + into_step_s).around
    }
}
