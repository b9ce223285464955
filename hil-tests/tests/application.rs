//! The application with its drivers, on simulated devices, without an emulator: flight mode above all.

use std::{cell::RefCell, collections::VecDeque, rc::Rc};

use embedded_io::{ErrorKind, ErrorType, Read, ReadReady, Write};
use firmware::{
    BEAT_HZ, TRIM_TABLE,
    actuators::Actuators,
    app::{App, Board, LinkClosed},
    flight::Stopwatch,
};
use hil_tests::{
    devices::{Devices, Pin, Pwm},
    dive::Dive,
};
use shared::{
    commands::Commands,
    device::Measurements,
    model::table::TrimTable,
    wire::{Auth, Decoder, Header, MAX_FRAME, Message, Refusal, SensorFrame, encode},
};

/// The world around the application: bytes both ways, time, devices.
struct World {
    to_firmware: VecDeque<u8>,
    from_firmware: VecDeque<u8>,
    link_is_broken: bool,
    beats: u32,
    devices: Devices,
}

type Shared = Rc<RefCell<World>>;

struct Bytes(Shared);

impl ErrorType for Bytes {
    type Error = ErrorKind;
}

impl Read for Bytes {
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, ErrorKind> {
        let mut world = self.0.borrow_mut();
        let count = buffer.len().min(world.to_firmware.len());
        buffer.iter_mut().zip(world.to_firmware.drain(..count)).for_each(|(slot, byte)| *slot = byte);
        Ok(count)
    }
}

impl ReadReady for Bytes {
    fn read_ready(&mut self) -> Result<bool, ErrorKind> {
        if self.0.borrow().link_is_broken {
            return Err(ErrorKind::BrokenPipe);
        }
        Ok(!self.0.borrow().to_firmware.is_empty())
    }
}

impl Write for Bytes {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        self.0.borrow_mut().from_firmware.extend(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        Ok(())
    }
}

struct Simulated {
    world: Shared,
    drivers: Actuators<Pwm, Pin>,
    jumper: bool,
}

impl Stopwatch for Simulated {
    fn now(&self) -> u32 {
        0
    }

    fn clocks_since(&self, _: u32) -> u32 {
        0
    }
}

impl Board for Simulated {
    const NAME: &'static str = "simulated";

    fn bench_jumper_fitted(&mut self) -> bool {
        self.jumper
    }

    fn beats(&self) -> u32 {
        self.world.borrow().beats
    }

    fn run_actuators(&mut self) {
        let readings = self.world.borrow().devices.readings();
        self.drivers.beat(&readings);
    }

    fn measure(&mut self) -> Measurements {
        let positions = self.drivers.positions();
        Measurements {
            r_px_um: positions.r_px_um,
            mu_cdeg: positions.mu_cdeg,
            vbd_ul: positions.vbd_ul,
            battery_mv: Some(14_000),
            ..Measurements::silent()
        }
    }

    fn order(&mut self, commands: &Commands) {
        self.drivers.order(commands);
    }

    fn make_safe(&mut self) {
        self.drivers.make_safe();
    }

    fn sleep(&mut self, _: u32) {}
}

/// An application that was just started, and the world around it.
struct Desk {
    app: App<'static, Bytes, Simulated>,
    world: Shared,
    decoder: Decoder,
}

impl Desk {
    fn start(jumper: bool) -> Self {
        let table = TrimTable::parse(TRIM_TABLE).unwrap();
        let devices = Devices::new(&table.vehicle().actuators);
        let drivers = devices.drivers();
        let (to_firmware, from_firmware) = (VecDeque::new(), VecDeque::new());
        let world =
            Rc::new(RefCell::new(World { to_firmware, from_firmware, link_is_broken: false, beats: 0, devices }));
        let board = Simulated { world: Rc::clone(&world), drivers, jumper };
        let app = App::start(Bytes(Rc::clone(&world)), board, table).unwrap();
        let mut desk = Self { app, world, decoder: Decoder::default() };
        assert!(matches!(desk.hear()[..], [Message::Hello(_)]), "hello comes first, and alone");
        desk
    }

    fn say(&self, message: &Message) {
        let mut buffer = [0; MAX_FRAME];
        let frame = encode(&Header { sequence: 0, auth: Auth::None }, message, &mut buffer).unwrap();
        self.world.borrow_mut().to_firmware.extend(frame);
    }

