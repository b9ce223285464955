//! The water column at rest: density, temperature, salinity and pressure by depth.

use nalgebra::Vector3;

use super::{
    Sample,
    teos10::{self, Composition},
};
use crate::model::plant::Surroundings;

/// Spacing of the table, m. The sharpest thermoclines are some metres thick.
const STEP_M: f64 = 1.0;
/// Depth down to which the table goes at least, m: deeper than any glider's.
const DEEPEST_M: f64 = 6_500.0;

/// One point of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Level {
    /// m.
    pub(super) depth_m: f64,
    /// In situ, ITS-90, °C.
    pub(super) temperature_c: f64,
    /// Practical salinity.
    pub(super) salinity: f64,
}

/// The water by depth.
#[derive(Clone, Debug)]
pub(super) enum Column {
    /// Of one density, without temperature and salinity.
    Uniform {
        /// ρ, kg/m³.
        density_kg_m3: f64,
        /// ρ g.
        pa_per_m: f64,
    },
    /// Tabulated every [`STEP_M`] from depth 0, linear between.
    Tabulated(Vec<Row>),
}

/// The water at one depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Row {
    density_kg_m3: f64,
    temperature_c: f64,
    salinity: f64,
    pressure_pa: f64,
    /// ρ g/c²: what a metre further down adds to the density of water that is carried there, kg/m⁴.
    compression_kg_m4: f64,
}

impl Column {
    pub(super) fn uniform(density_kg_m3: f64, gravity_m_s2: f64) -> Self {
        Self::Uniform { density_kg_m3, pa_per_m: density_kg_m3 * gravity_m_s2 }
    }

    /// From a profile with depths rising: temperature and salinity linear between its points, constant beyond; hydrostatic.
    pub(super) fn tabulated(
        profile: &[Level],
        composition: Composition,
        gravity_m_s2: f64,
    ) -> Result<Self, gsw::Error> {
        let bottom_m = profile.last().map_or(0.0, |level| level.depth_m).max(DEEPEST_M);
        let last = (bottom_m / STEP_M).ceil() as u32 + 1;
        let mut rows: Vec<Row> = Vec::new();
        for index in 0..=last {
            let (temperature_c, salinity) = interpolate(profile, f64::from(index) * STEP_M);
            let density = |pressure_pa: f64| teos10::density_kg_m3(salinity, temperature_c, pressure_pa, composition);
            let pressure_pa = match rows.last() {
                None => 0.0,
                Some(above) => {
                    let below = density(above.pressure_pa + above.density_kg_m3 * gravity_m_s2 * STEP_M)?;
                    above.pressure_pa + 0.5 * (above.density_kg_m3 + below) * gravity_m_s2 * STEP_M
                }
            };
            let density_kg_m3 = density(pressure_pa)?;
            let sound_m_s = teos10::sound_speed_m_s(salinity, temperature_c, pressure_pa, composition)?;
            let compression_kg_m4 = density_kg_m3 * gravity_m_s2 / (sound_m_s * sound_m_s);
            rows.push(Row { density_kg_m3, temperature_c, salinity, pressure_pa, compression_kg_m4 });
        }
        Ok(Self::Tabulated(rows))
    }

    /// Water at rest at a depth, its layers displaced downwards by `displaced_m`; above depth 0 its pressure is negative.
    #[inline]
    pub(super) fn at(&self, depth_m: f64, displaced_m: f64) -> Sample {
        let still = |density_kg_m3: f64, pressure_pa: f64, temperature_c: Option<f64>| Surroundings {
            density_kg_m3,
            pressure_pa,
            temperature_c,
            surface_m: 0.0,
            current_m_s: Vector3::zeros(),
            unrest: None,
        };
        match self {
            Self::Uniform { density_kg_m3, pa_per_m } => {
                Sample { around: still(*density_kg_m3, pa_per_m * depth_m, None), salinity: None }
            }
            Self::Tabulated(rows) => {
                let here = between(rows, depth_m);
                let origin = if displaced_m == 0.0 { here } else { between(rows, depth_m - displaced_m) };
                let density_kg_m3 = origin.density_kg_m3 + here.compression_kg_m4 * displaced_m;
                let around = still(density_kg_m3, here.pressure_pa, Some(origin.temperature_c));
                Sample { around, salinity: Some(origin.salinity) }
            }
        }
    }

