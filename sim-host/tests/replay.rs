//! A recorded flight replays to the same commands, and what does not is refused with its place.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use std::sync::LazyLock;

use shared::{
    model::table::TrimTable,
    wire::{self, Configuration, Decoder, Header, MAX_FRAME, Message, SensorFrame},
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{
        FlyingVehicle, Summary, fly,
        mission_file::MissionFile,
        pilot::ready,
        record::{BadFrame, Record, Sample},
        replay::{FieldDifference, Replay, replay},
    },
    model::{ocean::Ocean, vehicle::Vehicle},
};

/// A flight, its log and the table that flew it.
struct Flown {
    summary: Summary,
    log: Vec<u8>,
    table: Vec<u8>,
}

/// One yo to 8 m, begun at once: every phase but the crest in a few hundred ticks.
static FLOWN: LazyLock<Flown> = LazyLock::new(|| {
    let mut asked = MissionFile::load("default").unwrap();
    asked.mission.yos = 1;
    asked.mission.dive_to_mm = 8_000;
    asked.mission.climb_to_mm = 3_000;
    asked.mission.surface_time_s = 0;
    let vehicle = Vehicle::load(&asked.vehicle).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let ocean = Ocean::load("temperate", &vehicle.water).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let (file, mut autopilot) = ready(asked, &flying, &table, &ocean).unwrap();
    let mut record = Record { start: file.start, water: vehicle.water.clone(), samples: Vec::new() };
    let summary = fly(&flying, &ocean, &file.mission, &file.start, 7, &mut autopilot, &mut |tick| {
        record.samples.push(Sample::from(tick))
    })
    .unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("flight.frames");
    let configuration = Configuration { mission: file.mission.clone(), parameters: file.parameters };
    record.write_frames(&path, vehicle.hash(), &configuration).unwrap();
    Flown { summary, log: std::fs::read(path).unwrap(), table: bytes }
});

/// Frames before the first tick.
const OPENING: usize = 3;

/// The frames of the flight's log, each with its delimiter.
fn frames() -> Vec<Vec<u8>> {
    FLOWN.log.split_inclusive(|byte| *byte == wire::DELIMITER).map(<[u8]>::to_vec).collect()
}

/// Where a frame begins.
fn offset(index: usize) -> u64 {
    frames().iter().take(index).map(|frame| frame.len() as u64).sum()
}

/// Changes what a frame says, and makes its CRC right again.
fn change(frame: &mut Vec<u8>, what: impl FnOnce(&mut Message)) {
    let mut decoder = Decoder::default();
    let (header, mut message): (Header, Message) = frame.iter().find_map(|byte| decoder.push(*byte)).unwrap().unwrap();
    what(&mut message);
    *frame = wire::encode(&header, &message, &mut [0; MAX_FRAME]).unwrap().to_vec();
}

fn replayed(log: &[u8]) -> Result<Replay, BadFrame> {
    replay(log, &TrimTable::parse(&FLOWN.table).unwrap())
}

/// The refusal of a log.
fn refusal(log: &[u8]) -> String {
    let line = replayed(log).unwrap_err().to_string();
    assert!(!line.contains('\n'), "{line}");
    line
}

#[test]
fn a_flown_mission_replays_to_the_same_commands() {
    let replayed = replayed(&FLOWN.log).unwrap();
    assert_eq!((replayed.same, replayed.difference), (true, None));
    assert_eq!((replayed.ticks, &replayed.trace_hash), (FLOWN.summary.ticks, &FLOWN.summary.trace_hash));
    assert_eq!(frames().len(), OPENING + 2 * FLOWN.summary.ticks as usize);
}

/// The servo stands on the measured volume: 50 ml less than there is, far beyond its deadband, and the engine starts at once.
#[test]
fn a_changed_measurement_is_found_at_its_tick() {
    let mut engine_at_rest = 0;
    for tick in (0..FLOWN.summary.ticks).step_by(97) {
        let mut frames = frames();
        let asked = OPENING + 2 * tick as usize;
        let mut resting = false;
        change(&mut frames[asked + 1], |message| {
            let Message::Actuators(frame) = message else { panic!("{message:?}") };
            resting = frame.commands.vbd_rate_ul_s == 0;
        });
        change(&mut frames[asked], |message| {
            let Message::Sensors(SensorFrame { measurements, .. }) = message else { panic!("{message:?}") };
            measurements.vbd_ul -= 50_000;
        });
        if resting {
            let replayed = replayed(&frames.concat()).unwrap();
            let difference = replayed.difference.unwrap();
            assert_eq!((replayed.same, replayed.ticks, difference.tick), (false, tick, tick));
            assert!(difference.fields.iter().any(|field| field.field == "vbd_rate_ul_s" && field.recorded == 0));
            engine_at_rest += 1;
        }
    }
    assert!(engine_at_rest > 2, "only {engine_at_rest} changes were tried");
}

