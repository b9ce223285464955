use super::*;
use crate::model::table::tests::file;

fn mu_for(path_angle_rad: f32, error_cdeg: i32) -> i32 {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let steady = Steady { path_angle_rad, net_mass_kg: 0.25 };
    HeadingLoop::new(&Parameters::default()).mu_cdeg(&mut TurnTrim::default(), &table, &steady, 0, error_cdeg, 0)
}

#[test]
fn the_sense_of_the_turn_comes_from_the_table() {
    // The made-up vehicle turns right with mu < 0 on dives and mu > 0 on climbs.
    assert!(mu_for(-0.4, 3_000) < 0);
    assert!(mu_for(0.4, 3_000) > 0);
    assert_eq!(mu_for(0.4, 3_000), -mu_for(0.4, -3_000));
}

/// Flies straight for some periods on the table's turn rate and a bias beyond it; the trim and the last error, 0.01°.
fn hold(bias_rad_s: f32, periods: u32) -> (TurnTrim, f32, u32) {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let steady = Steady { path_angle_rad: -0.4, net_mass_kg: 0.25 };
    let parameters = Parameters::default();
    let heading_loop = HeadingLoop::new(&parameters);
    let (mut trim, mut mu_cdeg, mut error_cdeg, mut moves) = (TurnTrim::default(), 0, 0.0, 0);
    for tick in 0..periods.saturating_mul(heading_loop.period_ticks) {
        let before_cdeg = mu_cdeg;
        mu_cdeg = heading_loop.mu_cdeg(&mut trim, &table, &steady, tick, error_cdeg as i32, mu_cdeg);
        moves = u32::saturating_add(moves, u32::from(mu_cdeg != before_cdeg));
        let turn = table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_cdeg as f32 * RAD_PER_CDEG);
        error_cdeg -= (turn.turn_rate_rad_s + bias_rad_s) * TICK_S / RAD_PER_CDEG;
    }
    (trim, error_cdeg, moves)
}

#[test]
fn a_bias_of_the_turn_is_learned_and_the_vehicle_then_flies_straight() {
    let bias_rad_s = 0.1_f32.to_radians();
    let (trim, error_cdeg, _) = hold(bias_rad_s, 400);
    assert!((trim.bias_rad_s() / bias_rad_s - 1.0).abs() < 0.2, "{trim:?}");
    assert!(error_cdeg.abs() < 2.0 * Parameters::default().heading_deadband_cdeg as f32, "{error_cdeg}");
    let late_moves = hold(bias_rad_s, 400).2 - hold(bias_rad_s, 200).2;
    assert!(late_moves <= 10, "{late_moves} moves in 200 periods once it is known");
}

#[test]
fn a_learned_bias_stays_within_its_limit() {
    let limit_rad_s = Parameters::default().turn_bias_limit_mdeg_s as f32 / 10.0 * RAD_PER_CDEG;
    for bias_deg_s in [2.0_f32, -2.0] {
        let (trim, ..) = hold(bias_deg_s.to_radians(), 400);
        assert!(trim.bias_rad_s().abs() <= limit_rad_s, "{trim:?}");
    }
}

#[test]
fn a_turn_ends_well_inside_the_deadband_that_began_it() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let steady = Steady { path_angle_rad: -0.4, net_mass_kg: 0.25 };
    let heading_loop = HeadingLoop::new(&Parameters::default());
    let mut trim = TurnTrim::default();
    let mut mu_at = |error_cdeg, mu_cdeg| heading_loop.mu_cdeg(&mut trim, &table, &steady, 0, error_cdeg, mu_cdeg);
    assert_eq!(mu_at(140, 0), 0, "inside the deadband of 2° nothing begins");
    let turning_cdeg = mu_at(3_000, 0);
    assert_ne!(turning_cdeg, 0);
    assert_ne!(mu_at(140, turning_cdeg), 0, "the turn goes on");
    assert_eq!(mu_at(20, turning_cdeg), 0, "and ends");
}

/// An error beyond the deadband, but no turn: the mass moves once, by a few degrees, and the heading comes back.
#[test]
fn a_small_error_takes_one_small_move() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let steady = Steady { path_angle_rad: -0.4, net_mass_kg: 0.25 };
    let heading_loop = HeadingLoop::new(&Parameters::default());
    let (mut trim, mut mu_cdeg, mut error_cdeg, mut moves) = (TurnTrim::default(), 0, 250.0_f32, 0);
    let mut tick = 0;
    while error_cdeg > 50.0 {
        let before_cdeg = mu_cdeg;
        mu_cdeg = heading_loop.mu_cdeg(&mut trim, &table, &steady, tick, error_cdeg as i32, mu_cdeg);
        moves += i32::from(mu_cdeg != before_cdeg);
        assert!(mu_cdeg.abs() < Parameters::default().mu_deadband_cdeg && tick < 2_000, "{mu_cdeg} at {tick}");
        let mu_rad = mu_cdeg as f32 * RAD_PER_CDEG;
        let turn = table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad);
        error_cdeg -= turn.turn_rate_rad_s * TICK_S / RAD_PER_CDEG;
        tick += 1;
    }
    assert_eq!(moves, 1);
}

/// Half the authority takes twice the time, so that the rotation per error stays: it is the swing that bounds it.
#[test]
fn an_error_is_answered_by_one_rotation_however_weak_the_turn_but_by_none_without_authority() {
    let file = file();
    let table = TrimTable::parse(&file).unwrap();
    let heading_loop = HeadingLoop::new(&Parameters::default());
    let gain = |net_mass_kg| {
        let steady = Steady { path_angle_rad: -0.4, net_mass_kg };
        f64::from(heading_loop.mu_cdeg(&mut TurnTrim::default(), &table, &steady, 0, 450, 0)) / 450.0
    };
    // The made-up vehicle's critical gain is 9 everywhere; the arcsine of the table adds some per cent.
    for net_mass_kg in [0.1, 0.4] {
        assert!((gain(net_mass_kg).abs() / (9.0 * f64::from(GAIN_SHARE)) - 1.0).abs() < 0.1, "{}", gain(net_mass_kg));
    }
    // So light that 0.03 √m̃ sin μ turns by 0.005 °/s at most: an error of 4.5° would take a quarter of an hour and more.
    assert_eq!(gain(1e-5), 0.0, "the mass stays");
}

#[test]
fn small_errors_are_left_alone_and_large_ones_stay_within_the_limit() {
    assert_eq!(mu_for(-0.4, 100), 0);
    assert_eq!(mu_for(-0.4, 17_000), -Parameters::default().mu_limit_cdeg);
}
