//! Weight and drag, learned from the depth rate against the reduced model.
//!
//! Sinking goes with the root of net mass over drag, so a glide alone cannot tell a weight error from a drag error: while it
//! lasts, all of the difference counts as weight, which water that grows denser with depth also is. A dive and the climb
//! after it can: a weight error makes one faster and the other slower, a drag error both.
//!
//! How fast the weight changes with depth is learned too: where the water grows denser, a reversal ends in other water than
//! it begins in.

use crate::device::TICK_S;
use crate::math;
use crate::parameters::Parameters;

/// Time after buoyancy last changed before a glide counts as steady, s: speed is then the polar's to a few percent.
const SETTLE_S: f32 = 40.0;
/// Time in which a difference of depth rates is learned, s: no shorter than the speed's own lag of some 20 s.
const LEARNING_S: f32 = 25.0;
/// Change of net mass that is more than the buoyancy device's noise, kg.
const CHANGE_KG: f32 = 0.01;
/// Depth over which the offset may change by all of its limit, m: the sharpest pycnocline that is believed.
const SHARPEST_M: f32 = 10.0;
/// Slower than this, vertical speed says nothing about weight, m/s.
const SLOW_M_S: f32 = 0.05;
/// Steady time that a glide needs to be compared with the next, s.
const LEAST_S: f32 = 60.0;
/// Drag is half-way corrected after each pair of glides.
const SHARE: f32 = 0.5;
const KG_PER_G: f32 = 1e-3;

/// What is known of weight and drag.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Buoyancy {
    limit_kg: f32,
    drag_limit: f32,
    /// Net mass beyond the buoyancy device's, kg, positive sinks.
    offset_kg: f32,
    /// Drag of the vehicle file over the true one.
    thrust: f32,
    /// Change of the offset with depth, kg/m.
    slope_kg_m: f32,
    glide: Glide,
    before: Option<Mean>,
}

/// The glide under way: its nominal net mass, for how long it is steady, and the offset over that time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Glide {
    net_mass_kg: f32,
    since_s: f32,
    sum_kg_s: f32,
    steady_s: f32,
}

/// Nominal net mass and mean offset of a whole glide, kg.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mean {
    net_mass_kg: f32,
    offset_kg: f32,
}

