//! The plant of an underwater glider, and everything that flies it on a host.

pub mod cli;
pub mod draw;
pub mod eval;
pub mod flight;
pub mod helix;
#[cfg(unix)]
pub mod link;
pub mod mission_file;
pub mod modes;
pub mod ocean;
pub mod pilot;
pub mod plant;
pub mod real;
pub mod record;
pub mod report;
pub mod table;
pub mod toml_file;
pub mod trim;
pub mod turn;
pub mod vehicle;
pub mod whole_file;
