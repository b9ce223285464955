//! Checks and embeds the trim table, names the build, and links for one board.

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, exit},
};

use shared::model::table::TrimTable;

/// The table that is embedded unless `GLIDER_TABLE` names another.
const DEFAULT_TABLE: &str = "slocum-paper.table";
/// `Hello::build` holds this many bytes.
const MAX_BUILD_BYTES: usize = 32;

/// Flash and RAM that an image may use: its budget, smaller than any of the chips.
const BUDGET_FLASH_K: u32 = 128;
const BUDGET_RAM_K: u32 = 32;

/// Feature of a board, and where its flash and RAM begin.
const BOARDS: [(&str, u32, u32); 2] = [("F405", 0x0800_0000, 0x2000_0000), ("MPS2", 0x0000_0000, 0x2000_0000)];

fn main() {
    println!("cargo:rerun-if-changed=build.rs");
    let out = PathBuf::from(variable("OUT_DIR"));
    embed_table(&out);
    println!("cargo:rustc-env=GLIDER_BUILD={}", build_name());
    if env::var_os("CARGO_CFG_TARGET_OS").is_some_and(|os| os == "none") {
        link(&out);
    }
}

/// Says what is wrong in one line, and ends the build.
fn refuse(why: &str) -> ! {
    eprintln!("{why}");
    exit(1)
}

fn variable(name: &str) -> String {
    env::var(name).unwrap_or_else(|_| refuse(&format!("cargo did not set {name}")))
}

/// A table that cannot be flown must not reach a board.
fn embed_table(out: &Path) {
    println!("cargo:rerun-if-env-changed=GLIDER_TABLE");
    let package = PathBuf::from(variable("CARGO_MANIFEST_DIR"));
    // A relative path counts from the workspace's root, where people stand when they build.
    let named = env::var_os("GLIDER_TABLE").map(|path| package.join("..").join(path));
    let path = named.unwrap_or_else(|| package.join(DEFAULT_TABLE));
    println!("cargo:rerun-if-changed={}", path.display());
    let file = fs::read(&path).unwrap_or_else(|error| refuse(&format!("trim table {}: {error}", path.display())));
    if let Err(error) = TrimTable::parse(&file) {
        refuse(&format!("{} is not a trim table that may be flown: {error:?}", path.display()));
    }
    fs::write(out.join("trim.table"), file).unwrap_or_else(|error| refuse(&format!("cannot copy the table: {error}")));
}

/// Version and, in a git checkout, the commit.
fn build_name() -> String {
    let mut name = variable("CARGO_PKG_VERSION");
    if let Some(commit) = git(&["describe", "--always", "--abbrev=8", "--exclude=*"]) {
        name = format!("{name}+g{commit}");
        // HEAD itself does not change when its branch moves; its log does.
        for watched in ["HEAD", "logs/HEAD"] {
            if let Some(path) = git(&["rev-parse", "--git-path", watched]).filter(|path| Path::new(path).exists()) {
                println!("cargo:rerun-if-changed={path}");
            }
        }
    }
    name.chars().take(MAX_BUILD_BYTES).collect()
}

fn git(arguments: &[&str]) -> Option<String> {
    let output = Command::new("git").args(arguments).output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8(output.stdout).ok()?.trim().to_owned()).filter(|text| !text.is_empty())
}

/// Without these arguments an image links empty, and silently so.
fn link(out: &Path) {
    let chosen = BOARDS.iter().filter(|(board, ..)| env::var_os(format!("CARGO_FEATURE_{board}")).is_some());
    let [(_, flash, ram)] = *chosen.collect::<Vec<_>>() else {
        return; // The library alone: nothing to link.
    };
    let memory = format!(
        "MEMORY\n{{\n  FLASH : ORIGIN = {flash:#010x}, LENGTH = {BUDGET_FLASH_K}K\n  \
         RAM : ORIGIN = {ram:#010x}, LENGTH = {BUDGET_RAM_K}K\n}}\n"
    );
    let file = out.join("board_memory.x");
    fs::write(file, memory).unwrap_or_else(|error| refuse(&format!("cannot write the memory map: {error}")));
    println!("cargo:rustc-link-search={}", out.display());
    for argument in ["-Tlink.x", "-Tdefmt.x", "--nmagic"] {
        println!("cargo:rustc-link-arg-bins={argument}");
    }
}
