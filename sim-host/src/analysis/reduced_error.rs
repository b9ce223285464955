//! How far the reduced model that flies is from the plant, in both of its arithmetics.

use shared::{
    autopilot::Autopilot,
    commands::Phase,
    device::TICK_S,
    mission::Course,
    model::{
        number::{Fixed, Number},
        reduced::{Drive, Model, Motion},
        table::TrimTable,
    },
};

use crate::analysis::table::{Envelope, describe, flight_vehicle, generate};
use crate::flight::{FlyingVehicle, fly, mission_file::MissionFile, pilot::autopilot};
use crate::model::{
    ocean::Ocean,
    plant::{State, euler_from_quaternion},
    vehicle::Vehicle,
};

/// What the model may be off by from 20 s before an inflection to 60 s after it.
pub const BOUND: ModelError = ModelError { speed_m_s: 1e-4, depth_m: 0.01 };

/// A deep glider's engine: pump and bleed, m³/s.
const SLOW_PUMP_M3_S: [f64; 2] = [1.2e-6, 8e-6];
/// Before and after an inflection, ticks.
const AROUND_TICKS: [usize; 2] = [80, 240];
/// The model is for what is under water, m.
const SUBMERGED_M: f64 = 3.0;

/// Largest errors over a stretch of a flight that the model enters at the true velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ModelError {
    /// Of the speed, m/s.
    pub speed_m_s: f64,
    /// Of the depth, m.
    pub depth_m: f64,
}

/// The same inflection in both arithmetics.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inflection {
    /// How fast the pump was.
    pub pump: &'static str,
    /// In f32.
    pub float: ModelError,
    /// In fixed point.
    pub fixed: ModelError,
}

/// One tick of a flight as the truth has it.
#[derive(Clone, Copy, Debug)]
pub struct Truth {
    phase: Phase,
    state: State<f64>,
    density_kg_m3: f64,
    net_mass_kg: f64,
    reference_density_kg_m3: f64,
}

impl Truth {
    fn drive<N: Number>(&self) -> Drive<N> {
        let euler = euler_from_quaternion(&self.state.quaternion);
        let number = |value: f64| N::new(value as f32);
        Drive {
            pitch_rad: number(euler.y),
            roll_rad: number(euler.x),
            pitch_rate_rad_s: number(self.state.rate_rad_s.y),
            r_px_m: number(self.state.r_px_m),
            net_mass_kg: number(self.net_mass_kg),
            density_ratio: number(self.density_kg_m3 / self.reference_density_kg_m3),
        }
    }
}

/// Every apogee and crest of the paper's Slocum in still water, with its own fast pump, then with a deep glider's.
///
/// Straight ahead, so that the errors are those of the inflection.
///
/// # Errors
/// What keeps the vehicle from flying, in one line.
pub fn inflections() -> Result<Vec<Inflection>, String> {
    let mut file = MissionFile::load("default").map_err(|error| error.to_string())?;
    file.mission.course = Course::Headings([0].into_iter().collect());
    // With a slow pump it overshoots by far, and takes its time: let it.
    (file.mission.abort_depth_mm, file.mission.max_duration_s) = (300_000, 20_000);
    let fast = Vehicle::load(&file.vehicle).map_err(|error| error.to_string())?;
    let mut slow = fast.clone();
    if let Some(buoyancy) = &mut slow.buoyancy {
        [buoyancy.pump_rate_m3_s, buoyancy.bleed_rate_m3_s] = SLOW_PUMP_M3_S;
    }
    let mut all = Vec::new();
    for (pump, vehicle) in [("a fast pump", &fast), ("a slow pump", &slow)] {
        let flight = submerged(vehicle, &file)?;
        for stretch in around_inflections(&flight) {
            let (float, fixed) = (error::<f32>(vehicle, stretch)?, error::<Fixed>(vehicle, stretch)?);
            all.push(Inflection { pump, float, fixed });
        }
    }
    Ok(all)
}

/// Every tick of a mission in still water that is under it.
///
/// # Errors
/// What keeps the vehicle from flying, in one line.
pub fn submerged(vehicle: &Vehicle, file: &MissionFile) -> Result<Vec<Truth>, String> {
    let bytes = generate(vehicle, &Envelope::default())?;
    let table = TrimTable::parse(&bytes).map_err(|error| describe(&error))?;
    let mut pilot: Autopilot<'_> = autopilot(&table, file, &file.parameters)?;
    let flying = FlyingVehicle::new(vehicle)?;
    let ocean = Ocean::still(&vehicle.water);
    let mut truth = Vec::new();
    fly(&flying, &ocean, &file.mission, &file.start, 1, &mut pilot, &mut |tick| {
        let density_kg_m3 = tick.water.around.density_kg_m3;
        truth.push(Truth {
            phase: tick.commands.phase,
            state: *tick.state,
            density_kg_m3,
            net_mass_kg: vehicle.mass_kg() - density_kg_m3 * tick.state.displaced_volume_m3,
            reference_density_kg_m3: vehicle.water.density_kg_m3,
        });
    })?;
    truth.retain(|truth| truth.state.position_m.z > SUBMERGED_M);
    Ok(truth)
}

/// The model's largest errors over a stretch.
///
/// # Errors
/// What the vehicle file lacks to fly, in one line.
pub fn error<N: Number>(vehicle: &Vehicle, stretch: &[Truth]) -> Result<ModelError, String> {
    let flying = flight_vehicle(vehicle, &Envelope::default())?;
    let model = Model::<N>::new(&flying.glide, flying.gravity_m_s2, TICK_S);
    let mut worst = ModelError::default();
    let Some((first, rest)) = stretch.split_first() else { return Ok(worst) };
    let velocity_m_s = first.state.velocity_m_s;
    let mut motion = Motion::new(N::new(velocity_m_s.x as f32), N::new(velocity_m_s.z as f32));
    let sink_m_s =
        |motion: &Motion<N>, drive: &Drive<N>| f64::from(motion.sink_rate_m_s(drive.pitch_rad, drive.roll_rad).value());
    let mut depth_m = first.state.position_m.z;
    let mut before_m_s = sink_m_s(&motion, &first.drive());
    for truth in rest {
        let drive = truth.drive::<N>();
        motion = model.step(&motion, &drive);
        let now_m_s = sink_m_s(&motion, &drive);
        depth_m += 0.5 * f64::from(TICK_S) * (before_m_s + now_m_s);
        before_m_s = now_m_s;
        let off_m_s = f64::from(motion.speed_m_s().value()) - truth.state.velocity_m_s.norm();
        worst.speed_m_s = worst.speed_m_s.max(off_m_s.abs());
        worst.depth_m = worst.depth_m.max((depth_m - truth.state.position_m.z).abs());
    }
    Ok(worst)
}

/// Each apogee and each crest, with some time before and after it.
fn around_inflections(flight: &[Truth]) -> Vec<&[Truth]> {
    let [before, after] = AROUND_TICKS;
    let mut begin = 0;
    let phases = flight.chunk_by(|one, other| one.phase == other.phase);
    let around = phases.filter_map(|phase| {
        let end = begin + phase.len();
        let from = std::mem::replace(&mut begin, end).checked_sub(before)?;
        let is_inflection = matches!(phase.first()?.phase, Phase::Apogee | Phase::Crest);
        is_inflection.then(|| flight.get(from..end + after))?
    });
    around.collect()
}
