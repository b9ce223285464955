//! Newton's method with exact Jacobians.

use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Const, SMatrix};
use num_dual::{DualNum, DualSVec, DualSVec64};

use super::{Helix, Scale, Slope, Turn, Unknowns, climb, steady_state};
use crate::model::{plant::Plant, real::Real, vehicle::Vehicle};

const MOST_ITERATIONS: usize = 30;
/// Residual force and moment, N and N m, and angles, rad: rounding of terms of some hundred newtons.
const TOLERANCE: f64 = 1e-9;

/// Longest step of any angle: far from an answer the equations of a circle would throw it around many times.
const LONGEST_STEP_RAD: f64 = 0.5;

type Dual = DualSVec64<8>;

/// Finds steady helices of one vehicle.
#[derive(Clone, Debug)]
pub struct HelixSolver {
    plant: Plant<Dual>,
}

/// What a helix is asked to be.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Asked<T = f64> {
    pub(crate) scale: Scale<T>,
    pub(crate) slope: Slope<T>,
    pub(crate) turn: Turn<T>,
}

/// Why a search found nothing.
#[derive(Clone, Copy, Debug)]
pub(super) enum Miss {
    /// The least residual on the way, N and N m.
    Residual(f64),
    /// What balances flies backwards or abeam.
    NoFlight,
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
    /// One line with the residual that is left and the nearest helix on the way from `near`.
    pub fn solve(&self, near: &Helix, slope: Slope, turn: Turn) -> Result<Helix, String> {
        self.reach(near, Asked { scale: Scale::NetMass(near.net_mass_kg), slope, turn })
    }

    /// As [`HelixSolver::solve`], at a speed or net mass.
    ///
    /// # Errors
    /// As [`HelixSolver::solve`].
    pub fn solve_at(&self, scale: Scale, near: &Helix, slope: Slope, turn: Turn) -> Result<Helix, String> {
        self.reach(near, Asked { scale, slope, turn })
    }

    /// As [`HelixSolver::solve`], for a walk that only asks how far it goes: one search, no reason.
    pub(crate) fn step(&self, near: &Helix, slope: Slope, turn: Turn) -> Option<Helix> {
        self.search(near, &Asked { scale: Scale::NetMass(near.net_mass_kg), slope, turn }).ok()
    }

    /// How all of the helix changes per unit of its turn (per rad of μ, or per rad/s of Ω), slope and net mass held.
    #[must_use]
    pub fn sensitivity(&self, helix: &Helix, slope: Slope, turn: Turn) -> Option<Helix> {
        let scale = Scale::NetMass(helix.net_mass_kg);
        let (_, jacobian) = residual(&self.plant, &helix.unknowns(scale), &Asked { scale, slope, turn });
        // The given value enters its own row, the last, as −value.
        let change = jacobian.lu().solve(&Unknowns::from([0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0]))?;
        Some(Helix::from_unknowns(&change, Scale::NetMass(0.0)))
    }

    /// One search by Newton's method from `near`.
    pub(super) fn search(&self, near: &Helix, asked: &Asked) -> Result<Helix, Miss> {
        let mut x = near.unknowns(asked.scale);
        let mut least = f64::INFINITY;
        for _ in 0..MOST_ITERATIONS {
            let (residual, jacobian) = residual(&self.plant, &x, asked);
            let left = residual.amax();
            if left < TOLERANCE {
                let helix = Helix::from_unknowns(&x, asked.scale);
                return if is_flight(&helix) { Ok(helix) } else { Err(Miss::NoFlight) };
            }
            least = least.min(left);
            let Some(step) = jacobian.lu().solve(&residual) else { break };
            x -= step * (LONGEST_STEP_RAD / largest_turn_rad(&step)).min(1.0);
        }
        Err(Miss::Residual(least))
    }
}

/// Balance of the six equations and of what is given, with its Jacobian.
pub(super) fn residual<T: Real + DualNum>(
    plant: &Plant<DualSVec<T, 8>>,
    x: &Unknowns<T>,
    asked: &Asked<T>,
) -> (Unknowns<T>, SMatrix<T, 8, 8>) {
    let constant = DualSVec::<T, 8>::from_re;
    let x = Unknowns::from_fn(|i, _| constant(x[i]).derivative(i));
    let scale = match asked.scale {
        Scale::Speed(speed_m_s) => Scale::Speed(constant(speed_m_s)),
        Scale::NetMass(net_mass_kg) => Scale::NetMass(constant(net_mass_kg)),
    };
    let balance = plant.body_residual(&steady_state(plant, &x, scale));
    let given_slope = match asked.slope {
        Slope::PathAngle(path_angle_rad) => climb(&x) - constant(Real::sin(path_angle_rad)),
        Slope::Pitch(pitch_rad) => x[4] - constant(pitch_rad),
    };
    let given_turn = match asked.turn {
        Turn::Mu(mu_rad) => x[6] - constant(mu_rad),
        Turn::Rate(rate_rad_s) => x[7] - constant(rate_rad_s),
    };
    let rows = Unknowns::from_fn(|i, _| match i {
        6 => given_slope,
        7 => given_turn,
        _ => balance[i],
    });
    let jacobian = SMatrix::from_fn(|i, j| rows[i].eps.unwrap_generic(Const::<8>, Const::<1>)[j]);
    (rows.map(|row| row.re), jacobian)
}

/// Of α, β, φ, θ and μ.
fn largest_turn_rad(step: &Unknowns<f64>) -> f64 {
    [1, 2, 3, 4, 6].into_iter().map(|angle| step[angle].abs()).fold(0.0, f64::max)
}

/// Forwards, and the mass within a revolution: else the same law balances what no vehicle flies.
fn is_flight(helix: &Helix) -> bool {
    let forwards = helix.alpha_rad.abs().max(helix.beta_rad.abs()) < FRAC_PI_2;
    helix.speed_m_s > 0.0 && forwards && helix.mu_rad.abs() < TAU
}
