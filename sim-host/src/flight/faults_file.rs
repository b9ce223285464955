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

use crate::files::toml_file::{self, FileError, Rule, Section};
use crate::flight::{
    Actuator, AltimeterErrors, Cells, CompassErrors, Drain, Dropout, Faults, FlyingVehicle, HousekeepingErrors,
    Instrument, PressureErrors, Seep, SensorErrors, Stuck,
};

/// Faults that need no file: name, file it comes from, text.
pub const EMBEDDED: &[(&str, &str, &str)] = &[
    ("none", "faults/none.toml", include_str!("../../faults/none.toml")),
    ("leak", "faults/leak.toml", include_str!("../../faults/leak.toml")),
    ("dead-pressure", "faults/dead-pressure.toml", include_str!("../../faults/dead-pressure.toml")),
    ("compass-deviation", "faults/compass-deviation.toml", include_str!("../../faults/compass-deviation.toml")),
    ("altimeter-dropout", "faults/altimeter-dropout.toml", include_str!("../../faults/altimeter-dropout.toml")),
    ("weak-battery", "faults/weak-battery.toml", include_str!("../../faults/weak-battery.toml")),
    ("stuck-pump", "faults/stuck-pump.toml", include_str!("../../faults/stuck-pump.toml")),
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
    spans(section, &INSTRUMENTS, |instrument, [from_s, until_s]| Dropout { instrument, from_s, until_s })
}

fn stuck(section: &mut Section<'_>) -> Vec<Stuck> {
    spans(section, &ACTUATORS, |actuator, [from_s, until_s]| Stuck { actuator, from_s, until_s })
}

/// Stretches of time of each device by its key: rows of from and until, s after the start.
fn spans<D: Copy, T>(section: &mut Section<'_>, devices: &[(&'static str, D)], span: fn(D, [f64; 2]) -> T) -> Vec<T> {
    let mut spans = Vec::new();
    for &(key, device) in devices {
        let Some(rows) = section.optional_pairs(key) else { continue };
        let wrong = rows.is_empty() || rows.iter().any(|[from_s, until_s]| *from_s < 0.0 || until_s <= from_s);
        section.refuse_if(wrong, key, "rows of [from, until] in s after the start, each until after its from");
        spans.extend(rows.into_iter().map(|row| span(device, row)));
    }
    spans
}

/// A struct of which the numbers that stand in the section are read, each by its own name; the others stay.
macro_rules! with_numbers {
    ($section:ident, $usual:expr, { $($name:ident: $rule:expr),+ $(,)? }) => {{
        let mut read = $usual;
        $(read.$name = $section.number_or(stringify!($name), $rule, read.$name);)+
        read
    }};
}

fn cells(battery: &mut Section<'_>) -> Cells {
    with_numbers!(battery, Cells::default(), { resistance_ohm: SIZE, droop: SHARE })
}

fn sensors(sensors: &mut Section<'_>) -> SensorErrors {
    let of_instruments = SensorErrors {
        pressure: sensors.optional_section("pressure", pressure).unwrap_or_default(),
        compass: sensors.optional_section("compass", compass).unwrap_or_default(),
        altimeter: sensors.optional_section("altimeter", altimeter).unwrap_or_default(),
        housekeeping: sensors.optional_section("housekeeping", housekeeping).unwrap_or_default(),
        ..SensorErrors::default()
    };
    with_numbers!(sensors, of_instruments, {
        gps_noise_m: SIZE,
        gps_acquisition_s: SIZE,
        modem_acquisition_s: SIZE,
        pot_noise: SHARE,
    })
}

fn pressure(pressure: &mut Section<'_>) -> PressureErrors {
    with_numbers!(pressure, PressureErrors::default(), {
        range_over_crush: Rule::Positive,
        noise_pa: SIZE,
        bias_pa: SIZE,
        drift_pa_h: SIZE,
        creep: SHARE,
        creep_s: SIZE,
        zeroing_s: SIZE,
    })
}

fn compass(compass: &mut Section<'_>) -> CompassErrors {
    with_numbers!(compass, CompassErrors::default(), {
        tilt_noise_deg: SIZE,
        heading_noise_deg: SIZE,
        rate_noise_deg_s: SIZE,
        tilt_bias_deg: SIZE,
        heading_bias_deg: SIZE,
        lag_s: SIZE,
        earth_ut: Rule::Positive,
        battery_ut_m: SIZE,
        battery_roll_ut: SIZE,
        depth_ut_km: SIZE,
    })
}

fn altimeter(altimeter: &mut Section<'_>) -> AltimeterErrors {
    with_numbers!(altimeter, AltimeterErrors::default(), {
        // Bounds that do not overlap: whatever is given, the nearest floor is nearer than the farthest.
        least_m: Rule::Within(0.0, 5.0),
        most_m: Rule::Above(5.0),
        mount_deg: Rule::Within(-90.0, 90.0),
        beam_deg: Rule::Within(0.0, 89.0),
        dropout: SHARE,
        noise_m: SIZE,
        step_m: Rule::Positive,
    })
}

fn housekeeping(housekeeping: &mut Section<'_>) -> HousekeepingErrors {
    with_numbers!(housekeeping, HousekeepingErrors::default(), {
        leak_noise_v: SIZE,
        leak_glitches_per_h: SIZE,
        vacuum_noise_pa: SIZE,
        voltage_noise_v: SIZE,
        charge_gain: SIZE,
    })
}
