//! A supply that does not bear pump and drives together: what becomes of a dive with and without a limit on the peak
//! power.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use shared::{
    autopilot::Autopilot,
    device::{MM_PER_M, TICK_S},
    model::table::TrimTable,
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{Cells, FlyingVehicle, Outcome, Summary, fly, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
    studies::campaign::Drawn,
};

/// Rounding of the difference of two sums of energy, W.
const ROUNDING_W: f64 = 1e-6;

/// An embedded vehicle with stronger motors for pitch and roll, W.
fn vehicle(name: &str, [pitch_motor_w, roll_motor_w]: [f64; 2], peak_power_w: Option<f64>) -> Vehicle {
    let mut vehicle = Vehicle::load(name).unwrap();
    let energy = vehicle.energy.as_mut().unwrap();
    (energy.pitch_motor_w, energy.roll_motor_w, energy.peak_power_w) = (pitch_motor_w, roll_motor_w, peak_power_w);
    vehicle
}

/// Flies a vehicle that was ballasted for its dive. How that went, and the most that pump and drives drew together in a
/// tick, W.
fn fly_on(cells: Cells, vehicle: &Vehicle, water: &str, mission: &str) -> (Summary, f64) {
    let file = MissionFile::load(mission).unwrap();
    let bytes = generate(vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle { cells, ..FlyingVehicle::new(vehicle).unwrap() };
    let charted = Ocean::load(water, &vehicle.water).unwrap();
    let ocean = Drawn::nominal().ocean(&charted, vehicle, f64::from(file.mission.dive_to_mm) / f64::from(MM_PER_M));
    let (mut before_j, mut peak_w) = (0.0, 0.0_f64);
    let summary = fly(&flying, &ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
        let used_j = tick.energy.pump + tick.energy.pitch + tick.energy.roll;
        peak_w = peak_w.max((used_j - before_j) / f64::from(TICK_S));
        before_j = used_j;
    })
    .unwrap();
    println!("{mission}: {peak_w} W, {summary:?}");
    (summary, peak_w)
}

/// At 10 V, below which a mission ends, the old battery gives 10 V · 5 V / 1 Ω = 50 W. The pump takes 36 W at 1000 m
/// and everything else 1.5 W: that it bears, but not 15 W for pitch on top.
#[test]
fn a_dive_that_would_abort_for_its_voltage_completes_one_motor_at_a_time() {
    let old = Cells { resistance_ohm: 1.0, ..Cells::default() };
    let deep = |peak_power_w| vehicle("slocum-deep", [15.0, 10.0], peak_power_w);
    let dive = |cells, vehicle| fly_on(cells, &vehicle, "calm", "slow-1000").0;
    let unlimited = dive(old, deep(None));
    assert_eq!((unlimited.outcome, unlimited.aborts), (Outcome::Aborted, vec!["Undervolts".to_owned()]));
    let (sound, limited) = (dive(Cells::default(), deep(None)), dive(old, deep(Some(48.0))));
    assert_eq!((sound.outcome, limited.outcome), (Outcome::Completed, Outcome::Completed));
    let deeper = limited.max_depth_m / sound.max_depth_m - 1.0;
    assert!(deeper.abs() < 0.02, "apogee at {} m, without a limit at {} m", limited.max_depth_m, sound.max_depth_m);
}

/// Every tick of a flight on a fast and on a slow pump. Each of the limits is one that matters: free, the motors exceed
/// it.
#[test]
fn the_motors_never_draw_more_than_the_limit() {
    for (name, drives_w, water, mission, limit_w) in [
        ("slocum-paper", [80.0, 60.0], "still", "default", 725.0),
        ("slocum-deep", [15.0, 10.0], "calm", "slow-1000", 45.0),
    ] {
        let fly_under = |limit_w| fly_on(Cells::default(), &vehicle(name, drives_w, limit_w), water, mission);
        let ((free, free_w), (limited, limited_w)) = (fly_under(None), fly_under(Some(limit_w)));
        assert_eq!((free.outcome, limited.outcome), (Outcome::Completed, Outcome::Completed), "{mission}");
        assert!(free_w > limit_w && limited_w <= limit_w + ROUNDING_W, "{mission}: {limited_w} W, {free_w} W free");
    }
}
