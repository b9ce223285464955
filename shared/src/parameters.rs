//! Tuning of the controller: each parameter with its unit, bounds and default.

use postcard_schema::Schema;
use serde::{Deserialize, Serialize};

/// One row of the parameter table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    /// Name, unit included.
    pub name: &'static str,
    /// What it does.
    pub about: &'static str,
    /// Smallest value allowed.
    pub min: i32,
    /// Largest value allowed.
    pub max: i32,
    /// Value unless told otherwise.
    pub default: i32,
}

macro_rules! parameters {
    ($($(#[doc = $about:literal])+ $name:ident: $min:literal ..= $max:literal, $default:literal;)+) => {
        /// Tuning of the controller; [`ROWS`] has bounds and defaults.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, Schema)]
        #[serde(default, deny_unknown_fields)]
        pub struct Parameters {
            $($(#[doc = $about])+ pub $name: i32,)+
        }

        impl Default for Parameters {
            fn default() -> Self {
                Self { $($name: $default,)+ }
            }
        }

        /// Bounds and defaults, in the order of the fields.
        pub const ROWS: &[Row] = &[
            $(Row { name: stringify!($name), about: concat!($($about),+), min: $min, max: $max, default: $default },)+
        ];

        impl Parameters {
            /// The values, in the order of [`ROWS`].
            pub fn values(&self) -> impl Iterator<Item = i32> {
                [$(self.$name),+].into_iter()
            }
        }
    };
}

parameters! {
    /// Pitch error that is left alone, 0.01°.
    pitch_deadband_cdeg: 10..=1_000, 100;
    /// Part of a pitch error that one correction takes away, %.
    pitch_gain_percent: 0..=150, 60;
    /// Time between two pitch corrections, s.
    pitch_period_s: 2..=300, 40;
    /// Largest correction of the axial position that pitch errors may build up to, µm.
    pitch_trim_limit_um: 0..=100_000, 40_000;
    /// Heading error that is left alone, 0.01°.
    heading_deadband_cdeg: 10..=3_000, 200;
    /// Time in which a heading error shall be gone, s; 0: as short as the gain margin allows, by the trim table.
    heading_time_s: 0..=600, 0;
    /// Time between two heading corrections, s.
    heading_period_s: 1..=300, 8;
    /// Largest rotation of the mass for a turn, 0.01°.
    mu_limit_cdeg: 100..=9_000, 4_500;
    /// Change of rotation too small to move for, 0.01°.
    mu_deadband_cdeg: 10..=3_000, 600;
    /// Largest turn rate without rotation that may be learned, 0.001 °/s.
    turn_bias_limit_mdeg_s: 0..=2_000, 300;
    /// Pitch held while the buoyancy reverses at depth, 0.01° nose down.
    apogee_pitch_cdeg: 0..=2_000, 500;
    /// Distance from a target at which a buoyancy move counts as finished, µl.
    vbd_deadband_ul: 100..=50_000, 2_000;
    /// Distance from a target at which an axial move counts as finished, µm.
    r_px_deadband_um: 50..=10_000, 1_000;
    /// Mean density of the water down to the dive's depth, kg/m³: pressure becomes depth with it. Below 900: the vehicle file's.
    water_density_kg_m3: 0..=1_300, 0;
    /// Largest weight error that may be learned from the depth rate, g.
    buoyancy_limit_g: 0..=2_000, 150;
    /// Largest change of drag that may be learned from dives and climbs, %.
    drag_limit_percent: 0..=100, 50;
    /// Fastest current that may be learned from position fixes, each way, mm/s.
    current_limit_mm_s: 0..=5_000, 1_500;
    /// Largest error of speed that may be learned from position fixes, %.
    speed_limit_percent: 0..=50, 20;
    /// Largest error of the compass that may be learned from position fixes, 0.01°.
    compass_limit_cdeg: 0..=3_000, 1_000;
    /// Time without a fresh depth after which the mission ends, s.
    stale_depth_s: 5..=3_600, 60;
    /// Time without a fresh attitude after which the mission ends, s.
    stale_attitude_s: 5..=3_600, 120;
    /// Consecutive samples beyond a limit after which leak, vacuum, voltage or charge end the mission.
    abort_samples: 1..=1_000, 10;
    /// Voltage below which the leak detector counts as wet, mV.
    leak_mv: 0..=5_000, 2_000;
    /// Least vacuum in the hull, Pa (default: 4 inHg).
    vacuum_min_pa: -100_000..=100_000, 13_546;
    /// Most vacuum in the hull, Pa (default: 12 inHg).
    vacuum_max_pa: -100_000..=100_000, 40_637;
    /// Battery voltage below which the mission ends, mV.
    undervolts_mv: 0..=60_000, 10_000;
    /// Charge of the full battery, C; 0 if it is not known.
    battery_capacity_c: 0..=10_000_000, 0;
    /// Part of the battery's charge below which the mission ends, %.
    low_charge_percent: 0..=90, 10;
    /// Time under way without a change of depth after which the mission ends, s.
    no_motion_s: 30..=7_200, 900;
    /// Change of depth that counts as motion, mm.
    no_motion_mm: 100..=50_000, 3_000;
    /// Time for which the vehicle does not rise though light, or not sink though heavy, after which the mission ends, s.
    against_model_s: 10..=3_600, 60;
    /// Consecutive echoes of a floor that is too near after which a dive ends.
    altitude_samples: 1..=100, 3;
}

impl Parameters {
    /// The first value outside its bounds, if there is one.
    #[must_use]
    pub fn first_invalid(&self) -> Option<(&'static Row, i32)> {
        ROWS.iter().zip(self.values()).find(|(row, value)| !(row.min..=row.max).contains(value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_within_bounds() {
        assert_eq!(Parameters::default().first_invalid(), None);
    }

    #[test]
    fn a_value_out_of_bounds_is_named() {
        let bad = Parameters { pitch_period_s: 0, ..Parameters::default() };
        assert_eq!(bad.first_invalid().map(|(row, value)| (row.name, value)), Some(("pitch_period_s", 0)));
    }
}
