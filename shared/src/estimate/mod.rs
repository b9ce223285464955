//! What is learned in flight: all of it bounded by parameters, and shown in [`crate::commands::Learned`].
//!
//! * [`buoyancy`]: weight and drag, from the depth rate against the reduced model.
//! * [`drift`]: current, speed and compass, from position fixes against dead reckoning.
//! * [`reversal`]: the way that a reversal of buoyancy still takes, from the reduced model rolled forward.

pub mod buoyancy;
pub mod drift;
pub mod navigator;
pub mod reversal;
