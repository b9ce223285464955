//! The battery's field from readings of the compass, by least squares.

use nalgebra::{DMatrix, DVector};
use shared::device::Attitude;

use crate::model::vehicle::Compass;

/// Rounds until the offset has settled: each leaves the product of what is left of it and of the deviation.
const ROUNDS: usize = 6;

/// One reading of the compass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reading {
    /// Axial position of the moving mass, m.
    pub r_px_m: f64,
    /// Its rotation, rad.
    pub mu_rad: f64,
    /// True heading, rad.
    pub heading_rad: f64,
    /// What the compass showed.
    pub shown: Attitude,
}

/// The table that explains the readings best, with one row for each axial position among them, which must rise.
///
/// `sin(true − shown) = B sin(shown) + C cos(shown)` ([`shared::estimate::compass`]) is linear in the battery's field, over the Earth's;
/// an offset adds its cosine's share (`A cos δ` of Evans & Smith). Rounded to 0.001 µT and 0.01°.
///
/// # Errors
/// One line, if the readings do not tell the parts of the field apart, or the battery's field drowns the Earth's.
pub fn fit(readings: &[Reading], earth_ut: f64) -> Result<Compass, String> {
    let mut positions_m: Vec<f64> = readings.iter().map(|reading| reading.r_px_m).collect();
    positions_m.dedup();
    let mut offset_rad = 0.0;
    let mut found = Vec::new();
    for _ in 0..ROUNDS {
        let (rows, sines) = equations(readings, &positions_m, offset_rad);
        let normal = (rows.transpose() * &rows).cholesky();
        let normal = normal.ok_or("the readings do not tell the parts of the battery's field apart")?;
        found = normal.solve(&(rows.transpose() * sines)).iter().copied().collect();
        offset_rad += found.pop().unwrap_or(0.0);
    }
    let (battery, turning) = found.split_at(3 * positions_m.len());
    let ut = |over_earth: f64| rounded(over_earth * earth_ut, 1e3);
    let (battery, _) = battery.as_chunks();
    let row = |(r_px_m, [ahead, right, below]): (&f64, &[f64; 3])| {
        [rounded(*r_px_m, 1e6), ut(*ahead), ut(*right), ut(*below)]
    };
    let compass = Compass {
        offset_deg: rounded(offset_rad.to_degrees(), 100.0),
        earth_ut,
        battery_ut: positions_m.iter().zip(battery).map(row).collect(),
        turning_ut: [ut(turning[0]), ut(turning[1])],
    };
    if compass.is_storable() {
        Ok(compass)
    } else {
        Err(format!("the battery's field drowns the Earth's {earth_ut} µT: no table can correct that"))
    }
}

/// One equation per reading. Unknown are three parts of the field for each position, two that turn, and an offset beyond the
/// one that is known.
fn equations(readings: &[Reading], positions_m: &[f64], offset_rad: f64) -> (DMatrix<f64>, DVector<f64>) {
    let turning = 3 * positions_m.len();
    let mut rows = DMatrix::zeros(readings.len(), turning + 3);
    let mut sines = DVector::zeros(readings.len());
    for (index, reading) in readings.iter().enumerate() {
        let shown_rad = radians(reading.shown.heading_cdeg) + offset_rad;
        let [ahead, right, below] = shares(&reading.shown, shown_rad);
        let (sin, cos) = reading.mu_rad.sin_cos();
        let (deviation_sin, deviation_cos) = (reading.heading_rad - shown_rad).sin_cos();
        let first = 3 * positions_m.iter().take_while(|r_px_m| **r_px_m != reading.r_px_m).count();
        rows[(index, first)] = ahead;
        rows[(index, first + 1)] = right;
        rows[(index, first + 2)] = below;
        rows[(index, turning)] = (cos - 1.0) * right + sin * below;
        rows[(index, turning + 1)] = (cos - 1.0) * below - sin * right;
        rows[(index, turning + 2)] = deviation_cos;
        sines[index] = deviation_sin;
    }
    (rows, sines)
}

/// What a unit of field ahead, right, below adds to `B sin(shown) + C cos(shown)`.
fn shares(shown: &Attitude, shown_rad: f64) -> [f64; 3] {
    let ((sin, cos), (sin_roll, cos_roll), (sin_pitch, cos_pitch)) =
        (shown_rad.sin_cos(), radians(shown.roll_cdeg).sin_cos(), radians(shown.pitch_cdeg).sin_cos());
    [cos_pitch * sin, sin_pitch * sin_roll * sin + cos_roll * cos, sin_pitch * cos_roll * sin - sin_roll * cos]
}

fn radians(cdeg: impl Into<f64>) -> f64 {
    (cdeg.into() / 100.0).to_radians()
}

fn rounded(value: f64, steps_per_unit: f64) -> f64 {
    // A zero without a sign.
    (value * steps_per_unit).round() / steps_per_unit + 0.0
}
