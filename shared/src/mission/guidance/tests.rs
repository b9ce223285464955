//! Courses over ground of a vehicle that does exactly as it is told.

use std::vec::Vec;

use super::*;
use crate::device::{GpsFix, Measurements, TICK_S};
use crate::model::table::{TrimTable, tests::file};

const SPEED_M_S: f32 = 0.4;
/// 1e-7° of latitude per metre, and of longitude on the equator.
const E7_PER_M: f32 = 89.932_04;
/// Half a yo, s.
const HALF_YO_S: u32 = 500;

fn place(north_m: f32, east_m: f32) -> GpsFix {
    GpsFix { lat_e7: (north_m * E7_PER_M).round() as i32, lon_e7: (east_m * E7_PER_M).round() as i32 }
}

fn route(places: &[(f32, f32)]) -> Route {
    Route {
        places: places.iter().map(|(north_m, east_m)| place(*north_m, *east_m)).collect(),
        capture_radius_mm: 50_000,
        leg_time_s: 0,
    }
}

fn mission(course: Course) -> Mission {
    Mission {
        yos: 1,
        surfacings: 1_000,
        dive_to_mm: 100_000,
        climb_to_mm: 5_000,
        dive_path_angle_cdeg: -2_600,
        climb_path_angle_cdeg: 2_600,
        dive_net_mass_g: 250,
        climb_net_mass_g: -250,
        course,
        drift_time_s: 0,
        flare_depth_mm: 0,
        surface_time_s: 0,
        altitude_mm: 0,
        abort_depth_mm: 110_000,
        max_duration_s: 100_000,
    }
}

/// Where the vehicle was and what it aimed at, once per tick, over some yos in a current that it knows from its fixes.
fn track(mission: &Mission, current_m_s: (f32, f32), yos: u32) -> Vec<((f32, f32), Aim)> {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let (mut navigator, mut guide, mut executive) = (Navigator::default(), Guide::default(), Executive::new());
    let mut here = (0.0_f32, 0.0_f32);
    let mut seen = Vec::new();
    for tick in 0..yos.saturating_mul(2 * HALF_YO_S * TICK_HZ) {
        let into = tick % (2 * HALF_YO_S * TICK_HZ);
        let phase = if into < HALF_YO_S * TICK_HZ { Phase::Dive } else { Phase::Climb };
        if executive.phase != phase {
            let before = if phase == Phase::Dive { Phase::Surface } else { Phase::Apogee };
            executive = Executive { phase, yo: executive.yo.saturating_add(1), since_tick: tick, before };
        }
        let fix = Measurements { gps: Some(place(here.0, here.1)), ..Measurements::silent() };
        navigator.update(table.vehicle(), tick, &fix, true);
        let sight = Sight { tick, executive: &executive, navigator: &navigator, current_m_s, speed_m_s: SPEED_M_S };
        guide.update(mission, &sight);
        seen.push((here, guide.aim));
        if guide.is_over(mission) {
            break;
        }
        let heading_rad = f32::from(guide.heading_cdeg) * RAD_PER_CDEG;
        here.0 += (SPEED_M_S * math::cos(heading_rad) + current_m_s.0) * TICK_S;
        here.1 += (SPEED_M_S * math::sin(heading_rad) + current_m_s.1) * TICK_S;
    }
    seen
}

#[test]
fn a_ferry_angle_keeps_the_way_over_ground_on_the_line() {
    for bearing_deg in (0_u16..360).step_by(15) {
        for (north_m_s, east_m_s) in [(0.0, 0.2), (-0.15, 0.1), (0.3, 0.0)] {
            let bearing_rad = f32::from(bearing_deg).to_radians();
            let to = (300.0 * math::cos(bearing_rad), 300.0 * math::sin(bearing_rad));
            let ferry = Ferry::new(to, SPEED_M_S, (north_m_s, east_m_s));
            let over_ground = (
                SPEED_M_S * math::cos(ferry.heading_rad) + north_m_s,
                SPEED_M_S * math::sin(ferry.heading_rad) + east_m_s,
            );
            let across = (over_ground.1 * to.0 - over_ground.0 * to.1) / 300.0;
            let along = (over_ground.0 * to.0 + over_ground.1 * to.1) / 300.0;
            assert!(ferry.stemmed, "slower than the vehicle");
            assert!(across.abs() < 1e-5 && (along - ferry.made_good_m_s).abs() < 1e-5, "{bearing_deg}°: {ferry:?}");
        }
    }
}

