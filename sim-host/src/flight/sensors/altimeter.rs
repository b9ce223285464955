//! The altimeter: one beam, fixed to the hull, that looks for the floor.

use super::{errors::AltimeterErrors, noise::Noise};
use crate::flight::Instrument;
use crate::model::plant::{State, rotation_from_quaternion};

/// One altimeter of the kind that the errors describe. It knows its tilt, and reads the height, not the way of its beam.
#[derive(Clone, Debug)]
pub(super) struct Altimeter {
    errors: AltimeterErrors,
    noise: Noise,
}

impl Altimeter {
    pub(super) fn new(errors: &AltimeterErrors, seed: u64) -> Self {
        Self { errors: *errors, noise: Noise::of(Instrument::Altimeter, seed) }
    }

    /// Height above a floor of this depth below the vehicle, m; none without an echo, or without a floor.
    pub(super) fn read(&mut self, state: &State<f64>, floor_depth_m: Option<f64>) -> Option<f64> {
        let errors = &self.errors;
        // Drawn at every ping, so that no draw depends on what was there.
        let (lost, error_m) = (self.noise.happens(errors.dropout), self.noise.normal(errors.noise_m));
        let height_m = floor_depth_m? - state.position_m.z;
        let upright = self.upright(state);
        let echoes = upright >= libm::cos(errors.beam_deg.to_radians());
        let heard = !lost && echoes && (errors.least_m..=errors.most_m).contains(&(height_m / upright));
        heard.then(|| ((height_m + error_m) / errors.step_m).round() * errors.step_m)
    }

    /// Cosine of the angle between the beam and straight down. The beam is the body's down axis, tilted forward.
    fn upright(&self, state: &State<f64>) -> f64 {
        let (sin, cos) = libm::sincos(self.errors.mount_deg.to_radians());
        let down = rotation_from_quaternion(&state.quaternion).row(2).transpose();
        sin * down.x + cos * down.z
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plant::quaternion_from_euler;
    use nalgebra::Vector3;

    const TRUE: AltimeterErrors = AltimeterErrors {
        least_m: 0.5,
        most_m: 100.0,
        mount_deg: 26.0,
        beam_deg: 20.0,
        dropout: 0.0,
        noise_m: 0.0,
        step_m: 0.1,
    };

    fn state(roll_deg: f64, pitch_deg: f64, depth_m: f64) -> State<f64> {
        let euler = Vector3::new(roll_deg, pitch_deg, 70.0).map(f64::to_radians);
        let position_m = Vector3::new(0.0, 0.0, depth_m);
        State { quaternion: quaternion_from_euler(&euler), position_m, ..State::at_rest(0.05) }
    }

    fn read(errors: AltimeterErrors, roll_deg: f64, pitch_deg: f64, depth_m: f64) -> Option<f64> {
        Altimeter::new(&errors, 1).read(&state(roll_deg, pitch_deg, depth_m), Some(120.0))
    }

    #[test]
    fn it_reads_the_height_in_whole_steps_within_its_range() {
        assert!((read(TRUE, 0.0, -26.0, 80.04).unwrap() - 40.0).abs() < 1e-9);
        assert_eq!(read(TRUE, 0.0, -26.0, 19.9), None, "too far");
        assert!(read(TRUE, 0.0, -26.0, 20.1).is_some());
        assert_eq!(read(TRUE, 0.0, -26.0, 119.6), None, "too near");
        assert_eq!(Altimeter::new(&TRUE, 1).read(&state(0.0, -26.0, 80.0), None), None, "no floor");
    }

    #[test]
    fn the_floor_echoes_only_to_a_beam_that_is_nearly_upright() {
        for (roll_deg, pitch_deg, echoes) in
            [(0.0, -26.0, true), (0.0, -45.9, true), (0.0, -46.1, false), (0.0, -6.1, true), (0.0, -5.9, false)]
        {
            assert_eq!(read(TRUE, roll_deg, pitch_deg, 80.0).is_some(), echoes, "pitch {pitch_deg}°");
        }
        assert_eq!(read(TRUE, 0.0, 26.0, 80.0), None, "a climb at 26° looks 52° aside");
        // Roll turns the beam aside by about cos 26° of it: 13.5° of 15°, 22.5° of 25°.
        assert_eq!((read(TRUE, 15.0, -26.0, 80.0).is_some(), read(TRUE, 25.0, -26.0, 80.0).is_some()), (true, false));
        // 10° off, 99 m of height are 100.5 m of way.
        assert_eq!((read(TRUE, 0.0, -36.0, 21.0), read(TRUE, 0.0, -26.0, 21.0).is_some()), (None, true));
    }

    #[test]
    fn it_drops_out_as_often_as_said() {
        let mut altimeter = Altimeter::new(&AltimeterErrors { dropout: 0.2, noise_m: 0.3, ..TRUE }, 7);
        let heights: Vec<f64> =
            (0..10_000).filter_map(|_| altimeter.read(&state(0.0, -26.0, 80.0), Some(120.0))).collect();
        // Standard deviation of a share of 0.2 over 10,000: 0.004. Of the mean of 8,000 errors of 0.3 m: 3 mm.
        assert!((heights.len() as f64 / 1e4 - 0.8).abs() < 0.016, "{} of 10000", heights.len());
        let mean_m = heights.iter().sum::<f64>() / heights.len() as f64;
        assert!((mean_m - 40.0).abs() < 0.014, "{mean_m} m");
    }
}
