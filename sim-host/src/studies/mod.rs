//! Many flights: plans, campaigns, the sea trials, and the compass's swing.
//!
//! May use [`crate::analysis`] and what lies below it.

pub mod campaign;
pub mod plan;
pub mod swing;
pub mod trials;
