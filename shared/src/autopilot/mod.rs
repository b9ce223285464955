//! The controller: one step per tick, from measurements to commands.
//!
//! [`Autopilot::step`] has no clock, no I/O and no allocation, and it cannot fail: all that could be wrong is checked by
//! [`Autopilot::new`].

mod events;
mod targets;

use crate::commands::{Abort, Commands, Learned, Phase};
use crate::control::{
    depth_hold::DepthHold,
    heading::{HeadingLoop, TurnTrim},
    motors::Turns,
    pitch::{PitchLoop, PitchTrim, Steady},
    servo::{Move, Servo},
};
use crate::device::{Measurements, RAD_PER_CDEG, UL_PER_M3, UM_PER_M};
use crate::estimate::{
    navigator::Navigator,
    reversal::{Forecast, Plan},
};
use crate::math;
use crate::mission::{
    Course, Event, Executive, Mission, Unflyable,
    guidance::{Guide, Sight},
};
use crate::model::{table::TrimTable, vehicle::Range};
use crate::parameters::{Parameters, Row};
use crate::safety::{
    streak::Streak,
    supervisor::{Supervisor, Vitals, Watch},
};

/// Depth above which the vehicle counts as afloat, m.
const AFLOAT_DEPTH_M: f32 = 1.0;
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
    dive: Side,
    climb: Side,
    apogee_pitch_cdeg: i32,
    pitch_rate_rad_s: f32,
    altitude_samples: u32,
}

/// One of the two glides of a yo.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Side {
    steady: Steady,
    /// Pitch with the wings level, 0.01°.
    pitch_cdeg: i32,
    /// Through the water, m/s.
    horizontal_speed_m_s: f32,
    /// Volume of the buoyancy device, µl.
    vbd_ul: i32,
    /// Rotation of the mass in a spiral, 0.01°.
    spiral_mu_cdeg: i32,
}

/// What does.
#[derive(Clone, Debug, Default)]
struct State {
    navigator: Navigator,
    executive: Executive,
    watch: Watch,
    guide: Guide,
    abort: Option<Abort>,
    /// Tick of the last position fix.
    fix_tick: Option<u32>,
    forecast: Forecast,
    bottom: Streak,
    dive_trim: PitchTrim,
    climb_trim: PitchTrim,
    dive_turn: TurnTrim,
    climb_turn: TurnTrim,
    drift_trim: PitchTrim,
    depth_hold: DepthHold,
    mu_target_cdeg: i32,
    r_px_move: Move,
    mu_move: Move,
    vbd_move: Move,
    /// Whether the axial drive ran in the last tick, or waited for its turn.
    r_px_wanted: bool,
    turns: Turns,
}

