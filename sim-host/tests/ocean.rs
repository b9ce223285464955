//! Flights in each of the waters, and the files that describe them.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use std::sync::LazyLock;

use nalgebra::Vector3;
use shared::{
    autopilot::Autopilot,
    commands::{Abort, Phase},
    model::table::TrimTable,
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, Loss, Outcome, Summary, fly, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
};

static SLOCUM: LazyLock<Vehicle> = LazyLock::new(|| Vehicle::load("slocum-paper").unwrap());
static TABLE: LazyLock<Vec<u8>> = LazyLock::new(|| generate(&SLOCUM, &Envelope::default()).unwrap());

/// One tick as the truth has it.
struct Truth {
    yo: u16,
    phase: Phase,
    position_m: Vector3<f64>,
    density_kg_m3: f64,
}

fn fly_in(ocean: &Ocean, seed: u64, change: impl FnOnce(&mut MissionFile)) -> (Summary, Vec<Truth>) {
    let mut file = MissionFile::load("default").unwrap();
    change(&mut file);
    let table = TrimTable::parse(&TABLE).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(&SLOCUM).unwrap();
    let mut truth = Vec::new();
    let summary = fly(&flying, ocean, &file.mission, &file.start, seed, &mut autopilot, &mut |tick| {
        truth.push(Truth {
            yo: tick.commands.yo,
            phase: tick.commands.phase,
            position_m: tick.state.position_m,
            density_kg_m3: tick.water.around.density_kg_m3,
        });
    })
    .unwrap();
    (summary, truth)
}

fn load(name_or_path: &str) -> Ocean {
    Ocean::load(name_or_path, &SLOCUM.water).unwrap()
}

fn parse(text: &str) -> Result<Ocean, String> {
    Ocean::from_toml(text, "e.toml", &SLOCUM.water).map_err(|error| error.to_string())
}

#[test]
fn the_default_mission_completes_in_each_water() {
    for name in ["still", "tropical", "temperate", "polar", "baltic"] {
        for seed in 1..=3 {
            let (summary, _) = fly_in(&load(name), seed, |_| {});
            assert_eq!(summary.outcome, Outcome::Completed, "{name}, seed {seed}: {:?}", summary.aborts);
            // Dived by the vehicle file's 1000 kg/m³: in sea water 2.6 % less deep.
            assert!((192.0..205.0).contains(&summary.max_depth_m), "{name}: {} m", summary.max_depth_m);
        }
    }
}

#[test]
fn without_enough_buoyancy_it_stalls_in_the_halocline_and_is_brought_home() {
    let (summary, truth) = fly_in(&load("baltic"), 1, |file| {
        (file.mission.dive_net_mass_g, file.mission.climb_net_mass_g) = (60, -60);
        file.mission.max_duration_s = 7_200;
    });
    let reasons = [Abort::NoVerticalMotion].map(|abort| format!("{abort:?}"));
    assert_eq!((summary.outcome, summary.aborts.as_slice()), (Outcome::Aborted, &reasons[..]));
    assert!((60.0..120.0).contains(&summary.max_depth_m), "{} m", summary.max_depth_m);
    let aborted = truth.iter().position(|t| t.phase == Phase::Recovery).unwrap();
    let quarter_hour = &truth[aborted - 900 * 4..aborted];
    assert!(quarter_hour.iter().all(|t| t.phase == Phase::Dive), "it still tries to dive");
    // Within the 3 m either way that count as rest: the internal wave moves the layer in which it hangs by 0.7 m.
    let depths = || quarter_hour.iter().map(|t| t.position_m.z);
    assert!(depths().fold(0.0, f64::max) - depths().fold(f64::MAX, f64::min) <= 6.0);
    assert!(truth.last().unwrap().position_m.z < 2.0);
}

#[test]
fn the_same_seed_gives_the_same_bits_in_moving_water() {
    let hash = || fly_in(&load("temperate"), 4, |file| file.mission.yos = 1).0.trace_hash;
    assert_eq!(hash(), hash());
}

/// The controller steers by headings, and feels nothing of a uniform current.
#[test]
fn a_uniform_current_shifts_a_whole_flight() {
    let current = parse("[current]\nprofile = [[0, 0.1, -0.2]]\n").unwrap();
    let [(still, at_rest), (carried, drifting)] = [load("still"), current].map(|ocean| fly_in(&ocean, 1, |_| {}));
    assert_eq!((still.ticks, still.max_depth_m), (carried.ticks, carried.max_depth_m));
    let (from, to) = (at_rest.last().unwrap().position_m, drifting.last().unwrap().position_m);
    // From the launch, a minute before the first tick, to the last tick.
    let time_s = f64::from(still.ticks - 1) * 0.25 + 60.0;
    assert!((to - from - Vector3::new(0.1, -0.2, 0.0) * time_s).amax() < 1e-8);
    let miss = |s: &Summary| s.surfacing.actual.unwrap().east_m - s.surfacing.predicted.unwrap().east_m;
    assert!((miss(&carried) - miss(&still) + 0.2 * 2_700.0).abs() < 60.0, "dead reckoning knows no current");
}

