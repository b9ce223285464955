//! How a buoyancy engine is built: what its file says beyond range, rates and efficiency, and what follows at a pressure.
//!
//! Optional keys of `[buoyancy]`: `kind` (`"piston"`, the default, with `dead_zone_m3`; or `"bladder"`, with `vacuum_pa` and
//! `full_bleed_head_pa`), `pump_rate_at`, `pump_power_at`, `bleed_power_w`, `pot_step_m3`, `pot_noise_m3`.

use serde::Serialize;

use super::{Buoyancy, Limits, Water};
use crate::files::toml_file::{Rule, Section};

/// Depths at which the pump's power is looked at for its most: its tables have a kink every 100 m or so.
const DEPTH_STEPS: u32 = 1_000;
/// Steps of a 12-bit potentiometer over the range of volumes.
const POT_STEPS: f64 = 4096.0;
/// Vacuum in the hull: 8 inHg, the middle of the 4 to 12 inHg at which fielded gliders neither warn nor abort.
const VACUUM_PA: f64 = 27e3;
/// Chosen: the valve is wide open, and its flow limited on purpose, from 10 m on.
const FULL_BLEED_HEAD_PA: f64 = 1e5;

/// How a buoyancy engine is built.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Engine {
    /// What moves the water.
    pub kind: EngineKind,
    /// Most that is pumped, as (gauge pressure in Pa, m³/s), pressure rising; empty: `pump_rate_m3_s` at every pressure.
    pub pump_rate_at: Vec<[f64; 2]>,
    /// Electrical power of the pump at its full rate, as (gauge pressure in Pa, W); empty: from efficiency and idle power.
    pub pump_power_at: Vec<[f64; 2]>,
    /// Electrical power while bleeding: a valve held open, or a motor that draws a piston back, W.
    pub bleed_power_w: f64,
    /// Step of the position potentiometer, m³ (default: 12 bits over the range).
    pub pot_step_m3: f64,
    /// Noise of the position potentiometer, m³ (standard deviation).
    pub pot_noise_m3: f64,
}

/// What moves the water.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum EngineKind {
    /// A motor drives a piston both ways, whatever the pressure.
    Piston {
        /// Its own control leaves a demand alone that is nearer to where it stands than this, m³; a move, once begun, ends anywhere.
        dead_zone_m3: f64,
    },
    /// Oil is pumped into an outer bladder, and comes back through a valve by the pressure difference alone.
    Bladder {
        /// Air pressure outside less the pressure in the hull, Pa: all that brings the oil in at the surface. Negative: lost.
        vacuum_pa: f64,
        /// Pressure difference from which on the valve passes `bleed_rate_m3_s`; below, flow goes with its square root.
        full_bleed_head_pa: f64,
    },
}

impl Engine {
    pub(super) fn read(buoyancy: &mut Section<'_>, [low, high]: [f64; 2]) -> Self {
        let kinds = [("piston", true), ("bladder", false)];
        let kind = if buoyancy.choice_or_first("kind", &kinds).unwrap_or(true) {
            EngineKind::Piston { dead_zone_m3: buoyancy.number_or("dead_zone_m3", Rule::NotNegative, 0.0) }
        } else {
            EngineKind::Bladder {
                vacuum_pa: buoyancy.number_or("vacuum_pa", Rule::Within(-1e5, 1e5), VACUUM_PA),
                full_bleed_head_pa: buoyancy.number_or("full_bleed_head_pa", Rule::Positive, FULL_BLEED_HEAD_PA),
            }
        };
        Self {
            kind,
            pump_rate_at: table(buoyancy, "pump_rate_at", "rows of [pressure in Pa, rising; rate above 0 in m³/s]"),
            pump_power_at: table(buoyancy, "pump_power_at", "rows of [pressure in Pa, rising; power above 0 in W]"),
            bleed_power_w: buoyancy.number_or("bleed_power_w", Rule::NotNegative, 0.0),
            pot_step_m3: buoyancy.number_or("pot_step_m3", Rule::Positive, (high - low) / POT_STEPS),
            pot_noise_m3: buoyancy.number_or("pot_noise_m3", Rule::NotNegative, 0.0),
        }
    }
}

/// A table over pressure that may be left out.
fn table(buoyancy: &mut Section<'_>, key: &'static str, right: &str) -> Vec<[f64; 2]> {
    let Some(rows) = buoyancy.optional_pairs(key) else { return Vec::new() };
    let rising = rows.is_sorted_by(|[below, _], [above, _]| below < above);
    buoyancy.refuse_if(rows.is_empty() || !rising || rows.iter().any(|[_, value]| *value <= 0.0), key, right);
    rows
}

impl Buoyancy {
    /// Most that it pumps at a gauge pressure, m³/s.
    #[must_use]
    pub fn pump_rate_at_m3_s(&self, pressure_pa: f64) -> f64 {
        interpolated(&self.engine.pump_rate_at, pressure_pa).unwrap_or(self.pump_rate_m3_s)
    }

