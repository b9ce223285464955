//! What the controller must know of the vehicle it flies.

use heapless::String;
use serde::{Deserialize, Serialize};

use crate::device::UL_PER_M3;
use crate::math;
use crate::model::compass::Compass;

/// Constants of one vehicle, written into its trim table by the generator and never typed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FlightVehicle {
    /// Fingerprint of the whole vehicle file's values.
    pub hash: u64,
    /// The vehicle's name, for people.
    pub name: String<32>,
    /// Water in which `vbd_ul = 0` is neutral, kg/m³.
    pub density_kg_m3: f32,
    /// Acceleration of gravity, m/s².
    pub gravity_m_s2: f32,
    /// Drives of mass and buoyancy.
    pub actuators: Actuators,
    /// What they draw.
    pub power: MotorPower,
    /// Depth to which missions may be planned, mm.
    pub working_depth_mm: i32,
    /// Longitudinal flight dynamics, for the reduced model.
    pub glide: GlideConstants,
    /// Rotation of the mass per heading error from which on a loop that looks every
    /// [`GAIN_PERIOD_S`](crate::control::heading::GAIN_PERIOD_S) swings ever more, at the corners of the table:
    /// `[dives, climbs][flattest, steepest][least, most net mass]`; 0 where the loop settles with no gain.
    pub critical_heading_gain: [[[f32; 2]; 2]; 2],
    /// How the moving battery deflects the compass.
    pub compass: Compass,
}

impl FlightVehicle {
    /// Net mass in the water of `density_kg_m3`, kg, positive sinks.
    #[must_use]
    pub fn net_mass_kg(&self, vbd_ul: i32) -> f32 {
        -self.density_kg_m3 * (vbd_ul as f32 / UL_PER_M3)
    }

    /// Net mass in water of some density, the vehicle being neutral with `vbd_ul = 0` in that of `density_kg_m3`, kg.
    #[must_use]
    pub fn net_mass_in_kg(&self, vbd_ul: i32, density_kg_m3: f32) -> f32 {
        let thinner = 1.0 - density_kg_m3 / self.density_kg_m3;
        self.glide.mass_kg * thinner - density_kg_m3 * (vbd_ul as f32 / UL_PER_M3)
    }

    /// Weight of the water that the vehicle is ballasted for, N/m³.
    #[must_use]
    pub fn weight_density_n_m3(&self) -> f32 {
        self.density_kg_m3 * self.gravity_m_s2
    }

    /// Volume of the buoyancy device for a net mass given in g, µl.
    #[must_use]
    pub fn vbd_ul(&self, net_mass_g: i16) -> i32 {
        const KG_PER_G: f32 = 1e-3;
        math::round_to_i32(-f32::from(net_mass_g) * KG_PER_G / self.density_kg_m3 * UL_PER_M3)
    }
}

/// Ranges and rates of the three actuators.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Actuators {
    /// Axial travel of the moving mass.
    pub r_px_um: Range,
    /// Rotation of the moving mass.
    pub mu_cdeg: Range,
    /// Volume of the buoyancy device.
    pub vbd_ul: Range,
    /// Fastest axial motion, µm/s.
    pub r_px_rate_um_s: i32,
    /// Fastest rotation, 0.01 °/s.
    pub mu_rate_cdeg_s: i32,
    /// Fastest pumping, µl/s (makes the vehicle lighter).
    pub pump_rate_ul_s: i32,
    /// Fastest bleeding, µl/s (makes the vehicle heavier).
    pub bleed_rate_ul_s: i32,
}

/// What each motor draws at most, and what the supply bears, mW.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct MotorPower {
    /// Axial drive of the moving mass.
    pub r_px_mw: u32,
    /// Its rotation drive.
    pub mu_mw: u32,
    /// Pump, against any pressure that the hull bears.
    pub pump_mw: u32,
    /// What draws a piston back or holds a valve open.
    pub bleed_mw: u32,
    /// Most that motors may draw together; nothing: no limit.
    pub peak_mw: Option<u32>,
}

impl MotorPower {
    /// What the axial drive, the buoyancy device and the rotation drive draw at some rates, in this order, mW.
    #[must_use]
    pub const fn draws_mw(&self, [r_px_rate, vbd_rate, mu_rate]: [i32; 3]) -> [u32; 3] {
        let buoyancy_mw = if vbd_rate > 0 { self.pump_mw } else { self.bleed_mw };
        [
            if r_px_rate == 0 { 0 } else { self.r_px_mw },
            if vbd_rate == 0 { 0 } else { buoyancy_mw },
            if mu_rate == 0 { 0 } else { self.mu_mw },
        ]
    }

    /// Whether the axial drive must stand while the buoyancy device runs at some rate.
    #[must_use]
    pub fn bears_no_pitching_at(&self, vbd_rate: i32) -> bool {
        let [r_px_mw, vbd_mw, _] = self.draws_mw([1, vbd_rate, 0]);
        self.peak_mw.is_some_and(|peak_mw| r_px_mw.saturating_add(vbd_mw) > peak_mw)
    }
}

/// A closed range of device integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Range {
    /// Smallest value.
    pub min: i32,
    /// Largest value.
    pub max: i32,
}

impl Range {
    /// The nearest value inside the range.
    #[must_use]
    pub const fn clamp(self, value: i32) -> i32 {
        if value < self.min {
            self.min
        } else if value > self.max {
            self.max
        } else {
            value
        }
    }
}

/// Constants of the reduced model (K-form: ½ρS is folded in, at the density of the vehicle file).
///
/// Lift is `(lift_zero + lift_alpha α + lift_rate q) V²`, drag is `drag_zero V² + drag_induced L²/V²`, both in newtons with V in m/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GlideConstants {
    /// Mass, kg.
    pub mass_kg: f32,
    /// Mass with the added mass along b1, kg.
    pub mass_u_kg: f32,
    /// Mass with the added mass along b3, kg.
    pub mass_w_kg: f32,
    /// Drag at zero lift over V², N s²/m².
    pub drag_zero: f32,
    /// Induced drag times V² over lift², m²/(N s²).
    pub drag_induced: f32,
    /// Lift at zero angle of attack over V², N s²/m².
    pub lift_zero: f32,
    /// Lift slope over V², N s²/(m² rad).
    pub lift_alpha: f32,
    /// Lift by pitch rate over V², N s²/m² per rad/s.
    pub lift_rate: f32,
    /// Forward momentum per pitch rate, kg m: masses below the centre of buoyancy, and added mass.
    pub surge_coupling_kg_m: f32,
    /// Upward momentum per pitch rate with the moving mass centred, kg m: masses forward of it, and added mass.
    pub heave_coupling_kg_m: f32,
    /// The moving mass, kg: its place adds to the upward momentum.
    pub moving_mass_kg: f32,
    /// Way through the water in which a turn sets in, on dives and on climbs, m.
    pub turn_length_m: [f32; 2],
}
