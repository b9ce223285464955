//! What a vehicle's shape gives its plant.

use crate::model::{
    coefficients::{AddedMassOf, Coefficients},
    real::Real,
    vehicle::Vehicle,
};

/// Everything of a plant that follows from the vehicle's shape, in the plant's scalar.
#[derive(Clone, Debug)]
pub struct Outside<T: Real> {
    /// Of the viscous forces.
    pub coefficients: Coefficients<T>,
    /// Of the water around.
    pub added_mass: AddedMassOf<T>,
    /// l, m.
    pub length_m: T,
    /// Area of the cross flow along b3, m²; not used without one.
    pub plan_area_m2: T,
    /// Area of the cross flow along b2, m²; not used without one.
    pub side_area_m2: T,
}

impl<T: Real> Outside<T> {
    /// As the vehicle has it.
    #[must_use]
    pub fn of(vehicle: &Vehicle) -> Self {
        let c = T::constant;
        let areas = vehicle.crossflow.as_ref().map_or([0.0; 2], |flow| [flow.plan_area_m2, flow.side_area_m2]);
        Self {
            coefficients: Coefficients::from(&vehicle.hydrodynamics).lift(),
            added_mass: AddedMassOf::from(&vehicle.added_mass).lift(),
            length_m: c(vehicle.hull.length_m),
            plan_area_m2: c(areas[0]),
            side_area_m2: c(areas[1]),
        }
    }
}
