//! A vehicle of a changed shape.

use nalgebra::{Matrix3, Vector3};

use super::{AddedMassOf, Coefficients, Shape, Stream};
use crate::model::{
    plant::Outside,
    real::Real,
    vehicle::{Body, Vehicle, plan_area_m2, side_area_m2},
};

/// What a changed shape's coefficients start from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Anchoring {
    /// The vehicle's own: coefficient(x) = own + semi(x) − semi(x_nominal), nominal being its shape at V0 and without lift.
    ///
    /// For a vehicle whose coefficients come from its geometry this is the same as [`Anchoring::Unanchored`].
    #[default]
    Anchored,
    /// The semi-empirical estimate alone.
    Unanchored,
}

/// What a changed shape weighs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MassRule {
    /// What the vehicle weighs, distributed as it is.
    #[default]
    Kept,
    /// As much as the water in the hull's cylinder: the body's mass takes up the difference and keeps its place in proportion.
    Neutral,
}

/// Changed shapes of one vehicle.
#[derive(Clone, Debug)]
pub struct Study<'a> {
    /// The vehicle that is changed.
    pub vehicle: &'a Vehicle,
    /// What coefficients start from.
    pub anchoring: Anchoring,
    /// What a changed shape weighs.
    pub mass_rule: MassRule,
}

impl<'a> Study<'a> {
    /// Anchored, mass kept.
    #[must_use]
    pub fn new(vehicle: &'a Vehicle) -> Self {
        Self { vehicle, anchoring: Anchoring::default(), mass_rule: MassRule::default() }
    }

    /// The flow at a speed and a lift coefficient, in the vehicle's water.
    #[must_use]
    pub fn stream<T: Real>(&self, speed_m_s: T, lift_coefficient: T) -> Stream<T> {
        let kinematic_viscosity_m2_s = T::constant(self.vehicle.water.kinematic_viscosity_m2_s);
        Stream { speed_m_s, kinematic_viscosity_m2_s, lift_coefficient }
    }

    /// Coefficients of a shape, referred to its own wing, at a speed and a lift coefficient.
    #[must_use]
    pub fn coefficients<T: Real>(&self, shape: &Shape<T>, speed_m_s: T, lift_coefficient: T) -> Coefficients<T> {
        let changed = shape.coefficients(&self.stream(speed_m_s, lift_coefficient));
        if self.anchoring == Anchoring::Unanchored {
            return changed;
        }
        let at_nominal = self.stream(self.vehicle.nominal_speed_m_s, 0.0);
        let nominal = Shape::of(self.vehicle).coefficients(&at_nominal);
        let own = Coefficients::from(&self.vehicle.hydrodynamics).referred_to(
            nominal.area_m2,
            nominal.span_m,
            nominal.chord_m,
        );
        let change = changed.zip_map(&nominal.lift(), |new, old| new - old);
        change.zip_map(&own.lift(), |change, own| own + change)
    }

    /// Added mass of a shape.
    #[must_use]
    pub fn added_mass<T: Real>(&self, shape: &Shape<T>) -> AddedMassOf<T> {
        let density_kg_m3 = self.vehicle.water.density_kg_m3;
        let changed = shape.added_mass(T::constant(density_kg_m3));
        if self.anchoring == Anchoring::Unanchored {
            return changed;
        }
        let nominal = Shape::of(self.vehicle).added_mass(density_kg_m3).lift();
        let own = AddedMassOf::from(&self.vehicle.added_mass).lift();
        AddedMassOf {
            mass_kg: own.mass_kg + changed.mass_kg - nominal.mass_kg,
            inertia_kg_m2: own.inertia_kg_m2 + changed.inertia_kg_m2 - nominal.inertia_kg_m2,
            coupling_kg_m: own.coupling_kg_m + changed.coupling_kg_m - nominal.coupling_kg_m,
        }
    }

