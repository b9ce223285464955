//! The report of a flight that is known to the last digit.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use nalgebra::Vector3;
use shared::{
    commands::{Aim, Commands, Phase},
    device::{Attitude, Measurements},
};
use sim_host::{
    flight::{
        EnergyUsed, NorthEast, Outcome, Summary, Surfacing,
        mission_file::MissionFile,
        record::{Record, Sample, Truth},
    },
    model::{ocean::Ocean, vehicle::Vehicle},
    pages::report::{
        self, Flight,
        figures::{Leg, Moves, legs, moves, yo_heading_rms_deg},
    },
};

/// Ticks of each phase of the flight.
const PHASE_TICKS: u32 = 400;

/// Surface, dive, apogee, climb, surfacing and surface, 100 s each: down and up at 0.2 m/s, east at 0.5 m/s, and a heading that
/// comes from 20° off its target at 0.4 °/s and stays 3° off.
fn sample(tick: u32) -> Sample {
    let phases = [Phase::Surface, Phase::Dive, Phase::Apogee, Phase::Climb, Phase::Surfacing, Phase::Complete];
    let phase = phases[(tick / PHASE_TICKS) as usize];
    let seconds = f64::from(tick) * 0.25;
    let dived_s = (seconds - 100.0).clamp(0.0, 400.0);
    let depth_m = 0.2 * dived_s.min(200.0) - 0.2 * (dived_s - 200.0).max(0.0);
    let heading_deg = 350.0 + 20.0 - (20.0 - 0.4 * dived_s).max(3.0);
    let pressure_pa = (depth_m * 9_810.0) as i32;
    let cdeg = |degrees: f64| (degrees.rem_euclid(360.0) * 100.0) as u16;
    Sample {
        tick,
        measurements: Measurements {
            pressure_pa: (!tick.is_multiple_of(4)).then_some(pressure_pa),
            attitude: (!tick.is_multiple_of(5)).then_some(Attitude {
                roll_cdeg: 0,
                pitch_cdeg: -2_400,
                heading_cdeg: cdeg(heading_deg),
                pitch_rate_cdeg_s: 0,
                yaw_rate_cdeg_s: 0,
            }),
            r_px_um: 190_000,
            vbd_ul: -250_000,
            ..Measurements::silent()
        },
        commands: Commands {
            r_px_rate_um_s: if tick % 100 < 10 { -10_000 } else { 0 },
            vbd_rate_ul_s: if phase == Phase::Apogee { 42_000 } else { 0 },
            phase,
            yo: u16::from(tick >= PHASE_TICKS),
            target_heading_cdeg: 1_000,
            aim: Aim::Heading,
            ..Commands::safe()
        },
        truth: Truth {
            position_m: Vector3::new(0.0, 0.5 * dived_s, depth_m),
            euler_rad: Vector3::new(0.0, -0.42, heading_deg.to_radians()),
            velocity_m_s: Vector3::new(0.5, 0.0, 0.02),
            ground_velocity_m_s: Vector3::new(0.0, 0.5, 0.2),
            water: Ocean::still(&Vehicle::load("slocum-paper").unwrap().water).sample(&Vector3::zeros(), 0.0),
            floor_depth_m: None,
            rate_rad_s: Vector3::zeros(),
            r_px_m: 0.19,
            mu_rad: 0.0,
            displaced_volume_m3: 0.05,
        },
        energy_j: EnergyUsed { pump: 2.0 * seconds, pitch: 0.2 * seconds, roll: 0.0, hotel: seconds },
        pump_work_j: 0.1 * seconds,
        charge_c: 0.2 * seconds,
    }
}

fn record(ticks: u32) -> Record {
    let start = MissionFile::load("default").unwrap().start;
    let water = Vehicle::load("slocum-paper").unwrap().water;
    Record { start, water, samples: (0..ticks).map(sample).collect() }
}

fn summary(record: &Record) -> Summary {
    Summary {
        outcome: Outcome::Completed,
        loss: None,
        duration_s: 600.0,
        max_depth_m: 40.0,
        ticks: 2_400,
        energy_j: record.samples.last().map_or_else(EnergyUsed::default, |last| last.energy_j),
        pump_work_j: 0.0,
        charge_c: 0.0,
        surfacing: Surfacing {
            predicted: Some(NorthEast { north_m: 3.0, east_m: 204.0 }),
            actual: Some(NorthEast { north_m: 0.0, east_m: 200.0 }),
        },
        aborts: Vec::new(),
        wall_s: 0.01,
        real_time_factor: 60_000.0,
        trace_hash: "0123456789abcdef".repeat(4),
    }
}

