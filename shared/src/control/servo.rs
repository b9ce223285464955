//! Drives one actuator to a target: starts seldom, arrives within a tick, then brakes.

use crate::device::{TICK_HZ, TICK_S};
use crate::math;
use crate::model::vehicle::Range;

/// Steps in which a drive's sensor divides its range: 12-bit converters.
const SENSOR_STEPS: i32 = 4_095;

/// How one actuator is driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Servo {
    /// Positions it may be sent to.
    pub range: Range,
    /// Fastest motion towards larger values, per second.
    pub rate_up: i32,
    /// Fastest motion towards smaller values, per second.
    pub rate_down: i32,
    /// Distance that is not worth a move.
    pub deadband: i32,
}

/// Whether a move is under way.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Move {
    /// A move that began and has not arrived.
    pub moving: bool,
}

impl Servo {
    /// The rate to run at until the next tick; 0 brakes.
    pub fn rate(&self, state: &mut Move, target: i32, position: i32) -> i32 {
        let error = self.range.clamp(target).saturating_sub(position);
        let distance = error.saturating_abs();
        let near = self.arrival();
        let far = self.deadband.max(near.saturating_mul(2));
        state.moving = distance > if state.moving { near } else { far };
        if !state.moving {
            return 0;
        }
        let whole_tick = error.saturating_mul(TICK_HZ.cast_signed());
        Range { min: self.rate_down.saturating_neg(), max: self.rate_up }.clamp(whole_tick)
    }

    /// Distance at which a move has arrived: well inside the band that starts one, so that noise cannot make it stutter, and
    /// never finer than the sensor's step, or no position would do.
    const fn arrival(&self) -> i32 {
        let step = (self.range.max.saturating_sub(self.range.min) / SENSOR_STEPS).saturating_add(1);
        let quarter = self.deadband / 4;
        if quarter > step { quarter } else { step }
    }

    /// Time that a move over `distance` takes, s.
    #[must_use]
    pub fn duration_s(&self, distance: i32) -> f32 {
        let rate = if distance > 0 { self.rate_up } else { self.rate_down };
        if rate <= 0 {
            return 0.0;
        }
        math::abs(distance as f32) / rate as f32 + TICK_S
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SERVO: Servo = Servo { range: Range { min: -1_000, max: 1_000 }, rate_up: 100, rate_down: 400, deadband: 20 };

    #[test]
    fn arrives_without_overshoot_and_stays() {
        for target in [900, -900, 37, 5_000] {
            let (mut position, mut state, mut moves) = (0, Move::default(), 0);
            for _ in 0..200 {
                let rate = SERVO.rate(&mut state, target, position);
                assert!((-400..=100).contains(&rate));
                moves += i32::from(rate != 0);
                position += rate / 4;
                assert!(SERVO.range.clamp(position) == position);
            }
            assert!((position - SERVO.range.clamp(target)).abs() <= SERVO.deadband / 4, "{target}: at {position}");
            assert!(moves <= 40, "{target}: {moves} ticks of motion");
        }
    }

    /// An axial drive with 0.7 m of travel: its potentiometer's step is 171 µm, and the vehicle file's deadband may be finer.
    #[test]
    fn no_deadband_makes_it_hunt_between_two_steps_of_its_sensor() {
        let range = Range { min: -350_000, max: 350_000 };
        let step_um = 700_000.0 / 4_095.0;
        for deadband in [50, 300, 1_000] {
            let servo = Servo { range, rate_up: 10_000, rate_down: 10_000, deadband };
            for target in (-300_000..300_000).step_by(7_919) {
                let (mut position, mut state, mut last_motion) = (0, Move::default(), 0);
                for tick in 0..400 {
                    let seen = ((position as f32 / step_um).round() * step_um) as i32;
                    let rate = servo.rate(&mut state, target, seen);
                    position += rate / 4;
                    last_motion = if rate == 0 { last_motion } else { tick };
                }
                // 0.3 m at 1 cm/s is 30 s; the last ticks place it.
                assert!(last_motion < 30 * 4 + 8, "{deadband} µm: still hunts for {target} µm at tick {last_motion}");
            }
        }
    }

    #[test]
    fn small_changes_are_not_worth_a_move() {
        let mut state = Move::default();
        assert_eq!(SERVO.rate(&mut state, 20, 0), 0);
        assert_ne!(SERVO.rate(&mut state, 21, 0), 0);
    }
}
