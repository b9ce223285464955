//! What the instruments make of the truth: noise, bias, lag, quantisation, silence; one seeded generator.

mod altimeter;
mod antenna;
mod compass;
mod errors;
mod housekeeping;
mod noise;
mod pier;
mod pressure;

pub use errors::{AltimeterErrors, CompassErrors, HousekeepingErrors, PressureErrors, SensorErrors};
pub use pier::PierCompass;

use shared::device::{GpsFix, Measurements};

use super::{FlyingVehicle, NorthEast, TICK_S, actuators::Actuators, faults::Instrument};
use crate::flight::mission_file::Start;
use crate::model::{ocean::Sample, plant::State};
use altimeter::Altimeter;
use antenna::{Antenna, Receiver};
use compass::Compass;
use housekeeping::{BatteryGauge, HullAir, LeakDetector, VacuumGauge};
use noise::Noise;
use pressure::PressureSensor;

/// Steps of a 12-bit potentiometer over its travel.
const POT_STEPS: f64 = 4096.0;

/// The instruments of one vehicle.
#[derive(Clone, Debug)]
pub(super) struct Sensors<'a> {
    flying: FlyingVehicle<'a>,
    noise: Noise,
    start: Start,
    antenna: Antenna,
    pressure: PressureSensor,
    compass: Compass,
    satellites: Receiver,
    modem: Receiver,
    altimeter: Altimeter,
    leak: LeakDetector,
    vacuum: VacuumGauge,
    battery: BatteryGauge,
    pots: [Pot; 3],
    ticks: u32,
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
            antenna: Antenna::on_hull(vehicle.hull.length_m),
            pressure,
            compass,
            satellites: Receiver::default(),
            modem: Receiver::default(),
            altimeter: Altimeter::new(&errors.altimeter, seed),
            leak: LeakDetector::new(&errors.housekeeping, seed),
            vacuum: VacuumGauge::new(flying, seed),
            battery: BatteryGauge::new(&errors.housekeeping, seed),
            pots: [Pot::over(mass.travel_m, errors.pot_noise), Pot::over(mass.roll_deg, errors.pot_noise), vbd],
            ticks: 0,
        }
    }

    /// One tick of measurements in some water, above a floor if there is one.
    pub(super) fn measure(
        &mut self,
        state: &State<f64>,
        here: &Sample,
        floor_depth_m: Option<f64>,
        actuators: &Actuators<'_>,
    ) -> Measurements {
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
        let (voltage_v, charge_c) = self.battery.read(&actuators.battery);
        let leak_v = self.leak.read_v(actuators.leaked_m3());
        let vacuum_pa = self.vacuum.read_pa(&HullAir {
            vbd_m3: actuators.vbd_m3(state),
            leaked_m3: actuators.leaked_m3(),
            gas_m3: self.flying.faults.gas.gathered_m3(time_s),
            temperature_c: here.around.temperature_c,
        });
        let altitude_m = self.altimeter.read(state, floor_depth_m);
        let modem_up = self.modem.hears(antenna_is_clear, self.flying.sensor_errors.modem_acquisition_s);
        let heard = |instrument| self.flying.faults.speaks(instrument, time_s);
        // Casts that saturate: an instrument shows no more than its integer holds.
        Measurements {
            pressure_pa: heard(Instrument::Pressure).then_some(pressure_pa.round() as i32),
            attitude: heard(Instrument::Attitude).then_some(attitude),
            r_px_um: (r_px_m * 1e6).round() as i32,
            mu_cdeg: (mu_deg * 100.0).round() as i16,
            vbd_ul: (vbd_m3 * 1e9).round() as i32,
            battery_mv: heard(Instrument::Voltage).then_some((voltage_v * 1e3).round() as u16),
            charge_mc: heard(Instrument::Charge).then_some((charge_c * 1e3).round() as i64),
            altitude_mm: altitude_m.filter(|_| heard(Instrument::Altimeter)).map(|m| (m * 1e3).round() as i32),
            leak_mv: heard(Instrument::Leak).then_some((leak_v * 1e3).round() as u16),
            vacuum_pa: heard(Instrument::Vacuum).then_some(vacuum_pa.round() as i32),
            gps: fix.filter(|_| heard(Instrument::Gps)),
            modem_up: modem_up && heard(Instrument::Modem),
        }
    }

    /// Whether the antenna is out of the water.
    pub(super) fn antenna_is_clear(&self, state: &State<f64>, here: &Sample) -> bool {
        self.antenna.is_clear(state, here)
    }

    fn fix(&mut self, state: &State<f64>, antenna_is_clear: bool) -> Option<GpsFix> {
        let errors = &self.flying.sensor_errors;
        let error_m = [errors.gps_noise_m; 2].map(|sigma| self.noise.normal(sigma));
        if !self.satellites.hears(antenna_is_clear, errors.gps_acquisition_s) {
            return None;
        }
        let place = NorthEast { north_m: state.position_m.x + error_m[0], east_m: state.position_m.y + error_m[1] };
        let [latitude_deg, longitude_deg] = place.latitude_longitude_deg(&self.start);
        let e7 = |degrees: f64| (degrees * 1e7).round() as i32;
        Some(GpsFix { lat_e7: e7(latitude_deg), lon_e7: e7(longitude_deg) })
    }
}
