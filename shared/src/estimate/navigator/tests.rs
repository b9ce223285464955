//! Depth and its rate, dead reckoning, fixes.

use super::*;
use crate::model::compass::AxialField;
use crate::model::table::{TrimTable, tests::file};

fn at(pressure_pa: i32, heading_cdeg: u16) -> Measurements {
    Measurements {
        pressure_pa: Some(pressure_pa),
        attitude: Some(Attitude {
            roll_cdeg: 0,
            pitch_cdeg: -3_378,
            heading_cdeg,
            pitch_rate_cdeg_s: 0,
            yaw_rate_cdeg_s: 0,
        }),
        vbd_ul: -212_900,
        ..Measurements::silent()
    }
}

#[test]
fn the_depth_rate_of_a_steady_dive_is_found() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    for tick in 0..400 {
        let depth_m = 0.3 * 0.25 * tick as f32;
        navigator.update(table.vehicle(), tick, &at((depth_m * 9_810.0) as i32, 0), false);
    }
    assert!((navigator.depth_rate_m_s - 0.3).abs() < 1e-3);
    assert!((navigator.depth_m - 0.3 * 0.25 * 399.0).abs() < 1e-2);
}

/// Diving at the polar's 0.44 m/s when pressure falls silent, then light and nose up: the model follows both.
#[test]
fn without_pressure_the_model_keeps_track_of_depth() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    let sink_m_s = 0.77 * 35_f32.to_radians().sin();
    let depth_at = |tick: u32| sink_m_s * TICK_S * tick as f32;
    for tick in 0..800 {
        navigator.update(table.vehicle(), tick, &at((depth_at(tick) * 9_810.0) as i32, 0), false);
    }
    let silent = Measurements { pressure_pa: None, ..at(0, 0) };
    for tick in 800..1_200 {
        navigator.update(table.vehicle(), tick, &silent, false);
    }
    assert!(
        (navigator.depth_m - depth_at(1_199)).abs() < 0.5,
        "{} m, {} m in truth",
        navigator.depth_m,
        depth_at(1_199)
    );
    let mut rising = Measurements { vbd_ul: 212_900, ..silent };
    rising.attitude.as_mut().unwrap().pitch_cdeg = 3_378;
    for tick in 1_200..3_000 {
        navigator.update(table.vehicle(), tick, &rising, false);
    }
    assert_eq!(navigator.depth_m, 0.0, "at the surface, and not above it");
}

#[test]
fn dead_reckoning_goes_where_the_nose_points_at_the_polars_speed() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    for tick in 0..4_000 {
        let depth_m = 0.77 * 35_f32.to_radians().sin() * TICK_S * tick as f32;
        navigator.update(table.vehicle(), tick, &at((depth_m * 9_810.0) as i32, 9_000), false);
    }
    let (north_mm, east_mm) = navigator.position_mm();
    // 0.77 m/s at −35° for 1000 s is 630.7 m; getting up to speed costs some metres.
    assert!((615_000..631_500).contains(&east_mm), "{east_mm}");
    assert!(north_mm.abs() < 100, "{north_mm}");
}

/// A vehicle with a fifth more drag than its file says sinks slower by √1.2, and goes that much less far.
#[test]
fn a_depth_rate_that_the_model_does_not_give_slows_dead_reckoning() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    let speed_m_s = 0.77 / 1.2_f32.sqrt();
    let mut fouled = |from: u32, to: u32| {
        for tick in from..to {
            let depth_m = speed_m_s * 35_f32.to_radians().sin() * TICK_S * tick as f32;
            navigator.update(table.vehicle(), tick, &at((depth_m * 9_810.0) as i32, 9_000), false);
        }
        navigator.position_mm().1
    };
    let (early_mm, late_mm) = (fouled(0, 2_000), fouled(2_000, 4_000));
    let expected_mm = speed_m_s * 35_f32.to_radians().cos() * 500.0 * 1e3;
    assert!(((late_mm - early_mm) as f32 / expected_mm - 1.0).abs() < 0.005, "{} mm", late_mm - early_mm);
}

#[test]
fn the_water_of_the_mission_makes_depth_of_pressure() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    for (water_density_kg_m3, depth_m) in [(0, 100.0), (1_025, 97.561)] {
        let mut navigator = Navigator::new(&Parameters { water_density_kg_m3, ..Parameters::default() });
        navigator.update(table.vehicle(), 0, &at(981_000, 0), false);
        assert!((navigator.depth_m - depth_m).abs() < 1e-3, "{} m", navigator.depth_m);
    }
}

