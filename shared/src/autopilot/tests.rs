//! The controller as a whole: when it dives, when it gives up, and what nonsense cannot make it do.

use super::*;
use crate::device::{Attitude, GpsFix, TICK_HZ};
use crate::model::table::tests::file;
use heapless::Vec;

fn mission() -> Mission {
    Mission {
        yos: 1,
        surfacings: 1,
        dive_to_mm: 100_000,
        climb_to_mm: 5_000,
        dive_path_angle_cdeg: -2_600,
        climb_path_angle_cdeg: 2_600,
        dive_net_mass_g: 250,
        climb_net_mass_g: -250,
        course: Course::Headings(Vec::from_slice(&[9_000]).unwrap()),
        drift_time_s: 0,
        flare_depth_mm: 0,
        surface_time_s: 1,
        altitude_mm: 0,
        abort_depth_mm: 110_000,
        max_duration_s: 3_600,
    }
}

fn well(depth_m: i32, vbd_ul: i32) -> Measurements {
    Measurements {
        pressure_pa: Some(depth_m.saturating_mul(9_810)),
        attitude: Some(Attitude {
            roll_cdeg: 0,
            pitch_cdeg: -2_600,
            heading_cdeg: 9_000,
            pitch_rate_cdeg_s: 0,
            yaw_rate_cdeg_s: 0,
        }),
        vbd_ul,
        battery_mv: Some(15_000),
        charge_mc: Some(0),
        leak_mv: Some(2_500),
        vacuum_pa: Some(27_000),
        gps: Some(GpsFix { lat_e7: 590_000_000, lon_e7: 50_000_000 }),
        ..Measurements::silent()
    }
}

fn with_autopilot(test: impl FnOnce(&mut Autopilot<'_>)) {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    test(&mut Autopilot::new(&table, &mission(), &Parameters::default()).unwrap());
}

#[test]
fn it_dives_only_with_depth_attitude_and_position() {
    let complete = well(0, 300_000);
    for lacking in [
        Measurements { pressure_pa: None, ..complete },
        Measurements { attitude: None, ..complete },
        Measurements { gps: None, ..complete },
    ] {
        with_autopilot(|autopilot| {
            let last = (0..40).map(|tick| autopilot.step(tick, &lacking)).last().unwrap();
            assert_eq!((last.phase, last.abort), (Phase::Surface, None), "{lacking:?}");
        });
    }
    with_autopilot(|autopilot| {
        let phases: std::vec::Vec<Phase> = (0..6).map(|tick| autopilot.step(tick, &complete).phase).collect();
        assert_eq!(phases.iter().position(|phase| *phase == Phase::Dive), Some(4), "after one second at the surface");
    });
}

#[test]
fn without_fresh_depth_it_ends_the_dive_and_pumps() {
    with_autopilot(|autopilot| {
        for tick in 0..100 {
            autopilot.step(tick, &well(0, 300_000));
        }
        let blind = Measurements { pressure_pa: None, gps: None, ..well(0, -250_000) };
        let limit_ticks = Parameters::default().stale_depth_s.unsigned_abs() * TICK_HZ;
        let before = (100..100 + limit_ticks).map(|tick| autopilot.step(tick, &blind)).last().unwrap();
        assert_eq!((before.phase, before.abort), (Phase::Dive, None));
        let after = autopilot.step(100 + limit_ticks, &blind);
        assert_eq!((after.phase, after.abort), (Phase::Recovery, Some(Abort::StaleDepth)));
        assert_eq!(after.vbd_rate_ul_s, 42_000);
    });
}

/// Dives at 0.2 m/s towards a floor at 60 m; the altimeter says what `echo` makes of the true height, mm.
/// The height at which it turns, mm, if it does within 300 s.
fn turns_at_mm(altitude_mm: i32, echo: impl Fn(u32, i32) -> Option<i32>) -> Option<i32> {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mission = Mission { altitude_mm, ..mission() };
    let mut autopilot = Autopilot::new(&table, &mission, &Parameters::default()).unwrap();
    for tick in 0..20 {
        autopilot.step(tick, &well(0, 300_000));
    }
    (20_u32..).zip((0..60_000_i32).step_by(50)).find_map(|(tick, depth_mm)| {
        let height_mm = 60_000_i32.saturating_sub(depth_mm);
        let measurements = Measurements {
            pressure_pa: Some((depth_mm as f32 * 9.81) as i32),
            altitude_mm: echo(tick, height_mm),
            ..well(0, -250_000)
        };
        (autopilot.step(tick, &measurements).phase == Phase::Apogee).then_some(height_mm)
    })
}

#[test]
fn the_floor_ends_a_dive_where_asked_and_with_the_way_that_the_reversal_takes() {
    // 0.2 m/s for two thirds of the 6 s to neutral at 42 ml/s, and some 4 s of coasting while the nose comes up: 1.6 m; and
    // 0.15 m until the third echo.
    let turn_mm = turns_at_mm(15_000, |_, height_mm| Some(height_mm)).unwrap();
    assert!((16_300..=16_800).contains(&turn_mm), "{turn_mm} mm above the floor");
    assert_eq!(turns_at_mm(0, |_, height_mm| Some(height_mm)), None, "off");
    assert_eq!(turns_at_mm(15_000, |_, _| None), None, "without an echo it goes on to its depth");
    let dropping_out = turns_at_mm(15_000, |tick, height_mm| tick.is_multiple_of(3).then_some(height_mm)).unwrap();
    assert!((turn_mm - 500..turn_mm).contains(&dropping_out), "three echoes later all the same: {dropping_out} mm");
}

#[test]
fn two_false_echoes_in_a_row_end_no_dive() {
    let false_echoes = |tick: u32, _| Some(if tick.is_multiple_of(3) { 90_000 } else { 500 });
    assert_eq!(turns_at_mm(15_000, false_echoes), None);
}

/// Whatever the instruments say, rates stay within the drives', nothing overflows (tests check for it) and nothing panics.
#[test]
fn nonsense_from_the_instruments_never_gets_past_the_limits() {
    let mut seed = 1_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 32) as u32
    };
    with_autopilot(|autopilot| {
        for tick in 0..200_000_u32 {
            let extreme = |bits: u32| match bits % 5 {
                0 => i32::MAX,
                1 => i32::MIN,
                2 => 0,
                _ => bits.rotate_left(7).cast_signed(),
            };
            let small = |bits: u32| extreme(bits) as i16;
            let measurements = Measurements {
                pressure_pa: (random() % 3 > 0).then(|| extreme(random())),
                attitude: (random() % 3 > 0).then(|| Attitude {
                    roll_cdeg: small(random()),
                    pitch_cdeg: small(random()),
                    heading_cdeg: random() as u16,
                    pitch_rate_cdeg_s: small(random()),
                    yaw_rate_cdeg_s: small(random()),
                }),
                r_px_um: extreme(random()),
                mu_cdeg: small(random()),
                vbd_ul: extreme(random()),
                battery_mv: (random() % 3 > 0).then(|| random() as u16),
                charge_mc: (random() % 3 > 0).then(|| i64::from(extreme(random())) * i64::from(extreme(random()))),
                altitude_mm: (random() % 3 > 0).then(|| extreme(random())),
                leak_mv: (random() % 3 > 0).then(|| random() as u16),
                vacuum_pa: (random() % 3 > 0).then(|| extreme(random())),
                gps: (random() % 9 == 0).then(|| GpsFix { lat_e7: extreme(random()), lon_e7: extreme(random()) }),
                modem_up: random() % 2 == 0,
            };
            let commands = autopilot.step(tick.wrapping_mul(random() % 2), &measurements);
            assert!(commands.r_px_rate_um_s.abs() <= 10_000, "{commands:?}");
            assert!(commands.mu_rate_cdeg_s.abs() <= 1_500, "{commands:?}");
            assert!(commands.vbd_rate_ul_s.abs() <= 42_000, "{commands:?}");
            assert!(commands.target_heading_cdeg < 36_000);
        }
    });
}

