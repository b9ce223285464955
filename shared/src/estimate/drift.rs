//! Current, speed and compass, learned from position fixes against dead reckoning.
//!
//! Between two fixes the vehicle makes `f = c T + (1 + ε) d + β d⊥`: current `c`, way through the water `d` as reckoned, error
//! of speed `ε` and of compass `β`, `d⊥` being `d` turned right by 90°. One dive has two equations for four unknowns; dives
//! on different headings tell all of them apart. A Kalman filter over the dives gives each unknown its share: it starts from
//! how well each is known before, so a first dive teaches mostly the current. (Gelb 1974, Applied Optimal Estimation, 4.2.)

use nalgebra::{Matrix4, Vector2, Vector4};

use crate::device::{MM_PER_M, RAD_PER_CDEG};
use crate::math;
use crate::parameters::Parameters;

/// Shortest time under water that says anything about a current, s.
const LEAST_S: f32 = 120.0;
/// Known before the first dive: current each way in m/s, speed, compass in rad; one standard deviation.
const KNOWN: [f32; 4] = [0.3, 0.3, 0.02, 0.04];
/// Change from one dive to the next, likewise.
const CHANGES: [f32; 4] = [0.03, 0.03, 0.005, 0.002];
/// What the model leaves out, m/s: current that changes along the way.
const NOISE_M_S: f32 = 0.01;
/// Error of the difference of two fixes, m.
const FIX_M: f32 = 5.0;
/// Standard deviations beyond which a dive teaches nothing.
const OUTLIER: f32 = 5.0;

/// What is known of current, speed and compass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drift {
    limits: Vector4<f32>,
    /// Current north and east in m/s, error of speed, error of compass in rad.
    state: Vector4<f32>,
    covariance: Matrix4<f32>,
}

impl Drift {
    /// Knows nothing yet.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        let current_m_s = parameters.current_limit_mm_s as f32 / MM_PER_M;
        let speed = parameters.speed_limit_percent as f32 / 100.0;
        let compass_rad = parameters.compass_limit_cdeg as f32 * RAD_PER_CDEG;
        Self {
            limits: Vector4::new(current_m_s, current_m_s, speed, compass_rad),
            state: Vector4::zeros(),
            covariance: squares(KNOWN),
        }
    }

    /// Current north and east, m/s.
    #[must_use]
    pub fn current_m_s(&self) -> Vector2<f32> {
        self.state.xy()
    }

    /// Error of the reckoned speed, as a part of it.
    #[must_use]
    pub fn speed_error(&self) -> f32 {
        self.state.z
    }

    /// True heading less the compass's, as the vehicle's table corrects it, rad.
    #[must_use]
    pub fn compass_rad(&self) -> f32 {
        self.state.w
    }

    /// Velocity over ground, m/s, of a reckoned one through the water.
    #[must_use]
    pub fn over_ground(&self, water_m_s: &Vector2<f32>) -> Vector2<f32> {
        let turned = Vector2::new(-water_m_s.y, water_m_s.x);
        self.current_m_s() + water_m_s * (1.0 + self.speed_error()) + turned * self.compass_rad()
    }

    /// Takes a dive: what it made over ground, from fix to fix, and what was reckoned through the water, m.
    pub fn take_dive(&mut self, over_ground_m: &Vector2<f32>, water_m: &Vector2<f32>, time_s: f32) {
        if time_s < LEAST_S {
            return;
        }
        let (made_m_s, water_m_s) = (over_ground_m / time_s, water_m / time_s);
        let innovation = made_m_s - self.over_ground(&water_m_s);
        let noise = NOISE_M_S + FIX_M / time_s;
        let before = *self;
        self.covariance += squares(CHANGES);
        let north = Vector4::new(1.0, 0.0, water_m_s.x, -water_m_s.y);
        let east = Vector4::new(0.0, 1.0, water_m_s.y, water_m_s.x);
        let spread = |row: &Vector4<f32>| (self.covariance * row).dot(row) + noise * noise;
        let (north_spread, east_spread) = (spread(&north), spread(&east));
        let plausible = |error: f32, spread: f32| error * error <= OUTLIER * OUTLIER * spread;
        if !(plausible(innovation.x, north_spread) && plausible(innovation.y, east_spread)) {
            *self = before;
            return;
        }
        let drifted_m_s = made_m_s - water_m_s;
        self.correct(&north, drifted_m_s.x, noise);
        self.correct(&east, drifted_m_s.y, noise);
        // An unknown of limit zero stays out of it.
        for (value, limit) in self.state.iter_mut().zip(self.limits.iter()) {
            *value = math::clamp(*value, -limit, *limit);
        }
    }

    /// One scalar measurement of the filter, of `row · state`.
    fn correct(&mut self, row: &Vector4<f32>, drifted_m_s: f32, noise: f32) {
        let spread = self.covariance * row;
        let variance = spread.dot(row) + noise * noise;
        let gain = spread / variance;
        self.state += gain * (drifted_m_s - row.dot(&self.state));
        self.covariance -= gain * spread.transpose();
    }
}

