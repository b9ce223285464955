//! Turns and modes against what the paper prints, and three ways to the same first order.

use sim_host::{
    analysis::{
        helix::{Helix, HelixSolver, Slope, Turn},
        modes::{ModeSet, RollKinematics, modes},
        trim::{Condition, Glide, Scale, glide},
        turn::{Sensitivity, Turns},
    },
    model::{
        plant::{Plant, State},
        vehicle::Vehicle,
    },
};

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn glide_at(vehicle: &Vehicle, degrees: f64, scale: Scale) -> Glide {
    glide(vehicle, Condition::PathAngle(degrees.to_radians()), scale).unwrap()
}

fn assert_eigenvalues(set: &ModeSet, printed: [(f64, f64); 4]) {
    for (ours, (re, im)) in set.eigenvalues.iter().zip(printed) {
        // Two decimals are printed, and −3.28 stands for −3.2903.
        assert!((ours[0] - re).abs() < 0.011 && (ours[1] - im).abs() < 0.011, "{ours:?}, printed {re} {im:+}i");
    }
}

/// Table 1, sizes of the printed eigenvectors included.
#[test]
fn the_longitudinal_modes_are_those_of_table_1() {
    let vehicle = slocum();
    let set =
        modes(&vehicle, &glide_at(&vehicle, -35.0, Scale::Speed(0.77)), RollKinematics::Exact).unwrap().longitudinal;
    assert_eigenvalues(&set, [(-3.28, 0.0), (-0.85, 0.27), (-0.85, -0.27), (-0.06, 0.0)]);
    let printed = [
        [0.0315, 0.0631, 1.0, 0.1306],
        [0.0661, 0.6694, 1.0, 0.4793],
        [0.0661, 0.6694, 1.0, 0.4793],
        [1.0, 0.0231, 0.0005, 0.0038],
    ];
    for (vector, sizes) in set.eigenvectors.iter().zip(printed) {
        for ([re, im], size) in vector.iter().zip(sizes) {
            assert!((re.hypot(*im) - size).abs() < 0.004, "{vector:?}, printed sizes {sizes:?}");
        }
    }
    assert_eq!(set.names, ["pitch rate", "pitch oscillation", "pitch oscillation", "speed"]);
}

/// Table 2 obeys φ̇ = p; with the right kinematics the roll-yaw modes differ.
#[test]
fn the_lateral_modes_are_those_of_table_2_with_its_kinematics() {
    let vehicle = slocum();
    let glide = glide_at(&vehicle, -35.0, Scale::Speed(0.77));
    let paper = modes(&vehicle, &glide, RollKinematics::Paper).unwrap().lateral;
    assert_eigenvalues(&paper, [(-1.81, 0.0), (-1.33, 1.75), (-1.33, -1.75), (-0.17, 0.0)]);
    let exact = modes(&vehicle, &glide, RollKinematics::Exact).unwrap();
    assert_eigenvalues(&exact.lateral, [(-2.002, 0.0), (-1.228, 2.058), (-1.228, -2.058), (-0.1725, 0.0)]);
    assert!(exact.coupling < 1e-15, "{}", exact.coupling);
}

/// The rates of (u, w, q, v, p, r) under a disturbance of one of them.
fn disturbed(plant: &Plant<f64>, trim: &State<f64>, place: usize, size: f64) -> [f64; 6] {
    let mut state = *trim;
    match place {
        0 => state.velocity_m_s.x += size,
        1 => state.velocity_m_s.z += size,
        2 => state.rate_rad_s.y += size,
        3 => state.velocity_m_s.y += size,
        4 => state.rate_rad_s.x += size,
        _ => state.rate_rad_s.z += size,
    }
    let rates = plant.derivative_driven(&state, 0.0, &plant.still());
    let (v, w) = (rates.velocity_m_s, rates.rate_rad_s);
    [v.x, v.z, w.y, v.y, w.x, w.z]
}

/// The linearisation by dual numbers is that of central differences, to their own error of 1e-8 at a step of 1e-4.
#[test]
fn the_exact_linearisation_agrees_with_differences() {
    let vehicle = slocum();
    let glide = glide_at(&vehicle, -26.0, Scale::NetMass(0.25));
    let both = modes(&vehicle, &glide, RollKinematics::Exact).unwrap();
    let (plant, trim, step) = (Plant::<f64>::new(&vehicle), glide.state(), 1e-4);
    for place in 0..6 {
        let (plus, minus) = (disturbed(&plant, &trim, place, step), disturbed(&plant, &trim, place, -step));
        let (set, first) = if place < 3 { (&both.longitudinal, 0) } else { (&both.lateral, 3) };
        for row in 0..3 {
            let difference = (plus[first + row] - minus[first + row]) / (2.0 * step);
            let exact = set.matrix[row][place - first];
            assert!(
                (exact - difference).abs() < 1e-7 * exact.abs().max(1.0),
                "row {row}, column {place}: {exact}, {difference}"
            );
        }
    }
}

