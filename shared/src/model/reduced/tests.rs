//! The model on its own: the paper's glide, the same in both arithmetics, and what nonsense cannot do to it.

use super::*;
use crate::model::number::Fixed;

/// The paper's Slocum: trim of section 5.1 is 0.77 m/s at −35° with 0.2129 kg, α 1.2247°.
pub(crate) const SLOCUM: GlideConstants = GlideConstants {
    mass_kg: 50.0,
    mass_u_kg: 55.0,
    mass_w_kg: 120.0,
    drag_zero: 2.0,
    drag_induced: 45.0 / (135.0 * 135.0),
    lift_zero: 0.0,
    lift_alpha: 135.0,
    lift_rate: 0.0,
    surge_coupling_kg_m: 3.77,
    heave_coupling_kg_m: 0.0,
    moving_mass_kg: 9.0,
    turn_length_m: [3.0, 1.0],
};

fn drive<N: Number>(pitch_rad: f32, net_mass_kg: f32, pitch_rate_rad_s: f32) -> Drive<N> {
    Drive {
        pitch_rad: N::new(pitch_rad),
        roll_rad: N::new(0.0),
        pitch_rate_rad_s: N::new(pitch_rate_rad_s),
        r_px_m: N::new(0.0),
        net_mass_kg: N::new(net_mass_kg),
        density_ratio: N::new(1.0),
    }
}

fn settled<N: Number>() -> (f32, f32) {
    let model = Model::<N>::new(&SLOCUM, 9.81, 0.25);
    let drive = drive((-35.0_f32 + 1.2247).to_radians(), 0.2129, 0.0);
    let motion = (0..2_000).fold(Motion::at_rest(), |motion, _| model.step(&motion, &drive));
    (motion.speed_m_s().value(), motion.alpha_rad().value().to_degrees())
}

#[test]
fn settles_on_the_papers_glide_in_both_arithmetics() {
    for (speed_m_s, alpha_deg) in [settled::<f32>(), settled::<Fixed>()] {
        // 0.2129 kg is given to four digits, and speed goes with its root: half of 2.3e-4, relative.
        assert!((speed_m_s - 0.77).abs() < 3e-4, "{speed_m_s}");
        assert!((alpha_deg - 1.2247).abs() < 1e-2, "{alpha_deg}");
    }
}

fn stays_bounded<N: Number>() {
    let model = Model::<N>::new(&SLOCUM, 9.81, 0.25);
    for pitch_rad in [-1.5, 0.0, 1.5, 1e9, f32::NAN] {
        for net_mass_kg in [-1e6, 0.0, 0.3, f32::INFINITY] {
            let drive = drive(pitch_rad, net_mass_kg, 10.0);
            let mut motion = Motion::new(N::new(-3.0), N::new(2.5));
            for _ in 0..100 {
                motion = model.step(&motion, &drive);
                assert!(motion.u_m_s.value().abs() <= limits::SPEED_M_S, "{pitch_rad} rad, {net_mass_kg} kg");
                assert!(motion.w_m_s.value().abs() <= limits::SPEED_M_S, "{pitch_rad} rad, {net_mass_kg} kg");
            }
        }
    }
}

#[test]
fn stays_bounded_under_any_drive() {
    stays_bounded::<f32>();
    stays_bounded::<Fixed>();
}

/// A body of revolution without lift keeps its momentum in space when it is pitched: what surge loses heave gains.
#[test]
fn momentum_is_kept_while_pitching_without_forces() {
    let shell = GlideConstants {
        drag_zero: 0.0,
        drag_induced: 0.0,
        lift_alpha: 0.0,
        mass_w_kg: 55.0,
        moving_mass_kg: 0.0,
        ..SLOCUM
    };
    let model = Model::<f32>::new(&shell, 9.81, 0.25);
    let drive = drive(0.0, 0.0, 0.1);
    let mut motion = model.step(&Motion::new(0.7, 0.0), &drive);
    let arm_m_s = 0.1 * shell.surge_coupling_kg_m / shell.mass_u_kg;
    let momentum = |motion: &Motion<f32>| (motion.u_m_s + arm_m_s).hypot(motion.w_m_s);
    let before = momentum(&motion);
    for _ in 0..60 {
        motion = model.step(&motion, &drive);
    }
    // The midpoint rule gains (q dt)⁴/8, 5e-8, a step.
    assert!((momentum(&motion) / before - 1.0).abs() < 1e-5, "{} m/s of {before}", momentum(&motion));
    assert!(motion.w_m_s > 0.5, "after 1.5 rad most of it is heave: {motion:?}");
}