/// On north a field of half the Earth's to the right turns the compass to the left by atan ½.
#[test]
fn the_vehicles_table_corrects_what_is_steered_and_what_is_reckoned_by() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut vehicle = table.vehicle().clone();
    vehicle.compass.axial.push(AxialField { r_px_um: 0, field: [0, 5_000, 0] }).unwrap();
    let mut navigator = Navigator::default();
    for tick in 0..4_000 {
        navigator.update(&vehicle, tick, &at(0, 33_343), false);
    }
    let (north_mm, east_mm) = navigator.position_mm();
    // The reading is rounded, and so is the correction.
    assert!(math::wrap_cdeg(navigator.heading_cdeg()).abs() <= 1, "{}", navigator.heading_cdeg());
    assert!(north_mm > 100_000 && east_mm.abs() < north_mm / 1_000, "{north_mm} mm north, {east_mm} mm east");
}

/// An hour's dive to the east in a current: the fix after it teaches the current, and the next dive reckons with it.
#[test]
fn the_fix_after_a_dive_teaches_the_current() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    let fix = |lat_e7| Measurements { gps: Some(GpsFix { lat_e7, lon_e7: 0 }), ..Measurements::silent() };
    navigator.update(table.vehicle(), 0, &fix(0), true);
    let level = Measurements { vbd_ul: 0, pressure_pa: None, ..at(0, 9_000) };
    for tick in 1..4 * 3_600 {
        navigator.update(table.vehicle(), tick, &level, false);
    }
    // 0.1 m/s for an hour is 360 m, 1e-7° of latitude 1.1 cm.
    navigator.update(table.vehicle(), 4 * 3_600, &fix(32_375), true);
    let current_m_s = navigator.drift().current_m_s();
    assert!((current_m_s.x - 0.1).abs() < 0.001, "{current_m_s}");
    let before_mm = navigator.position_mm().0;
    for tick in 1..=4_000 {
        navigator.update(table.vehicle(), 4 * 3_600 + tick, &level, false);
    }
    let drifted_mm = navigator.position_mm().0 - before_mm;
    assert!((99_000..101_000).contains(&drifted_mm), "{drifted_mm} mm in 1000 s");
}

#[test]
fn the_first_fix_is_the_origin_and_later_ones_are_metres_from_it() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let mut navigator = Navigator::default();
    let fix = |lat_e7, lon_e7| Measurements { gps: Some(GpsFix { lat_e7, lon_e7 }), ..at(0, 0) };
    navigator.update(table.vehicle(), 0, &fix(600_000_000, 1_799_999_000), true);
    assert!(navigator.has_position());
    assert_eq!(navigator.position_mm(), (0, 0));
    navigator.update(table.vehicle(), 1, &fix(600_010_000, -1_799_999_000), true);
    let (north_mm, east_mm) = navigator.position_mm();
    assert!((north_mm - 111_195).abs() <= 1, "{north_mm}");
    assert!((east_mm - 11_119).abs() <= 1, "{east_mm}, across the date line at 60° north");
}

/// Light and nose up in 50 m: rising as the polar says, hanging, sinking; and the same while pressure is silent.
#[test]
fn a_vehicle_that_hangs_or_sinks_though_light_goes_against_the_model() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let rise_m_s = 0.77 * 35_f32.to_radians().sin();
    for (made_good_m_s, against) in [(rise_m_s, false), (0.5 * rise_m_s, false), (0.0, true), (-0.1, true)] {
        let mut navigator = Navigator::default();
        let mut light = Measurements { vbd_ul: 212_900, ..at(0, 0) };
        light.attitude.as_mut().unwrap().pitch_cdeg = 3_378;
        for tick in 0..400 {
            let depth_m = 60.0 - made_good_m_s * TICK_S * tick as f32;
            light.pressure_pa = Some((depth_m * 9_810.0) as i32);
            navigator.update(table.vehicle(), tick, &light, false);
        }
        assert_eq!(navigator.goes_against_model(399), Some(against), "{made_good_m_s} m/s of {rise_m_s}");
        assert_eq!(navigator.goes_against_model(400), None, "no fresh depth");
    }
}
