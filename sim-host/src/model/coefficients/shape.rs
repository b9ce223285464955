//! The outside of a vehicle, and what its parts add up to.

use super::{
    AddedMassOf, CRITICAL_REYNOLDS_HULL, CRITICAL_REYNOLDS_WING, Coefficients, Parameter, added_mass, body_form_factor,
    fin, friction_coefficient, section_form_factor, wing,
};
use crate::model::{
    real::Real,
    vehicle::{Fin, Hull, Vehicle, Wing},
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
