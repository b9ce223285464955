//! The application: hello first, then one answer per message, whatever the transport.
//!
//! ```text
//! start ─► Hello ─► Configure ─► Ready ─┬─► (jumper fitted)     Sensors ─► Actuators ─► …
//!                       ▲    └► Refused └─► (jumper not fitted) a tick every 250 ms, from the drivers
//!                       └── at any time: begins anew
//! ```
//!
//! With the bench jumper fitted, measurements come over the link and the real actuators stay safe. Without it they come from
//! the drivers, and simulated ones are refused. Which of the two is read once, at start.

use embedded_io::{Read, ReadReady, Write};
use shared::{
    commands::Commands,
    device::Measurements,
    model::table::TrimTable,
    wire::{
        self, ActuatorFrame, Auth, Configuration, Decoder, Header, Hello, MAX_FRAME, Message, PROTOCOL, Refusal,
        SensorFrame,
    },
};

use crate::{
    BEATS_PER_TICK, BUILD,
    flight::{Flight, Stopwatch},
    log::log,
};

/// Bytes taken from the link at once.
const CHUNK: usize = 128;

/// What a board offers besides the link.
pub trait Board: Stopwatch {
    /// The board's name, at most 16 bytes.
    const NAME: &'static str;

    /// Whether the bench jumper is fitted, which allows simulated measurements.
    fn bench_jumper_fitted(&mut self) -> bool;
    /// Beats since start: [`crate::BEAT_HZ`] of them in a second.
    fn beats(&self) -> u32;
    /// Runs the actuators for one beat, at what was last ordered.
    fn run_actuators(&mut self);
    /// What the devices say.
    fn measure(&mut self) -> Measurements;
    /// Takes the autopilot's orders.
    fn order(&mut self, commands: &Commands);
    /// Stops and brakes everything.
    fn make_safe(&mut self);
    /// Sleeps until the next interrupt, unless a beat after `beats_done` is due or there is something on the link.
    fn sleep(&mut self, beats_done: u32);
}

/// The link is gone for good: its other end closed, or an error of the transport.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LinkClosed;

/// The application on one board, at one link.
#[derive(Debug)]
pub struct App<'t, Link, Devices> {
    link: Link,
    board: Devices,
    table: TrimTable<'t>,
    decoder: Decoder,
    sequence: u32,
    simulation: bool,
    flight: Option<Flight<'t>>,
    beats_done: u32,
}

impl<'t, Link: Read + Write, Devices: Board> App<'t, Link, Devices> {
    /// Puts the actuators safe and says hello.
    ///
    /// # Errors
    /// [`LinkClosed`] if that cannot be said and nothing can be done without a link: in simulation.
    pub fn start(link: Link, mut board: Devices, table: TrimTable<'t>) -> Result<Self, LinkClosed> {
        board.make_safe();
        let simulation = board.bench_jumper_fitted();
        let beats_done = board.beats();
        let decoder = Decoder::default();
        let mut app = Self { link, board, table, decoder, sequence: 0, simulation, flight: None, beats_done };
        let vehicle = app.table.vehicle();
        log!(info, "{} {}: {}, simulation {}", Devices::NAME, BUILD, vehicle.name.as_str(), simulation);
        let hello = Hello {
            protocol: PROTOCOL,
            vehicle_hash: vehicle.hash,
            board: Devices::NAME.try_into().unwrap_or_default(),
            build: BUILD.try_into().unwrap_or_default(),
            simulation,
        };
        match app.send(&Message::Hello(hello)) {
            Err(closed) if simulation => Err(closed),
            Err(LinkClosed) | Ok(()) => Ok(app),
        }
    }

    /// Whether measurements come over the link.
    pub const fn is_simulation(&self) -> bool {
        self.simulation
    }

    /// Frames that were dropped so far.
    pub const fn dropped(&self) -> u32 {
        self.decoder.dropped
    }

    /// Answers what comes over the link, for ever. Only in simulation: the drivers get no beat here.
    pub fn simulate(&mut self) -> LinkClosed {
        loop {
            if let Err(closed) = self.serve() {
                self.board.make_safe();
                log!(info, "link closed, {} frames dropped", self.dropped());
                return closed;
            }
        }
    }

