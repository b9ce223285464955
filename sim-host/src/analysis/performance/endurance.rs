//! How far and how long a battery lasts: the paper's ideal account, and a realistic one beside it.
//!
//! Ideal (section 4.2.1 of the paper): the lung's whole stroke against the pressure at depth, from an energy that does nothing
//! else; no pump losses, no hotel load, water of one density, inflections that take no time. Range and endurance then do not
//! depend on depth, but for the last dive that the battery does not pay for.

use serde::Serialize;

use super::{DiveEnergy, Size, Sizing, Yo};
use crate::analysis::trim::{Condition, Scale, glide};
use crate::model::{coefficients::Shape, ocean::Ocean};

/// Dives that a battery pays for.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Account {
    /// Of one dive and climb, m.
    pub dive_distance_m: f64,
    /// Of one dive and climb, s.
    pub dive_duration_s: f64,
    /// Of one dive and climb, J.
    pub dive_energy_j: f64,
    /// Whole dives.
    pub dives: f64,
    /// m.
    pub range_m: f64,
    /// s.
    pub endurance_s: f64,
}

/// What a dive really takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Realistic {
    /// Dives that the battery pays for.
    #[serde(flatten)]
    pub account: Account,
    /// Slowest speed of the glides, m/s.
    pub slowest_m_s: f64,
    /// Fastest speed of the glides, m/s.
    pub fastest_m_s: f64,
    /// Inflections of one dive, s.
    pub inflections_s: f64,
    /// Ideal work of the pump over its electrical energy.
    pub pump_efficiency: f64,
    /// Where the energy of one dive goes.
    pub energy: DiveEnergy,
}

/// Both accounts of yos at the flattest glide.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Endurance {
    /// From the surface down to, m.
    pub depth_m: f64,
    /// J.
    pub battery_j: f64,
    /// What the speed takes.
    pub size: Size,
    /// The paper's.
    pub ideal: Account,
    /// The vehicle's, where its file says enough and it can fly there.
    pub realistic: Option<Realistic>,
    /// What stands against flying it, or why there is no realistic account.
    pub warnings: Vec<String>,
}

impl Account {
    fn new(dive_distance_m: f64, dive_duration_s: f64, dive_energy_j: f64, battery_j: f64) -> Self {
        let dives = (battery_j / dive_energy_j).floor();
        let (range_m, endurance_s) = (dives * dive_distance_m, dives * dive_duration_s);
        Self { dive_distance_m, dive_duration_s, dive_energy_j, dives, range_m, endurance_s }
    }

    /// Δx = 2z/tan γ, ΔT = 2z/(V sin γ), ΔE = ρgz · 2η/(1 + η) · (π/4) l³/f², which is 2zΔW.
    #[must_use]
    pub fn ideal(size: &Size, depth_m: f64, battery_j: f64, gravity_m_s2: f64) -> Self {
        let sink_m_s = size.speed_m_s * libm::sin(size.glide.descent_rad);
        let energy_j = 2.0 * depth_m * size.net_mass_kg * gravity_m_s2;
        Self::new(2.0 * depth_m * size.glide.lift_to_drag, 2.0 * depth_m / sink_m_s, energy_j, battery_j)
    }
}

impl Endurance {
    /// Of a shape at the flattest glide and a speed, in an ocean.
    ///
    /// # Errors
    /// One line: depth, battery or speed not positive, or as [`Sizing::at_speed`].
    pub fn new(
        sizing: &Sizing<'_>,
        shape: &Shape,
        (speed_m_s, depth_m, battery_j): (f64, f64, f64),
        ocean: &Ocean,
    ) -> Result<Self, String> {
        for (what, value) in [("speed", speed_m_s), ("depth", depth_m), ("battery", battery_j)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(format!("{what} {value}: must be positive"));
            }
        }
        let size = sizing.at_speed(shape, speed_m_s)?;
        let ideal = Account::ideal(&size, depth_m, battery_j, sizing.study.vehicle.water.gravity_m_s2);
        let mut warnings = Vec::new();
        let realistic = match realistic(sizing, shape, (speed_m_s, depth_m, battery_j), ocean) {
            Ok((realistic, of_the_glide)) => {
                warnings.extend(of_the_glide);
                Some(realistic)
            }
            Err(reason) => {
                warnings.push(format!("no realistic account: {reason}"));
                None
            }
        };
        Ok(Self { depth_m, battery_j, size, ideal, realistic, warnings })
    }
}

fn realistic(
    sizing: &Sizing<'_>,
    shape: &Shape,
    (speed_m_s, depth_m, battery_j): (f64, f64, f64),
    ocean: &Ocean,
) -> Result<(Realistic, Vec<String>), String> {
    let vehicle = sizing.study.vehicle(shape, speed_m_s, 0.0)?;
    let glide = glide(&vehicle, Condition::MinGlideAngle, Scale::Speed(speed_m_s))?;
    let yo = Yo::new(&vehicle, &glide, ocean, [0.0, depth_m])?;
    let mut warnings = glide.warnings.clone();
    if let Some(limits) = vehicle.limits.as_ref().filter(|limits| depth_m > limits.working_depth_m) {
        warnings.push(format!("depth {depth_m} m is beyond the working depth, {} m", limits.working_depth_m));
    }
    let realistic = Realistic {
        account: Account::new(yo.distance_m, yo.duration_s, yo.energy.total_j(), battery_j),
        slowest_m_s: yo.slowest_m_s,
        fastest_m_s: yo.fastest_m_s,
        inflections_s: yo.inflections_s,
        pump_efficiency: yo.pump_efficiency,
        energy: yo.energy,
    };
    Ok((realistic, warnings))
}