/// Where the actuators shall go, and what that is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Targets {
    r_px_um: i32,
    mu_cdeg: i32,
    vbd_ul: i32,
    pitch_cdeg: i32,
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
        let resting = !self.state.is_gliding();
        self.state.navigator.update(self.config.table.vehicle(), tick, measurements, resting);
        if measurements.gps.is_some() {
            self.state.fix_tick = Some(tick);
        }
        self.supervise(tick, measurements);
        self.forecast();
        if let Some(event) = self.event(tick, measurements) {
            self.state.executive.take(tick, event);
        }
        self.guide(tick);
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
            under_way: state.is_gliding(),
            against_model: state.navigator.goes_against_model(tick),
            measurements,
        };
        if let Some(abort) = self.config.supervisor.judge(&mut state.watch, &vitals)
            && state.executive.take(tick, Event::Abort)
        {
            state.abort = Some(abort);
        }
    }

    fn guide(&mut self, tick: u32) {
        let (config, state) = (&self.config, &mut self.state);
        let side = if state.is_on_the_way_up() { &config.climb } else { &config.dive };
        let current_m_s = state.navigator.drift().current_m_s();
        let sight = Sight {
            tick,
            executive: &state.executive,
            navigator: &state.navigator,
            current_m_s: (current_m_s.x, current_m_s.y),
            speed_m_s: side.horizontal_speed_m_s,
        };
        state.guide.update(&config.mission, &sight);
    }

    fn drive(&mut self, measurements: &Measurements, targets: &Targets) -> Commands {
        let (config, state) = (&self.config, &mut self.state);
        state.mu_target_cdeg = targets.mu_cdeg;
        let (mut r_px, mut vbd, mut mu) = (state.r_px_move, state.vbd_move, state.mu_move);
        let rates = [
            config.r_px_servo.rate(&mut r_px, targets.r_px_um, measurements.r_px_um),
            config.vbd_servo.rate(&mut vbd, targets.vbd_ul, measurements.vbd_ul),
            config.mu_servo.rate(&mut mu, targets.mu_cdeg, i32::from(measurements.mu_cdeg)),
        ];
        let coming_up = matches!(state.executive.phase, Phase::Surfacing | Phase::Recovery);
        let [r_px_runs, vbd_runs, mu_runs] = state.turns.take(&config.table.vehicle().power, rates, coming_up);
        let [r_px_rate, vbd_rate, mu_rate] = rates;
        state.r_px_wanted = r_px_rate != 0;
        let r_px_rate = allowed(r_px_runs, r_px_rate, r_px, &mut state.r_px_move);
        let vbd_rate = allowed(vbd_runs, vbd_rate, vbd, &mut state.vbd_move);
        let mu_rate = allowed(mu_runs, mu_rate, mu, &mut state.mu_move);
        let (north_mm, east_mm) = state.navigator.position_mm();
        Commands {
            r_px_rate_um_s: r_px_rate,
            mu_rate_cdeg_s: saturate(mu_rate),
            vbd_rate_ul_s: vbd_rate,
            phase: state.executive.phase,
            yo: state.executive.yo,
            abort: state.abort,
            target_pitch_cdeg: saturate(targets.pitch_cdeg),
            target_heading_cdeg: state.guide.heading_cdeg,
            aim: state.guide.aim,
            north_mm,
            east_mm,
            learned: state.learned(),
        }
    }
}

