//! The way that a reversal of buoyancy still takes, from the reduced model rolled forward.
//!
//! A forecast starts from the motion under way and lets the drives run as the autopilot will let them: buoyancy towards
//! the next glide's, pitch first to its nearly level value, then, once light enough, to the next glide's; one at a time
//! where the supply does not bear both. It ends where the vertical speed changes sign. A slow pump takes minutes for
//! that, so a forecast advances some steps per tick, and is some seconds old when it is done.
//!
//! On its way the water goes on changing as it did: by the net mass's slope over depth.

use crate::math;
use crate::model::reduced::{Drive, Model, Motion};

/// Time step of a forecast, s: a twentieth of the time in which speed follows.
pub const STEP_S: f32 = 1.0;
/// Steps per tick: five minutes of reversal in nine seconds. With a quarter of them the apogees of a slow pump are off by
/// twice as much in water that changes with depth.
const STEPS: u32 = 8;
/// Time by which pitch follows the mass and the mass its order, s.
const PITCH_LAG_S: f32 = 1.5;
/// Pitch error at which its move is over, rad: what a mass within 1 mm of its place leaves at most.
const PITCHED_RAD: f32 = 0.005;
/// A reversal that takes longer is not one, s.
const LONGEST_S: f32 = 900.0;

/// What the autopilot will do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plan {
    /// Pitch while the buoyancy reverses, rad.
    pub level_pitch_rad: f32,
    /// Pitch of the glide after it, rad.
    pub next_pitch_rad: f32,
    /// Speed at which the axial drive pitches, rad/s.
    pub pitch_rate_rad_s: f32,
    /// Net mass at which pitch goes on to the next glide's, kg.
    pub pass_net_mass_kg: f32,
    /// Net mass of the next glide, kg.
    pub next_net_mass_kg: f32,
    /// Speed at which pump or bleed change it, kg/s.
    pub net_mass_rate_kg_s: f32,
    /// Whether buoyancy waits while the axial drive pitches, for want of power.
    pub pitch_first: bool,
    /// Change of net mass with depth, kg/m.
    pub slope_kg_m: f32,
    /// Way by which what is known of the net mass trails the water's changes, m, down positive.
    pub behind_m: f32,
}

/// Where a reversal that begins now would turn, found a few steps at a time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Forecast {
    under_way: Option<Rollout>,
    lead_m: f32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Rollout {
    motion: Motion<f32>,
    drive: Drive<f32>,
    sink_rate_m_s: f32,
    sinking: bool,
    passed: bool,
    time_s: f32,
    way_m: f32,
}

impl Forecast {
    /// Depth between the begin of a reversal and its turning point, m, down positive; 0 until the first forecast is done.
    #[must_use]
    pub const fn lead_m(&self) -> f32 {
        self.lead_m
    }

    /// Forgets it all: another glide began.
    pub fn reset(&mut self) {
        *self = Self::default();
    }

    /// Goes on with the forecast, from `motion` under `drive` if none is under way.
    pub fn advance(&mut self, model: &Model<f32>, plan: &Plan, motion: &Motion<f32>, drive: &Drive<f32>) {
        let mut rollout = self.under_way.unwrap_or_else(|| Rollout::new(motion, drive));
        for _ in 0..STEPS {
            if rollout.step(model, plan) {
                self.lead_m = rollout.way_m;
                self.under_way = None;
                return;
            }
        }
        self.under_way = Some(rollout);
    }
}

impl Rollout {
    fn new(motion: &Motion<f32>, drive: &Drive<f32>) -> Self {
        let sink_rate_m_s = motion.sink_rate_m_s(drive.pitch_rad, drive.roll_rad);
        Self {
            // What the mass did a tick ago is not to be taken for what it does in a whole step.
            motion: Motion::new(motion.u_m_s, motion.w_m_s),
            drive: Drive { pitch_rate_rad_s: 0.0, ..*drive },
            sink_rate_m_s,
            sinking: sink_rate_m_s > 0.0,
            passed: false,
            time_s: 0.0,
            way_m: 0.0,
        }
    }

    /// One step; whether the vertical speed changed sign.
    fn step(&mut self, model: &Model<f32>, plan: &Plan) -> bool {
        let before_m_s = self.sink_rate_m_s;
        self.time_s += STEP_S;
        let (pitch_rad, net_mass_kg) = (self.drive.pitch_rad, self.drive.net_mass_kg);
        let pitching = math::abs(self.goal_rad(plan) - pitch_rad) > PITCHED_RAD;
        let most_kg = if plan.pitch_first && pitching { 0.0 } else { plan.net_mass_rate_kg_s * STEP_S };
        let net_mass_kg = toward(net_mass_kg, plan.next_net_mass_kg, most_kg);
        self.drive.net_mass_kg = net_mass_kg;
        self.passed |=
            if self.sinking { net_mass_kg <= plan.pass_net_mass_kg } else { net_mass_kg >= plan.pass_net_mass_kg };
        if self.time_s > PITCH_LAG_S {
            self.drive.pitch_rad = toward(pitch_rad, self.goal_rad(plan), plan.pitch_rate_rad_s * STEP_S);
        }
        self.drive.pitch_rate_rad_s = (self.drive.pitch_rad - pitch_rad) / STEP_S;
        let water_kg = plan.slope_kg_m * (plan.behind_m + self.way_m);
        let drive = Drive { net_mass_kg: net_mass_kg + water_kg, ..self.drive };
        self.motion = model.step(&self.motion, &drive);
        self.sink_rate_m_s = self.motion.sink_rate_m_s(self.drive.pitch_rad, self.drive.roll_rad);
        self.way_m += 0.5 * (before_m_s + self.sink_rate_m_s) * STEP_S;
        (self.sink_rate_m_s > 0.0) != self.sinking || self.time_s >= LONGEST_S
    }

