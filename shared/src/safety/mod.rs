//! Ends the mission when it must end.

pub mod streak;
pub mod supervisor;
