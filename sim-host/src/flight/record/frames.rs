//! The record as frames: what host and firmware say to each other in a flight, byte for byte, so that it replays.
//!
//! ```text
//! Hello | Configure | Ready | Sensors | Actuators | Sensors | Actuators | …
//! ```
//!
//! A link to firmware that was listened to gives such a file too ([`crate::flight::link::Stream::log_to`]). A tick takes some
//! 95 bytes, a day 33 MB; both writing and reading go frame by frame.

use std::{
    fmt,
    io::{self, BufRead, Write},
    path::Path,
};

use shared::wire::{
    self, ActuatorFrame, Auth, Configuration, DELIMITER, Damage, Decoder, Header, Hello, MAX_FRAME, Message, PROTOCOL,
    SensorFrame,
};

use super::Record;
use crate::files::whole_file;

/// The board that a linked controller says it runs on.
const BOARD: &str = "host";

impl Record {
    /// Writes the record as frames; `configuration` is what was flown, by the vehicle with this fingerprint.
    ///
    /// # Errors
    /// The path and what went wrong, in one line.
    pub fn write_frames(&self, path: &Path, vehicle_hash: u64, configuration: &Configuration) -> Result<(), String> {
        whole_file::write(path, |file| {
            let (mut host, mut firmware) = (Sender::default(), Sender::default());
            firmware.write(file, &Message::Hello(hello(vehicle_hash)))?;
            host.write(file, &Message::Configure(configuration.clone()))?;
            firmware.write(file, &Message::Ready)?;
            for sample in &self.samples {
                let (tick, measurements, commands) = (sample.tick, sample.measurements, sample.commands);
                host.write(file, &Message::Sensors(SensorFrame { tick, measurements }))?;
                firmware.write(file, &Message::Actuators(ActuatorFrame { tick, commands, step_clocks: 0 }))?;
            }
            Ok(())
        })
    }
}

/// What the linked controller would say of itself.
fn hello(vehicle_hash: u64) -> Hello {
    Hello {
        protocol: PROTOCOL,
        vehicle_hash,
        board: BOARD.try_into().unwrap_or_default(),
        build: env!("CARGO_PKG_VERSION").try_into().unwrap_or_default(),
        simulation: true,
    }
}

/// One side of the link.
#[derive(Default)]
struct Sender {
    sequence: u32,
}

impl Sender {
    fn write(&mut self, file: &mut impl Write, message: &Message) -> io::Result<()> {
        let header = Header { sequence: self.sequence, auth: Auth::None };
        self.sequence = self.sequence.wrapping_add(1);
        let mut buffer = [0; MAX_FRAME];
        let frame = wire::encode(&header, message, &mut buffer);
        file.write_all(frame.map_err(|_| io::Error::other("a message exceeds the link's frame"))?)
    }
}

/// A whole message, and where its frame begins.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// Offset of its first byte in the file.
    pub at_byte: u64,
    /// What it says.
    pub message: Message,
}

/// What is wrong with the bytes of a log, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadFrame {
    /// Offset of the frame's first byte in the file.
    pub at_byte: u64,
    /// What is wrong with it.
    pub what: String,
}

impl fmt::Display for BadFrame {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "byte {}: {}", self.at_byte, self.what)
    }
}

/// Reads frames one after the other. What the link would drop and go on is an error here: a gap does not replay.
#[derive(Debug)]
pub struct Frames<R> {
    bytes: io::Bytes<R>,
    taken: u64,
    decoder: Decoder,
}

impl<R: BufRead> Frames<R> {
    /// Reads from the start of a log.
    pub fn new(log: R) -> Self {
        Self { bytes: log.bytes(), taken: 0, decoder: Decoder::default() }
    }

    /// Bytes that were read so far.
    #[must_use]
    pub const fn taken(&self) -> u64 {
        self.taken
    }
}

impl<R: BufRead> Iterator for Frames<R> {
    type Item = Result<Frame, BadFrame>;

    /// The next frame; nothing where the log ends between two.
    fn next(&mut self) -> Option<Self::Item> {
        let mut began = None;
        loop {
            let at_byte = began.unwrap_or(self.taken);
            let bad = |what: String| Some(Err(BadFrame { at_byte, what }));
            let byte = match self.bytes.next() {
                Some(Ok(byte)) => byte,
                Some(Err(error)) => return bad(error.to_string()),
                None => return began.and_then(|_| bad("the file ends inside the frame".into())),
            };
            self.taken += 1;
            if byte != DELIMITER {
                began = Some(at_byte);
            }
            if self.taken - at_byte > MAX_FRAME as u64 {
                return bad(describe(Damage::Overlong)); // Another kind of file need not be read to its end.
            }
            match self.decoder.push(byte) {
                Some(Ok((_, message))) => return Some(Ok(Frame { at_byte, message })),
                Some(Err(damage)) => return bad(describe(damage)),
                None => {}
            }
        }
    }
}

fn describe(damage: Damage) -> String {
    match damage {
        Damage::Overlong => format!("no end of a frame within {MAX_FRAME} bytes: not a log of frames, or damaged"),
        Damage::Corrupt => "the frame is damaged: its CRC does not fit".into(),
        Damage::OtherSchema(theirs) => format!(
            "a frame of schema {theirs:08x}, this program reads {:08x}: replay it with the sources that flew it",
            wire::schema()
        ),
        Damage::Unknown => "a whole frame that holds no known message".into(),
    }
}
