//! A classical controller to compare the autopilot with: fixed gains, no model of the vehicle, no trim table.
//!
//! It flies the same mission through the same phases, under the same supervisor, with the same servos and the same dead
//! reckoning: what differs is how pitch and heading are held, and when a reversal begins.
//!
//! * Pitch aims at the mission's path angle, since the angle of attack is not known; PID on the axial position.
//! * Heading by the rotation of the mass: PID, held to the ±0.52 rad of a Slocum's battery roll. Which way the mass
//!   turns the vehicle must be told ([`TurnSense`]): no fixed gain can know it.
//! * A reversal begins a fixed share of the pump's time to neutral ahead of its depth.
//!
//! # How it was tuned
//! By hand, on the default mission of slocum-paper in still water with the first 12 seeds of a campaign, one value at a
//! time, from what fielded gliders use: a Slocum's pitch deadband of 3° and battery roll (P 1.0, I 0.03 /s, ±0.52 rad), a
//! Seaglider's axial deadband of 1 mm. It stopped where settling times, heading rms and the number of moves no longer
//! improved together.
//! * Pitch deadband 1.5° and period 8 s: 3° would leave the path angle that far off; 1° and 4 s make three times the moves.
//! * Heading P 2.5: P 1.0 takes 270 s for 30° on this vehicle. No integral: any raised the heading rms, since a yawing
//!   vehicle integrates by itself and this one is symmetric. No damping: it only added moves.

use shared::{
    commands::{Abort, Aim, Commands, Learned, Phase},
    control::servo::{Move, Servo},
    device::{MM_PER_M, Measurements, TICK_HZ},
    estimate::navigator::Navigator,
    math,
    mission::{Course, Event, Executive, Mission, heading_of},
    model::vehicle::{FlightVehicle, Range},
    parameters::Parameters,
    safety::supervisor::{Supervisor, Vitals, Watch},
};

use crate::flight::pilot::Pilot;

/// Axial position, µm, from pitch, 0.01°: forward is nose down, hence the signs.
const PITCH: Pid = Pid { gain: -30.0, gain_per_s: -4.0, gain_s: -60.0, period_s: 8, deadband_cdeg: 150.0 };
/// Rotation of the mass towards the turn, 0.01°, from heading, 0.01°.
const HEADING: Pid = Pid { gain: 2.5, gain_per_s: 0.0, gain_s: 0.0, period_s: 12, deadband_cdeg: 150.0 };
/// A Seaglider's deadband of the axial drive, µm.
const AXIAL_DEADBAND_UM: i32 = 1_000;
/// Rotation limit of a Slocum's battery roll, 0.52 rad, in 0.01°.
const ROTATION: Range = Range { min: -2_980, max: 2_980 };
/// Change of rotation that is not worth a move, 0.01°.
const ROTATION_DEADBAND_CDEG: i32 = 400;
/// Part of the pump's time to neutral by which a reversal begins ahead of its depth: as if the vehicle sank on until
/// neutral, and then stood.
const LEAD_SHARE: f32 = 1.0;
/// Above this depth the wings may leave the water, and heading is left alone, m.
const HEADING_DEPTH_M: f32 = 2.0;
/// Depth above which the vehicle counts as afloat, m.
const AFLOAT_DEPTH_M: f32 = 1.0;
/// Vertical speed below which the vehicle counts as at rest at the surface, m/s.
const AFLOAT_RATE_M_S: f32 = 0.1;

/// Which way the vehicle turns when the mass swings to the left (`mu` > 0).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// To the left.
    Left,
    /// To the right.
    Right,
}

impl Turn {
    const fn sign(self) -> f32 {
        match self {
            Self::Left => -1.0,
            Self::Right => 1.0,
        }
    }
}

/// The sense of turn on both ways.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TurnSense {
    /// On dives.
    pub dive: Turn,
    /// On climbs.
    pub climb: Turn,
}

