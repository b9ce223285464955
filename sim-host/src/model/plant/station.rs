//! The variable volume at its station: buoyancy that pitches.
//!
//! The buoyant force of the volume beyond neutral, `−ρ g ΔV ζ`, acts at `(x, 0, 0)` instead of the centre of buoyancy; its moment
//! there is `−(x e1) × ρ g ΔV ζ`. **Sign**: volume pumped out ahead of the centre of buoyancy (`ΔV > 0`, `x > 0`) pitches a level
//! vehicle up, by `ρ g ΔV x`. What else acts on this volume (the water's acceleration, the hull's elasticity, the surface)
//! stays at the centre of buoyancy: it is a hundredth of the whole.

use nalgebra::Vector3;

use super::{Plant, State, inertia::axis};
use crate::model::{real::Real, vehicle::Vehicle};

/// Where the variable volume acts, and from which volume on it is counted.
#[derive(Clone, Copy, Debug)]
pub(super) struct Station<T: Real> {
    position_m: T,
    neutral_volume_m3: T,
}

impl<T: Real> Station<T> {
    /// `None` for a vehicle whose variable volume acts at the centre of buoyancy.
    pub(super) fn new(vehicle: &Vehicle) -> Option<Self> {
        let buoyancy = vehicle.buoyancy.as_ref().filter(|buoyancy| buoyancy.acts_at_station)?;
        Some(Self {
            position_m: T::constant(buoyancy.position_m),
            neutral_volume_m3: T::constant(vehicle.neutral_volume_m3()),
        })
    }
}

impl<T: Real> Plant<T> {
    /// The same plant ballasted so that its buoyancy device stands at zero with this displaced volume. Without it: in the static water.
    #[must_use]
    pub fn neutral_with(mut self, displaced_volume_m3: T) -> Self {
        if let Some(station) = &mut self.station {
            station.neutral_volume_m3 = displaced_volume_m3;
        }
        self
    }

    /// First moment ρ ΔV x e1 of the water displaced beyond neutral, body axes, kg m; nothing if it acts at the centre of buoyancy.
    pub(super) fn displaced_moment_kg_m(&self, state: &State<T>, density_kg_m3: T) -> Option<Vector3<T>> {
        let station = self.station.as_ref()?;
        let beyond_neutral_m3 = state.displaced_volume_m3 - station.neutral_volume_m3;
        Some(axis() * (station.position_m * density_kg_m3 * beyond_neutral_m3))
    }
}