impl Buoyancy {
    /// Knows nothing yet.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        Self {
            limit_kg: parameters.buoyancy_limit_g as f32 * KG_PER_G,
            drag_limit: parameters.drag_limit_percent as f32 / 100.0,
            offset_kg: 0.0,
            thrust: 1.0,
            slope_kg_m: 0.0,
            glide: Glide::default(),
            before: None,
        }
    }

    /// Net mass beyond the buoyancy device's, kg, positive sinks.
    #[must_use]
    pub const fn offset_kg(&self) -> f32 {
        self.offset_kg
    }

    /// Change of [`Self::net_mass_kg`] with depth, kg/m: negative where the water grows denser.
    #[must_use]
    pub fn slope_kg_m(&self) -> f32 {
        self.slope_kg_m * self.thrust
    }

    /// Way by which the net mass that is known trails the water's changes, m, down positive.
    #[must_use]
    pub fn behind_m(&self, depth_rate_m_s: f32) -> f32 {
        depth_rate_m_s * LEARNING_S
    }

    /// True drag over the vehicle file's.
    #[must_use]
    pub fn drag_factor(&self) -> f32 {
        1.0 / self.thrust
    }

    /// Net mass with which the model of the vehicle file moves as the vehicle does, kg.
    #[must_use]
    pub fn net_mass_kg(&self, nominal_kg: f32) -> f32 {
        (nominal_kg + self.offset_kg) * self.thrust
    }

    /// Takes one tick under way: the buoyancy device's net mass, the model's sinking and what the depth says of it.
    pub fn update(&mut self, nominal_kg: f32, model_m_s: f32, depth_rate_m_s: f32) {
        if math::abs(nominal_kg - self.glide.net_mass_kg) > CHANGE_KG {
            self.end_glide();
            self.glide = Glide { net_mass_kg: nominal_kg, ..Glide::default() };
        }
        self.glide.since_s += TICK_S;
        let mass_kg = self.net_mass_kg(nominal_kg);
        // Pitched against its buoyancy it does not glide.
        let glides = math::abs(model_m_s) > SLOW_M_S && mass_kg * model_m_s > 0.0;
        if self.glide.since_s < SETTLE_S || !glides {
            return;
        }
        // The rate goes with the root of the mass: d mass / d rate = 2 mass / rate.
        let error_kg = 2.0 * mass_kg / model_m_s * (depth_rate_m_s - model_m_s) / self.thrust;
        let learned_kg = self.offset_kg + math::finite_or(error_kg, 0.0) * (TICK_S / LEARNING_S);
        self.offset_kg = math::clamp(learned_kg, -self.limit_kg, self.limit_kg);
        if self.glide.since_s > SETTLE_S + LEARNING_S {
            self.glide.sum_kg_s += self.offset_kg * TICK_S;
            self.glide.steady_s += TICK_S;
            self.learn_slope(error_kg / (LEARNING_S * model_m_s));
        }
    }

    /// Takes the slope at which an offset that trails by the learning time is behind by what it is.
    fn learn_slope(&mut self, slope_kg_m: f32) {
        let change_kg_m = math::finite_or(slope_kg_m, 0.0) - self.slope_kg_m;
        let limit_kg_m = self.limit_kg / SHARPEST_M;
        self.slope_kg_m = math::clamp(self.slope_kg_m + change_kg_m * (TICK_S / LEARNING_S), -limit_kg_m, limit_kg_m);
    }

    /// Compares the glide with the one before it: what differs between a dive and a climb is drag.
    fn end_glide(&mut self) {
        if self.glide.steady_s < LEAST_S {
            return;
        }
        let net_mass_kg = self.glide.net_mass_kg;
        let now = Mean { net_mass_kg, offset_kg: self.glide.sum_kg_s / self.glide.steady_s };
        let Some(before) = self.before.replace(now).filter(|before| before.net_mass_kg * net_mass_kg < 0.0) else {
            return;
        };
        let difference_kg = before.offset_kg - now.offset_kg;
        let thrust = self.thrust * (1.0 + difference_kg / (before.net_mass_kg - net_mass_kg));
        let (least, most) = (1.0 / (1.0 + self.drag_limit), 1.0 + self.drag_limit);
        let moved = math::clamp(self.thrust + SHARE * (thrust - self.thrust), least, most);
        let share = math::finite_or((moved - self.thrust) / (thrust - self.thrust), 0.0);
        self.thrust = moved;
        // As much as became drag is no longer weight; half of the difference was on either side.
        self.offset_kg += share * 0.5 * difference_kg;
        self.before = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MASS_KG: f32 = 0.25;

    /// Flies glides of ten minutes on a polar without lag: rate = 0.3 m/s √(mass / 0.25 kg / drag).
    fn fly(buoyancy: &mut Buoyancy, glides: u32, offset_kg: f32, drag: f32) {
        let rate = |mass_kg: f32| 0.3 * mass_kg.signum() * (mass_kg.abs() / MASS_KG).sqrt();
        for glide in 0..glides {
            let nominal_kg = if glide % 2 == 0 { MASS_KG } else { -MASS_KG };
            for _ in 0..2_400 {
                let truth_m_s = rate((nominal_kg + offset_kg) / drag);
                buoyancy.update(nominal_kg, rate(buoyancy.net_mass_kg(nominal_kg)), truth_m_s);
            }
        }
    }

    #[test]
    fn a_weight_error_is_found_in_one_glide() {
        let mut buoyancy = Buoyancy::new(&Parameters::default());
        fly(&mut buoyancy, 1, 0.03, 1.0);
        // 560 s of learning at 25 s leave nothing of it.
        assert!((buoyancy.offset_kg() - 0.03).abs() < 1e-4, "{buoyancy:?}");
        fly(&mut buoyancy, 2, 0.03, 1.0);
        assert!((buoyancy.drag_factor() - 1.0).abs() < 0.01, "weight is not taken for drag: {buoyancy:?}");
    }

    #[test]
    fn drag_and_weight_are_told_apart_half_way_at_a_time() {
        let mut buoyancy = Buoyancy::new(&Parameters::default());
        fly(&mut buoyancy, 3, 0.02, 1.2);
        let first = 1.0 / buoyancy.drag_factor();
        assert!((first - 0.5 * (1.0 + 1.0 / 1.2)).abs() < 0.01, "half of the way: {buoyancy:?}");
        fly(&mut buoyancy, 24, 0.02, 1.2);
        assert!((buoyancy.drag_factor() - 1.2).abs() < 0.02, "{buoyancy:?}");
        assert!((buoyancy.offset_kg() - 0.02).abs() < 0.004, "{buoyancy:?}");
    }

    #[test]
    fn water_that_grows_denser_is_found_by_its_slope() {
        const SLOPE_KG_M: f32 = -5e-4;
        let mut buoyancy = Buoyancy::new(&Parameters::default());
        let (mut depth_m, mut truth_m_s) = (0.0, 0.0);
        for _ in 0..1_600 {
            truth_m_s = 0.3 * ((MASS_KG + SLOPE_KG_M * depth_m) / MASS_KG).sqrt();
            let model_m_s = 0.3 * (buoyancy.net_mass_kg(MASS_KG) / MASS_KG).sqrt();
            buoyancy.update(MASS_KG, model_m_s, truth_m_s);
            depth_m += truth_m_s * TICK_S;
        }
        // The root is taken for a line over the 3.8 g that the offset trails: a quarter of 1.5 %, of the error and so of the slope.
        assert!((buoyancy.slope_kg_m() / SLOPE_KG_M - 1.0).abs() < 0.01, "{buoyancy:?}");
        let trails_kg = buoyancy.offset_kg() - SLOPE_KG_M * depth_m;
        let told_kg = -buoyancy.slope_kg_m() * buoyancy.behind_m(truth_m_s);
        assert!((trails_kg / told_kg - 1.0).abs() < 0.05, "trails by {trails_kg} kg, told are {told_kg} kg");
    }

    #[test]
    fn nonsense_stays_within_the_limits() {
        let parameters = Parameters::default();
        let mut buoyancy = Buoyancy::new(&parameters);
        for glide in 0..50_u32 {
            for tick in 0..2_000_u32 {
                let rates = [f32::NAN, 1e9, -1e9, 0.0, f32::INFINITY];
                let nominal_kg = if glide % 2 == 0 { 0.3 } else { -0.2 };
                buoyancy.update(nominal_kg, 0.3 * nominal_kg, rates[(tick + glide) as usize % rates.len()]);
                assert!(buoyancy.offset_kg().abs() <= 1.5e-3 * parameters.buoyancy_limit_g as f32, "{buoyancy:?}");
                let sharpest_kg_m = parameters.buoyancy_limit_g as f32 * KG_PER_G / SHARPEST_M;
                assert!(buoyancy.slope_kg_m.abs() <= sharpest_kg_m, "{buoyancy:?}");
                assert!((0.5..=2.0).contains(&buoyancy.drag_factor()), "{buoyancy:?}");
            }
        }
    }

    #[test]
    fn limits_of_zero_turn_it_off() {
        let off = Parameters { buoyancy_limit_g: 0, drag_limit_percent: 0, ..Parameters::default() };
        let mut buoyancy = Buoyancy::new(&off);
        fly(&mut buoyancy, 5, 0.03, 1.2);
        assert_eq!((buoyancy.offset_kg(), buoyancy.slope_kg_m(), buoyancy.drag_factor()), (0.0, 0.0, 1.0));
    }
}
