//! What the real firmware says: hello first, refusals in order, nothing to damaged frames; and what it logs of it.

use std::time::Duration;

use hil_tests::{bench::Bench, dive::Dive};
use shared::{
    device::Measurements,
    wire::{Auth, Configuration, Header, MAX_FRAME, Message, PROTOCOL, Refusal, SensorFrame, encode, schema},
};
use sim_host::flight::link::{FirmwarePilot, Machine};

const PATIENCE: Duration = Duration::from_secs(30);

const STILL: Measurements = Measurements { pressure_pa: Some(0), battery_mv: Some(14_000), ..Measurements::silent() };

fn sensors(tick: u32) -> Message {
    Message::Sensors(SensorFrame { tick, measurements: STILL })
}

impl Conversation {
    fn hear(&mut self) -> Message {
        self.0.stream.receive(PATIENCE).unwrap_or_else(|error| panic!("{error}; log: {:#?}", self.0.log()))
    }

    fn ask(&mut self, message: &Message) -> Message {
        self.0.stream.send(message).unwrap();
        self.hear()
    }
}

/// A bench to talk with.
struct Conversation(Bench);

fn start() -> Conversation {
    Conversation(Bench::start(Machine::Mps2An386, "mps2"))
}

#[test]
fn hello_comes_first_and_says_who_speaks() {
    let mut firmware = start();
    let Message::Hello(hello) = firmware.hear() else { panic!("no hello") };
    assert_eq!(hello.protocol, PROTOCOL);
    assert_eq!(hello.vehicle_hash, Dive::standard().vehicle_hash());
    assert_eq!((hello.board.as_str(), hello.simulation), ("mps2-an386", true));
    assert_eq!(hello.build.as_str(), firmware::BUILD);
}

#[test]
fn what_makes_no_sense_is_refused_and_logged_and_does_no_harm() {
    let mut firmware = start();
    assert!(matches!(firmware.hear(), Message::Hello(_)));
    let refused = Message::Refused;
    assert_eq!(firmware.ask(&sensors(0)), refused(Refusal::OutOfOrder), "measurements before a mission");
    assert_eq!(firmware.ask(&Message::Ready), refused(Refusal::NotForFirmware));
    let good = Dive::standard().configuration();
    let mut deep = good.clone();
    deep.mission.dive_to_mm = i32::MAX;
    assert_eq!(firmware.ask(&Message::Configure(deep)), refused(Refusal::InvalidConfiguration));
    let mut hasty = good.clone();
    hasty.parameters.pitch_period_s = 0;
    assert_eq!(firmware.ask(&Message::Configure(hasty)), refused(Refusal::InvalidConfiguration));
    assert_eq!(firmware.ask(&Message::Configure(good.clone())), Message::Ready);
    assert_eq!(firmware.ask(&sensors(1)), refused(Refusal::OutOfOrder), "a mission begins at tick 0");
    for tick in 0..3 {
        let Message::Actuators(answer) = firmware.ask(&sensors(tick)) else { panic!("no answer to tick {tick}") };
        assert_eq!(answer.tick, tick);
    }
    assert_eq!(firmware.ask(&sensors(2)), refused(Refusal::OutOfOrder), "a tick flies once");
    assert_eq!(firmware.ask(&Message::Configure(good)), Message::Ready, "a new mission begins anew");
    assert!(matches!(firmware.ask(&sensors(0)), Message::Actuators(answer) if answer.tick == 0));
    let depth = "configuration refused: dive_to_mm is 2147483647, not 1000 to";
    let expected = [
        "info mps2-an386",
        "warn refused: OutOfOrder",
        "warn refused: NotForFirmware",
        &format!("warn {depth}"),
        "warn refused: InvalidConfiguration",
        "warn configuration refused: pitch_period_s is 0, not 2 to 300",
        "warn refused: InvalidConfiguration",
        "info configuration accepted: 2 yos to 200000 mm",
        "warn refused: OutOfOrder",
        "warn refused: OutOfOrder",
        "info configuration accepted: 2 yos to 200000 mm",
    ];
    assert_log(&firmware.0.log(), &expected);
}

/// Every line begins as expected; all of them are shown if one does not.
fn assert_log(log: &[String], expected: &[&str]) {
    let alike = log.len() == expected.len() && log.iter().zip(expected).all(|(line, start)| line.starts_with(start));
    assert!(alike, "logged {log:#?}, expected {expected:#?}");
}

/// The bytes of a sensor frame.
fn frame_of(tick: u32) -> Vec<u8> {
    let header = Header { sequence: 0, auth: Auth::None };
    encode(&header, &sensors(tick), &mut [0; MAX_FRAME]).unwrap().to_vec()
}

#[test]
fn damaged_frames_are_dropped_counted_and_never_acted_on() {
    let mut firmware = start();
    assert!(matches!(firmware.hear(), Message::Hello(_)));
    assert_eq!(firmware.ask(&Message::Configure(Dive::standard().configuration())), Message::Ready);
    let good = frame_of(0);
    let mut flipped = good.clone();
    flipped[9] ^= 0x04;
    let overlong = [[0x55; 2 * MAX_FRAME].as_slice(), &[0]].concat();
    let truncated = [&good[..good.len() / 2], &[0]].concat();
    for damaged in [&flipped, &overlong, &truncated, &of_another_schema()] {
        firmware.0.stream.send_bytes(damaged).unwrap();
    }
    // Had one of them been acted on, tick 0 would be over, and its answer would come first.
    assert!(matches!(firmware.ask(&sensors(0)), Message::Actuators(answer) if answer.tick == 0));
    let dropped = ["Corrupt", "Overlong", "Corrupt"].map(str::to_owned);
    let dropped = dropped.into_iter().chain([format!("OtherSchema({})", schema() ^ 1)]);
    let dropped = dropped.zip(1..).map(|(damage, count)| format!("warn dropped frame {count}: {damage}"));
    let log = firmware.0.log();
    assert_eq!(log[2..], dropped.collect::<Vec<_>>());
}

/// A whole frame whose sender was built from other types: schema and CRC, framed by hand.
fn of_another_schema() -> Vec<u8> {
    let content = (schema() ^ 1).to_le_bytes();
    let plain = [content, shared::checksum::crc32(&content).to_le_bytes()].concat();
    assert!(!plain.contains(&0), "COBS without zeros is a count and the bytes");
    [&[plain.len() as u8 + 1], plain.as_slice(), &[0]].concat()
}

#[test]
fn firmware_of_another_vehicle_is_named() {
    let Conversation(bench) = start();
    let configuration: Configuration = Dive::standard().configuration();
    let error = FirmwarePilot::connect(bench.stream, Some(bench.emulator), 7, &configuration).unwrap_err();
    assert!(error.contains("the mission is for 0000000000000007"), "{error}");
}

#[test]
fn the_emulation_ends_well_when_the_host_closes_the_link() {
    let Conversation(bench) = start();
    let (mut emulator, mut stream) = (bench.emulator, bench.stream);
    assert!(matches!(stream.receive(PATIENCE).unwrap(), Message::Hello(_)));
    drop(stream);
    assert!(emulator.wait(PATIENCE).unwrap(), "it ended with failure");
}
