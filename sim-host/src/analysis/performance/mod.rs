//! How well a glider glides, how large its lung must be, how far and how long it goes: section 6 of the equations.
//!
//! [`Polar`] and [`Sizing`] are the paper's closed forms. [`Endurance`] sets the paper's ideal account of a yo beside a realistic
//! one of the same vehicle: water that grows denser, a hull that gives way, a pump with losses, inflections, a hotel load.

mod dive;
mod endurance;
mod polar;
mod size;

pub use dive::{DiveEnergy, Yo};
pub use endurance::{Account, Endurance, Realistic};
pub use polar::{Polar, PolarPoint};
pub use size::{Hold, Size, Sizing};
