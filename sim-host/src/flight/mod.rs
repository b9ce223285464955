//! The closed loop, and all that goes in and comes out: missions and faults, the record and its replay, the link.
//!
//! [`fly`] puts plant, motors and sensors around a [`pilot`]: the linked autopilot, the baseline, or firmware at the other
//! end of a [`link`]. May use [`crate::model`] and [`crate::files`].

mod actuators;
pub mod baseline;
mod battery;
mod closed_loop;
mod faults;
pub mod faults_file;
mod flying_vehicle;
#[cfg(unix)]
pub mod link;
pub mod mission_file;
pub mod pilot;
pub mod record;
pub mod replay;
mod sensors;
mod summary;

pub use actuators::EnergyUsed;
pub use battery::Cells;
pub use closed_loop::{TICK_S, Tick, fly};
pub use faults::{Actuator, Drain, Dropout, Faults, Instrument, Seep, Stuck};
pub use flying_vehicle::FlyingVehicle;
pub use sensors::{AltimeterErrors, CompassErrors, HousekeepingErrors, PierCompass, PressureErrors, SensorErrors};
pub use summary::{Loss, NorthEast, Outcome, Summary, Surfacing, TraceHash};