    /// Most that it bleeds at a gauge pressure, m³/s.
    #[must_use]
    pub fn bleed_rate_at_m3_s(&self, pressure_pa: f64) -> f64 {
        match self.engine.kind {
            EngineKind::Piston { .. } => self.bleed_rate_m3_s,
            EngineKind::Bladder { vacuum_pa, full_bleed_head_pa } => {
                let head = ((pressure_pa + vacuum_pa) / full_bleed_head_pa).clamp(0.0, 1.0);
                self.bleed_rate_m3_s * head.sqrt()
            }
        }
    }

    /// Electrical power of pumping at a rate against a gauge pressure, W.
    ///
    /// Ideal p·Q over the efficiency there, and what no pressure takes away; or, where the file gives it, the measured power
    /// of the full rate, of which a lower one takes its share.
    #[must_use]
    pub fn pump_power_w(&self, pressure_pa: f64, rate_m3_s: f64) -> f64 {
        if let Some(power_w) = interpolated(&self.engine.pump_power_at, pressure_pa) {
            return power_w * rate_m3_s / self.pump_rate_at_m3_s(pressure_pa);
        }
        let efficiency = interpolated(&self.efficiency, pressure_pa).unwrap_or(1.0);
        self.idle_power_w + pressure_pa * rate_m3_s / efficiency
    }

    /// Most electrical power that the pump takes at its full rate anywhere down to the crush depth, W.
    #[must_use]
    pub fn most_pump_power_w(&self, limits: &Limits, water: &Water) -> f64 {
        let crush_pa = water.density_kg_m3 * water.gravity_m_s2 * limits.crush_depth_m;
        let at = |step: u32| f64::from(step) / f64::from(DEPTH_STEPS) * crush_pa;
        let power_w = |pressure_pa: f64| self.pump_power_w(pressure_pa, self.pump_rate_at_m3_s(pressure_pa));
        (0..=DEPTH_STEPS).map(|step| power_w(at(step))).fold(0.0, f64::max)
    }
}

/// Linear between the points, constant beyond them; nothing without points.
fn interpolated(points: &[[f64; 2]], at: f64) -> Option<f64> {
    let after = points.partition_point(|[place, _]| *place <= at);
    match (after.checked_sub(1).and_then(|before| points.get(before)), points.get(after)) {
        (Some([x0, y0]), Some([x1, y1])) => Some(y0 + (y1 - y0) * (at - x0) / (x1 - x0)),
        (Some([_, edge]), None) | (None, Some([_, edge])) => Some(*edge),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::vehicle::Vehicle;

    fn slocum() -> Buoyancy {
        Vehicle::load("slocum-paper").unwrap().buoyancy.unwrap()
    }

    #[test]
    fn tables_are_interpolated_and_held_at_the_ends() {
        let points = [[0.0, 0.04], [1e6, 0.08], [5e6, 0.28]];
        let at = |pressure| interpolated(&points, pressure).unwrap();
        assert_eq!(at(-1.0), 0.04);
        assert!((at(3e6) - 0.18).abs() < 1e-15);
        assert_eq!(at(1e7), 0.28);
    }

    #[test]
    fn a_bladder_takes_oil_back_by_the_pressure_difference_alone() {
        let full = slocum().bleed_rate_m3_s;
        let bleed = |vacuum_pa, pressure_pa| {
            let mut buoyancy = slocum();
            buoyancy.engine.kind = EngineKind::Bladder { vacuum_pa, full_bleed_head_pa: 1e5 };
            buoyancy.bleed_rate_at_m3_s(pressure_pa)
        };
        assert_eq!(bleed(0.0, 0.0), 0.0, "at the surface without a vacuum");
        assert!((bleed(25e3, 0.0) - 0.5 * full).abs() < 1e-18, "at the surface by the vacuum");
        assert_eq!(bleed(27e3, 1e6), full, "the valve limits at depth");
    }

    #[test]
    fn a_pump_of_1000_m_has_the_rate_and_power_that_fielded_ones_show() {
        // Fielded 1000 m pumps: 1.1 to 1.3 cc/s at depth for 20 to 39 W, 0.27 to 0.40 of it ideal work between 500 and 1000 m.
        let mut buoyancy = slocum();
        buoyancy.engine.pump_rate_at = vec![[0.0, 2e-6], [5e6, 1.3e-6], [1e7, 1.1e-6]];
        buoyancy.engine.pump_power_at = vec![[0.0, 12.0], [5e6, 22.0], [1e7, 32.0]];
        for (pressure_pa, rate_m3_s, power_w) in [(5e6, 1.3e-6, 22.0), (1e7, 1.1e-6, 32.0), (2e7, 1.1e-6, 32.0)] {
            assert_eq!(buoyancy.pump_rate_at_m3_s(pressure_pa), rate_m3_s);
            assert_eq!(buoyancy.pump_power_w(pressure_pa, rate_m3_s), power_w);
        }
        let efficiency = |pressure_pa: f64| {
            let rate = buoyancy.pump_rate_at_m3_s(pressure_pa);
            pressure_pa * rate / buoyancy.pump_power_w(pressure_pa, rate)
        };
        assert!((0.27..=0.40).contains(&efficiency(5e6)) && (0.27..=0.40).contains(&efficiency(1e7)));
    }
}
