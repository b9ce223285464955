//! A faults file says what goes wrong; its mistakes are answered with one line.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use sim_host::flight::{
    Actuator, AltimeterErrors, Cells, CompassErrors, Drain, Dropout, Faults, HousekeepingErrors, Instrument,
    PressureErrors, Seep, SensorErrors, Stuck,
    faults_file::{EMBEDDED, FaultsFile},
};

fn parse(text: &str) -> Result<FaultsFile, String> {
    FaultsFile::from_toml(text, "f.toml").map_err(|error| error.to_string())
}

#[test]
fn every_key_reaches_its_own_place() {
    let read = parse(
        "[leak]\nrate_m3_s = 1\nfrom_s = 2\n[uncommanded_bleed]\nrate_m3_s = 3\n[gas]\nrate_m3_s = 4\nfrom_s = 5\n\
         [drain]\npower_w = 6\nfrom_s = 7\n[battery]\nresistance_ohm = 8\ndroop = 0.9\n\
         [stuck]\nrotation = [[10, 11]]\naxial = [[12, 13]]\n\
         [sensors]\ngps_noise_m = 20\ngps_acquisition_s = 21\nmodem_acquisition_s = 22\npot_noise = 0.23\n\
         [sensors.pressure]\nrange_over_crush = 30\nnoise_pa = 31\nbias_pa = 32\ndrift_pa_h = 33\ncreep = 0.34\n\
         creep_s = 35\nzeroing_s = 36\n\
         [sensors.compass]\ntilt_noise_deg = 40\nheading_noise_deg = 41\nrate_noise_deg_s = 42\ntilt_bias_deg = 43\n\
         heading_bias_deg = 44\nlag_s = 45\nearth_ut = 46\nbattery_ut_m = 47\nbattery_roll_ut = 48\ndepth_ut_km = 49\n\
         [sensors.altimeter]\nleast_m = 1\nmost_m = 50\nmount_deg = 51\nbeam_deg = 52\ndropout = 0.53\nnoise_m = 54\n\
         step_m = 55\n\
         [sensors.housekeeping]\nleak_noise_v = 60\nleak_glitches_per_h = 61\nvacuum_noise_pa = 62\n\
         voltage_noise_v = 63\ncharge_gain = 64\n",
    );
    let expected = FaultsFile {
        faults: Faults {
            leak: Seep { rate_m3_s: 1.0, from_s: 2.0 },
            uncommanded_bleed: Seep { rate_m3_s: 3.0, from_s: 0.0 },
            gas: Seep { rate_m3_s: 4.0, from_s: 5.0 },
            drain: Drain { power_w: 6.0, from_s: 7.0 },
            dropouts: Vec::new(),
            stuck: vec![
                Stuck { actuator: Actuator::Axial, from_s: 12.0, until_s: 13.0 },
                Stuck { actuator: Actuator::Rotation, from_s: 10.0, until_s: 11.0 },
            ],
        },
        sensor_errors: SensorErrors {
            pressure: PressureErrors {
                range_over_crush: 30.0,
                noise_pa: 31.0,
                bias_pa: 32.0,
                drift_pa_h: 33.0,
                creep: 0.34,
                creep_s: 35.0,
                zeroing_s: 36.0,
            },
            compass: CompassErrors {
                tilt_noise_deg: 40.0,
                heading_noise_deg: 41.0,
                rate_noise_deg_s: 42.0,
                tilt_bias_deg: 43.0,
                heading_bias_deg: 44.0,
                lag_s: 45.0,
                earth_ut: 46.0,
                battery_ut_m: 47.0,
                battery_roll_ut: 48.0,
                depth_ut_km: 49.0,
            },
            altimeter: AltimeterErrors {
                least_m: 1.0,
                most_m: 50.0,
                mount_deg: 51.0,
                beam_deg: 52.0,
                dropout: 0.53,
                noise_m: 54.0,
                step_m: 55.0,
            },
            housekeeping: HousekeepingErrors {
                leak_noise_v: 60.0,
                leak_glitches_per_h: 61.0,
                vacuum_noise_pa: 62.0,
                voltage_noise_v: 63.0,
                charge_gain: 64.0,
            },
            gps_noise_m: 20.0,
            gps_acquisition_s: 21.0,
            modem_acquisition_s: 22.0,
            pot_noise: 0.23,
        },
        cells: Cells { resistance_ohm: 8.0, droop: 0.9 },
    };
    assert_eq!(read.unwrap(), expected);
}

#[test]
fn every_instrument_may_drop_out_more_than_once() {
    let instruments = [
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
    for (key, instrument) in instruments {
        let faults = parse(&format!("[dropouts]\n{key} = [[10, 20], [30, 1e9]]\n")).unwrap().faults;
        let silent = [(10.0, 20.0), (30.0, 1e9)].map(|(from_s, until_s)| Dropout { instrument, from_s, until_s });
        assert_eq!(faults, Faults { dropouts: silent.to_vec(), ..Faults::default() });
        assert_eq!([9.9, 10.0, 20.0, 1e6].map(|time_s| faults.speaks(instrument, time_s)), [true, false, true, false]);
    }
}

#[test]
fn the_embedded_ones_are_what_their_names_say() {
    for (name, ..) in EMBEDDED {
        let file = FaultsFile::load(name).unwrap();
        assert_eq!(file == FaultsFile::default(), *name == "none", "{name}");
    }
    assert_eq!(FaultsFile::load("compass-deviation").unwrap().sensor_errors.compass, CompassErrors::uncalibrated());
}

#[test]
fn mistakes_are_answered_with_their_place() {
    let rows = [
        ("[leek]\nrate_m3_s = 1\n", "f.toml:1:2: unknown key `leek`; did you mean `leak`?"),
        ("[leak]\n", "f.toml:1:1: missing key `leak.rate_m3_s`: a number of 0 or more"),
        ("[leak]\nrate_m3_s = -1\n", "f.toml:2:13: `leak.rate_m3_s` is -1, but must be a number of 0 or more"),
        ("[dropouts]\npresure = [[0, 1]]\n", "f.toml:2:1: unknown key `presure`; did you mean `pressure`?"),
        (
            "[dropouts]\ngps = [[20, 10]]\n",
            "f.toml:2:7: `dropouts.gps` is [[20, 10]], but must be rows of [from, until] in s after the start, each until after \
             its from",
        ),
        ("[stuck]\naxial = 3\n", "f.toml:2:9: `stuck.axial` is 3, but must be rows of 2 finite numbers"),
        ("[sensors.compas]\n", "f.toml:1:10: unknown key `compas`; did you mean `compass`?"),
        (
            "[sensors.altimeter]\ndropout = 2\n",
            "f.toml:2:11: `sensors.altimeter.dropout` is 2, but must be a number from 0 to 1",
        ),
    ];
    for (text, expected) in rows {
        assert_eq!(parse(text).unwrap_err(), expected, "{text}");
    }
    let error = FaultsFile::load("lek").unwrap_err().to_string();
    assert!(
        error.starts_with("lek: not a readable file") && error.contains("`none`, `leak`, `dead-pressure`"),
        "{error}"
    );
}
