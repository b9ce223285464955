//! The faults file: what goes wrong on a flight, and how large the errors of the instruments are.
//!
//! TOML; every section and every key may be left out:
//! ```toml
//! [leak]              # sea water into the hull: weight that no potentiometer shows
//! rate_m3_s = 1e-7    # at 1 MPa; goes with the root of the pressure
//! from_s = 300        # since when, s after the start; so below
//! [uncommanded_bleed] # a valve or piston that gives way: the potentiometer shows it
//! rate_m3_s = 1e-6
//! [gas]               # gas into the hull, measured at the air's pressure: the vacuum goes
//! rate_m3_s = 1e-6
//! [drain]             # a load that nobody switched on
//! power_w = 100
//! [battery]           # how its voltage gives way: see `Cells`
//! resistance_ohm = 0.03
//! droop = 0.3
//! [dropouts]          # instruments that give nothing, from and until, s; 1e9 is for good
//! pressure = [[400, 430], [900, 1e9]] # also attitude, gps, altimeter, leak, vacuum, voltage, charge, modem
//! [stuck]             # actuators that do not move, likewise
//! buoyancy = [[0, 60]] # also axial, rotation
//! [sensors]           # error sizes: see `SensorErrors`, whose names these are
//! gps_noise_m = 3
//! [sensors.pressure]  # likewise compass, altimeter, housekeeping
//! noise_pa = 50
//! ```

use crate::{
    flight::{
        Actuator, AltimeterErrors, Cells, CompassErrors, Drain, Dropout, Faults, FlyingVehicle, HousekeepingErrors,
        Instrument, PressureErrors, Seep, SensorErrors, Stuck,
    },
    toml_file::{self, FileError, Rule, Section},
};

/// Faults that need no file: name, file it comes from, text.
pub const EMBEDDED: &[(&str, &str, &str)] = &[
    ("none", "faults/none.toml", include_str!("../faults/none.toml")),
    ("leak", "faults/leak.toml", include_str!("../faults/leak.toml")),
    ("dead-pressure", "faults/dead-pressure.toml", include_str!("../faults/dead-pressure.toml")),
    ("compass-deviation", "faults/compass-deviation.toml", include_str!("../faults/compass-deviation.toml")),
    ("altimeter-dropout", "faults/altimeter-dropout.toml", include_str!("../faults/altimeter-dropout.toml")),
    ("weak-battery", "faults/weak-battery.toml", include_str!("../faults/weak-battery.toml")),
    ("stuck-pump", "faults/stuck-pump.toml", include_str!("../faults/stuck-pump.toml")),
];

const INSTRUMENTS: [(&str, Instrument); 9] = [
    ("pressure", Instrument::Pressure),
    ("attitude", Instrument::Attitude),
    ("gps", Instrument::Gps),
    ("altimeter", Instrument::Altimeter),
    ("leak", Instrument::Leak),
    ("vacuum", Instrument::Vacuum),
    ("voltage", Instrument::Voltage),
    ("charge", Instrument::Charge),
    ("modem", Instrument::Modem),
];

const ACTUATORS: [(&str, Actuator); 3] =
    [("buoyancy", Actuator::Buoyancy), ("axial", Actuator::Axial), ("rotation", Actuator::Rotation)];

const SIZE: Rule = Rule::NotNegative;
const SHARE: Rule = Rule::Within(0.0, 1.0);

/// What a faults file says.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaultsFile {
    /// What goes wrong.
    pub faults: Faults,
    /// How large the errors of the instruments are.
    pub sensor_errors: SensorErrors,
    /// How the battery gives way.
    pub cells: Cells,
}