#[test]
fn a_floor_ends_the_dive() {
    let ocean = parse("[floor]\ndepth_m = 100\nslope_deg = 2\ndirection_deg = 180\n").unwrap();
    let (summary, truth) = fly_in(&ocean, 1, |_| {});
    assert_eq!((summary.outcome, summary.loss), (Outcome::Lost, Some(Loss::Grounded)));
    let end = truth.last().unwrap().position_m;
    let floor_m = ocean.floor_depth_m(end.x, end.y).unwrap();
    assert!(floor_m < 100.0 && (end.z - floor_m).abs() < 0.2, "{end} on {floor_m} m");
}

/// The same floor, with the altimeter listened to: the dives turn above it, each as high as asked.
#[test]
fn the_altimeter_keeps_the_vehicle_off_the_floor() {
    let ocean = parse("[floor]\ndepth_m = 100\nslope_deg = 2\ndirection_deg = 180\n").unwrap();
    for seed in 1..=4 {
        let (summary, truth) = fly_in(&ocean, seed, |file| file.mission.altitude_mm = 15_000);
        assert_eq!((summary.outcome, &summary.aborts[..]), (Outcome::Completed, &[][..]));
        for yo in [1, 2] {
            let heights = truth
                .iter()
                .filter(|t| t.yo == yo)
                .map(|t| ocean.floor_depth_m(t.position_m.x, t.position_m.y).unwrap() - t.position_m.z);
            let lowest_m = heights.fold(f64::MAX, f64::min);
            // The reversal takes some ten metres of depth, of which the controller foresees all but a metre or two.
            assert!((12.0..18.0).contains(&lowest_m), "seed {seed}, yo {yo}: {lowest_m} m above the floor");
        }
    }
}

#[test]
fn a_cast_gives_the_density_that_the_vehicle_meets() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cast.csv"), "PRES,TEMP,PSAL\n1,15,34\n50,12,34.5\n300,8,35\n").unwrap();
    let toml = folder.path().join("here.toml");
    std::fs::write(&toml, "[water]\ncast = \"cast.csv\"\nballast_density_kg_m3 = 1026.5\n").unwrap();
    let (named, alone) = (load(toml.to_str().unwrap()), load(folder.path().join("cast.csv").to_str().unwrap()));
    let at = |ocean: &Ocean| ocean.sample(&Vector3::new(0.0, 0.0, 100.0), 0.0);
    assert_eq!(at(&named), at(&alone));
    assert_eq!(named.ballast_density_kg_m3(200.0), 1026.5);
    let (summary, truth) = fly_in(&alone, 1, |file| file.mission.yos = 1);
    assert_eq!(summary.outcome, Outcome::Completed);
    let [least, most] = truth
        .iter()
        .fold([f64::MAX, 0.0], |[least, most], t| [f64::min(least, t.density_kg_m3), f64::max(most, t.density_kg_m3)]);
    // σ₀ of 15 °C at salinity 34 is 25.2; at 195 m some 9.7 °C at 34.8 make 26.8, and pressure adds 0.9.
    assert!((least - 1025.2).abs() < 0.1 && (most - 1027.7).abs() < 0.2, "{least} to {most}");
}

#[test]
fn mistakes_are_answered_with_their_place() {
    let rows = [
        ("[water]\nprofil = []\n", "e.toml:2:1: unknown key `profil`; did you mean `profile`?"),
        (
            "[water]\nprofile = [[0, 10, 35], [0, 9, 35]]\n",
            "e.toml:2:11: `water.profile` is [[0, 10, 35], [0, 9, 35]], but must be rows of [depth in m, rising; \
             temperature in °C, -3 to 40; practical salinity, 0 to 42]",
        ),
        (
            "[current]\nprofile = [[0, 1]]\n",
            "e.toml:2:11: `current.profile` is [[0, 1]], but must be rows of 3 finite numbers",
        ),
        (
            "[swell]\nheight_m = 9\nperiod_s = 5\ndirection_deg = 0\n",
            "e.toml:2:12: `swell.height_m` is 9, but must be less than a seventh of the wavelength of 39.0 m, beyond which \
             waves break",
        ),
        (
            "[internal_wave]\nvertical_velocity_m_s = 0.01\nperiod_s = 900\nwavelength_m = 500\ndirection_deg = 0\n",
            "e.toml:1:1: missing section `floor`: an internal wave fills the water from the surface to it",
        ),
        (
            "[water]\ncast = \"nowhere.csv\"\n",
            "e.toml: `water.cast`: nowhere.csv: No such file or directory (os error 2)",
        ),
    ];
    for (text, expected) in rows {
        assert_eq!(parse(text).unwrap_err(), expected, "{text}");
    }
    let error = Ocean::load("nowhere", &SLOCUM.water).unwrap_err().to_string();
    assert!(
        error.ends_with("nor an embedded one (`still`, `calm`, `tropical`, `temperate`, `polar`, `baltic`)"),
        "{error}"
    );
}