#[test]
fn a_changed_command_is_named_with_both_values_and_its_place() {
    let (mut frames, tick) = (frames(), 200);
    let index = OPENING + 2 * tick + 1;
    let mut recorded = [0; 2];
    change(&mut frames[index], |message| {
        let Message::Actuators(frame) = message else { panic!("{message:?}") };
        recorded = [frame.commands.north_mm + 1, i32::from(frame.commands.learned.weight_g) - 2];
        frame.commands.north_mm += 1;
        frame.commands.learned.weight_g -= 2;
    });
    let difference = replayed(&frames.concat()).unwrap().difference.unwrap();
    assert_eq!((difference.tick, difference.at_byte), (200, offset(index)));
    let field = |name: &str, recorded: i32, replayed: i32| FieldDifference {
        field: name.into(),
        recorded: recorded.into(),
        replayed: replayed.into(),
    };
    let [north_mm, weight_g] = recorded;
    let expected = [field("learned.weight_g", weight_g, weight_g + 2), field("north_mm", north_mm, north_mm - 1)];
    assert_eq!(difference.fields, expected);
    let line = difference.to_string();
    let start = format!("byte {}: tick 200 (50 s): `learned.weight_g` was {weight_g} and replays as ", offset(index));
    assert!(line.starts_with(&start) && !line.contains('\n'), "{line}");
}

/// Wherever a log is cut, either it ends between two ticks, or the cut is told with the frame that it hit.
#[test]
fn a_truncated_log_is_refused_where_it_ends() {
    let frames = frames();
    let mut at = 0;
    for (index, frame) in frames.iter().take(OPENING + 8).enumerate() {
        let before_a_tick = index > OPENING && (index - OPENING).is_multiple_of(2);
        match replayed(&FLOWN.log[..at]) {
            Ok(replayed) => assert!(before_a_tick && replayed.same && replayed.ticks as usize == (index - OPENING) / 2),
            Err(bad) => {
                assert!(!before_a_tick && bad.at_byte == at as u64, "{bad}");
                assert!(bad.what.ends_with(": the file ends before"), "{bad}");
            }
        }
        for cut in at + 1..at + frame.len() {
            let bad = replayed(&FLOWN.log[..cut]).unwrap_err();
            assert!(bad.at_byte == at as u64 && bad.what.ends_with(": the file ends inside the frame"), "{bad}");
        }
        at += frame.len();
    }
    assert_eq!(refusal(&FLOWN.log[..at - 1]).split(": ").nth(1), Some("commands of tick 3"));
}

#[test]
fn a_damaged_frame_is_refused_with_its_tick() {
    let mut frames = frames();
    let index = OPENING + 2 * 40;
    frames[index][6] ^= 0x10;
    let place = format!("byte {}: measurements of tick 40: ", offset(index));
    assert_eq!(refusal(&frames.concat()), format!("{place}the frame is damaged: its CRC does not fit"));
    frames[index] = vec![0x55; 2 * MAX_FRAME];
    assert!(refusal(&frames.concat()).starts_with(&format!("{place}no end of a frame within 512 bytes")));
}

#[test]
fn frames_of_another_schema_are_refused_with_both() {
    let content = (wire::schema() ^ 1).to_le_bytes();
    let plain = [content, shared::checksum::crc32(&content).to_le_bytes()].concat();
    // COBS: each run between zeros behind its length.
    let runs = plain.split(|byte| *byte == 0).flat_map(|run| [&[run.len() as u8 + 1], run].concat());
    let log: Vec<u8> = runs.chain([wire::DELIMITER]).collect();
    let line = refusal(&log);
    let [theirs, ours] = [wire::schema() ^ 1, wire::schema()];
    assert!(line.starts_with(&format!("byte 0: hello: a frame of schema {theirs:08x}, this program reads {ours:08x}")));
}

#[test]
fn a_missing_frame_and_a_second_flight_are_told_apart() {
    let whole = frames();
    let without = |index: usize| {
        let mut frames = frames();
        frames.remove(index);
        refusal(&frames.concat())
    };
    let place = offset(OPENING + 20);
    assert_eq!(
        without(OPENING + 20),
        format!("byte {place}: measurements of tick 10: the log has the commands of tick 10 here")
    );
    assert_eq!(without(0), "byte 0: hello: the log has a configuration here");
    let twice = [&whole[..OPENING + 20], &whole].concat().concat();
    assert_eq!(refusal(&twice), format!("byte {place}: measurements of tick 10: the log has a hello here"));
}

#[test]
fn another_table_is_refused() {
    let by = |vehicle: &str, envelope: &Envelope| {
        let bytes = generate(&Vehicle::load(vehicle).unwrap(), envelope).unwrap();
        replay(FLOWN.log.as_slice(), &TrimTable::parse(&bytes).unwrap()).unwrap_err().to_string()
    };
    let line = by("slocum-deep", &Envelope::default());
    assert!(line.starts_with("byte 0: hello: flown by vehicle ") && line.ends_with("(slocum-deep)"), "{line}");
    // The same vehicle, but dives no steeper than 20°: the mission's have 26°.
    let flat = by("slocum-paper", &Envelope { dive_deg: [12.0, 20.0], ..Envelope::default() });
    let wrong = "configuration: `mission.dive_path_angle_cdeg` is -2600, but this trim table takes -2000 to -1200";
    assert!(flat.starts_with(&format!("byte {}: {wrong}", offset(1))), "{flat}");
}
