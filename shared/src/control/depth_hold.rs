//! Depth by small changes of buoyancy, while drifting.
//!
//! A neutral vehicle does not care where it is, so depth is held as a servo would: the depth error asks for a vertical speed,
//! the error of that for a net force, and what force it takes on average is learned. Volume is only moved where the buoyancy
//! drive's own deadband finds it worth a move.

use crate::device::{TICK_HZ, UL_PER_M3};
use crate::math;
use crate::model::vehicle::FlightVehicle;

/// Time between two looks, s.
const PERIOD_S: u32 = 20;
/// Time in which an error of vertical speed shall be gone, s: long against the period.
const RATE_TIME_S: f32 = 60.0;
/// Time in which an error of depth shall be gone, s: four times that of the rate is critically damped.
const DEPTH_TIME_S: f32 = 4.0 * RATE_TIME_S;
/// Time in which a lasting force is learned, s: as slow, which leaves the three together a damping ratio of 0.7.
const FORCE_TIME_S: f32 = DEPTH_TIME_S;
/// Fastest way back to the depth, m/s.
const MOST_RATE_M_S: f32 = 0.05;

/// What was learned of the buoyancy that is neutral, and what is asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DepthHold {
    neutral_ul: f32,
    target_ul: i32,
}

impl DepthHold {
    /// Volume of the buoyancy device, µl, for a depth too shallow by `error_m`, sinking at `sink_rate_m_s`.
    pub fn vbd_ul(&mut self, vehicle: &FlightVehicle, ticks_in_phase: u32, error_m: f32, sink_rate_m_s: f32) -> i32 {
        if ticks_in_phase.checked_rem(PERIOD_S * TICK_HZ) != Some(0) {
            return self.target_ul;
        }
        let wanted_m_s = math::clamp(error_m / DEPTH_TIME_S, -MOST_RATE_M_S, MOST_RATE_M_S);
        let too_fast_m_s = sink_rate_m_s - wanted_m_s;
        // The force that changes the speed of the vehicle and the water with it in the time given, as a volume.
        let ul_per_m_s = vehicle.glide.mass_w_kg * UL_PER_M3 / (RATE_TIME_S * vehicle.weight_density_n_m3());
        let range = vehicle.actuators.vbd_ul;
        let learned_ul = self.neutral_ul + ul_per_m_s * too_fast_m_s * (PERIOD_S as f32 / FORCE_TIME_S);
        self.neutral_ul = math::clamp(learned_ul, range.min as f32, range.max as f32);
        self.target_ul = math::round_to_i32(self.neutral_ul + ul_per_m_s * too_fast_m_s);
        self.target_ul
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::table::{TrimTable, tests::file};

    /// A body without drag, too light by `light_kg` at first, 5 m above its depth and sinking.
    #[test]
    fn a_body_comes_to_its_depth_and_stays_there() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let vehicle = table.vehicle();
        for light_kg in [-0.005_f32, 0.0, 0.005] {
            let (mut hold, mut error_m, mut sink_m_s) = (DepthHold::default(), 5.0_f32, 0.05_f32);
            for tick in 0..4 * 7_200 {
                let vbd_ul = hold.vbd_ul(vehicle, tick, error_m, sink_m_s);
                let force_n = (vehicle.net_mass_kg(vbd_ul) - light_kg) * vehicle.gravity_m_s2;
                sink_m_s += force_n / vehicle.glide.mass_w_kg * 0.25;
                error_m -= sink_m_s * 0.25;
                assert!(error_m.abs() < 12.0, "{light_kg} kg: {error_m} m off after {tick} ticks");
            }
            assert!(error_m.abs() < 0.2 && sink_m_s.abs() < 1e-3, "{light_kg} kg: {error_m} m, {sink_m_s} m/s");
        }
    }
}
