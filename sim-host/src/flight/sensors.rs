//! What the instruments make of the truth: noise, bias, quantisation; one seeded generator.

use nalgebra::Vector3;
use rand::{Rng, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;
use shared::device::{Attitude, GpsFix, Measurements, TICK_HZ};

use super::{FlyingVehicle, actuators::Actuators};
use crate::{
    mission_file::Start,
    ocean::Sample,
    plant::{State, euler_from_quaternion, rotation_from_quaternion},
};

/// Pressure: noise of a 0.01 % sensor of 20 bar, Pa.
const PRESSURE_NOISE_PA: f64 = 50.0;
/// Pressure: what surface zeroing leaves, Pa.
const PRESSURE_BIAS_PA: f64 = 100.0;
/// Tilt noise of a tilt-compensated compass, deg.
const TILT_NOISE_DEG: f64 = 0.15;
/// Its heading noise, deg.
const HEADING_NOISE_DEG: f64 = 0.5;
/// Constant error of heading after calibration, deg.
const HEADING_BIAS_DEG: f64 = 0.7;
/// Constant errors of pitch and roll (mounting), deg.
const TILT_BIAS_DEG: f64 = 0.3;
/// Rate noise, deg/s.
const RATE_NOISE_DEG_S: f64 = 0.1;
/// Horizontal error of a position fix, per axis, m.
const GPS_NOISE_M: f64 = 3.0;
/// Time with the antenna clear until positions come, s.
const GPS_ACQUISITION_S: u32 = 20;
/// Time under water that the search survives: waves wash over the antenna, s.
const GPS_MEMORY_S: u32 = 20;
/// Antenna above the tail, along the hull's axis, m.
const ANTENNA_M: f64 = 0.2;
/// Height of the antenna's tip at which waves no longer wash it, m.
const CLEAR_M: f64 = 0.05;
/// Steps of a 12-bit potentiometer over its travel.
const POT_STEPS: f64 = 4096.0;
/// Metres per degree of latitude, on the sphere that the controller uses.
const M_PER_DEG: f64 = 111_194.93;

/// The instruments of one vehicle.
#[derive(Clone, Debug)]
pub(super) struct Sensors {
    noise: Pcg64Mcg,
    start: Start,
    tail_m: f64,
    pots: [Pot; 3],
    battery_mv: u16,
    pressure_bias_pa: f64,
    attitude_bias_deg: Vector3<f64>,
    clear_ticks: u32,
    under_ticks: u32,
}

/// A position potentiometer: a range in steps.
#[derive(Clone, Copy, Debug)]
struct Pot {
    low: f64,
    step: f64,
}

impl Pot {
    fn new([low, high]: [f64; 2]) -> Self {
        Self { low, step: (high - low) / POT_STEPS }
    }

    fn read(&self, value: f64) -> f64 {
        self.low + ((value - self.low) / self.step).round() * self.step
    }
}

impl Sensors {
    pub(super) fn new(flying: &FlyingVehicle<'_>, start: &Start, seed: u64) -> Self {
        let vehicle = flying.vehicle;
        let mut noise = Pcg64Mcg::seed_from_u64(seed);
        let tilt = Vector3::new(TILT_BIAS_DEG, TILT_BIAS_DEG, HEADING_BIAS_DEG);
        let pressure_bias_pa = PRESSURE_BIAS_PA * normal(&mut noise);
        let attitude_bias_deg = tilt.map(|sigma| sigma * normal(&mut noise));
        Self {
            start: *start,
            tail_m: 0.5 * vehicle.hull.length_m + ANTENNA_M,
            pots: [vehicle.moving_mass.travel_m, vehicle.moving_mass.roll_deg, flying.buoyancy.volume_m3].map(Pot::new),
            battery_mv: (flying.energy.battery_v * 1e3).round() as u16,
            noise,
            pressure_bias_pa,
            attitude_bias_deg,
            clear_ticks: 0,
            under_ticks: 0,
        }
    }

    /// One tick of measurements in some water.
    pub(super) fn measure(&mut self, state: &State<f64>, here: &Sample, actuators: &Actuators<'_>) -> Measurements {
        let pressure_pa = here.around.pressure_pa + self.pressure_bias_pa + PRESSURE_NOISE_PA * self.normal();
        let [travel, roll, volume] = self.pots;
        let attitude = self.attitude(state);
        Measurements {
            pressure_pa: Some(pressure_pa.round() as i32),
            attitude: Some(attitude),
            r_px_um: (travel.read(state.r_px_m) * 1e6).round() as i32,
            mu_cdeg: (roll.read(state.mu_rad.to_degrees()) * 100.0).round() as i16,
            vbd_ul: (volume.read(actuators.vbd_m3(state)) * 1e9).round() as i32,
            battery_mv: self.battery_mv,
            gps: self.fix(state, here),
        }
    }

    /// Whether the antenna, on the tail, is out of the water.
    pub(super) fn antenna_is_clear(&self, state: &State<f64>, here: &Sample) -> bool {
        let down = rotation_from_quaternion(&state.quaternion).row(2).transpose();
        state.position_m.z + here.around.surface_m - down.x * self.tail_m < -CLEAR_M
    }

    fn attitude(&mut self, state: &State<f64>) -> Attitude {
        let tilt_noise = [TILT_NOISE_DEG, TILT_NOISE_DEG, HEADING_NOISE_DEG].map(|sigma| sigma * self.normal());
        let rate_noise = [RATE_NOISE_DEG_S; 2].map(|sigma| sigma * self.normal());
        let measured = euler_from_quaternion(&state.quaternion).map(f64::to_degrees)
            + self.attitude_bias_deg
            + Vector3::from(tilt_noise);
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

    fn fix(&mut self, state: &State<f64>, here: &Sample) -> Option<GpsFix> {
        let clear = self.antenna_is_clear(state, here);
        self.under_ticks = if clear { 0 } else { self.under_ticks.saturating_add(1) };
        if self.under_ticks > GPS_MEMORY_S * TICK_HZ {
            self.clear_ticks = 0;
        }
        self.clear_ticks = self.clear_ticks.saturating_add(clear.into());
        let error_m = [GPS_NOISE_M; 2].map(|sigma| sigma * self.normal());
        if !clear || self.clear_ticks < GPS_ACQUISITION_S * TICK_HZ {
            return None;
        }
        let latitude_deg = self.start.latitude_deg + (state.position_m.x + error_m[0]) / M_PER_DEG;
        let east_deg =
            (state.position_m.y + error_m[1]) / (M_PER_DEG * libm::cos(self.start.latitude_deg.to_radians()));
        let longitude_deg = (self.start.longitude_deg + east_deg + 180.0).rem_euclid(360.0) - 180.0;
        let e7 = |degrees: f64| (degrees * 1e7).round() as i32;
        Some(GpsFix { lat_e7: e7(latitude_deg), lon_e7: e7(longitude_deg) })
    }

    fn normal(&mut self) -> f64 {
        normal(&mut self.noise)
    }
}

/// One draw of the standard normal distribution.
fn normal(noise: &mut impl Rng) -> f64 {
    StandardNormal.sample(noise)
}
