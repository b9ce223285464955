//! The plant of an underwater glider, and everything that flies it on a host.

pub mod mission_file;
pub mod pilot;
pub mod toml_file;
pub mod vehicle;
