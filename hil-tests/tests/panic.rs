//! A panic leaves the actuators safe, and says why.

use std::{
    thread,
    time::{Duration, Instant},
};

use hil_tests::{bench::Bench, dive::Dive};
use sim_host::flight::link::{FirmwarePilot, Machine};

const PATIENCE: Duration = Duration::from_secs(30);
/// Duty registers of the three motors: TIM3_CCR1 to TIM3_CCR3.
const DUTIES: &str = "xp /3wx 0x40000434";

/// Waits until a line of the log holds `text`.
fn await_log(bench: &Bench, text: &str) -> String {
    let deadline = Instant::now() + PATIENCE;
    loop {
        let log = bench.log();
        if let Some(line) = log.iter().find(|line| line.contains(text)) {
            return line.clone();
        }
        assert!(Instant::now() < deadline, "nothing logged like {text:?}: {log:#?}");
        thread::sleep(Duration::from_millis(10));
    }
}

fn duties(bench: &Bench) -> Vec<u32> {
    let answer = bench.emulator.monitor(DUTIES).unwrap();
    let (_, words) = answer.rsplit_once(": ").unwrap_or_else(|| panic!("the monitor says {answer:?}"));
    words.split_whitespace().map(|word| u32::from_str_radix(&word[2..], 16).unwrap()).collect()
}

#[test]
fn on_the_f405_running_motors_stop() {
    let mut bench = Bench::start(Machine::NetduinoPlus2, "f405-drill");
    await_log(&bench, "running");
    let running = duties(&bench);
    assert!(running.len() == 3 && running.iter().all(|duty| *duty > 0), "the motors should run: {running:?}");
    bench.stream.send_bytes(&[1]).unwrap();
    let line = await_log(&bench, "panic");
    assert!(line.starts_with("error") && line.contains("this is a drill") && line.contains("drill.rs"), "{line}");
    assert_eq!(duties(&bench), [0, 0, 0]);
}

#[test]
fn in_emulation_the_host_learns_of_it_at_once() {
    let bench = Bench::start(Machine::Mps2An386, "mps2-drill");
    let dive = Dive::standard();
    let began = Instant::now();
    let configuration = dive.configuration();
    let error = FirmwarePilot::connect(bench.stream, Some(bench.emulator), dive.vehicle_hash(), &configuration);
    let error = error.unwrap_err();
    assert!(error.contains("the emulation ended with exit status: 1"), "{error}");
    assert!(began.elapsed() < PATIENCE, "it took {:?}", began.elapsed());
}
