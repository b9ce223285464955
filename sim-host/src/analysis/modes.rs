//! Small motions about a straight glide: exact linearisation and its eigenvalues (section 9 of the equations).
//!
//! The moving mass is locked. `longitudinal` has the states (u, w, q, θ), `lateral` (v, p, r, φ), SI. They are the two blocks on
//! the diagonal of one 8×8 matrix. For a vehicle that is not symmetric the other two blocks do not vanish: leaving them out is
//! then an approximation, whose size is told, beside the eigenvalues of the whole.

use nalgebra::{Complex, Const, Matrix4, SMatrix, Vector3, Vector4};
use num_dual::{DualNum, DualSVec, DualSVec64};
use serde::Serialize;

use crate::analysis::{helix::Helix, trim::Glide};
use crate::model::{
    plant::{Plant, State, quaternion_from_euler},
    real::Real,
    vehicle::Vehicle,
};

/// Length that makes the eigenvectors' rates dimensionless in the paper's tables, with the nominal speed, m.
const TABLE_LENGTH_M: f64 = 1.8;
/// Parts of an eigenvalue below this share of the largest are rounding.
const ROUNDING: f64 = 1e-9;

/// The kinematics of roll.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub enum RollKinematics {
    /// φ̇ = p + r tanθ.
    Exact,
    /// φ̇ = p, as the paper's Table 2 was computed.
    Paper,
}

/// Both sets of modes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Modes {
    /// Motion in the plane of symmetry.
    pub longitudinal: ModeSet,
    /// Motion out of it.
    pub lateral: ModeSet,
    /// Largest entry that couples the two sets, over the largest of all: 0 for a symmetric vehicle.
    pub coupling: f64,
    /// Eigenvalues of all eight states together, ordered as those of the sets; none if the sets are not coupled.
    pub coupled_eigenvalues: Option<[[f64; 2]; 8]>,
    /// Those of the glide, and the coupling.
    pub warnings: Vec<String>,
}

/// Linear dynamics of four states.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ModeSet {
    /// Names of the states.
    pub states: [&'static str; 4],
    /// ẋ = A x, rows.
    pub matrix: [[f64; 4]; 4],
    /// [re, im], 1/s, by increasing real part, the positive imaginary part of a pair first.
    pub eigenvalues: [[f64; 2]; 4],
    /// One per eigenvalue, speeds over V0, rates times 1.8 m/V0, the largest entry 1.
    pub eigenvectors: [[[f64; 2]; 4]; 4],
    /// What each mode is, by its largest entries.
    pub names: [&'static str; 4],
    /// −Re λ/|λ|: 1 decays without oscillation, below 0 it grows; none for λ = 0.
    pub damping_ratio: [Option<f64>; 4],
    /// 2π/|Im λ|, s; none without oscillation.
    pub period_s: [Option<f64>; 4],
    /// ln 2/−Re λ, s: time to half the amplitude, negative for the time to double it; none where it stays.
    pub time_to_half_s: [Option<f64>; 4],
    /// One row per eigenvalue: share of each state in the mode, |left × right eigenvector|, summing to 1; none where modes
    /// coincide.
    pub participation: Option<[[f64; 4]; 4]>,
}

/// The modes of a glide.
///
/// # Errors
/// One line if numbers overflow: a speed that no vehicle has.
pub fn modes(vehicle: &Vehicle, glide: &Glide, roll: RollKinematics) -> Result<Modes, String> {
    let jacobian = jacobian(&Plant::<DualSVec64<8>>::new(vehicle), &Helix::from(glide), roll);
    if jacobian.iter().any(|entry| !entry.is_finite()) {
        return Err(format!("{}: no finite linearisation at {:e} m/s", vehicle.name, glide.speed_m_s));
    }
    let [longitudinal, lateral] = [0, 4].map(|first| jacobian.fixed_view::<4, 4>(first, first).into_owned());
    let coupled = jacobian.fixed_view::<4, 4>(0, 4).amax().max(jacobian.fixed_view::<4, 4>(4, 0).amax());
    let coupling = coupled / jacobian.amax();
    let coupled_eigenvalues = (coupling > ROUNDING).then(|| ordered(jacobian.complex_eigenvalues().into()).map(pair));
    let mut warnings = glide.warnings.clone();
    if coupled_eigenvalues.is_some() {
        warnings.push(format!(
            "longitudinal and lateral motion are coupled, by {coupling:.2e} of the largest entry: the modes leave it out, \
             `coupled_eigenvalues` has it"
        ));
    }
    let (v0, length) = (vehicle.nominal_speed_m_s, TABLE_LENGTH_M);
    let rate = length / v0;
    Ok(Modes {
        longitudinal: mode_set(
            ["u", "w", "q", "theta"],
            &longitudinal,
            [1.0 / v0, 1.0 / v0, rate, 1.0],
            longitudinal_name,
        ),
        lateral: mode_set(["v", "p", "r", "phi"], &lateral, [1.0 / v0, rate, rate, 1.0], lateral_name),
        coupling,
        coupled_eigenvalues,
        warnings,
    })
}

/// Small motions of (u, w, q, θ, v, p, r, φ), SI.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linearised {
    /// Rates of the states by the states.
    pub states: SMatrix<f64, 8, 8>,
    /// Rates of the states by the moving mass's axial position, m, and rotation, rad.
    pub inputs: SMatrix<f64, 8, 2>,
}

