//! Guidance in the loop: waypoints in still and in moving water, a waypoint out of reach, a mooring, a drift.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use shared::{
    autopilot::Autopilot,
    commands::{Aim, Phase},
    mission::Course,
    model::table::TrimTable,
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, Outcome, Summary, fly, mission_file::MissionFile},
    model::{ocean::Ocean, plant::euler_from_quaternion, vehicle::Vehicle},
};

/// One tick as the truth has it.
#[derive(Clone, Copy)]
struct Truth {
    phase: Phase,
    yo: u16,
    aim: Aim,
    place_m: [f64; 2],
    depth_m: f64,
    sink_m_s: f64,
    heading_deg: f64,
    has_fix: bool,
}

fn fly_mission(name: &str, current_m_s: [f64; 2], change: impl FnOnce(&mut MissionFile)) -> (Summary, Vec<Truth>) {
    let asked = MissionFile::load(name).unwrap();
    let vehicle = Vehicle::load(&asked.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut file = asked.resolve(&table).unwrap();
    change(&mut file);
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let mut truth: Vec<Truth> = Vec::new();
    let mut depth_before_m = None;
    let ocean = Ocean::still(&vehicle.water).carried_along(current_m_s);
    let summary = fly(&flying, &ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
        let depth_m = tick.state.position_m.z;
        truth.push(Truth {
            phase: tick.commands.phase,
            yo: tick.commands.yo,
            aim: tick.commands.aim,
            place_m: [tick.state.position_m.x, tick.state.position_m.y],
            depth_m,
            sink_m_s: 4.0 * (depth_m - depth_before_m.replace(depth_m).unwrap_or(depth_m)),
            heading_deg: euler_from_quaternion(&tick.state.quaternion).z.to_degrees(),
            has_fix: tick.measurements.gps.is_some(),
        });
    });
    (summary.unwrap(), truth)
}

fn distance_m([north_m, east_m]: [f64; 2], [to_north_m, to_east_m]: [f64; 2]) -> f64 {
    (to_north_m - north_m).hypot(to_east_m - east_m)
}

/// Where the last tick of an aim found the vehicle.
fn left_at(truth: &[Truth], aim: Aim) -> [f64; 2] {
    truth.iter().rfind(|t| t.aim == aim).expect("it was aimed at").place_m
}

/// Radius of the mission, and what dead reckoning is off since the last fix: 4 % of the 900 m of a yo, rounded up.
const CAPTURED_M: f64 = 200.0 + 50.0;

#[test]
fn waypoints_are_reached_in_their_order_in_still_and_in_moving_water() {
    for current_m_s in [[0.0, 0.0], [0.0, 0.2]] {
        let (summary, truth) = fly_mission("waypoints", current_m_s, |_| {});
        assert_eq!(summary.outcome, Outcome::Completed, "{current_m_s:?}: {:?}", summary.aborts);
        let mut aims: Vec<Aim> = truth.iter().skip_while(|t| t.aim == Aim::Heading).map(|t| t.aim).collect();
        aims.dedup();
        assert_eq!(aims, [1, 2, 3].map(Aim::Waypoint), "{current_m_s:?}");
        for (number, place_m) in (1..).zip([[2_000.0, 0.0], [2_000.0, 1_500.0]]) {
            let off_m = distance_m(left_at(&truth, Aim::Waypoint(number)), place_m);
            assert!(off_m < CAPTURED_M, "{current_m_s:?}: waypoint {number} left {off_m:.0} m off");
        }
        let least_m = truth.iter().map(|t| distance_m(t.place_m, [0.0, 0.0])).skip(4 * 7_200).fold(f64::MAX, f64::min);
        assert!(least_m < CAPTURED_M, "{current_m_s:?}: home passed {least_m:.0} m off");
    }
}

/// What the water does is learned from one surfacing to the next: the first dive is carried off, later ones are not.
#[test]
fn across_a_known_current_the_track_stays_on_the_line() {
    let waypoint_m = [6_000.0, 0.0];
    let (summary, truth) = fly_mission("waypoints", [0.0, 0.2], |file| {
        let Course::Waypoints(route) = &mut file.mission.course else { panic!("a route") };
        route.places.truncate(1);
        route.places[0].lat_e7 = 590_000_000 + (waypoint_m[0] / 111_194.93 * 1e7) as i32;
        route.leg_time_s = 0;
    });
    assert_eq!(summary.outcome, Outcome::Completed);
    let last_yo = truth.last().unwrap().yo;
    assert!(last_yo >= 4, "long enough to learn and to show it: {last_yo} yos");
    let off_line_m = |yo: u16| {
        let dive: Vec<_> = truth.iter().filter(|t| t.yo == yo && t.phase != Phase::Surface).collect();
        let from_m = dive[0].place_m;
        let line_m = [waypoint_m[0] - from_m[0], waypoint_m[1] - from_m[1]];
        let length_m = line_m[0].hypot(line_m[1]);
        let off_m = |t: &&Truth| {
            let to_m = [t.place_m[0] - from_m[0], t.place_m[1] - from_m[1]];
            (to_m[1] * line_m[0] - to_m[0] * line_m[1]).abs() / length_m
        };
        dive.iter().take_while(|t| t.phase != Phase::Surfacing).map(off_m).fold(0.0, f64::max)
    };
    assert!(off_line_m(1) > 150.0, "0.2 m/s for 20 min, less what the compass does: {:.0} m", off_line_m(1));
    for yo in 3..last_yo {
        assert!(off_line_m(yo) < 60.0, "yo {yo} is {:.0} m off its line", off_line_m(yo));
    }
}

