//! The steady motions that a table stores, from the full equations.

use shared::model::table::{Axis, Grid, Node};

use crate::analysis::{
    helix::{Helix, HelixSolver, Slope, Turn},
    trim::{Condition, Scale, wings_level},
};
use crate::model::vehicle::Vehicle;

/// Largest rotation from one helix to the next, which Newton's method takes easily.
const EASY_STEP_RAD: f64 = 0.3;
/// Rotation at which the turn rate per rotation at μ = 0 is taken.
const SMALL_MU_RAD: f64 = 1e-3;
/// Two mirrored motions of a symmetric vehicle differ by rounding and the solver's tolerance; angles in rad, lengths in m.
const MIRROR_TOLERANCE: f64 = 1e-6;

/// Dives or climbs of one vehicle.
#[derive(Clone, Copy)]
pub(super) struct Side<'a> {
    pub(super) vehicle: &'a Vehicle,
    pub(super) solver: &'a HelixSolver,
    /// Sign of the net mass: 1 dives, −1 climbs.
    pub(super) sign: f64,
}

/// The motions at one path angle and net mass.
pub(super) struct Column {
    /// γ, rad, climbing positive.
    pub(super) path_angle_rad: f64,
    /// The mass hanging straight down: wings level, if the vehicle is symmetric.
    pub(super) level: Helix,
    /// The mass rotated, in the order that was asked.
    pub(super) turned: Vec<Helix>,
}

/// Value of an axis, some part of a cell beyond a node.
pub(super) fn at(axis: &Axis, node: u8, beyond: f64) -> f64 {
    let here = f64::from(axis.at(node));
    if beyond == 0.0 { here } else { here + beyond * (f64::from(axis.at(node + 1)) - here) }
}

impl Side<'_> {
    /// The motions at √|γ|, ⁴√|m̃| and rising rotations of the mass.
    ///
    /// # Errors
    /// One line that says which motion does not exist.
    pub(super) fn column(&self, root_path: f64, fourth_root_mass: f64, rotations: &[f64]) -> Result<Column, String> {
        let path_angle_rad = -self.sign * root_path * root_path;
        let net_mass_kg = self.sign * fourth_root_mass.powi(4);
        let level = wings_level(self.vehicle, Condition::PathAngle(path_angle_rad), Scale::NetMass(net_mass_kg))?;
        let slope = Slope::PathAngle(path_angle_rad);
        let level = self.solver.solve(&Helix::from(&level), slope, Turn::Mu(0.0))?;
        // Outwards from the level motion, to the right and to the left, each from its neighbour.
        let (right, left) = rotations.split_at(rotations.partition_point(|mu_rad| *mu_rad < 0.0));
        let mut turned = self.follow(&level, slope, right.iter().rev())?;
        turned.reverse();
        turned.extend(self.follow(&level, slope, left.iter())?);
        Ok(Column { path_angle_rad, level, turned })
    }

    fn follow<'m>(
        &self,
        level: &Helix,
        slope: Slope,
        rotations: impl Iterator<Item = &'m f64>,
    ) -> Result<Vec<Helix>, String> {
        let mut helix = *level;
        let mut found = Vec::new();
        for mu_rad in rotations {
            let from = helix.mu_rad;
            let steps = ((mu_rad - from).abs() / EASY_STEP_RAD).ceil().max(1.0);
            for step in 1..=steps as u32 {
                let along = from + (mu_rad - from) * f64::from(step) / steps;
                helix = self.solver.solve(&helix, slope, Turn::Mu(along))?;
            }
            found.push(helix);
        }
        Ok(found)
    }

    /// Nodes in the order of the file.
    pub(super) fn nodes(&self, grid: &Grid) -> Result<Vec<Node>, String> {
        let rotations: Vec<f64> = (0..grid.mu_rad.count).map(|k| at(&grid.mu_rad, k, 0.0)).collect();
        let mut nodes = Vec::with_capacity(grid.nodes());
        for i in 0..grid.root_path_angle.count {
            for j in 0..grid.fourth_root_net_mass.count {
                let place = (at(&grid.root_path_angle, i, 0.0), at(&grid.fourth_root_net_mass, j, 0.0));
                let column = self.column(place.0, place.1, &rotations)?;
                let slightly = self.column(place.0, place.1, &[SMALL_MU_RAD])?;
                // The factor at μ = 0 is a limit.
                let turned = |helix| if at_zero(helix) { slightly.turned.first().unwrap_or(helix) } else { helix };
                nodes.extend(column.turned.iter().map(|helix| node(&column, helix, turned(helix))));
            }
        }
        Ok(nodes)
    }

    /// Whether left and right mirror each other, seen at the corners of the envelope.
    pub(super) fn is_symmetric(&self, grid: &Grid) -> Result<bool, String> {
        let (path, mass, reach) = (&grid.root_path_angle, &grid.fourth_root_net_mass, f64::from(grid.mu_rad.last));
        for root_path in [path.first, path.last] {
            for fourth_root_mass in [mass.first, mass.last] {
                let column = self.column(f64::from(root_path), f64::from(fourth_root_mass), &[-reach, reach])?;
                if !column.turned.first().zip(column.turned.last()).is_some_and(|(one, other)| mirror(one, other)) {
                    return Ok(false);
                }
            }
        }
        Ok(true)
    }
}

fn at_zero(helix: &Helix) -> bool {
    helix.mu_rad.abs() < SMALL_MU_RAD
}

fn mirror(one: &Helix, other: &Helix) -> bool {
    [
        one.r_px_m - other.r_px_m,
        one.pitch_rad - other.pitch_rad,
        one.roll_rad + other.roll_rad,
        one.beta_rad + other.beta_rad,
        one.turn_rate_rad_s + other.turn_rate_rad_s,
    ]
    .iter()
    .all(|difference| difference.abs() < MIRROR_TOLERANCE)
}

/// `turned`: the same motion, or one nearby whose mass is rotated at all.
fn node(column: &Column, helix: &Helix, turned: &Helix) -> Node {
    let root = helix.net_mass_kg.abs().sqrt();
    let made = turned.turn_rate_rad_s - column.level.turn_rate_rad_s;
    Node {
        r_px_m: helix.r_px_m as f32,
        speed_factor: (helix.speed_m_s / root) as f32,
        alpha_rad: helix.alpha_rad as f32,
        incidence_rad: (helix.pitch_rad - column.path_angle_rad) as f32,
        roll_rad: helix.roll_rad as f32,
        turn_factor: (made / (root * libm::sin(turned.mu_rad))) as f32,
        turn_bias: (column.level.turn_rate_rad_s / root) as f32,
    }
}
