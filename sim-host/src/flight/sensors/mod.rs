//! What the instruments make of the truth: noise, bias, lag, quantisation, silence; one seeded generator.

mod compass;
mod errors;
mod noise;
mod pressure;

pub use errors::{CompassErrors, PressureErrors, SensorErrors};

use shared::device::{GpsFix, Measurements, TICK_HZ};

use super::{FlyingVehicle, TICK_S, actuators::Actuators, faults::Instrument};
use crate::{
    mission_file::{M_PER_DEG, Start},
    ocean::Sample,
    plant::{State, rotation_from_quaternion},
};
use compass::Compass;
use noise::Noise;
use pressure::PressureSensor;

/// Antenna above the tail, along the hull's axis, m.
const ANTENNA_M: f64 = 0.2;
/// Height of the antenna's tip at which waves no longer wash it, m.
const CLEAR_M: f64 = 0.05;
/// Time under water that the search survives: waves wash over the antenna, s.
const GPS_MEMORY_S: u32 = 20;
/// Steps of a 12-bit potentiometer over its travel.
const POT_STEPS: f64 = 4096.0;

/// The instruments of one vehicle.
#[derive(Clone, Debug)]
pub(super) struct Sensors<'a> {
    flying: FlyingVehicle<'a>,
    noise: Noise,
    start: Start,
    tail_m: f64,
    pressure: PressureSensor,
    compass: Compass,
    pots: [Pot; 3],
    ticks: u32,
    clear_ticks: u32,
    under_ticks: u32,
}

/// A position potentiometer: where its range begins, its step and its noise.
#[derive(Clone, Copy, Debug)]
struct Pot {
    low: f64,
    step: f64,
    noise: f64,
}

impl Pot {
    /// 12 bits over a travel, with noise as a part of it.
    fn over([low, high]: [f64; 2], noise: f64) -> Self {
        Self { low, step: (high - low) / POT_STEPS, noise: noise * (high - low) }
    }

    fn read(&self, value: f64, noise: &mut Noise) -> f64 {
        self.low + ((value + noise.normal(self.noise) - self.low) / self.step).round() * self.step
    }
}

impl<'a> Sensors<'a> {
    pub(super) fn new(flying: &FlyingVehicle<'a>, start: &Start, seed: u64) -> Self {
        let (vehicle, errors, engine) = (flying.vehicle, &flying.sensor_errors, &flying.buoyancy.engine);
        let pa_per_m = vehicle.water.density_kg_m3 * vehicle.water.gravity_m_s2;
        let mut noise = Noise::new(seed);
        let pressure = PressureSensor::new(&errors.pressure, pa_per_m * flying.limits.crush_depth_m, &mut noise);
        let compass = Compass::new(&errors.compass, &mut noise);
        let vbd = Pot { low: flying.buoyancy.volume_m3[0], step: engine.pot_step_m3, noise: engine.pot_noise_m3 };
        let mass = &vehicle.moving_mass;
        Self {
            flying: flying.clone(),
            noise,
            start: *start,
            tail_m: 0.5 * vehicle.hull.length_m + ANTENNA_M,
            pressure,
            compass,
            pots: [Pot::over(mass.travel_m, errors.pot_noise), Pot::over(mass.roll_deg, errors.pot_noise), vbd],
            ticks: 0,
            clear_ticks: 0,
            under_ticks: 0,
        }
    }

    /// One tick of measurements in some water.
    pub(super) fn measure(&mut self, state: &State<f64>, here: &Sample, actuators: &Actuators<'_>) -> Measurements {
        let time_s = f64::from(self.ticks) * TICK_S;
        self.ticks += 1;
        let antenna_is_clear = self.antenna_is_clear(state, here);
        // Every instrument reads, also one that is not heard: no draw depends on another's silence.
        let pressure_pa = self.pressure.read(here.around.pressure_pa, time_s, antenna_is_clear, &mut self.noise);
        let attitude = self.compass.read(state, &mut self.noise);
        let fix = self.fix(state, antenna_is_clear);
        let positions = [state.r_px_m, state.mu_rad.to_degrees(), actuators.vbd_m3(state)];
        let [r_px_m, mu_deg, vbd_m3] =
            std::array::from_fn(|index| self.pots[index].read(positions[index], &mut self.noise));
        let heard = |instrument| self.flying.faults.speaks(instrument, time_s);
        Measurements {
            pressure_pa: heard(Instrument::Pressure).then_some(pressure_pa.round() as i32),
            attitude: heard(Instrument::Attitude).then_some(attitude),
            r_px_um: (r_px_m * 1e6).round() as i32,
            mu_cdeg: (mu_deg * 100.0).round() as i16,
            vbd_ul: (vbd_m3 * 1e9).round() as i32,
            battery_mv: (actuators.battery.voltage_v() * 1e3).round() as u16,
            gps: fix.filter(|_| heard(Instrument::Gps)),
        }
    }

    /// Whether the antenna, on the tail, is out of the water.
    pub(super) fn antenna_is_clear(&self, state: &State<f64>, here: &Sample) -> bool {
        let down = rotation_from_quaternion(&state.quaternion).row(2).transpose();
        state.position_m.z + here.around.surface_m - down.x * self.tail_m < -CLEAR_M
    }

    fn fix(&mut self, state: &State<f64>, antenna_is_clear: bool) -> Option<GpsFix> {
        self.under_ticks = if antenna_is_clear { 0 } else { self.under_ticks.saturating_add(1) };
        if self.under_ticks > GPS_MEMORY_S * TICK_HZ {
            self.clear_ticks = 0;
        }
        self.clear_ticks = self.clear_ticks.saturating_add(antenna_is_clear.into());
        let errors = &self.flying.sensor_errors;
        let error_m = [errors.gps_noise_m; 2].map(|sigma| self.noise.normal(sigma));
        if !antenna_is_clear || f64::from(self.clear_ticks) < errors.gps_acquisition_s * f64::from(TICK_HZ) {
            return None;
        }
        let latitude_deg = self.start.latitude_deg + (state.position_m.x + error_m[0]) / M_PER_DEG;
        let east_deg =
            (state.position_m.y + error_m[1]) / (M_PER_DEG * libm::cos(self.start.latitude_deg.to_radians()));
        let longitude_deg = (self.start.longitude_deg + east_deg + 180.0).rem_euclid(360.0) - 180.0;
        let e7 = |degrees: f64| (degrees * 1e7).round() as i32;
        Some(GpsFix { lat_e7: e7(latitude_deg), lon_e7: e7(longitude_deg) })
    }
}
