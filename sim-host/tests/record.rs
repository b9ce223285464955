//! A record reads back to the same values from every format.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use std::path::Path;

use nalgebra::Vector3;
use parquet::{
    file::reader::{FileReader, SerializedFileReader},
    record::Field,
};
use shared::{
    commands::{Abort, Commands, Phase},
    device::{Attitude, GpsFix, Measurements},
};
use sim_host::{
    flight::{
        EnergyUsed,
        mission_file::Start,
        record::{COLUMNS, Record, Sample, Truth, Value},
    },
    model::{ocean, plant::Surroundings, vehicle::Water},
};

fn record() -> Record {
    let start = Start { latitude_deg: 59.0, longitude_deg: 179.999, heading_deg: 0.0 };
    let water = Water { density_kg_m3: 1025.0, gravity_m_s2: 9.81, kinematic_viscosity_m2_s: 1e-6 };
    Record { start, water, samples: (0..40).map(sample).collect() }
}

/// With temperature and salinity on even ticks.
fn water(tick: u32) -> ocean::Sample {
    let even = tick.is_multiple_of(2);
    let around = Surroundings {
        density_kg_m3: 1027.0 + f64::from(tick),
        pressure_pa: 1e5,
        temperature_c: even.then_some(7.5),
        surface_m: 0.0,
        current_m_s: Vector3::new(0.1, -0.2, 1e-3 * f64::from(tick)),
        unrest: None,
    };
    ocean::Sample { around, salinity: even.then_some(35.1) }
}

/// Something else in every field, nothing where there may be nothing.
fn sample(tick: u32) -> Sample {
    let x = f64::from(tick);
    let phases = [Phase::Surface, Phase::Dive, Phase::Apogee, Phase::Climb, Phase::Crest, Phase::Recovery];
    let small = i16::try_from(tick).unwrap();
    Sample {
        tick,
        measurements: Measurements {
            pressure_pa: (!tick.is_multiple_of(3)).then_some(1_000 * i32::from(small)),
            attitude: (!tick.is_multiple_of(5)).then_some(Attitude {
                roll_cdeg: -small,
                pitch_cdeg: 7 * small,
                heading_cdeg: 35_900 + small.unsigned_abs(),
                pitch_rate_cdeg_s: small,
                yaw_rate_cdeg_s: -3 * small,
            }),
            r_px_um: -191_234,
            mu_cdeg: 10 * small,
            vbd_ul: -250_000,
            battery_mv: (!tick.is_multiple_of(6)).then_some(15_000),
            charge_mc: (tick > 1).then_some(5_000_000_000 * i64::from(tick)),
            altitude_mm: tick.is_multiple_of(4).then_some(90_000 - i32::from(small)),
            leak_mv: tick.is_multiple_of(2).then_some(2_500),
            vacuum_pa: tick.is_multiple_of(3).then_some(-27_000),
            gps: (tick < 4).then_some(GpsFix { lat_e7: 590_000_001, lon_e7: -1_799_999_999 }),
            modem_up: tick < 3,
        },
        commands: Commands {
            r_px_rate_um_s: 10_000,
            phase: phases[tick as usize % phases.len()],
            yo: if tick == 0 { 0 } else { 1 + u16::try_from(tick / 10).unwrap() },
            abort: (tick > 30).then_some(Abort::StaleDepth),
            north_mm: 1_234 * i32::from(small),
            east_mm: 5_678 * i32::from(small),
            ..Commands::safe()
        },
        truth: Truth {
            position_m: Vector3::new(0.1 * x, -1e-9 * x, 1.0 / (1.0 + x)),
            euler_rad: Vector3::new(0.1, -0.4, 3.0),
            velocity_m_s: Vector3::new(0.7, if tick == 7 { f64::NAN } else { 0.01 }, 0.02),
            ground_velocity_m_s: Vector3::new(0.6, 0.1, 0.3),
            water: water(tick),
            floor_depth_m: tick.is_multiple_of(2).then_some(100.5),
            rate_rad_s: Vector3::new(1e-20, 0.0, -1e300),
            r_px_m: 0.191_234_567_890_123,
            mu_rad: 0.5,
            displaced_volume_m3: 0.05,
        },
        energy_j: EnergyUsed { pump: x * x, pitch: x, roll: 0.5 * x, hotel: 2.0 * x },
        pump_work_j: 0.1 * x * x,
        charge_c: x / 15.0,
    }
}

/// A value as any format should give it back.
#[derive(Debug, PartialEq)]
enum Cell {
    Null,
    Integer(i64),
    Real(f64),
    Text(String),
}

