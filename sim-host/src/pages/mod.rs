//! What people look at: charts, drawings, and the report of a flight.
//!
//! Pages draw what they are given and compute nothing of their own. May use [`crate::flight`] and what lies below it.

pub mod chart;
pub(crate) mod document;
pub mod draw;
pub(crate) mod page;
pub mod report;
