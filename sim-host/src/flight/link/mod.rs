//! Firmware at the other end of a link: emulated, or on a board.
//!
//! Every wait is bounded, so that dead firmware gives one line that says so.

mod emulator;
mod firmware_pilot;
mod stream;

pub use emulator::{Emulator, Machine};
pub use firmware_pilot::FirmwarePilot;
pub use stream::Stream;
