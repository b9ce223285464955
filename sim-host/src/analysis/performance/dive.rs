//! One yo as it really goes: quasi-steady glides through layered water, with inflections, a pump and a hotel load.
//!
//! The glides hold their path angle. Their speed follows the net mass, and that the water's density, the hull's compression
//! and its thermal expansion: V² = 2|m̃|g/(ρS√(C_L² + C_D²)).
//!
//! **Inflections.** The engine runs, and the moving mass travels, one after the other: as long as both take together, the
//! vertical speed goes evenly from one glide's to the other's, and the horizontal speed falls to a half and comes back. The
//! glider loses half of that time, and meanwhile goes a quarter of its way farther. Flown by the plant in the loop, slocum-paper
//! loses 26 s and wins 8 m in an inflection of 50 s, where this gives 25 s and 8 m (`tests/performance.rs`).

use nalgebra::Vector3;
use serde::Serialize;

use crate::analysis::trim::Glide;
use crate::flight::FlyingVehicle;
use crate::model::{
    ocean::Ocean,
    plant::Surroundings,
    vehicle::{Buoyancy, Energy, Vehicle},
};

/// Depth of a layer, m: the resolution of a tabulated ocean.
const LAYER_M: f64 = 1.0;

/// Electrical energy of one yo, J.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DiveEnergy {
    /// Of the pump at the bottom.
    pub pump_j: f64,
    /// Of the bleed at the top.
    pub bleed_j: f64,
    /// Of moving the mass along the axis.
    pub pitch_j: f64,
    /// Of everything that always runs.
    pub hotel_j: f64,
}

/// A dive and a climb, with the inflections at both ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Yo {
    /// Over ground in still water, m.
    pub distance_m: f64,
    /// s.
    pub duration_s: f64,
    /// Slowest speed of the glides, m/s.
    pub slowest_m_s: f64,
    /// Fastest speed of the glides, m/s.
    pub fastest_m_s: f64,
    /// Of which inflections: s.
    pub inflections_s: f64,
    /// Ideal work of the pump over its electrical energy.
    pub pump_efficiency: f64,
    /// Where the energy goes.
    pub energy: DiveEnergy,
}

impl DiveEnergy {
    /// All of it, J.
    #[must_use]
    pub fn total_j(&self) -> f64 {
        self.pump_j + self.bleed_j + self.pitch_j + self.hotel_j
    }
}

/// A vehicle set for one glide down and its mirror image up.
struct Setting<'a> {
    vehicle: &'a Vehicle,
    buoyancy: &'a Buoyancy,
    energy: &'a Energy,
    glide: &'a Glide,
    ocean: &'a Ocean,
    /// Displaced volume at which it is neutral in the water it is ballasted for, m³.
    neutral_m3: f64,
    /// From heaviest to lightest, m³.
    stroke_m3: f64,
}

/// The two ways of a yo.
#[derive(Clone, Copy)]
enum Way {
    Down,
    Up,
}

impl Yo {
    /// Between two depths, m, down at `glide` and up at its mirror image, ballasted as for a flight.
    ///
    /// # Errors
    /// One line: a missing section of the vehicle file, a depth at which the glider no longer sinks or rises, an inflection
    /// that takes longer than the glides, an engine that does not run there.
    pub fn new(vehicle: &Vehicle, glide: &Glide, ocean: &Ocean, [top_m, bottom_m]: [f64; 2]) -> Result<Self, String> {
        let flying = FlyingVehicle::new(vehicle)?;
        let setting = Setting {
            vehicle,
            buoyancy: flying.buoyancy,
            energy: flying.energy,
            glide,
            ocean,
            neutral_m3: vehicle.mass_kg() / ocean.ballast_density_kg_m3(bottom_m),
            stroke_m3: 2.0 * glide.net_mass_kg / vehicle.water.density_kg_m3,
        };
        setting.yo(top_m, bottom_m)
    }
}

