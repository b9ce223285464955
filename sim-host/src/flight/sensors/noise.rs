//! Seeded noise: one generator for pressure, attitude, position and potentiometers, and a stream for each other instrument.

use nalgebra::Vector3;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

use crate::flight::Instrument;

/// Spreads small numbers over all bits: 2⁶⁴ over the golden ratio.
const SPREAD: u64 = 0x9e37_79b9_7f4a_7c15;

/// Noise of one flight. What is drawn, and in what order, depends on nothing but the tick: the same seed gives the same errors
/// whatever is measured, and a size of zero changes no other error.
#[derive(Clone, Debug)]
pub(super) struct Noise(Pcg64Mcg);

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
    }

    /// The stream of one instrument: what it draws, and how often, changes no other's errors.
    pub(super) fn of(instrument: Instrument, seed: u64) -> Self {
        Self::new(seed ^ SPREAD.wrapping_mul(instrument as u64))
    }

    /// Whether something of this probability happens now.
    pub(super) fn happens(&mut self, probability: f64) -> bool {
        self.0.random::<f64>() < probability
    }

    /// One draw of a normal distribution with this standard deviation.
    pub(super) fn normal(&mut self, sigma: f64) -> f64 {
        let draw: f64 = StandardNormal.sample(&mut self.0);
        sigma * draw
    }

    /// Three draws.
    pub(super) fn vector(&mut self, sigmas: [f64; 3]) -> Vector3<f64> {
        Vector3::from(sigmas.map(|sigma| self.normal(sigma)))
    }
}
