//! What the tests of the real firmware share: its images, built here, its log, decoded, and the dives that it flies.

#![allow(clippy::expect_used, clippy::unwrap_used, reason = "this is test code: a panic is how it says no")]

pub mod bench;
pub mod devices;
pub mod dive;
pub mod image;
pub mod log;

use std::io::Write;

/// Tells a measured figure, past the capture of the test runner: it is a result, not a diagnosis.
pub fn report(line: &str) {
    // A closed standard error is no reason to fail.
    let _ = writeln!(std::io::stderr(), "    {line}");
}
