//! Steady straight glides: wings level from the polar (section 7 of the equations), or exact and banked.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Vector3, Vector4};
use serde::Serialize;

pub use crate::analysis::helix::Scale;
use crate::analysis::{
    helix::{Helix, HelixSolver, Slope, Turn},
    performance::{Polar, PolarPoint},
};
use crate::model::{
    plant::{Plant, State, quaternion_from_euler},
    vehicle::Vehicle,
};

/// Force and moment that rounding leaves, over the net weight.
const ROUNDING: f64 = 1e-9;

/// Which glide is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Condition {
    /// Path angle γ, rad, climbing positive.
    PathAngle(f64),
    /// The dive that goes farthest per time.
    MaxHorizontalSpeed,
    /// The flattest dive.
    MinGlideAngle,
}

/// A steady straight glide: wings level, or banked if the vehicle is not symmetric.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Glide {
    /// V, m/s.
    pub speed_m_s: f64,
    /// γ, rad, climbing positive.
    pub path_angle_rad: f64,
    /// α, rad.
    pub alpha_rad: f64,
    /// β, rad; 0 for a symmetric vehicle.
    pub beta_rad: f64,
    /// φ, rad, right wing down; 0 for a symmetric vehicle.
    pub phi_rad: f64,
    /// θ, rad; γ + α for a symmetric vehicle.
    pub pitch_rad: f64,
    /// m̃, kg, positive sinks.
    pub net_mass_kg: f64,
    /// Axial position of the moving mass, m.
    pub r_px_m: f64,
    /// μ, rad, positive to the left; 0 for a symmetric vehicle.
    pub mu_rad: f64,
    /// V_d, m³.
    pub displaced_volume_m3: f64,
    /// C_L.
    pub lift_coefficient: f64,
    /// C_D.
    pub drag_coefficient: f64,
    /// What stands against flying it: limits of the actuators, lack of symmetry.
    pub warnings: Vec<String>,
}

/// The straight glide of a vehicle in the water of its static analyses.
///
/// Of the two glides at one path angle it gives the one with the smaller |α|. A vehicle that wings level leave out of balance
/// (it is not symmetric, or its flow separates) gets the glide of the full equations at the same path angle, which for
/// [`Condition::MaxHorizontalSpeed`] and [`Condition::MinGlideAngle`] is still the polar's.
///
/// # Errors
/// One line that says which input cannot be met, and the nearest that can.
pub fn glide(vehicle: &Vehicle, condition: Condition, scale: Scale) -> Result<Glide, String> {
    let plant = Plant::new(vehicle);
    let mut glide = wings_level(vehicle, condition, scale)?;
    if !is_balanced(vehicle, &plant, &glide) {
        glide = exact(vehicle, &plant, &glide, scale)?;
    }
    glide.warnings = warnings(vehicle, &glide);
    Ok(glide)
}

/// The wings-level glide by the polar of attached flow, whether or not it leaves something out of balance.
///
/// # Errors
/// As [`glide`].
pub(crate) fn wings_level(vehicle: &Vehicle, condition: Condition, scale: Scale) -> Result<Glide, String> {
    let (hydro, polar) = (&vehicle.hydrodynamics, Polar::from(&vehicle.hydrodynamics));
    let (point, path_angle_rad) = match condition {
        Condition::PathAngle(path_angle_rad) => {
            (polar.at(lift_at_path_angle(vehicle, path_angle_rad)?), path_angle_rad)
        }
        Condition::MaxHorizontalSpeed => (polar.max_horizontal_speed(), -polar.max_horizontal_speed().descent_rad),
        Condition::MinGlideAngle => (polar.best_glide(), -polar.best_glide().descent_rad),
    };
    let PolarPoint { lift_coefficient, drag_coefficient, .. } = point;
    if !lift_coefficient.is_finite() {
        return Err(format!("{}: without induced drag there is no flattest glide", vehicle.name));
    }
    let sinking = -path_angle_rad.signum();
    let (speed_m_s, net_mass_kg) =
        speed_and_net_mass(vehicle, libm::hypot(lift_coefficient, drag_coefficient), sinking, scale)?;
    let alpha_rad = (lift_coefficient - hydro.c_l_zero) / hydro.c_l_alpha;
    let plant = Plant::new(vehicle);
    let mut glide = Glide {
        speed_m_s,
        path_angle_rad,
        alpha_rad,
        beta_rad: 0.0,
        phi_rad: 0.0,
        pitch_rad: path_angle_rad + alpha_rad,
        net_mass_kg,
        r_px_m: 0.0,
        mu_rad: 0.0,
        displaced_volume_m3: plant.displaced_volume_m3(net_mass_kg),
        lift_coefficient,
        drag_coefficient,
        warnings: Vec::new(),
    };
    glide.r_px_m = balancing_r_px_m(&plant, &glide);
    Ok(glide)
}

