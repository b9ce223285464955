//! Large angles: with `[crossflow]` the flow separates, without it the linear law holds at every angle.

mod common;

use common::random_states;
use nalgebra::Vector3;
use sim_host::model::{
    plant::{Particle, Plant, State, rk4_step},
    vehicle::Vehicle,
};

const DENSITY_KG_M3: f64 = 1000.0;

fn with_crossflow() -> Vehicle {
    let text = include_str!("../vehicles/slocum-paper.toml");
    let section = "[crossflow]\ndrag_coefficient = 1.1\nstall_deg = 15\nseparated_deg = 40\n\n[water]";
    Vehicle::from_toml(&text.replace("[water]", section), "with-crossflow.toml").unwrap()
}

fn at_incidence(degrees: f64, around: f64) -> Vector3<f64> {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vector3::new(cos, sin * around.sin(), sin * around.cos()) * 0.7
}

#[test]
fn below_the_stall_nothing_changes_and_above_it_the_change_is_smooth() {
    let (linear, blended) =
        (Plant::<f64>::new(&Vehicle::load("slocum-paper").unwrap()), Plant::<f64>::new(&with_crossflow()));
    let rate = Vector3::new(0.1, -0.2, 0.05);
    let force =
        |plant: &Plant<f64>, degrees: f64| plant.viscous(&at_incidence(degrees, 0.3), &rate, DENSITY_KG_M3).force_n;
    for degrees in [0.0, 5.0, 14.9] {
        assert_eq!(force(&linear, degrees), force(&blended, degrees));
    }
    // Twice the step, twice the change: no jump at either end of the blend.
    for edge in [15.0, 40.0] {
        let jump = |half: f64| (force(&blended, edge + half) - force(&blended, edge - half)).norm();
        assert!((jump(2e-4) / jump(1e-4) - 2.0).abs() < 0.01, "at {edge}°");
    }
}

/// A cylinder and a wing in a flow across them: ½ρ c_dc A w².
#[test]
fn straight_across_it_is_the_drag_of_the_plan_view() {
    let vehicle = with_crossflow();
    let crossflow = vehicle.crossflow.clone().unwrap();
    let plant = Plant::<f64>::new(&vehicle);
    let drag_n = 0.5 * DENSITY_KG_M3 * 1.1 * crossflow.plan_area_m2 * 0.3 * 0.3;
    let force = plant.viscous(&Vector3::new(0.0, 0.0, 0.3), &Vector3::zeros(), DENSITY_KG_M3).force_n;
    assert!((force - Vector3::new(0.0, 0.0, -drag_n)).norm() < 1e-12);
    // Hull 1.5 m × 0.2143 m, and the wing's 0.1169 m × 1.0714 m outside it.
    assert!((crossflow.plan_area_m2 - 0.4467).abs() < 1e-4, "{}", crossflow.plan_area_m2);
}

/// Separated flow never gives energy, whatever the motion; the linear law can.
#[test]
fn separated_flow_only_takes_energy_away() {
    let plant = Plant::<f64>::new(&with_crossflow());
    for (state, _) in random_states(&plant, 300) {
        for degrees in [40.0, 90.0, 135.0, 180.0] {
            let velocity = at_incidence(degrees, state.mu_rad);
            let viscous = plant.viscous(&velocity, &state.rate_rad_s, DENSITY_KG_M3);
            let power_w = viscous.force_n.dot(&velocity) + viscous.moment_nm.dot(&state.rate_rad_s);
            assert!(power_w < 0.0, "{degrees}°: {power_w} W");
        }
    }
}

/// Dropped flat, the hull turns into the flow and settles into a steady descent.
#[test]
fn a_flat_drop_ends_in_a_glide() {
    let vehicle = with_crossflow();
    let plant = Plant::<f64>::new(&vehicle);
    let mut state = State { r_px_m: 0.19, ..State::at_rest(plant.displaced_volume_m3(0.25)) };
    let water = plant.still();
    for _ in 0..4_000 {
        state = rk4_step(&plant, &state, &Particle::Driven { u_b_m3_s: 0.0 }, 0.1, &water);
    }
    let speed = state.velocity_m_s.norm();
    assert!((0.70..0.75).contains(&speed), "{speed} m/s, the trim's is 0.725");
}
