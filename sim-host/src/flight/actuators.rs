//! Pump, valve and mass drives: rates held within their limits, end stops, and what they cost.

use shared::device::{Commands, RAD_PER_CDEG, UL_PER_M3, UM_PER_M};

use super::{FlyingVehicle, STEP_S, STEPS_PER_TICK, TICK_S};
use crate::{
    ocean::{Ocean, Sample},
    plant::{Particle, Plant, State, rk4_step},
    vehicle::Buoyancy,
};

/// Electrical energy used so far, J.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct EnergyUsed {
    /// By the buoyancy pump.
    pub pump: f64,
    /// By the axial drive of the moving mass.
    pub pitch: f64,
    /// By its rotation drive.
    pub roll: f64,
    /// By everything that always runs.
    pub hotel: f64,
}

impl EnergyUsed {
    /// All together, J.
    #[must_use]
    pub fn total(&self) -> f64 {
        self.pump + self.pitch + self.roll + self.hotel
    }
}

/// The actuators of one vehicle.
#[derive(Clone, Debug)]
pub(super) struct Actuators<'a> {
    flying: FlyingVehicle<'a>,
    neutral_volume_m3: f64,
    pub(super) used: EnergyUsed,
}

/// Rates that hold for one tick.
struct Rates {
    r_px_m_s: f64,
    mu_rad_s: f64,
    volume_m3_s: f64,
}

impl<'a> Actuators<'a> {
    /// Of a vehicle whose displaced volume is this when the buoyancy device stands at zero.
    pub(super) fn new(flying: &FlyingVehicle<'a>, neutral_volume_m3: f64) -> Self {
        Self { flying: flying.clone(), neutral_volume_m3, used: EnergyUsed::default() }
    }

    /// Volume of the buoyancy device beyond neutral, m³.
    pub(super) fn vbd_m3(&self, state: &State<f64>) -> f64 {
        state.displaced_volume_m3 - self.neutral_volume_m3
    }

    /// One tick under some commands, from `time_s` on; `here` is the water where and when it begins.
    pub(super) fn advance(
        &mut self,
        plant: &Plant<f64>,
        state: &State<f64>,
        commands: &Commands,
        (ocean, here, time_s): (&Ocean, &Sample, f64),
    ) -> State<f64> {
        let rates = self.rates(state, commands);
        self.charge(here.around.pressure_pa, &rates);
        // A geared drive takes up its speed at once, and the vehicle recoils.
        let mut next = plant.with_particle_rates(state, rates.r_px_m_s, rates.mu_rad_s);
        for step in 0..STEPS_PER_TICK {
            let particle = Particle::Driven { u_b_m3_s: rates.volume_m3_s };
            let water = ocean.from_time(time_s + f64::from(step) * STEP_S);
            next = rk4_step(plant, &next, &particle, STEP_S, &water);
        }
        next
    }

    /// Commanded rates, held to what the drives can do and to what is left before the end stops.
    fn rates(&self, state: &State<f64>, commands: &Commands) -> Rates {
        let (mass, buoyancy) = (&self.flying.vehicle.moving_mass, self.flying.buoyancy);
        let held = |rate: f64, most_down: f64, most_up: f64, [low, high]: [f64; 2], position: f64| {
            rate.clamp(-most_down, most_up)
                .clamp(((low - position) / TICK_S).min(0.0), ((high - position) / TICK_S).max(0.0))
        };
        let turn = mass.roll_rate_deg_s.to_radians();
        Rates {
            r_px_m_s: held(
                f64::from(commands.r_px_rate_um_s) / f64::from(UM_PER_M),
                mass.rate_m_s,
                mass.rate_m_s,
                mass.travel_m,
                state.r_px_m,
            ),
            mu_rad_s: held(
                f64::from(commands.mu_rate_cdeg_s) * f64::from(RAD_PER_CDEG),
                turn,
                turn,
                mass.roll_deg.map(f64::to_radians),
                state.mu_rad,
            ),
            volume_m3_s: held(
                f64::from(commands.vbd_rate_ul_s) / f64::from(UL_PER_M3),
                buoyancy.bleed_rate_m3_s,
                buoyancy.pump_rate_m3_s,
                buoyancy.volume_m3,
                self.vbd_m3(state),
            ),
        }
    }

    fn charge(&mut self, pressure_pa: f64, rates: &Rates) {
        let energy = self.flying.energy;
        let running = |rate: f64, power_w: f64| if rate == 0.0 { 0.0 } else { power_w * TICK_S };
        if rates.volume_m3_s > 0.0 {
            self.used.pump += pump_power_w(self.flying.buoyancy, pressure_pa, rates.volume_m3_s) * TICK_S;
        }
        self.used.pitch += running(rates.r_px_m_s, energy.pitch_motor_w);
        self.used.roll += running(rates.mu_rad_s, energy.roll_motor_w);
        self.used.hotel += energy.hotel_w * TICK_S;
    }
}

/// Electrical power of pumping against a pressure: ideal p·Q over the efficiency there, and what no pressure takes away, W.
fn pump_power_w(buoyancy: &Buoyancy, pressure_pa: f64, rate_m3_s: f64) -> f64 {
    buoyancy.idle_power_w + pressure_pa * rate_m3_s / efficiency(&buoyancy.efficiency, pressure_pa)
}

/// Linear between the points, constant beyond them.
fn efficiency(points: &[[f64; 2]], pressure_pa: f64) -> f64 {
    let after = points.partition_point(|[pressure, _]| *pressure <= pressure_pa);
    match (after.checked_sub(1).and_then(|before| points.get(before)), points.get(after)) {
        (Some([p0, e0]), Some([p1, e1])) => e0 + (e1 - e0) * (pressure_pa - p0) / (p1 - p0),
        (Some([_, edge]), None) | (None, Some([_, edge])) => *edge,
        (None, None) => 1.0,
    }
}

#[cfg(test)]
mod tests {
    use super::efficiency;

    #[test]
    fn efficiency_is_interpolated_and_held_at_the_ends() {
        let points = [[0.0, 0.04], [1e6, 0.08], [5e6, 0.28]];
        let at = |pressure| efficiency(&points, pressure);
        assert_eq!(at(-1.0), 0.04);
        assert!((at(3e6) - 0.18).abs() < 1e-15);
        assert_eq!(at(1e7), 0.28);
    }
}
