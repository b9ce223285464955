//! Vehicles that are not their own mirror image: straight glides are banked, or there are none, and both are said.

mod common;

use common::lopsided;
use nalgebra::Matrix3;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use sim_host::{
    analysis::{
        helix::{Helix, HelixSolver, Slope, Turn},
        modes::{RollKinematics, modes},
        trim::{Condition, Glide, Scale, glide},
        turn::Turns,
    },
    model::{
        plant::{Particle, Plant, State, euler_from_quaternion, rk4_step, rotation_from_quaternion},
        vehicle::{MomentFrame, Vehicle},
    },
};

fn at_degrees(degrees: f64) -> Condition {
    Condition::PathAngle(degrees.to_radians())
}

/// Straight, at the path angle and scale that were asked, with nothing left over in the plant.
fn assert_exact(vehicle: &Vehicle, glide: &Glide, path_angle_rad: f64, scale: Scale) {
    let plant = Plant::<f64>::new(vehicle);
    let state = glide.state();
    // The search ends below 1e-9; writing the answer as a state rounds anew.
    let left = plant.body_residual(&state).amax();
    assert!(left < 1e-8, "{left:.1e} left in {glide:?}");
    let down_m_s = (rotation_from_quaternion(&state.quaternion) * state.velocity_m_s).z;
    assert!((-down_m_s / glide.speed_m_s - path_angle_rad.sin()).abs() < 1e-8, "{glide:?}");
    match scale {
        Scale::Speed(speed_m_s) => assert_eq!(glide.speed_m_s, speed_m_s),
        Scale::NetMass(net_mass_kg) => assert_eq!(glide.net_mass_kg, net_mass_kg),
    }
    assert_eq!(glide.displaced_volume_m3, plant.displaced_volume_m3(glide.net_mass_kg));
}

/// By hand: without hydrodynamic asymmetry the mass swings until the whole hangs below the axis, sin μ = m_rb y_rb/(m_p R_p).
#[test]
fn a_weight_to_the_right_is_balanced_by_the_mass_to_the_left() {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    vehicle.body.centre_of_mass_m.y = 0.01;
    let banked = glide(&vehicle, at_degrees(-35.0), Scale::Speed(0.77)).unwrap();
    assert_exact(&vehicle, &banked, (-35.0_f64).to_radians(), Scale::Speed(0.77));
    assert!((banked.mu_rad.sin() - 40.0 * 0.01 / (9.0 * 0.1013)).abs() < 1e-9, "{banked:?}");
    assert!(banked.phi_rad.abs() < 1e-9 && banked.beta_rad.abs() < 1e-9, "{banked:?}");
    let warning = "the vehicle is not symmetric: it glides straight with a bank of";
    assert!(banked.warnings.iter().any(|line| line.starts_with(warning)), "{:?}", banked.warnings);
    // 3 cm are more than the mass can hold: m_rb y_rb = 1.2 kg m, m_p R_p = 0.91 kg m.
    vehicle.body.centre_of_mass_m.y = 0.03;
    let refusal = glide(&vehicle, at_degrees(-35.0), Scale::Speed(0.77)).unwrap_err();
    assert!(
        refusal.contains("N is left; the nearest found has path angle -35.000°") && !refusal.contains('\n'),
        "{refusal}"
    );
}

/// Every way to be lopsided, alone: what bends the straight glide, and what shows only in turns and modes.
#[test]
fn each_asymmetry_is_answered() {
    type Change = fn(&mut Vehicle);
    let slocum = Vehicle::load("slocum-paper").unwrap();
    let level = glide(&slocum, at_degrees(-26.0), Scale::NetMass(0.25)).unwrap();
    let rows: [(&str, bool, Change); 8] = [
        ("centre of mass", true, |v| v.body.centre_of_mass_m.y = -0.005),
        ("added mass 12", true, |v| (v.added_mass.mass_kg[(0, 1)], v.added_mass.mass_kg[(1, 0)]) = (0.5, 0.5)),
        ("added mass 23", true, |v| (v.added_mass.mass_kg[(1, 2)], v.added_mass.mass_kg[(2, 1)]) = (4.0, 4.0)),
        ("products of inertia", false, |v| (v.body.inertia_kg_m2[(0, 1)], v.body.inertia_kg_m2[(1, 0)]) = (0.3, 0.3)),
        ("longitudinal coupling", false, |v| v.added_mass.coupling_kg_m[(1, 0)] = 1.2),
        ("lateral coupling", false, |v| v.added_mass.coupling_kg_m[(0, 0)] = 0.5),
        ("moments in the current frame", false, |v| v.hydrodynamics.moment_frame = MomentFrame::Current),
        ("lift at no angle", false, |v| v.hydrodynamics.c_l_zero = 0.1),
    ];
    for (name, bends, change) in rows {
        let mut vehicle = slocum.clone();
        change(&mut vehicle);
        let glide =
            glide(&vehicle, at_degrees(-26.0), Scale::NetMass(0.25)).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_exact(&vehicle, &glide, (-26.0_f64).to_radians(), Scale::NetMass(0.25));
        let banked = [glide.phi_rad, glide.beta_rad, glide.mu_rad] != [0.0; 3];
        assert_eq!(banked, bends, "{name}: {glide:?}");
        if !bends && name != "lift at no angle" {
            assert_eq!((glide.speed_m_s, glide.alpha_rad), (level.speed_m_s, level.alpha_rad), "{name}");
        }
        let turns = Turns::new(&vehicle, &glide).unwrap();
        let all = turns.sensitivities(&glide);
        assert!(all.numeric.is_some(), "{name}");
        assert!(!bends || (all.linear.is_none() && all.closed_form.is_none()), "{name}");
        let modes = modes(&vehicle, &glide, RollKinematics::Exact).unwrap();
        let coupled = modes.coupled_eigenvalues.is_some();
        assert_eq!(coupled, modes.warnings.iter().any(|line| line.contains("are coupled")), "{name}");
        // C_f of a pitching moment by a forward velocity belongs to the plane of symmetry.
        let symmetric = ["longitudinal coupling", "moments in the current frame", "lift at no angle"].contains(&name);
        assert_eq!(coupled, !symmetric, "{name}: {}", modes.coupling);
    }
}