impl FaultsFile {
    /// Reads faults from the text of their file; `source_name` stands in the errors.
    ///
    /// # Errors
    /// The first mistake, with its place and what would be right.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, FileError> {
        toml_file::read(text, source_name, |file| Self {
            faults: faults(file),
            sensor_errors: file.optional_section("sensors", sensors).unwrap_or_default(),
            cells: file.optional_section("battery", cells).unwrap_or_default(),
        })
    }

    /// Reads embedded faults by their name, or else a file by its path.
    ///
    /// # Errors
    /// As [`FaultsFile::from_toml`], or one line that lists the embedded names.
    pub fn load(name_or_path: &str) -> Result<Self, FileError> {
        let (text, file) = toml_file::load(name_or_path, EMBEDDED)?;
        Self::from_toml(&text, &file)
    }

    /// The vehicle with all that.
    #[must_use]
    pub fn on(self, flying: FlyingVehicle<'_>) -> FlyingVehicle<'_> {
        FlyingVehicle { faults: self.faults, sensor_errors: self.sensor_errors, cells: self.cells, ..flying }
    }
}

fn faults(file: &mut Section<'_>) -> Faults {
    Faults {
        leak: file.optional_section("leak", seep).unwrap_or_default(),
        uncommanded_bleed: file.optional_section("uncommanded_bleed", seep).unwrap_or_default(),
        gas: file.optional_section("gas", seep).unwrap_or_default(),
        drain: file.optional_section("drain", drain).unwrap_or_default(),
        dropouts: file.optional_section("dropouts", dropouts).unwrap_or_default(),
        stuck: file.optional_section("stuck", stuck).unwrap_or_default(),
    }
}

fn seep(section: &mut Section<'_>) -> Seep {
    Seep { rate_m3_s: section.number("rate_m3_s", SIZE), from_s: section.number_or("from_s", SIZE, 0.0) }
}

fn drain(section: &mut Section<'_>) -> Drain {
    Drain { power_w: section.number("power_w", SIZE), from_s: section.number_or("from_s", SIZE, 0.0) }
}

fn dropouts(section: &mut Section<'_>) -> Vec<Dropout> {
    let of = |(key, instrument)| spans(section, key).into_iter().map(move |span| (instrument, span));
    let spans = INSTRUMENTS.into_iter().flat_map(of);
    spans.map(|(instrument, [from_s, until_s])| Dropout { instrument, from_s, until_s }).collect()
}

fn stuck(section: &mut Section<'_>) -> Vec<Stuck> {
    let of = |(key, actuator)| spans(section, key).into_iter().map(move |span| (actuator, span));
    let spans = ACTUATORS.into_iter().flat_map(of);
    spans.map(|(actuator, [from_s, until_s])| Stuck { actuator, from_s, until_s }).collect()
}

/// Stretches of time, each from and until, s after the start.
fn spans(section: &mut Section<'_>, key: &'static str) -> Vec<[f64; 2]> {
    let Some(rows) = section.optional_pairs(key) else { return Vec::new() };
    let wrong = rows.is_empty() || rows.iter().any(|[from_s, until_s]| *from_s < 0.0 || until_s <= from_s);
    section.refuse_if(wrong, key, "rows of [from, until] in s after the start, each until after its from");
    rows
}

fn cells(battery: &mut Section<'_>) -> Cells {
    let usual = Cells::default();
    Cells {
        resistance_ohm: battery.number_or("resistance_ohm", SIZE, usual.resistance_ohm),
        droop: battery.number_or("droop", SHARE, usual.droop),
    }
}

fn sensors(sensors: &mut Section<'_>) -> SensorErrors {
    let usual = SensorErrors::default();
    SensorErrors {
        pressure: sensors.optional_section("pressure", pressure).unwrap_or_default(),
        compass: sensors.optional_section("compass", compass).unwrap_or_default(),
        altimeter: sensors.optional_section("altimeter", altimeter).unwrap_or_default(),
        housekeeping: sensors.optional_section("housekeeping", housekeeping).unwrap_or_default(),
        gps_noise_m: sensors.number_or("gps_noise_m", SIZE, usual.gps_noise_m),
        gps_acquisition_s: sensors.number_or("gps_acquisition_s", SIZE, usual.gps_acquisition_s),
        modem_acquisition_s: sensors.number_or("modem_acquisition_s", SIZE, usual.modem_acquisition_s),
        pot_noise: sensors.number_or("pot_noise", SHARE, usual.pot_noise),
    }
}

