//! From where the vehicle should go to what its actuators are told: pitch, heading, depth, and whose turn a motor's is.

pub mod depth_hold;
pub mod heading;
pub mod motors;
pub mod pitch;
pub mod servo;
