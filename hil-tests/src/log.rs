//! The firmware's log, decoded with the strings of its image.

use std::{fs, path::Path};

use defmt_decoder::{DecodeError, Table};

/// Lines as `LEVEL message`.
///
/// # Panics
/// If the image has no log table, or the frames do not fit it.
#[must_use]
pub fn decode(image: &Path, frames: &[u8]) -> Vec<String> {
    let elf = fs::read(image).expect("the image is there");
    let table = Table::parse(&elf).expect("a sound log table").expect("a log table");
    let mut decoder = table.new_stream_decoder();
    decoder.received(frames);
    let mut lines = Vec::new();
    loop {
        match decoder.decode() {
            Ok(frame) => {
                let level = frame.level().map_or("", |level| level.as_str());
                lines.push(format!("{level} {}", frame.display_message()));
            }
            Err(DecodeError::UnexpectedEof) => return lines,
            Err(DecodeError::Malformed) => panic!("a malformed log frame after {lines:#?}"),
        }
    }
}
