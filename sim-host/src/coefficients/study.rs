//! A vehicle of a changed shape.

use nalgebra::{Matrix3, Vector3};

use super::{Coefficients, Shape, Stream};
use crate::vehicle::{AddedMass, Body, Hydrodynamics, Vehicle, plan_area_m2, side_area_m2};

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
    pub fn stream(&self, speed_m_s: f64, lift_coefficient: f64) -> Stream {
        let kinematic_viscosity_m2_s = self.vehicle.water.kinematic_viscosity_m2_s;
        Stream { speed_m_s, kinematic_viscosity_m2_s, lift_coefficient }
    }

    /// Coefficients of a shape, referred to its own wing, at a speed and a lift coefficient.
    #[must_use]
    pub fn coefficients(&self, shape: &Shape, speed_m_s: f64, lift_coefficient: f64) -> Coefficients {
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
        let change = changed.zip_map(&nominal, |new, old| new - old);
        change.zip_map(&own, |change, own| own + change)
    }

    /// The same as a vehicle has them.
    #[must_use]
    pub fn hydrodynamics(&self, shape: &Shape, speed_m_s: f64, lift_coefficient: f64) -> Hydrodynamics {
        let moment_frame = self.vehicle.hydrodynamics.moment_frame;
        self.coefficients(shape, speed_m_s, lift_coefficient).hydrodynamics(moment_frame)
    }

    /// Added mass of a shape.
    #[must_use]
    pub fn added_mass(&self, shape: &Shape) -> AddedMass {
        let density_kg_m3 = self.vehicle.water.density_kg_m3;
        let changed = AddedMass::from(shape.added_mass(density_kg_m3));
        if self.anchoring == Anchoring::Unanchored {
            return changed;
        }
        let nominal = AddedMass::from(Shape::of(self.vehicle).added_mass(density_kg_m3));
        let own = &self.vehicle.added_mass;
        AddedMass {
            mass_kg: own.mass_kg + changed.mass_kg - nominal.mass_kg,
            inertia_kg_m2: own.inertia_kg_m2 + changed.inertia_kg_m2 - nominal.inertia_kg_m2,
            coupling_kg_m: own.coupling_kg_m + changed.coupling_kg_m - nominal.coupling_kg_m,
        }
    }

    /// The vehicle with a changed shape, its coefficients those of a speed and a lift coefficient.
    ///
    /// Moving mass, engine and battery stay; cross-flow areas change by as much as the shape's.
    ///
    /// # Errors
    /// One line, where the change leaves no possible vehicle: no mass for the body, or a drag, lift slope or added mass that
    /// is not positive (anchoring far from the nominal shape).
    pub fn vehicle(&self, shape: &Shape, speed_m_s: f64, lift_coefficient: f64) -> Result<Vehicle, String> {
        let mut changed = self.vehicle.clone();
        changed.hydrodynamics = self.hydrodynamics(shape, speed_m_s, lift_coefficient);
        changed.added_mass = self.added_mass(shape);
        if let Some(crossflow) = &mut changed.crossflow {
            let nominal = Shape::of(self.vehicle);
            crossflow.plan_area_m2 +=
                plan_area_m2(&shape.hull, &shape.wing) - plan_area_m2(&nominal.hull, &nominal.wing);
            crossflow.side_area_m2 += side_area_m2(&shape.hull, &shape.fin) - side_area_m2(&nominal.hull, &nominal.fin);
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
