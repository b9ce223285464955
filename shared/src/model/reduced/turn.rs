//! The turn rate: it follows what the trim table gives for the mass's rotation, with a first-order lag.
//!
//! Sway, roll and yaw answer to a rotation of the mass within some hull lengths. The lag's length is chosen, from the
//! linearised lateral model, so that a step of the rotation leads to the right heading once the transient is over. It holds
//! for the middle of the envelope: slocum-paper's is 4 m on its usual dive, nothing on flat glides (they may even overshoot),
//! and tens of metres near the control reversal of its dives.

use crate::model::number::Number;

/// A turn rate on its way to a steady one.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TurnRate<N> {
    /// Turn rate, rad/s, right positive.
    pub rad_s: N,
}

impl<N: Number> TurnRate<N> {
    /// The turn rate `dt_s` later. `steady_rad_s`: what the table gives; `per_length_m`: one over the vehicle's turn length.
    #[must_use]
    pub fn step(self, steady_rad_s: N, speed_m_s: N, per_length_m: N, dt_s: N) -> Self {
        // 1 − exp(−x) to second order, and never beyond the goal.
        let x = speed_m_s * per_length_m * dt_s;
        let share = (x - N::new(0.5) * x * x).clamp(N::new(0.0), N::new(0.5));
        Self { rad_s: self.rad_s + share * (steady_rad_s - self.rad_s) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::number::Fixed;

    /// After a step the heading is behind by the turn length over the speed, to the second order of the time step.
    fn lag_s<N: Number>() -> f32 {
        const STEADY_RAD_S: f32 = 0.01;
        let mut turn = TurnRate { rad_s: N::new(0.0) };
        let mut turned_rad = 0.0;
        for _ in 0..400 {
            let before = turn.rad_s.value();
            turn = turn.step(N::new(STEADY_RAD_S), N::new(0.75), N::new(1.0 / 3.0), N::new(0.25));
            turned_rad += 0.125 * (before + turn.rad_s.value());
        }
        100.0 - turned_rad / STEADY_RAD_S
    }

    #[test]
    fn the_heading_lags_by_the_turn_length_over_the_speed() {
        // 3 m at 0.75 m/s. In fixed point the rate stops short of its goal by a step over the share of 1/16: 1.5e-5 rad/s.
        assert!((lag_s::<f32>() - 4.0).abs() < 0.01, "{} s", lag_s::<f32>());
        assert!((lag_s::<Fixed>() - 4.0).abs() < 0.2, "{} s", lag_s::<Fixed>());
    }
}
