//! An external check: the spiral that Zhang et al. (2013) publish for another vehicle, with another model's conventions.

use sim_host::{
    analysis::{
        helix::{Helix, HelixSolver, Slope, Turn},
        trim::{Condition, Scale, glide},
    },
    model::vehicle::Vehicle,
};

const NET_MASS_KG: f64 = 0.3;
const MU_DEG: f64 = 45.0;
const R_PX_M: f64 = 0.4216;

/// The helix with the mass at the published place, found by a secant over pitch.
fn published_place(vehicle: &Vehicle) -> Helix {
    let level = glide(vehicle, Condition::PathAngle((-36.9_f64).to_radians()), Scale::NetMass(NET_MASS_KG)).unwrap();
    let solver = HelixSolver::new(vehicle);
    let turned = (1..=MU_DEG as i32).fold(Helix::from(&level), |helix, degrees| {
        solver.solve(&helix, Slope::Pitch(level.pitch_rad), Turn::Mu(f64::from(degrees).to_radians())).unwrap()
    });
    let at_pitch =
        |pitch_rad: f64, near: &Helix| solver.solve(near, Slope::Pitch(pitch_rad), Turn::Mu(near.mu_rad)).unwrap();
    let mut before = turned;
    let mut now = at_pitch(turned.pitch_rad + 0.01, &turned);
    for _ in 0..20 {
        let moved = now.r_px_m - before.r_px_m;
        if moved.abs() < 1e-12 {
            break;
        }
        let next = at_pitch(now.pitch_rad - (now.r_px_m - R_PX_M) * (now.pitch_rad - before.pitch_rad) / moved, &now);
        (before, now) = (now, next);
    }
    assert!((now.r_px_m - R_PX_M).abs() < 1e-9);
    now
}

/// Two per cent: the published values are rounded, and the drag there is K_D α², here K C_L² with a small C_L0.
#[test]
fn the_published_spiral_is_held_within_two_per_cent() {
    let vehicle = Vehicle::load("seawing").unwrap();
    let helix = published_place(&vehicle);
    let degrees = f64::to_degrees;
    for (name, ours, published) in [
        ("alpha", degrees(helix.alpha_rad), 1.267),
        ("beta", degrees(helix.beta_rad), -1.283),
        ("theta", degrees(helix.pitch_rad), -35.641),
        ("phi", degrees(helix.roll_rad), -13.703),
        ("speed", helix.speed_m_s, 0.490),
        ("turn rate", helix.turn_rate_rad_s, 0.0039),
    ] {
        assert!((ours / published - 1.0).abs() < 0.02, "{name}: {ours:.5}, published {published}");
    }
}

/// The coefficients are Graver's K's: ½ρS = 1 kg/m.
#[test]
fn the_reference_quantities_make_the_coefficients_k_values() {
    let vehicle = Vehicle::load("seawing").unwrap();
    assert!((0.5 * vehicle.water.density_kg_m3 * vehicle.hydrodynamics.area_m2 - 1.0).abs() < 1e-12);
}
