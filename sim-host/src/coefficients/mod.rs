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
mod skin_friction;
mod study;
mod wing;

pub use added_mass::{AddedMassOf, spheroid_factors};
pub use parameter::Parameter;
pub use skin_friction::{
    BoundaryLayer, CRITICAL_REYNOLDS_HULL, CRITICAL_REYNOLDS_WING, body_form_factor, friction_coefficient,
    section_form_factor,
};
pub use study::{Anchoring, MassRule, Study};
pub use wing::{OSWALD_EFFICIENCY, lift_slope};

use crate::{
    real::Real,
    vehicle::{AddedMass, Fin, Hull, Hydrodynamics, MomentFrame, Vehicle, Wing},
};

/// The outside of a vehicle.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape<T = f64> {
    /// Hull.
    pub hull: Hull<T>,
    /// Wing.
    pub wing: Wing<T>,
    /// Vertical fin.
    pub fin: Fin<T>,
}

/// The flow that the coefficients hold for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stream<T = f64> {
    /// V, m/s: sets the Reynolds numbers.
    pub speed_m_s: T,
    /// ν, m²/s.
    pub kinematic_viscosity_m2_s: T,
    /// C_L of the glide, for what depends on it; 0 for the mean of dive and climb.
    pub lift_coefficient: T,
}

/// Coefficients of section 4 of the equations, Nelson's signs, referred to an area, a span and a chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients<T = f64> {
    /// S, m².
    pub area_m2: T,
    /// b, m.
    pub span_m: T,
    /// c̄, m.
    pub chord_m: T,
    /// C_D0 and K.
    pub drag: [T; 2],
    /// C_L by 1, α, q̂.
    pub lift: [T; 3],
    /// C_Y by β, p̂, r̂.
    pub side: [T; 3],
    /// C_l by β, p̂, r̂.
    pub roll: [T; 3],
    /// C_m by 1, α, q̂.
    pub pitch: [T; 3],
    /// C_n by β, p̂, r̂.
    pub yaw: [T; 3],
}

impl Shape {
    /// Of a vehicle.
    #[must_use]
    pub fn of(vehicle: &Vehicle) -> Self {
        Self { hull: vehicle.hull.clone(), wing: vehicle.wing.clone(), fin: vehicle.fin.clone() }
    }

    /// In another scalar, without derivatives.
    #[must_use]
    pub fn lift<T: Real>(&self) -> Shape<T> {
        let mut lifted = Shape::blank(T::constant(0.0));
        let mut from = self.clone();
        for parameter in Parameter::ALL {
            *parameter.of(&mut lifted) = T::constant(*parameter.of(&mut from));
        }
        lifted
    }
}

impl<T: Real> Shape<T> {
    fn blank(x: T) -> Self {
        Self {
            hull: Hull { length_m: x, fineness: x },
            wing: Wing {
                aspect_ratio: x,
                span_ratio: x,
                thickness_ratio: x,
                position: x,
                sweep_deg: x,
                dihedral_deg: x,
                height_m: x,
            },
            fin: Fin { area_ratio: x, position: x, aspect_ratio: x, thickness_ratio: x, height_m: x },
        }
    }

    /// Re_l = V l/ν.
    #[must_use]
    pub fn hull_reynolds(&self, stream: &Stream<T>) -> T {
        stream.speed_m_s * self.hull.length_m / stream.kinematic_viscosity_m2_s
    }

    /// Re_c = V c̄/ν.
    #[must_use]
    pub fn wing_reynolds(&self, stream: &Stream<T>) -> T {
        stream.speed_m_s * self.wing.chord_m(&self.hull) / stream.kinematic_viscosity_m2_s
    }

    /// Reynolds number of the fin's chord; none without a fin.
    #[must_use]
    pub fn fin_reynolds(&self, stream: &Stream<T>) -> Option<T> {
        let there = self.fin.area_ratio.value() > 0.0;
        there.then(|| stream.speed_m_s * self.fin.chord_m(&self.hull) / stream.kinematic_viscosity_m2_s)
    }

    /// C_D0: friction on the wetted areas with their form factors, referred to S.
    ///
    /// The hull's wetted area is the side of the cylinder, πdl; wing and fin have two sides outside the hull.
    #[must_use]
    pub fn parasitic_drag(&self, stream: &Stream<T>) -> T {
        let c = T::constant;
        let (hull, wing, fin) = (&self.hull, &self.wing, &self.fin);
        let side_m2 = c(std::f64::consts::PI) * hull.diameter_m() * hull.length_m;
        let mut drag_m2 = friction_coefficient(self.hull_reynolds(stream), CRITICAL_REYNOLDS_HULL)
            * body_form_factor(c(1.0) / hull.fineness)
            * side_m2;
        let plate_m2 = |area_m2: T, reynolds: T, thickness_ratio: T| {
            let friction = friction_coefficient(reynolds, CRITICAL_REYNOLDS_WING);
            friction * section_form_factor(thickness_ratio) * c(2.0) * area_m2
        };
        drag_m2 += plate_m2(wing.exposed_area_m2(hull), self.wing_reynolds(stream), wing.thickness_ratio);
        if let Some(reynolds) = self.fin_reynolds(stream) {
            drag_m2 += plate_m2(fin.area_m2(hull), reynolds, fin.thickness_ratio);
        }
        drag_m2 / wing.area_m2(hull)
    }