    fn hear(&mut self) -> Vec<Message> {
        let bytes: Vec<u8> = self.world.borrow_mut().from_firmware.drain(..).collect();
        bytes.iter().filter_map(|byte| self.decoder.push(*byte)).map(|frame| frame.unwrap().1).collect()
    }

    /// Lets time pass in flight.
    fn fly(&mut self, beats: u32) {
        for _ in 0..beats {
            self.world.borrow_mut().beats += 1;
            self.app.fly_round();
            self.world.borrow_mut().devices.advance();
        }
    }
}

fn sensors(tick: u32) -> Message {
    let measurements = Measurements { pressure_pa: Some(0), ..Measurements::silent() };
    Message::Sensors(SensorFrame { tick, measurements })
}

#[test]
fn in_flight_the_drivers_bring_the_vehicle_to_its_surface_trim_and_rest_there() {
    let mut desk = Desk::start(false);
    desk.fly(BEAT_HZ);
    assert!(desk.world.borrow().devices.are_safe(), "without a mission nothing moves");
    desk.say(&Message::Configure(Dive::standard().configuration()));
    desk.fly(120 * BEAT_HZ);
    assert_eq!(desk.hear(), [Message::Ready], "in flight nothing is sent unasked");
    let devices = &desk.world.borrow().devices;
    assert!(devices.are_safe(), "at rest it is stopped and braked: {devices:?}");
    let (volume, travel) = (devices.piston.volume_ul, devices.piston.calibration.travel_ul);
    // Within the controller's deadband of its surface trim: lightest, and nose down.
    assert!((volume - f64::from(travel.max)).abs() < 2_500.0, "{volume} µl, the most is {}", travel.max);
    let (r_px, travel) = (devices.axial.position, devices.axial.calibration.travel);
    assert!((r_px - f64::from(travel.max)).abs() < 500.0, "{r_px} µm, the most is {}", travel.max);
}

#[test]
fn in_flight_simulated_measurements_are_refused() {
    let mut desk = Desk::start(false);
    desk.say(&Message::Configure(Dive::standard().configuration()));
    desk.say(&sensors(0));
    desk.fly(1);
    assert_eq!(desk.hear(), [Message::Ready, Message::Refused(Refusal::NotSimulating)]);
}

#[test]
fn in_simulation_the_real_actuators_stay_safe() {
    let mut desk = Desk::start(true);
    desk.say(&Message::Configure(Dive::standard().configuration()));
    desk.say(&sensors(0));
    assert_eq!(desk.app.simulate(), LinkClosed, "the end of the stream");
    let [Message::Ready, Message::Actuators(answer)] = &desk.hear()[..] else { panic!("no answer") };
    assert_ne!(answer.commands.vbd_rate_ul_s, 0, "it does order something");
    assert!(desk.world.borrow().devices.are_safe());
}

#[test]
fn a_refused_mission_ends_the_one_under_way() {
    let mut desk = Desk::start(false);
    let good = Dive::standard().configuration();
    let mut bad = good.clone();
    bad.mission.yos = 0;
    desk.say(&Message::Configure(good));
    desk.fly(BEAT_HZ);
    assert!(!desk.world.borrow().devices.are_safe(), "it moves");
    desk.say(&Message::Configure(bad));
    desk.fly(BEAT_HZ);
    assert_eq!(desk.hear(), [Message::Ready, Message::Refused(Refusal::InvalidConfiguration)]);
    assert!(desk.world.borrow().devices.are_safe());
}

#[test]
fn a_link_that_breaks_ends_no_flight() {
    let mut desk = Desk::start(false);
    desk.say(&Message::Configure(Dive::standard().configuration()));
    desk.fly(1);
    desk.world.borrow_mut().link_is_broken = true;
    desk.fly(120 * BEAT_HZ);
    let devices = &desk.world.borrow().devices;
    assert!(devices.piston.volume_ul > 0.9 * f64::from(devices.piston.calibration.travel_ul.max), "{devices:?}");
}

#[test]
fn beats_that_were_slept_through_are_made_up_for() {
    let mut desk = Desk::start(false);
    desk.say(&Message::Configure(Dive::standard().configuration()));
    desk.world.borrow_mut().beats += 7;
    desk.app.fly_round();
    assert!(!desk.world.borrow().devices.are_safe(), "the tick among them was flown");
}
