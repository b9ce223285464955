//! One vehicle, looked at: trim, turns, modes, margins, performance, and the tables that the controller flies by.
//!
//! May use [`crate::pages`] and what lies below it.

pub mod design;
pub mod eval;
pub mod helix;
pub mod locus;
pub mod margins;
pub mod modes;
pub mod paper;
pub mod performance;
pub mod reduced_error;
pub mod sensitivity;
pub mod table;
pub mod trim;
pub mod turn;
