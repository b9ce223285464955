//! The plant of an underwater glider, and everything that flies it on a host.

pub mod pilot;
pub mod vehicle;
