//! What the controller reads, in device integers, and the scale factors of all of them.
//!
//! A simulated sensor, a driver and a frame on the wire all deliver these same integers, so the controller cannot tell them
//! apart. Integers are exact: they print, hash and replay to the same bits everywhere.

use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

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
