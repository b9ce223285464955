//! Steady helices of the full equations, by Newton's method with exact Jacobians.

use nalgebra::{Const, SMatrix, SVector, Vector3};
use num_dual::DualSVec64;

use crate::{
    plant::{Plant, State, quaternion_from_euler},
    real::Real,
    trim::Glide,
    vehicle::Vehicle,
};

const MOST_ITERATIONS: usize = 30;
/// Residual force and moment, N and N m, and angles, rad: rounding of terms of some hundred newtons.
const TOLERANCE: f64 = 1e-9;

type Dual = DualSVec64<8>;
type Unknowns<T> = SVector<T, 8>;

/// A steady helix: a turn at constant rate along a path of constant slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix {
    /// m̃, kg, positive sinks.
    pub net_mass_kg: f64,
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
    /// μ, rad.
    pub mu_rad: f64,
    /// Ω, rad/s, right positive.
    pub turn_rate_rad_s: f64,
}

impl From<&Glide> for Helix {
    fn from(glide: &Glide) -> Self {
        Self {
            net_mass_kg: glide.net_mass_kg,
            speed_m_s: glide.speed_m_s,
            alpha_rad: glide.alpha_rad,
            beta_rad: 0.0,
            roll_rad: 0.0,
            pitch_rad: glide.pitch_rad,
            r_px_m: glide.r_px_m,
            mu_rad: 0.0,
            turn_rate_rad_s: 0.0,
        }
    }
}

impl Helix {
    /// γ, rad, climbing positive.
    #[must_use]
    pub fn path_angle_rad(&self) -> f64 {
        libm::asin(climb(&self.unknowns()))
    }

    /// Radius of the helix seen from above, m; infinite for a straight glide.
    #[must_use]
    pub fn radius_m(&self) -> f64 {
        self.speed_m_s * libm::cos(self.path_angle_rad()) / self.turn_rate_rad_s.abs()
    }

    /// The helix as a state of the plant, heading north, at depth 0.
    #[must_use]
    pub fn state(&self, plant: &Plant<f64>) -> State<f64> {
        steady_state(plant, &self.unknowns(), self.net_mass_kg)
    }

    fn unknowns(&self) -> Unknowns<f64> {
        Unknowns::from([
            self.speed_m_s,
            self.alpha_rad,
            self.beta_rad,
            self.roll_rad,
            self.pitch_rad,
            self.r_px_m,
            self.mu_rad,
            self.turn_rate_rad_s,
        ])
    }

    fn from_unknowns(x: &Unknowns<f64>, net_mass_kg: f64) -> Self {
        let [speed_m_s, alpha_rad, beta_rad, roll_rad, pitch_rad, r_px_m, mu_rad, turn_rate_rad_s] = (*x).into();
        Self { net_mass_kg, speed_m_s, alpha_rad, beta_rad, roll_rad, pitch_rad, r_px_m, mu_rad, turn_rate_rad_s }
    }
}

/// What is given of the helix's slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slope {
    /// γ, rad.
    PathAngle(f64),
    /// θ, rad.
    Pitch(f64),
}

/// What is given of its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn {
    /// μ, rad.
    Mu(f64),
    /// Ω, rad/s.
    Rate(f64),
}

/// Finds steady helices of one vehicle.
#[derive(Clone, Debug)]
pub struct HelixSolver {
    plant: Plant<Dual>,
}

impl HelixSolver {
    /// For a vehicle in the water of its static analyses.
    #[must_use]
    pub fn new(vehicle: &Vehicle) -> Self {
        Self { plant: Plant::new(vehicle) }
    }