/// PID with a period and a deadband, within which its output holds.
#[derive(Clone, Copy, Debug)]
struct Pid {
    gain: f32,
    gain_per_s: f32,
    gain_s: f32,
    period_s: u32,
    deadband_cdeg: f32,
}

/// What a [`Pid`] remembers.
#[derive(Clone, Copy, Debug, Default)]
struct PidState {
    sum: f32,
    output: f32,
}

impl Pid {
    /// One tick; the integral stays within the output's range, so it cannot wind up.
    fn step(&self, state: &mut PidState, tick: u32, (error_cdeg, rate_cdeg_s): (f32, f32), range: Range) {
        if !tick.is_multiple_of(self.period_s * TICK_HZ) || error_cdeg.abs() <= self.deadband_cdeg {
            return;
        }
        let held = |value: f32| math::clamp(value, range.min as f32, range.max as f32);
        state.sum = held(state.sum + self.gain_per_s * self.period_s as f32 * error_cdeg);
        state.output = held(self.gain * error_cdeg + state.sum - self.gain_s * rate_cdeg_s);
    }
}

/// The classical controller.
#[derive(Clone, Debug)]
pub struct Baseline {
    vehicle: FlightVehicle,
    mission: Mission,
    sense: TurnSense,
    apogee_pitch_cdeg: i32,
    supervisor: Supervisor,
    watch: Watch,
    servos: [Servo; 3],
    moves: [Move; 3],
    navigator: Navigator,
    executive: Executive,
    abort: Option<Abort>,
    pitch: PidState,
    heading: PidState,
}

impl Baseline {
    /// Of a vehicle's ranges and rates; of the tuning only what concerns phases, servos and supervisor counts.
    ///
    /// The mission must be one that [`Mission::check`] accepts and that this controller knows how to fly: by headings, and
    /// without a drift ([`Baseline::knows`]).
    #[must_use]
    pub fn new(vehicle: &FlightVehicle, mission: &Mission, parameters: &Parameters, sense: TurnSense) -> Self {
        let actuators = &vehicle.actuators;
        let servo = |range, rate_up, rate_down, deadband| Servo { range, rate_up, rate_down, deadband };
        let (axial, rotation) = (actuators.r_px_rate_um_s, actuators.mu_rate_cdeg_s);
        let (pump, bleed) = (actuators.pump_rate_ul_s, actuators.bleed_rate_ul_s);
        Self {
            supervisor: Supervisor::new(mission, parameters),
            watch: Watch::default(),
            servos: [
                servo(actuators.r_px_um, axial, axial, AXIAL_DEADBAND_UM),
                servo(actuators.mu_cdeg, rotation, rotation, ROTATION_DEADBAND_CDEG),
                servo(actuators.vbd_ul, pump, bleed, parameters.vbd_deadband_ul),
            ],
            vehicle: vehicle.clone(),
            mission: mission.clone(),
            sense,
            apogee_pitch_cdeg: parameters.apogee_pitch_cdeg,
            moves: [Move::default(); 3],
            navigator: Navigator::new(parameters),
            executive: Executive::new(),
            abort: None,
            pitch: PidState::default(),
            heading: PidState::default(),
        }
    }

    /// Whether this controller can fly all of a mission.
    #[must_use]
    pub const fn knows(mission: &Mission) -> bool {
        matches!(mission.course, Course::Headings(_)) && mission.drift_time_s == 0
    }

    fn supervise(&mut self, tick: u32, measurements: &Measurements) {
        let navigator = &self.navigator;
        let vitals = Vitals {
            tick,
            depth_mm: navigator.depth_mm(),
            depth_tick: navigator.depth_tick.unwrap_or(0),
            attitude_tick: navigator.attitude_tick.unwrap_or(0),
            under_way: !matches!(self.executive.phase, Phase::Surface | Phase::Complete | Phase::Recovery),
            // It has no model of the vehicle.
            against_model: None,
            measurements,
        };
        if let Some(abort) = self.supervisor.judge(&mut self.watch, &vitals)
            && self.executive.take(tick, Event::Abort)
        {
            self.abort = Some(abort);
        }
    }

