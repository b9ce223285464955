//! From geometry to coefficients: the semi-empirical chain.
//!
//! A [`Shape`] in a [`Stream`] gives [`Coefficients`] and [`AddedMassOf`], in any scalar, so that dual numbers carry exact
//! derivatives with respect to every geometric parameter. A [`Study`] makes a vehicle of a changed shape.
//!
//! Such estimates show trends; they are imprecise, and for slender glider wings far off. At slocum-paper's nominal geometry
//! and 0.77 m/s, against what the paper's own tables need:
//!
//! | | from geometry | identified |
//! |---|---|---|
//! | M_f, kg | 1.9, 53, 62 | 5, 60, 70 |
//! | C_D0, K | 0.042, 0.034 | 0.027, 0.186 |
//! | C_Lα, C_mα, C_mq | 5.95, −5.3, −4.3 | 1.80, −5.7, −152 |
//! | C_Yβ, C_nβ, C_nr | −0.56, 0.34, −0.39 | −0.27, 1.04, −0.42 |
//! | C_lβ, C_lp | 0, −0.99 | −0.62, −0.42 |
//!
//! Hence anchoring: where a vehicle has identified numbers, a study adds to them only what the change of shape changes.
//!
//! Of C_L's effects on the lateral coefficients (sweep, C_lr, C_np) a dive has one sign and a climb the other. A vehicle that
//! flies both has their mean: none. Its file is therefore read at C_L = 0; a study of one glide may give that glide's C_L.

mod added_mass;
mod fin;
mod parameter;
mod set;
mod shape;
mod skin_friction;
mod study;
mod wing;

pub use added_mass::{AddedMassOf, spheroid_factors};
pub use parameter::Parameter;
pub use set::Coefficients;
pub use shape::{Shape, Stream};
pub use skin_friction::{
    BoundaryLayer, CRITICAL_REYNOLDS_HULL, CRITICAL_REYNOLDS_WING, body_form_factor, friction_coefficient,
    section_form_factor,
};
pub use study::{Anchoring, MassRule, Study};
pub use wing::{OSWALD_EFFICIENCY, lift_slope};