    /// The helix at the net mass of `near` with the slope and turn that are given, starting the search from `near`.
    ///
    /// # Errors
    /// One line with the residual that is left, if the search does not converge.
    pub fn solve(&self, near: &Helix, slope: Slope, turn: Turn) -> Result<Helix, String> {
        let mut x = near.unknowns();
        let mut left = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let (residual, jacobian) = self.residual(&x, near.net_mass_kg, slope, turn);
            left = residual.amax();
            if left < TOLERANCE {
                return Ok(Helix::from_unknowns(&x, near.net_mass_kg));
            }
            let Some(step) = jacobian.lu().solve(&residual) else { break };
            x -= step;
        }
        Err(format!(
            "no steady helix with {slope}, {turn}, net mass {:.4} kg: a residual of {left:.2e} N is left",
            near.net_mass_kg
        ))
    }

    /// How all of the helix changes per unit of its turn (per rad of μ, or per rad/s of Ω), its slope held.
    #[must_use]
    pub fn sensitivity(&self, helix: &Helix, slope: Slope, turn: Turn) -> Option<Helix> {
        let (_, jacobian) = self.residual(&helix.unknowns(), helix.net_mass_kg, slope, turn);
        // The given value enters its own row, the last, as −value.
        let change = jacobian.lu().solve(&Unknowns::from([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))?;
        Some(Helix::from_unknowns(&change, 0.0))
    }

    /// Balance of the six equations and of what is given, with its Jacobian.
    fn residual(
        &self,
        x: &Unknowns<f64>,
        net_mass_kg: f64,
        slope: Slope,
        turn: Turn,
    ) -> (Unknowns<f64>, SMatrix<f64, 8, 8>) {
        let x = Unknowns::from_fn(|i, _| Dual::from_re(x[i]).derivative(i));
        let balance = self.plant.body_residual(&steady_state(&self.plant, &x, net_mass_kg));
        let given_slope = match slope {
            Slope::PathAngle(path_angle_rad) => climb(&x) - Dual::constant(libm::sin(path_angle_rad)),
            Slope::Pitch(pitch_rad) => x[4] - Dual::constant(pitch_rad),
        };
        let given_turn = match turn {
            Turn::Mu(mu_rad) => x[6] - Dual::constant(mu_rad),
            Turn::Rate(rate_rad_s) => x[7] - Dual::constant(rate_rad_s),
        };
        let rows = Unknowns::from_fn(|i, _| match i {
            6 => given_slope,
            7 => given_turn,
            _ => balance[i],
        });
        let jacobian = SMatrix::from_fn(|i, j| rows[i].eps.unwrap_generic(Const::<8>, Const::<1>)[j]);
        (rows.map(|row| row.re), jacobian)
    }
}

/// Unit vector of the velocity, body axes.
fn direction<T: Real>(x: &Unknowns<T>) -> Vector3<T> {
    let (alpha, beta) = (x[1], x[2]);
    Vector3::new(alpha.cos() * beta.cos(), beta.sin(), alpha.sin() * beta.cos())
}

/// Direction of gravity, body axes.
fn zeta<T: Real>(x: &Unknowns<T>) -> Vector3<T> {
    let (roll, pitch) = (x[3], x[4]);
    Vector3::new(-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos())
}

/// sin γ.
fn climb<T: Real>(x: &Unknowns<T>) -> T {
    -direction(x).dot(&zeta(x))
}

/// The state whose rates vanish if the helix is steady.
fn steady_state<T: Real>(plant: &Plant<T>, x: &Unknowns<T>, net_mass_kg: f64) -> State<T> {
    State {
        quaternion: quaternion_from_euler(&Vector3::new(x[3], x[4], T::constant(0.0))),
        velocity_m_s: direction(x) * x[0],
        rate_rad_s: zeta(x) * x[7],
        r_px_m: x[5],
        mu_rad: x[6],
        ..State::at_rest(plant.displaced_volume_m3(T::constant(net_mass_kg)))
    }
}

impl std::fmt::Display for Slope {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::PathAngle(angle) => write!(f, "path angle {:.3}°", angle.to_degrees()),
            Self::Pitch(angle) => write!(f, "pitch {:.3}°", angle.to_degrees()),
        }
    }
}

impl std::fmt::Display for Turn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Mu(angle) => write!(f, "mu {:.2}°", angle.to_degrees()),
            Self::Rate(rate) => write!(f, "turn rate {rate:.6} rad/s"),
        }
    }
}
