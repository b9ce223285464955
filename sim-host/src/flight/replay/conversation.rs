//! The frames of a log in the order in which host and firmware say them.

use std::{fmt::Display, io::BufRead};

use shared::{
    commands::Commands,
    device::Measurements,
    model::table::TrimTable,
    wire::{Configuration, Hello, Message, PROTOCOL},
};

use crate::flight::record::{BadFrame, Frame, Frames};

/// A log, read message by message.
pub(super) struct Conversation<R> {
    frames: Frames<R>,
}

/// One tick of a log.
pub(super) struct Tick {
    /// What the controller was told.
    pub(super) measurements: Measurements,
    /// What it answered.
    pub(super) commands: Commands,
    /// Where the answer's frame begins.
    pub(super) at_byte: u64,
}

impl<R: BufRead> Conversation<R> {
    pub(super) fn new(log: R) -> Self {
        Self { frames: Frames::new(log) }
    }

    /// Who flew, if it was the table's vehicle.
    pub(super) fn hello(&mut self, table: &TrimTable<'_>) -> Result<Hello, BadFrame> {
        let frame = self.expect("hello")?;
        let Message::Hello(hello) = frame.message else { return Err(misplaced(&frame, "hello")) };
        let bad = |what: String| BadFrame { at_byte: frame.at_byte, what: format!("hello: {what}") };
        if hello.protocol != PROTOCOL {
            return Err(bad(format!("protocol {}, this program replays {PROTOCOL}", hello.protocol)));
        }
        let (flown, vehicle) = (hello.vehicle_hash, table.vehicle());
        if flown != vehicle.hash {
            return Err(bad(format!(
                "flown by vehicle {flown:016x}, the trim table is for another, {:016x} ({})",
                vehicle.hash, vehicle.name
            )));
        }
        Ok(hello)
    }

    /// Where it was told what to fly, and what.
    pub(super) fn configuration(&mut self) -> Result<(u64, Configuration), BadFrame> {
        let frame = self.expect("configuration")?;
        match frame.message {
            Message::Configure(configuration) => Ok((frame.at_byte, configuration)),
            _ => Err(misplaced(&frame, "configuration")),
        }
    }

    /// That it will fly that.
    pub(super) fn acceptance(&mut self) -> Result<(), BadFrame> {
        let frame = self.expect("acceptance")?;
        if frame.message == Message::Ready { Ok(()) } else { Err(misplaced(&frame, "acceptance")) }
    }

    /// Measurements and the commands that answer them. Nothing at the end of the log, but the first tick must be there.
    pub(super) fn tick(&mut self, tick: u32) -> Result<Option<Tick>, BadFrame> {
        let awaited = format_args!("measurements of tick {tick}");
        let asked = if tick == 0 { Some(self.expect(awaited)?) } else { self.next(awaited)? };
        let Some(asked) = asked else { return Ok(None) };
        let measurements = match &asked.message {
            Message::Sensors(frame) if frame.tick == tick => frame.measurements,
            _ => return Err(misplaced(&asked, awaited)),
        };
        let awaited = format_args!("commands of tick {tick}");
        let answer = self.expect(awaited)?;
        match &answer.message {
            Message::Actuators(frame) if frame.tick == tick => {
                Ok(Some(Tick { measurements, commands: frame.commands, at_byte: answer.at_byte }))
            }
            _ => Err(misplaced(&answer, awaited)),
        }
    }

    fn expect(&mut self, awaited: impl Display) -> Result<Frame, BadFrame> {
        let missing = format!("{awaited}: the file ends before");
        let next = self.next(awaited)?;
        next.ok_or(BadFrame { at_byte: self.frames.taken(), what: missing })
    }

    fn next(&mut self, awaited: impl Display) -> Result<Option<Frame>, BadFrame> {
        let frame = self.frames.next().transpose();
        frame.map_err(|BadFrame { at_byte, what }| BadFrame { at_byte, what: format!("{awaited}: {what}") })
    }
}

/// A sound frame that says something else.
fn misplaced(frame: &Frame, awaited: impl Display) -> BadFrame {
    let found = match &frame.message {
        Message::Hello(_) => "a hello".into(),
        Message::Configure(_) => "a configuration".into(),
        Message::Ready => "an acceptance".into(),
        Message::Refused(refusal) => format!("a refusal, {refusal:?}"),
        Message::Sensors(frame) => format!("the measurements of tick {}", frame.tick),
        Message::Actuators(frame) => format!("the commands of tick {}", frame.tick),
    };
    BadFrame { at_byte: frame.at_byte, what: format!("{awaited}: the log has {found} here") }
}
