//! Equations (1)–(8): the rates of a state.

use nalgebra::{Matrix3, Vector3, Vector6};

use super::{
    Plant, State, Surroundings,
    attitude::{quaternion_rate, rotation_from_quaternion},
    inertia::{ParticlePlace, axis, stack},
    solve::Cholesky,
};
use crate::model::real::Real;

/// Inputs of the plant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Input<T: Real> {
    /// u_px: axial force on the particle, N.
    pub u_px_n: T,
    /// u_μ: moment about b1 on the particle, N m.
    pub u_mu_nm: T,
    /// u_b: rate of displaced volume, m³/s.
    pub u_b_m3_s: T,
}

impl<T: Real> Input<T> {
    /// No input.
    #[must_use]
    pub fn none() -> Self {
        let zero = T::constant(0.0);
        Self { u_px_n: zero, u_mu_nm: zero, u_b_m3_s: zero }
    }
}

/// What holds the particle on its prescribed motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reaction<T: Real> {
    /// Axial force on the particle, N.
    pub u_px_n: T,
    /// Moment about b1 on the particle, N m.
    pub u_mu_nm: T,
}

/// Right-hand sides of (4)–(7) without inputs, less Ṁ η.
struct Balance<T: Real> {
    body: Vector6<T>,
    particle: [T; 2],
}

/// A particle held in one place, and the factored mass matrix that goes with it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Held<T: Real> {
    place: ParticlePlace<T>,
    matrix: Cholesky<T, 6>,
}

impl<T: Real> Plant<T> {
    /// Rates of a state with the particle free to move under its inputs: eight degrees of freedom.
    ///
    /// The result is a `State` whose every field is the time derivative of that field.
    #[must_use]
    pub fn derivative(&self, state: &State<T>, input: &Input<T>, water: &Surroundings<T>) -> State<T> {
        let place = self.particle_place(state.r_px_m, state.mu_rad);
        let to_inertial = rotation_from_quaternion(&state.quaternion);
        let balance = self.balance(state, &place, &to_inertial, water);
        let [axial, swing] = balance.particle;
        let (upper, lower) = halves(&balance.body);
        let rhs = stack(&upper, &lower, axial + input.u_px_n, swing + input.u_mu_nm);
        let acceleration = Cholesky::new(self.mass_matrix(state.r_px_m, state.mu_rad)).solve(rhs);
        let body = Vector6::from_fn(|i, _| acceleration[i]);
        assemble(
            state,
            &(to_inertial * state.velocity_m_s + water.current_m_s),
            &body,
            [acceleration[6], acceleration[7]],
            input.u_b_m3_s,
        )
    }

    /// Rates of a state whose particle keeps its present speed (a braked or self-locking drive): six degrees of freedom.
    #[must_use]
    pub fn derivative_driven(&self, state: &State<T>, u_b_m3_s: T, water: &Surroundings<T>) -> State<T> {
        self.derivative_held(state, &self.held(state), u_b_m3_s, water)
    }

    /// The particle where it is.
    pub(super) fn held(&self, state: &State<T>) -> Held<T> {
        let place = self.particle_place(state.r_px_m, state.mu_rad);
        Held { place, matrix: Cholesky::new(self.body_matrix(&place)) }
    }

    /// As [`Plant::derivative_driven`], with what the particle's place gives computed before.
    pub(super) fn derivative_held(
        &self,
        state: &State<T>,
        held: &Held<T>,
        u_b_m3_s: T,
        water: &Surroundings<T>,
    ) -> State<T> {
        let to_inertial = rotation_from_quaternion(&state.quaternion);
        let balance = self.balance(state, &held.place, &to_inertial, water);
        let body = held.matrix.solve(balance.body);
        let zero = T::constant(0.0);
        assemble(state, &(to_inertial * state.velocity_m_s + water.current_m_s), &body, [zero, zero], u_b_m3_s)
    }

    /// Force and moment that the drive must give for the particle to keep its present speed.
    #[must_use]
    pub fn reaction(&self, state: &State<T>, water: &Surroundings<T>) -> Reaction<T> {
        let Held { place, matrix } = self.held(state);
        let balance = self.balance(state, &place, &rotation_from_quaternion(&state.quaternion), water);
        let (linear, angular) = halves(&matrix.solve(balance.body));
        let (m, e1) = (self.particle_kg, axis::<T>());
        let row = |direction: &Vector3<T>, spin: &Vector3<T>| {
            direction.dot(&linear) + (place.r.cross(direction) + spin).dot(&angular)
        };
        let none = Vector3::repeat(T::constant(0.0));
        Reaction {
            u_px_n: row(&(e1 * m), &none) - balance.particle[0],
            u_mu_nm: row(&(place.swing * m), &(place.inertia * e1)) - balance.particle[1],
        }
    }

    /// Resultant force and moment of the body's six equations in the static water, N and N m: zero in steady flight.
    #[must_use]
    pub fn body_residual(&self, state: &State<T>) -> Vector6<T> {
        let place = self.particle_place(state.r_px_m, state.mu_rad);
        self.balance(state, &place, &rotation_from_quaternion(&state.quaternion), &self.still()).body
    }

