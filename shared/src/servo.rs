//! Drives one actuator to a target: starts seldom, arrives within a tick, then brakes.

use crate::{
    device::{TICK_HZ, TICK_S},
    math,
    vehicle::Range,
};

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
        // A move ends well inside the band that starts one, so noise cannot make it stutter.
        let arrived = distance <= self.deadband / 4;
        state.moving = if state.moving { !arrived } else { distance > self.deadband };
        if !state.moving {
            return 0;
        }
        let whole_tick = error.saturating_mul(TICK_HZ.cast_signed());
        Range { min: self.rate_down.saturating_neg(), max: self.rate_up }.clamp(whole_tick)
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

    #[test]
    fn small_changes_are_not_worth_a_move() {
        let mut state = Move::default();
        assert_eq!(SERVO.rate(&mut state, 20, 0), 0);
        assert_ne!(SERVO.rate(&mut state, 21, 0), 0);
    }
}
