//! What is simulated: the vehicle, its coefficients, its equations of motion, and the water.
//!
//! Data flows from a vehicle's file through its geometry and its coefficients to the plant. Everything is generic over its
//! scalar ([`real`]), so that derivatives are exact. May use [`crate::files`].

pub mod coefficients;
pub mod ocean;
pub mod plant;
pub mod real;
pub mod vehicle;
