//! Files that are there whole or not at all.

use std::{
    ffi::OsString,
    fs::{self, File},
    io::{self, BufWriter, Write},
    path::{Path, PathBuf},
};

/// Writes a neighbour of `path` first and renames it when it is complete, so that nobody ever reads half a file.
///
/// # Errors
/// The path and what went wrong, in one line.
pub fn write(path: &Path, fill: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>) -> Result<(), String> {
    let mut neighbour = OsString::from(path);
    neighbour.push(".part");
    let neighbour = PathBuf::from(neighbour);
    let written = File::create(&neighbour).and_then(|file| {
        let mut buffered = BufWriter::new(file);
        fill(&mut buffered)?;
        buffered.flush()?;
        fs::rename(&neighbour, path)
    });
    written.map_err(|error| format!("{}: {error}", path.display()))
}
