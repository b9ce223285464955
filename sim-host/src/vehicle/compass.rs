//! How the moving battery deflects the compass: a calibration of one vehicle, which `glider swing` finds.
//!
//! The optional section `[compass]` has `earth_ut` and `battery_ut`, and may have `offset_deg` and `turning_ut` (then 0). At
//! another place the battery's field is the same and the Earth's is not: `earth_ut` alone changes (World Magnetic Model).
//! Without the section the heading flies as the compass shows it.

use serde::Serialize;
use shared::compass::{AxialField, FIELD_STEP, MOST_POSITIONS};

use crate::toml_file::{Rule, Section};

/// Largest field of the battery over the Earth's: what the table can store; no compass serves beyond 1.
const MOST_OVER_EARTH: f64 = 3.0;

/// What the controller takes away from the compass's heading.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Compass {
    /// True heading less the compass's that nothing changes (its mounting), deg.
    pub offset_deg: f64,
    /// Horizontal part of the Earth's field where the vehicle flies, µT.
    pub earth_ut: f64,
    /// The battery's field with the mass hanging down, as (axial position in m, rising; ahead, right, below in µT).
    pub battery_ut: Vec<[f64; 4]>,
    /// The part of it that turns with the mass: right, below with the mass hanging down, µT.
    pub turning_ut: [f64; 2],
}

impl Compass {
    pub(super) fn read(section: &mut Section<'_>) -> Self {
        let read = Self {
            offset_deg: section.number_or("offset_deg", Rule::Within(-180.0, 180.0), 0.0),
            // At most 42 µT, near the magnetic equator; no compass serves where it is nearly vertical.
            earth_ut: section.number("earth_ut", Rule::Within(1.0, 45.0)),
            battery_ut: section.quadruples("battery_ut"),
            turning_ut: section.numbers_or("turning_ut", Rule::Finite, [0.0; 2]),
        };
        let rising = read.battery_ut.is_sorted_by(|[below, ..], [above, ..]| below < above);
        let wrong = !(1..=MOST_POSITIONS).contains(&read.battery_ut.len()) || !rising;
        let right =
            format!("1 to {MOST_POSITIONS} rows of [axial position in m, rising; field ahead, right, below in µT]");
        section.refuse_if(wrong, "battery_ut", &right);
        let most = format!("at most {MOST_OVER_EARTH} times earth_ut in each direction");
        let storable =
            |ut: &[f64]| read.earth_ut.is_nan() || ut.iter().all(|ut| ut.abs() <= MOST_OVER_EARTH * read.earth_ut);
        section.refuse_if(!read.battery_ut.iter().all(|[_, ut @ ..]| storable(ut)), "battery_ut", &most);
        section.refuse_if(!storable(&read.turning_ut), "turning_ut", &most);
        read
    }

    /// The same in the integers that fly.
    #[must_use]
    pub fn flown(&self) -> shared::compass::Compass {
        let steps = |ut: f64| (ut / self.earth_ut / f64::from(FIELD_STEP)).round() as i16;
        let row = |&[r_px_m, ahead, right, below]: &[f64; 4]| AxialField {
            r_px_um: (r_px_m * 1e6).round() as i32,
            field: [ahead, right, below].map(steps),
        };
        shared::compass::Compass {
            offset_cdeg: (self.offset_deg * 100.0).round() as i16,
            axial: self.battery_ut.iter().take(MOST_POSITIONS).map(row).collect(),
            turning: self.turning_ut.map(steps),
        }
    }
}
