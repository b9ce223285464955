//! What may go wrong with the simulated devices.

/// Faults of one flight; none by default.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faults {
    /// Sea water into the hull: weight that no potentiometer shows. The rate is that at 1 MPa and goes with √p.
    pub leak: Seep,
    /// Back through a valve that does not close, or a piston that gives way: the potentiometer shows it. The rate is that of a
    /// full pressure difference; see [`crate::vehicle::Buoyancy::bleed_rate_at_m3_s`].
    pub uncommanded_bleed: Seep,
    /// Instruments that give nothing for a while.
    pub dropouts: Vec<Dropout>,
}

/// A flow that begins at some time and does not end.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Seep {
    /// Its rate, m³/s.
    pub rate_m3_s: f64,
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

/// An instrument whose silence the controller can see.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Instrument {
    /// Pressure sensor.
    Pressure,
    /// Attitude and heading reference.
    Attitude,
    /// Satellite receiver.
    Gps,
}

impl Faults {
    /// Whether an instrument gives something at a time, s after the start.
    #[must_use]
    pub fn speaks(&self, instrument: Instrument, time_s: f64) -> bool {
        let silent =
            |dropout: &Dropout| dropout.instrument == instrument && (dropout.from_s..dropout.until_s).contains(&time_s);
        !self.dropouts.iter().any(silent)
    }
}

impl Seep {
    /// Its rate at a time, s after the start.
    #[must_use]
    pub fn at(&self, time_s: f64) -> f64 {
        if time_s >= self.from_s { self.rate_m3_s } else { 0.0 }
    }
}
