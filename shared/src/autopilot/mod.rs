//! The controller: one step per tick, from measurements to commands.
//!
//! [`Autopilot::step`] has no clock, no I/O and no allocation, and it cannot fail: all that could be wrong is checked by
//! [`Autopilot::new`].

mod events;

use crate::{
    device::{Commands, Learned, Measurements, RAD_PER_CDEG, TICK_HZ, UL_PER_M3, UM_PER_M},
    estimate::reversal::{Forecast, Plan},
    heading::{HeadingLoop, TurnTrim},
    math,
    mission::{Event, Executive, Mission, Phase, Unflyable},
    navigator::Navigator,
    parameters::{Parameters, Row},
    pitch::{PitchLoop, PitchTrim, Steady},
    servo::{Move, Servo},
    streak::Streak,
    supervisor::{Abort, Supervisor, Vitals, Watch},
    table::TrimTable,
    vehicle::{FlightVehicle, Range},
};

/// Depth above which the vehicle counts as afloat, m.
const AFLOAT_DEPTH_M: f32 = 1.0;
/// Depth above which heading is left alone, since the wings are about to leave the water or just entered it, m.
const HEADING_DEPTH_M: f32 = 2.0;
/// Time after an inflection before heading is controlled again, s.
const TURN_SETTLE_S: u32 = 12;
const KG_PER_G: f32 = 1e-3;

/// Why an autopilot cannot be built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigurationError {
    /// A value of the mission cannot be flown by this vehicle.
    Mission(Unflyable),
    /// A parameter is outside its bounds.
    Parameter(&'static Row, i32),
}

/// The whole controller.
#[derive(Clone, Debug)]
pub struct Autopilot<'a> {
    config: Config<'a>,
    state: State,
}

/// What does not change in flight.
#[derive(Clone, Debug)]
struct Config<'a> {
    table: TrimTable<'a>,
    mission: Mission,
    supervisor: Supervisor,
    pitch: PitchLoop,
    heading: HeadingLoop,
    r_px_servo: Servo,
    mu_servo: Servo,
    vbd_servo: Servo,
    dive: Steady,
    climb: Steady,
    dive_pitch_cdeg: i32,
    climb_pitch_cdeg: i32,
    apogee_pitch_cdeg: i32,
    pitch_rate_rad_s: f32,
    altitude_samples: u32,
}

/// What does.
#[derive(Clone, Debug, Default)]
struct State {
    navigator: Navigator,
    executive: Executive,
    watch: Watch,
    abort: Option<Abort>,
    forecast: Forecast,
    bottom: Streak,
    dive_trim: PitchTrim,
    climb_trim: PitchTrim,
    dive_turn: TurnTrim,
    climb_turn: TurnTrim,
    mu_target_cdeg: i32,
    r_px_move: Move,
    mu_move: Move,
    vbd_move: Move,
}

/// Where the actuators shall go, and what that is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Targets {
    r_px_um: i32,
    mu_cdeg: i32,
    vbd_ul: i32,
    pitch_cdeg: i32,
    heading_cdeg: u16,
}

impl<'a> Autopilot<'a> {
    /// Checks a mission and its tuning against the vehicle, and makes ready to fly them.
    ///
    /// # Errors
    /// The first value that cannot be flown.
    pub fn new(table: &TrimTable<'a>, mission: &Mission, parameters: &Parameters) -> Result<Self, ConfigurationError> {
        mission.check(table).map_err(ConfigurationError::Mission)?;
        if let Some((row, value)) = parameters.first_invalid() {
            return Err(ConfigurationError::Parameter(row, value));
        }
        Ok(Self { config: Config::new(table, mission, parameters), state: State::new(parameters) })
    }

    /// One tick: what to do, given what is measured. Ticks count from 0 at 4 Hz.
    pub fn step(&mut self, tick: u32, measurements: &Measurements) -> Commands {
        let afloat = self.state.is_afloat();
        self.state.navigator.update(self.config.table.vehicle(), tick, measurements, afloat);
        self.supervise(tick, measurements);
        self.forecast();
        if let Some(event) = self.event(tick, measurements) {
            self.state.executive.take(tick, event);
        }
        let targets = self.targets(tick, measurements);
        self.drive(measurements, &targets)
    }

    fn supervise(&mut self, tick: u32, measurements: &Measurements) {
        let state = &mut self.state;
        let vitals = Vitals {
            tick,
            depth_mm: state.navigator.depth_mm(),
            depth_tick: state.navigator.depth_tick.unwrap_or(0),
            attitude_tick: state.navigator.attitude_tick.unwrap_or(0),
            under_way: !state.is_afloat(),
            measurements,
        };
        if let Some(abort) = self.config.supervisor.judge(&mut state.watch, &vitals)
            && state.executive.take(tick, Event::Abort)
        {
            state.abort = Some(abort);
        }
    }

