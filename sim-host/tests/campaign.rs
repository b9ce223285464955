//! Campaigns: the same flights whatever the number of threads, a fair opponent, and bad input in one line.

use std::{fs, num::NonZero, path::Path, process::Command};

use shared::{autopilot::Autopilot, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{
        Outcome,
        baseline::{Baseline, Turn, TurnSense},
        mission_file::MissionFile,
    },
    model::{ocean::Ocean, vehicle::Vehicle},
    studies::campaign::{self, Campaign, Drawn, FACTORS, Flown, Flyer, METRICS, Water},
};

/// slocum-paper turns right with the mass to the right on dives and to the left on climbs.
const SENSE: TurnSense = TurnSense { dive: Turn::Left, climb: Turn::Right };

fn fly(water: &str, seeds: u64, threads: usize, sense: TurnSense, current_m_s: f64) -> Vec<Flown> {
    fly_mission("default", water, seeds, threads, sense, current_m_s)
}

fn fly_mission(
    mission: &str,
    water: &str,
    seeds: u64,
    threads: usize,
    sense: TurnSense,
    current_m_s: f64,
) -> Vec<Flown> {
    let file = MissionFile::load(mission).unwrap();
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let pilots = vec![
        Flyer::Autopilot(Box::new(Autopilot::new(&table, &file.mission, &file.parameters).unwrap())),
        Flyer::Baseline(Box::new(Baseline::new(table.vehicle(), &file.mission, &file.parameters, sense))),
    ];
    let ocean = Ocean::load(water, &vehicle.water).unwrap();
    let waters = [Water { name: water.into(), ocean, pilots }];
    let campaign = Campaign { vehicle: &vehicle, file: &file, waters: &waters, seeds, current_m_s };
    campaign::run(&campaign, NonZero::new(threads).unwrap(), |_| {}).unwrap()
}

fn value(flown: &Flown, name: &str) -> f64 {
    flown.value(name).unwrap()
}

fn of<'a>(flown: &'a [Flown], pilot: &'a str) -> impl Iterator<Item = &'a Flown> {
    flown.iter().filter(move |flight| flight.pilot == pilot)
}

#[test]
fn the_same_seeds_give_the_same_file_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let csv = |threads: usize| {
        let path = folder.path().join(format!("{threads}.csv"));
        campaign::write_csv(&path, &[("default", &fly("temperate", 3, threads, SENSE, 0.2))]).unwrap();
        fs::read_to_string(path).unwrap()
    };
    let (one, three) = (csv(1), csv(3));
    assert_eq!(one, three);
    assert_eq!(one.lines().count(), 1 + 2 * 3);
}

#[test]
fn a_seed_draws_the_same_vehicle_again_within_what_is_known_of_it() {
    let nominal = Vehicle::load("slocum-paper").unwrap();
    for seed in 1..=200 {
        let drawn = Drawn::new(seed, 0.2);
        assert_eq!(drawn, Drawn::new(seed, 0.2));
        for (factor, by) in FACTORS.iter().zip(drawn.factors) {
            let damps = ["_p", "_q", "_r"].iter().any(|rate| factor.name.ends_with(rate));
            assert!((by - 1.0).abs() <= if damps { 0.20 } else { 0.10 }, "{} × {by}", factor.name);
        }
        assert!(drawn.ballast_kg.abs() <= 0.03);
        let [north, east] = drawn.current_m_s;
        assert!((north.hypot(east) - 0.2).abs() < 1e-12);
        let hydrodynamics = drawn.vehicle(&nominal).hydrodynamics;
        assert_eq!(hydrodynamics.c_d_zero, nominal.hydrodynamics.c_d_zero * drawn.factors[0]);
    }
    assert_ne!(Drawn::new(1, 0.0), Drawn::new(2, 0.0));
}

/// The vehicle is neutral half-way between surface and target depth, but for the grams that were drawn.
#[test]
fn a_hull_that_gives_way_is_ballasted_for_the_middle_of_its_dive() {
    let vehicle = Vehicle::load("slocum-deep").unwrap();
    let ocean = Ocean::load("calm", &vehicle.water).unwrap();
    let elasticity = vehicle.buoyancy.as_ref().unwrap().elasticity;
    for seed in 1..=20 {
        let drawn = Drawn::new(seed, 0.0);
        let ballasted = drawn.ocean(&ocean, &vehicle, 1_000.0);
        let displaced_m3 = vehicle.mass_kg() / ballasted.ballast_density_kg_m3(1_000.0);
        let net_mass_kg = |depth_m: f64| {
            let water = ballasted.sample(&[0.0, 0.0, depth_m].into(), 0.0).around;
            let warmth_c = water.temperature_c.unwrap() - elasticity.reference_temperature_c;
            let strain =
                elasticity.thermal_expansion_per_c * warmth_c - elasticity.compressibility_per_pa * water.pressure_pa;
            vehicle.mass_kg() - water.density_kg_m3 * displaced_m3 * (1.0 + strain)
        };
        let middle_kg = 0.5 * (net_mass_kg(0.0) + net_mass_kg(1_000.0));
        // Mean of products against product of means: half the changes of density and volume, (2.3e-3)(2.5e-3) of 50 kg.
        assert!((middle_kg - drawn.ballast_kg).abs() < 4e-4, "seed {seed}: {middle_kg} kg, {} drawn", drawn.ballast_kg);
    }
}

