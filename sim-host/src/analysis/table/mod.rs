//! Generates the trim table that flies, from the plant, and measures how well it interpolates.

mod constants;
mod error;
mod gain;
mod helices;
mod lag;

pub use constants::flight_vehicle;
pub use error::{BOUND, InterpolationError, TableErrors};

use shared::model::table::{Axis, Grid, Header, QUANTITIES, TableError, TrimTable, write};

use crate::analysis::helix::HelixSolver;
use crate::model::vehicle::Vehicle;
use error::worst_at;
use helices::Side;

/// The largest table that fits beside a program of some 100 KiB.
const MOST_BYTES: usize = 16 * 1024;
/// Cells along path angle, net mass and μ (of one sign) to start from.
const FEW_CELLS: [u8; 3] = [7, 2, 2];
/// Share of the bound that may be used up where the error is probed; it can be larger a little beside.
const SHARE_OF_BOUND: f64 = 0.9;

/// What the table shall cover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// Flattest and steepest dive, deg, positive numbers.
    pub dive_deg: [f64; 2],
    /// Flattest and steepest climb, deg.
    pub climb_deg: [f64; 2],
    /// Least and most net mass, kg, positive numbers for both sides.
    pub net_mass_kg: [f64; 2],
    /// Largest rotation of the mass, deg.
    pub mu_deg: f64,
}

impl Default for Envelope {
    /// Where slocum-paper flies: short of the control reversal of its dives at −39.3°.
    fn default() -> Self {
        Self { dive_deg: [12.0, 35.0], climb_deg: [12.0, 40.0], net_mass_kg: [0.05, 0.6], mu_deg: 60.0 }
    }
}

/// The bytes of the vehicle's trim table, with as many nodes as it takes to interpolate within [`BOUND`].
///
/// # Errors
/// One line: what the vehicle file lacks to fly, which motion of the envelope does not exist, or that no table of a
/// size that flies is fine enough.
pub fn generate(vehicle: &Vehicle, envelope: &Envelope) -> Result<Vec<u8>, String> {
    envelope.check()?;
    let flight_vehicle = flight_vehicle(vehicle, envelope)?;
    let solver = HelixSolver::new(vehicle);
    let sides = [1.0, -1.0].map(|sign| Side { vehicle, solver: &solver, sign });
    let [dive, climb] = envelope.grids(&[FEW_CELLS; 2], true);
    let symmetric = sides[0].is_symmetric(&dive)? && sides[1].is_symmetric(&climb)?;
    let mut cells = [FEW_CELLS; 2];
    let mut file = vec![0; MOST_BYTES];
    loop {
        let [dive, climb] = envelope.grids(&cells, symmetric);
        let header = Header::new(flight_vehicle.clone(), symmetric, dive, climb);
        let nodes = [sides[0].nodes(&dive)?, sides[1].nodes(&climb)?];
        let Ok(written) = write(&header, &nodes[0], &nodes[1], &mut file) else {
            return Err(format!(
                "{}: {MOST_BYTES} bytes do not make a fine enough table; narrow the envelope",
                vehicle.name
            ));
        };
        let table = TrimTable::parse(written).map_err(|error| describe(&error))?;
        let coarsest = [coarsest_axis(&sides[0], &table, &dive)?, coarsest_axis(&sides[1], &table, &climb)?];
        if coarsest == [None, None] {
            return Ok(written.to_vec());
        }
        for (cells, coarsest) in cells.iter_mut().zip(coarsest) {
            if let Some(axis) = coarsest {
                cells[axis] += 1;
            }
        }
    }
}

/// Why a table may not be flown, in one line.
#[must_use]
pub fn describe(error: &TableError) -> String {
    match error {
        TableError::Corrupt => "the table is damaged: its CRC does not fit".into(),
        TableError::NotATable => "not a trim table".into(),
        TableError::OtherVersion(version) => {
            format!("a trim table of version {version}; this program reads version {}", shared::model::table::VERSION)
        }
        TableError::Malformed => "the table's axes and nodes do not fit together".into(),
        TableError::OtherVehicle(hash) => format!("the table is for another vehicle, {hash:016x}; generate it anew"),
        TableError::NoRoom => format!("the table is larger than {MOST_BYTES} bytes"),
    }
}