    /// Waits for bytes, takes those that are there, and answers every message that they complete.
    ///
    /// # Errors
    /// [`LinkClosed`] at the end of the stream.
    pub fn serve(&mut self) -> Result<(), LinkClosed> {
        let mut chunk = [0; CHUNK];
        let received = self.link.read(&mut chunk).map_err(|_| LinkClosed)?;
        if received == 0 {
            return Err(LinkClosed);
        }
        for byte in chunk.iter().take(received) {
            match self.decoder.push(*byte) {
                Some(Ok((_, message))) => self.take(&message)?,
                Some(Err(damage)) => log!(warn, "dropped frame {}: {:?}", self.dropped(), damage),
                None => {}
            }
        }
        Ok(())
    }

    fn take(&mut self, message: &Message) -> Result<(), LinkClosed> {
        let answer = match message {
            Message::Configure(configuration) => self.configure(configuration).map(|()| Message::Ready),
            Message::Sensors(frame) => self.simulate_tick(frame).map(Message::Actuators),
            Message::Hello(_) | Message::Ready | Message::Refused(_) | Message::Actuators(_) => {
                Err(Refusal::NotForFirmware)
            }
        };
        let answer = answer.unwrap_or_else(|refusal| {
            log!(warn, "refused: {:?}", refusal);
            Message::Refused(refusal)
        });
        self.send(&answer)
    }

    /// A refused configuration leaves no flight, so that nothing goes on by an order that was meant to be replaced.
    fn configure(&mut self, configuration: &Configuration) -> Result<(), Refusal> {
        self.flight = None;
        self.board.make_safe();
        self.flight = Some(Flight::new(&self.table, configuration)?);
        Ok(())
    }

    fn simulate_tick(&mut self, frame: &SensorFrame) -> Result<ActuatorFrame, Refusal> {
        if !self.simulation {
            return Err(Refusal::NotSimulating);
        }
        let flight = self.flight.as_mut().filter(|flight| flight.next_tick() == frame.tick);
        let flight = flight.ok_or(Refusal::OutOfOrder)?;
        let (commands, step_clocks) = flight.step(&frame.measurements, &self.board);
        Ok(ActuatorFrame { tick: frame.tick, commands, step_clocks })
    }

    fn send(&mut self, message: &Message) -> Result<(), LinkClosed> {
        let header = Header { sequence: self.sequence, auth: Auth::None };
        self.sequence = self.sequence.wrapping_add(1);
        let mut buffer = [0; MAX_FRAME];
        // What the firmware says is short; a test encodes the longest.
        let Ok(frame) = wire::encode(&header, message, &mut buffer) else { return Ok(()) };
        self.link.write_all(frame).map_err(|_| LinkClosed)
    }
}

impl<Link: Read + ReadReady + Write, Devices: Board> App<'_, Link, Devices> {
    /// Flies from the drivers, for ever: every beat on time, a tick every [`BEATS_PER_TICK`] of them, asleep in between.
    pub fn fly(&mut self) -> ! {
        loop {
            self.fly_round();
            self.board.sleep(self.beats_done);
        }
    }

    /// Does what is due now: the link's messages, the drivers' beats, the autopilot's tick. A link that breaks ends no flight.
    pub fn fly_round(&mut self) {
        while matches!(self.link.read_ready(), Ok(true)) && self.serve().is_ok() {}
        let due = self.board.beats().wrapping_sub(self.beats_done);
        if due > 1 {
            log!(warn, "{} beats late", due.wrapping_sub(1));
        }
        for _ in 0..due {
            self.beat();
        }
    }

    fn beat(&mut self) {
        self.beats_done = self.beats_done.wrapping_add(1);
        self.board.run_actuators();
        if self.beats_done.checked_rem(BEATS_PER_TICK) == Some(0)
            && let Some(flight) = self.flight.as_mut()
        {
            let (commands, _) = flight.step(&self.board.measure(), &self.board);
            self.board.order(&commands);
        }
    }
}