    /// What happened that may end the phase.
    fn event(&self, tick: u32, measurements: &Measurements) -> Option<Event> {
        let (mission, navigator, executive) = (&self.mission, &self.navigator, &self.executive);
        let ahead_mm = (navigator.depth_m + navigator.depth_rate_m_s * self.lead_s(executive.phase)) * MM_PER_M;
        let reached_top = ahead_mm <= mission.climb_to_mm as f32;
        let net_mass_g = self.vehicle.net_mass_kg(measurements.vbd_ul) * 1e3;
        let (met, event) = match executive.phase {
            Phase::Surface => (self.is_ready_to_dive(tick), Event::ReadyToDive),
            Phase::Dive => (ahead_mm >= mission.dive_to_mm as f32, Event::DeepEnough),
            Phase::Apogee => (net_mass_g <= 0.5 * f32::from(mission.climb_net_mass_g), Event::Light),
            Phase::Climb if mission.surfaces_after(executive.yo) => (reached_top, Event::LastTopReached),
            Phase::Climb => (reached_top, Event::TopReached),
            Phase::Crest => (net_mass_g >= 0.5 * f32::from(mission.dive_net_mass_g), Event::Heavy),
            Phase::Surfacing => {
                let last = mission.ends_after(executive.yo);
                (
                    self.is_afloat_by_depth() && navigator.depth_rate_m_s.abs() < AFLOAT_RATE_M_S,
                    if last { Event::LastAfloat } else { Event::Afloat },
                )
            }
            Phase::Drift | Phase::Complete | Phase::Recovery => return None,
        };
        met.then_some(event)
    }

    fn is_ready_to_dive(&self, tick: u32) -> bool {
        let navigator = &self.navigator;
        self.executive.has_lasted_s(tick, self.mission.surface_time_s.into())
            && navigator.has_position()
            && navigator.depth_tick == Some(tick)
            && navigator.attitude_tick == Some(tick)
    }

    fn is_afloat_by_depth(&self) -> bool {
        self.navigator.depth_m < AFLOAT_DEPTH_M
    }

    /// Whether the vehicle floats and does not glide.
    fn floats(&self) -> bool {
        match self.executive.phase {
            Phase::Surface | Phase::Complete => true,
            Phase::Recovery => self.is_afloat_by_depth(),
            Phase::Dive | Phase::Drift | Phase::Apogee | Phase::Climb | Phase::Crest | Phase::Surfacing => false,
        }
    }

    /// Time by which a reversal begins ahead of its depth, s.
    fn lead_s(&self, phase: Phase) -> f32 {
        let diving = phase == Phase::Dive;
        let net_mass_g = if diving { self.mission.dive_net_mass_g } else { self.mission.climb_net_mass_g };
        let [_, _, vbd] = &self.servos;
        LEAD_SHARE * vbd.duration_s(-self.vehicle.vbd_ul(net_mass_g))
    }

    fn is_heading_up(&self) -> bool {
        !matches!(self.executive.phase, Phase::Surface | Phase::Dive | Phase::Crest)
    }

    /// Heading of the half-yo under way; an inflection already aims at the next one's.
    fn target_heading_cdeg(&self) -> u16 {
        let next = u16::from(matches!(self.executive.phase, Phase::Crest | Phase::Surface));
        match &self.mission.course {
            Course::Headings(headings) => heading_of(headings, self.executive.yo + next, self.is_heading_up()),
            Course::Waypoints(_) | Course::Spiral(_) => 0,
        }
    }

    fn target_pitch_cdeg(&self) -> i32 {
        match self.executive.phase {
            Phase::Surface | Phase::Drift | Phase::Complete => 0,
            Phase::Dive => self.mission.dive_path_angle_cdeg.into(),
            Phase::Apogee => -self.apogee_pitch_cdeg,
            Phase::Crest => self.apogee_pitch_cdeg,
            Phase::Climb | Phase::Surfacing | Phase::Recovery => self.mission.climb_path_angle_cdeg.into(),
        }
    }