    fn targets(&mut self, tick: u32, measurements: &Measurements) -> Targets {
        let actuators = self.config.actuators();
        let (lightest_ul, nose_down_um) = (actuators.vbd_ul.max, actuators.r_px_um.max);
        let heading_cdeg = self.state.heading_cdeg(&self.config.mission);
        let mu_cdeg = self.config.heading.hanging_cdeg(self.state.mu_target_cdeg);
        let level = |r_px_um, vbd_ul, pitch_cdeg| Targets { r_px_um, mu_cdeg, vbd_ul, pitch_cdeg, heading_cdeg };
        let config = &self.config;
        match self.state.executive.phase {
            // The antenna sits in the tail: nose down lifts it out of the water.
            Phase::Surface | Phase::Complete => level(nose_down_um, lightest_ul, 0),
            Phase::Recovery if self.state.navigator.depth_m < AFLOAT_DEPTH_M => level(nose_down_um, lightest_ul, 0),
            Phase::Recovery => {
                let r_px_um = PitchLoop::feed_forward_um(&config.table, &config.climb, 0.0);
                level(r_px_um, lightest_ul, config.pitch_cdeg(&config.climb))
            }
            Phase::Apogee => {
                let r_px_um = config.level_off_um(&config.dive, self.state.dive_trim);
                level(
                    r_px_um,
                    config.vbd_ul(config.mission.climb_net_mass_g),
                    config.apogee_pitch_cdeg.saturating_neg(),
                )
            }
            Phase::Crest => {
                let r_px_um = config.level_off_um(&config.climb, self.state.climb_trim);
                level(r_px_um, config.vbd_ul(config.mission.dive_net_mass_g), config.apogee_pitch_cdeg)
            }
            Phase::Dive => self.glide(tick, measurements, config.dive, config.vbd_ul(config.mission.dive_net_mass_g)),
            Phase::Climb => {
                self.glide(tick, measurements, config.climb, config.vbd_ul(config.mission.climb_net_mass_g))
            }
            Phase::Surfacing => self.glide(tick, measurements, config.climb, lightest_ul),
        }
    }

    /// Holds a steady glide on the heading of the half-yo.
    fn glide(&mut self, tick: u32, measurements: &Measurements, steady: Steady, vbd_ul: i32) -> Targets {
        let (config, state) = (&self.config, &mut self.state);
        let ticks_in_phase = tick.saturating_sub(state.executive.since_tick);
        let heading_cdeg = state.heading_cdeg(&config.mission);
        let pitch_cdeg = config.pitch_cdeg(&steady);
        let attitude = state.navigator.attitude;
        let (trim, turn) = if steady.path_angle_rad < 0.0 {
            (&mut state.dive_trim, &mut state.dive_turn)
        } else {
            (&mut state.climb_trim, &mut state.climb_turn)
        };
        let mu_rad = f32::from(measurements.mu_cdeg) * RAD_PER_CDEG;
        let expected = config.table.look_up(steady.path_angle_rad, steady.net_mass_kg, mu_rad);
        // Beyond the table its axial position is only the edge's: an error there teaches nothing about the trim.
        if state.executive.phase != Phase::Surfacing && !expected.saturated {
            let pitch_error_cdeg = pitch_cdeg.saturating_sub(i32::from(attitude.pitch_cdeg));
            config.pitch.update(trim, &config.table, &steady, ticks_in_phase, pitch_error_cdeg);
        }
        let trim_um = trim.trim_um;
        if state.navigator.depth_m < HEADING_DEPTH_M {
            state.mu_target_cdeg = config.heading.hanging_cdeg(state.mu_target_cdeg);
            turn.begin();
        } else if ticks_in_phase >= TURN_SETTLE_S * TICK_HZ || state.executive.phase == Phase::Surfacing {
            let error_cdeg = math::wrap_cdeg(i32::from(heading_cdeg).saturating_sub(state.navigator.heading_cdeg()));
            state.mu_target_cdeg =
                config.heading.mu_cdeg(turn, &config.table, &steady, ticks_in_phase, error_cdeg, state.mu_target_cdeg);
        } else {
            turn.begin();
        }
        let r_px_um = math::round_to_i32(expected.r_px_m * UM_PER_M).saturating_add(trim_um);
        Targets { r_px_um, mu_cdeg: state.mu_target_cdeg, vbd_ul, pitch_cdeg, heading_cdeg }
    }

