//! How soon a turn follows a rotation of the mass.

use nalgebra::{Matrix4, Vector4};

use super::Envelope;
use crate::analysis::{
    modes::{RollKinematics, modes},
    trim::{Condition, Glide, Scale, glide},
};
use crate::model::{
    plant::{Plant, State},
    vehicle::Vehicle,
};

/// Rotation over which the effect of the mass is taken, rad.
const SMALL_MU_RAD: f64 = 1e-4;

/// The turn lengths of dives and climbs, in the middle of an envelope.
///
/// # Errors
/// One line if the envelope's middle has no glide or does not turn.
pub(super) fn turn_lengths_m(vehicle: &Vehicle, envelope: &Envelope) -> Result<[f64; 2], String> {
    let middle = |[low, high]: [f64; 2]| (low * high).sqrt();
    let net_mass_kg = middle(envelope.net_mass_kg);
    let length = |path_angle_deg: f64, net_mass_kg: f64| {
        let condition = Condition::PathAngle(path_angle_deg.to_radians());
        turn_length_m(vehicle, &glide(vehicle, condition, Scale::NetMass(net_mass_kg))?)
    };
    Ok([length(-middle(envelope.dive_deg), net_mass_kg)?, length(middle(envelope.climb_deg), -net_mass_kg)?])
}

/// Way through the water by which the heading lags, after a step of μ, behind a turn that had its steady rate at once, m.
///
/// For ẋ = A x + b μ and the yaw rate c·x the step response is c A⁻¹ (exp(A t) − 1) b; what it lacks to its end adds up to
/// c A⁻² b, over the end's −c A⁻¹ b.
fn turn_length_m(vehicle: &Vehicle, glide: &Glide) -> Result<f64, String> {
    let rows = modes(vehicle, glide, RollKinematics::Exact)?.lateral.matrix;
    let a = Matrix4::from(rows).transpose();
    let plant = Plant::<f64>::new(vehicle);
    let rate = |mu_rad: f64| {
        let rates =
            plant.derivative_driven(&State { mu_rad: glide.mu_rad + mu_rad, ..glide.state() }, 0.0, &plant.still());
        Vector4::new(rates.velocity_m_s.y, rates.rate_rad_s.x, rates.rate_rad_s.z, 0.0)
    };
    let b = (rate(SMALL_MU_RAD) - rate(-SMALL_MU_RAD)) / (2.0 * SMALL_MU_RAD);
    let solve = |x: &Vector4<f64>| a.lu().solve(x);
    let once = solve(&b).ok_or_else(|| format!("{}: its turns do not settle", vehicle.name))?;
    let twice = solve(&once).ok_or_else(|| format!("{}: its turns do not settle", vehicle.name))?;
    Ok(-glide.speed_m_s * twice.z / once.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plant::{Particle, euler_from_quaternion, rk4_step};

    /// The full plant after a step of μ by 1°: once its turn is steady, its heading is behind by the turn length. 5 %: the
    /// pitch gives way a little.
    #[test]
    fn the_plants_heading_lags_by_the_turn_length() {
        const STEP_S: f64 = 0.05;
        const STEPS: i32 = 2_400;
        let vehicle = Vehicle::load("slocum-paper").unwrap();
        let condition = Condition::PathAngle(-26_f64.to_radians());
        let glide = glide(&vehicle, condition, Scale::NetMass(0.25)).unwrap();
        let plant = Plant::<f64>::new(&vehicle);
        let heading = |state: &State<f64>| euler_from_quaternion(&state.quaternion).z;
        let locked = Particle::Driven { u_b_m3_s: 0.0 };
        let advance = |state: &State<f64>| rk4_step(&plant, state, &locked, STEP_S, &plant.still());
        let mut state = State { mu_rad: 1_f64.to_radians(), ..glide.state() };
        for _ in 0..STEPS {
            state = advance(&state);
        }
        let turn_rate_rad_s = (heading(&advance(&state)) - heading(&state)) / STEP_S;
        let lag_s = STEP_S * f64::from(STEPS) - heading(&state) / turn_rate_rad_s;
        let length_m = turn_length_m(&vehicle, &glide).unwrap();
        assert!((lag_s * glide.speed_m_s / length_m - 1.0).abs() < 0.05, "{lag_s} s, {length_m} m");
    }
}
