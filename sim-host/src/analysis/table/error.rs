//! How well a table interpolates, against exact motions.

use shared::model::table::{Glide, Grid, TrimTable};

use super::helices::{Side, at};
use crate::analysis::helix::Helix;

/// What a table's interpolation may be off by, anywhere in its envelope.
pub const BOUND: Bound = Bound { speed: 0.005, turn_rate: 0.02, angle_rad: 0.2 / 180.0 * std::f64::consts::PI };

/// See [`BOUND`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bound {
    /// Of the speed, relative.
    pub speed: f64,
    /// Of the turn rate, relative.
    pub turn_rate: f64,
    /// Of pitch and angle of attack, and of the pitch that an error of the axial position makes, rad.
    pub angle_rad: f64,
}

/// Largest errors of the table against exact trim.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct InterpolationError {
    /// Of the speed, relative.
    pub speed: f64,
    /// Of the turn rate, relative to it, or to the part of it that the rotation of the mass makes if that is larger.
    pub turn_rate: f64,
    /// Of the pitch, rad.
    pub pitch_rad: f64,
    /// Of the angle of attack, rad.
    pub alpha_rad: f64,
    /// Of the axial position, m.
    pub r_px_m: f64,
}

/// Both sides of [`InterpolationError`].
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct TableErrors {
    /// On dives.
    pub dive: InterpolationError,
    /// On climbs.
    pub climb: InterpolationError,
}

impl InterpolationError {
    /// Of what a table says against the helix that it stands for; `level` is the one with the mass hanging straight down.
    #[must_use]
    pub fn of(found: &Glide, exact: &Helix, level: &Helix) -> Self {
        let made = (exact.turn_rate_rad_s - level.turn_rate_rad_s).abs();
        Self {
            speed: (f64::from(found.speed_m_s) / exact.speed_m_s - 1.0).abs(),
            turn_rate: (f64::from(found.turn_rate_rad_s) - exact.turn_rate_rad_s).abs()
                / exact.turn_rate_rad_s.abs().max(made),
            pitch_rad: (f64::from(found.pitch_rad) - exact.pitch_rad).abs(),
            alpha_rad: (f64::from(found.alpha_rad) - exact.alpha_rad).abs(),
            r_px_m: (f64::from(found.r_px_m) - exact.r_px_m).abs(),
        }
    }

    /// The larger one of each.
    #[must_use]
    pub fn max(&self, other: &Self) -> Self {
        Self {
            speed: self.speed.max(other.speed),
            turn_rate: self.turn_rate.max(other.turn_rate),
            pitch_rad: self.pitch_rad.max(other.pitch_rad),
            alpha_rad: self.alpha_rad.max(other.alpha_rad),
            r_px_m: self.r_px_m.max(other.r_px_m),
        }
    }

    /// The largest share of [`BOUND`] that is used up, if the mass travels `gearing_m_per_rad` per change of pitch.
    #[must_use]
    pub fn share_of_bound(&self, gearing_m_per_rad: f64) -> f64 {
        [
            self.speed / BOUND.speed,
            self.turn_rate / BOUND.turn_rate,
            self.pitch_rad / BOUND.angle_rad,
            self.alpha_rad / BOUND.angle_rad,
            self.r_px_m / gearing_m_per_rad / BOUND.angle_rad,
        ]
        .into_iter()
        .fold(0.0, f64::max)
    }
}

/// The largest errors over all cells, at a place in each: parts of the cell from its first node along every axis.
pub(super) fn worst_at(
    side: &Side<'_>,
    table: &TrimTable<'_>,
    grid: &Grid,
    [x, y, z]: [f64; 3],
) -> Result<InterpolationError, String> {
    let cells = |count: u8| 0..count - 1;
    let rotations: Vec<f64> = cells(grid.mu_rad.count).map(|k| at(&grid.mu_rad, k, z)).collect();
    let mut worst = InterpolationError::default();
    for i in cells(grid.root_path_angle.count) {
        for j in cells(grid.fourth_root_net_mass.count) {
            let column =
                side.column(at(&grid.root_path_angle, i, x), at(&grid.fourth_root_net_mass, j, y), &rotations)?;
            for exact in column.turned.iter().filter(|exact| exact.mu_rad != 0.0) {
                let found = table.look_up(column.path_angle_rad as f32, exact.net_mass_kg as f32, exact.mu_rad as f32);
                worst = worst.max(&InterpolationError::of(&found, exact, &column.level));
            }
        }
    }
    Ok(worst)
}
