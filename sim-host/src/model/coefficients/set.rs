//! A set of coefficients in any scalar, and the same forces under other reference lengths.

use crate::model::{
    real::Real,
    vehicle::{Hydrodynamics, MomentFrame},
};

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
    pub(super) fn zip_map(&self, other: &Self, f: impl Fn(T, T) -> T) -> Self {
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