    fn target_vbd_ul(&self) -> i32 {
        match self.executive.phase {
            Phase::Dive | Phase::Crest => self.vehicle.vbd_ul(self.mission.dive_net_mass_g),
            Phase::Drift => 0,
            Phase::Apogee | Phase::Climb => self.vehicle.vbd_ul(self.mission.climb_net_mass_g),
            Phase::Surface | Phase::Surfacing | Phase::Complete | Phase::Recovery => self.vehicle.actuators.vbd_ul.max,
        }
    }

    /// Axial position: PID on pitch under water, nose down afloat, which lifts the antenna out.
    fn target_r_px_um(&mut self, tick: u32) -> i32 {
        let range = self.vehicle.actuators.r_px_um;
        if self.floats() {
            self.pitch = PidState { sum: range.max as f32, output: range.max as f32 };
        } else {
            let attitude = &self.navigator.attitude;
            let error_cdeg = self.target_pitch_cdeg() - i32::from(attitude.pitch_cdeg);
            let errors = (error_cdeg as f32, f32::from(attitude.pitch_rate_cdeg_s));
            PITCH.step(&mut self.pitch, tick, errors, range);
        }
        math::round_to_i32(self.pitch.output)
    }

    /// Rotation of the mass: PID on heading on the glides, hanging down elsewhere.
    fn target_mu_cdeg(&mut self, tick: u32) -> i32 {
        let sense = match self.executive.phase {
            Phase::Dive => self.sense.dive,
            Phase::Climb | Phase::Surfacing => self.sense.climb,
            Phase::Surface | Phase::Drift | Phase::Apogee | Phase::Crest | Phase::Complete | Phase::Recovery => {
                self.heading = PidState::default();
                return 0;
            }
        };
        if self.navigator.depth_m < HEADING_DEPTH_M {
            return 0;
        }
        let attitude = &self.navigator.attitude;
        let error_cdeg = i32::from(self.target_heading_cdeg()) - i32::from(attitude.heading_cdeg);
        let errors = (math::wrap_cdeg(error_cdeg) as f32, f32::from(attitude.yaw_rate_cdeg_s));
        HEADING.step(&mut self.heading, tick, errors, ROTATION);
        math::round_to_i32(sense.sign() * self.heading.output)
    }
}

impl Pilot for Baseline {
    fn step(&mut self, tick: u32, measurements: &Measurements) -> Result<Commands, String> {
        let afloat = self.floats();
        self.navigator.update(&self.vehicle, tick, measurements, afloat);
        self.supervise(tick, measurements);
        if let Some(event) = self.event(tick, measurements) {
            self.executive.take(tick, event);
        }
        let targets = [self.target_r_px_um(tick), self.target_mu_cdeg(tick), self.target_vbd_ul()];
        let positions = [measurements.r_px_um, i32::from(measurements.mu_cdeg), measurements.vbd_ul];
        let [r_px_rate_um_s, mu_rate_cdeg_s, vbd_rate_ul_s] =
            std::array::from_fn(|axis| self.servos[axis].rate(&mut self.moves[axis], targets[axis], positions[axis]));
        let (north_mm, east_mm) = self.navigator.position_mm();
        Ok(Commands {
            r_px_rate_um_s,
            mu_rate_cdeg_s: saturated(mu_rate_cdeg_s),
            vbd_rate_ul_s,
            phase: self.executive.phase,
            yo: self.executive.yo,
            abort: self.abort,
            target_pitch_cdeg: saturated(self.target_pitch_cdeg()),
            target_heading_cdeg: self.target_heading_cdeg(),
            aim: Aim::Heading,
            north_mm,
            east_mm,
            learned: Learned::default(),
        })
    }
}

/// The nearest `i16`.
fn saturated(value: i32) -> i16 {
    i16::try_from(value).unwrap_or(if value < 0 { i16::MIN } else { i16::MAX })
}
