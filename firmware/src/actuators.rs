//! The three actuators together: what the autopilot commands, and what it hears of them.

use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle};
use shared::commands::Commands;

use crate::{
    calibration::Counts,
    log::log,
    mass::Axis,
    pump::{Fault, Pump},
};

/// Readings of the three position potentiometers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Readings {
    /// Piston of the buoyancy device.
    pub vbd: Counts,
    /// Moving mass along the axis.
    pub r_px: Counts,
    /// Moving mass around the axis.
    pub mu: Counts,
}

/// Where the three actuators stand, in device integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Positions {
    /// Volume beyond neutral, µl.
    pub vbd_ul: i32,
    /// Axial position of the moving mass, µm.
    pub r_px_um: i32,
    /// Rotation of the moving mass, 0.01°.
    pub mu_cdeg: i16,
}

/// Pump and both axes of the moving mass.
#[derive(Debug)]
pub struct Actuators<Motor, Pin> {
    pump: Pump<Motor, Pin>,
    axial: Axis<Motor, Pin>,
    rotation: Axis<Motor, Pin>,
    faults: [Option<Fault>; 3],
}

impl<Motor: SetDutyCycle, Pin: OutputPin> Actuators<Motor, Pin> {
    /// Takes the three drivers.
    pub const fn new(pump: Pump<Motor, Pin>, axial: Axis<Motor, Pin>, rotation: Axis<Motor, Pin>) -> Self {
        Self { pump, axial, rotation, faults: [None; 3] }
    }

    /// Passes the autopilot's orders on; they run from the next beat.
    pub fn order(&mut self, commands: &Commands) {
        self.pump.order(commands.vbd_rate_ul_s);
        self.axial.order(commands.r_px_rate_um_s);
        self.rotation.order(i32::from(commands.mu_rate_cdeg_s));
    }

    /// Runs all three for one beat; a fault stops its own actuator only, and is logged once.
    pub fn beat(&mut self, readings: &Readings) {
        let outcomes = [
            ("pump", self.pump.beat(readings.vbd)),
            ("axial mass", self.axial.beat(readings.r_px)),
            ("rotation of the mass", self.rotation.beat(readings.mu)),
        ];
        for (known, (name, outcome)) in self.faults.iter_mut().zip(outcomes) {
            let fault = outcome.err();
            if fault.is_some() != known.is_some() {
                match fault {
                    Some(fault) => log!(error, "{} stopped: {:?}", name, fault),
                    None => log!(info, "{} works again", name),
                }
            }
            *known = fault;
        }
    }

    /// Where they stand.
    pub fn positions(&self) -> Positions {
        let mu_cdeg = self.rotation.position();
        Positions {
            vbd_ul: self.pump.vbd_ul(),
            r_px_um: self.axial.position(),
            mu_cdeg: i16::try_from(mu_cdeg).unwrap_or(if mu_cdeg < 0 { i16::MIN } else { i16::MAX }),
        }
    }

    /// Stops, shuts and brakes everything; all are tried, and a failure is logged.
    pub fn make_safe(&mut self) {
        let outcomes = [self.pump.make_safe(), self.axial.make_safe(), self.rotation.make_safe()];
        if outcomes.iter().any(Result::is_err) {
            log!(error, "an actuator could not be put safe");
        }
    }
}
