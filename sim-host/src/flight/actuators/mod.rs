//! Pump, valve and mass drives: rates held within their limits, end stops, and what they cost.

mod axis;
mod engine;
mod mass_drive;

use shared::{
    commands::Commands,
    device::{RAD_PER_CDEG, UL_PER_M3, UM_PER_M},
};

use super::{
    FlyingVehicle, TICK_S,
    battery::Battery,
    closed_loop::{STEP_S, STEPS_PER_TICK},
};
use crate::model::{
    ocean::{Ocean, Sample},
    plant::{Particle, Plant, State, rk4_step},
};
use engine::{Engine, Flow};
use mass_drive::MassDrive;

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

/// The actuators of one vehicle, and the battery that they drain.
#[derive(Clone, Debug)]
pub(super) struct Actuators<'a> {
    flying: FlyingVehicle<'a>,
    neutral_volume_m3: f64,
    engine: Engine,
    /// Present if motors drive the moving mass; else it has the commanded speed at once.
    mass_drive: Option<MassDrive>,
    pub(super) battery: Battery,
    pub(super) used: EnergyUsed,
    /// Ideal work p ΔV of the pump, J.
    pub(super) pump_work_j: f64,
}

impl<'a> Actuators<'a> {
    /// Of a vehicle whose displaced volume is this when the buoyancy device stands at zero.
    pub(super) fn new(flying: &FlyingVehicle<'a>, neutral_volume_m3: f64) -> Self {
        let energy = flying.energy;
        Self {
            flying: flying.clone(),
            neutral_volume_m3,
            engine: Engine::default(),
            mass_drive: MassDrive::new(&flying.vehicle.moving_mass),
            battery: Battery::new(flying.cells, energy.battery_v, energy.battery_j),
            used: EnergyUsed::default(),
            pump_work_j: 0.0,
        }
    }

    /// Volume of the buoyancy device beyond neutral, m³.
    pub(super) fn vbd_m3(&self, state: &State<f64>) -> f64 {
        state.displaced_volume_m3 + self.engine.leaked_m3 - self.neutral_volume_m3
    }

    /// Sea water in the hull, m³.
    pub(super) fn leaked_m3(&self) -> f64 {
        self.engine.leaked_m3
    }

    /// One tick under some commands, from `time_s` on; `here` is the water where and when it begins.
    pub(super) fn advance(
        &mut self,
        plant: &Plant<f64>,
        state: &State<f64>,
        commands: &Commands,
        (ocean, here, time_s): (&Ocean, &Sample, f64),
    ) -> State<f64> {
        let commands = &self.flying.faults.obeyed(commands, time_s);
        let pressure_pa = here.around.pressure_pa;
        let commanded_m3_s = f64::from(commands.vbd_rate_ul_s) / f64::from(UL_PER_M3);
        let place = (self.vbd_m3(state), pressure_pa, time_s);
        let flow = self.engine.flow(self.flying.buoyancy, &self.flying.faults, commanded_m3_s, place);
        let (next, mass_j) = self.moved(plant, state, commands, flow.displaced_m3_s, (ocean, time_s));
        self.charge(pressure_pa, &flow, mass_j, self.flying.faults.drain.at(time_s));
        next
    }

    /// The state after a tick, and what axial and rotation drive took, J.
    fn moved(
        &mut self,
        plant: &Plant<f64>,
        state: &State<f64>,
        commands: &Commands,
        u_b_m3_s: f64,
        water: (&Ocean, f64),
    ) -> (State<f64>, [f64; 2]) {
        let slide = f64::from(commands.r_px_rate_um_s) / f64::from(UM_PER_M);
        let turn = f64::from(commands.mu_rate_cdeg_s) * f64::from(RAD_PER_CDEG);
        if let Some(drive) = &mut self.mass_drive {
            return match drive.advance(plant, state, [slide, turn], u_b_m3_s, water) {
                Some(moved) => (moved.state, moved.energy_j),
                None => (steps(plant, state, u_b_m3_s, water), [0.0; 2]),
            };
        }
        // A geared drive takes up its speed at once, and the vehicle recoils.
        let rates = self.held(state, [slide, turn]);
        let begun = plant.with_particle_rates(state, rates[0], rates[1]);
        (steps(plant, &begun, u_b_m3_s, water), self.running(rates))
    }

    /// Rates of the mass (m/s, rad/s) held to what the drives can do and to what is left before the end stops.
    fn held(&self, state: &State<f64>, [slide, turn]: [f64; 2]) -> [f64; 2] {
        let mass = &self.flying.vehicle.moving_mass;
        let held = |rate: f64, most: f64, [low, high]: [f64; 2], position: f64| {
            rate.clamp(-most, most).clamp(((low - position) / TICK_S).min(0.0), ((high - position) / TICK_S).max(0.0))
        };
        [
            held(slide, mass.rate_m_s, mass.travel_m, state.r_px_m),
            held(turn, mass.roll_rate_deg_s.to_radians(), mass.roll_deg.map(f64::to_radians), state.mu_rad),
        ]
    }

    /// What drives that are only known by their power take in a tick, J.
    fn running(&self, rates: [f64; 2]) -> [f64; 2] {
        let energy = self.flying.energy;
        let power = |rate: f64, power_w: f64| if rate == 0.0 { 0.0 } else { power_w * TICK_S };
        [power(rates[0], energy.pitch_motor_w), power(rates[1], energy.roll_motor_w)]
    }

    /// Takes the energy of a tick from the battery; a drain counts as hotel load.
    fn charge(&mut self, pressure_pa: f64, flow: &Flow, [pitch_j, roll_j]: [f64; 2], drain_w: f64) {
        let (buoyancy, before_j) = (self.flying.buoyancy, self.used.total());
        if flow.driven_m3_s > 0.0 {
            self.used.pump += buoyancy.pump_power_w(pressure_pa, flow.driven_m3_s) * TICK_S;
            self.pump_work_j += pressure_pa * flow.driven_m3_s * TICK_S;
        } else if flow.driven_m3_s < 0.0 {
            self.used.pump += buoyancy.engine.bleed_power_w * TICK_S;
        }
        self.used.pitch += pitch_j;
        self.used.roll += roll_j;
        self.used.hotel += (self.flying.energy.hotel_w + drain_w) * TICK_S;
        let used_j = self.used.total();
        self.battery.supply((used_j - before_j) / TICK_S, TICK_S, used_j);
    }
}

/// One tick of a particle that keeps its speed, in an ocean from a time on.
fn steps(plant: &Plant<f64>, state: &State<f64>, u_b_m3_s: f64, (ocean, time_s): (&Ocean, f64)) -> State<f64> {
    (0..STEPS_PER_TICK).fold(*state, |state, step| {
        let water = ocean.from_time(time_s + f64::from(step) * STEP_S);
        rk4_step(plant, &state, &Particle::Driven { u_b_m3_s }, STEP_S, &water)
    })
}
