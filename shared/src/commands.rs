//! What the controller orders, and what it tells: device integers again, and three small vocabularies.

use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

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

/// What the vehicle is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Phase {
    /// Afloat before the mission's first dive, antenna in air.
    Surface,
    /// Gliding down.
    Dive,
    /// Becoming light at depth, nearly level.
    Apogee,
    /// Gliding up.
    Climb,
    /// Becoming heavy at the top of a yo, nearly level.
    Crest,
    /// Last part of the way to the surface, fully light.
    Surfacing,
    /// Afloat after the last yo, antenna in air.
    Complete,
    /// Aborted: fully light, on the way to the surface or there.
    Recovery,
    /// Neutral and level at depth, carried by the water.
    Drift,
}

/// What a heading is for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Aim {
    /// A heading of the mission.
    #[default]
    Heading,
    /// This waypoint, from 1.
    Waypoint(u8),
    /// This waypoint, in a current that cannot be stemmed.
    UnstemmedWaypoint(u8),
    /// No place: a steady turn.
    Spiral,
    /// The station of the mooring.
    Station,
    /// The station, in a current that cannot be stemmed.
    UnstemmedStation,
}

/// Why a mission ended early (append only).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Abort {
    /// Deeper than the mission's abort depth.
    Overdepth,
    /// The mission took longer than its time allowed.
    MissionTimeout,
    /// No fresh depth for too long.
    StaleDepth,
    /// No fresh attitude for too long.
    StaleAttitude,
    /// The leak detector is wet.
    Leak,
    /// Too little vacuum in the hull, or too much.
    Vacuum,
    /// Too little battery voltage.
    Undervolts,
    /// Too little charge left in the battery.
    LowCharge,
    /// Under way, but neither sinking nor rising.
    NoVerticalMotion,
    /// Light and not rising, or heavy and not sinking, as the reduced model has it.
    AgainstModel,
}
