//! Stability of the controller's loops around the linearised plant, at every node of the trim table.
//!
//! Three loops, each closed alone while the others hold:
//!
//! | loop | sees | sets | law |
//! |---|---|---|---|
//! | pitch | θ, mean over a period | axial position of the mass | adds a part of what the table's slope says |
//! | heading | ψ, once per period | rotation of the mass | the table's inverse of ψ error over a time |
//! | servo | an actuator's position, every tick | its rate | there within a tick |
//!
//! The plant is the exact linearisation about the node's glide (eight states, and ψ for heading), with the mass's position and
//! rotation as inputs; the mass's own acceleration is left out, and the gains are the flying code's (`laws`). An actuator
//! is where it was sent one tick later, which bounds a move that ends within a tick. Deadbands never add gain. A longer
//! move at a motor's limited rate lags by no more than its own duration, which [`Loop::longest_move_s`] says: below
//! the delay margin it cannot make the loop unstable. Left out: the compass' lag of some tenths of a second, quantisation.

mod laws;
mod picture;
mod sampled;

use std::num::NonZero;

use nalgebra::{DMatrix, DVector, RowDVector};
use serde::Serialize;
use shared::{
    control::pitch::Steady,
    device::{RAD_PER_CDEG, TICK_HZ, TICK_S},
    mission::Mission,
    model::{
        table::{Grid, TrimTable},
        vehicle::FlightVehicle,
    },
    parameters::Parameters,
};

pub use picture::figure;
pub use sampled::{Law, Margins, SampledLoop, held};

use crate::analysis::{
    modes::{Linearised, RollKinematics, linearised},
    trim::{Condition, Glide, Scale, glide},
};
use crate::model::vehicle::Vehicle;
use crate::parallel;
use laws::{Laws, servo_per_s};

/// Places of q, θ, r and the number of states in [`Linearised`].
const Q: usize = 2;
const THETA: usize = 3;
const R: usize = 6;
/// Place of the first lateral state.
const LATERAL: usize = 4;
const STATES: usize = 8;
/// From an order until the actuator is there, ticks.
const ACTUATOR_TICKS: usize = 1;

/// The gain margin that a loop should have: 6 dB, the usual least.
pub const ENOUGH_GAIN: f64 = 2.0;

/// The margins at one node of the trim table.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Node {
    /// Path angle, rad, climbing positive.
    pub path_angle_rad: f64,
    /// Net mass, kg, positive sinks.
    pub net_mass_kg: f64,
    /// Speed of its glide, m/s.
    pub speed_m_s: f64,
    /// The pitch loop.
    pub pitch: Margins,
    /// The heading loop.
    pub heading: Margins,
    /// Whether the mass turns the vehicle; else the loop leaves it alone, and the heading is not held.
    pub has_authority: bool,
}

/// One loop over all nodes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Loop {
    /// Whether it is stable at every node.
    pub stable: bool,
    /// Largest spectral radius.
    pub spectral_radius: f64,
    /// Least gain margin; nothing if a node is not stable, or all bear a hundredfold.
    pub gain_margin: Option<f64>,
    /// Least delay margin, s; nothing if a node is not stable, or all bear 20 periods.
    pub delay_margin_s: Option<f64>,
    /// Nodes that are not stable.
    pub unstable_nodes: usize,
    /// Nodes with a gain margin below [`ENOUGH_GAIN`], those that are not stable among them.
    pub weak_nodes: usize,
    /// Path angle, rad, and net mass, kg, of the node with the least gain margin (or else the largest radius).
    pub worst_at: [f64; 2],
    /// Time that the longest move of its actuator takes, s.
    pub longest_move_s: f64,
}

/// All loops of a vehicle's controller.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Envelope {
    /// The pitch loop.
    pub pitch: Loop,
    /// The heading loop.
    pub heading: Loop,
    /// Any actuator's position loop, the same everywhere.
    pub servo: Margins,
    /// Node by node: dives, then climbs; net mass by net mass, path angle fastest, the flattest first.
    pub nodes: Vec<Node>,
}

