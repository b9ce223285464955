//! What the wing gives: lift, induced drag, pitching and rolling moments.
//!
//! Sources, in the order of the functions below: Helmbold's lift slope with sweep (USAF DATCOM 4.1.3.2; Nelson, *Flight
//! Stability and Automatic Control*, 2nd ed., section 2.3); carry-over to and from the hull (Pitts, Nielsen & Kaattari, NACA
//! Report 1307, 1957: (1 + d/b)² of slender-body theory, on the exposed wing); strip theory of a rectangular wing for roll due
//! to dihedral and roll damping (Nelson, table 3.4 at taper 1: checked by integrating the strips); wing height on the hull
//! (Raymer, *Aircraft Design*, eq. 16.42). Cross-flow lift at large angles is the plant's (`[crossflow]`), not counted here.

use std::f64::consts::PI;

use super::Shape;
use crate::model::real::Real;

/// e: how nearly elliptic the lift is along the span.
pub const OSWALD_EFFICIENCY: f64 = 0.85;
/// κ: lift slope of the section over 2π.
const SECTION_SLOPE: f64 = 1.0;

/// C_Lα of a wing alone, per rad: 2πAR/(2 + √((AR/κ)²(1 + tan²Λ) + 4)).
#[must_use]
pub fn lift_slope<T: Real>(aspect_ratio: T, sweep_rad: T) -> T {
    let c = T::constant;
    let along = aspect_ratio / (sweep_rad.cos() * c(SECTION_SLOPE));
    c(2.0 * PI) * aspect_ratio / (c(2.0) + (along * along + c(4.0)).sqrt())
}

/// What the wing gives, referred to S, b and c̄.
pub(super) struct WingDerivatives<T> {
    /// K = 1/(π e AR).
    pub(super) c_d_induced: T,
    pub(super) c_l_alpha: T,
    pub(super) c_l_q: T,
    pub(super) c_m_alpha: T,
    pub(super) c_m_q: T,
    pub(super) c_roll_beta: T,
    pub(super) c_roll_p: T,
    pub(super) c_roll_r: T,
    pub(super) c_n_p: T,
}

/// Derivatives of the wing on its hull, at a lift coefficient.
///
/// **Levers.** Thin-plate theory puts lift at the quarter chord; about mid chord that is the moment πρc²/4·V²α per span, which
/// is the Munk moment of the plate's own added mass. The plant has it already, in `p × v`; so in the static moment the lever
/// here goes to mid chord, and plant and coefficient together put the lift where it is. Rates (C_Lq, C_mq) take the
/// quarter chord and the wing alone: the hull's upwash belongs to a uniform incidence.
pub(super) fn derivatives<T: Real>(shape: &Shape<T>, lift_coefficient: T) -> WingDerivatives<T> {
    let c = T::constant;
    let (hull, wing) = (&shape.hull, &shape.wing);
    let radians = |degrees: T| degrees * c(PI / 180.0);
    let (sweep, dihedral) = (radians(wing.sweep_deg), radians(wing.dihedral_deg));
    let (d, span, chord) = (hull.diameter_m(), wing.span_m(hull), wing.chord_m(hull));

    let alone = lift_slope(wing.aspect_ratio, sweep);
    let carry_over = c(1.0) + d / span;
    let c_l_alpha = alone * carry_over * carry_over * wing.exposed_area_m2(hull) / wing.area_m2(hull);

    let quarter_chord = wing.position * hull.length_m / chord;
    let mid_chord = quarter_chord + c(0.25);
    // z_w, down positive.
    let z_w = -wing.height_m;
    let by_height = c(1.2) * wing.aspect_ratio.sqrt() * (z_w / span) * (c(2.0) * d / span);
    let by_sweep = c(0.5) * lift_coefficient * sweep.sin() / sweep.cos();
    WingDerivatives {
        c_d_induced: c(1.0) / (c(PI * OSWALD_EFFICIENCY) * wing.aspect_ratio),
        c_l_alpha,
        c_l_q: c(2.0) * alone * quarter_chord,
        c_m_alpha: -c_l_alpha * mid_chord,
        c_m_q: c(-2.0) * alone * quarter_chord * quarter_chord,
        c_roll_beta: by_height - c_l_alpha * dihedral / c(4.0) - by_sweep,
        c_roll_p: -c_l_alpha / c(6.0),
        c_roll_r: lift_coefficient / c(4.0),
        c_n_p: -lift_coefficient / c(8.0),
    }
}
