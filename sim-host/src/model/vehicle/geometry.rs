//! Lengths, areas and volumes that follow from the geometry's ratios (section 5 of the equations).

use std::f64::consts::PI;

use super::{Fin, Hull, Wing};
use crate::model::real::Real;

impl<T: Real> Hull<T> {
    /// d = l/f, m.
    #[must_use]
    pub fn diameter_m(&self) -> T {
        self.length_m / self.fineness
    }

    /// S_f = πd²/4, m².
    #[must_use]
    pub fn frontal_area_m2(&self) -> T {
        let d = self.diameter_m();
        T::constant(PI) * (d * d) / T::constant(4.0)
    }

    /// (π/4) d² l, m³: the cylinder of eq. (11).
    #[must_use]
    pub fn volume_m3(&self) -> T {
        self.frontal_area_m2() * self.length_m
    }
}

impl<T: Real> Wing<T> {
    /// b = 𝒷 d, m.
    #[must_use]
    pub fn span_m(&self, hull: &Hull<T>) -> T {
        self.span_ratio * hull.diameter_m()
    }

    /// c̄ = b/AR, m.
    #[must_use]
    pub fn chord_m(&self, hull: &Hull<T>) -> T {
        self.span_m(hull) / self.aspect_ratio
    }

    /// S = b c̄, m².
    #[must_use]
    pub fn area_m2(&self, hull: &Hull<T>) -> T {
        self.span_m(hull) * self.chord_m(hull)
    }

    /// What of S lies outside the hull, m².
    #[must_use]
    pub fn exposed_area_m2(&self, hull: &Hull<T>) -> T {
        self.chord_m(hull) * (self.span_m(hull) - hull.diameter_m())
    }
}

impl<T: Real> Fin<T> {
    /// S_v, m².
    #[must_use]
    pub fn area_m2(&self, hull: &Hull<T>) -> T {
        self.area_ratio * hull.frontal_area_m2()
    }

    /// Its span, m.
    #[must_use]
    pub fn span_m(&self, hull: &Hull<T>) -> T {
        (self.area_m2(hull) * self.aspect_ratio).sqrt()
    }

    /// Its chord, m.
    #[must_use]
    pub fn chord_m(&self, hull: &Hull<T>) -> T {
        (self.area_m2(hull) / self.aspect_ratio).sqrt()
    }
}

/// Hull and exposed wing seen from above, m².
#[must_use]
pub fn plan_area_m2<T: Real>(hull: &Hull<T>, wing: &Wing<T>) -> T {
    hull.length_m * hull.diameter_m() + wing.exposed_area_m2(hull)
}

/// Hull and fin seen from the side, m².
#[must_use]
pub fn side_area_m2<T: Real>(hull: &Hull<T>, fin: &Fin<T>) -> T {
    hull.length_m * hull.diameter_m() + fin.area_m2(hull)
}
