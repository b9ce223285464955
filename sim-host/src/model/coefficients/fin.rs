//! What the vertical fin gives: side force, and its moments.
//!
//! The side force of a fin behind wing and hull: DATCOM's fit of sidewash and dynamic pressure (Nelson eq. 2.80; Raymer
//! eq. 16.51; checked against a dozen open implementations, which agree in every constant), its slope Helmbold's. Moments and
//! rates follow from where it sits (Nelson, table 3.4; Etkin & Reid, *Dynamics of Flight*, section 5.9), by rigid kinematics:
//! a point l_v aft and z_v up sees a sideslip β − r l_v/V + p z_v/V.

use super::{Shape, wing::lift_slope};
use crate::model::real::Real;

/// What the fin gives, referred to the wing's S and b.
pub(super) struct FinDerivatives<T> {
    pub(super) c_y_beta: T,
    pub(super) c_y_p: T,
    pub(super) c_y_r: T,
    pub(super) c_roll_beta: T,
    pub(super) c_roll_r: T,
    pub(super) c_n_beta: T,
    pub(super) c_n_r: T,
}

/// Derivatives of the fin behind its wing and hull.
///
/// The static lever goes to mid chord, that of rates to the quarter chord: see the wing's.
pub(super) fn derivatives<T: Real>(shape: &Shape<T>) -> FinDerivatives<T> {
    let c = T::constant;
    let Shape { hull, wing, fin, .. } = shape;
    let span = wing.span_m(hull);
    let area_ratio = fin.area_m2(hull) / wing.area_m2(hull);
    let sweep_rad = wing.sweep_deg * c(std::f64::consts::PI / 180.0);
    // z_w, down positive.
    let z_w = -wing.height_m;
    let sidewash = c(0.724)
        + c(3.06) * area_ratio / (c(1.0) + sweep_rad.cos())
        + c(0.4) * z_w / hull.diameter_m()
        + c(0.009) * wing.aspect_ratio;
    let c_y_beta = -lift_slope(fin.aspect_ratio, c(0.0)) * area_ratio * sidewash;

    let aft = fin.position * hull.length_m / span;
    let up = fin.height_m / span;
    // A fin without area has a chord whose derivative does not exist.
    let quarter = if fin.area_ratio.value() > 0.0 { c(0.25) * fin.chord_m(hull) / span } else { c(0.0) };
    FinDerivatives {
        c_y_beta,
        c_y_p: c(2.0) * up * c_y_beta,
        c_y_r: c(-2.0) * aft * c_y_beta,
        c_roll_beta: c_y_beta * up,
        c_roll_r: c(-2.0) * aft * up * c_y_beta,
        c_n_beta: -c_y_beta * (aft + quarter),
        c_n_r: c(2.0) * aft * aft * c_y_beta,
    }
}
