//! What the tests of the real firmware share: its images, built here, and its log, decoded.

pub mod image;
pub mod log;
