//! What may go wrong with the simulated devices.

use shared::commands::Commands;

/// Faults of one flight; none by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Sea water into the hull: weight that no potentiometer shows. The rate is that at 1 MPa and goes with √p.
    pub leak: Seep,
    /// Back through a valve that does not close, or a piston that gives way: the potentiometer shows it. The rate is that of a
    /// full pressure difference; see [`crate::model::vehicle::Buoyancy::bleed_rate_at_m3_s`].
    pub uncommanded_bleed: Seep,
    /// Gas into the hull, as air past a seal or out of a battery cell, measured at the air's pressure.
    pub gas: Seep,
    /// A load that nobody switched on.
    pub drain: Drain,
    /// Instruments that give nothing for a while.
    pub dropouts: Vec<Dropout>,
    /// Actuators that do not move for a while.
    pub stuck: Vec<Stuck>,
}

/// A flow that begins at some time and does not end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seep {
    /// Its rate, m³/s.
    pub rate_m3_s: f64,
    /// Since when, s after the start.
    pub from_s: f64,
}

/// A load that begins at some time and does not end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Drain {
    /// Its power, W.
    pub power_w: f64,
    /// Since when, s after the start.
    pub from_s: f64,
}

/// An instrument that gives nothing for a while.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dropout {
    /// Which one.
    pub instrument: Instrument,
    /// From when, s after the start.
    pub from_s: f64,
    /// Until when, s after the start.
    pub until_s: f64,
}

/// An instrument whose silence the controller can see (append only: an instrument's place chooses its noise).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instrument {
    /// Pressure sensor.
    Pressure,
    /// Attitude and heading reference.
    Attitude,
    /// Satellite receiver.
    Gps,
    /// Altimeter.
    Altimeter,
    /// Leak detector.
    Leak,
    /// Vacuum gauge.
    Vacuum,
    /// Battery's voltmeter.
    Voltage,
    /// Coulomb counter.
    Charge,
    /// Modem.
    Modem,
}

/// An actuator that does not move for a while, whatever it is told.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stuck {
    /// Which one.
    pub actuator: Actuator,
    /// From when, s after the start.
    pub from_s: f64,
    /// Until when, s after the start.
    pub until_s: f64,
}

/// An actuator that may stick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Actuator {
    /// Buoyancy engine: neither pumps nor bleeds.
    Buoyancy,
    /// Axial drive of the moving mass.
    Axial,
    /// Its rotation drive.
    Rotation,
}

impl Faults {
    /// Whether an instrument gives something at a time, s after the start.
    #[must_use]
    pub fn speaks(&self, instrument: Instrument, time_s: f64) -> bool {
        let silent =
            |dropout: &Dropout| dropout.instrument == instrument && (dropout.from_s..dropout.until_s).contains(&time_s);
        !self.dropouts.iter().any(silent)
    }

    /// What the actuators make of commands at a time, s after the start.
    #[must_use]
    pub fn obeyed(&self, commands: &Commands, time_s: f64) -> Commands {
        let mut obeyed = *commands;
        for stuck in self.stuck.iter().filter(|stuck| (stuck.from_s..stuck.until_s).contains(&time_s)) {
            match stuck.actuator {
                Actuator::Buoyancy => obeyed.vbd_rate_ul_s = 0,
                Actuator::Axial => obeyed.r_px_rate_um_s = 0,
                Actuator::Rotation => obeyed.mu_rate_cdeg_s = 0,
            }
        }
        obeyed
    }
}

impl Drain {
    /// Its power at a time, s after the start.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        if time_s >= self.from_s { self.power_w } else { 0.0 }
    }
}

impl Seep {
    /// Its rate at a time, s after the start.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        if time_s >= self.from_s { self.rate_m3_s } else { 0.0 }
    }

    /// What it has brought in by a time, s after the start, at a rate that nothing changes, m³.
    #[must_use]
    pub fn gathered_m3(&self, time_s: f64) -> f64 {
        self.rate_m3_s * (time_s - self.from_s).max(0.0)
    }
}
