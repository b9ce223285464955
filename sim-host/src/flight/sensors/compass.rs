//! The attitude and heading reference: a compass that feels the moving battery, its tilts, and the lag of its filter.

use nalgebra::Vector3;
use shared::device::Attitude;

use super::{errors::CompassErrors, noise::Noise, pressure::share};
use crate::model::plant::{State, euler_from_quaternion};

/// One reference of the kind that the errors describe.
#[derive(Clone, Debug)]
pub(super) struct Compass {
    errors: CompassErrors,
    bias_deg: Vector3<f64>,
    disturbance: Disturbance,
    /// Roll, pitch, heading as filtered, rad; nothing before the first reading.
    filtered_rad: Option<Vector3<f64>>,
}

/// Field in body axes that calibration left, µT.
#[derive(Clone, Debug)]
struct Disturbance {
    per_m: Vector3<f64>,
    turning: Vector3<f64>,
    per_km: Vector3<f64>,
}

impl Disturbance {
    fn ut(&self, state: &State<f64>) -> Vector3<f64> {
        // What turns with the battery, less what was there when it hung straight down.
        let (sin, cos) = libm::sincos(state.mu_rad);
        let turned = Vector3::new(
            0.0,
            (cos - 1.0) * self.turning.y - sin * self.turning.z,
            sin * self.turning.y + (cos - 1.0) * self.turning.z,
        );
        self.per_m * state.r_px_m + turned + self.per_km * (1e-3 * state.position_m.z.max(0.0))
    }
}

impl Compass {
    pub(super) fn new(errors: &CompassErrors, noise: &mut Noise) -> Self {
        Self {
            errors: *errors,
            bias_deg: noise.vector([errors.tilt_bias_deg, errors.tilt_bias_deg, errors.heading_bias_deg]),
            disturbance: Disturbance {
                per_m: noise.vector([errors.battery_ut_m; 3]),
                turning: noise.vector([errors.battery_roll_ut; 3]),
                per_km: noise.vector([errors.depth_ut_km; 3]),
            },
            filtered_rad: None,
        }
    }

    /// Lets its filter come to rest: the next reading has no lag.
    pub(super) fn settle(&mut self) {
        self.filtered_rad = None;
    }

    /// What it shows.
    pub(super) fn read(&mut self, state: &State<f64>, noise: &mut Noise) -> Attitude {
        let errors = self.errors;
        let euler = euler_from_quaternion(&state.quaternion);
        let shown = Vector3::new(euler.x, euler.y, euler.z + self.heading_error_rad(state, &euler));
        let before = self.filtered_rad.unwrap_or(shown);
        let filtered = before + (shown - before).map(shortest) * share(errors.lag_s);
        self.filtered_rad = Some(filtered);
        let tilt_noise = noise.vector([errors.tilt_noise_deg, errors.tilt_noise_deg, errors.heading_noise_deg]);
        let rate_noise = [errors.rate_noise_deg_s; 2].map(|sigma| noise.normal(sigma));
        let measured = filtered.map(f64::to_degrees) + self.bias_deg + tilt_noise;
        let rate = state.rate_rad_s.map(f64::to_degrees);
        // A saturating cast: a rate beyond ±327 °/s reads as that.
        let cdeg = |degrees: f64| (degrees * 100.0).round() as i16;
        Attitude {
            roll_cdeg: cdeg(measured.x),
            pitch_cdeg: cdeg(measured.y),
            heading_cdeg: ((measured.z * 100.0).round() as i32).rem_euclid(36_000) as u16,
            pitch_rate_cdeg_s: cdeg(rate.y + rate_noise[0]),
            yaw_rate_cdeg_s: cdeg(rate.z + rate_noise[1]),
        }
    }

    /// Magnetic error of the tilt-compensated heading, rad: the field that is too much, levelled, beside the Earth's.
    fn heading_error_rad(&self, state: &State<f64>, euler: &Vector3<f64>) -> f64 {
        let field = self.disturbance.ut(state);
        let ((sin_roll, cos_roll), (sin_pitch, cos_pitch)) = (libm::sincos(euler.x), libm::sincos(euler.y));
        let below = sin_roll * field.y + cos_roll * field.z;
        let ahead = cos_pitch * field.x + sin_pitch * below;
        let right = cos_roll * field.y - sin_roll * field.z;
        let (sin, cos) = libm::sincos(euler.z);
        let horizontal = self.errors.earth_ut;
        let (north_ahead, north_right) = (horizontal * cos + ahead, right - horizontal * sin);
        shortest((-north_right).atan2(north_ahead) - euler.z)
    }
}