/// The straight glide of the full equations: path angle and scale as asked; bank, sideslip and μ whatever they must be.
fn exact(vehicle: &Vehicle, plant: &Plant<f64>, level: &Glide, scale: Scale) -> Result<Glide, String> {
    let (solver, near) = (HelixSolver::new(vehicle), Helix::from(level));
    let slope = Slope::PathAngle(level.path_angle_rad);
    let solve = |near: &Helix, turn: Turn| solver.solve_at(scale, near, slope, turn);
    let helix = solve(&near, Turn::Rate(0.0)).or_else(|failure| {
        // Perhaps it can be led there from the turn that it makes with the mass hanging straight down.
        let turning = solve(&near, Turn::Mu(0.0)).map_err(|_| failure)?;
        solve(&turning, Turn::Rate(0.0))
    });
    let helix = helix.map_err(|failure| format!("{}: {failure}", vehicle.name))?;
    if helix.roll_rad.abs() >= FRAC_PI_2 {
        return Err(format!("{}: glides straight only upside down, with {helix}", vehicle.name));
    }
    let viscous = plant.viscous_in(&helix.state(plant));
    Ok(Glide {
        speed_m_s: helix.speed_m_s,
        path_angle_rad: level.path_angle_rad,
        alpha_rad: helix.alpha_rad,
        beta_rad: helix.beta_rad,
        phi_rad: helix.roll_rad,
        pitch_rad: helix.pitch_rad,
        net_mass_kg: helix.net_mass_kg,
        r_px_m: helix.r_px_m,
        mu_rad: helix.mu_rad,
        displaced_volume_m3: plant.displaced_volume_m3(helix.net_mass_kg),
        lift_coefficient: viscous.lift_coefficient,
        drag_coefficient: viscous.drag_coefficient,
        warnings: Vec::new(),
    })
}

impl Glide {
    /// The glide as a state of the plant, heading north, at some depth.
    #[must_use]
    pub fn state(&self) -> State<f64> {
        let quaternion: Vector4<f64> = quaternion_from_euler(&Vector3::new(self.phi_rad, self.pitch_rad, 0.0));
        let (sin_alpha, cos_alpha) = libm::sincos(self.alpha_rad);
        let (sin_beta, cos_beta) = libm::sincos(self.beta_rad);
        State {
            quaternion,
            velocity_m_s: Vector3::new(cos_alpha * cos_beta, sin_beta, sin_alpha * cos_beta) * self.speed_m_s,
            r_px_m: self.r_px_m,
            mu_rad: self.mu_rad,
            ..State::at_rest(self.displaced_volume_m3)
        }
    }
}

impl From<&Glide> for Helix {
    fn from(glide: &Glide) -> Self {
        Self {
            net_mass_kg: glide.net_mass_kg,
            speed_m_s: glide.speed_m_s,
            alpha_rad: glide.alpha_rad,
            beta_rad: glide.beta_rad,
            roll_rad: glide.phi_rad,
            pitch_rad: glide.pitch_rad,
            r_px_m: glide.r_px_m,
            mu_rad: glide.mu_rad,
            turn_rate_rad_s: 0.0,
        }
    }
}

/// Roots of K C_L² + C_L tanγ + C_D0 = 0; the one with the smaller |α|.
fn lift_at_path_angle(vehicle: &Vehicle, path_angle_rad: f64) -> Result<f64, String> {
    let hydro = &vehicle.hydrodynamics;
    let tangent = libm::tan(path_angle_rad);
    let discriminant = tangent * tangent - 4.0 * hydro.c_d_induced * hydro.c_d_zero;
    let upright = path_angle_rad != 0.0 && path_angle_rad.abs() <= FRAC_PI_2;
    if !upright || discriminant.is_nan() || discriminant < 0.0 {
        let flattest = libm::atan(2.0 * (hydro.c_d_induced * hydro.c_d_zero).sqrt()).to_degrees();
        return Err(format!(
            "path angle {:.4}°: {} glides between {flattest:.4}° and 90°, down (−) or up (+)",
            path_angle_rad.to_degrees(),
            vehicle.name
        ));
    }
    // The form without cancellation for the root near zero, then its partner.
    let sum = -tangent - tangent.signum() * discriminant.sqrt();
    let roots = [2.0 * hydro.c_d_zero / sum, sum / (2.0 * hydro.c_d_induced)];
    let size = |lift: &f64| (lift - hydro.c_l_zero).abs();
    Ok(if size(&roots[0]) <= size(&roots[1]) { roots[0] } else { roots[1] })
}

