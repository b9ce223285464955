//! Added mass and inertia: a spheroid for the hull, strips for wing and fin.
//!
//! Hull: the prolate spheroid of its fineness (Lamb, *Hydrodynamics*, §§114–115 and 373), whose k-factors multiply the mass
//! and inertia of the water that the hull displaces. α₀ + 2β₀ = 2 holds for every ellipsoid of revolution, which is used for
//! β₀; `tests/coefficients.rs` holds them against his integrals and table. Wing and fin: πρc²/4 per span across a thin
//! plate (Newman, *Marine Hydrodynamics*, table 4.3), at mid chord, with the plate's own πρc⁴/128 about it.

use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};

use super::Shape;
use crate::model::{real::Real, vehicle::AddedMass};

/// Below this square of the eccentricity the closed form loses digits, and its series has them all.
const SERIES_BELOW: f64 = 0.1;
const SERIES_TERMS: i32 = 16;

/// M_f, J_f and C_f; names as in [`AddedMass`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AddedMassOf<T: Real> {
    /// M_f, kg.
    pub mass_kg: Matrix3<T>,
    /// J_f, kg m².
    pub inertia_kg_m2: Matrix3<T>,
    /// C_f, kg m: row moment axis, column velocity axis.
    pub coupling_kg_m: Matrix3<T>,
}

impl From<&AddedMass> for AddedMassOf<f64> {
    fn from(a: &AddedMass) -> Self {
        Self { mass_kg: a.mass_kg, inertia_kg_m2: a.inertia_kg_m2, coupling_kg_m: a.coupling_kg_m }
    }
}

impl AddedMassOf<f64> {
    /// In another scalar, without derivatives.
    #[must_use]
    pub fn lift<T: Real>(&self) -> AddedMassOf<T> {
        let [mass_kg, inertia_kg_m2, coupling_kg_m] =
            [self.mass_kg, self.inertia_kg_m2, self.coupling_kg_m].map(|matrix| matrix.map(T::constant));
        AddedMassOf { mass_kg, inertia_kg_m2, coupling_kg_m }
    }
}

impl From<AddedMassOf<f64>> for AddedMass {
    fn from(a: AddedMassOf<f64>) -> Self {
        Self { mass_kg: a.mass_kg, inertia_kg_m2: a.inertia_kg_m2, coupling_kg_m: a.coupling_kg_m }
    }
}

/// Lamb's k₁ (along), k₂ (across) and k′ (turning end over end) of a prolate spheroid of some fineness, 1 or more.
#[must_use]
pub fn spheroid_factors<T: Real>(fineness: T) -> [T; 3] {
    let c = T::constant;
    let e2 = c(1.0) - c(1.0) / (fineness * fineness);
    let alpha0 = c(2.0) * (c(1.0) - e2) * excess(e2);
    let beta0 = c(1.0) - alpha0 / c(2.0);
    let more = beta0 - alpha0;
    let wide = c(2.0) - e2;
    let k_turning = if e2.value() > 0.0 {
        e2 * e2 * more / (wide * (c(2.0) * e2 - wide * more))
    } else {
        c(0.0) // A sphere turns without stirring the water.
    };
    [alpha0 / (c(2.0) - alpha0), beta0 / (c(2.0) - beta0), k_turning]
}

/// (artanh e − e)/e³, from e².
fn excess<T: Real>(e2: T) -> T {
    let c = T::constant;
    if e2.value() < SERIES_BELOW {
        (0..SERIES_TERMS).rev().fold(c(0.0), |sum, n| sum * e2 + c(1.0 / f64::from(2 * n + 3)))
    } else {
        let e = e2.sqrt();
        (((c(1.0) + e) / (c(1.0) - e)).ln() / c(2.0) - e) / (e2 * e)
    }
}

/// Of hull, wing and fin together, in water of some density.
pub(super) fn added_mass<T: Real>(shape: &Shape<T>, density_kg_m3: T) -> AddedMassOf<T> {
    let mut sum = of_hull(shape, density_kg_m3);
    let zero = T::constant(0.0);
    let (hull, wing, fin) = (&shape.hull, &shape.wing, &shape.fin);
    let (d, span) = (hull.diameter_m(), wing.span_m(hull));

    let lifted = Vector3::new(zero, zero, T::constant(1.0));
    let chord = wing.chord_m(hull);
    let wing_plate = Plate { chord_m: chord, span_m: span - d, density_kg_m3 };
    let aft = wing.position * hull.length_m + chord / T::constant(4.0);
    wing_plate.add_to(&mut sum, &lifted, &Vector3::new(-aft, zero, zero));
    // The strips of both halves resist roll with their distance from the axis.
    let arms = (span * span * span - d * d * d) / T::constant(12.0);
    sum.inertia_kg_m2[(0, 0)] += wing_plate.mass_per_span() * arms;

    if fin.area_ratio.value() > 0.0 {
        let across = Vector3::new(zero, T::constant(1.0), zero);
        let (chord, height) = (fin.chord_m(hull), fin.span_m(hull));
        let fin_plate = Plate { chord_m: chord, span_m: height, density_kg_m3 };
        let aft = fin.position * hull.length_m + chord / T::constant(4.0);
        fin_plate.add_to(&mut sum, &across, &Vector3::new(-aft, zero, -fin.height_m));
        sum.inertia_kg_m2[(0, 0)] += fin_plate.mass_per_span() * height * height * height / T::constant(12.0);
    }
    sum
}

fn of_hull<T: Real>(shape: &Shape<T>, density_kg_m3: T) -> AddedMassOf<T> {
    let (zero, hull) = (T::constant(0.0), &shape.hull);
    let [along, across, turning] = spheroid_factors(hull.fineness);
    let displaced_kg = density_kg_m3 * hull.volume_m3();
    let d = hull.diameter_m();
    // m (a² + b²)/5 of a spheroid with the semi-axes l/2 and d/2.
    let displaced_kg_m2 = displaced_kg * (hull.length_m * hull.length_m + d * d) / T::constant(20.0);
    let diagonal = |x, y| Matrix3::from_diagonal(&Vector3::new(x, y, y));
    AddedMassOf {
        mass_kg: diagonal(displaced_kg * along, displaced_kg * across),
        inertia_kg_m2: diagonal(zero, displaced_kg_m2 * turning),
        coupling_kg_m: Matrix3::repeat(zero),
    }
}

/// A thin flat plate that moves across itself.
struct Plate<T> {
    chord_m: T,
    span_m: T,
    density_kg_m3: T,
}

impl<T: Real> Plate<T> {
    /// πρc²/4, kg/m.
    fn mass_per_span(&self) -> T {
        T::constant(PI / 4.0) * self.density_kg_m3 * self.chord_m * self.chord_m
    }

    /// Adds the plate with its normal `n` and its middle at `r`: ½A(n·(v + ω × r))² and ½I(n × e1·ω)².
    fn add_to(&self, sum: &mut AddedMassOf<T>, normal: &Vector3<T>, middle: &Vector3<T>) {
        let mass_kg = self.mass_per_span() * self.span_m;
        let arm = middle.cross(normal);
        sum.mass_kg += normal * normal.transpose() * mass_kg;
        sum.coupling_kg_m += arm * normal.transpose() * mass_kg;
        let along_span = normal.cross(&Vector3::new(T::constant(1.0), T::constant(0.0), T::constant(0.0)));
        let own_kg_m2 = mass_kg * self.chord_m * self.chord_m / T::constant(32.0);
        sum.inertia_kg_m2 += arm * arm.transpose() * mass_kg + along_span * along_span.transpose() * own_kg_m2;
    }
}