    /// Every coefficient, referred to the wing's own S, b and c̄.
    #[must_use]
    pub fn coefficients(&self, stream: &Stream<T>) -> Coefficients<T> {
        let zero = T::constant(0.0);
        let wing = wing::derivatives(self, stream.lift_coefficient);
        let fin = fin::derivatives(self);
        let c_d_zero = self.parasitic_drag(stream);
        Coefficients {
            area_m2: self.wing.area_m2(&self.hull),
            span_m: self.wing.span_m(&self.hull),
            chord_m: self.wing.chord_m(&self.hull),
            drag: [c_d_zero, wing.c_d_induced],
            lift: [zero, wing.c_l_alpha, wing.c_l_q],
            side: [fin.c_y_beta, fin.c_y_p, fin.c_y_r],
            roll: [wing.c_roll_beta + fin.c_roll_beta, wing.c_roll_p, wing.c_roll_r + fin.c_roll_r],
            pitch: [zero, wing.c_m_alpha, wing.c_m_q],
            // The wing that advances in a yaw drags more (Nelson, Etkin: a quarter of C_D0, as if all of it were the wing's).
            yaw: [fin.c_n_beta, wing.c_n_p, fin.c_n_r - c_d_zero / T::constant(4.0)],
        }
    }

    /// Added mass and inertia in water of some density.
    #[must_use]
    pub fn added_mass(&self, density_kg_m3: T) -> AddedMassOf<T> {
        added_mass::added_mass(self, density_kg_m3)
    }
}

impl<T: Real> Coefficients<T> {
    /// The same forces and moments, referred to another area, span and chord.
    #[must_use]
    pub fn referred_to(&self, area_m2: T, span_m: T, chord_m: T) -> Self {
        let (force, wide, long) = (self.area_m2 / area_m2, self.span_m / span_m, self.chord_m / chord_m);
        let scaled = |[x, y, z]: [T; 3], lever: T, rates: [T; 2]| {
            let all = force * lever;
            [x * all, y * all * rates[0], z * all * rates[1]]
        };
        let one = T::constant(1.0);
        Self {
            area_m2,
            span_m,
            chord_m,
            drag: [self.drag[0] * force, self.drag[1] / force],
            lift: scaled(self.lift, one, [one, long]),
            side: scaled(self.side, one, [wide, wide]),
            roll: scaled(self.roll, wide, [wide, wide]),
            pitch: scaled(self.pitch, long, [one, long]),
            yaw: scaled(self.yaw, wide, [wide, wide]),
        }
    }

    /// Entry by entry with another set; the references stay this one's.
    fn zip_map(&self, other: &Self, f: impl Fn(T, T) -> T) -> Self {
        fn each<T: Copy, const N: usize>(a: [T; N], b: [T; N], f: impl Fn(T, T) -> T) -> [T; N] {
            std::array::from_fn(|i| f(a[i], b[i]))
        }
        Self {
            drag: each(self.drag, other.drag, &f),
            lift: each(self.lift, other.lift, &f),
            side: each(self.side, other.side, &f),
            roll: each(self.roll, other.roll, &f),
            pitch: each(self.pitch, other.pitch, &f),
            yaw: each(self.yaw, other.yaw, &f),
            ..*self
        }
    }
}

impl From<&Hydrodynamics> for Coefficients {
    fn from(h: &Hydrodynamics) -> Self {
        Self {
            area_m2: h.area_m2,
            span_m: h.span_m,
            chord_m: h.chord_m,
            drag: [h.c_d_zero, h.c_d_induced],
            lift: [h.c_l_zero, h.c_l_alpha, h.c_l_q],
            side: [h.c_y_beta, h.c_y_p, h.c_y_r],
            roll: [h.c_roll_beta, h.c_roll_p, h.c_roll_r],
            pitch: [h.c_m_zero, h.c_m_alpha, h.c_m_q],
            yaw: [h.c_n_beta, h.c_n_p, h.c_n_r],
        }
    }
}

impl Coefficients {
    /// In another scalar, without derivatives.
    #[must_use]
    pub fn lift<T: Real>(&self) -> Coefficients<T> {
        let three = |values: [f64; 3]| values.map(T::constant);
        Coefficients {
            area_m2: T::constant(self.area_m2),
            span_m: T::constant(self.span_m),
            chord_m: T::constant(self.chord_m),
            drag: self.drag.map(T::constant),
            lift: three(self.lift),
            side: three(self.side),
            roll: three(self.roll),
            pitch: three(self.pitch),
            yaw: three(self.yaw),
        }
    }

    /// As a vehicle has them.
    #[must_use]
    pub fn hydrodynamics(&self, moment_frame: MomentFrame) -> Hydrodynamics {
        let ([c_d_zero, c_d_induced], [c_l_zero, c_l_alpha, c_l_q]) = (self.drag, self.lift);
        let ([c_y_beta, c_y_p, c_y_r], [c_roll_beta, c_roll_p, c_roll_r]) = (self.side, self.roll);
        let ([c_m_zero, c_m_alpha, c_m_q], [c_n_beta, c_n_p, c_n_r]) = (self.pitch, self.yaw);
        Hydrodynamics {
            area_m2: self.area_m2,
            span_m: self.span_m,
            chord_m: self.chord_m,
            moment_frame,
            c_d_zero,
            c_d_induced,
            c_l_zero,
            c_l_alpha,
            c_l_q,
            c_y_beta,
            c_y_p,
            c_y_r,
            c_roll_beta,
            c_roll_p,
            c_roll_r,
            c_m_zero,
            c_m_alpha,
            c_m_q,
            c_n_beta,
            c_n_p,
            c_n_r,
        }
    }
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
