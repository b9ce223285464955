//! The one seeded generator of all noise.

use nalgebra::Vector3;
use rand::SeedableRng;
use rand_distr::{Distribution, StandardNormal};
use rand_pcg::Pcg64Mcg;

/// Noise of one flight. What is drawn, and in what order, depends on nothing but the tick: the same seed gives the same errors
/// whatever is measured, and a size of zero changes no other error.
#[derive(Clone, Debug)]
pub(super) struct Noise(Pcg64Mcg);

impl Noise {
    pub(super) fn new(seed: u64) -> Self {
        Self(Pcg64Mcg::seed_from_u64(seed))
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