#[test]
fn a_waypoint_up_a_current_too_strong_is_given_up_for_the_next_one() {
    let (summary, truth) = fly_mission("waypoints", [-0.9, 0.0], |file| {
        let Course::Waypoints(route) = &mut file.mission.course else { panic!("a route") };
        route.places.truncate(2);
        route.places[1].lat_e7 = 590_000_000 - (5_000.0 / 111_194.93 * 1e7) as i32;
        route.places[1].lon_e7 = 50_000_000;
    });
    assert_eq!(summary.outcome, Outcome::Completed);
    let mut aims: Vec<Aim> = truth.iter().skip_while(|t| t.aim == Aim::Heading).map(|t| t.aim).collect();
    aims.dedup();
    let [first, unstemmed, second] = [Aim::Waypoint(1), Aim::UnstemmedWaypoint(1), Aim::Waypoint(2)];
    assert_eq!(aims, [first, unstemmed, second], "seen at the first surfacing, given up there or at the next");
    let given_up = truth.iter().rfind(|t| t.aim == unstemmed).unwrap();
    assert!(given_up.yo <= 2, "in yo {}", given_up.yo);
    let least_m = truth.iter().map(|t| distance_m(t.place_m, [-5_000.0, 0.0])).fold(f64::MAX, f64::min);
    assert!(least_m < CAPTURED_M, "the next one passed {least_m:.0} m off");
}

#[test]
fn a_mooring_spirals_at_its_turn_rate_and_goes_nowhere() {
    let (summary, truth) = fly_mission("mooring", [0.0, 0.0], |_| {});
    assert_eq!(summary.outcome, Outcome::Completed);
    for (yo, phase) in [(1, Phase::Dive), (2, Phase::Climb), (5, Phase::Dive)] {
        let glide: Vec<_> = truth.iter().filter(|t| (t.yo, t.phase) == (yo, phase)).collect();
        // Two minutes for the turn to set in.
        let steady = &glide[480..];
        let turned = |pair: &[&Truth]| (pair[1].heading_deg - pair[0].heading_deg + 180.0).rem_euclid(360.0) - 180.0;
        let mean_deg_s = 4.0 * steady.windows(2).map(turned).sum::<f64>() / (steady.len() - 1) as f64;
        // The table interpolates turn rates within 2 %, and the servo leaves 0.25° of the rotation, 1 % here.
        assert!((mean_deg_s - 0.3).abs() < 0.03 * 0.3, "yo {yo} {phase:?}: {mean_deg_s:.3} °/s");
    }
    let farthest_m = truth.iter().map(|t| distance_m(t.place_m, [0.0, 0.0])).fold(0.0, f64::max);
    assert!(farthest_m < 400.0, "{farthest_m:.0} m from the station");
}

#[test]
fn a_mooring_holds_its_station_in_a_current() {
    let (summary, truth) = fly_mission("mooring", [0.1, 0.1], |_| {});
    assert_eq!(summary.outcome, Outcome::Completed);
    assert!(truth.iter().any(|t| t.aim == Aim::Station), "it goes back");
    let farthest_m = truth.iter().map(|t| distance_m(t.place_m, [0.0, 0.0])).fold(0.0, f64::max);
    let carried_m = 0.1_f64.hypot(0.1) * summary.duration_s;
    assert!(farthest_m < 0.6 * carried_m, "{farthest_m:.0} m from the station, adrift it would be {carried_m:.0} m");
}

#[test]
fn a_drift_holds_its_depth_for_its_time() {
    let (summary, truth) = fly_mission("drift", [0.0, 0.1], |_| {});
    assert_eq!(summary.outcome, Outcome::Completed);
    let drift: Vec<_> = truth.iter().filter(|t| t.phase == Phase::Drift).collect();
    assert_eq!(drift.len(), 3_600 * 4);
    // Two minutes to come to rest; then the drive's deadband of 2 ml lets the depth wander by a metre or two.
    let off_m = drift[480..].iter().map(|t| (t.depth_m - 150.0).abs()).fold(0.0, f64::max);
    assert!(off_m < 3.0, "{off_m:.1} m off its depth");
}

#[test]
fn a_flare_comes_up_slower() {
    let fastest_m_s = |flare_depth_mm: i32| {
        let (summary, truth) = fly_mission("drift", [0.0, 0.0], |file| {
            file.mission.drift_time_s = 0;
            file.mission.flare_depth_mm = flare_depth_mm;
        });
        assert_eq!(summary.outcome, Outcome::Completed);
        let arriving = truth.iter().filter(|t| t.phase == Phase::Surfacing && t.depth_m < 2.0);
        arriving.map(|t| -t.sink_m_s).fold(0.0, f64::max)
    };
    let (flared_m_s, plain_m_s) = (fastest_m_s(4_000), fastest_m_s(0));
    assert!(flared_m_s < 0.9 * plain_m_s, "{flared_m_s:.3} m/s with a flare, {plain_m_s:.3} without");
}

#[test]
fn every_surfacing_waits_for_its_fix() {
    let (summary, truth) = fly_mission("mooring", [0.0, 0.0], |file| file.mission.surface_time_s = 0);
    assert_eq!(summary.outcome, Outcome::Completed);
    assert_eq!(truth.last().unwrap().yo, 8, "four surfacings of two yos");
    let dives = (1..truth.len()).filter(|i| (truth[i - 1].phase, truth[*i].phase) == (Phase::Surface, Phase::Dive));
    let fixes = dives.map(|i| {
        let stay = truth[..i].iter().rev().take_while(|t| t.phase == Phase::Surface).count();
        truth[i - stay..=i].iter().filter(|t| t.has_fix).count()
    });
    let fixes: Vec<_> = fixes.collect();
    assert_eq!(fixes.len(), 4, "dives from the surface");
    assert!(fixes.iter().all(|count| *count > 0), "fixes at each: {fixes:?}");
}
