//! A rate that was ordered: it goes stale, and it ends at the end stops.

use shared::model::vehicle::Range;

use crate::BEAT_HZ;

/// Beats for which an order is obeyed: two ticks, so one lost tick does not make a motor stutter.
pub const ORDER_LIFE_BEATS: u8 = 10;

/// The last order to one actuator, in its device unit per second.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Order {
    rate: i32,
    beats_left: u8,
}

impl Order {
    /// None, or one that was not renewed in time.
    pub const STALE: Self = Self { rate: 0, beats_left: 0 };

    /// Begins now, and lasts for [`ORDER_LIFE_BEATS`].
    #[must_use]
    pub const fn new(rate: i32) -> Self {
        Self { rate, beats_left: ORDER_LIFE_BEATS }
    }

    /// The rate for the coming beat; 0 once the order is stale.
    pub fn take_beat(&mut self) -> i32 {
        let Some(left) = self.beats_left.checked_sub(1) else { return 0 };
        self.beats_left = left;
        self.rate
    }
}

/// Slows a rate so that the coming beat ends inside the travel; 0 at an end stop or beyond it.
#[must_use]
pub fn within_travel(rate: i32, position: i32, travel: Range) -> i32 {
    let beats_per_s = BEAT_HZ.cast_signed();
    let room = |stop: i32| stop.saturating_sub(position).saturating_mul(beats_per_s);
    Range { min: room(travel.min).min(0), max: room(travel.max).max(0) }.clamp(rate)
}

/// The share of a full duty that gives a rate, proportionally.
#[must_use]
pub fn duty(rate: i32, full_rate: i32, max_duty: u16) -> u16 {
    let scaled = u64::from(rate.unsigned_abs()).saturating_mul(u64::from(max_duty));
    let duty = scaled.checked_div(u64::from(full_rate.unsigned_abs())).unwrap_or(0);
    u16::try_from(duty).map_or(max_duty, |duty| duty.min(max_duty))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRAVEL: Range = Range { min: -1_000, max: 1_000 };

    #[test]
    fn an_order_goes_stale() {
        let mut order = Order::new(7);
        for _ in 0..ORDER_LIFE_BEATS {
            assert_eq!(order.take_beat(), 7);
        }
        assert_eq!(order.take_beat(), 0);
        assert_eq!(order, Order { rate: 7, ..Order::STALE });
    }

    #[test]
    fn no_beat_ends_outside_the_travel() {
        assert_eq!(within_travel(100, 0, TRAVEL), 100);
        assert_eq!(within_travel(100, 998, TRAVEL), 40);
        assert_eq!(within_travel(100, 1_000, TRAVEL), 0);
        assert_eq!(within_travel(100, 1_500, TRAVEL), 0);
        assert_eq!(within_travel(-100, 1_500, TRAVEL), -100, "the way back stays open");
        assert_eq!(within_travel(-100, -1_001, TRAVEL), 0);
        assert_eq!(within_travel(i32::MAX, i32::MIN, TRAVEL), i32::MAX);
    }

    #[test]
    fn duty_is_proportional_and_held_to_full() {
        assert_eq!(duty(21_000, 42_000, 1_000), 500);
        assert_eq!(duty(-42_000, 42_000, 1_000), 1_000);
        assert_eq!(duty(i32::MIN, 1, u16::MAX), u16::MAX);
        assert_eq!(duty(5, 0, 1_000), 0, "an uncalibrated motor does not run");
    }
}
