//! The pressure sensor: range, noise, drift, creep, and zeroing at the surface.

use super::{errors::PressureErrors, noise::Noise};
use crate::flight::TICK_S;

/// One sensor of the kind that the errors describe.
#[derive(Clone, Debug)]
pub(super) struct PressureSensor {
    errors: PressureErrors,
    range_pa: f64,
    bias_pa: f64,
    drift_pa_h: f64,
    /// What the sensor's body has got used to.
    crept_pa: f64,
    /// What zeroing takes off.
    zero_pa: f64,
}

impl PressureSensor {
    pub(super) fn new(errors: &PressureErrors, crush_pa: f64, noise: &mut Noise) -> Self {
        Self {
            errors: *errors,
            range_pa: errors.range_over_crush * crush_pa,
            bias_pa: noise.normal(errors.bias_pa),
            drift_pa_h: noise.normal(errors.drift_pa_h),
            crept_pa: 0.0,
            zero_pa: 0.0,
        }
    }

    /// What it shows of a pressure above the air's, Pa.
    ///
    /// While the antenna is clear it is zeroed: the vehicle then floats at a depth that is known.
    pub(super) fn read(&mut self, pressure_pa: f64, time_s: f64, antenna_is_clear: bool, noise: &mut Noise) -> f64 {
        let errors = &self.errors;
        self.crept_pa += share(errors.creep_s) * (pressure_pa - self.crept_pa);
        let drifted_pa = self.drift_pa_h * time_s / 3600.0;
        let error_pa = drifted_pa - errors.creep * (pressure_pa - self.crept_pa) + noise.normal(errors.noise_pa);
        if antenna_is_clear {
            self.zero_pa += share(errors.zeroing_s) * (error_pa - self.zero_pa);
        }
        (pressure_pa + self.bias_pa + error_pa - self.zero_pa).min(self.range_pa)
    }
}

/// What a first-order lag takes up in a tick.
pub(super) fn share(time_constant_s: f64) -> f64 {
    if time_constant_s > 0.0 { 1.0 - libm::exp(-TICK_S / time_constant_s) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DEEP_PA: f64 = 2e6;
    const NONE: PressureErrors = PressureErrors {
        range_over_crush: 1.25,
        noise_pa: 0.0,
        bias_pa: 0.0,
        drift_pa_h: 0.0,
        creep: 0.0,
        creep_s: 600.0,
        zeroing_s: 10.0,
    };

    fn sensor(errors: PressureErrors) -> (PressureSensor, Noise) {
        let mut noise = Noise::new(1);
        (PressureSensor::new(&errors, 3e6, &mut noise), noise)
    }

    #[test]
    fn without_errors_it_shows_the_pressure_as_far_as_it_goes() {
        let (mut sensor, mut noise) = sensor(NONE);
        assert_eq!(sensor.read(DEEP_PA, 0.0, false, &mut noise), DEEP_PA);
        assert_eq!(sensor.read(1e7, 0.0, false, &mut noise), 1.25 * 3e6);
    }

    #[test]
    fn drift_gathers_under_water_and_goes_at_the_surface() {
        let (mut sensor, mut noise) = sensor(PressureErrors { drift_pa_h: 100.0, ..NONE });
        let drift_pa = sensor.drift_pa_h;
        let hour = |hours: f64| 3600.0 * hours;
        assert!((sensor.read(DEEP_PA, hour(10.0), false, &mut noise) - DEEP_PA - 10.0 * drift_pa).abs() < 1e-6);
        // Ten time constants leave 5e-5.
        for _ in 0..400 {
            sensor.read(0.0, hour(10.0), true, &mut noise);
        }
        let left_pa = sensor.read(0.0, hour(10.0), false, &mut noise);
        assert!(left_pa.abs() < 1e-3 * drift_pa.abs(), "{left_pa} Pa left of {} Pa", 10.0 * drift_pa);
    }

    #[test]
    fn on_the_way_up_it_shows_more_than_on_the_way_down() {
        let (mut sensor, mut noise) = sensor(PressureErrors { creep: 2e-4, ..NONE });
        let mut error_at = |pressure_pa: f64| sensor.read(pressure_pa, 0.0, false, &mut noise) - pressure_pa;
        // 200 m down and up, each in 10 minutes; read half-way.
        let way = |tick: i32| DEEP_PA * f64::from(tick) / 2400.0;
        let down: Vec<f64> = (0..2400).map(|tick| error_at(way(tick))).collect();
        let up: Vec<f64> = (0..2400).rev().map(|tick| error_at(way(tick))).collect();
        assert!(down[1200] < 0.0 && up[1200] > 0.0);
        // A loop of at most the creep, which is 4 cm of 200 m.
        let loop_pa = up[1200] - down[1200];
        assert!((50.0..=2e-4 * DEEP_PA).contains(&loop_pa), "{loop_pa} Pa");
    }
}
