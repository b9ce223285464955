//! Large angles: attached flow gives way to cross-flow drag.
//!
//! Up to the stall the coefficients of section 4 hold; from full separation on, a slender body in cross flow (Allen & Perkins,
//! NACA Report 1048, 1951; drag coefficients in Hoerner, *Fluid-Dynamic Drag*, 1965, chapter 3). In between the two are
//! blended smoothly over the incidence, the angle between the velocity and b1. Separated forces only take energy away.

use nalgebra::Vector3;

use super::{Outside, Plant};
use crate::model::{real::Real, vehicle::Vehicle};

/// ∫|x|³ dx over a length l, over l⁴: what turns a cross-flow drag per length into a damping moment.
const CUBIC_MOMENT: f64 = 1.0 / 32.0;

/// Cross-flow drag in the plant's scalar.
#[derive(Clone, Copy, Debug)]
pub(super) struct Crossflow<T: Real> {
    stall_rad: T,
    separated_rad: T,
    /// Axial drag area C_D0 S, m².
    axial_m2: T,
    /// Drag areas c_dc A seen along b2 and b3, m².
    side_m2: T,
    plan_m2: T,
    /// Damping volumes about b1, b2, b3, m⁵: drag per area and squared rate, times the lever.
    damping_m5: Vector3<T>,
}

impl<T: Real> Crossflow<T> {
    /// `None` for a vehicle whose file has no cross flow: the linear law then holds at every angle.
    pub(super) fn new(vehicle: &Vehicle, outside: &Outside<T>) -> Option<Self> {
        let crossflow = vehicle.crossflow.as_ref()?;
        let c = T::constant;
        let (length, hydro) = (outside.length_m, &outside.coefficients);
        let cdc = c(crossflow.drag_coefficient);
        let (side, plan) = (cdc * outside.side_area_m2, cdc * outside.plan_area_m2);
        let cube = |x: T| x * x * x;
        let wing = cdc * hydro.area_m2 * cube(hydro.span_m);
        Some(Self {
            stall_rad: c(crossflow.stall_deg.to_radians()),
            separated_rad: c(crossflow.separated_deg.to_radians()),
            axial_m2: hydro.drag[0] * hydro.area_m2,
            side_m2: side,
            plan_m2: plan,
            damping_m5: Vector3::new(wing, plan * cube(length), side * cube(length)) * c(CUBIC_MOMENT),
        })
    }

    /// How far the flow has separated, 0 to 1, with continuous slope.
    fn separation(&self, velocity_m_s: &Vector3<T>) -> T {
        let across = T::hypot(velocity_m_s.y, velocity_m_s.z);
        if across.value() == 0.0 && velocity_m_s.x.value() >= 0.0 {
            return T::constant(0.0);
        }
        let incidence = across.atan2(velocity_m_s.x);
        let t = (incidence - self.stall_rad) / (self.separated_rad - self.stall_rad);
        if t.value() <= 0.0 {
            T::constant(0.0)
        } else if t.value() >= 1.0 {
            T::constant(1.0)
        } else {
            t * t * (T::constant(3.0) - T::constant(2.0) * t)
        }
    }

    /// Force and moment of fully separated flow, N and N m.
    fn separated(
        &self,
        density_kg_m3: T,
        velocity_m_s: &Vector3<T>,
        rate_rad_s: &Vector3<T>,
    ) -> (Vector3<T>, Vector3<T>) {
        let half_density = T::constant(0.5) * density_kg_m3;
        let (v, w) = (velocity_m_s, rate_rad_s);
        let across = T::hypot(v.y, v.z);
        let size = |x: T| if x.value() < 0.0 { -x } else { x };
        let force =
            Vector3::new(self.axial_m2 * size(v.x) * v.x, self.side_m2 * across * v.y, self.plan_m2 * across * v.z);
        let moment = self.damping_m5.zip_map(w, |volume, rate| volume * size(rate) * rate);
        (force * -half_density, moment * -half_density)
    }
}

impl<T: Real> Plant<T> {
    /// Force and moment at any angle, from those of attached flow; unchanged below the stall and without a cross flow.
    pub(super) fn blended(
        &self,
        attached: (Vector3<T>, Vector3<T>),
        density_kg_m3: T,
        velocity_m_s: &Vector3<T>,
        rate_rad_s: &Vector3<T>,
    ) -> (Vector3<T>, Vector3<T>) {
        let Some(crossflow) = &self.crossflow else { return attached };
        let share = crossflow.separation(velocity_m_s);
        if share.value() == 0.0 {
            return attached;
        }
        let (force, moment) = crossflow.separated(density_kg_m3, velocity_m_s, rate_rad_s);
        let rest = T::constant(1.0) - share;
        (attached.0 * rest + force * share, attached.1 * rest + moment * share)
    }
}
