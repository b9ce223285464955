//! The flying laws, as gains: found by asking the very code that flies, its deadbands set to zero.
//!
//! A deadband lets nothing through or the whole error, so its describing function lies between 0 and 1: it never adds gain.

use shared::{
    control::{
        heading::{HeadingLoop, TurnTrim},
        pitch::{PitchLoop, PitchTrim, Steady},
        servo::{Move, Servo},
    },
    device::{RAD_PER_CDEG, TICK_HZ, UM_PER_M},
    model::{table::TrimTable, vehicle::Range},
    parameters::Parameters,
};

/// Error that is put to the laws, 0.01°: far above their rounding, within their limits.
const ERROR_CDEG: i32 = 200;
/// Rotation over which the table's slopes are taken, rad.
const SMALL_MU_RAD: f32 = 0.02;
/// Longest time for which the pitch law is asked, s.
const LONG_S: u32 = 3600;

/// The laws of a vehicle's controller at one glide.
#[derive(Clone, Debug)]
pub(super) struct Laws<'a> {
    pub(super) table: &'a TrimTable<'a>,
    pub(super) parameters: Parameters,
    pub(super) steady: Steady,
}

impl<'a> Laws<'a> {
    pub(super) fn new(table: &'a TrimTable<'a>, parameters: &Parameters, steady: Steady) -> Self {
        let sharp = Parameters { pitch_deadband_cdeg: 0, heading_deadband_cdeg: 0, mu_deadband_cdeg: 0, ..*parameters };
        Self { table, parameters: sharp, steady }
    }

    /// Axial position that one correction adds per mean pitch error, m/rad.
    pub(super) fn pitch_m_per_rad(&self) -> f64 {
        let law = PitchLoop::new(&self.parameters);
        let corrected_um = |error_cdeg: i32| {
            let mut trim = PitchTrim::default();
            for tick in 0..LONG_S * TICK_HZ {
                law.update(&mut trim, self.table, &self.steady, tick, Some(error_cdeg));
                if trim.trim_um != 0 {
                    break;
                }
            }
            f64::from(trim.trim_um)
        };
        let per_cdeg = (corrected_um(ERROR_CDEG) - corrected_um(-ERROR_CDEG)) / f64::from(2 * ERROR_CDEG);
        per_cdeg / f64::from(UM_PER_M) / f64::from(RAD_PER_CDEG)
    }

    /// Rotation of the mass per heading error.
    pub(super) fn mu_per_heading(&self) -> f64 {
        let law = HeadingLoop::new(&self.parameters);
        let mu_cdeg = |error_cdeg: i32, near_cdeg: i32| {
            law.mu_cdeg(&mut TurnTrim::default(), self.table, &self.steady, 0, error_cdeg, near_cdeg)
        };
        let straight_cdeg = mu_cdeg(0, 0);
        let [more, less] = [ERROR_CDEG, -ERROR_CDEG].map(|error_cdeg| mu_cdeg(error_cdeg, straight_cdeg));
        f64::from(more - less) / f64::from(2 * ERROR_CDEG)
    }

    /// Axial position that is led along with the rotation, m/rad: 0 for a symmetric vehicle.
    pub(super) fn r_px_m_per_mu(&self, mu_rad: f64) -> f64 {
        let Steady { path_angle_rad, net_mass_kg } = self.steady;
        let r_px_m = |mu_rad: f32| f64::from(self.table.look_up(path_angle_rad, net_mass_kg, mu_rad).r_px_m);
        let mu_rad = mu_rad as f32;
        (r_px_m(mu_rad + SMALL_MU_RAD) - r_px_m(mu_rad - SMALL_MU_RAD)) / f64::from(2.0 * SMALL_MU_RAD)
    }
}

/// Rate that the servo orders per error of the position while no limit is met, 1/s.
pub(super) fn servo_per_s() -> f64 {
    const ERROR: i32 = 1_000;
    // Fine enough a sensor that the error is not taken for its step.
    let range = Range { min: -100 * ERROR, max: 100 * ERROR };
    let servo = Servo { range, rate_up: i32::MAX, rate_down: i32::MAX, deadband: 0 };
    f64::from(servo.rate(&mut Move::default(), ERROR, 0)) / f64::from(ERROR)
}
