//! Firmware images, built by a nested cargo.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

use object::{
    Object, ObjectSection, ObjectSymbol, SectionFlags,
    elf::{SHF_ALLOC, SHF_WRITE},
};
use sim_host::flight::link::Machine;

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

/// What an image takes of a board's memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sizes {
    /// Code, constants, trim table and initial values, bytes.
    pub flash: u64,
    /// Statics, bytes; what is left of the RAM is the stack's.
    pub statics: u64,
}

/// Measures an image by its sections.
///
/// # Panics
/// If it is not an ELF file.
#[must_use]
pub fn sizes(image: &Path) -> Sizes {
    let elf = fs::read(image).expect("the image is there");
    let elf = object::File::parse(&*elf).expect("an ELF file");
    let mut sizes = Sizes { flash: 0, statics: 0 };
    for section in elf.sections() {
        let SectionFlags::Elf { sh_flags } = section.flags() else { continue };
        let (loaded, writable) = (sh_flags & u64::from(SHF_ALLOC) != 0, sh_flags & u64::from(SHF_WRITE) != 0);
        if loaded && writable {
            sizes.statics += section.size();
        }
        // What is zero at the start has no place in the file, and none in flash.
        if loaded && section.file_range().is_some() {
            sizes.flash += section.size();
        }
    }
    sizes
}

/// Names of all functions that an image holds.
///
/// # Panics
/// If it is not an ELF file with symbols.
#[must_use]
pub fn functions(image: &Path) -> Vec<String> {
    let elf = fs::read(image).expect("the image is there");
    let elf = object::File::parse(&*elf).expect("an ELF file");
    let text = elf.symbols().filter(|symbol| symbol.kind() == object::SymbolKind::Text);
    text.filter_map(|symbol| Some(symbol.name().ok()?.to_owned())).collect()
}
