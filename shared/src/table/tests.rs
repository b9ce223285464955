//! A made-up vehicle's table: written, read, looked up, refused.

use super::*;
use crate::vehicle::{Actuators, GlideConstants};
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
        working_depth_mm: 200_000,
        glide: GlideConstants {
            mass_u_kg: 55.0,
            mass_w_kg: 120.0,
            drag_zero: 2.0,
            drag_induced: 45.0 / (135.0 * 135.0),
            lift_zero: 0.0,
            lift_alpha: 135.0,
        },
    }
}

/// A made-up vehicle whose nodes are linear in the axes, so that interpolation must be exact but for quantisation.
/// It turns right with `mu` < 0 on dives and `mu` > 0 on climbs, like the paper's.
pub(crate) fn file() -> Vec<u8> {
    let grid = |low: f32, high: f32| Grid {
        path_angle_rad: Axis { first: low, last: high, count: 5 },
        root_net_mass: Axis { first: 0.2, last: 0.8, count: 3 },
        sin_mu: Axis { first: -0.9, last: 0.9, count: 3 },
        full_scale: [0.0; QUANTITIES],
    };
    let (dive, climb) = (grid(-0.6, -0.2), grid(0.2, 0.7));
    let nodes = |grid: &Grid| {
        let mut nodes = Vec::new();
        for i in 0..grid.path_angle_rad.count {
            for _ in 0..grid.root_net_mass.count {
                for k in 0..grid.sin_mu.count {
                    nodes.push(node(grid.path_angle_rad.at(i), grid.sin_mu.at(k)));
                }
            }
        }
        nodes
    };
    let mut bytes = std::vec![0; 4096];
    let header = Header::new(vehicle(), dive, climb);
    let used = write(&header, &nodes(&dive), &nodes(&climb), &mut bytes).unwrap().len();
    bytes.truncate(used);
    bytes
}

fn node(path_angle_rad: f32, sin_mu: f32) -> Node {
    Node {
        r_px_m: -0.42 * path_angle_rad,
        speed_factor: 1.0 + 0.8 * math::abs(path_angle_rad),
        alpha_rad: -0.03 * path_angle_rad.signum(),
        roll_rad: 0.2 * sin_mu * path_angle_rad.signum(),
        turn_factor: 0.03 * path_angle_rad.signum(),
        turn_bias: 0.0,
    }
}

#[test]
fn a_written_table_reads_back_within_its_quantisation() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    for (gamma, mass, mu) in [(-0.45_f32, 0.25_f32, 0.3_f32), (-0.2, 0.6, -0.8), (0.33, -0.1, 0.5)] {
        let glide = table.look_up(gamma, mass, mu);
        let exact = node(gamma, mu.sin());
        let root = mass.abs().sqrt();
        assert!((glide.r_px_m - exact.r_px_m).abs() < 1e-5);
        assert!((glide.speed_m_s - exact.speed_factor * root).abs() < 5e-5);
        assert!((glide.turn_rate_rad_s - exact.turn_factor * root * mu.sin()).abs() < 1e-6);
        assert!(!glide.saturated);
    }
}

#[test]
fn outside_the_envelope_it_saturates_and_says_so() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let beyond = table.look_up(-1.2, 0.25, 0.0);
    assert!(beyond.saturated);
    assert_eq!(beyond.r_px_m, table.look_up(-0.6, 0.25, 0.0).r_px_m);
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