    /// Everything that a shape gives the plant; cross-flow areas change by as much as the shape's.
    #[must_use]
    pub fn outside<T: Real>(&self, shape: &Shape<T>, speed_m_s: T, lift_coefficient: T) -> Outside<T> {
        let (nominal, own) = (Shape::of(self.vehicle), Outside::<T>::of(self.vehicle));
        let plan = plan_area_m2(&nominal.hull, &nominal.wing);
        let side = side_area_m2(&nominal.hull, &nominal.fin);
        Outside {
            coefficients: self.coefficients(shape, speed_m_s, lift_coefficient),
            added_mass: self.added_mass(shape),
            length_m: shape.hull.length_m,
            plan_area_m2: own.plan_area_m2 + (plan_area_m2(&shape.hull, &shape.wing) - T::constant(plan)),
            side_area_m2: own.side_area_m2 + (side_area_m2(&shape.hull, &shape.fin) - T::constant(side)),
        }
    }

    /// The vehicle with a changed shape, its coefficients those of a speed and a lift coefficient.
    ///
    /// Moving mass, engine and battery stay.
    ///
    /// # Errors
    /// One line, where the change leaves no possible vehicle: no mass for the body, or a drag, lift slope or added mass that
    /// is not positive (anchoring far from the nominal shape).
    pub fn vehicle(&self, shape: &Shape, speed_m_s: f64, lift_coefficient: f64) -> Result<Vehicle, String> {
        let mut changed = self.vehicle.clone();
        let outside = self.outside(shape, speed_m_s, lift_coefficient);
        changed.hydrodynamics = outside.coefficients.hydrodynamics(self.vehicle.hydrodynamics.moment_frame);
        changed.added_mass = outside.added_mass.into();
        if let Some(crossflow) = &mut changed.crossflow {
            crossflow.plan_area_m2 = outside.plan_area_m2;
            crossflow.side_area_m2 = outside.side_area_m2;
        }
        if self.mass_rule == MassRule::Neutral {
            let others_kg = changed.mass_kg() - changed.body.mass_kg;
            let body_kg = changed.water.density_kg_m3 * shape.hull.volume_m3() - others_kg;
            let nominal = &self.vehicle.hull;
            let wider = shape.hull.diameter_m() / nominal.diameter_m();
            let stretch = Vector3::new(shape.hull.length_m / nominal.length_m, wider, wider);
            changed.body = resized(&self.vehicle.body, body_kg, &stretch);
        }
        Shape { hull: changed.hull, wing: changed.wing, fin: changed.fin } = shape.clone();
        possible(&changed).map(|()| changed)
    }
}

/// The body with another mass, everything in it moved in proportion.
fn resized(body: &Body, mass_kg: f64, stretch: &Vector3<f64>) -> Body {
    // Σ m r rᵀ moves in proportion; J = tr(Σ) I − Σ, so Σ = ½ tr(J) I − J.
    let spread = Matrix3::from_diagonal_element(0.5 * body.inertia_kg_m2.trace()) - body.inertia_kg_m2;
    let moved = spread.component_mul(&(stretch * stretch.transpose())) * (mass_kg / body.mass_kg);
    Body {
        mass_kg,
        centre_of_mass_m: body.centre_of_mass_m.component_mul(stretch),
        inertia_kg_m2: Matrix3::from_diagonal_element(moved.trace()) - moved,
        ..body.clone()
    }
}

/// Whether a changed vehicle can exist.
fn possible(vehicle: &Vehicle) -> Result<(), String> {
    let (h, added) = (&vehicle.hydrodynamics, &vehicle.added_mass);
    let needs = [
        ("the body's mass, kg,", vehicle.body.mass_kg),
        ("C_D0", h.c_d_zero),
        ("C_Lα", h.c_l_alpha),
        ("the least added mass, kg,", added.mass_kg.diagonal().min()),
    ];
    match needs.iter().find(|(_, value)| value.is_nan() || *value <= 0.0) {
        Some((what, value)) => Err(format!("this shape of {}: {what} comes out as {value:.4}", vehicle.name)),
        None => Ok(()),
    }
}
