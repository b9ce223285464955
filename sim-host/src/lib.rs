//! The plant of an underwater glider, and everything that flies it on a host.

#[cfg(unix)]
pub mod link;
pub mod pilot;
pub mod vehicle;