/// The derivatives of the full equations at a glide, exact.
#[must_use]
pub fn linearised(vehicle: &Vehicle, glide: &Glide, roll: RollKinematics) -> Linearised {
    let (trim, plant) = (Helix::from(glide), Plant::<DualSVec64<2>>::new(vehicle));
    let along = |value: f64, place: usize| DualSVec64::from_re(value).derivative(place);
    let states = resting_states(&trim).map(DualSVec64::from_re);
    let place = [along(trim.r_px_m, 0), along(trim.mu_rad, 1)];
    let rows = rates(&plant, &states, place, DualSVec64::from_re(trim.net_mass_kg), roll);
    let inputs = SMatrix::from_fn(|i, j| rows[i].eps.unwrap_generic(Const::<2>, Const::<1>)[j]);
    Linearised { states: jacobian(&Plant::<DualSVec64<8>>::new(vehicle), &trim, roll), inputs }
}

/// Derivative of (u̇, ẇ, q̇, θ̇, v̇, ṗ, ṙ, φ̇) by (u, w, q, θ, v, p, r, φ).
pub(crate) fn jacobian<T: Real + DualNum>(
    plant: &Plant<DualSVec<T, 8>>,
    trim: &Helix<T>,
    roll: RollKinematics,
) -> SMatrix<T, 8, 8> {
    let constant = DualSVec::<T, 8>::from_re;
    let at = resting_states(trim);
    let states = std::array::from_fn(|place| constant(at[place]).derivative(place));
    let rows = rates(plant, &states, [trim.r_px_m, trim.mu_rad].map(constant), constant(trim.net_mass_kg), roll);
    SMatrix::from_fn(|i, j| rows[i].eps.unwrap_generic(Const::<8>, Const::<1>)[j])
}

/// (u, w, q, θ, v, p, r, φ) of a straight glide.
fn resting_states<T: Real>(trim: &Helix<T>) -> [T; 8] {
    let (velocity, none) = (trim.velocity_m_s(), T::constant(0.0));
    [velocity.x, velocity.z, none, trim.pitch_rad, velocity.y, none, none, trim.roll_rad]
}

/// (u̇, ẇ, q̇, θ̇, v̇, ṗ, ṙ, φ̇) with the moving mass locked at its axial position and rotation.
fn rates<T: Real>(
    plant: &Plant<T>,
    [u, w, q, theta, v, p, r, phi]: &[T; 8],
    [r_px_m, mu_rad]: [T; 2],
    net_mass_kg: T,
    roll: RollKinematics,
) -> [T; 8] {
    let zero = T::constant(0.0);
    let state = State {
        quaternion: quaternion_from_euler(&Vector3::new(*phi, *theta, zero)),
        velocity_m_s: Vector3::new(*u, *v, *w),
        rate_rad_s: Vector3::new(*p, *q, *r),
        r_px_m,
        mu_rad,
        ..State::at_rest(plant.displaced_volume_m3(net_mass_kg))
    };
    let rates = plant.derivative_driven(&state, zero, &plant.still());
    let (sin_phi, cos_phi) = (phi.sin(), phi.cos());
    let across = *q * sin_phi + *r * cos_phi;
    let roll_rate = match roll {
        RollKinematics::Exact => *p + across * theta.sin() / theta.cos(),
        RollKinematics::Paper => *p,
    };
    let (dv, dw) = (rates.velocity_m_s, rates.rate_rad_s);
    [dv.x, dv.z, dw.y, *q * cos_phi - *r * sin_phi, dv.y, dw.x, dw.z, roll_rate]
}