    /// Where pitch is to go.
    const fn goal_rad(&self, plan: &Plan) -> f32 {
        if self.passed { plan.next_pitch_rad } else { plan.level_pitch_rad }
    }
}

/// `from`, brought towards `to` by at most `step`.
fn toward(from: f32, to: f32, step: f32) -> f32 {
    from + math::clamp(to - from, -step, step)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::table::{TrimTable, tests::file};

    const PITCH_RAD: f32 = -0.59;
    const NET_MASS_KG: f32 = 0.2129;

    /// A reversal at one pitch throughout.
    fn plan(net_mass_rate_kg_s: f32, slope_kg_m: f32) -> Plan {
        Plan {
            level_pitch_rad: PITCH_RAD,
            next_pitch_rad: 0.59,
            pitch_rate_rad_s: 0.02,
            pass_net_mass_kg: -0.1,
            next_net_mass_kg: -NET_MASS_KG,
            net_mass_rate_kg_s,
            pitch_first: false,
            slope_kg_m,
            behind_m: 0.0,
        }
    }

    /// The turning depth of the made-up vehicle with a plan, and the sinking it starts from.
    fn turns_by_m(plan: &Plan) -> (f32, f32) {
        let file = file();
        let vehicle = TrimTable::parse(&file).unwrap().vehicle().clone();
        let drive = Drive {
            pitch_rad: PITCH_RAD,
            roll_rad: 0.0,
            pitch_rate_rad_s: 0.0,
            r_px_m: 0.0,
            net_mass_kg: NET_MASS_KG,
            density_ratio: 1.0,
        };
        let model = Model::new(&vehicle.glide, vehicle.gravity_m_s2, STEP_S);
        let glide = (0..300).fold(Motion::at_rest(), |motion, _| model.step(&motion, &drive));
        let mut forecast = Forecast::default();
        for _ in 0..(LONGEST_S / STEP_S) as u32 {
            forecast.advance(&model, plan, &glide, &drive);
        }
        (forecast.lead_m(), glide.sink_rate_m_s(PITCH_RAD, 0.0))
    }

    fn turns_after_m(net_mass_rate_kg_s: f32, slope_kg_m: f32) -> (f32, f32) {
        turns_by_m(&plan(net_mass_rate_kg_s, slope_kg_m))
    }

    /// A pump that waits until the nose is up loses that time, and no more than the way of that time at full speed.
    #[test]
    fn a_pump_that_waits_for_pitch_turns_deeper_by_part_of_the_way_of_pitching() {
        let at_once = Plan { level_pitch_rad: -0.09, ..plan(NET_MASS_KG / 120.0, 0.0) };
        let (at_once_m, sink_m_s) = turns_by_m(&at_once);
        let (in_turn_m, _) = turns_by_m(&Plan { pitch_first: true, ..at_once });
        let pitching_s = (0.59 - 0.09) / 0.02;
        let deeper_m = in_turn_m - at_once_m;
        assert!(deeper_m > 0.0 && deeper_m < pitching_s * sink_m_s, "{at_once_m} m, {in_turn_m} m in turn");
    }

    /// When the pump is slow the speed follows the root of the net mass: ∫√(1 − t/T) over T is 2/3 T.
    #[test]
    fn a_slow_reversal_takes_two_thirds_of_the_way_at_full_speed() {
        let (lead_m, sink_m_s) = turns_after_m(NET_MASS_KG / 600.0, 0.0);
        let quasi_steady_m = 2.0 / 3.0 * sink_m_s * 600.0;
        // Speed V lags by τ V₀/V, τ = m₁/(2 D₀ V₀) = 18 s, which adds τ ln(V₀/V) at V₀: 36 s of 400 s down to an eighth of it.
        assert!((1.06..1.12).contains(&(lead_m / quasi_steady_m)), "{lead_m} m, {quasi_steady_m} m quasi-steadily");
    }

    #[test]
    fn a_fast_reversal_leaves_the_way_of_coasting() {
        let (fast_m, sink_m_s) = turns_after_m(1.0, 0.0);
        let (slow_m, _) = turns_after_m(NET_MASS_KG / 60.0, 0.0);
        assert!((0.5 * sink_m_s..20.0 * sink_m_s).contains(&fast_m) && fast_m < slow_m, "{fast_m} m, {slow_m} m");
    }

    #[test]
    fn a_pump_that_stands_still_ends_no_forecast_in_nonsense() {
        let (lead_m, sink_m_s) = turns_after_m(0.0, 0.0);
        assert!((lead_m / (sink_m_s * LONGEST_S) - 1.0).abs() < 0.01, "{lead_m} m");
    }

    /// Without a pump it sinks to where it is neutral, and past it: V² follows the net mass within m₁/(2 D₀) of way.
    #[test]
    fn denser_water_turns_a_dive_by_itself() {
        const NEUTRAL_M: f32 = 40.0;
        let (lead_m, sink_m_s) = turns_after_m(0.0, -NET_MASS_KG / NEUTRAL_M);
        // τ V₀ of way, of it sink/V₀ downwards; a tenth for the angle of attack, which is another one when V² lags.
        let coasting_m = 18.0 * sink_m_s;
        assert!((lead_m / (NEUTRAL_M + coasting_m) - 1.0).abs() < 0.1, "{lead_m} m, {coasting_m} m of it coasting");
    }
}