/// The margins over the envelope of a trim table.
///
/// # Errors
/// One line: a node without a glide, or without eigenvalues.
pub fn margins(
    vehicle: &Vehicle,
    table: &TrimTable<'_>,
    parameters: &Parameters,
    threads: NonZero<usize>,
) -> Result<Envelope, String> {
    let header = table.header();
    let places: Vec<Steady> = places(&header.dive, 1.0).chain(places(&header.climb, -1.0)).collect();
    let node = |index: usize| at(vehicle, table, parameters, places[index]);
    let nodes = parallel::in_order(places.len(), threads, node, |_| {})?;
    let [axial_s, rotation_s] = longest_moves_s(table.vehicle(), parameters);
    Ok(Envelope {
        pitch: Loop::over(&nodes, |node| node.pitch, axial_s),
        heading: Loop::over(&nodes, |node| node.heading, rotation_s),
        servo: servo().margins()?,
        nodes,
    })
}

/// The nodes of one side; `sign` is that of its net mass.
fn places(grid: &Grid, sign: f32) -> impl Iterator<Item = Steady> {
    let (path_angles, net_masses) = (grid.root_path_angle, grid.fourth_root_net_mass);
    (0..net_masses.count).flat_map(move |j| {
        (0..path_angles.count).map(move |i| {
            let (root, fourth_root) = (path_angles.at(i), net_masses.at(j));
            let squared = fourth_root * fourth_root;
            Steady { path_angle_rad: -sign * root * root, net_mass_kg: sign * squared * squared }
        })
    })
}

/// What a mission flies: its dives and its climbs.
#[must_use]
pub fn glides(mission: &Mission) -> [Steady; 2] {
    let steady = |path_angle_cdeg: i16, net_mass_g: i16| Steady {
        path_angle_rad: f32::from(path_angle_cdeg) * RAD_PER_CDEG,
        net_mass_kg: f32::from(net_mass_g) / 1e3,
    };
    [
        steady(mission.dive_path_angle_cdeg, mission.dive_net_mass_g),
        steady(mission.climb_path_angle_cdeg, mission.climb_net_mass_g),
    ]
}

/// The margins at one glide.
///
/// # Errors
/// One line: there is no such glide, or no eigenvalues.
pub fn at(vehicle: &Vehicle, table: &TrimTable<'_>, parameters: &Parameters, steady: Steady) -> Result<Node, String> {
    let laws = &Laws::new(table, parameters, steady);
    let Steady { path_angle_rad, net_mass_kg } = laws.steady;
    let (path_angle_rad, net_mass_kg) = (f64::from(path_angle_rad), f64::from(net_mass_kg));
    let glide = glide(vehicle, Condition::PathAngle(path_angle_rad), Scale::NetMass(net_mass_kg))?;
    let linear = linearised(vehicle, &glide, RollKinematics::Exact);
    Ok(Node {
        path_angle_rad,
        net_mass_kg,
        speed_m_s: glide.speed_m_s,
        pitch: pitch(&linear, laws).margins()?,
        heading: heading(&linear, &glide, laws).margins()?,
        has_authority: laws.mu_per_heading() != 0.0,
    })
}

fn pitch(linear: &Linearised, laws: &Laws<'_>) -> SampledLoop {
    let a = DMatrix::from_fn(STATES, STATES, |i, j| linear.states[(i, j)]);
    let b = DVector::from_fn(STATES, |i, _| linear.inputs[(i, 0)]);
    let gain = laws.pitch_m_per_rad();
    sampled((&a, &b), THETA, Law::IntegratedMean, gain, laws.parameters.pitch_period_s)
}