fn squares(deviations: [f32; 4]) -> Matrix4<f32> {
    Matrix4::from_diagonal(&Vector4::from(deviations.map(|deviation| deviation * deviation)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HOUR_S: f32 = 3_600.0;

    fn dive(drift: &mut Drift, heading_deg: f32, current_m_s: Vector2<f32>, speed_error: f32, compass_rad: f32) {
        let at = |speed_m_s: f32, heading_rad: f32| Vector2::new(heading_rad.cos(), heading_rad.sin()) * speed_m_s;
        let heading_rad = heading_deg.to_radians();
        let made = current_m_s + at(0.3 * (1.0 + speed_error), heading_rad + compass_rad);
        drift.take_dive(&(made * HOUR_S), &(at(0.3, heading_rad) * HOUR_S), HOUR_S);
    }

    #[test]
    fn one_dive_teaches_the_current() {
        let mut drift = Drift::new(&Parameters::default());
        dive(&mut drift, 40.0, Vector2::new(0.1, -0.2), 0.0, 0.0);
        // The filter's own doubt: 1 cm/s of noise, and 4 % of 0.3 m/s that it cannot tell from a compass error.
        assert!((drift.current_m_s() - Vector2::new(0.1, -0.2)).norm() < 0.015, "{drift:?}");
    }

    #[test]
    fn dives_on_different_headings_tell_current_speed_and_compass_apart() {
        let mut drift = Drift::new(&Parameters::default());
        let current_m_s = Vector2::new(0.15, 0.05);
        // Currents that change by 3 cm/s from dive to dive hide 2° of compass at 0.3 m/s: it takes many.
        for dives in 0..100 {
            dive(&mut drift, if dives % 2 == 0 { 20.0 } else { 110.0 }, current_m_s, 0.04, -0.05);
        }
        assert!((drift.current_m_s() - current_m_s).norm() < 0.01, "{drift:?}");
        assert!((drift.speed_error() - 0.04).abs() < 0.02, "{drift:?}");
        assert!((drift.compass_rad() + 0.05).abs() < 0.015, "{drift:?}");
    }

    #[test]
    fn dives_on_one_heading_leave_the_compass_almost_alone() {
        let mut drift = Drift::new(&Parameters::default());
        for _ in 0..12 {
            dive(&mut drift, 20.0, Vector2::new(0.1, 0.1), 0.0, 0.0);
        }
        assert!(drift.compass_rad().abs() < 0.02 && drift.speed_error().abs() < 0.02, "{drift:?}");
    }

    #[test]
    fn bad_fixes_and_short_dives_teach_nothing() {
        let fresh = Drift::new(&Parameters::default());
        let water_m = Vector2::new(1_000.0, 0.0);
        for (made_m, time_s) in [
            (Vector2::new(1e6, 0.0), HOUR_S),
            (Vector2::new(f32::NAN, 0.0), HOUR_S),
            (Vector2::new(500.0, 0.0), 60.0),
            (Vector2::new(500.0, 0.0), 0.0),
        ] {
            let mut drift = fresh;
            drift.take_dive(&made_m, &water_m, time_s);
            assert_eq!(drift, fresh, "{made_m:?} in {time_s} s");
        }
    }

    #[test]
    fn what_is_learned_stays_within_its_limits() {
        let parameters = Parameters {
            current_limit_mm_s: 50,
            speed_limit_percent: 0,
            compass_limit_cdeg: 0,
            ..Parameters::default()
        };
        let mut drift = Drift::new(&parameters);
        for heading_deg in [0.0, 90.0, 180.0, 270.0] {
            dive(&mut drift, heading_deg, Vector2::new(0.4, -0.4), 0.1, 0.1);
        }
        assert_eq!(drift.current_m_s(), Vector2::new(0.05, -0.05));
        assert_eq!((drift.speed_error(), drift.compass_rad()), (0.0, 0.0));
    }
}
