//! The record of a flight: what was measured, what was commanded and what was true, tick by tick.

mod columns;
mod csv;
mod frames;
mod parquet;

use nalgebra::Vector3;
use shared::{commands::Commands, device::Measurements};

pub use columns::{COLUMNS, Column, Value};
pub use frames::{BadFrame, Frame, Frames};

use crate::flight::{EnergyUsed, TICK_S, Tick, mission_file::Start};
use crate::model::{
    ocean,
    plant::{euler_from_quaternion, rotation_from_quaternion},
    vehicle::Water,
};

/// A flight, tick by tick, and what it takes to read it.
#[derive(Clone, Debug)]
pub struct Record {
    /// Where it started: the origin of north and east.
    pub start: Start,
    /// The water in which pressure becomes depth.
    pub water: Water,
    /// One sample per tick.
    pub samples: Vec<Sample>,
}

/// One tick: measurements, the commands they led to, and the truth before these commands act.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Ticks since the start.
    pub tick: u32,
    /// What the controller was told.
    pub measurements: Measurements,
    /// What it answered.
    pub commands: Commands,
    /// What was.
    pub truth: Truth,
    /// Electrical energy used so far.
    pub energy_j: EnergyUsed,
    /// Ideal work p ΔV of the pump so far, J.
    pub pump_work_j: f64,
    /// Charge drawn from the battery so far, C.
    pub charge_c: f64,
}

/// The state of the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Truth {
    /// North, east and down of the start, m.
    pub position_m: Vector3<f64>,
    /// Roll, pitch and heading, rad.
    pub euler_rad: Vector3<f64>,
    /// Velocity relative to the water in body axes (forward, right, down), m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Velocity over ground, north, east and down, m/s.
    pub ground_velocity_m_s: Vector3<f64>,
    /// The water at the centre of buoyancy.
    pub water: ocean::Sample,
    /// Depth of the sea floor below it, m, if there is one.
    pub floor_depth_m: Option<f64>,
    /// Rates about the body's axes, rad/s.
    pub rate_rad_s: Vector3<f64>,
    /// Axial position of the moving mass, m.
    pub r_px_m: f64,
    /// Rotation of the moving mass, rad, positive to the left.
    pub mu_rad: f64,
    /// Displaced volume, m³.
    pub displaced_volume_m3: f64,
}

impl Sample {
    /// Time since the start, s.
    #[must_use]
    pub fn time_s(&self) -> f64 {
        f64::from(self.tick) * TICK_S
    }
}

impl Truth {
    /// Height above the sea floor, m, if there is one.
    #[must_use]
    pub fn altitude_m(&self) -> Option<f64> {
        Some(self.floor_depth_m? - self.position_m.z)
    }

    /// V, through the water, m/s.
    #[must_use]
    pub fn speed_m_s(&self) -> f64 {
        self.velocity_m_s.norm()
    }

    /// α = atan2(w, u), rad.
    #[must_use]
    pub fn alpha_rad(&self) -> f64 {
        self.velocity_m_s.z.atan2(self.velocity_m_s.x)
    }

    /// β = asin(v/V), rad; 0 at rest.
    #[must_use]
    pub fn beta_rad(&self) -> f64 {
        ratio(self.velocity_m_s.y, self.speed_m_s()).asin()
    }

    /// γ through the water, rad, climbing positive; 0 at rest.
    #[must_use]
    pub fn path_angle_rad(&self) -> f64 {
        let through = self.ground_velocity_m_s - self.water.around.current_m_s;
        -ratio(through.z, through.norm()).asin()
    }
}

/// A component over its vector's length, 0 for no vector.
fn ratio(component: f64, length: f64) -> f64 {
    if length > 0.0 { (component / length).clamp(-1.0, 1.0) } else { 0.0 }
}

impl From<&Tick<'_>> for Sample {
    fn from(tick: &Tick<'_>) -> Self {
        let state = tick.state;
        Self {
            tick: tick.tick,
            measurements: *tick.measurements,
            commands: *tick.commands,
            truth: Truth {
                position_m: state.position_m,
                euler_rad: euler_from_quaternion(&state.quaternion),
                velocity_m_s: state.velocity_m_s,
                ground_velocity_m_s: rotation_from_quaternion(&state.quaternion) * state.velocity_m_s
                    + tick.water.around.current_m_s,
                water: *tick.water,
                floor_depth_m: tick.floor_depth_m,
                rate_rad_s: state.rate_rad_s,
                r_px_m: state.r_px_m,
                mu_rad: state.mu_rad,
                displaced_volume_m3: state.displaced_volume_m3,
            },
            energy_j: *tick.energy,
            pump_work_j: tick.pump_work_j,
            charge_c: tick.charge_c,
        }
    }
}