    fn drive(&mut self, measurements: &Measurements, targets: &Targets) -> Commands {
        let (config, state) = (&self.config, &mut self.state);
        state.mu_target_cdeg = targets.mu_cdeg;
        let mu_rate = config.mu_servo.rate(&mut state.mu_move, targets.mu_cdeg, i32::from(measurements.mu_cdeg));
        let (north_mm, east_mm) = state.navigator.position_mm();
        Commands {
            r_px_rate_um_s: config.r_px_servo.rate(&mut state.r_px_move, targets.r_px_um, measurements.r_px_um),
            mu_rate_cdeg_s: saturate(mu_rate),
            vbd_rate_ul_s: config.vbd_servo.rate(&mut state.vbd_move, targets.vbd_ul, measurements.vbd_ul),
            phase: state.executive.phase,
            yo: state.executive.yo,
            abort: state.abort,
            target_pitch_cdeg: saturate(targets.pitch_cdeg),
            target_heading_cdeg: targets.heading_cdeg,
            north_mm,
            east_mm,
            learned: state.learned(),
        }
    }
}

impl<'a> Config<'a> {
    fn new(table: &TrimTable<'a>, mission: &Mission, parameters: &Parameters) -> Self {
        let steady = |path_angle_cdeg: i16, net_mass_g: i16| Steady {
            path_angle_rad: f32::from(path_angle_cdeg) * RAD_PER_CDEG,
            net_mass_kg: f32::from(net_mass_g) * KG_PER_G,
        };
        let actuators = &table.vehicle().actuators;
        let servo =
            |range: Range, rate_up: i32, rate_down: i32, deadband: i32| Servo { range, rate_up, rate_down, deadband };
        let (r_px_rate, mu_rate) = (actuators.r_px_rate_um_s, actuators.mu_rate_cdeg_s);
        let dive = steady(mission.dive_path_angle_cdeg, mission.dive_net_mass_g);
        let climb = steady(mission.climb_path_angle_cdeg, mission.climb_net_mass_g);
        let pitch_cdeg = |steady: &Steady| math::round_to_i32(steady.pitch_rad(table) / RAD_PER_CDEG);
        Self {
            pitch_rate_rad_s: pitch_rate_rad_s(table, &dive, &climb),
            dive_pitch_cdeg: pitch_cdeg(&dive),
            climb_pitch_cdeg: pitch_cdeg(&climb),
            supervisor: Supervisor::new(mission, parameters),
            pitch: PitchLoop::new(parameters),
            heading: HeadingLoop::new(parameters),
            r_px_servo: servo(actuators.r_px_um, r_px_rate, r_px_rate, parameters.r_px_deadband_um),
            mu_servo: servo(actuators.mu_cdeg, mu_rate, mu_rate, MU_SERVO_DEADBAND_CDEG),
            vbd_servo: servo(
                actuators.vbd_ul,
                actuators.pump_rate_ul_s,
                actuators.bleed_rate_ul_s,
                parameters.vbd_deadband_ul,
            ),
            dive,
            climb,
            apogee_pitch_cdeg: parameters.apogee_pitch_cdeg,
            altitude_samples: parameters.altitude_samples.unsigned_abs(),
            mission: mission.clone(),
            table: table.clone(),
        }
    }

    fn actuators(&self) -> &crate::vehicle::Actuators {
        &self.table.vehicle().actuators
    }

    fn vbd_ul(&self, net_mass_g: i16) -> i32 {
        let vehicle: &FlightVehicle = self.table.vehicle();
        vehicle.vbd_ul(net_mass_g)
    }

    const fn pitch_cdeg(&self, steady: &Steady) -> i32 {
        if steady.path_angle_rad < 0.0 { self.dive_pitch_cdeg } else { self.climb_pitch_cdeg }
    }

    /// Axial position for the nearly level pitch of a reversal: the glide's own, scaled by the pitches.
    fn level_off_um(&self, steady: &Steady, trim: PitchTrim) -> i32 {
        let glide_um = PitchLoop::feed_forward_um(&self.table, steady, 0.0).saturating_add(trim.trim_um);
        let share = self.apogee_pitch_cdeg as f32 / math::abs(self.pitch_cdeg(steady) as f32);
        math::round_to_i32(glide_um as f32 * math::clamp(share, 0.0, 1.0))
    }