/// ψ̇ = (q sin φ + r cos φ)/cos θ stands below the other states.
///
/// Of a symmetric vehicle only the lateral half: a pitch that runs away is not seen in the heading, and is told by its own loop.
fn heading(linear: &Linearised, glide: &Glide, laws: &Laws<'_>) -> SampledLoop {
    let first = if laws.table.header().symmetric { LATERAL } else { 0 };
    let psi = STATES - first;
    let mut a = DMatrix::zeros(psi + 1, psi + 1);
    a.view_mut((0, 0), (psi, psi)).copy_from(&linear.states.view((first, first), (psi, psi)));
    let (sin_phi, cos_phi) = libm::sincos(glide.phi_rad);
    if first <= Q {
        a[(psi, Q - first)] = sin_phi / libm::cos(glide.pitch_rad);
    }
    a[(psi, R - first)] = cos_phi / libm::cos(glide.pitch_rad);
    let led = laws.r_px_m_per_mu(glide.mu_rad);
    let by_mu = linear.inputs.column(1) + linear.inputs.column(0) * led;
    let b = DVector::from_fn(psi + 1, |i, _| if i < psi { by_mu[first + i] } else { 0.0 });
    sampled((&a, &b), psi, Law::ProportionalMean, laws.mu_per_heading(), laws.parameters.heading_period_s)
}

/// The loop over one state of a plant ẋ = A x + b u; the period in s.
fn sampled((a, b): (&DMatrix<f64>, &DVector<f64>), seen: usize, law: Law, gain: f64, period_s: i32) -> SampledLoop {
    let (step, drive) = held(a, b, TICK_S.into());
    let seen = RowDVector::from_fn(a.nrows(), |_, j| if j == seen { 1.0 } else { 0.0 });
    let period_ticks = (period_s.unsigned_abs().saturating_mul(TICK_HZ) as usize).max(1);
    SampledLoop { step, drive, seen, law, gain, period_ticks, delay_ticks: ACTUATOR_TICKS, tick_s: TICK_S.into() }
}

/// An actuator that runs at its ordered rate for a tick, seen before the next.
fn servo() -> SampledLoop {
    let (step, drive) = held(&DMatrix::zeros(1, 1), &DVector::from_element(1, 1.0), TICK_S.into());
    let seen = RowDVector::from_element(1, 1.0);
    let (law, gain) = (Law::Proportional, servo_per_s());
    SampledLoop { step, drive, seen, law, gain, period_ticks: 1, delay_ticks: 0, tick_s: TICK_S.into() }
}

/// From one end of its corrections to the other: the axial position, the rotation, s.
fn longest_moves_s(vehicle: &FlightVehicle, parameters: &Parameters) -> [f64; 2] {
    let way_s = |limit: i32, rate: i32| 2.0 * f64::from(limit) / f64::from(rate.max(1));
    let actuators = &vehicle.actuators;
    [
        way_s(parameters.pitch_trim_limit_um, actuators.r_px_rate_um_s),
        way_s(parameters.mu_limit_cdeg, actuators.mu_rate_cdeg_s),
    ]
}

impl Loop {
    fn over(nodes: &[Node], of: fn(&Node) -> Margins, longest_move_s: f64) -> Self {
        let all = || nodes.iter().map(of);
        let stable = all().all(|margins| margins.is_stable());
        let least = |value: fn(&Margins) -> Option<f64>| {
            if stable { all().filter_map(|margins| value(&margins)).reduce(f64::min) } else { None }
        };
        let spectral_radius = all().map(|margins| margins.spectral_radius).fold(0.0, f64::max);
        let gain_margin = least(|margins| margins.gain_margin);
        let worst = nodes.iter().find(|node| match gain_margin {
            Some(_) => of(node).gain_margin == gain_margin,
            None => of(node).spectral_radius >= spectral_radius,
        });
        let is_weak =
            |margins: &Margins| !margins.is_stable() || margins.gain_margin.is_some_and(|factor| factor < ENOUGH_GAIN);
        Self {
            stable,
            spectral_radius,
            gain_margin,
            delay_margin_s: least(|margins| margins.delay_margin_s),
            unstable_nodes: all().filter(|margins| !margins.is_stable()).count(),
            weak_nodes: all().filter(is_weak).count(),
            worst_at: worst.map_or([0.0; 2], |node| [node.path_angle_rad, node.net_mass_kg]),
            longest_move_s,
        }
    }
}
