//! Every reason to abort, in closed loop: something goes wrong, the controller says so, and the vehicle is back at the surface.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use std::sync::LazyLock;

use shared::{
    autopilot::Autopilot,
    commands::{Abort, Phase},
    model::table::TrimTable,
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, Outcome, Summary, faults_file::FaultsFile, fly, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
};

static SLOCUM: LazyLock<Vehicle> = LazyLock::new(|| Vehicle::load("slocum-paper").unwrap());
static TABLE: LazyLock<Vec<u8>> = LazyLock::new(|| generate(&SLOCUM, &Envelope::default()).unwrap());

/// How a flight went on.
struct Flown {
    summary: Summary,
    /// When the mission ended early, s after the start.
    aborted_s: Option<f64>,
    /// Depth at the end, m.
    depth_m: f64,
}

/// Flies the default mission in still water with some faults, given as a file, and some changes.
fn fly_with(faults: &str, change: impl FnOnce(&mut MissionFile)) -> Flown {
    let mut file = MissionFile::load("default").unwrap();
    change(&mut file);
    let table = TrimTable::parse(&TABLE).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let faults = FaultsFile::from_toml(faults, "faults").unwrap_or_else(|error| panic!("{error}"));
    let flying = faults.on(FlyingVehicle::new(&SLOCUM).unwrap());
    let (mut aborted_s, mut depth_m) = (None, 0.0);
    let summary =
        fly(&flying, &Ocean::still(&SLOCUM.water), &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
            depth_m = tick.state.position_m.z;
            if tick.commands.phase == Phase::Recovery {
                aborted_s.get_or_insert(f64::from(tick.tick) * 0.25);
            }
        })
        .unwrap();
    Flown { summary, aborted_s, depth_m }
}

type Change = fn(&mut MissionFile);

/// What goes wrong, with the mission changed so that it matters; what the controller makes of it, and between which times, s.
const ROWS: [(&str, Change, Abort, [f64; 2]); 9] = [
    // 2 ml, which take the detector below 2 V, at some 0.7 of the rate at 1 MPa: half a minute, and ten samples.
    ("[leak]\nrate_m3_s = 1e-7\nfrom_s = 300\n", |_| {}, Abort::Leak, [310.0, 340.0]),
    // A hull with 10 l of air dives with 25 kPa of vacuum: the 11.5 kPa to the limit are 1.1 l of gas.
    ("[gas]\nrate_m3_s = 5e-6\nfrom_s = 300\n", |_| {}, Abort::Vacuum, [400.0, 600.0]),
    // The pump's 660 W at 200 m are more than 15 V give through 0.1 Ω; it starts at the first apogee.
    ("[battery]\nresistance_ohm = 0.1\n", |_| {}, Abort::Undervolts, [600.0, 900.0]),
    // 600 W at 13.7 V are 44 A, so 18,000 of 20,000 C are gone in 410 s.
    (
        "[drain]\npower_w = 600\nfrom_s = 300\n",
        |file| file.parameters.battery_capacity_c = 20_000,
        Abort::LowCharge,
        [650.0, 750.0],
    ),
    // The mission starts after a minute; a quarter of an hour without motion is up 900 s later.
    ("[stuck]\nbuoyancy = [[0, 1e9]]\n", |_| {}, Abort::NoVerticalMotion, [960.0, 1_000.0]),
    ("[dropouts]\npressure = [[400, 1e9]]\n", |_| {}, Abort::StaleDepth, [460.0, 461.0]),
    ("[dropouts]\nattitude = [[400, 1e9]]\n", |_| {}, Abort::StaleAttitude, [520.0, 521.0]),
    // The pump sticks at the apogee for five minutes: nearly level, the vehicle goes on down past 215 m.
    ("[stuck]\nbuoyancy = [[690, 990]]\n", |_| {}, Abort::Overdepth, [720.0, 990.0]),
    ("", |file| file.mission.max_duration_s = 600, Abort::MissionTimeout, [600.0, 601.0]),
];

#[test]
fn each_fault_is_noticed_in_time_and_the_vehicle_comes_back() {
    for (faults, change, abort, [earliest_s, latest_s]) in ROWS {
        let flown = fly_with(faults, change);
        let summary = &flown.summary;
        println!("{abort:?} after {:?} s, home after {} s", flown.aborted_s, summary.duration_s);
        assert_eq!((summary.outcome, &summary.aborts), (Outcome::Aborted, &vec![format!("{abort:?}")]), "{faults}");
        let aborted_s = flown.aborted_s.unwrap();
        assert!((earliest_s..=latest_s).contains(&aborted_s), "{abort:?} after {aborted_s} s");
        assert!(flown.depth_m < 1.0, "{abort:?}: back at the surface, not {} m deep", flown.depth_m);
    }
}

/// Heavier than its file by more than the climb's net mass, it dives well, and hangs at depth when it should climb.
#[test]
fn a_vehicle_too_heavy_to_climb_is_noticed_by_the_reduced_model_and_comes_back() {
    const HEAVY_KG: f64 = 0.255;
    let file = MissionFile::load("default").unwrap();
    let table = TrimTable::parse(&TABLE).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let (mass_kg, density_kg_m3) = (SLOCUM.mass_kg(), SLOCUM.water.density_kg_m3);
    let ocean = Ocean::still(&SLOCUM.water).with_ballast_density(density_kg_m3 * mass_kg / (mass_kg - HEAVY_KG));
    let flying = FlyingVehicle::new(&SLOCUM).unwrap();
    let (mut climb_s, mut aborted_s, mut depth_m) = (None, None, 0.0);
    let summary = fly(&flying, &ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
        depth_m = tick.state.position_m.z;
        let time_s = f64::from(tick.tick) * 0.25;
        match tick.commands.phase {
            Phase::Climb => climb_s = climb_s.or(Some(time_s)),
            Phase::Recovery => aborted_s = aborted_s.or(Some(time_s)),
            _ => {}
        }
    })
    .unwrap();
    assert_eq!((summary.outcome, summary.aborts), (Outcome::Aborted, vec!["AgainstModel".to_string()]));
    let noticed_s = aborted_s.unwrap() - climb_s.unwrap();
    // A minute against the model, once the way of the dive is lost: long before a vehicle counts as at rest, after 900 s.
    assert!((60.0..300.0).contains(&noticed_s), "{noticed_s} s after the climb began");
    assert!(depth_m < 1.0, "{depth_m} m deep at the end");
}

/// Glitches, gaps and noise that a sound vehicle lives with.
#[test]
fn nuisances_end_no_mission() {
    for faults in [
        "[sensors.housekeeping]\nleak_glitches_per_h = 500\n",
        "[dropouts]\nleak = [[0, 1e9]]\nvacuum = [[0, 1e9]]\nvoltage = [[0, 1e9]]\ncharge = [[0, 1e9]]\nmodem = [[0, 1e9]]\n",
        "[dropouts]\npressure = [[400, 455]]\nattitude = [[900, 1000]]\n",
        "[gas]\nrate_m3_s = 1e-7\n",
    ] {
        let flown = fly_with(faults, |_| {});
        assert_eq!((flown.summary.outcome, flown.aborted_s), (Outcome::Completed, None), "{faults}");
    }
}
