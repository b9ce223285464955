//! Appendix A: the mass matrix M(r_p) and the momenta.

use nalgebra::{Matrix3, Matrix6, SMatrix, SVector, Vector3};

use super::{Plant, State};
use crate::model::real::Real;

/// M, block order (v | ω | ṙ_px | μ̇).
pub type Matrix8<T> = SMatrix<T, 8, 8>;
/// Momenta (p, h, p_px, h_px) or velocities η, in the same order.
pub(super) type Vector8<T> = SVector<T, 8>;

/// What the particle's place alone gives.
#[derive(Clone, Copy, Debug)]
pub(super) struct ParticlePlace<T: Real> {
    /// r_p, m.
    pub(super) r: Vector3<T>,
    /// ∂r_p/∂μ = e1 × r_p = R_p a_μ, m.
    pub(super) swing: Vector3<T>,
    /// Inertia of the moving mass about its own centre, body axes, kg m².
    pub(super) inertia: Matrix3<T>,
}

/// What its motion adds.
#[derive(Clone, Copy, Debug)]
pub(super) struct ParticleMotion<T: Real> {
    /// ω + μ̇ e1, rad/s.
    pub(super) rate: Vector3<T>,
    /// ṙ_p seen from the body, m/s.
    pub(super) r_rate: Vector3<T>,
    /// p_p = m_p v_p, kg m/s.
    pub(super) momentum: Vector3<T>,
    /// Angular momentum of the moving mass about its own centre, body axes, kg m²/s.
    pub(super) spin: Vector3<T>,
}

impl<T: Real> Plant<T> {
    /// M(r_p), 8×8, symmetric and positive definite.
    #[must_use]
    pub fn mass_matrix(&self, r_px_m: T, mu_rad: T) -> Matrix8<T> {
        let place = self.particle_place(r_px_m, mu_rad);
        let ParticlePlace { r, swing, inertia } = place;
        let (m, e1) = (self.particle_kg, axis());
        let mut matrix = Matrix8::repeat(T::constant(0.0));
        matrix.fixed_view_mut::<6, 6>(0, 0).copy_from(&self.body_matrix(&place));
        for (column, direction, spin) in [(6, e1, Vector3::repeat(T::constant(0.0))), (7, swing, inertia * e1)] {
            let linear = direction * m;
            let angular = r.cross(&linear) + spin;
            matrix.fixed_view_mut::<3, 1>(0, column).copy_from(&linear);
            matrix.fixed_view_mut::<3, 1>(3, column).copy_from(&angular);
            matrix.fixed_view_mut::<1, 3>(column, 0).copy_from(&linear.transpose());
            matrix.fixed_view_mut::<1, 3>(column, 3).copy_from(&angular.transpose());
        }
        matrix[(6, 6)] = m;
        matrix[(7, 7)] = m * swing.dot(&swing) + self.particle_inertia_kg_m2.x;
        matrix
    }

    /// Upper left 6×6 block of M: what a body with a held particle resists with.
    pub(super) fn body_matrix(&self, place: &ParticlePlace<T>) -> Matrix6<T> {
        let hat = cross_matrix(&place.r);
        let m = self.particle_kg;
        let translation = self.fixed_mass_kg + Matrix3::from_diagonal(&Vector3::repeat(m));
        let coupling = self.fixed_coupling_kg_m + hat * m;
        let rotation = self.fixed_inertia_kg_m2 + place.inertia - hat * hat * m;
        let mut matrix = Matrix6::repeat(T::constant(0.0));
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&translation);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&coupling);
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&coupling.transpose());
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&rotation);
        matrix
    }

    /// Momenta (p, h, p_px, h_px) = M η.
    #[must_use]
    pub fn momentum(&self, state: &State<T>) -> SVector<T, 8> {
        let place = self.particle_place(state.r_px_m, state.mu_rad);
        let motion = self.particle_motion(state, &place);
        let (p, h) = self.body_momentum(state, &place, &motion);
        let e1 = axis();
        let h_px = place.swing.dot(&motion.momentum) + e1.dot(&motion.spin);
        stack(&p, &h, e1.dot(&motion.momentum), h_px)
    }

    /// Kinetic energy ½ ηᵀ M η, J.
    #[must_use]
    pub fn kinetic_energy_j(&self, state: &State<T>) -> T {
        let eta = stack(&state.velocity_m_s, &state.rate_rad_s, state.r_px_rate_m_s, state.mu_rate_rad_s);
        eta.dot(&self.momentum(state)) * T::constant(0.5)
    }

    /// Linear and angular momentum (p, h) of the whole, about the body's origin.
    pub(super) fn body_momentum(
        &self,
        state: &State<T>,
        place: &ParticlePlace<T>,
        motion: &ParticleMotion<T>,
    ) -> (Vector3<T>, Vector3<T>) {
        let (v, w) = (state.velocity_m_s, state.rate_rad_s);
        let p = self.fixed_mass_kg * v + self.fixed_coupling_kg_m.tr_mul(&w) + motion.momentum;
        let h =
            self.fixed_coupling_kg_m * v + self.fixed_inertia_kg_m2 * w + place.r.cross(&motion.momentum) + motion.spin;
        (p, h)
    }

    pub(super) fn particle_place(&self, r_px_m: T, mu_rad: T) -> ParticlePlace<T> {
        let (sin_mu, cos_mu) = (mu_rad.sin(), mu_rad.cos());
        let r = Vector3::new(r_px_m, -self.particle_radius_m * sin_mu, self.particle_radius_m * cos_mu);
        ParticlePlace { r, swing: axis().cross(&r), inertia: self.particle_inertia(sin_mu, cos_mu) }
    }

    pub(super) fn particle_motion(&self, state: &State<T>, place: &ParticlePlace<T>) -> ParticleMotion<T> {
        let e1 = axis();
        let rate = state.rate_rad_s + e1 * state.mu_rate_rad_s;
        let r_rate = e1 * state.r_px_rate_m_s + place.swing * state.mu_rate_rad_s;
        let velocity = state.velocity_m_s + state.rate_rad_s.cross(&place.r) + r_rate;
        ParticleMotion { rate, r_rate, momentum: velocity * self.particle_kg, spin: place.inertia * rate }
    }

    /// R_BP diag(I) R_BPᵀ: the moving mass's own inertia turned with μ, body axes.
    fn particle_inertia(&self, sin_mu: T, cos_mu: T) -> Matrix3<T> {
        let (zero, own) = (T::constant(0.0), &self.particle_inertia_kg_m2);
        let [s, c] = [sin_mu, cos_mu];
        let across = (own.y - own.z) * s * c;
        Matrix3::new(
            own.x,
            zero,
            zero,
            zero,
            own.y * s * s + own.z * c * c,
            -across,
            zero,
            -across,
            own.y * c * c + own.z * s * s,
        )
    }
}

/// b1.
pub(super) fn axis<T: Real>() -> Vector3<T> {
    Vector3::new(T::constant(1.0), T::constant(0.0), T::constant(0.0))
}

/// â with â b = a × b. (nalgebra's own asks for a field with a sign.)
fn cross_matrix<T: Real>(a: &Vector3<T>) -> Matrix3<T> {
    let zero = T::constant(0.0);
    Matrix3::new(zero, -a.z, a.y, a.z, zero, -a.x, -a.y, a.x, zero)
}

/// Two vectors and two scalars as one column.
pub(super) fn stack<T: Real>(a: &Vector3<T>, b: &Vector3<T>, c: T, d: T) -> Vector8<T> {
    Vector8::from([a.x, a.y, a.z, b.x, b.y, b.z, c, d])
}
