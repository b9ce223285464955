//! The compass beside a battery that moves: a table of heading corrections.
//!
//! The battery is magnetic, and its field moves with it. Levelled by roll and pitch, that field has a part `B` ahead and a
//! part `C` to the right, both over the Earth's horizontal field; whatever their size, the deviation is then exactly
//! ```text
//! sin(true − shown) = B sin(shown) + C cos(shown)
//! ```
//! (Evans & Smith 1863, Admiralty Manual for the Deviations of the Compass: the exact equation for permanent magnetism.)
//! Iron that the Earth's field magnetises (their `D`, `E`) is left out. Where `B² + C²` passes 1 the compass no longer turns
//! once with the vehicle, and no table can correct it.

use heapless::Vec;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::device::{Attitude, RAD_PER_CDEG, TURN_CDEG};
use crate::math;

/// Most axial positions that a table holds.
pub const MOST_POSITIONS: usize = 8;
/// What a stored field is in, over the Earth's horizontal field: 1e-4 turns the heading by 0.006° at most.
pub const FIELD_STEP: f32 = 1e-4;

/// What calibration found; the default corrects nothing.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Compass {
    /// True heading less the compass's that nothing changes (its mounting), 0.01°.
    pub offset_cdeg: i16,
    /// The battery's field with the mass hanging down, by axial position, rising; linear between, held at the ends.
    pub axial: Vec<AxialField, MOST_POSITIONS>,
    /// The part that turns with the mass: right and below with the mass hanging down, [`FIELD_STEP`].
    pub turning: [i16; 2],
}

/// The battery's field at one axial position.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AxialField {
    /// Axial position of the moving mass, µm.
    pub r_px_um: i32,
    /// Field ahead, right, below in body axes, [`FIELD_STEP`].
    pub field: [i16; 3],
}

impl Compass {
    /// Heading without the deviation, 0.01°, 0 to 35999, at a position of the moving mass.
    #[must_use]
    pub fn heading_cdeg(&self, attitude: &Attitude, r_px_um: i32, mu_cdeg: i16) -> u16 {
        let rad = |cdeg: i16| f32::from(cdeg) * RAD_PER_CDEG;
        let field = self.axial_field(r_px_um) + self.turned_field(rad(mu_cdeg));
        let (ahead, right) = levelled(&field, rad(attitude.roll_cdeg), rad(attitude.pitch_cdeg));
        let magnetic_cdeg = i32::from(attitude.heading_cdeg).saturating_add(i32::from(self.offset_cdeg));
        let (sin, cos) = math::sin_cos(magnetic_cdeg as f32 * RAD_PER_CDEG);
        let deviation_cdeg = math::round_to_i32(math::asin(ahead * sin + right * cos) / RAD_PER_CDEG);
        let heading_cdeg = magnetic_cdeg.saturating_add(deviation_cdeg).rem_euclid(TURN_CDEG);
        u16::try_from(heading_cdeg).unwrap_or(attitude.heading_cdeg)
    }

    fn axial_field(&self, r_px_um: i32) -> Vector3<f32> {
        let after = self.axial.iter().position(|node| node.r_px_um > r_px_um).unwrap_or(self.axial.len());
        let before = after.checked_sub(1).and_then(|index| self.axial.get(index));
        match (before, self.axial.get(after)) {
            (Some(before), Some(after)) => {
                let way_um = |from: &AxialField, to: i32| to.saturating_sub(from.r_px_um) as f32;
                let share = way_um(before, r_px_um) / way_um(before, after.r_px_um);
                before.vector() * (1.0 - share) + after.vector() * share
            }
            (Some(edge), None) | (None, Some(edge)) => edge.vector(),
            (None, None) => Vector3::zeros(),
        }
    }

    /// What turns with the mass, less what is there when it hangs down.
    fn turned_field(&self, mu_rad: f32) -> Vector3<f32> {
        let [right, below] = self.turning.map(|steps| f32::from(steps) * FIELD_STEP);
        let (sin, cos) = math::sin_cos(mu_rad);
        Vector3::new(0.0, (cos - 1.0) * right - sin * below, sin * right + (cos - 1.0) * below)
    }
}

impl AxialField {
    fn vector(&self) -> Vector3<f32> {
        Vector3::from(self.field.map(|steps| f32::from(steps) * FIELD_STEP))
    }
}

