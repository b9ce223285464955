//! What the controller reads and what it orders, in device integers.
//!
//! A simulated sensor, a driver and a frame on the wire all deliver these same integers, so the controller cannot tell them
//! apart. Integers are exact: they print, hash and replay to the same bits everywhere.

use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

use crate::{guidance::Aim, mission::Phase, supervisor::Abort};

/// Ticks per second of [`crate::autopilot::Autopilot::step`].
pub const TICK_HZ: u32 = 4;
/// Duration of one tick, s.
pub const TICK_S: f32 = 0.25;

/// Micrometres per metre: `r_px_um`.
pub const UM_PER_M: f32 = 1e6;
/// Microlitres per cubic metre: `vbd_ul`.
pub const UL_PER_M3: f32 = 1e9;
/// Radians per hundredth of a degree: every `_cdeg`.
pub const RAD_PER_CDEG: f32 = core::f32::consts::PI / 18_000.0;
/// Millimetres per metre: long-lived positions and depths.
pub const MM_PER_M: f32 = 1e3;
/// A full turn in hundredths of a degree.
pub const TURN_CDEG: i32 = 36_000;

/// Everything the controller knows about the world at one tick.
///
/// `None` means that the device gave nothing fresh since the last tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Measurements {
    /// Pressure above the air's at the centre of buoyancy, Pa.
    pub pressure_pa: Option<i32>,
    /// What the attitude and heading reference says.
    pub attitude: Option<Attitude>,
    /// Axial position of the moving mass, µm forward of the centre of buoyancy.
    pub r_px_um: i32,
    /// Rotation of the moving mass, 0.01°, positive to the left.
    pub mu_cdeg: i16,
    /// Volume of the variable buoyancy device beyond neutral, µl.
    pub vbd_ul: i32,
    /// Battery voltage at the terminals, under whatever load there is, mV.
    pub battery_mv: Option<u16>,
    /// Charge drawn from the battery since it was full, mC.
    pub charge_mc: Option<i64>,
    /// Height above the sea floor, mm; none without an echo.
    pub altitude_mm: Option<i32>,
    /// Voltage of the leak detector, mV: high while dry.
    pub leak_mv: Option<u16>,
    /// Air pressure less the pressure in the hull, Pa.
    pub vacuum_pa: Option<i32>,
    /// A position fix, only with the antenna in air.
    pub gps: Option<GpsFix>,
    /// The modem has a link to shore, only with the antenna in air.
    pub modem_up: bool,
}

impl Measurements {
    /// Not a word from any instrument; actuators at zero. What a board has no device for stays so.
    #[must_use]
    pub const fn silent() -> Self {
        Self {
            pressure_pa: None,
            attitude: None,
            r_px_um: 0,
            mu_cdeg: 0,
            vbd_ul: 0,
            battery_mv: None,
            charge_mc: None,
            altitude_mm: None,
            leak_mv: None,
            vacuum_pa: None,
            gps: None,
            modem_up: false,
        }
    }
}

/// Attitude and body rates, 0.01° and 0.01 °/s.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Attitude {
    /// Right wing down, 0.01°.
    pub roll_cdeg: i16,
    /// Nose up, 0.01°.
    pub pitch_cdeg: i16,
    /// Clockwise from true north, 0.01°, 0 to 35999.
    pub heading_cdeg: u16,
    /// Pitch rate about the body's right axis, 0.01 °/s.
    pub pitch_rate_cdeg_s: i16,
    /// Yaw rate about the body's down axis, 0.01 °/s.
    pub yaw_rate_cdeg_s: i16,
}

/// A position on the WGS84 ellipsoid.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct GpsFix {
    /// Latitude, 1e-7°, north positive.
    pub lat_e7: i32,
    /// Longitude, 1e-7°, east positive.
    pub lon_e7: i32,
}

/// Everything the controller orders at one tick, and what it thinks it is doing.
///
/// Rates hold until the next tick; zero means stop and brake.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Commands {
    /// Speed of the moving mass along the axis, µm/s, forward positive.
    pub r_px_rate_um_s: i32,
    /// Rotation speed of the moving mass, 0.01 °/s, positive to the left.
    pub mu_rate_cdeg_s: i16,
    /// Flow into the variable buoyancy device, µl/s: pump positive, bleed negative.
    pub vbd_rate_ul_s: i32,
    /// The phase that these commands belong to.
    pub phase: Phase,
    /// The dive cycle under way, from 1; 0 before the first.
    pub yo: u16,
    /// Why the mission ended early, if it did.
    pub abort: Option<Abort>,
    /// Pitch that is aimed at, 0.01°.
    pub target_pitch_cdeg: i16,
    /// Heading that is aimed at, 0.01°, 0 to 35999.
    pub target_heading_cdeg: u16,
    /// What that heading is for.
    pub aim: Aim,
    /// Dead-reckoned position north of the mission's origin, mm.
    pub north_mm: i32,
    /// Dead-reckoned position east of the mission's origin, mm.
    pub east_mm: i32,
    /// What was learned so far.
    pub learned: Learned,
}

/// What the controller has learned of vehicle and water: all zero at first.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Learned {
    /// Weight beyond what the buoyancy device says, g, positive sinks.
    pub weight_g: i16,
    /// Drag beyond the vehicle file's, 0.1 %.
    pub drag_permille: i16,
    /// Current towards the north, mm/s.
    pub current_north_mm_s: i16,
    /// Current towards the east, mm/s.
    pub current_east_mm_s: i16,
    /// Speed through the water beyond what is reckoned, 0.1 %.
    pub speed_permille: i16,
    /// True heading less the compass's, as the vehicle's table corrects it, 0.01°.
    pub compass_cdeg: i16,
    /// Turn rate without rotation of the mass on this side, 0.001 °/s, right positive.
    pub turn_bias_mdeg_s: i16,
    /// Correction of the axial position on this side, µm.
    pub trim_um: i32,
}

impl Commands {
    /// All motors stopped and braked, before anything is known.
    #[must_use]
    pub const fn safe() -> Self {
        Self {
            r_px_rate_um_s: 0,
            mu_rate_cdeg_s: 0,
            vbd_rate_ul_s: 0,
            phase: Phase::Surface,
            yo: 0,
            abort: None,
            target_pitch_cdeg: 0,
            target_heading_cdeg: 0,
            aim: Aim::Heading,
            north_mm: 0,
            east_mm: 0,
            learned: Learned {
                weight_g: 0,
                drag_permille: 0,
                current_north_mm_s: 0,
                current_east_mm_s: 0,
                speed_permille: 0,
                compass_cdeg: 0,
                turn_bias_mdeg_s: 0,
                trim_um: 0,
            },
        }
    }
}
