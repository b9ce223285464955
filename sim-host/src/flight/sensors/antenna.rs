//! The antenna on the tail, and what hears through it.

use shared::device::TICK_HZ;

use crate::model::{
    ocean::Sample,
    plant::{State, rotation_from_quaternion},
};

/// Antenna above the tail, along the hull's axis, m.
const ANTENNA_M: f64 = 0.2;
/// Height of the antenna's tip at which waves no longer wash it, m.
const CLEAR_M: f64 = 0.05;
/// Time under water that a search survives: waves wash over the antenna, s.
const MEMORY_S: u32 = 20;

/// The antenna of one vehicle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Antenna {
    /// Its tip aft of the centre of buoyancy, m.
    tip_m: f64,
}

impl Antenna {
    pub(super) fn on_hull(length_m: f64) -> Self {
        Self { tip_m: 0.5 * length_m + ANTENNA_M }
    }

    /// Whether it is out of the water.
    pub(super) fn is_clear(self, state: &State<f64>, here: &Sample) -> bool {
        let down = rotation_from_quaternion(&state.quaternion).row(2).transpose();
        state.position_m.z + here.around.surface_m - down.x * self.tip_m < -CLEAR_M
    }
}

/// A receiver that needs the antenna clear for some time before it hears.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Receiver {
    clear_ticks: u32,
    under_ticks: u32,
}

impl Receiver {
    /// Takes one tick; tells whether it hears something, `acquisition_s` being the time that it needs.
    pub(super) fn hears(&mut self, antenna_is_clear: bool, acquisition_s: f64) -> bool {
        self.under_ticks = if antenna_is_clear { 0 } else { self.under_ticks.saturating_add(1) };
        if self.under_ticks > MEMORY_S * TICK_HZ {
            self.clear_ticks = 0;
        }
        self.clear_ticks = self.clear_ticks.saturating_add(antenna_is_clear.into());
        antenna_is_clear && f64::from(self.clear_ticks) >= acquisition_s * f64::from(TICK_HZ)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Tick at which it first hears, the antenna being clear from tick to tick as given.
    fn first(clear: impl Fn(u32) -> bool) -> Option<u32> {
        let mut receiver = Receiver::default();
        (1..=800).find(|tick| receiver.hears(clear(*tick), 10.0))
    }

    #[test]
    fn a_search_survives_a_wave_but_no_dive() {
        assert_eq!(first(|_| true), Some(40));
        assert_eq!(first(|_| false), None);
        assert_eq!(first(|tick| tick <= 20 || tick > 100), Some(120), "20 s under a wave");
        assert_eq!(first(|tick| tick <= 20 || tick > 101), Some(141), "a search begun anew");
    }
}
