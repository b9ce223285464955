//! The flight stack on a board: drivers, and the application loop around [`shared::autopilot::Autopilot`].
//!
//! Everything here is generic over `embedded-hal` and `embedded-io`, so that the same code runs against simulated devices on
//! a host, in emulation and on a board. A board's binary (`boards/`) only wires it up.
//!
//! # What is not there yet
//! No driver for pressure, attitude, position, altitude, leak, vacuum, charge or modem: in flight those measurements stay
//! `None`, and the autopilot does not leave the surface; what is not measured aborts nothing. Simulated measurements come
//! over the link, with the bench jumper fitted.
//!
//! No watchdog and no drop weight: after a panic the actuators are safe, and stay so until somebody resets the board.
//!
//! # Time
//! A *beat* is the drivers' period, [`BEAT_HZ`]; a *tick* is the autopilot's, [`shared::device::TICK_HZ`].

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

mod log;

pub mod actuators;
pub mod app;
pub mod calibration;
pub mod flight;
pub mod mass;
pub mod order;
pub mod pump;

/// Rate at which drivers watch end stops and stale orders, Hz.
pub const BEAT_HZ: u32 = 20;
/// Beats in one tick of the autopilot.
pub const BEATS_PER_TICK: u32 = 5;

/// File of the trim table that was embedded when this was built.
pub static TRIM_TABLE: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/trim.table"));

/// Version and commit that this was built from.
pub const BUILD: &str = env!("GLIDER_BUILD");