    /// The reversal that would end a dive or a climb.
    fn reversal(&self, phase: Phase, navigator: &Navigator) -> Plan {
        let actuators = self.actuators();
        let (level_rad, next, pump_ul_s) = if phase == Phase::Dive {
            (-(self.apogee_pitch_cdeg as f32) * RAD_PER_CDEG, &self.climb, actuators.pump_rate_ul_s)
        } else {
            (self.apogee_pitch_cdeg as f32 * RAD_PER_CDEG, &self.dive, actuators.bleed_rate_ul_s)
        };
        let net_mass_kg = |nominal_kg: f32| navigator.buoyancy().net_mass_kg(nominal_kg);
        let kg_s = pump_ul_s as f32 / UL_PER_M3 * self.table.vehicle().density_kg_m3;
        Plan {
            level_pitch_rad: level_rad,
            next_pitch_rad: self.pitch_cdeg(next) as f32 * RAD_PER_CDEG,
            pitch_rate_rad_s: self.pitch_rate_rad_s,
            pass_net_mass_kg: net_mass_kg(PASS_SHARE * next.net_mass_kg),
            next_net_mass_kg: net_mass_kg(next.net_mass_kg),
            net_mass_rate_kg_s: kg_s / navigator.buoyancy().drag_factor(),
        }
    }
}

/// Speed at which the axial drive pitches, from one glide of the table to the other, rad/s.
fn pitch_rate_rad_s(table: &TrimTable<'_>, dive: &Steady, climb: &Steady) -> f32 {
    let at = |steady: &Steady| table.look_up(steady.path_angle_rad, steady.net_mass_kg, 0.0);
    let (down, up) = (at(dive), at(climb));
    let slope_rad_m = math::abs(math::finite_or((up.pitch_rad - down.pitch_rad) / (up.r_px_m - down.r_px_m), 0.0));
    table.vehicle().actuators.r_px_rate_um_s as f32 / UM_PER_M * slope_rad_m
}

/// Part of the next glide's net mass from which on a reversal counts as over.
const PASS_SHARE: f32 = 0.5;

/// Rotations finer than this are left alone; the heading loop has a wider band of its own, 0.01°.
const MU_SERVO_DEADBAND_CDEG: i32 = 100;

impl State {
    fn new(parameters: &Parameters) -> Self {
        Self { navigator: Navigator::new(parameters), ..Self::default() }
    }

    fn learned(&self) -> Learned {
        let (buoyancy, drift) = (self.navigator.buoyancy(), self.navigator.drift());
        let climbs = matches!(self.executive.phase, Phase::Climb | Phase::Crest | Phase::Surfacing | Phase::Complete);
        let (trim, turn) =
            if climbs { (&self.climb_trim, &self.climb_turn) } else { (&self.dive_trim, &self.dive_turn) };
        let thousandths = |value: f32| saturate(math::round_to_i32(value * 1e3));
        let current_m_s = drift.current_m_s();
        Learned {
            weight_g: thousandths(buoyancy.offset_kg()),
            drag_permille: thousandths(buoyancy.drag_factor() - 1.0),
            current_north_mm_s: thousandths(current_m_s.x),
            current_east_mm_s: thousandths(current_m_s.y),
            speed_permille: thousandths(drift.speed_error()),
            compass_cdeg: saturate(math::round_to_i32(drift.compass_rad() / RAD_PER_CDEG)),
            turn_bias_mdeg_s: thousandths(turn.bias_rad_s() / (100.0 * RAD_PER_CDEG)),
            trim_um: trim.trim_um,
        }
    }

    fn is_afloat(&self) -> bool {
        match self.executive.phase {
            Phase::Surface | Phase::Complete => true,
            Phase::Recovery => self.navigator.depth_m < AFLOAT_DEPTH_M,
            Phase::Dive | Phase::Apogee | Phase::Climb | Phase::Crest | Phase::Surfacing => false,
        }
    }

    /// Heading of the half-yo under way; an inflection already aims at the next one's.
    fn heading_cdeg(&self, mission: &Mission) -> u16 {
        let yo = self.executive.yo;
        match self.executive.phase {
            Phase::Surface | Phase::Dive => mission.heading_cdeg(yo, false),
            Phase::Crest => mission.heading_cdeg(yo.saturating_add(1), false),
            Phase::Apogee | Phase::Climb | Phase::Surfacing | Phase::Complete | Phase::Recovery => {
                mission.heading_cdeg(yo, true)
            }
        }
    }
}

/// The nearest `i16`.
fn saturate(value: i32) -> i16 {
    i16::try_from(value).unwrap_or(if value < 0 { i16::MIN } else { i16::MAX })
}

#[cfg(test)]
mod tests;
