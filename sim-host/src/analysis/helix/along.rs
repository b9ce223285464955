//! How steady helices change with what their vehicle is made of: exact, by the implicit function theorem.
//!
//! The plant carries the derivative by one parameter in an inner dual number, that by the eight unknowns in an outer one. A helix
//! x of F(x; k) = 0 then changes by −F_x⁻¹ F_k, which is one step of Newton's method from the helix itself.

use nalgebra::{SMatrix, U1};
use num_dual::{Derivative, DualSVec, DualSVec64};

use super::{
    Helix, Scale, Slope, Turn, Unknowns,
    search::{Asked, residual},
};
use crate::model::{plant::Plant, real::Real};

/// A value and its derivative by one parameter.
pub(crate) type Along = DualSVec64<1>;
/// The same of a derivative by one of eight unknowns.
pub(crate) type Nested = DualSVec<Along, 8>;

/// The derivative that a number carries.
pub(crate) fn rate(value: Along) -> f64 {
    value.eps.unwrap_generic(U1, U1)[0]
}

/// A number with its derivative.
pub(crate) fn with_rate(value: f64, rate: f64) -> Along {
    Along::new(value, Derivative::some(SMatrix::from([rate])))
}

/// Steady helices of a vehicle that changes with a parameter.
#[derive(Clone, Debug)]
pub(crate) struct HelixAlong<'a> {
    pub(crate) plant: &'a Plant<Nested>,
}

impl HelixAlong<'_> {
    /// A helix that was found, with its derivative; what is asked may change with the parameter, too.
    pub(crate) fn helix(
        &self,
        found: &Helix,
        scale: Scale<Along>,
        slope: Slope<Along>,
        turn: Turn<Along>,
    ) -> Option<Helix<Along>> {
        let x = found.lift().unknowns(scale);
        let (left, jacobian) = residual(self.plant, &x, &Asked { scale, slope, turn });
        let step = jacobian.map(|entry| entry.re).lu().solve(&left.map(rate))?;
        Some(Helix::from_unknowns(&x.zip_map(&step, |value, step| with_rate(value.re, -step)), scale))
    }

    /// dΩ/dμ at a helix with slope and net mass held, 1/s, with its derivative.
    ///
    /// It is the last but one entry of y = F_x⁻¹ e₈, whose own derivative is −F_x⁻¹ (dF_x) y.
    pub(crate) fn turn_per_mu(&self, helix: &Helix<Along>) -> Option<Along> {
        let asked = Asked {
            scale: Scale::NetMass(helix.net_mass_kg),
            slope: Slope::Pitch(helix.pitch_rad),
            turn: Turn::Mu(helix.mu_rad),
        };
        let (_, jacobian) = residual(self.plant, &helix.unknowns(asked.scale), &asked);
        let lu = jacobian.map(|entry| entry.re).lu();
        let change = lu.solve(&Unknowns::from([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))?;
        let second = lu.solve(&(jacobian.map(rate) * change))?;
        Some(with_rate(change[7], -second[7]))
    }
}

impl Helix {
    /// As a constant.
    fn lift(&self) -> Helix<Along> {
        let scale = Scale::NetMass(self.net_mass_kg);
        Helix::from_unknowns(
            &self.unknowns(scale).map(Along::constant),
            Scale::NetMass(Along::constant(self.net_mass_kg)),
        )
    }
}