impl<'a> Config<'a> {
    fn new(table: &TrimTable<'a>, mission: &Mission, parameters: &Parameters) -> Self {
        let actuators = &table.vehicle().actuators;
        let servo =
            |range: Range, rate_up: i32, rate_down: i32, deadband: i32| Servo { range, rate_up, rate_down, deadband };
        let (r_px_rate, mu_rate) = (actuators.r_px_rate_um_s, actuators.mu_rate_cdeg_s);
        let dive = Side::new(table, &mission.course, mission.dive_path_angle_cdeg, mission.dive_net_mass_g);
        let climb = Side::new(table, &mission.course, mission.climb_path_angle_cdeg, mission.climb_net_mass_g);
        Self {
            pitch_rate_rad_s: pitch_rate_rad_s(table, &dive.steady, &climb.steady),
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

    fn actuators(&self) -> &crate::model::vehicle::Actuators {
        &self.table.vehicle().actuators
    }

    /// Axial position for the nearly level pitch of a reversal: the glide's own, scaled by the pitches.
    fn level_off_um(&self, side: &Side, trim: PitchTrim) -> i32 {
        let glide_um = PitchLoop::feed_forward_um(&self.table, &side.steady, 0.0).saturating_add(trim.trim_um);
        let share = self.apogee_pitch_cdeg as f32 / math::abs(side.pitch_cdeg as f32);
        math::round_to_i32(glide_um as f32 * math::clamp(share, 0.0, 1.0))
    }

    /// The reversal that would end a dive or a climb; on the way to a drift it just stops half-way.
    fn reversal(&self, phase: Phase, navigator: &Navigator) -> Plan {
        let actuators = self.actuators();
        let (level_rad, next, vbd_rate_ul_s) = if phase == Phase::Dive {
            (-(self.apogee_pitch_cdeg as f32) * RAD_PER_CDEG, &self.climb, actuators.pump_rate_ul_s)
        } else {
            (self.apogee_pitch_cdeg as f32 * RAD_PER_CDEG, &self.dive, actuators.bleed_rate_ul_s.saturating_neg())
        };
        let net_mass_kg = |nominal_kg: f32| navigator.buoyancy().net_mass_kg(nominal_kg);
        let kg_s = math::abs(vbd_rate_ul_s as f32) / UL_PER_M3 * self.table.vehicle().density_kg_m3;
        Plan {
            level_pitch_rad: level_rad,
            next_pitch_rad: next.pitch_cdeg as f32 * RAD_PER_CDEG,
            pitch_rate_rad_s: self.pitch_rate_rad_s,
            pass_net_mass_kg: net_mass_kg(PASS_SHARE * next.steady.net_mass_kg),
            next_net_mass_kg: net_mass_kg(next.steady.net_mass_kg),
            net_mass_rate_kg_s: kg_s / navigator.buoyancy().drag_factor(),
            slope_kg_m: navigator.buoyancy().slope_kg_m(),
            pitch_first: self.table.vehicle().power.bears_no_pitching_at(vbd_rate_ul_s),
            behind_m: navigator.buoyancy().behind_m(navigator.depth_rate_m_s),
        }
    }
}

impl Side {
    fn new(table: &TrimTable<'_>, course: &Course, path_angle_cdeg: i16, net_mass_g: i16) -> Self {
        let steady = Steady {
            path_angle_rad: f32::from(path_angle_cdeg) * RAD_PER_CDEG,
            net_mass_kg: f32::from(net_mass_g) * KG_PER_G,
        };
        let level = table.look_up(steady.path_angle_rad, steady.net_mass_kg, 0.0);
        Self {
            steady,
            pitch_cdeg: math::round_to_i32(level.pitch_rad / RAD_PER_CDEG),
            horizontal_speed_m_s: level.speed_m_s * math::cos(steady.path_angle_rad),
            vbd_ul: table.vehicle().vbd_ul(net_mass_g),
            spiral_mu_cdeg: match course {
                Course::Headings(_) | Course::Waypoints(_) => 0,
                Course::Spiral(mooring) => spiral_mu_cdeg(table, &steady, mooring.turn_rate_cdeg_s),
            },
        }
    }
}

/// Rotation of the mass that turns at a rate, 0.01°.
fn spiral_mu_cdeg(table: &TrimTable<'_>, steady: &Steady, turn_rate_cdeg_s: i16) -> i32 {
    let (rate_rad_s, limit_rad) = (f32::from(turn_rate_cdeg_s) * RAD_PER_CDEG, table.mu_limit_rad());
    let mut mu_rad = 0.0;
    // Each call takes two steps from where it starts, and authority depends only a little on the rotation.
    for _ in 0..2 {
        mu_rad = table.mu_for_turn(steady.path_angle_rad, steady.net_mass_kg, rate_rad_s, mu_rad, limit_rad);
    }
    math::round_to_i32(mu_rad / RAD_PER_CDEG)
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

    /// Whether the vehicle flies on its wings: not afloat, and not adrift.
    fn is_gliding(&self) -> bool {
        match self.executive.phase {
            Phase::Surface | Phase::Complete | Phase::Drift => false,
            Phase::Recovery => self.navigator.depth_m >= AFLOAT_DEPTH_M,
            Phase::Dive | Phase::Apogee | Phase::Climb | Phase::Crest | Phase::Surfacing => true,
        }
    }

    /// Whether the glide under way or next is a climb.
    const fn is_on_the_way_up(&self) -> bool {
        match self.executive.phase {
            Phase::Surface | Phase::Dive | Phase::Crest => false,
            Phase::Drift | Phase::Apogee | Phase::Climb | Phase::Surfacing | Phase::Complete | Phase::Recovery => true,
        }
    }
}

/// The rate of a motor that may run or must wait. A move that must wait before its first tick has not begun.
const fn allowed(runs: bool, rate: i32, next: Move, state: &mut Move) -> i32 {
    if runs || rate == 0 {
        *state = next;
        rate
    } else {
        0
    }
}

/// The nearest `i16`.
fn saturate(value: i32) -> i16 {
    i16::try_from(value).unwrap_or(if value < 0 { i16::MIN } else { i16::MAX })
}

#[cfg(test)]
mod tests;
