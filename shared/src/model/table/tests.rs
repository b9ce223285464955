//! A made-up vehicle's table: written, read, looked up, refused.

use super::*;
use crate::model::compass::Compass;
use crate::model::{
    reduced::tests::SLOCUM,
    vehicle::{Actuators, MotorPower},
};
use std::vec::Vec;

fn vehicle() -> FlightVehicle {
    FlightVehicle {
        hash: 42,
        name: "test".try_into().unwrap(),
        density_kg_m3: 1000.0,
        gravity_m_s2: 9.81,
        actuators: Actuators {
            r_px_um: Range { min: -350_000, max: 350_000 },
            mu_cdeg: Range { min: -6_000, max: 6_000 },
            vbd_ul: Range { min: -300_000, max: 300_000 },
            r_px_rate_um_s: 10_000,
            mu_rate_cdeg_s: 1_500,
            pump_rate_ul_s: 42_000,
            bleed_rate_ul_s: 42_000,
        },
        power: MotorPower { r_px_mw: 3_000, mu_mw: 2_000, pump_mw: 700_000, bleed_mw: 0, peak_mw: None },
        working_depth_mm: 200_000,
        glide: SLOCUM,
        critical_heading_gain: [[[9.0; 2]; 2]; 2],
        compass: Compass::default(),
    }
}

/// A made-up vehicle that turns right with `mu` < 0 on dives and `mu` > 0 on climbs, like the paper's.
pub(crate) fn file() -> Vec<u8> {
    file_of(true)
}

/// Its nodes are linear in path angle and `mu`; left and right mirror each other, stored once or twice.
fn file_of(symmetric: bool) -> Vec<u8> {
    let grid = |low: f32, high: f32| Grid {
        root_path_angle: Axis { first: low.sqrt(), last: high.sqrt(), count: 32 },
        fourth_root_net_mass: Axis { first: 0.04_f32.powf(0.25), last: 0.64_f32.powf(0.25), count: 2 },
        mu_rad: Axis { first: if symmetric { 0.0 } else { -1.1 }, last: 1.1, count: 3 },
        full_scale: [0.0; QUANTITIES],
    };
    let (dive, climb) = (grid(0.2, 0.6), grid(0.2, 0.7));
    let nodes = |grid: &Grid, sign: f32| {
        let mut nodes = Vec::new();
        for i in 0..grid.root_path_angle.count {
            for _ in 0..grid.fourth_root_net_mass.count {
                for k in 0..grid.mu_rad.count {
                    nodes.push(node(sign * grid.root_path_angle.at(i).powi(2), grid.mu_rad.at(k)));
                }
            }
        }
        nodes
    };
    let mut bytes = std::vec![0; 8192];
    let header = Header::new(vehicle(), symmetric, dive, climb);
    let used = write(&header, &nodes(&dive, -1.0), &nodes(&climb, 1.0), &mut bytes).unwrap().len();
    bytes.truncate(used);
    bytes
}

fn node(path_angle_rad: f32, mu_rad: f32) -> Node {
    let side = path_angle_rad.signum();
    Node {
        r_px_m: -0.42 * path_angle_rad,
        speed_factor: 1.0 + 0.8 * math::abs(path_angle_rad),
        alpha_rad: -0.03 * side,
        incidence_rad: -0.03 * side,
        roll_rad: 0.2 * mu_rad * side,
        turn_factor: 0.03 * side,
        turn_bias: 0.0,
    }
}

/// A cell is 1/31 of √0.7 − √0.2 wide: over it x² is a quarter of that squared, 4e-5, off a straight line at most; the rest is
/// quantisation.
#[test]
fn a_written_table_reads_back_whether_one_side_is_stored_or_both() {
    for symmetric in [true, false] {
        let file = file_of(symmetric);
        let table = TrimTable::parse(&file).unwrap();
        for (gamma, mass, mu) in
            [(-0.45_f32, 0.25_f32, 0.3_f32), (-0.2, 0.6, -0.8), (0.33, -0.1, 0.5), (0.6, -0.3, -1.0)]
        {
            let glide = table.look_up(gamma, mass, mu);
            let exact = node(gamma, mu);
            let root = mass.abs().sqrt();
            assert!((glide.r_px_m - exact.r_px_m).abs() < 4e-5);
            assert!((glide.speed_m_s - exact.speed_factor * root).abs() < 1e-4);
            assert!((glide.pitch_rad - gamma - exact.incidence_rad).abs() < 1e-6);
            assert!((glide.roll_rad - exact.roll_rad).abs() < 1e-5);
            assert!((glide.turn_rate_rad_s - exact.turn_factor * root * mu.sin()).abs() < 1e-6);
            assert!(!glide.saturated);
        }
    }
}

#[test]
fn outside_the_envelope_it_saturates_and_says_so() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let beyond = table.look_up(-1.2, 0.25, 0.0);
    assert!(beyond.saturated);
    assert_eq!(beyond.r_px_m, table.look_up(-0.6, 0.25, 0.0).r_px_m);
    for (gamma, mass, mu) in [(-0.1, 0.25, 0.0), (0.0, 0.25, 0.0), (0.4, 0.01, 0.0), (0.4, 0.0, 0.0), (0.4, 1.0, 0.0)] {
        assert!(table.look_up(gamma, mass, mu).saturated, "{gamma} rad, {mass} kg");
    }
    for mu in [-1.5, 1.5, f32::NAN] {
        assert!(table.look_up(-0.4, 0.25, mu).saturated, "{mu} rad");
    }
}

#[test]
fn the_rotation_for_a_turn_gives_that_turn_with_the_vehicles_own_sense() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    for gamma in [-0.4, 0.4] {
        let mu = table.mu_for_turn(gamma, 0.25, 0.005, 0.0, 1.0);
        assert!((table.look_up(gamma, 0.25, mu).turn_rate_rad_s - 0.005).abs() < 1e-6);
        assert_eq!(mu > 0.0, gamma > 0.0);
    }
    assert!((table.mu_for_turn(-0.4, 0.25, 1.0, 0.0, 0.7) + 0.7).abs() < 1e-5, "held to the limit");
    let widest = table.mu_for_turn(-0.4, 0.25, 1.0, 0.0, 1.5);
    assert!((widest + 1.1).abs() < 1e-5, "held to what the table covers");
}

#[test]
fn damaged_truncated_foreign_and_older_tables_are_refused() {
    let good = file();
    for place in 4..good.len() {
        let mut bad = good.clone();
        bad[place] ^= 0x20;
        assert_eq!(TrimTable::parse(&bad).unwrap_err(), TableError::Corrupt, "byte {place}");
    }
    assert_eq!(TrimTable::parse(&good[..good.len() - 12]).unwrap_err(), TableError::Corrupt);
    assert_eq!(TrimTable::parse(b"hello, table").unwrap_err(), TableError::NotATable);
    let table = TrimTable::parse(&good).unwrap();
    assert_eq!(table.for_vehicle(7).unwrap_err(), TableError::OtherVehicle(42));
}

#[test]
fn the_envelope_is_told_in_device_units() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    assert_eq!(table.dive_envelope().net_mass_g, Range { min: 40, max: 640 });
    assert_eq!(table.climb_envelope().net_mass_g, Range { min: -640, max: -40 });
    assert_eq!(table.dive_envelope().path_angle_cdeg, Range { min: -3_437, max: -1_146 });
}