/// ½ρV²S √(C_L² + C_D²) = |m̃| g.
fn speed_and_net_mass(vehicle: &Vehicle, resultant: f64, sinking: f64, scale: Scale) -> Result<(f64, f64), String> {
    let per_speed_squared = 0.5 * vehicle.water.density_kg_m3 * vehicle.hydrodynamics.area_m2 * resultant;
    let (speed_m_s, net_mass_kg) = match scale {
        Scale::Speed(speed_m_s) if speed_m_s.is_finite() && speed_m_s > 0.0 => {
            (speed_m_s, sinking * per_speed_squared * speed_m_s * speed_m_s / vehicle.water.gravity_m_s2)
        }
        Scale::Speed(speed_m_s) => return Err(format!("speed {speed_m_s} m/s: must be positive")),
        Scale::NetMass(net_mass_kg) if net_mass_kg.is_finite() && net_mass_kg * sinking > 0.0 => {
            ((net_mass_kg.abs() * vehicle.water.gravity_m_s2 / per_speed_squared).sqrt(), net_mass_kg)
        }
        Scale::NetMass(net_mass_kg) => {
            let right = if sinking > 0.0 { "positive to glide down" } else { "negative to glide up" };
            return Err(format!("net mass {net_mass_kg} kg: must be {right}"));
        }
    };
    // As much as it weighs in air would leave no volume; not finite is what overflowed.
    if net_mass_kg.is_finite() && net_mass_kg < vehicle.mass_kg() {
        Ok((speed_m_s, net_mass_kg))
    } else {
        let (name, mass_kg) = (&vehicle.name, vehicle.mass_kg());
        Err(format!(
            "speed {speed_m_s:?} m/s: takes a net mass of {net_mass_kg} kg, but {name} has only {mass_kg} kg in all"
        ))
    }
}

/// The axial position at which no pitching moment is left; the moment is linear in it.
fn balancing_r_px_m(plant: &Plant<f64>, glide: &Glide) -> f64 {
    let moment = |r_px_m: f64| plant.body_residual(&State { r_px_m, ..glide.state() })[4];
    let (centred, forward) = (moment(0.0), moment(1.0));
    centred / (centred - forward)
}

/// Whether nothing is left over. Not asked of the pitching moment: the mass takes it up, and a vertical glide has no place for it.
fn is_balanced(vehicle: &Vehicle, plant: &Plant<f64>, glide: &Glide) -> bool {
    let weight_n = glide.net_mass_kg.abs() * vehicle.water.gravity_m_s2;
    let mut residual = plant.body_residual(&glide.state());
    residual[4] = 0.0;
    residual.amax() <= ROUNDING * weight_n
}

fn warnings(vehicle: &Vehicle, glide: &Glide) -> Vec<String> {
    let degrees = f64::to_degrees;
    let mut warnings = Vec::new();
    let [aft, fore] = vehicle.moving_mass.travel_m;
    if !(aft..=fore).contains(&glide.r_px_m) {
        warnings.push(format!("r_px {:.4} m is beyond the travel of the moving mass, {aft} to {fore} m", glide.r_px_m));
    }
    let [right, left] = vehicle.moving_mass.roll_deg;
    if !(right..=left).contains(&degrees(glide.mu_rad)) {
        let mu_deg = degrees(glide.mu_rad);
        warnings.push(format!("mu {mu_deg:.2}° is beyond the rotation of the moving mass, {right} to {left}°"));
    }
    if let Some(buoyancy) = &vehicle.buoyancy {
        let volume = glide.displaced_volume_m3 - vehicle.neutral_volume_m3();
        let [least, most] = buoyancy.volume_m3;
        if !(least..=most).contains(&volume) {
            warnings.push(format!("volume {volume:.6} m³ is beyond the buoyancy engine, {least} to {most} m³"));
        }
    }
    if [glide.phi_rad, glide.beta_rad, glide.mu_rad] != [0.0; 3] {
        warnings.push(format!(
            "the vehicle is not symmetric: it glides straight with a bank of {:.3}°, a sideslip of {:.3}° and mu at {:.3}°",
            degrees(glide.phi_rad),
            degrees(glide.beta_rad),
            degrees(glide.mu_rad)
        ));
    }
    warnings
}