/// A fair opponent: it flies what the autopilot flies, and comes back.
#[test]
fn the_baseline_flies_the_default_mission_well() {
    let flown = fly("still", 8, 2, SENSE, 0.0);
    for flight in of(&flown, "baseline") {
        assert_eq!(flight.outcome, Outcome::Completed, "seed {}: {}", flight.seed, flight.reason);
        let worst_percent = value(flight, "apogee_over_percent").max(value(flight, "apogee_under_percent"));
        assert!(worst_percent < 2.5, "seed {}: apogee {worst_percent:.1} % off", flight.seed);
        // The compass alone deviates by 2° rms: three of that, and the deadband of 1.5° twice.
        assert!(value(flight, "heading_rms_deg") < 9.0, "seed {}", flight.seed);
        // A minute to move the mass by 0.38 m at 10 mm/s and settle.
        assert!(value(flight, "pitch_settling_s") < 120.0, "seed {}", flight.seed);
    }
}

/// Currents that shear turn the vehicle a little all the time: who answers each error moves the mass ever again. Energy is
/// the scarce thing, so a controller that knows its vehicle must beat fixed gains, and hold the heading that its compass shows.
#[test]
fn the_autopilot_moves_the_mass_less_often_than_the_baseline_and_holds_its_heading() {
    for (mission, water) in [("slow-50", "temperate"), ("slow-200", "tropical"), ("fast-50", "temperate")] {
        let flown = fly_mission(mission, water, 12, 2, SENSE, 0.0);
        let mean = |pilot, name| of(&flown, pilot).map(|flight| value(flight, name)).sum::<f64>() / 12.0;
        let [ours, theirs] = ["autopilot", "baseline"].map(|pilot| mean(pilot, "roll_moves_per_km"));
        assert!(ours < theirs, "{mission}, {water}: {ours} and {theirs} moves per km");
        let compass_rms_deg = mean("autopilot", "compass_rms_deg");
        assert!(compass_rms_deg < 3.0, "{mission}, {water}: {compass_rms_deg}° rms");
    }
}

#[test]
fn told_the_wrong_sense_of_turn_the_baseline_cannot_hold_its_heading() {
    let flown = fly("still", 1, 1, TurnSense { dive: Turn::Right, climb: Turn::Left }, 0.0);
    let rms = |pilot| value(of(&flown, pilot).next().unwrap(), "heading_rms_deg");
    assert!(rms("baseline") > 45.0 && rms("autopilot") < 9.0, "{}° and {}°", rms("baseline"), rms("autopilot"));
}

/// A steady current changes nothing under water, and carries the vehicle off by its speed times the time under way.
#[test]
fn an_unknown_current_shows_in_where_it_comes_up() {
    let (still, carried) = (fly("still", 2, 2, SENSE, 0.0), fly("still", 2, 2, SENSE, 0.2));
    for (a, b) in still.iter().zip(&carried) {
        assert_eq!(value(a, "heading_rms_deg"), value(b, "heading_rms_deg"));
        assert!(value(b, "surfacing_error_percent") > value(a, "surfacing_error_percent") + 10.0);
    }
}

fn refusal(arguments: &[&str], out: &Path) -> String {
    let mut glider = Command::new(env!("CARGO_BIN_EXE_glider"));
    let output = glider.arg("campaign").args(arguments).arg("--out").arg(out).output().unwrap();
    assert!(!output.status.success() && output.stdout.is_empty() && !out.exists());
    let text = String::from_utf8(output.stderr).unwrap();
    let line = text.strip_suffix('\n').unwrap();
    assert!(!line.contains('\n'), "one line, not: {text}");
    line.to_string()
}

#[test]
fn bad_input_is_one_line_and_nothing_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let refusal = |arguments: &[&str]| refusal(arguments, &folder.path().join("out"));
    assert_eq!(refusal(&["--current", "-1"]), "error: --current -1: a speed from 0 to 3 m/s");
    assert!(refusal(&["--current", "NaN"]).ends_with("a speed from 0 to 3 m/s"));
    assert_eq!(
        refusal(&["slow-1000", "--environment", "temperate"]),
        "error: temperate: the sea floor lies at 800 m, and the mission dives to 1000 m"
    );
    assert!(refusal(&["--environment", "stil"]).contains("nor an embedded one (`still`"));
    assert!(refusal(&["slow-1000", "--vehicle", "slocum-paper"]).contains("`mission.dive_to_m` is 1000"));
}

#[test]
fn a_folder_with_every_flight_and_a_page_that_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("campaign");
    let output = Command::new(env!("CARGO_BIN_EXE_glider"))
        .args(["campaign", "fast-50", "--seeds", "3", "--environment", "still", "--environment", "temperate", "--json"])
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let parties = answer["results"].as_array().unwrap();
    assert_eq!(parties.len(), 4);
    for party in parties {
        assert_eq!((party["flights"].as_u64(), party["completed"].as_u64()), (Some(3), Some(3)), "{party}");
        for metric in METRICS {
            let spread = |name: &str| party["spreads"][metric.name][name].as_f64().unwrap();
            assert!(spread("p10") <= spread("median") && spread("median") <= spread("p90"), "{}", metric.name);
            assert!(spread("p90") <= spread("worst"), "{}", metric.name);
        }
    }
    assert_eq!(fs::read_to_string(out.join("campaign.csv")).unwrap().lines().count(), 1 + 12);
    let page = fs::read_to_string(out.join("campaign.html")).unwrap();
    for load in ["<script", "<link", "<img", "src=", "href=", "url(", "@import", "NaN"] {
        assert!(!page.contains(load), "`{load}`");
    }
}
