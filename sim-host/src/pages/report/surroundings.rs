//! What is plotted of the vehicle's surroundings, where there is something to see: floor, density, current.

use super::{
    plot::Axis,
    traces::{MARKS, Trace, Traces, values},
};

/// Narrowest range of densities that is drawn, kg/m³.
const LEAST_DENSITY_KG_M3: f64 = 0.1;
/// Narrowest range of currents that is drawn, m/s.
const LEAST_CURRENT_M_S: f64 = 0.02;

impl Traces<'_> {
    /// Those that this flight's environment gives.
    pub(super) fn surroundings(&self) -> Vec<Trace> {
        [self.altitude(), self.density(), self.current()].into_iter().flatten().collect()
    }

    /// Height above the sea floor, if there is one.
    fn altitude(&self) -> Option<Trace> {
        let truth = self.curve("true", |s| s.truth.altitude_m());
        if truth.points.is_empty() {
            return None;
        }
        // Not a number where there is no echo: the curve has gaps there.
        let echoes = self.curve("measured", |s| {
            Some(s.measurements.altitude_mm.map_or(f64::NAN, |altitude_mm| f64::from(altitude_mm) / 1e3))
        });
        let curves = vec![truth, echoes];
        let axis = Axis::from_zero(values(&curves), 1.0, MARKS);
        let key = vec![("true", "true".into()), ("measured", "altimeter".into())];
        Some(self.trace("Altitude", "m above the sea floor", key, axis, curves))
    }

    /// Density, if it is not the same everywhere.
    fn density(&self) -> Option<Trace> {
        let curves = vec![self.curve("true", |s| Some(s.truth.water.around.density_kg_m3))];
        let varies = values(&curves).zip(values(&curves).skip(1)).any(|(before, after)| before != after);
        varies.then(|| {
            let axis = Axis::around(values(&curves), LEAST_DENSITY_KG_M3, MARKS);
            self.trace("Water density", "kg/m³", vec![("true", "true, at the vehicle".into())], axis, curves)
        })
    }

    /// Horizontal velocity of the water, if it moves.
    fn current(&self) -> Option<Trace> {
        let curves = vec![
            self.curve("north", |s| Some(s.truth.water.around.current_m_s.x)),
            self.curve("east", |s| Some(s.truth.water.around.current_m_s.y)),
        ];
        let moves = values(&curves).any(|velocity| velocity != 0.0);
        moves.then(|| {
            let axis = Axis::around(values(&curves), LEAST_CURRENT_M_S, MARKS);
            let key = vec![("north", "north".into()), ("east", "east".into())];
            self.trace("Current", "m/s, true, at the vehicle", key, axis, curves)
        })
    }
}
