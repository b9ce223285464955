//! What watches over the vehicle itself: leak detector, vacuum gauge, battery gauge.

use super::{errors::HousekeepingErrors, noise::Noise};
use crate::flight::{FlyingVehicle, Instrument, TICK_S, battery::Battery};
use crate::model::vehicle::EngineKind;

/// The leak detector dry, V; fielded gliders abort below 2.0 V.
const DRY_V: f64 = 2.5;
/// The leak detector under water, V (chosen).
const WET_V: f64 = 1.0;
/// Water in the bilge that covers its electrodes, m³ (chosen).
const WET_M3: f64 = 5e-6;
/// Pressure of the air, Pa.
const AIR_PA: f64 = 101_325.0;
/// Vacuum with which a hull is closed, unless the vehicle says another: 8 inHg, the middle of the fielded 4 to 12.
const CLOSED_PA: f64 = 27e3;
/// Temperature at which it is closed, °C (chosen).
const CLOSED_C: f64 = 15.0;
/// Part of the displaced volume that is air (chosen).
const AIR_SHARE: f64 = 0.2;
const ZERO_C_K: f64 = 273.15;

/// The leak detector: two electrodes at the bottom of the hull.
#[derive(Clone, Debug)]
pub(super) struct LeakDetector {
    errors: HousekeepingErrors,
    noise: Noise,
}

impl LeakDetector {
    pub(super) fn new(errors: &HousekeepingErrors, seed: u64) -> Self {
        Self { errors: *errors, noise: Noise::of(Instrument::Leak, seed) }
    }

    /// Its voltage with so much water in the hull, V.
    pub(super) fn read_v(&mut self, leaked_m3: f64) -> f64 {
        let glitch = self.noise.happens(self.errors.leak_glitches_per_h * TICK_S / 3600.0);
        let covered = if glitch { 1.0 } else { (leaked_m3 / WET_M3).min(1.0) };
        DRY_V - (DRY_V - WET_V) * covered + self.noise.normal(self.errors.leak_noise_v)
    }
}

/// What sets the pressure in the hull.
#[derive(Clone, Copy, Debug)]
pub(super) struct HullAir {
    /// Volume of the buoyancy device beyond neutral: what leaves the hull makes room in it, m³.
    pub(super) vbd_m3: f64,
    /// Sea water in the hull, m³.
    pub(super) leaked_m3: f64,
    /// Gas that came in, at the air's pressure, m³.
    pub(super) gas_m3: f64,
    /// Temperature of the water around, which the hull's air takes up at once, °C, where it is known.
    pub(super) temperature_c: Option<f64>,
}

/// The vacuum gauge.
#[derive(Clone, Debug)]
pub(super) struct VacuumGauge {
    noise_pa: f64,
    noise: Noise,
    closed_pa: f64,
    air_m3: f64,
}

impl VacuumGauge {
    pub(super) fn new(flying: &FlyingVehicle<'_>, seed: u64) -> Self {
        let closed_pa = match flying.buoyancy.engine.kind {
            EngineKind::Bladder { vacuum_pa, .. } => vacuum_pa,
            EngineKind::Piston { .. } => CLOSED_PA,
        };
        Self {
            noise_pa: flying.sensor_errors.housekeeping.vacuum_noise_pa,
            noise: Noise::of(Instrument::Vacuum, seed),
            closed_pa,
            air_m3: AIR_SHARE * flying.vehicle.neutral_volume_m3(),
        }
    }

    /// Air pressure less the hull's, Pa: an ideal gas in what room there is.
    pub(super) fn read_pa(&mut self, air: &HullAir) -> f64 {
        let amount_pa = AIR_PA - self.closed_pa + AIR_PA * air.gas_m3 / self.air_m3;
        let room = (self.air_m3 + air.vbd_m3 - air.leaked_m3) / self.air_m3;
        let warmth = (air.temperature_c.unwrap_or(CLOSED_C) + ZERO_C_K) / (CLOSED_C + ZERO_C_K);
        AIR_PA - amount_pa * warmth / room + self.noise.normal(self.noise_pa)
    }
}

/// Voltmeter and coulomb counter at the battery's terminals.
#[derive(Clone, Debug)]
pub(super) struct BatteryGauge {
    noise_v: f64,
    noise: Noise,
    gain: f64,
}

impl BatteryGauge {
    pub(super) fn new(errors: &HousekeepingErrors, seed: u64) -> Self {
        let gain = 1.0 + Noise::of(Instrument::Charge, seed).normal(errors.charge_gain);
        Self { noise_v: errors.voltage_noise_v, noise: Noise::of(Instrument::Voltage, seed), gain }
    }

    /// Voltage, V, and charge drawn so far, C.
    pub(super) fn read(&mut self, battery: &Battery) -> (f64, f64) {
        (battery.voltage_v() + self.noise.normal(self.noise_v), self.gain * battery.charge_c())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::vehicle::Vehicle;

    const QUIET: HousekeepingErrors = HousekeepingErrors {
        leak_noise_v: 0.0,
        leak_glitches_per_h: 0.0,
        vacuum_noise_pa: 0.0,
        voltage_noise_v: 0.0,
        charge_gain: 0.0,
    };

    #[test]
    fn the_leak_detector_falls_below_two_volts_with_a_sip_of_water() {
        let mut detector = LeakDetector::new(&QUIET, 1);
        assert_eq!([0.0, 5e-6, 1e-3].map(|leaked_m3| detector.read_v(leaked_m3)), [2.5, 1.0, 1.0]);
        assert!(detector.read_v(1e-6) > 2.0 && detector.read_v(2e-6) < 2.0);
    }

    #[test]
    fn glitches_come_as_often_as_said() {
        let mut detector = LeakDetector::new(&HousekeepingErrors { leak_glitches_per_h: 100.0, ..QUIET }, 1);
        // 100 h: 10,000 of 1,440,000 readings, give or take the root.
        let count = (0..1_440_000).filter(|_| detector.read_v(0.0) < 2.0).count();
        assert!((9_600..=10_400).contains(&count), "{count} in 100 h");
    }

    #[test]
    fn the_vacuum_obeys_the_gas_law() {
        let vehicle = Vehicle::load("slocum-paper").unwrap();
        let mut flying = FlyingVehicle::new(&vehicle).unwrap();
        flying.sensor_errors.housekeeping = QUIET;
        let mut gauge = VacuumGauge::new(&flying, 1);
        let closed = HullAir { vbd_m3: 0.0, leaked_m3: 0.0, gas_m3: 0.0, temperature_c: None };
        let mut absolute_pa = |air: HullAir| AIR_PA - gauge.read_pa(&air);
        let (room_m3, at_first_pa) = (0.2 * vehicle.neutral_volume_m3(), AIR_PA - 27e3);
        let near = |pressure_pa: f64, expected_pa: f64| assert!((pressure_pa / expected_pa - 1.0).abs() < 1e-12);
        near(absolute_pa(closed), at_first_pa);
        near(absolute_pa(HullAir { vbd_m3: room_m3, ..closed }), 0.5 * at_first_pa);
        near(absolute_pa(HullAir { leaked_m3: 0.5 * room_m3, ..closed }), 2.0 * at_first_pa);
        near(absolute_pa(HullAir { gas_m3: room_m3, ..closed }), at_first_pa + AIR_PA);
        near(absolute_pa(HullAir { temperature_c: Some(15.0 - 28.815), ..closed }), 0.9 * at_first_pa);
    }
}