impl Setting<'_> {
    fn yo(&self, top_m: f64, bottom_m: f64) -> Result<Yo, String> {
        let height_m = bottom_m - top_m;
        let layers = (height_m / LAYER_M).ceil().max(1.0);
        let (mut slowest_m_s, mut fastest_m_s, mut glides_s) = (f64::INFINITY, 0.0_f64, 0.0);
        for way in [Way::Down, Way::Up] {
            for layer in 0..layers as u32 {
                let speed_m_s = self.speed_m_s(way, top_m + height_m * (f64::from(layer) + 0.5) / layers)?;
                slowest_m_s = slowest_m_s.min(speed_m_s);
                fastest_m_s = fastest_m_s.max(speed_m_s);
                glides_s += height_m / layers / (speed_m_s * self.sine());
            }
        }
        let (bottom, top) = (self.water(bottom_m), self.water(top_m));
        let pump_m3_s = self.buoyancy.pump_rate_at_m3_s(bottom.pressure_pa);
        let bleed_m3_s = self.buoyancy.bleed_rate_at_m3_s(top.pressure_pa);
        if pump_m3_s <= 0.0 || bleed_m3_s <= 0.0 {
            return Err("the engine does not pump at the bottom, or does not bleed at the top".into());
        }
        let (pump_s, bleed_s) = (self.stroke_m3 / pump_m3_s, self.stroke_m3 / bleed_m3_s);
        let travel_s = self.travel_m() / self.vehicle.moving_mass.rate_m_s;
        let inflections_s = pump_s + bleed_s + 2.0 * travel_s;
        if inflections_s / 2.0 > glides_s {
            return Err(format!(
                "inflections take {inflections_s:.0} s, longer than the glides between {top_m} and {bottom_m} m"
            ));
        }
        let duration_s = glides_s + inflections_s / 2.0;
        let mean_m_s = 2.0 * height_m / self.sine() / glides_s;
        let pump_j = self.buoyancy.pump_power_w(bottom.pressure_pa, pump_m3_s) * pump_s;
        Ok(Yo {
            distance_m: self.cosine() * (2.0 * height_m / self.sine() + mean_m_s * inflections_s / 4.0),
            duration_s,
            slowest_m_s,
            fastest_m_s,
            inflections_s,
            pump_efficiency: bottom.pressure_pa * self.stroke_m3 / pump_j,
            energy: DiveEnergy {
                pump_j,
                bleed_j: self.buoyancy.engine.bleed_power_w * bleed_s,
                pitch_j: 2.0 * travel_s * self.energy.pitch_motor_w,
                hotel_j: self.energy.hotel_w * duration_s,
            },
        })
    }

    /// Speed of a glide at a depth, m/s.
    fn speed_m_s(&self, way: Way, depth_m: f64) -> Result<f64, String> {
        let water = self.water(depth_m);
        let (set_m3, sign, verb) = match way {
            Way::Down => (-0.5 * self.stroke_m3, 1.0, "sinks"),
            Way::Up => (0.5 * self.stroke_m3, -1.0, "rises"),
        };
        let displaced_kg = water.density_kg_m3 * (self.neutral_m3 + set_m3) * self.strain(&water);
        let driving_kg = sign * (self.vehicle.mass_kg() - displaced_kg);
        if driving_kg <= 0.0 {
            return Err(format!(
                "at {depth_m:.0} m {} no longer {verb}: the water is {:.2} kg/m³ off its ballast, and it is set for {:.3} kg",
                self.vehicle.name,
                water.density_kg_m3 - self.vehicle.mass_kg() / self.neutral_m3,
                self.glide.net_mass_kg
            ));
        }
        let resultant = libm::hypot(self.glide.lift_coefficient, self.glide.drag_coefficient);
        let area_m2 = self.vehicle.hydrodynamics.area_m2;
        let weight_n = driving_kg * self.vehicle.water.gravity_m_s2;
        Ok((2.0 * weight_n / (water.density_kg_m3 * area_m2 * resultant)).sqrt())
    }

    /// Volume under pressure and at temperature over that at the surface: the plant's law.
    fn strain(&self, water: &Surroundings<f64>) -> f64 {
        let elastic = &self.buoyancy.elasticity;
        let warmth_c = water.temperature_c.map_or(0.0, |warm| warm - elastic.reference_temperature_c);
        1.0 + elastic.thermal_expansion_per_c * warmth_c - elastic.compressibility_per_pa * water.pressure_pa
    }

    fn water(&self, depth_m: f64) -> Surroundings<f64> {
        self.ocean.at_rest(depth_m).around
    }

    /// Way of the moving mass from one glide to its mirror image, m: symmetric about where no moment is left at rest.
    fn travel_m(&self) -> f64 {
        let body: &Vector3<f64> = &self.vehicle.body.centre_of_mass_m;
        let level_m = -self.vehicle.body.mass_kg * body.x / self.vehicle.moving_mass.mass_kg;
        2.0 * (self.glide.r_px_m - level_m).abs()
    }

    fn sine(&self) -> f64 {
        libm::sin(self.glide.path_angle_rad).abs()
    }

    fn cosine(&self) -> f64 {
        libm::cos(self.glide.path_angle_rad)
    }
}
