//! The real firmware flies the plant, and commands what the linked autopilot commands, bit for bit; its link's log replays.

use std::{fs::File, io::BufReader, time::Instant};

use hil_tests::{
    bench::{Bench, Traces},
    dive::{Dive, Twins},
    report,
};
use sim_host::flight::{
    Outcome, Summary,
    link::{FirmwarePilot, Machine},
    replay::replay,
};

/// Instructions that a step may take, in the median and at worst: 0.5 % and 1.5 % of a tick at 16 MHz.
const INSTRUCTIONS: [u32; 2] = [20_000, 60_000];

/// Flies a dive twice, linked and by firmware, and checks that nobody could tell.
fn fly_both(machine: Machine, bin: &str, dive: &Dive) -> (FirmwarePilot, Traces) {
    let linked = dive.fly(&mut dive.autopilot()).unwrap();
    let (firmware, traces) = Bench::start(machine, bin).pilot(dive);
    let board = firmware.hello().board.clone();
    let mut twins = Twins { firmware, linked: dive.autopilot() };
    let began = Instant::now();
    let emulated = dive.fly(&mut twins).unwrap_or_else(|error| panic!("{error}; log: {:#?}", traces.log()));
    let seconds = began.elapsed().as_secs_f64();
    report(&format!("linked     {} in {} ticks", linked.trace_hash, linked.ticks));
    report(&format!(
        "{board:10} {} in {} ticks, {:.0}/s",
        emulated.trace_hash,
        emulated.ticks,
        f64::from(emulated.ticks) / seconds
    ));
    assert_eq!(figures(&emulated), figures(&linked));
    assert_eq!(emulated.outcome, Outcome::Completed);
    let replayed = replay(BufReader::new(File::open(traces.frames()).unwrap()), dive.table()).unwrap();
    assert_eq!((replayed.difference, replayed.ticks), (None, emulated.ticks));
    assert_eq!((replayed.board.as_str(), &replayed.trace_hash), (board.as_str(), &emulated.trace_hash));
    (twins.firmware, traces)
}

/// A summary without the time that it took.
fn figures(summary: &Summary) -> Summary {
    Summary { wall_s: 0.0, real_time_factor: 0.0, ..summary.clone() }
}

/// The phases that the firmware logged, in order.
fn phases(traces: &Traces) -> Vec<String> {
    let log = traces.log();
    let told = log.iter().filter_map(|line| line.strip_prefix("info tick "));
    told.filter_map(|line| Some(line.split_once(": ")?.1.to_owned())).collect()
}

#[test]
fn mps2_flies_the_default_mission_over_fifos() {
    let dive = Dive::standard();
    let (firmware, traces) = fly_both(Machine::Mps2An386, "mps2", &dive);
    // 128 ns of virtual time per instruction (`-icount shift=7`), 40 ns per count of the 25 MHz core clock.
    let mut instructions: Vec<u32> = firmware.step_clocks().iter().map(|clocks| clocks * 40 / 128).collect();
    instructions.sort_unstable();
    let (median, worst) = (instructions[instructions.len() / 2], instructions[instructions.len() - 1]);
    report(&format!("instructions per step: median {median}, worst {worst}"));
    // Counted by the emulator, the same in every run.
    assert!(median <= INSTRUCTIONS[0] && worst <= INSTRUCTIONS[1], "a step takes {median}, at worst {worst}");
    let yos = ["Dive, yo 1", "Apogee, yo 1", "Climb, yo 1", "Crest, yo 1", "Dive, yo 2", "Apogee, yo 2", "Climb, yo 2"];
    assert_eq!(phases(&traces), [yos.as_slice(), &["Surfacing, yo 2", "Complete, yo 2"]].concat());
}

#[test]
fn f405_flies_a_short_dive_over_its_uart() {
    let (_, traces) = fly_both(Machine::NetduinoPlus2, "f405", &Dive::short());
    let dive = ["Dive, yo 1", "Apogee, yo 1", "Climb, yo 1", "Surfacing, yo 1", "Complete, yo 1"];
    assert_eq!(phases(&traces), dive);
}