/// Every eigenpair satisfies A x = λ x once the table's scaling is undone.
#[test]
fn eigenvectors_belong_to_their_eigenvalues() {
    let vehicle = slocum();
    for degrees in [-35.0, -12.0, 20.0, 60.0] {
        let both = modes(&vehicle, &glide_at(&vehicle, degrees, Scale::Speed(0.6)), RollKinematics::Exact).unwrap();
        let (speed, rate) = (0.77, 0.77 / 1.8);
        for (set, scales) in [(both.longitudinal, [speed, speed, rate, 1.0]), (both.lateral, [speed, rate, rate, 1.0])]
        {
            for (value, vector) in set.eigenvalues.iter().zip(set.eigenvectors) {
                let x: [[f64; 2]; 4] = std::array::from_fn(|i| vector[i].map(|part| part * scales[i]));
                for (i, row) in set.matrix.iter().enumerate() {
                    let left: [f64; 2] = std::array::from_fn(|part| row.iter().zip(x).map(|(a, x)| a * x[part]).sum());
                    let right = [value[0] * x[i][0] - value[1] * x[i][1], value[0] * x[i][1] + value[1] * x[i][0]];
                    assert!((left[0] - right[0]).hypot(left[1] - right[1]) < 1e-10, "{degrees}°: row {i} of {value:?}");
                }
            }
        }
    }
}

fn assert_same(one: Sensitivity, other: Sensitivity, relative: f64) {
    for (a, b) in [(one.mu_s, other.mu_s), (one.phi_s, other.phi_s), (one.beta_s, other.beta_s)] {
        assert!((a - b).abs() < relative * b.abs(), "{one:?}, {other:?}");
    }
}

/// The exact helix's derivative, the 3×3 system and equations (14)–(16) are the same numbers for the paper's vehicle.
#[test]
fn three_ways_to_the_first_order_of_a_turn_agree() {
    let mut coupled = slocum();
    coupled.added_mass.coupling_kg_m[(1, 2)] = 1.5;
    coupled.added_mass.coupling_kg_m[(2, 1)] = -2.0;
    for vehicle in [slocum(), coupled] {
        for (degrees, speed) in [(-35.0, 0.77), (-20.0, 0.5), (15.0, 0.9), (50.0, 0.77)] {
            let glide = glide_at(&vehicle, degrees, Scale::Speed(speed));
            let all = Turns::new(&vehicle, &glide).unwrap().sensitivities(&glide);
            let numeric = all.numeric.unwrap();
            assert_same(all.linear.unwrap(), numeric, 1e-9);
            assert_same(all.closed_form.unwrap(), numeric, 1e-9);
        }
    }
}

#[test]
fn where_the_papers_assumptions_fail_it_gives_no_closed_form() {
    let mut vehicle = slocum();
    vehicle.hydrodynamics.c_n_p = -0.05;
    let glide = glide_at(&vehicle, -35.0, Scale::Speed(0.77));
    let all = Turns::new(&vehicle, &glide).unwrap().sensitivities(&glide);
    assert_eq!(all.closed_form, None);
    assert_same(all.linear.unwrap(), all.numeric.unwrap(), 1e-9);
    vehicle.body.centre_of_mass_m.y = 0.001;
    let all = Turns::new(&vehicle, &glide).unwrap().sensitivities(&glide);
    assert_eq!((all.linear, all.closed_form), (None, None));
}

/// The pole of (14)–(16) is where the control reverses: C_lβ = −0.7317 at −35°.
#[test]
fn the_sense_of_turn_reverses_at_the_pole() {
    let sense = |c_roll_beta: f64| {
        let mut vehicle = slocum();
        vehicle.hydrodynamics.c_roll_beta = c_roll_beta;
        Turns::new(&vehicle, &glide_at(&vehicle, -35.0, Scale::Speed(0.77))).unwrap().sense()
    };
    assert_eq!((sense(-0.7316), sense(-0.7318)), (-1.0, 1.0));
    let vehicle = slocum();
    let by_angle = |degrees| Turns::new(&vehicle, &glide_at(&vehicle, degrees, Scale::Speed(0.77))).unwrap().sense();
    assert_eq!((by_angle(-39.2), by_angle(-39.4)), (-1.0, 1.0));
    assert_eq!((by_angle(35.0), by_angle(60.0)), (1.0, 1.0), "no reversal on climbs");
}

