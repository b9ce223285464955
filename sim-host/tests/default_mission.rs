//! The default mission, flown in the loop.

use shared::{autopilot::Autopilot, commands::Phase, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, Outcome, Summary, fly, mission_file::MissionFile},
    model::{ocean::Ocean, plant::euler_from_quaternion, vehicle::Vehicle},
};

/// One tick as the truth has it.
struct Truth {
    yo: u16,
    phase: Phase,
    depth_m: f64,
    heading_error_deg: f64,
}

fn fly_mission(seed: u64, change: impl FnOnce(&mut MissionFile)) -> (Summary, Vec<Truth>) {
    let mut file = MissionFile::load("default").unwrap();
    change(&mut file);
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let mut truth = Vec::new();
    let summary =
        fly(&flying, &Ocean::still(&vehicle.water), &file.mission, &file.start, seed, &mut autopilot, &mut |tick| {
            let heading_deg = euler_from_quaternion(&tick.state.quaternion).z.to_degrees();
            let error = f64::from(tick.commands.target_heading_cdeg) / 100.0 - heading_deg;
            truth.push(Truth {
                yo: tick.commands.yo,
                phase: tick.commands.phase,
                depth_m: tick.state.position_m.z,
                heading_error_deg: (error + 180.0).rem_euclid(360.0) - 180.0,
            });
        })
        .unwrap();
    (summary, truth)
}

#[test]
fn two_yos_come_back_with_depth_and_heading_held() {
    for seed in 1..=8 {
        let (summary, truth) = fly_mission(seed, |_| {});
        assert_eq!(summary.outcome, Outcome::Completed, "seed {seed}");
        assert_eq!(summary.aborts, [""; 0]);
        for yo in [1, 2] {
            let apogee_m = truth.iter().filter(|t| t.yo == yo).map(|t| t.depth_m).fold(0.0, f64::max);
            assert!((apogee_m - 200.0).abs() < 5.0, "seed {seed}: apogee of yo {yo} at {apogee_m:.1} m");
        }
        let top_m = truth.iter().filter(|t| t.phase == Phase::Crest).map(|t| t.depth_m).fold(f64::MAX, f64::min);
        assert!(top_m > 1.0, "seed {seed}: the top of the first yo at {top_m:.1} m");
        assert!(truth.last().unwrap().depth_m < 1.0, "seed {seed}: back at the surface");

        let second: Vec<f64> =
            truth.iter().filter(|t| t.yo == 2 && t.phase != Phase::Complete).map(|t| t.heading_error_deg).collect();
        let entry = second.iter().position(|error| error.abs() < 5.0).expect("the heading is reached");
        let held = &second[entry..];
        let rms_deg = (held.iter().map(|error| error * error).sum::<f64>() / held.len() as f64).sqrt();
        assert!(rms_deg < 5.0, "seed {seed}: heading held to {rms_deg:.2}° rms");
        assert!(held.len() > 4_000, "most of the second yo is judged");
    }
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_seed_others() {
    let hash = |seed| fly_mission(seed, |_| {}).0.trace_hash;
    assert_eq!(hash(5), hash(5));
    assert_ne!(hash(5), hash(6));
}

#[test]
fn measurements_replay_to_the_same_commands() {
    let file = MissionFile::load("default").unwrap();
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let autopilot = || Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let mut log = Vec::new();
    fly(&flying, &Ocean::still(&vehicle.water), &file.mission, &file.start, 1, &mut autopilot(), &mut |tick| {
        log.push((*tick.measurements, *tick.commands))
    })
    .unwrap();
    let mut again = autopilot();
    for (tick, (measurements, commands)) in (0..).zip(&log) {
        assert_eq!(again.step(tick, measurements), *commands, "tick {tick}");
    }
    assert!(log.len() > 10_000);
}

#[test]
fn too_deep_aborts_and_brings_it_home() {
    // The abort depth lies above the apogee that this mission aims at, as if the pump had been late.
    let (summary, truth) = fly_mission(1, |file| file.mission.abort_depth_mm = file.mission.dive_to_mm + 1);
    assert_eq!((summary.outcome, summary.aborts.as_slice()), (Outcome::Aborted, &["Overdepth".to_string()][..]));
    assert!(truth.last().unwrap().depth_m < 1.0);
    assert!(truth.iter().all(|t| t.yo < 2), "no further yo after an abort");
}

#[test]
fn too_long_aborts_and_brings_it_home() {
    let (summary, truth) = fly_mission(1, |file| file.mission.max_duration_s = 600);
    assert_eq!((summary.outcome, summary.aborts.as_slice()), (Outcome::Aborted, &["MissionTimeout".to_string()][..]));
    assert!(truth.last().unwrap().depth_m < 1.0);
    let at_timeout_m = truth[600 * 4].depth_m;
    assert!(
        summary.max_depth_m < at_timeout_m + 5.0,
        "it turns at once: {at_timeout_m:.1} to {:.1} m",
        summary.max_depth_m
    );
}

#[test]
fn where_it_comes_up_is_dead_reckoned() {
    let (summary, _) = fly_mission(3, |_| {});
    let (predicted, actual) = (summary.surfacing.predicted.unwrap(), summary.surfacing.actual.unwrap());
    let miss_m = (predicted.north_m - actual.north_m).hypot(predicted.east_m - actual.east_m);
    let made_good_m = actual.north_m.hypot(actual.east_m);
    // Compass error of 1° and tilt error of 0.5° together make 2 %.
    assert!(miss_m < 0.04 * made_good_m, "{miss_m:.0} m off after {made_good_m:.0} m");
}
