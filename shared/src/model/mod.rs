//! What the controller knows of its vehicle: constants, trim table, and a reduced model of its glide.

pub mod compass;
pub mod number;
pub mod reduced;
pub mod table;
pub mod vehicle;