/// A helix is an equilibrium of the plant that flies, and its radius is what speed and rate make it.
#[test]
fn the_exact_turn_is_steady_in_the_plant_and_holds_pitch() {
    let vehicle = slocum();
    let plant = Plant::<f64>::new(&vehicle);
    for (degrees, net_mass, rate) in
        [(-26.0, 0.25, 0.007), (-26.0, 0.25, -0.007), (26.0, -0.25, 0.009), (-35.0, 0.2129, 0.003)]
    {
        let glide = glide_at(&vehicle, degrees, Scale::NetMass(net_mass));
        let helix = Turns::new(&vehicle, &glide).unwrap().at_rate(rate).unwrap();
        assert!(plant.body_residual(&helix.state(&plant)).amax() < 1e-9);
        assert!((helix.pitch_rad - glide.pitch_rad).abs() < 1e-12 && helix.turn_rate_rad_s == rate);
        let radius = helix.speed_m_s * helix.path_angle_rad().cos() / rate.abs();
        assert!((helix.radius_m() - radius).abs() < 1e-9 * radius);
    }
}

/// Turn rates at |μ| of 30, 45 and 60° with 0.25 kg, pitch held, mrad/s, as an independent model gives them.
#[test]
fn the_authority_differs_between_steep_and_shallow_dives_and_climbs() {
    let vehicle = slocum();
    let solver = HelixSolver::new(&vehicle);
    let table =
        [(-35.0, [1.9, 2.7, 3.2]), (-26.0, [4.9, 7.1, 8.9]), (-15.0, [8.8, 12.9, 16.4]), (35.0, [5.9, 8.7, 11.2])];
    for (degrees, rates) in table {
        let glide = glide_at(&vehicle, degrees, Scale::NetMass(-0.25 * f64::signum(degrees)));
        let mut helix = Helix::from(&glide);
        for (mu_deg, rate) in [30.0_f64, 45.0, 60.0].into_iter().zip(rates) {
            helix = solver.solve(&helix, Slope::Pitch(glide.pitch_rad), Turn::Mu(mu_deg.to_radians())).unwrap();
            let ours = 1e3 * helix.turn_rate_rad_s.abs();
            assert!((ours - rate).abs() < 0.06, "{degrees}°, mu {mu_deg}°: {ours:.2}, expected {rate}");
        }
    }
}

#[test]
fn a_turn_that_is_too_tight_is_refused_with_the_tightest() {
    let vehicle = slocum();
    let turns = Turns::new(&vehicle, &glide_at(&vehicle, -35.0, Scale::Speed(0.77))).unwrap();
    let largest = turns.authorities().right.largest_turn_rate_rad_s;
    assert!(turns.at_rate(largest * 0.9999).is_ok());
    let refusal = turns.at_rate(largest * 1.0001).unwrap_err();
    assert!(
        refusal.contains(&format!(
            "the largest that slocum-paper reaches at this pitch and net mass is {largest:.6} rad/s"
        )),
        "{refusal}"
    );
    assert!(turns.authorities().right.reverses);
}

/// Damping, period and time to half say what the eigenvalue says; the states' shares in a mode sum to 1.
#[test]
fn the_figures_of_a_mode_follow_from_its_eigenvalue() {
    let vehicle = slocum();
    let both = modes(&vehicle, &glide_at(&vehicle, -35.0, Scale::Speed(0.77)), RollKinematics::Exact).unwrap();
    for set in [both.longitudinal, both.lateral] {
        for i in 0..4 {
            let [re, im] = set.eigenvalues[i];
            assert!((set.damping_ratio[i].unwrap() + re / re.hypot(im)).abs() < 1e-15);
            // After the time to half, e^(re t) is a half.
            assert!(((re * set.time_to_half_s[i].unwrap()).exp() - 0.5).abs() < 1e-14);
            assert_eq!(set.period_s[i].is_some(), im != 0.0);
            let shares = set.participation.unwrap()[i];
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        }
    }
}

/// Pitch rate rules the fastest longitudinal mode, speed the slowest.
#[test]
fn pitch_rate_and_speed_rule_their_modes() {
    let vehicle = slocum();
    let glide = glide_at(&vehicle, -35.0, Scale::Speed(0.77));
    let shares = modes(&vehicle, &glide, RollKinematics::Exact).unwrap().longitudinal.participation.unwrap();
    let largest = |mode: [f64; 4]| (0..4).max_by(|a, b| mode[*a].total_cmp(&mode[*b])).unwrap();
    assert_eq!([largest(shares[0]), largest(shares[3])], [2, 0]);
}