/// An angle, the short way round, rad.
fn shortest(angle: f64) -> f64 {
    (angle + std::f64::consts::PI).rem_euclid(std::f64::consts::TAU) - std::f64::consts::PI
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::plant::quaternion_from_euler;

    const STILL: CompassErrors = CompassErrors {
        tilt_noise_deg: 0.0,
        heading_noise_deg: 0.0,
        rate_noise_deg_s: 0.0,
        tilt_bias_deg: 0.0,
        heading_bias_deg: 0.0,
        lag_s: 0.0,
        earth_ut: 15.0,
        battery_ut_m: 0.0,
        battery_roll_ut: 0.0,
        depth_ut_km: 0.0,
    };

    fn state(euler_deg: [f64; 3]) -> State<f64> {
        let euler = Vector3::from(euler_deg).map(f64::to_radians);
        State { quaternion: quaternion_from_euler(&euler), ..State::at_rest(0.05) }
    }

    #[test]
    fn without_errors_it_shows_what_is() {
        let mut noise = Noise::new(1);
        let shown = Compass::new(&STILL, &mut noise).read(&state([5.0, -25.0, -90.0]), &mut noise);
        assert_eq!((shown.roll_cdeg, shown.pitch_cdeg, shown.heading_cdeg), (500, -2500, 27_000));
    }

    #[test]
    fn a_field_ahead_turns_the_heading_by_its_angle() {
        let mut noise = Noise::new(1);
        let mut compass = Compass::new(&STILL, &mut noise);
        compass.disturbance.per_m = Vector3::new(3.0, 0.0, 0.0);
        let mut error_deg = |heading_deg: f64, pitch_deg: f64| {
            let state = State { r_px_m: 0.5, ..state([0.0, pitch_deg, heading_deg]) };
            f64::from(compass.read(&state, &mut noise).heading_cdeg) / 100.0 - heading_deg
        };
        // 1.5 µT ahead of 15 µT: nothing on north, atan(0.1) towards north on east, and less of it with the nose down.
        assert_eq!(error_deg(360.0, 0.0) + 360.0, 0.0);
        assert!((error_deg(90.0, 0.0) + 0.1_f64.atan().to_degrees()).abs() < 0.01);
        assert!((error_deg(90.0, -60.0) + 0.05_f64.atan().to_degrees()).abs() < 0.01);
    }

    /// Largest change of the heading error between a dive and a climb in 800 m, over 8 headings and several compasses, deg.
    fn dive_to_climb_deg(errors: CompassErrors, seed: u64) -> f64 {
        let mut noise = Noise::new(seed);
        let quiet = CompassErrors { lag_s: 0.0, ..errors };
        let compass = Compass::new(&quiet, &mut noise);
        let error = |heading_deg: f64, side: f64| {
            let mut state = state([0.0, -25.0 * side, heading_deg]);
            (state.r_px_m, state.position_m.z) = (0.2 * side, 400.0 + 400.0 * side);
            compass.heading_error_rad(&state, &euler_from_quaternion(&state.quaternion)).to_degrees()
        };
        (0..8)
            .map(|eighth| (error(45.0 * f64::from(eighth), 1.0) - error(45.0 * f64::from(eighth), -1.0)).abs())
            .fold(0.0, f64::max)
    }

    #[test]
    fn calibration_takes_tens_of_degrees_down_to_one_or_two() {
        let median = |errors: CompassErrors| {
            let mut worst: Vec<f64> = (1..=21).map(|seed| dive_to_climb_deg(errors, seed)).collect();
            worst.sort_by(f64::total_cmp);
            worst[10]
        };
        let [calibrated, raw] = [CompassErrors::default(), CompassErrors::uncalibrated()].map(median);
        assert!((0.3..3.0).contains(&calibrated), "{calibrated}°");
        assert!((10.0..90.0).contains(&raw), "{raw}°");
    }

    #[test]
    fn a_turn_is_shown_late_by_the_lag_also_through_north() {
        let mut noise = Noise::new(1);
        let mut compass = Compass::new(&CompassErrors { lag_s: 2.0, ..STILL }, &mut noise);
        // 2 °/s from 350° through north, until the lag has settled: e^-10 of 4° are left.
        let shown =
            (0..=80).map(|tick| compass.read(&state([0.0, 0.0, 350.0 + 0.5 * f64::from(tick)]), &mut noise)).last();
        // A first-order lag sampled at 4 Hz is late by its time constant less half a tick, to 1 %.
        let late_deg = 30.0 - f64::from(shown.unwrap().heading_cdeg) / 100.0;
        assert!((late_deg - 2.0 * 1.875).abs() < 0.04, "{late_deg}° behind");
    }
}
