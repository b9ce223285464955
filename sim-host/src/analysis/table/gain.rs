//! How much a heading loop may turn the mass before it swings for ever.

use nalgebra::{DMatrix, DVector, RowDVector};
use shared::{
    control::heading::GAIN_PERIOD_S,
    device::{TICK_HZ, TICK_S},
};

use super::Envelope;
use crate::analysis::{
    margins::{Law, SampledLoop, held},
    modes::{RollKinematics, linearised},
    trim::{Condition, Glide, Scale, glide},
};
use crate::model::vehicle::Vehicle;

/// Places of the lateral states (v, p, r, φ) among the eight, and of r and ψ behind them.
const LATERAL: usize = 4;
const R: usize = 2;
const PSI: usize = 4;
/// A gain that is small for any vehicle: the search for the critical one begins here.
const SMALL_GAIN: f64 = 0.2;
/// Where it ends, a hundred times as far.
const MOST_GAIN: f64 = 100.0 * SMALL_GAIN;
/// From an order until the actuator is there, ticks.
const ACTUATOR_TICKS: usize = 1;

/// The critical gains at the corners of an envelope: of dives and climbs, flattest and steepest, lightest and heaviest.
///
/// A straight line between two corners lies below the gain of all embedded vehicles: it has one hump in between.
///
/// # Errors
/// One line: a corner without a glide, or without eigenvalues.
pub(super) fn critical_heading_gains(vehicle: &Vehicle, envelope: &Envelope) -> Result<[[[f32; 2]; 2]; 2], String> {
    let mut gains = [[[0.0; 2]; 2]; 2];
    for (side, (sign, path_angles_deg)) in [(1.0, envelope.dive_deg), (-1.0, envelope.climb_deg)].iter().enumerate() {
        for (steep, path_angle_deg) in path_angles_deg.iter().enumerate() {
            for (heavy, net_mass_kg) in envelope.net_mass_kg.iter().enumerate() {
                let condition = Condition::PathAngle(-sign * path_angle_deg.to_radians());
                let glide = glide(vehicle, condition, Scale::NetMass(sign * net_mass_kg))?;
                gains[side][steep][heavy] = critical_gain(vehicle, &glide)? as f32;
            }
        }
    }
    Ok(gains)
}

/// Gain at which the sampled loop around the lateral motion is stable no more; 0 if it never is.
fn critical_gain(vehicle: &Vehicle, glide: &Glide) -> Result<f64, String> {
    let linear = linearised(vehicle, glide, RollKinematics::Exact);
    let mut a = DMatrix::zeros(PSI + 1, PSI + 1);
    a.view_mut((0, 0), (PSI, PSI)).copy_from(&linear.states.view((LATERAL, LATERAL), (PSI, PSI)));
    a[(PSI, R)] = libm::cos(glide.phi_rad) / libm::cos(glide.pitch_rad);
    let b = DVector::from_fn(PSI + 1, |i, _| if i < PSI { linear.inputs[(LATERAL + i, 1)] } else { 0.0 });
    let (step, drive) = held(&a, &b, TICK_S.into());
    let settled = a.view((0, 0), (PSI, PSI)).into_owned().lu().solve(&b.rows(0, PSI).into_owned());
    // The steady turn rate per rotation is −c A⁻¹ b: its sign is the sense of the turn.
    let Some(turn) = settled.map(|state| -state[R]) else { return Ok(0.0) };
    let sampled = SampledLoop {
        step,
        drive,
        seen: RowDVector::from_fn(PSI + 1, |_, j| if j == PSI { 1.0 } else { 0.0 }),
        law: Law::ProportionalMean,
        gain: SMALL_GAIN.copysign(turn),
        period_ticks: GAIN_PERIOD_S.unsigned_abs().saturating_mul(TICK_HZ) as usize,
        delay_ticks: ACTUATOR_TICKS,
        tick_s: TICK_S.into(),
    };
    let margins = sampled.margins()?;
    Ok(if margins.is_stable() { margins.gain_margin.map_or(MOST_GAIN, |margin| SMALL_GAIN * margin) } else { 0.0 })
}