    /// Half-way between the lightest and the heaviest water down to a depth, kg/m³.
    pub(super) fn middle_density_kg_m3(&self, depth_m: f64) -> f64 {
        match self {
            Self::Uniform { density_kg_m3, .. } => *density_kg_m3,
            Self::Tabulated(rows) => {
                let deepest = (depth_m / STEP_M).ceil() as usize;
                let densities = rows.iter().take(deepest + 1).map(|row| row.density_kg_m3);
                let [least, most] = densities.fold([f64::INFINITY, f64::NEG_INFINITY], |[least, most], value| {
                    [least.min(value), most.max(value)]
                });
                0.5 * (least + most)
            }
        }
    }
}

/// Linear between the rows, and on from the last two.
fn between(rows: &[Row], depth_m: f64) -> Row {
    let place = depth_m / STEP_M;
    // A cast that saturates: above depth 0 the first two rows go on.
    let index = (place as usize).min(rows.len().saturating_sub(2));
    let share = place - index as f64;
    let [a, b] = [rows[index], rows[index + 1]];
    let mix = |a: f64, b: f64| a + (b - a) * share;
    Row {
        density_kg_m3: mix(a.density_kg_m3, b.density_kg_m3),
        temperature_c: mix(a.temperature_c, b.temperature_c),
        salinity: mix(a.salinity, b.salinity),
        pressure_pa: mix(a.pressure_pa, b.pressure_pa),
        compression_kg_m4: mix(a.compression_kg_m4, b.compression_kg_m4),
    }
}

/// Temperature and salinity of a profile at a depth.
fn interpolate(profile: &[Level], depth_m: f64) -> (f64, f64) {
    let after = profile.partition_point(|level| level.depth_m <= depth_m);
    match (after.checked_sub(1).and_then(|before| profile.get(before)), profile.get(after)) {
        (Some(a), Some(b)) => {
            let share = (depth_m - a.depth_m) / (b.depth_m - a.depth_m);
            let mix = |a: f64, b: f64| a + (b - a) * share;
            (mix(a.temperature_c, b.temperature_c), mix(a.salinity, b.salinity))
        }
        (Some(edge), None) | (None, Some(edge)) => (edge.temperature_c, edge.salinity),
        (None, None) => (f64::NAN, f64::NAN),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column() -> Column {
        let level = |depth_m, temperature_c, salinity| Level { depth_m, temperature_c, salinity };
        let profile = [level(0.0, 18.0, 35.0), level(50.0, 10.0, 35.2), level(900.5, 5.0, 34.9)];
        Column::tabulated(&profile, Composition::Standard, 9.81).unwrap()
    }

    #[test]
    fn pressure_is_the_weight_of_the_water_above() {
        let column = column();
        for depth_m in [0.5, 33.25, 420.0, 2_000.0] {
            let at = |depth_m: f64| column.at(depth_m, 0.0).around;
            let slope = (at(depth_m + 0.25).pressure_pa - at(depth_m - 0.25).pressure_pa) / 0.5;
            // Linear pressure over a metre against linear density: half a metre of gradient, at most 0.2 kg/m⁴.
            assert!((slope / (9.81 * at(depth_m).density_kg_m3) - 1.0).abs() < 2e-4, "{depth_m} m");
        }
        let Sample { around: deep, salinity } = column.at(5_000.0, 0.0);
        assert_eq!((deep.temperature_c, salinity), (Some(5.0), Some(34.9)));
    }

    #[test]
    fn displaced_water_keeps_its_salt_and_is_compressed() {
        let column = column();
        let (here, moved) = (column.at(700.0, 0.0), column.at(700.0, 30.0));
        assert_eq!(moved.salinity, column.at(670.0, 0.0).salinity);
        // From 30 m above: warmer, so lighter than what was here, yet by less than the 0.14 kg/m³ that 30 m of pressure give.
        let change = moved.around.density_kg_m3 - here.around.density_kg_m3;
        assert!((-0.14..0.0).contains(&change), "{change}");
    }
}