fn pressure(pressure: &mut Section<'_>) -> PressureErrors {
    let usual = PressureErrors::default();
    PressureErrors {
        range_over_crush: pressure.number_or("range_over_crush", Rule::Positive, usual.range_over_crush),
        noise_pa: pressure.number_or("noise_pa", SIZE, usual.noise_pa),
        bias_pa: pressure.number_or("bias_pa", SIZE, usual.bias_pa),
        drift_pa_h: pressure.number_or("drift_pa_h", SIZE, usual.drift_pa_h),
        creep: pressure.number_or("creep", SHARE, usual.creep),
        creep_s: pressure.number_or("creep_s", SIZE, usual.creep_s),
        zeroing_s: pressure.number_or("zeroing_s", SIZE, usual.zeroing_s),
    }
}

fn compass(compass: &mut Section<'_>) -> CompassErrors {
    let usual = CompassErrors::default();
    CompassErrors {
        tilt_noise_deg: compass.number_or("tilt_noise_deg", SIZE, usual.tilt_noise_deg),
        heading_noise_deg: compass.number_or("heading_noise_deg", SIZE, usual.heading_noise_deg),
        rate_noise_deg_s: compass.number_or("rate_noise_deg_s", SIZE, usual.rate_noise_deg_s),
        tilt_bias_deg: compass.number_or("tilt_bias_deg", SIZE, usual.tilt_bias_deg),
        heading_bias_deg: compass.number_or("heading_bias_deg", SIZE, usual.heading_bias_deg),
        lag_s: compass.number_or("lag_s", SIZE, usual.lag_s),
        earth_ut: compass.number_or("earth_ut", Rule::Positive, usual.earth_ut),
        battery_ut_m: compass.number_or("battery_ut_m", SIZE, usual.battery_ut_m),
        battery_roll_ut: compass.number_or("battery_roll_ut", SIZE, usual.battery_roll_ut),
        depth_ut_km: compass.number_or("depth_ut_km", SIZE, usual.depth_ut_km),
    }
}

fn altimeter(altimeter: &mut Section<'_>) -> AltimeterErrors {
    let usual = AltimeterErrors::default();
    AltimeterErrors {
        // Bounds that do not overlap: whatever is given, the nearest floor is nearer than the farthest.
        least_m: altimeter.number_or("least_m", Rule::Within(0.0, 5.0), usual.least_m),
        most_m: altimeter.number_or("most_m", Rule::Above(5.0), usual.most_m),
        mount_deg: altimeter.number_or("mount_deg", Rule::Within(-90.0, 90.0), usual.mount_deg),
        beam_deg: altimeter.number_or("beam_deg", Rule::Within(0.0, 89.0), usual.beam_deg),
        dropout: altimeter.number_or("dropout", SHARE, usual.dropout),
        noise_m: altimeter.number_or("noise_m", SIZE, usual.noise_m),
        step_m: altimeter.number_or("step_m", Rule::Positive, usual.step_m),
    }
}

fn housekeeping(housekeeping: &mut Section<'_>) -> HousekeepingErrors {
    let usual = HousekeepingErrors::default();
    HousekeepingErrors {
        leak_noise_v: housekeeping.number_or("leak_noise_v", SIZE, usual.leak_noise_v),
        leak_glitches_per_h: housekeeping.number_or("leak_glitches_per_h", SIZE, usual.leak_glitches_per_h),
        vacuum_noise_pa: housekeeping.number_or("vacuum_noise_pa", SIZE, usual.vacuum_noise_pa),
        voltage_noise_v: housekeeping.number_or("voltage_noise_v", SIZE, usual.voltage_noise_v),
        charge_gain: housekeeping.number_or("charge_gain", SIZE, usual.charge_gain),
    }
}
