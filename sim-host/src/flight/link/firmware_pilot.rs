//! Firmware as the pilot of a simulated vehicle.

use std::time::Duration;

use shared::{
    commands::Commands,
    device::Measurements,
    wire::{Configuration, Hello, Message, PROTOCOL, SensorFrame},
};

use super::{Emulator, Stream};
use crate::flight::pilot::Pilot;

/// Time to boot and say hello; a loaded machine is slow.
const BOOT: Duration = Duration::from_secs(30);
/// Time for one answer.
const ANSWER: Duration = Duration::from_secs(20);

/// Firmware that accepted a mission, one exchange per tick.
#[derive(Debug)]
pub struct FirmwarePilot {
    ends: Ends,
    hello: Hello,
    step_clocks: Vec<u32>,
}

/// The link, and what is at its other end.
#[derive(Debug)]
struct Ends {
    stream: Stream,
    emulator: Option<Emulator>,
}

impl FirmwarePilot {
    /// Awaits the firmware's hello, checks that it flies this vehicle, and gives it the mission.
    ///
    /// # Errors
    /// One line: silence, another protocol, schema or vehicle, no bench jumper, or a mission that is refused.
    pub fn connect(
        stream: Stream,
        emulator: Option<Emulator>,
        vehicle_hash: u64,
        configuration: &Configuration,
    ) -> Result<Self, String> {
        let mut ends = Ends { stream, emulator };
        let hello = match ends.receive(BOOT)? {
            Message::Hello(hello) => hello,
            other => return Err(format!("the firmware began with {other:?} instead of hello")),
        };
        check(&hello, vehicle_hash)?;
        ends.stream.send(&Message::Configure(configuration.clone()))?;
        match ends.receive(ANSWER)? {
            Message::Ready => Ok(Self { ends, hello, step_clocks: Vec::new() }),
            Message::Refused(refusal) => Err(format!("the firmware refused the mission: {refusal:?}")),
            other => Err(format!("the firmware answered a configuration with {other:?}")),
        }
    }

    /// What the firmware said of itself.
    #[must_use]
    pub const fn hello(&self) -> &Hello {
        &self.hello
    }

    /// Counts of the core clock that each step took so far.
    #[must_use]
    pub fn step_clocks(&self) -> &[u32] {
        &self.step_clocks
    }

    /// The emulator that the firmware runs in, unless it runs on a board.
    #[must_use]
    pub const fn emulator(&self) -> Option<&Emulator> {
        self.ends.emulator.as_ref()
    }

    /// Closes the link, and gives back the emulator.
    #[must_use]
    pub fn close(self) -> Option<Emulator> {
        self.ends.emulator
    }
}

impl Ends {
    /// The next message; if none comes and the emulator is gone, says how it ended.
    fn receive(&mut self, patience: Duration) -> Result<Message, String> {
        let end = |emulator: &mut Emulator| emulator.wait(Duration::from_millis(200)).ok().and(emulator.end());
        self.stream.receive(patience).map_err(|error| match self.emulator.as_mut().and_then(end) {
            Some(end) => format!("{error}: {end}"),
            None => error,
        })
    }
}

impl Pilot for FirmwarePilot {
    fn step(&mut self, tick: u32, measurements: &Measurements) -> Result<Commands, String> {
        self.ends.stream.send(&Message::Sensors(SensorFrame { tick, measurements: *measurements }))?;
        match self.ends.receive(ANSWER)? {
            Message::Actuators(answer) if answer.tick == tick => {
                self.step_clocks.push(answer.step_clocks);
                Ok(answer.commands)
            }
            other => Err(format!("the firmware answered tick {tick} with {other:?}")),
        }
    }
}

fn check(hello: &Hello, vehicle_hash: u64) -> Result<(), String> {
    if hello.protocol != PROTOCOL {
        return Err(format!("the firmware speaks protocol {}, this host {PROTOCOL}", hello.protocol));
    }
    if hello.vehicle_hash != vehicle_hash {
        let theirs = hello.vehicle_hash;
        return Err(format!("the firmware flies vehicle {theirs:016x}, the mission is for {vehicle_hash:016x}"));
    }
    if !hello.simulation {
        return Err(format!("{}: fit the bench jumper to simulate measurements", hello.board));
    }
    Ok(())
}
