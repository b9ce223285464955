//! Firmware images, built by a nested cargo.

use std::{
    path::{Path, PathBuf},
    process::Command,
};

use sim_host::link::Machine;

/// Root of the workspace.
#[must_use]
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The firmware's feature for a board.
#[must_use]
pub const fn feature(machine: Machine) -> &'static str {
    match machine {
        Machine::Mps2An386 => "mps2",
        Machine::NetduinoPlus2 => "f405",
    }
}

/// Builds one binary of the firmware for a board's feature; returns the image's path.
///
/// The build has a target folder of its own, since cargo holds the outer one's lock while it runs tests.
///
/// # Panics
/// If it does not build.
#[must_use]
pub fn build(feature: &str, bin: &str) -> PathBuf {
    const TARGET: &str = "thumbv7em-none-eabihf";
    let target_dir = root().join("target/hil");
    let status = Command::new(env!("CARGO"))
        .current_dir(root())
        .args(["build", "--quiet", "--locked", "-p", "firmware", "--profile", "firmware", "--target", TARGET])
        .args(["--features", feature, "--bin", bin, "--target-dir"])
        .arg(&target_dir)
        .status()
        .expect("cargo starts");
    assert!(status.success(), "the firmware's {bin} does not build");
    target_dir.join(TARGET).join("firmware").join(bin)
}