    /// The change of (v, ω) when the particle's speed jumps: momentum is kept.
    #[must_use]
    pub fn with_particle_rates(&self, state: &State<T>, r_px_rate_m_s: T, mu_rate_rad_s: T) -> State<T> {
        let Held { place, matrix } = self.held(state);
        let (m, e1) = (self.particle_kg, axis::<T>());
        let (axial, turn) = (r_px_rate_m_s - state.r_px_rate_m_s, mu_rate_rad_s - state.mu_rate_rad_s);
        let linear = (e1 * axial + place.swing * turn) * m;
        let angular = place.r.cross(&linear) + place.inertia * e1 * turn;
        let (velocity, rate) = halves(&matrix.solve(join(&-linear, &-angular)));
        State {
            velocity_m_s: state.velocity_m_s + velocity,
            rate_rad_s: state.rate_rad_s + rate,
            r_px_rate_m_s,
            mu_rate_rad_s,
            ..*state
        }
    }

    /// Potential energy in the static water, U = −m̃ g (i3·X) − g ζ·(m_rb r_rb + m_p r_p − ρ ΔV x e1), J.
    ///
    /// The last term is there if the variable volume ΔV acts at its station x.
    #[must_use]
    pub fn potential_energy_j(&self, state: &State<T>) -> T {
        let down = rotation_from_quaternion(&state.quaternion).row(2).transpose();
        let moment = self.body_moment_kg_m + self.particle_place(state.r_px_m, state.mu_rad).r * self.particle_kg;
        let turned =
            self.displaced_moment_kg_m(state, self.density_kg_m3).map_or(moment, |displaced| moment - displaced);
        let weight = self.net_mass_kg(state.displaced_volume_m3) * state.position_m.z;
        -(weight + down.dot(&turned)) * self.gravity_m_s2
    }

    /// Right-hand sides of (4)–(7), less Ṁ η, inputs left out.
    fn balance(
        &self,
        state: &State<T>,
        place: &ParticlePlace<T>,
        to_inertial: &Matrix3<T>,
        water: &Surroundings<T>,
    ) -> Balance<T> {
        let (v, w, e1) = (state.velocity_m_s, state.rate_rad_s, axis::<T>());
        let motion = self.particle_motion(state, place);
        let (p, h) = self.body_momentum(state, place, &motion);
        let zeta = to_inertial.row(2).transpose();
        let gravity = zeta * self.gravity_m_s2;
        let viscous = self.viscous(&v, &w, water.density_kg_m3);
        let moment = self.body_moment_kg_m + place.r * self.particle_kg;
        let carried = self.carried(state, to_inertial, water);
        // What every mass feels in the frame that goes with the water.
        let felt = carried.map_or(gravity, |carried| gravity + carried.felt_m_s2);

        let net_mass = self.mass_kg - water.density_kg_m3 * self.volume_in(state, water);
        let mut force = p.cross(&w) + gravity * net_mass + viscous.force_n;
        if let Some(carried) = &carried {
            force += carried.force_n;
        }
        let mut torque = h.cross(&w) + p.cross(&v) + moment.cross(&felt) + viscous.moment_nm;
        if let Some(displaced) = self.displaced_moment_kg_m(state, water.density_kg_m3) {
            torque -= displaced.cross(&gravity);
        }
        let (lost_force, lost_torque) = self.emerged(state, &zeta, water);
        let on_particle = motion.momentum.cross(&motion.rate) + felt * self.particle_kg;

        // Ṁ η: only the particle's part of M varies.
        let turning = motion.rate.cross(&motion.r_rate) * self.particle_kg;
        let spinning = (e1.cross(&motion.spin) - place.inertia * e1.cross(&motion.rate)) * state.mu_rate_rad_s;
        let varying = motion.r_rate.cross(&motion.momentum) + place.r.cross(&turning) + spinning;
        let swinging = e1.cross(&motion.r_rate).dot(&motion.momentum) + place.swing.dot(&turning);
        Balance {
            body: join(&(force + lost_force - turning), &(torque + lost_torque - varying)),
            particle: [
                e1.dot(&on_particle) - e1.dot(&turning),
                place.swing.dot(&on_particle) + e1.dot(&motion.spin.cross(&w)) - swinging,
            ],
        }
    }
}

fn assemble<T: Real>(
    state: &State<T>,
    position_m_s: &Vector3<T>,
    body: &Vector6<T>,
    particle: [T; 2],
    u_b_m3_s: T,
) -> State<T> {
    let (velocity_m_s, rate_rad_s) = halves(body);
    State {
        position_m: *position_m_s,
        quaternion: quaternion_rate(&state.quaternion, &state.rate_rad_s),
        velocity_m_s,
        rate_rad_s,
        r_px_m: state.r_px_rate_m_s,
        r_px_rate_m_s: particle[0],
        mu_rad: state.mu_rate_rad_s,
        mu_rate_rad_s: particle[1],
        displaced_volume_m3: u_b_m3_s,
    }
}

fn join<T: Real>(a: &Vector3<T>, b: &Vector3<T>) -> Vector6<T> {
    Vector6::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

fn halves<T: Real>(both: &Vector6<T>) -> (Vector3<T>, Vector3<T>) {
    (Vector3::new(both[0], both[1], both[2]), Vector3::new(both[3], both[4], both[5]))
}