#[test]
fn what_cannot_be_flown_is_refused() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let deep = Mission { dive_to_mm: 250_000, ..mission() };
    let unflyable = Unflyable { field: "dive_to_mm", value: 250_000, min: 1_000, max: 200_000 };
    let refused = Autopilot::new(&table, &deep, &Parameters::default()).unwrap_err();
    assert_eq!(refused, ConfigurationError::Mission(unflyable));
    let mistuned = Parameters { heading_period_s: 0, ..Parameters::default() };
    let refused = Autopilot::new(&table, &mission(), &mistuned).unwrap_err();
    assert!(matches!(refused, ConfigurationError::Parameter(row, 0) if row.name == "heading_period_s"));
}

/// Dives, drifts and climbs as the depth has it; the phases one after another, and the last commands.
fn phases_of(mission: &Mission, depths_m: &[(usize, i32, i32)]) -> (std::vec::Vec<Phase>, Commands) {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut autopilot = Autopilot::new(&table, mission, &Parameters::default()).unwrap();
    let (mut clock, mut phases, mut last) = (0.., std::vec::Vec::new(), Commands::safe());
    for (ticks, depth_m, vbd_ul) in depths_m {
        for tick in clock.by_ref().take(*ticks) {
            last = autopilot.step(tick, &well(*depth_m, *vbd_ul));
            phases.push(last.phase);
        }
    }
    phases.dedup();
    (phases, last)
}

#[test]
fn a_drift_is_neither_stuck_nor_adrift_for_ever_and_each_surfacing_but_the_last_dives_again() {
    use Phase::{Apogee, Climb, Complete, Dive, Drift, Surface, Surfacing};
    let mission = Mission { surfacings: 2, drift_time_s: 2_000, max_duration_s: 7_200, ..mission() };
    // Longer at one depth than a glide may be; depth is let settle at the surface after each climb.
    let dive = [(200, 50, -250_000), (8_400, 100, 0), (200, 60, 250_000), (300, 2, 250_000), (600, 0, 300_000)];
    let flown = [&[(40, 0, 300_000)][..], &dive[..], &dive[..]].concat();
    let (phases, last) = phases_of(&mission, &flown);
    let once = [Surface, Dive, Drift, Apogee, Climb, Surfacing];
    assert_eq!(phases, [&once[..], &once[..], &[Complete]].concat());
    assert_eq!((last.yo, last.abort), (2, None));
}

#[test]
fn a_drift_can_be_aborted() {
    let mission = Mission { drift_time_s: 2_000, max_duration_s: 2_000, ..mission() };
    let (phases, last) = phases_of(&mission, &[(40, 0, 300_000), (200, 50, -250_000), (8_400, 100, 0)]);
    assert_eq!(phases, [Phase::Surface, Phase::Dive, Phase::Drift, Phase::Recovery]);
    assert_eq!(last.abort, Some(Abort::MissionTimeout));
    assert_eq!(last.vbd_rate_ul_s, 42_000, "it pumps");
}
