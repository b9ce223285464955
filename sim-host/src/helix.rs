//! Steady helices of the full equations, by Newton's method with exact Jacobians.

use nalgebra::{Vector3, Vector6};
use num_dual::DualSVec64;

use crate::{
    plant::{Plant, State, quaternion_from_euler},
    real::Real,
    trim::Glide,
    vehicle::Vehicle,
};

const MOST_ITERATIONS: usize = 30;
/// Residual force and moment, N and N m: rounding of terms of some hundred newtons.
const TOLERANCE: f64 = 1e-9;

/// A steady helix: a turn at constant rate along a path of constant slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    /// γ, rad, climbing positive.
    pub path_angle_rad: f64,
    /// m̃, kg, positive sinks.
    pub net_mass_kg: f64,
    /// μ, rad.
    pub mu_rad: f64,
    /// V, m/s.
    pub speed_m_s: f64,
    /// α, rad.
    pub alpha_rad: f64,
    /// β, rad.
    pub beta_rad: f64,
    /// φ, rad, right wing down.
    pub roll_rad: f64,
    /// θ, rad.
    pub pitch_rad: f64,
    /// Axial position of the moving mass, m.
    pub r_px_m: f64,
    /// Ω, rad/s, right positive.
    pub turn_rate_rad_s: f64,
}

impl From<&Glide> for Helix {
    fn from(glide: &Glide) -> Self {
        Self {
            path_angle_rad: glide.path_angle_rad,
            net_mass_kg: glide.net_mass_kg,
            mu_rad: 0.0,
            speed_m_s: glide.speed_m_s,
            alpha_rad: glide.alpha_rad,
            beta_rad: 0.0,
            roll_rad: 0.0,
            pitch_rad: glide.pitch_rad,
            r_px_m: glide.r_px_m,
            turn_rate_rad_s: 0.0,
        }
    }
}

/// Finds steady helices of one vehicle.
#[derive(Clone, Debug)]
pub struct HelixSolver {
    plant: Plant<DualSVec64<6>>,
}

impl HelixSolver {
    /// For a vehicle in the water of its static analyses.
    #[must_use]
    pub fn new(vehicle: &Vehicle) -> Self {
        Self { plant: Plant::new(vehicle) }
    }

    /// The helix at the path angle and net mass of `near` with the mass rotated to `mu_rad`, starting the search from `near`.
    ///
    /// # Errors
    /// One line with the residual that is left, if the search does not converge.
    pub fn solve(&self, near: &Helix, mu_rad: f64) -> Result<Helix, String> {
        let mut x = Vector6::new(
            near.speed_m_s,
            near.alpha_rad,
            near.beta_rad,
            near.roll_rad,
            near.r_px_m,
            near.turn_rate_rad_s,
        );
        let mut residual = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let duals = Vector6::from_fn(|i, _| DualSVec64::<6>::from_re(x[i]).derivative(i));
            let (state, pitch_rad) = steady_state(&self.plant, &duals, near.path_angle_rad, near.net_mass_kg, mu_rad);
            let balance = self.plant.body_residual(&state);
            let f = balance.map(|row| row.re);
            residual = f.amax();
            if residual < TOLERANCE {
                let [speed_m_s, alpha_rad, beta_rad, roll_rad, r_px_m, turn_rate_rad_s] = x.into();
                let pitch_rad = pitch_rad.re;
                return Ok(Helix {
                    mu_rad,
                    speed_m_s,
                    alpha_rad,
                    beta_rad,
                    roll_rad,
                    pitch_rad,
                    r_px_m,
                    turn_rate_rad_s,
                    ..*near
                });
            }
            let jacobian = nalgebra::Matrix6::from_fn(|i, j| {
                balance[i].eps.unwrap_generic(nalgebra::Const::<6>, nalgebra::Const::<1>)[j]
            });
            let Some(step) = jacobian.lu().solve(&f) else { break };
            x -= step;
        }
        Err(format!(
            "no steady turn at path angle {:.3}°, net mass {:.4} kg, mu {:.2}°: a residual of {residual:.2e} N is left",
            near.path_angle_rad.to_degrees(),
            near.net_mass_kg,
            mu_rad.to_degrees()
        ))
    }
}

/// The state of a helix with unknowns (V, α, β, φ, r_px, Ω), and its pitch.
fn steady_state<T: Real>(
    plant: &Plant<T>,
    x: &Vector6<T>,
    path_angle_rad: f64,
    net_mass_kg: f64,
    mu_rad: f64,
) -> (State<T>, T) {
    let [speed, alpha, beta, roll, r_px_m, turn_rate]: [T; 6] = [x[0], x[1], x[2], x[3], x[4], x[5]];
    let direction = Vector3::new(alpha.cos() * beta.cos(), beta.sin(), alpha.sin() * beta.cos());
    let pitch = pitch_for_path(&direction, roll, T::constant(path_angle_rad));
    let zeta = Vector3::new(-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos());
    let zero = T::constant(0.0);
    let state = State {
        quaternion: quaternion_from_euler(&Vector3::new(roll, pitch, zero)),
        velocity_m_s: direction * speed,
        rate_rad_s: zeta * turn_rate,
        r_px_m,
        mu_rad: T::constant(mu_rad),
        ..State::at_rest(plant.displaced_volume_m3(T::constant(net_mass_kg)))
    };
    (state, pitch)
}

/// The pitch at which a velocity along `direction` (body axes) climbs at γ: a sinθ − b cosθ = sinγ.
fn pitch_for_path<T: Real>(direction: &Vector3<T>, roll: T, path_angle: T) -> T {
    let (a, b) = (direction.x, direction.y * roll.sin() + direction.z * roll.cos());
    let sine = path_angle.sin() / T::hypot(a, b);
    let cosine = (T::constant(1.0) - sine * sine).sqrt();
    sine.atan2(cosine) + b.atan2(a)
}