/// The horizontal parts, ahead and right, of a field in body axes.
fn levelled(field: &Vector3<f32>, roll_rad: f32, pitch_rad: f32) -> (f32, f32) {
    let ((sin_roll, cos_roll), (sin_pitch, cos_pitch)) = (math::sin_cos(roll_rad), math::sin_cos(pitch_rad));
    let below = sin_roll * field.y + cos_roll * field.z;
    (cos_pitch * field.x + sin_pitch * below, cos_roll * field.y - sin_roll * field.z)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::vec::Vec as List;

    fn attitude([roll_cdeg, pitch_cdeg]: [i16; 2], heading_cdeg: u16) -> Attitude {
        Attitude { roll_cdeg, pitch_cdeg, heading_cdeg, pitch_rate_cdeg_s: 0, yaw_rate_cdeg_s: 0 }
    }

    fn compass(axial: &[(i32, [i16; 3])], turning: [i16; 2]) -> Compass {
        let axial = axial.iter().map(|&(r_px_um, field)| AxialField { r_px_um, field }).collect();
        Compass { axial, turning, ..Compass::default() }
    }

    /// What a compass shows, 0.01°: the direction of the Earth's field and the battery's together, both in body axes.
    fn shown_cdeg(heading_cdeg: u16, [roll_cdeg, pitch_cdeg]: [i16; 2], field: [f64; 3]) -> u16 {
        let rad = |cdeg: f64| (cdeg / 100.0).to_radians();
        let to_level = nalgebra::Rotation3::from_euler_angles(rad(roll_cdeg.into()), rad(pitch_cdeg.into()), 0.0);
        let (sin, cos) = rad(heading_cdeg.into()).sin_cos();
        // The vertical part must not matter: levelling takes it away.
        let seen = Vector3::new(cos, -sin, 2.0) + to_level * Vector3::from(field);
        ((-seen.y).atan2(seen.x).to_degrees() * 100.0).round().rem_euclid(36_000.0) as u16 % 36_000
    }

    fn off_cdeg(one: u16, other: u16) -> i32 {
        math::wrap_cdeg(i32::from(one).saturating_sub(other.into())).abs()
    }

    #[test]
    fn without_a_table_the_heading_is_the_compass_s() {
        for heading_cdeg in [0, 1, 12_345, 35_999] {
            let shown = attitude([500, -2_500], heading_cdeg);
            assert_eq!(Compass::default().heading_cdeg(&shown, 100_000, -3_000), heading_cdeg);
        }
    }

    #[test]
    fn a_field_half_the_earths_is_taken_away_on_every_heading_and_tilt() {
        let table = compass(&[(0, [3_000, -2_500, 2_000])], [0; 2]);
        for tilt in [[0, 0], [800, -2_600], [-1_500, 3_000]] {
            for heading_cdeg in (0..36_000).step_by(500) {
                let shown_cdeg = shown_cdeg(heading_cdeg, tilt, [0.3, -0.25, 0.2]);
                let heading = table.heading_cdeg(&attitude(tilt, shown_cdeg), 0, 0);
                // The reading is rounded to 0.01°, and a field of half the Earth's doubles that at most.
                assert!(off_cdeg(heading, heading_cdeg) <= 2, "{heading} for {heading_cdeg} at {tilt:?}");
            }
        }
    }

    #[test]
    fn fields_are_linear_between_positions_and_held_at_the_ends() {
        let table = compass(&[(-100_000, [0, -1_000, 0]), (0, [0; 3]), (300_000, [0, 3_000, 0])], [0; 2]);
        // On north a field to the right of a part C turns the compass to the left by asin C.
        let deviation = |r_px_um| math::wrap_cdeg(table.heading_cdeg(&attitude([0; 2], 0), r_px_um, 0).into());
        let asin_cdeg = |c: f64| (c.asin().to_degrees() * 100.0).round() as i32;
        let places = [(-100_000, -0.1), (-50_000, -0.05), (0, 0.0), (150_000, 0.15), (300_000, 0.3)];
        for (r_px_um, c) in places.into_iter().chain([(i32::MIN, -0.1), (i32::MAX, 0.3)]) {
            assert_eq!(deviation(r_px_um), asin_cdeg(c), "{r_px_um} µm");
        }
    }

    #[test]
    fn what_turns_with_the_mass_counts_by_what_its_turn_changes() {
        let table = compass(&[], [0, 2_000]);
        let deviation = |mu_cdeg| math::wrap_cdeg(table.heading_cdeg(&attitude([0; 2], 0), 0, mu_cdeg).into());
        // A magnet below, swung to the left by 30°, shows half of itself on the left.
        assert_eq!(deviation(0), 0);
        assert_eq!(deviation(3_000), -((0.1_f64.asin().to_degrees() * 100.0).round() as i32));
        assert_eq!(deviation(-3_000), -deviation(3_000));
    }

    #[test]
    fn a_field_beyond_the_earths_and_an_offset_still_give_a_heading() {
        let beyond = Compass { offset_cdeg: i16::MIN, ..compass(&[(0, [i16::MIN; 3])], [i16::MAX; 2]) };
        let headings: List<u16> = (0..36_000)
            .step_by(100)
            .map(|heading_cdeg| beyond.heading_cdeg(&attitude([i16::MIN, i16::MAX], heading_cdeg), i32::MIN, i16::MIN))
            .collect();
        assert!(headings.iter().all(|heading| *heading < 36_000), "{headings:?}");
    }
}