fn with_flight<T>(ticks: u32, look: impl FnOnce(&Flight<'_>) -> T) -> T {
    let (record, vehicle) = (record(ticks), Vehicle::load("slocum-paper").unwrap());
    let mission = MissionFile::load("default").unwrap().mission;
    look(&Flight { vehicle: &vehicle, mission: &mission, record: &record, summary: &summary(&record) })
}

#[test]
fn legs_are_measured_from_their_first_to_their_last_tick() {
    let legs = legs(&record(2_400));
    let [dive, climb] = &legs[..] else { panic!("{legs:?}") };
    let near =
        |value: f64, expected: f64| assert!((value - expected).abs() < 2e-3 * expected.abs(), "{value} {expected}");
    assert!(matches!(dive, Leg { yo: 1, climbing: false, .. }) && matches!(climb, Leg { yo: 1, climbing: true, .. }));
    near(dive.duration_s, 199.75);
    near(dive.turning_depth_m, 39.95);
    near(dive.vertical_speed_m_s, 0.2);
    near(climb.vertical_speed_m_s, -0.2);
    near(dive.horizontal_speed_m_s, 0.5);
    near(dive.target_heading_deg, 10.0);
    near(dive.on_heading_after_s.unwrap(), 37.5);
    near(climb.heading_rms_deg.unwrap(), 3.0);
    near(yo_heading_rms_deg(&record(2_400), 1).unwrap(), 3.018);
    assert_eq!(yo_heading_rms_deg(&record(2_400), 2), None);
}

#[test]
fn a_move_is_a_run_from_standstill_to_standstill() {
    let record = record(2_400);
    assert_eq!(moves(&record, |s| s.commands.r_px_rate_um_s), Moves { count: 24, ticks: 240 });
    assert_eq!(moves(&record, |s| s.commands.vbd_rate_ul_s.max(0)), Moves { count: 1, ticks: 400 });
    assert_eq!(moves(&record, |s| s.commands.vbd_rate_ul_s.min(0)), Moves::default());
}

#[test]
fn the_report_tells_the_dive_and_needs_nothing_else() {
    let page = with_flight(2_400, report::html);
    let words = ["completed", "10 min 00 s", "40.0 m", "200 m", "5.0 m", "1.9 kJ", "pump 1.20 kJ", "0123456789abcdef"];
    for words in
        words.into_iter().chain(["Depth", "Pitch", "Heading", "Roll", "Speed", "Angle of attack", "From above"])
    {
        assert!(page.contains(words), "`{words}` is missing");
    }
    for load in ["<script", "<link", "<img", "src=", "href=", "url(", "@import"] {
        assert!(!page.contains(load), "`{load}` loads something");
    }
}

/// What still water without a floor has nothing of is not drawn.
#[test]
fn surroundings_are_drawn_where_there_is_something_to_see() {
    let drawn = |change: &dyn Fn(&mut Sample)| {
        let mut record = record(2_400);
        record.samples.iter_mut().for_each(change);
        let (vehicle, mission) =
            (Vehicle::load("slocum-paper").unwrap(), MissionFile::load("default").unwrap().mission);
        let summary = summary(&record);
        let page = report::html(&Flight { vehicle: &vehicle, mission: &mission, record: &record, summary: &summary });
        ["Altitude", "Water density", "Current"].map(|title| page.contains(&format!("<b>{title}</b>")))
    };
    assert_eq!(drawn(&|_| {}), [false, false, false]);
    assert_eq!(drawn(&|s| s.truth.floor_depth_m = Some(60.0)), [true, false, false]);
    assert_eq!(drawn(&|s| s.truth.water.around.density_kg_m3 += s.truth.position_m.z), [false, true, false]);
    assert_eq!(drawn(&|s| s.truth.water.around.current_m_s.y = -0.1), [false, false, true]);
}

#[test]
fn every_number_of_report_and_picture_is_finite_however_short_the_flight() {
    for ticks in [0, 1, 2, PHASE_TICKS, 2_400] {
        for text in [with_flight(ticks, report::html), with_flight(ticks, report::picture)] {
            assert!(!text.contains("NaN") && !text.contains("inf%") && !text.contains("inf "), "{ticks} ticks");
        }
    }
}

#[test]
fn the_picture_keeps_its_text_as_text() {
    let picture = with_flight(2_400, report::picture);
    for words in ["slocum-paper: 10 min 00 s, 40 m deep, 1.9 kJ", "Depth, m", "dead-reckoned"] {
        assert!(picture.contains(words), "`{words}` is missing");
    }
}