fn mode_set(
    states: [&'static str; 4],
    matrix: &Matrix4<f64>,
    scales: [f64; 4],
    name: fn(&[f64; 4], bool) -> &'static str,
) -> ModeSet {
    let eigenvalues = ordered(matrix.complex_eigenvalues().into());
    let size = largest(&eigenvalues);
    let eigenvectors = eigenvalues.map(|value| eigenvector(matrix, value, scales));
    let names = std::array::from_fn(|i| {
        let sizes: [f64; 4] = eigenvectors[i].map(|entry| entry.norm());
        name(&sizes, eigenvalues[i].im.abs() > ROUNDING * size)
    });
    ModeSet {
        states,
        matrix: matrix.transpose().into(),
        eigenvalues: eigenvalues.map(pair),
        eigenvectors: eigenvectors.map(|vector| vector.map(pair)),
        names,
        damping_ratio: eigenvalues.map(|value| finite(-value.re / value.norm())),
        period_s: eigenvalues.map(|value| {
            let oscillates = value.im.abs() > ROUNDING * size;
            oscillates.then(|| std::f64::consts::TAU / value.im.abs())
        }),
        time_to_half_s: eigenvalues.map(|value| finite(std::f64::consts::LN_2 / -value.re)),
        participation: participation(&eigenvectors),
    }
}

/// By increasing real part, the positive imaginary part of a pair first.
fn ordered<const N: usize>(mut eigenvalues: [Complex<f64>; N]) -> [Complex<f64>; N] {
    let size = largest(&eigenvalues);
    // A pair has one real part, whatever rounding says.
    eigenvalues.sort_by(|a, b| {
        let nearly_equal = (a.re - b.re).abs() < ROUNDING * size;
        if nearly_equal { b.im.total_cmp(&a.im) } else { a.re.total_cmp(&b.re) }
    });
    eigenvalues
}

fn largest(eigenvalues: &[Complex<f64>]) -> f64 {
    eigenvalues.iter().map(|value| value.norm()).fold(0.0, f64::max)
}

fn pair(value: Complex<f64>) -> [f64; 2] {
    [value.re, value.im]
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

/// Share of each state in each mode. The scales of the states cancel.
fn participation(eigenvectors: &[[Complex<f64>; 4]; 4]) -> Option<[[f64; 4]; 4]> {
    let right = Matrix4::from_fn(|state, mode| eigenvectors[mode][state]);
    let left = right.try_inverse()?;
    Some(std::array::from_fn(|mode| {
        let sizes: [f64; 4] = std::array::from_fn(|state| (left[(mode, state)] * right[(state, mode)]).norm());
        let sum: f64 = sizes.iter().sum();
        sizes.map(|size| size / sum)
    }))
}

/// The direction of length 1 that A − λ takes to zero: its last right singular vector.
pub(crate) fn null_vector(matrix: &Matrix4<f64>, value: Complex<f64>) -> Vector4<Complex<f64>> {
    let shifted = matrix.map(|entry| Complex::new(entry, 0.0)) - Matrix4::from_diagonal_element(value);
    let svd = shifted.svd(false, true);
    svd.v_t.map_or_else(Vector4::zeros, |v_t| v_t.row(svd.singular_values.imin()).adjoint())
}

/// An eigenvector, scaled, the largest entry 1.
fn eigenvector(matrix: &Matrix4<f64>, value: Complex<f64>, scales: [f64; 4]) -> [Complex<f64>; 4] {
    let null = null_vector(matrix, value);
    let scaled: [Complex<f64>; 4] = std::array::from_fn(|i| null[i] * scales[i]);
    let largest = scaled.iter().copied().fold(Complex::new(0.0, 0.0), |a, b| if b.norm() > a.norm() { b } else { a });
    scaled.map(|entry| entry / largest)
}

/// The largest entry tells; `sizes` of u, w, q, θ.
fn longitudinal_name([u, w, q, theta]: &[f64; 4], oscillates: bool) -> &'static str {
    let incidence_or_pitch = w.max(*q).max(*theta);
    match (u > &incidence_or_pitch, oscillates) {
        (true, true) => "phugoid",
        (true, false) => "speed",
        (false, true) => "pitch oscillation",
        (false, false) if q >= w && q >= theta => "pitch rate",
        (false, false) => "pitch and angle of attack",
    }
}

/// The largest entry tells; `sizes` of v, p, r, φ.
fn lateral_name([v, p, r, phi]: &[f64; 4], oscillates: bool) -> &'static str {
    let rates = p.max(*r);
    match (oscillates, rates > v.max(*phi)) {
        (true, _) => "roll-yaw oscillation",
        (false, true) => "roll and yaw rate",
        (false, false) => "roll angle and side velocity",
    }
}