#[test]
fn a_current_that_cannot_be_stemmed_is_told_and_met_head_on() {
    let against = Ferry::new((100.0, 0.0), SPEED_M_S, (-0.5, 0.0));
    assert_eq!((against.heading_rad, against.stemmed), (0.0, false));
    assert!((against.made_good_m_s + 0.1).abs() < 1e-6);
    assert!(!Ferry::new((100.0, 0.0), SPEED_M_S, (0.0, 0.41)).stemmed, "across");
    assert!(Ferry::new((100.0, 0.0), SPEED_M_S, (0.5, 0.0)).stemmed, "astern");
    assert!(Ferry::new((100.0, 100.0), SPEED_M_S, (0.3, 0.5)).stemmed, "mostly astern: 0.14 m/s across");
    let here = Ferry::new((0.0, 0.0), 0.0, (0.0, 0.0));
    assert!(here.heading_rad.is_finite() && !here.stemmed, "no way, no speed: still a number");
}

#[test]
fn waypoints_are_reached_in_their_order_along_straight_lines() {
    let places = [(1_000.0, 0.0), (1_000.0, 800.0), (0.0, 0.0)];
    let mission = mission(Course::Waypoints(route(&places)));
    for current_m_s in [(0.0, 0.0), (0.0, 0.2), (-0.15, -0.15)] {
        let seen = track(&mission, current_m_s, 40);
        let mut leg_from = (0.0, 0.0);
        for (number, to) in (1..).zip(places) {
            let leg: Vec<_> = seen.iter().filter(|(_, aim)| *aim == Aim::Waypoint(number)).map(|(at, _)| *at).collect();
            let (last, line) = (leg.last().unwrap(), (to.0 - leg_from.0, to.1 - leg_from.1));
            assert!((last.0 - to.0).hypot(last.1 - to.1) < 50.2, "waypoint {number} captured from {last:?}");
            let off_m = leg
                .iter()
                .map(|at| ((at.1 - leg_from.1) * line.0 - (at.0 - leg_from.0) * line.1).abs() / line.0.hypot(line.1));
            // Headings are whole hundredths of a degree and positions of fixes centimetres: metres on a kilometre.
            let worst_m = off_m.fold(0.0, f32::max);
            assert!(worst_m < 3.0, "{worst_m} m off the line to waypoint {number} in {current_m_s:?}");
            leg_from = *last;
        }
        assert!(seen.len() < 40 * 2 * 500 * 4, "the route ends");
    }
}

#[test]
fn a_waypoint_up_a_stronger_current_is_given_up_at_the_second_surfacing_and_the_next_one_flown() {
    let mission = mission(Course::Waypoints(route(&[(2_000.0, 0.0), (-2_000.0, 0.0)])));
    let seen = track(&mission, (-0.5, 0.0), 40);
    let leg = |wanted: Aim| seen.iter().filter(|(_, aim)| *aim == wanted).count() as u32 / TICK_HZ;
    assert_eq!(leg(Aim::Waypoint(1)), 0);
    assert_eq!(leg(Aim::UnstemmedWaypoint(1)), 2 * HALF_YO_S, "one yo, from surfacing to surfacing");
    let (end, _) = seen.last().unwrap();
    assert!((end.0 + 2_000.0).abs() < 51.0, "reached: {end:?}");
}

#[test]
fn a_waypoint_is_given_up_when_its_time_is_over() {
    let course = Course::Waypoints(Route { leg_time_s: 700, ..route(&[(20_000.0, 0.0), (0.0, 20_000.0)]) });
    let seen = track(&mission(course), (0.0, 0.0), 4);
    for number in [1, 2] {
        let ticks = seen.iter().filter(|(_, aim)| *aim == Aim::Waypoint(number)).count();
        assert!(ticks.abs_diff(700 * 4) <= 1, "waypoint {number}: {ticks} ticks");
    }
    assert_eq!(seen.len(), 2 * 700 * 4 + 1, "and then there is nothing left to go to");
}

/// A spiral goes nowhere through the water, so that a mooring is as far off as the current takes it in half a yo.
#[test]
fn a_mooring_spirals_near_its_station_and_goes_back_from_afar() {
    let mooring = |station| Course::Spiral(Mooring { turn_rate_cdeg_s: 50, station, radius_mm: 200_000 });
    let near = track(&mission(mooring(place(100.0, 0.0))), (0.0, 0.0), 1);
    assert!(near.iter().all(|(_, aim)| *aim == Aim::Spiral));
    let far = track(&mission(mooring(place(700.0, 0.0))), (0.0, 0.0), 3);
    let back = far.iter().position(|(_, aim)| *aim == Aim::Spiral).unwrap();
    assert!(far[..back].iter().all(|(_, aim)| *aim == Aim::Station));
    assert!((far[back].0.0 - 600.0).abs() < 1.0, "half the radius before the station: {:?}", far[back]);
}
