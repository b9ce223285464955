//! The best geometry within bounds: `glider design`.
//!
//! Given are the mass of water that the hull displaces, what drives the glider (lung capacity, net mass or speed), depth and
//! battery; everything is judged at the flattest glide, at the speed that the drive then gives, with the paper's closed forms
//! ([`crate::analysis::performance`]) and the full equations for modes and turns. The body weighs what makes the hull neutral, its inertia
//! and the moving mass keep their places in proportion; engine, battery and loads stay the vehicle's.
//!
//! # The paper's conclusions (section 6), and where they do not hold
//! With coefficients from geometry, 52 kg and one lung, as long as no flow changes its state (`tests/design.rs`):
//! the fastest glider has the longest hull (so the highest fineness), the smallest span and the highest aspect ratio; the highest
//! lift to drag is had with the shortest hull and the largest span. They do not hold
//! * anchored on slocum-paper: the identified K is five times the estimate, so a high aspect ratio costs lift to drag;
//! * where a boundary layer turns turbulent: the drag jumps, and the best geometry stays just short of it;
//! * for the range at a given *speed*: a dive then pays for drag alone, ρV²S C_D0 at the flattest glide, so the smallest wing
//!   goes farthest, although its lift to drag is the worst.
//!
//! Anchored, a geometry counts as possible while no damping, drag or lift slope has lost half of its identified value.

mod candidate;
mod constraint;
mod front;
mod search;
mod spec;
mod vehicle_file;

use serde::Serialize;

pub use candidate::Candidate;
pub use constraint::{Active, Constraint};
pub use front::{Front, FrontPoint};
pub use spec::{Drive, Limits, Objective, Spec};
pub use vehicle_file::vehicle_toml;

use crate::model::{coefficients::Parameter, vehicle::Vehicle};
use candidate::Maker;
use constraint::constraints;
use search::{Found, MET, Search};

/// Distance from a bound, as a share of them, or from a constraint over its scale, within which it counts as reached.
const REACHED: f64 = 2e-3;

/// The best geometry.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Design {
    /// What it is judged by.
    #[serde(flatten)]
    pub best: Candidate,
    /// Parameters that were varied, and where they came to lie.
    pub parameters: Vec<Placed>,
    /// Constraints that hold it back.
    pub active: Vec<Active>,
    /// The same figures of the geometry that the vehicle has, where it is possible.
    pub start: Option<Candidate>,
    /// Range against turn rate, if it was asked for.
    pub front: Option<Front>,
}

/// A parameter within its bounds.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Placed {
    /// Its key.
    pub parameter: &'static str,
    /// Its value.
    pub value: f64,
    /// Its bounds.
    pub bounds: [f64; 2],
    /// The bound that holds it back: "least" or "most".
    pub reached: Option<&'static str>,
}

/// The best vehicle of a specification.
///
/// # Errors
/// One line: no vehicle within the bounds glides, or which constraint cannot be met and what is nearest.
pub fn design(spec: &Spec, vehicle: &Vehicle) -> Result<Design, String> {
    let maker = Maker::new(spec, vehicle);
    let constraints = constraints(spec);
    let search = Search { maker: &maker, objective: Some(spec.objective), constraints: &constraints };
    let found = search.run(&[]).ok_or_else(|| no_vehicle(&maker))?;
    if found.shortfall > MET {
        return Err(infeasible(&maker, &constraints, &found));
    }
    let front = (spec.front_points > 0).then(|| front::front(&maker, &constraints, &found)).flatten();
    Ok(Design {
        parameters: placed(spec, &found.candidate),
        active: constraints.iter().filter_map(|constraint| constraint.active(&found.candidate, REACHED)).collect(),
        start: maker.at(&maker.nominal()).ok(),
        best: found.candidate,
        front,
    })
}

fn placed(spec: &Spec, candidate: &Candidate) -> Vec<Placed> {
    let place = |(parameter, bounds): &(Parameter, [f64; 2])| {
        let (value, [least, most]) = (candidate.parameter(*parameter), *bounds);
        let share = (value - least) / (most - least);
        let reached = match share {
            share if share < REACHED => Some("least"),
            share if share > 1.0 - REACHED => Some("most"),
            _ => None,
        };
        Placed { parameter: parameter.key(), value, bounds: *bounds, reached }
    };
    spec.bounds.iter().map(place).collect()
}

fn no_vehicle(maker: &Maker<'_>) -> String {
    let reason = maker.at(&vec![0.5; maker.free.len()]).err().unwrap_or_default();
    format!("no geometry within the bounds makes a glider; in their middle: {reason}")
}

/// Which constraints cannot be met, each by itself and all together.
fn infeasible(maker: &Maker<'_>, constraints: &[Constraint], nearest: &Found) -> String {
    let unmet = constraints.iter().filter(|constraint| constraint.slack(&nearest.candidate) < -MET);
    let told = unmet.map(|constraint| {
        let alone = [constraint.clone()];
        let found = Search { maker, objective: None, constraints: &alone }.run(&[]);
        match found.filter(|found| found.shortfall > MET) {
            Some(found) => format!("{constraint} cannot be met, at best {}", constraint.value_of(&found.candidate)),
            None => format!(
                "{constraint} cannot be met together with the others, at best {}",
                constraint.value_of(&nearest.candidate)
            ),
        }
    });
    let told: Vec<String> = told.collect();
    let place = placed(maker.spec, &nearest.candidate);
    let place: Vec<String> = place.iter().map(|placed| format!("{} = {:.4}", placed.parameter, placed.value)).collect();
    format!("no geometry within the bounds: {}; nearest: {}", told.join("; "), place.join(", "))
}