/// Measures a table against exact trim, in the middle of all its cells.
///
/// # Errors
/// One line if some motion does not exist.
pub fn measure(vehicle: &Vehicle, table: &TrimTable<'_>) -> Result<TableErrors, String> {
    let solver = HelixSolver::new(vehicle);
    let worst = |sign: f64, grid: &Grid| worst_at(&Side { vehicle, solver: &solver, sign }, table, grid, [0.5; 3]);
    let header = table.header();
    Ok(TableErrors { dive: worst(1.0, &header.dive)?, climb: worst(-1.0, &header.climb)? })
}

/// The axis along which interpolation errs most, or nothing if the table is within the bound everywhere.
///
/// The error along an axis vanishes on its nodes and is largest between them; where the errors of several axes have one sign
/// they add up. So the worst place is near the middle of cells along some of the axes, on the nodes of the others.
fn coarsest_axis(side: &Side<'_>, table: &TrimTable<'_>, grid: &Grid) -> Result<Option<usize>, String> {
    const ON_SEVERAL_AXES: [[f64; 3]; 4] = [[0.5, 0.5, 0.5], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];
    let gearing = gearing_m_per_rad(side, table, grid);
    let share = |place| worst_at(side, table, grid, place).map(|error| error.share_of_bound(gearing));
    let [path_angle, net_mass, mu] = [share([0.5, 0.0, 0.0])?, share([0.0, 0.5, 0.0])?, share([0.0, 0.0, 0.5])?];
    let mut worst = path_angle.max(net_mass).max(mu);
    for place in ON_SEVERAL_AXES {
        if worst > SHARE_OF_BOUND {
            break;
        }
        worst = worst.max(share(place)?);
    }
    let coarsest = if path_angle >= net_mass.max(mu) { 0 } else { 1 + usize::from(mu > net_mass) };
    Ok((worst > SHARE_OF_BOUND).then_some(coarsest))
}

/// How far the mass travels per change of pitch, from the flattest glide to the steepest, m/rad.
fn gearing_m_per_rad(side: &Side<'_>, table: &TrimTable<'_>, grid: &Grid) -> f64 {
    let Axis { first, last, .. } = grid.root_path_angle;
    let net_mass_kg = grid.fourth_root_net_mass.last.powi(4);
    let [flat, steep] = [first, last].map(|root| table.look_up(-(side.sign as f32) * root * root, net_mass_kg, 0.0));
    f64::from((steep.r_px_m - flat.r_px_m) / (steep.pitch_rad - flat.pitch_rad)).abs()
}

impl Envelope {
    fn check(&self) -> Result<(), String> {
        let pairs =
            [("dive", self.dive_deg, 90.0), ("climb", self.climb_deg, 90.0), ("net mass", self.net_mass_kg, f64::MAX)];
        for (name, [least, most], limit) in pairs {
            if !(least > 0.0 && most > least && most < limit) {
                return Err(format!("envelope: {name} {least} to {most} must be positive and rising"));
            }
        }
        if !(self.mu_deg > 0.0 && self.mu_deg <= 90.0) {
            return Err(format!("envelope: mu {}° must lie between 0 and 90°", self.mu_deg));
        }
        Ok(())
    }

    /// Dives and climbs, with some cells along each axis; without symmetry twice as many along μ.
    fn grids(&self, cells: &[[u8; 3]; 2], symmetric: bool) -> [Grid; 2] {
        let axis =
            |[first, last]: [f64; 2], cells: u8| Axis { first: first as f32, last: last as f32, count: cells + 1 };
        let reach = self.mu_deg.to_radians();
        let grid = |path_angle_deg: [f64; 2], [path_angle, net_mass, mu]: [u8; 3]| Grid {
            root_path_angle: axis(path_angle_deg.map(|deg| deg.to_radians().sqrt()), path_angle),
            fourth_root_net_mass: axis(self.net_mass_kg.map(|kg| kg.sqrt().sqrt()), net_mass),
            mu_rad: if symmetric { axis([0.0, reach], mu) } else { axis([-reach, reach], 2 * mu) },
            full_scale: [0.0; QUANTITIES],
        };
        [grid(self.dive_deg, cells[0]), grid(self.climb_deg, cells[1])]
    }
}
