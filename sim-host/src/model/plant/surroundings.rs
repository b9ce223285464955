//! The water around the vehicle: what the plant must know of it, and what its motion does.
//!
//! The state's velocity is relative to the water at the centre of buoyancy; a steady uniform current `c` shows only in
//! `Ẋ = R v + c`. Elsewhere the frame that goes with the local water accelerates by `dc/dt = Dc/Dt + (∇c) R v`: every mass of the
//! vehicle feels `−dc/dt` where it is, the displaced water `+Dc/Dt` at the centre of buoyancy (Froude–Krylov), and the energy
//! of the added mass `½ v·M_f v + v·C_fᵀ ω` depends on the place through `v = Rᵀ(Ẋ − c)`, which gives `−(∇c)ᵀ (M_f v + C_fᵀ ω)`
//! (Lagrange). Thomasson & Woolsey, "Vehicle motion in currents", IEEE J. Oceanic Eng. 38(2), 2013; as there the vehicle is
//! small against the current's scale. The rotation and strain of the water are neglected where they would add to `ω`.

use nalgebra::{Matrix3, Vector3};

use super::{Plant, State};
use crate::model::real::Real;

/// The water at one place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings<T: Real> {
    /// ρ, kg/m³.
    pub density_kg_m3: T,
    /// Pressure above the air's, Pa: compresses the hull.
    pub pressure_pa: T,
    /// Temperature, °C: expands the hull; without one the hull is at its reference temperature.
    pub temperature_c: Option<T>,
    /// Height of the surface above depth 0, m.
    pub surface_m: T,
    /// c: velocity of the water, north, east, down, m/s.
    pub current_m_s: Vector3<T>,
    /// How the velocity changes; nothing where it is steady and uniform.
    pub unrest: Option<Unrest<T>>,
}

/// A velocity of the water that changes in time or space; inertial axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unrest<T: Real> {
    /// Dc/Dt = ∂c/∂t + (∇c) c: acceleration of the water itself, m/s².
    pub acceleration_m_s2: Vector3<T>,
    /// ∇c: row component, column direction, 1/s.
    pub gradient_per_s: Matrix3<T>,
}

/// Water that can be asked at every place, during one step of integration.
pub trait Medium<T: Real> {
    /// The water at a position (north, east, down, m), some seconds into the step.
    fn around(&self, position_m: &Vector3<T>, into_step_s: T) -> Surroundings<T>;
}

/// The same everywhere and always.
impl<T: Real> Medium<T> for Surroundings<T> {
    fn around(&self, _position_m: &Vector3<T>, _into_step_s: T) -> Surroundings<T> {
        *self
    }
}

/// What the water's motion does, body axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Carried<T: Real> {
    /// −dc/dt: what every mass feels, m/s².
    pub(super) felt_m_s2: Vector3<T>,
    /// Force at the centre of buoyancy, N.
    pub(super) force_n: Vector3<T>,
}

impl<T: Real> Plant<T> {
    /// The still water of the static analyses, at the surface's pressure.
    #[must_use]
    pub fn still(&self) -> Surroundings<T> {
        let zero = T::constant(0.0);
        Surroundings {
            density_kg_m3: self.density_kg_m3,
            pressure_pa: zero,
            temperature_c: None,
            surface_m: zero,
            current_m_s: Vector3::repeat(zero),
            unrest: None,
        }
    }

    /// V_d under pressure and at temperature, m³: `V_d (1 − κ p + α_T (T − T_ref))`.
    pub(super) fn volume_in(&self, state: &State<T>, water: &Surroundings<T>) -> T {
        let zero = T::constant(0.0);
        let warmth_c = water.temperature_c.map_or(zero, |temperature| temperature - self.reference_temperature_c);
        let strain = self.thermal_expansion_per_c * warmth_c - self.compressibility_per_pa * water.pressure_pa;
        state.displaced_volume_m3 * (T::constant(1.0) + strain)
    }

    /// What the motion of the water adds to the equations of motion relative to it.
    pub(super) fn carried(
        &self,
        state: &State<T>,
        to_inertial: &Matrix3<T>,
        water: &Surroundings<T>,
    ) -> Option<Carried<T>> {
        let unrest = water.unrest.as_ref()?;
        let velocity = to_inertial * state.velocity_m_s;
        let frame = unrest.acceleration_m_s2 + unrest.gradient_per_s * velocity;
        let felt_m_s2 = -to_inertial.tr_mul(&frame);
        let displaced_kg = water.density_kg_m3 * self.volume_in(state, water);
        let added = self.added_mass_kg * state.velocity_m_s + self.added_coupling_kg_m.tr_mul(&state.rate_rad_s);
        let place = unrest.gradient_per_s.tr_mul(&(to_inertial * added));
        let buoyant = to_inertial.tr_mul(&(unrest.acceleration_m_s2 * displaced_kg - place));
        Some(Carried { felt_m_s2, force_n: felt_m_s2 * self.mass_kg + buoyant })
    }
}
