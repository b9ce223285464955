//! How the moving battery deflects the compass: a calibration of one vehicle, which `glider swing` finds.
//!
//! The optional section `[compass]` has `earth_ut` and `battery_ut`, and may have `offset_deg` and `turning_ut` (then 0). At
//! another place the battery's field is the same and the Earth's is not: `earth_ut` alone changes (World Magnetic Model).
//! Without the section the heading flies as the compass shows it.

use serde::Serialize;
use shared::model::compass::{AxialField, FIELD_STEP, MOST_POSITIONS};

use crate::files::toml_file::{Rule, Section};

/// Largest field of the battery over the Earth's: what the table can store; no compass serves beyond 1.
const MOST_OVER_EARTH: f64 = 3.0;
/// The Earth's horizontal field has at most 42 µT; no compass serves where it is nearly vertical.
const EARTH_UT: Rule = Rule::Within(1.0, 45.0);

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
            earth_ut: section.number("earth_ut", EARTH_UT),
            battery_ut: section.quadruples("battery_ut"),
            turning_ut: section.numbers_or("turning_ut", Rule::Finite, [0.0; 2]),
        };
        let rising = read.battery_ut.is_sorted_by(|[below, ..], [above, ..]| below < above);
        let wrong = !(1..=MOST_POSITIONS).contains(&read.battery_ut.len()) || !rising;
        let right =
            format!("1 to {MOST_POSITIONS} rows of [axial position in m, rising; field ahead, right, below in µT]");
        section.refuse_if(wrong, "battery_ut", &right);
        let most = format!("fields of at most {MOST_OVER_EARTH} times earth_ut in each direction");
        section.refuse_if(read.battery_ut.iter().any(|[_, ut @ ..]| read.drowns(ut)), "battery_ut", &most);
        section.refuse_if(read.drowns(&read.turning_ut), "turning_ut", &most);
        read
    }

    /// Whether a file may say so.
    #[must_use]
    pub fn is_storable(&self) -> bool {
        let drowned = self.battery_ut.iter().any(|[_, ut @ ..]| self.drowns(ut)) || self.drowns(&self.turning_ut);
        EARTH_UT.holds(self.earth_ut) && !drowned
    }

    /// Whether a field is too large beside the Earth's.
    fn drowns(&self, ut: &[f64]) -> bool {
        ut.iter().any(|ut| ut.abs() > MOST_OVER_EARTH * self.earth_ut)
    }

    /// The same in the integers that fly.
    #[must_use]
    pub fn flown(&self) -> shared::model::compass::Compass {
        let steps = |ut: f64| (ut / self.earth_ut / f64::from(FIELD_STEP)).round() as i16;
        let row = |&[r_px_m, ahead, right, below]: &[f64; 4]| AxialField {
            r_px_um: (r_px_m * 1e6).round() as i32,
            field: [ahead, right, below].map(steps),
        };
        shared::model::compass::Compass {
            offset_cdeg: (self.offset_deg * 100.0).round() as i16,
            axial: self.battery_ut.iter().take(MOST_POSITIONS).map(row).collect(),
            turning: self.turning_ut.map(steps),
        }
    }
}
