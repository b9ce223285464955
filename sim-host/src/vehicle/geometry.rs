//! Lengths and areas that follow from the geometry's ratios (section 5 of the equations).

use std::f64::consts::PI;

use super::{Fin, Hull, Wing};

impl Hull {
    /// S_f = πd²/4, m².
    #[must_use]
    pub fn frontal_area_m2(&self) -> f64 {
        PI * self.diameter_m().powi(2) / 4.0
    }
}

impl Wing {
    /// b = 𝒷 d, m.
    #[must_use]
    pub fn span_m(&self, hull: &Hull) -> f64 {
        self.span_ratio * hull.diameter_m()
    }

    /// c̄ = b/AR, m.
    #[must_use]
    pub fn chord_m(&self, hull: &Hull) -> f64 {
        self.span_m(hull) / self.aspect_ratio
    }

    /// S = b c̄, m².
    #[must_use]
    pub fn area_m2(&self, hull: &Hull) -> f64 {
        self.span_m(hull) * self.chord_m(hull)
    }
}

impl Fin {
    /// S_v, m².
    #[must_use]
    pub fn area_m2(&self, hull: &Hull) -> f64 {
        self.area_ratio * hull.frontal_area_m2()
    }

    /// Its span, m.
    #[must_use]
    pub fn span_m(&self, hull: &Hull) -> f64 {
        (self.area_m2(hull) * self.aspect_ratio).sqrt()
    }

    /// Its chord, m.
    #[must_use]
    pub fn chord_m(&self, hull: &Hull) -> f64 {
        (self.area_m2(hull) / self.aspect_ratio).sqrt()
    }
}
