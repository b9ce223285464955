//! A closed-loop flight: plant, motors and sensors around whoever flies.

use nalgebra::Vector3;
use shared::{
    commands::Commands,
    device::{MM_PER_M, Measurements, TICK_HZ},
    mission::Mission,
};

use super::{
    EnergyUsed, FlyingVehicle, Loss, Summary, actuators::Actuators, mission_file::Start, pilot::Pilot,
    sensors::Sensors, summary::Log,
};
use crate::model::{
    ocean::{self, Ocean},
    plant::{Particle, Plant, State, quaternion_from_euler, rk4_step},
};

/// Duration of a tick, s.
pub const TICK_S: f64 = 1.0 / TICK_HZ as f64;
/// Integration steps per tick: fourth order at 0.25 s is 0.8 mm off after a whole dive (`tests/integration.rs`).
pub(super) const STEPS_PER_TICK: u32 = 1;
/// Duration of an integration step, s.
pub(super) const STEP_S: f64 = TICK_S / STEPS_PER_TICK as f64;
/// From the launch to the start of the mission, s.
const SETTLING_S: u32 = 60;
/// Time at the surface, mission over, for the position to be fixed, s.
pub(super) const LINGER_S: u32 = 60;
/// A vehicle that is not back this long after its mission's time is up counts as lost, s.
const LOST_AFTER_S: u32 = 6 * 3600;

/// What is shown of each tick: measurements and commands, and the truth behind them before the commands act.
#[derive(Clone, Copy, Debug)]
pub struct Tick<'a> {
    /// Ticks since the start.
    pub tick: u32,
    /// What the controller was told.
    pub measurements: &'a Measurements,
    /// What it answered.
    pub commands: &'a Commands,
    /// What is.
    pub state: &'a State<f64>,
    /// The water at the centre of buoyancy.
    pub water: &'a ocean::Sample,
    /// Depth of the sea floor below it, m, if there is one.
    pub floor_depth_m: Option<f64>,
    /// Electrical energy used so far.
    pub energy: &'a EnergyUsed,
    /// Ideal work p ΔV of the pump so far, J.
    pub pump_work_j: f64,
    /// Charge drawn from the battery so far, C.
    pub charge_c: f64,
}

/// Flies a mission from the surface back to the surface; `observe` sees every tick.
///
/// The vehicle is ballasted for the ocean: it is neutral, its buoyancy device at zero, in water of
/// [`Ocean::ballast_density_kg_m3`]. This changes its displaced volume, not its mass. The controller is not told: it takes pressure
/// for depth by the density of the vehicle file.
///
/// # Errors
/// What the pilot said when it failed to answer.
pub fn fly(
    flying: &FlyingVehicle<'_>,
    ocean: &Ocean,
    mission: &Mission,
    start: &Start,
    seed: u64,
    pilot: &mut dyn Pilot,
    observe: &mut dyn FnMut(&Tick<'_>),
) -> Result<Summary, String> {
    let began = std::time::Instant::now();
    let ballast_density_kg_m3 = ocean.ballast_density_kg_m3(f64::from(mission.dive_to_mm) / f64::from(MM_PER_M));
    let neutral_volume_m3 = flying.vehicle.mass_kg() / ballast_density_kg_m3;
    let plant = Plant::<f64>::new(flying.vehicle).below_surface(&flying.vehicle.hull).neutral_with(neutral_volume_m3);
    let mut state = afloat(flying, ocean, &plant, start, neutral_volume_m3);
    let mut sensors = Sensors::new(flying, start, seed);
    let mut actuators = Actuators::new(flying, neutral_volume_m3);
    let mut log = Log::new();
    let last_tick = mission.max_duration_s.saturating_add(LOST_AFTER_S).saturating_mul(TICK_HZ);
    let mut outcome = Err(Loss::Overdue);
    for tick in 0..=last_tick {
        let time_s = f64::from(tick) * TICK_S;
        let here = ocean.sample(&state.position_m, time_s);
        let floor_depth_m = ocean.floor_depth_m(state.position_m.x, state.position_m.y);
        let measurements = sensors.measure(&state, &here, floor_depth_m, &actuators);
        let commands = pilot.step(tick, &measurements)?;
        let shown = Tick {
            tick,
            measurements: &measurements,
            commands: &commands,
            state: &state,
            water: &here,
            floor_depth_m,
            energy: &actuators.used,
            pump_work_j: actuators.pump_work_j,
            charge_c: actuators.battery.charge_c(),
        };
        log.take(&shown);
        observe(&shown);
        if let Some(loss) = lost(flying, floor_depth_m, state.position_m.z) {
            outcome = Err(loss);
            break;
        }
        if let Some(ended) = log.ended(sensors.antenna_is_clear(&state, &here)) {
            outcome = Ok(ended);
            break;
        }
        state = actuators.advance(&plant, &state, &commands, (ocean, &here, time_s));
    }
    Ok(log.summary(outcome, &actuators, began.elapsed().as_secs_f64()))
}

/// Whether a depth ends the flight.
fn lost(flying: &FlyingVehicle<'_>, floor_depth_m: Option<f64>, depth_m: f64) -> Option<Loss> {
    if depth_m > flying.limits.crush_depth_m {
        Some(Loss::Crushed)
    } else if floor_depth_m.is_some_and(|floor_m| depth_m > floor_m) {
        Some(Loss::Grounded)
    } else {
        None
    }
}

/// Floating at the surface, as light as it gets, nose down.
fn afloat(
    flying: &FlyingVehicle<'_>,
    ocean: &Ocean,
    plant: &Plant<f64>,
    start: &Start,
    neutral_volume_m3: f64,
) -> State<f64> {
    let [_, lightest] = flying.buoyancy.volume_m3;
    let [_, forward] = flying.vehicle.moving_mass.travel_m;
    let mut state = State {
        position_m: Vector3::new(0.0, 0.0, 0.25 * flying.vehicle.hull.length_m),
        quaternion: quaternion_from_euler(&Vector3::new(0.0, -0.5, start.heading_deg.to_radians())),
        r_px_m: forward,
        ..State::at_rest(neutral_volume_m3 + lightest)
    };
    // The splash of the launch settles before the mission starts, and the vehicle drifts off a little.
    for step in (1..=SETTLING_S * TICK_HZ * STEPS_PER_TICK).rev() {
        let water = ocean.from_time(f64::from(step) * -STEP_S);
        state = rk4_step(plant, &state, &Particle::Driven { u_b_m3_s: 0.0 }, STEP_S, &water);
    }
    state
}