fn expected(record: &Record, sample: &Sample, value: Value) -> Cell {
    let cell = match value {
        Value::Integer(get) => get(sample).map(Cell::Integer),
        Value::Real(get) => get(record, sample).filter(|value| value.is_finite()).map(Cell::Real),
        Value::Text(get) => get(sample).map(Cell::Text),
    };
    cell.unwrap_or(Cell::Null)
}

/// Compares rows of cells with the record.
fn assert_is_record(rows: impl Iterator<Item = Vec<Cell>>) {
    let record = record();
    let mut count = 0;
    for (sample, row) in record.samples.iter().zip(rows) {
        assert_eq!(row.len(), COLUMNS.len());
        for (column, cell) in COLUMNS.iter().zip(row) {
            assert_eq!(cell, expected(&record, sample, column.value), "{} at tick {}", column.name, sample.tick);
        }
        count += 1;
    }
    assert_eq!(count, record.samples.len());
}

fn in_folder(check: impl FnOnce(&Path)) {
    let folder = tempfile::tempdir().unwrap();
    check(folder.path());
    let names: Vec<_> = folder.path().read_dir().unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names.len(), 1, "nothing but the record is left behind: {names:?}");
}

#[test]
fn csv_reads_back_to_the_same_values() {
    in_folder(|folder| {
        let path = folder.join("record.csv");
        record().write_csv(&path).unwrap();
        let mut csv = csv::Reader::from_path(&path).unwrap();
        assert!(csv.headers().unwrap().iter().eq(COLUMNS.iter().map(|column| column.name)));
        assert_is_record(csv.records().map(|row| {
            let row = row.unwrap();
            let cells = COLUMNS.iter().zip(row.iter()).map(|(column, text)| match column.value {
                _ if text.is_empty() => Cell::Null,
                Value::Integer(_) => Cell::Integer(text.parse().unwrap()),
                Value::Real(_) => Cell::Real(text.parse().unwrap()),
                Value::Text(_) => Cell::Text(text.to_owned()),
            });
            cells.collect()
        }));
    });
}

#[test]
fn parquet_reads_back_to_the_same_values_and_says_what_they_mean() {
    in_folder(|folder| {
        let path = folder.join("record.parquet");
        record().write_parquet(&path).unwrap();
        let parquet = SerializedFileReader::new(std::fs::File::open(&path).unwrap()).unwrap();
        let metadata = parquet.metadata().file_metadata().key_value_metadata().unwrap().clone();
        for column in COLUMNS {
            let about = metadata.iter().find(|pair| pair.key == column.name).unwrap().value.as_deref();
            assert_eq!(about, Some(column.about));
        }
        assert_is_record(parquet.get_row_iter(None).unwrap().map(|row| {
            let row = row.unwrap();
            let cells = COLUMNS.iter().zip(row.get_column_iter()).map(|(column, (name, field))| {
                assert_eq!(name, column.name);
                match field {
                    Field::Null => Cell::Null,
                    Field::Long(value) => Cell::Integer(*value),
                    Field::Double(value) => Cell::Real(*value),
                    Field::Str(value) => Cell::Text(value.clone()),
                    other => panic!("{name} is {other:?}"),
                }
            });
            cells.collect()
        }));
    });
}

#[test]
fn og1_columns_are_in_og1_units() {
    let record = record();
    let cell = |tick: usize, name: &str| {
        let column = COLUMNS.iter().find(|column| column.name == name).unwrap();
        expected(&record, &record.samples[tick], column.value)
    };
    assert_eq!(cell(4, "PRES"), Cell::Real(0.4));
    assert_eq!(cell(4, "DEPTH"), Cell::Real(4_000.0 / (1025.0 * 9.81)));
    assert_eq!(cell(4, "PITCH"), Cell::Real(0.28));
    assert_eq!(cell(1, "LONGITUDE_GPS"), Cell::Real(-179.999_999_9));
    // 39 · 5.678 m east on the 59th parallel, across the date line.
    let Cell::Real(longitude) = cell(39, "LONGITUDE") else { panic!("a longitude is a number") };
    assert!((longitude + 179.997_133).abs() < 1e-6, "{longitude}");
    let codes = [(3, 0), (2, 1), (5, 1), (1, 2), (5, 2), (3, 2)];
    for (tick, (phase, profile)) in codes.into_iter().enumerate() {
        assert_eq!(cell(tick, "PHASE"), Cell::Integer(phase), "tick {tick}");
        assert_eq!(cell(tick, "PROFILE_NUMBER"), Cell::Integer(profile), "tick {tick}");
    }
}

#[test]
fn a_folder_that_is_not_there_is_named() {
    let message = record().write_csv(Path::new("/no/such/folder/record.csv")).unwrap_err();
    assert!(message.starts_with("/no/such/folder/record.csv: "), "{message}");
}
