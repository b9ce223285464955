//! Drag of a surface that flow follows without separating.
//!
//! Mean friction of a smooth flat plate: laminar 1.328/√Re (Blasius), turbulent 0.455/(log₁₀ Re)^2.58 (Prandtl–Schlichting;
//! Schlichting, *Boundary-Layer Theory*, chapter 21), one or the other by a critical Reynolds number: a jump, since which one
//! a glider meets at such speeds depends on its finish. Form factors for thickness: Hoerner, *Fluid-Dynamic Drag* (1965),
//! 6-6 eq. (6) for sections and 6-17 eq. (28) for bodies of revolution. The formulas were checked against several open
//! implementations that cite them; the books' pages were not at hand.

use crate::model::real::Real;

/// Reynolds number of its length up to which the flow along a hull stays laminar: that of a flat plate.
pub const CRITICAL_REYNOLDS_HULL: f64 = 5e5;
/// Reynolds number of its chord up to which the flow along a thin wing or fin stays laminar.
///
/// Less than a smooth plate's: leading edges and joints trip the flow. Chosen, as what puts the steps of the paper's Fig. 8
/// within 0.2 to 1 m/s.
pub const CRITICAL_REYNOLDS_WING: f64 = 1e5;

/// Which boundary layer a surface has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "lowercase")]
pub enum BoundaryLayer {
    /// Smooth sheets.
    Laminar,
    /// Mixed by eddies.
    Turbulent,
}

impl BoundaryLayer {
    /// Turbulent from the critical Reynolds number on.
    #[must_use]
    pub fn at(reynolds: f64, critical: f64) -> Self {
        if reynolds < critical { Self::Laminar } else { Self::Turbulent }
    }
}

impl std::fmt::Display for BoundaryLayer {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.pad(match self {
            Self::Laminar => "laminar",
            Self::Turbulent => "turbulent",
        })
    }
}

/// C_f: mean friction of a plate, per wetted area.
#[must_use]
pub fn friction_coefficient<T: Real>(reynolds: T, critical: f64) -> T {
    match BoundaryLayer::at(reynolds.value(), critical) {
        BoundaryLayer::Laminar => T::constant(1.328) / reynolds.sqrt(),
        BoundaryLayer::Turbulent => {
            let log10 = reynolds.ln() / T::constant(std::f64::consts::LN_10);
            T::constant(0.455) / log10.powf(2.58)
        }
    }
}

/// Drag of a streamlined body of revolution over that of a plate with its wetted area; `slenderness` is d/l.
#[must_use]
pub fn body_form_factor<T: Real>(slenderness: T) -> T {
    let cubed = slenderness * slenderness * slenderness;
    T::constant(1.0) + T::constant(1.5) * slenderness.powf(1.5) + T::constant(7.0) * cubed
}

/// Drag of a section over that of a plate with its wetted area.
#[must_use]
pub fn section_form_factor<T: Real>(thickness_ratio: T) -> T {
    let squared = thickness_ratio * thickness_ratio;
    T::constant(1.0) + T::constant(2.0) * thickness_ratio + T::constant(60.0) * squared * squared
}
