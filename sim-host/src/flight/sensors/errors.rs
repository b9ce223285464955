//! How large the errors of the instruments are: one place, so that a campaign can change them.
//!
//! A size is a standard deviation unless it says otherwise. What is drawn once per flight is called constant.

/// Errors of all instruments.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SensorErrors {
    /// Pressure sensor.
    pub pressure: PressureErrors,
    /// Tilt-compensated compass.
    pub compass: CompassErrors,
    /// Altimeter.
    pub altimeter: AltimeterErrors,
    /// Leak detector, vacuum gauge and battery gauge.
    pub housekeeping: HousekeepingErrors,
    /// Horizontal error of a position fix, per axis, m.
    pub gps_noise_m: f64,
    /// Time with the antenna clear until positions come, s.
    pub gps_acquisition_s: f64,
    /// Time with the antenna clear until the modem has a link, s.
    pub modem_acquisition_s: f64,
    /// Noise of the moving mass's potentiometers, over their travel.
    pub pot_noise: f64,
}

/// Errors of the pressure sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PressureErrors {
    /// Most that it shows, over the pressure at the vehicle's crush depth.
    pub range_over_crush: f64,
    /// Noise, Pa.
    pub noise_pa: f64,
    /// Constant error that zeroing at the surface does not see, Pa.
    pub bias_pa: f64,
    /// Constant rate of drift, Pa/h; zeroing at the surface takes away what has gathered.
    pub drift_pa_h: f64,
    /// Hysteresis, as creep: the part of a change of pressure that shows only later (a size, not a deviation).
    pub creep: f64,
    /// Time in which it shows, s.
    pub creep_s: f64,
    /// Time constant of zeroing while the antenna is clear, s.
    pub zeroing_s: f64,
}

/// Errors of the attitude and heading reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CompassErrors {
    /// Noise of pitch and roll, deg.
    pub tilt_noise_deg: f64,
    /// Noise of heading, deg.
    pub heading_noise_deg: f64,
    /// Noise of rates, deg/s.
    pub rate_noise_deg_s: f64,
    /// Constant errors of pitch and roll (mounting), deg.
    pub tilt_bias_deg: f64,
    /// Constant error of heading (mounting, declination), deg.
    pub heading_bias_deg: f64,
    /// Time constant of its filter for pitch, roll and heading, s (a size, not a deviation).
    pub lag_s: f64,
    /// Horizontal part of the Earth's field, µT.
    pub earth_ut: f64,
    /// Field of the moving battery that calibration left, per metre of its way from the centre, each axis constant, µT/m.
    pub battery_ut_m: f64,
    /// The same for its rotation: what turns with it, µT.
    pub battery_roll_ut: f64,
    /// Field that grows with depth, each axis constant, µT/km.
    pub depth_ut_km: f64,
}

/// Errors of the altimeter; none of them is a constant of a flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AltimeterErrors {
    /// Nearest floor that it ranges, m along the beam (a size).
    pub least_m: f64,
    /// Farthest floor that it ranges, m along the beam (a size).
    pub most_m: f64,
    /// Nose-down pitch at which its beam is vertical, deg (a size).
    pub mount_deg: f64,
    /// Angle of the beam from the vertical beyond which the floor sends no echo back, deg (a size).
    pub beam_deg: f64,
    /// Part of the pings that get no echo for no reason.
    pub dropout: f64,
    /// Noise, m.
    pub noise_m: f64,
    /// Step of its reading, m (a size).
    pub step_m: f64,
}

/// Errors of what watches over the vehicle itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HousekeepingErrors {
    /// Noise of the leak detector, V.
    pub leak_noise_v: f64,
    /// Single readings of the leak detector that look wet, per hour (a rate).
    pub leak_glitches_per_h: f64,
    /// Noise of the vacuum gauge, Pa.
    pub vacuum_noise_pa: f64,
    /// Noise of the battery's voltmeter, V.
    pub voltage_noise_v: f64,
    /// Constant error of the coulomb counter, over the charge.
    pub charge_gain: f64,
}

impl Default for SensorErrors {
    /// Chosen within what receivers and 12-bit potentiometers do, whose step is the larger error.
    fn default() -> Self {
        Self {
            pressure: PressureErrors::default(),
            compass: CompassErrors::default(),
            altimeter: AltimeterErrors::default(),
            housekeeping: HousekeepingErrors::default(),
            gps_noise_m: 3.0,
            gps_acquisition_s: 20.0,
            modem_acquisition_s: 10.0,
            pot_noise: 0.0,
        }
    }
}

impl SensorErrors {
    /// Instruments that show what is, but for their range, step and lag.
    #[must_use]
    pub fn none() -> Self {
        let (usual, none) = (Self::default(), 0.0);
        let pressure =
            PressureErrors { noise_pa: none, bias_pa: none, drift_pa_h: none, creep: none, ..usual.pressure };
        let compass = CompassErrors {
            tilt_noise_deg: none,
            heading_noise_deg: none,
            rate_noise_deg_s: none,
            tilt_bias_deg: none,
            heading_bias_deg: none,
            battery_ut_m: none,
            battery_roll_ut: none,
            depth_ut_km: none,
            ..usual.compass
        };
        let altimeter = AltimeterErrors { dropout: none, noise_m: none, ..usual.altimeter };
        let housekeeping = HousekeepingErrors {
            leak_noise_v: none,
            leak_glitches_per_h: none,
            vacuum_noise_pa: none,
            voltage_noise_v: none,
            charge_gain: none,
        };
        Self { pressure, compass, altimeter, housekeeping, gps_noise_m: none, pot_noise: none, ..usual }
    }
}

impl Default for PressureErrors {
    /// Noise is that of a 0.01 % sensor of 20 bar; all else chosen.
    fn default() -> Self {
        Self {
            range_over_crush: 1.25,
            noise_pa: 50.0,
            bias_pa: 100.0,
            drift_pa_h: 50.0,
            creep: 2e-4,
            creep_s: 600.0,
            zeroing_s: 10.0,
        }
    }
}

impl Default for CompassErrors {
    /// A compass calibrated with the battery moving, in the field of the northern North Sea: some 0.5° remain. Chosen.
    fn default() -> Self {
        Self {
            tilt_noise_deg: 0.15,
            heading_noise_deg: 0.5,
            rate_noise_deg_s: 0.1,
            tilt_bias_deg: 0.3,
            heading_bias_deg: 0.7,
            lag_s: 0.3,
            earth_ut: 15.0,
            battery_ut_m: 0.3,
            battery_roll_ut: 0.1,
            depth_ut_km: 0.3,
        }
    }
}

impl Default for AltimeterErrors {
    /// An altimeter of 100 m that looks straight down in a dive at 26°, the fielded pitch. Chosen.
    fn default() -> Self {
        Self { least_m: 0.5, most_m: 100.0, mount_deg: 26.0, beam_deg: 20.0, dropout: 0.1, noise_m: 0.1, step_m: 0.1 }
    }
}

impl Default for HousekeepingErrors {
    /// Chosen; glitches of leak detectors are known from the field.
    fn default() -> Self {
        Self {
            leak_noise_v: 0.01,
            leak_glitches_per_h: 1.0,
            vacuum_noise_pa: 50.0,
            voltage_noise_v: 0.02,
            charge_gain: 0.01,
        }
    }
}

impl CompassErrors {
    /// A compass that was never calibrated against the moving battery: tens of degrees that change with depth, as in the field.
    #[must_use]
    pub fn uncalibrated() -> Self {
        Self { battery_ut_m: 15.0, battery_roll_ut: 3.0, depth_ut_km: 5.0, ..Self::default() }
    }
}
