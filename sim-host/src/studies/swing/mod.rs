//! Swings a compass on the pier, as a crew does before a mission, and fits the vehicle file's section `[compass]`.
//!
//! The vehicle lies in a cradle that turns and pitches. With the battery at several positions and rotations it is turned
//! through the headings, each known by a sight, and the compass is read. What changes with depth cannot be seen there: the
//! table leaves it as it is.

mod fit;
mod text;

pub use fit::{Reading, fit};
pub use text::{section, vehicle_file};

use std::f64::consts::TAU;

use nalgebra::Vector3;
use serde::Serialize;
use shared::math::wrap_cdeg;

use crate::flight::{FlyingVehicle, PierCompass};
use crate::model::vehicle::Compass;

/// Positions of the battery, from end to end of its travel.
const POSITIONS: u32 = 5;
/// Rotations of the battery, from end to end.
const ROTATIONS: u32 = 3;
/// Pitch of the cradle: without pitch the compass does not feel the vertical part of the battery's field.
const PITCHES_DEG: [f64; 3] = [-25.0, 0.0, 25.0];
/// Headings of a turn.
const HEADINGS: u32 = 12;

/// A compass that was swung.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Swing {
    /// Number of readings.
    pub readings: usize,
    /// How far off it was, and is.
    pub positions: Vec<Residual>,
    /// What takes the deviation away.
    pub compass: Compass,
    /// Where the table cannot help.
    pub warnings: Vec<String>,
}

/// Heading errors at one position of the battery.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Residual {
    /// Axial position, m.
    pub r_px_m: f64,
    /// Compass against the sight, deg rms.
    pub before_rms_deg: f64,
    /// The same, corrected by what flies: the noise of the compass is in it.
    pub after_rms_deg: f64,
}

/// Swings the compass that a flight with this seed would have.
///
/// # Errors
/// One line, if no table can be made of the readings.
pub fn swing(flying: &FlyingVehicle<'_>, seed: u64) -> Result<Swing, String> {
    let readings = readings(flying, seed);
    let compass = fit(&readings, flying.sensor_errors.compass.earth_ut)
        .map_err(|error| format!("{}: {error}", flying.vehicle.name))?;
    let positions = compass.battery_ut.iter().map(|&[r_px_m, ..]| residual(&readings, &compass, r_px_m)).collect();
    Ok(Swing { readings: readings.len(), positions, warnings: warnings(&compass), compass })
}

fn readings(flying: &FlyingVehicle<'_>, seed: u64) -> Vec<Reading> {
    let mass = &flying.vehicle.moving_mass;
    let mut compass = PierCompass::new(flying, seed);
    let mut readings = Vec::new();
    for r_px_m in evenly(mass.travel_m, POSITIONS) {
        for mu_rad in evenly(mass.roll_deg.map(f64::to_radians), ROTATIONS) {
            for pitch_deg in PITCHES_DEG {
                for heading in 0..HEADINGS {
                    let heading_rad = f64::from(heading) * TAU / f64::from(HEADINGS);
                    let euler_rad = Vector3::new(0.0, pitch_deg.to_radians(), heading_rad);
                    let shown = compass.read(&euler_rad, r_px_m, mu_rad);
                    readings.push(Reading { r_px_m, mu_rad, heading_rad, shown });
                }
            }
        }
    }
    readings
}

/// Some values from end to end of a range.
fn evenly([first, last]: [f64; 2], count: u32) -> impl Iterator<Item = f64> {
    (0..count).map(move |index| first + (last - first) * f64::from(index) / f64::from(count - 1))
}

fn residual(readings: &[Reading], compass: &Compass, r_px_m: f64) -> Residual {
    let flown = compass.flown();
    let here = || readings.iter().filter(|reading| (reading.r_px_m - r_px_m).abs() < 1e-6);
    let rms_deg = |heading_cdeg: &dyn Fn(&Reading) -> u16| {
        let squares: f64 = here().map(|reading| error_deg(heading_cdeg(reading), reading.heading_rad).powi(2)).sum();
        (squares / here().count() as f64).sqrt()
    };
    Residual {
        r_px_m,
        before_rms_deg: rms_deg(&|reading| reading.shown.heading_cdeg),
        after_rms_deg: rms_deg(&|reading| {
            let (r_px_um, mu_cdeg) = ((reading.r_px_m * 1e6).round(), (reading.mu_rad.to_degrees() * 100.0).round());
            flown.heading_cdeg(&reading.shown, r_px_um as i32, mu_cdeg as i16)
        }),
    }
}

fn error_deg(shown_cdeg: u16, true_rad: f64) -> f64 {
    let true_cdeg = (true_rad.to_degrees() * 100.0).round() as i32;
    f64::from(wrap_cdeg(i32::from(shown_cdeg) - true_cdeg)) / 100.0
}

/// Positions at which the battery's field may outweigh the Earth's.
fn warnings(compass: &Compass) -> Vec<String> {
    let [right, below] = compass.turning_ut;
    let reaches = |[_, ut @ ..]: &[f64; 4]| (Vector3::from(*ut).norm() + right.hypot(below)) / compass.earth_ut;
    let beyond = compass.battery_ut.iter().filter(|row| reaches(row) > 1.0);
    let warning = |row: &[f64; 4]| {
        let (r_px_m, reach) = (row[0], reaches(row));
        format!(
            "at r_px {r_px_m} m the battery's field reaches {reach:.1} times the Earth's: no table corrects beyond 1"
        )
    };
    beyond.map(warning).collect()
}
