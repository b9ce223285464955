//! Wings-level glides against the numbers that the paper prints, and against the plant.

use sim_host::{
    analysis::trim::{Condition, Glide, Scale, glide},
    model::{plant::Plant, vehicle::Vehicle},
};

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn solve(condition: Condition, scale: Scale) -> Glide {
    glide(&slocum(), condition, scale).unwrap()
}

fn at_degrees(degrees: f64) -> Condition {
    Condition::PathAngle(degrees.to_radians())
}

/// Section 5.1 prints 0.2130 kg, 0.2826 m and 1.2°; with g = 9.81 the net mass is 0.2129.
#[test]
fn the_papers_trim_is_reproduced() {
    let glide = solve(at_degrees(-35.0), Scale::Speed(0.77));
    assert_eq!(format!("{:.4}", glide.net_mass_kg), "0.2129");
    assert_eq!(format!("{:.4}", glide.alpha_rad.to_degrees()), "1.2247");
    assert_eq!(format!("{:.4}", glide.r_px_m), "0.2826");
    assert!(glide.warnings.is_empty(), "{:?}", glide.warnings);
}

/// Fig 5 and trap 2 of the paper's polar: best glide 8.0003°, fastest at 35.66° with 0.2094 kg and 0.290 m.
#[test]
fn flattest_and_fastest_glide_are_where_the_polar_has_them() {
    let flattest = solve(Condition::MinGlideAngle, Scale::Speed(0.77));
    assert_eq!(format!("{:.4}", flattest.path_angle_rad.to_degrees()), "-8.0003");
    assert_eq!(format!("{:.2} {:.1}", flattest.net_mass_kg, flattest.alpha_rad.to_degrees()), "1.74 12.1");
    assert_eq!(flattest.warnings.len(), 1, "1.74 kg is beyond the engine: {:?}", flattest.warnings);
    let fastest = solve(Condition::MaxHorizontalSpeed, Scale::Speed(0.77));
    assert_eq!(format!("{:.2}", fastest.path_angle_rad.to_degrees()), "-35.66");
    assert_eq!(format!("{:.4} {:.3}", fastest.net_mass_kg, fastest.r_px_m), "0.2094 0.290");
}

/// The closed form is an equilibrium of the equations that fly, diving and climbing.
#[test]
fn nothing_is_left_over_in_the_plant() {
    let plant = Plant::<f64>::new(&slocum());
    for degrees in [-80.0, -35.0, -12.0, 8.1, 26.0, 40.0, 89.0] {
        let glide = solve(at_degrees(degrees), Scale::Speed(0.6));
        // Terms of the balance are of order 10 N.
        let residual = plant.body_residual(&glide.state()).amax();
        assert!(residual < 1e-12, "{degrees}°: {residual:.1e} left");
        assert_eq!(glide.net_mass_kg > 0.0, degrees < 0.0);
    }
}

#[test]
fn speed_and_net_mass_are_two_ways_to_say_the_same() {
    let by_speed = solve(at_degrees(-26.0), Scale::Speed(0.7));
    let by_mass = solve(at_degrees(-26.0), Scale::NetMass(by_speed.net_mass_kg));
    assert!((by_mass.speed_m_s - 0.7).abs() < 1e-14);
}

#[test]
fn what_cannot_be_met_is_named_with_the_nearest_that_can() {
    let refusal = |condition, scale| glide(&slocum(), condition, scale).unwrap_err();
    assert_eq!(
        refusal(at_degrees(-7.9), Scale::Speed(0.77)),
        "path angle -7.9000°: slocum-paper glides between 8.0003° and 90°, down (−) or up (+)"
    );
    assert_eq!(refusal(at_degrees(-26.0), Scale::Speed(0.0)), "speed 0 m/s: must be positive");
    assert_eq!(refusal(at_degrees(26.0), Scale::NetMass(0.2)), "net mass 0.2 kg: must be negative to glide up");
    assert!(refusal(at_degrees(f64::NAN), Scale::Speed(0.77)).starts_with("path angle NaN°"));
}

/// A dive's engine is emptied: with the engine in the nose the mass must come back by ρ ΔV x/m_p.
#[test]
fn an_engine_in_the_nose_is_trimmed_by_the_moving_mass() {
    let mut vehicle = slocum();
    let centred = glide(&vehicle, at_degrees(-35.0), Scale::Speed(0.77)).unwrap();
    vehicle.buoyancy.as_mut().unwrap().acts_at_station = true;
    let nose = glide(&vehicle, at_degrees(-35.0), Scale::Speed(0.77)).unwrap();
    let back_m = nose.net_mass_kg * 0.55 / 9.0;
    assert!((centred.r_px_m - back_m - nose.r_px_m).abs() < 1e-12);
    assert_ne!(vehicle.hash(), slocum().hash(), "the trim table of one is not for the other");
}