/// The sensitivities about a banked glide are those of helices on both sides of it.
#[test]
fn sensitivities_of_a_lopsided_vehicle_are_differences_of_its_turns() {
    let mut vehicle = lopsided();
    vehicle.body.centre_of_mass_m.y = 0.01;
    let glide = glide(&vehicle, at_degrees(20.0), Scale::Speed(0.77)).unwrap();
    assert_exact(&vehicle, &glide, 20_f64.to_radians(), Scale::Speed(0.77));
    let turns = Turns::new(&vehicle, &glide).unwrap();
    let numeric = turns.sensitivities(&glide).numeric.unwrap();
    let step = 1e-5;
    let [left, right] = [-step, step].map(|rate| turns.at_rate(rate).unwrap());
    let plant = Plant::<f64>::new(&vehicle);
    assert!(plant.body_residual(&right.state(&plant)).amax() < 1e-8);
    for (exact, [from, to]) in [
        (numeric.mu_s, [left.mu_rad, right.mu_rad]),
        (numeric.phi_s, [left.roll_rad, right.roll_rad]),
        (numeric.beta_s, [left.beta_rad, right.beta_rad]),
    ] {
        // Central differences of answers that are good to 1e-9: 1e-4, and their curvature.
        assert!(((to - from) / (2.0 * step) - exact).abs() < 1e-3 * exact.abs().max(1.0), "{numeric:?}");
    }
}

/// The eight eigenvalues are those of the motion: left alone near its glide, the vehicle departs as the slowest of them says.
#[test]
fn the_coupled_eigenvalues_are_those_of_the_motion() {
    let mut vehicle = lopsided();
    vehicle.body.centre_of_mass_m.y = 0.01;
    let glide = glide(&vehicle, at_degrees(20.0), Scale::Speed(0.77)).unwrap();
    let eigenvalues = modes(&vehicle, &glide, RollKinematics::Exact).unwrap().coupled_eigenvalues.unwrap();
    let [slowest, next] = [eigenvalues[7], eigenvalues[6]];
    assert_eq!(slowest[1], 0.0, "one real mode is the last to go: {eigenvalues:?}");
    let plant = Plant::<f64>::new(&vehicle);
    let trim = glide.state();
    let mut state = State { velocity_m_s: trim.velocity_m_s * (1.0 + 1e-4), ..trim };
    let away = |state: &State<f64>| {
        let roll_and_pitch = |state: &State<f64>| euler_from_quaternion(&state.quaternion).xy();
        (state.velocity_m_s - trim.velocity_m_s).norm_squared()
            + (roll_and_pitch(state) - roll_and_pitch(&trim)).norm_squared()
    };
    // Until the second slowest has fallen by e^-10 more than the slowest.
    let settle_s = (10.0 / (slowest[0] - next[0])).ceil();
    let fly = |state: State<f64>, duration_s: f64| {
        let steps = (duration_s / 0.05) as u32;
        (0..steps)
            .fold(state, |state, _| rk4_step(&plant, &state, &Particle::Driven { u_b_m3_s: 0.0 }, 0.05, &plant.still()))
    };
    state = fly(state, settle_s);
    let later = fly(state, 2.0);
    let rate = 0.5 * (away(&later) / away(&state)).ln() / 2.0;
    assert!((rate - slowest[0]).abs() < 0.01 * slowest[0].abs(), "{rate}, {eigenvalues:?}");
}

