//! One drive of the moving mass: motor, screw or gear with play, brake, end stops.

use crate::model::vehicle::{AxialDrive, MovingMass, RotationDrive};

/// Speed of a motor without load over the speed that it is regulated to (chosen): so it slows from 20 % of its stall load on.
const FREE_SPEED: f64 = 1.25;
/// From the end of the motor's motion until the brake has closed, s (chosen).
const BRAKE_S: f64 = 0.125;
/// Share of a gap to a flank or stop that one sub-step closes: 6 − √32, with which the trapezoid of the rates settles fastest,
/// to 41 % per sub-step and without swinging.
const CLOSING: f64 = 0.343;

/// One axis, in m and N along the hull, in rad and N m about it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    pub(super) ends: [f64; 2],
    pub(super) rate: f64,
    acceleration: f64,
    pub(super) friction: f64,
    backlash: f64,
    stall: f64,
    pub(super) brake: f64,
    efficiency: f64,
    idle_power_w: f64,
}

/// Motor and brake of one axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Motor {
    /// Where the screw would have the mass, in the middle of the play.
    screw: f64,
    speed: f64,
    /// Force last given, N or N m.
    load: f64,
    /// Time since the motor stopped, s.
    still_s: f64,
    /// Where the brake closed on the mass.
    pub(super) clamped_at: Option<f64>,
}

impl Axis {
    pub(super) fn axial(mass: &MovingMass, drive: &AxialDrive) -> Self {
        Self {
            ends: mass.travel_m,
            rate: mass.rate_m_s,
            acceleration: drive.acceleration_m_s2,
            friction: drive.friction_n,
            backlash: drive.backlash_m,
            stall: drive.stall_n,
            brake: drive.brake_n,
            efficiency: drive.efficiency,
            idle_power_w: drive.idle_power_w,
        }
    }

    pub(super) fn rotation(mass: &MovingMass, drive: &RotationDrive) -> Self {
        Self {
            ends: mass.roll_deg.map(f64::to_radians),
            rate: mass.roll_rate_deg_s.to_radians(),
            acceleration: drive.acceleration_deg_s2.to_radians(),
            friction: drive.friction_nm,
            backlash: drive.backlash_deg.to_radians(),
            stall: drive.stall_nm,
            brake: drive.brake_nm,
            efficiency: drive.efficiency,
            idle_power_w: drive.idle_power_w,
        }
    }

    /// Whether a force at a position comes from an end stop.
    fn stop_gives(&self, force: f64, position: f64) -> bool {
        let [low, high] = self.ends;
        (position <= low && force > 0.0) || (position >= high && force < 0.0)
    }
}

impl Motor {
    /// Clamped where the mass is.
    pub(super) fn braked(position: f64) -> Self {
        Self { screw: position, still_s: BRAKE_S, clamped_at: Some(position), ..Self::default() }
    }

    /// Follows a commanded speed for `dt_s`; the brake opens for the first motion and closes when all motion has ended.
    pub(super) fn follow(&mut self, axis: &Axis, command: f64, position: f64, dt_s: f64) {
        if command == 0.0 && self.speed == 0.0 {
            self.still_s += dt_s;
            if self.still_s > BRAKE_S {
                self.clamped_at.get_or_insert(position);
            }
            return;
        }
        (self.clamped_at, self.still_s) = (None, 0.0);
        let against = self.load * command.signum();
        let able = axis.rate * (FREE_SPEED * (1.0 - against / axis.stall)).clamp(0.0, 1.0);
        let most = axis.acceleration * dt_s;
        self.speed += (command.clamp(-able, able) - self.speed).clamp(-most, most);
        let [low, high] = axis.ends;
        let screw = self.screw + self.speed * dt_s;
        self.screw = screw.clamp(low - 0.5 * axis.backlash, high + 0.5 * axis.backlash);
        if self.screw != screw {
            self.speed = 0.0;
        }
    }

    /// Rate at which the mass shall be after `dt_s`, if it would have `rate` without drive, brake or stops.
    ///
    /// `slowing` is what friction can take from a rate in that time. A flank of the play or a stop gives as much force as it takes
    /// not to be passed, and none outwards: impact without rebound.
    pub(super) fn next_rate(&self, axis: &Axis, position: f64, rate: f64, slowing: f64, dt_s: f64) -> f64 {
        if let Some(place) = self.clamped_at {
            return CLOSING * (place - position) / dt_s;
        }
        // Speed of a bound, what is left to it, and whether it has been passed.
        let bound = |speed: f64, gap: f64, passed: bool| speed + if passed { CLOSING } else { 1.0 } * gap / dt_s;
        let [low, high] = axis.ends.map(|end| end - position);
        // The flanks at the beginning of the sub-step.
        let screw = self.screw - self.speed * dt_s - position;
        let (behind, ahead) = (screw - 0.5 * axis.backlash, screw + 0.5 * axis.backlash);
        let least = bound(self.speed, behind, behind > 0.0).max(bound(0.0, low, low > 0.0));
        let most = bound(self.speed, ahead, ahead < 0.0).min(bound(0.0, high, high < 0.0));
        let slowed = rate.signum() * (rate.abs() - slowing).max(0.0);
        slowed.max(least).min(most.max(least))
    }

    /// Takes note of the force that drive, friction and stops together gave; returns the electrical energy of `dt_s`, J.
    pub(super) fn work(&mut self, axis: &Axis, force: f64, position: f64, rate: f64, dt_s: f64) -> f64 {
        if self.clamped_at.is_some() {
            self.load = 0.0;
            return 0.0;
        }
        // Friction acts against the motion, so the motor gives it on top.
        self.load = if axis.stop_gives(force, position) { 0.0 } else { force + axis.friction * rate.signum() };
        (axis.idle_power_w + (self.load * self.speed).max(0.0) / axis.efficiency) * dt_s
    }

    /// What of a force the brake gives, if it is closed: beyond its rating it slips, and the screw goes along.
    pub(super) fn brake(&mut self, axis: &Axis, force: f64, position: f64) -> f64 {
        if self.clamped_at.is_none() || force.abs() <= axis.brake || axis.stop_gives(force, position) {
            return force;
        }
        self.clamped_at = Some(position.clamp(axis.ends[0], axis.ends[1]));
        self.screw = self.screw.clamp(position - 0.5 * axis.backlash, position + 0.5 * axis.backlash);
        force.clamp(-axis.brake, axis.brake)
    }
}
