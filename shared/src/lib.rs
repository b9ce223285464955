//! What flies: the glide controller, its trim table and its reduced model.
//!
//! Simulation, emulation, board and tests all call [`autopilot::Autopilot::step`] and nothing else.
//! The same measurements give the same commands, bit for bit, on a desk and on a Cortex-M.
//!
//! # Frames
//! * Inertial: north, east, down; the origin lies at the surface, where the mission started.
//! * Body: forward, right, down; the origin is the centre of buoyancy.
//! * Attitude: heading `psi`, pitch `theta`, roll `phi`, in the order 3-2-1.
//!
//! # Signs
//! * `theta` > 0 nose up, `phi` > 0 right wing down, `psi` clockwise from north.
//! * Path angle `gamma` > 0 climbs; `theta = gamma + alpha` with the wings level.
//! * Net mass > 0 sinks: net mass = mass − density × displaced volume.
//! * Volume of the variable buoyancy device (`vbd`) > 0 displaces more water than neutral, so it rises.
//! * The moving mass: `r_px` > 0 forward (nose down), `mu` > 0 swings to the **left** (Fan & Woolsey's polar angle about the
//!   body axis; 0 hangs down).
//! * Turn rate > 0 turns right. Which `mu` turns right is the vehicle's, and stands in its trim table.
//!
//! # Units
//! SI, and named: `depth_m`, `rate_rad_s`. What crosses a wire or lives long is an integer (`r_px_um`, `pressure_pa`); the
//! scale factors are in [`device`].

#![no_std]
#![forbid(unsafe_code)]
#![deny(
    clippy::arithmetic_side_effects,
    clippy::expect_used,
    clippy::indexing_slicing,
    clippy::panic,
    clippy::unwrap_used
)]

#[cfg(test)]
extern crate std;

pub mod autopilot;
pub mod checksum;
pub mod commands;
pub mod control;
pub mod device;
pub mod estimate;
pub mod math;
pub mod mission;
pub mod model;
pub mod parameters;
pub mod safety;
pub mod wire;