/// Lopsided but sane: anything within some tens of per cent, and asymmetries of some per cent.
fn random_vehicle(random: &mut Pcg64Mcg) -> Vehicle {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    let mut within = |size: f64| random.random_range(-size..size);
    vehicle.name = "random".into();
    let hydro = &mut vehicle.hydrodynamics;
    for coefficient in [
        &mut hydro.c_d_zero,
        &mut hydro.c_d_induced,
        &mut hydro.c_l_alpha,
        &mut hydro.c_y_beta,
        &mut hydro.c_roll_beta,
        &mut hydro.c_roll_p,
        &mut hydro.c_m_alpha,
        &mut hydro.c_m_q,
        &mut hydro.c_n_beta,
        &mut hydro.c_n_r,
    ] {
        *coefficient *= 1.0 + within(0.3);
    }
    hydro.c_l_zero = within(0.02);
    (hydro.c_roll_r, hydro.c_n_p, hydro.c_y_p) = (within(0.1), within(0.1), within(0.1));
    hydro.moment_frame = if within(1.0) < 0.0 { MomentFrame::Current } else { MomentFrame::Body };
    vehicle.body.centre_of_mass_m.x = within(0.02);
    vehicle.body.centre_of_mass_m.y = within(0.005);
    let mut skew = |size: f64| {
        let [a, b, c] = [within(size), within(size), within(size)];
        Matrix3::new(0.0, a, b, a, 0.0, c, b, c, 0.0)
    };
    vehicle.body.inertia_kg_m2 += skew(0.1);
    vehicle.added_mass.inertia_kg_m2 += skew(0.5);
    vehicle.added_mass.mass_kg += skew(0.5);
    vehicle.added_mass.coupling_kg_m = Matrix3::from_fn(|_, _| within(1.0));
    if let Some(buoyancy) = &mut vehicle.buoyancy {
        buoyancy.acts_at_station = within(1.0) < 0.0;
    }
    vehicle
}

#[test]
fn fifty_random_vehicles_glide_exactly_or_say_in_one_line_why_not() {
    let mut random = Pcg64Mcg::seed_from_u64(7);
    let (mut glided, mut refused) = (0, 0);
    for number in 0..50 {
        let vehicle = random_vehicle(&mut random);
        let side = if number % 3 == 0 { 1.0 } else { -1.0 };
        let path_angle_rad = f64::to_radians(side * random.random_range(12.0..40.0));
        let scale = if number % 2 == 0 {
            Scale::Speed(random.random_range(0.3..0.9))
        } else {
            Scale::NetMass(-side * random.random_range(0.1..0.4))
        };
        match glide(&vehicle, Condition::PathAngle(path_angle_rad), scale) {
            Ok(glide) => {
                glided += 1;
                assert_exact(&vehicle, &glide, path_angle_rad, scale);
                assert_answers(&vehicle, &glide);
            }
            Err(refusal) => {
                refused += 1;
                assert!(refusal.contains("is left; the nearest found has") && !refusal.contains('\n'), "{refusal}");
                assert_no_straight_glide(&vehicle, path_angle_rad, scale, &mut random);
            }
        }
    }
    assert!(glided > 30 && refused > 0, "{glided} glided, {refused} refused");
}

/// Turns and modes of a glide: finite numbers, and turns that are steady.
fn assert_answers(vehicle: &Vehicle, glide: &Glide) {
    let plant = Plant::<f64>::new(vehicle);
    let turns = Turns::new(vehicle, glide).unwrap();
    let numeric = turns.sensitivities(glide).numeric.unwrap();
    assert!([numeric.mu_s, numeric.phi_s, numeric.beta_s].iter().all(|value| value.is_finite()));
    let largest = turns.authorities().right.largest_turn_rate_rad_s;
    let helix = turns.at_rate(0.5 * largest).unwrap();
    assert!(plant.body_residual(&helix.state(&plant)).amax() < 1e-8, "{helix:?}");
    let refusal = turns.at_rate(1.01 * largest).unwrap_err();
    assert!(refusal.contains(&format!("is {largest:.6} rad/s, at mu ")), "{refusal}");
    let modes = modes(vehicle, glide, RollKinematics::Exact).unwrap();
    let values = modes.longitudinal.eigenvalues.into_iter().chain(modes.lateral.eigenvalues);
    assert!(values.chain(modes.coupled_eigenvalues.unwrap()).flatten().all(|part| part.is_finite()));
}

/// A refusal is right if searches from all over find nothing that flies with attached flow either.
fn assert_no_straight_glide(vehicle: &Vehicle, path_angle_rad: f64, scale: Scale, random: &mut Pcg64Mcg) {
    let solver = HelixSolver::new(vehicle);
    let slocum = Vehicle::load("slocum-paper").unwrap();
    let level = Helix::from(&glide(&slocum, Condition::PathAngle(path_angle_rad), scale).unwrap());
    for _ in 0..30 {
        let near = Helix {
            beta_rad: random.random_range(-0.2..0.2),
            roll_rad: random.random_range(-1.0..1.0),
            mu_rad: random.random_range(-3.0..3.0),
            ..level
        };
        if let Ok(helix) = solver.solve_at(scale, &near, Slope::PathAngle(path_angle_rad), Turn::Rate(0.0)) {
            assert!(helix.alpha_rad.abs() > 0.3, "{helix} was overlooked");
        }
    }
}
