//! Devices that misbehave, in closed loop.

use shared::{autopilot::Autopilot, commands::Phase, device::Measurements, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{
        CompassErrors, Dropout, Faults, FlyingVehicle, Instrument, Outcome, Seep, Summary, fly,
        mission_file::MissionFile,
    },
    model::{
        ocean::Ocean,
        vehicle::{EngineKind, Vehicle},
    },
};

/// Flies the default mission with a changed vehicle and changed devices; shows every tick's pressure and buoyancy.
fn fly_with(
    seed: u64,
    change: impl FnOnce(&mut Vehicle),
    devices: impl FnOnce(&mut FlyingVehicle<'_>),
    mut observe: impl FnMut(&sim_host::flight::Tick<'_>),
) -> Summary {
    let file = MissionFile::load("default").unwrap();
    let mut vehicle = Vehicle::load(&file.vehicle).unwrap();
    change(&mut vehicle);
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let mut flying = FlyingVehicle::new(&vehicle).unwrap();
    devices(&mut flying);
    fly(&flying, &Ocean::still(&vehicle.water), &file.mission, &file.start, seed, &mut autopilot, &mut observe).unwrap()
}

#[test]
fn the_electrical_energy_of_the_pump_is_its_ideal_work_over_a_fielded_efficiency() {
    let mut work_j = 0.0;
    let mut before = None;
    let summary = fly_with(
        1,
        |_| {},
        |_| {},
        |tick| {
            let (volume, depth_m) = (tick.state.displaced_volume_m3, tick.state.position_m.z.max(0.0));
            if let Some((volume_before, depth_before_m)) = before.replace((volume, depth_m)) {
                work_j += 1000.0 * 9.81 * depth_before_m * f64::max(volume - volume_before, 0.0);
            }
        },
    );
    assert!((summary.pump_work_j / work_j - 1.0).abs() < 1e-9, "p ΔV is {work_j} J, recorded {}", summary.pump_work_j);
    // Fielded pumps: 3 to 8 % above 100 m, 27 to 40 % in 500 to 1000 m; 200 m lie between.
    let efficiency = summary.pump_work_j / summary.energy_j.pump;
    assert!((0.03..0.27).contains(&efficiency), "{efficiency}");
    // All energy went through the terminals, whose voltage is a little below the battery's 15 V.
    let mean_v = summary.energy_j.total() / summary.charge_c;
    assert!((13.5..15.0).contains(&mean_v), "{mean_v} V on the average");
}

#[test]
fn a_bladder_dives_by_its_vacuum_and_stays_up_without_one() {
    let bladder = |vacuum_pa| {
        move |vehicle: &mut Vehicle| {
            vehicle.buoyancy.as_mut().unwrap().engine.kind = EngineKind::Bladder { vacuum_pa, full_bleed_head_pa: 1e5 };
        }
    };
    let summary = fly_with(1, bladder(27e3), |_| {}, |_| {});
    assert_eq!(summary.outcome, Outcome::Completed);
    assert!((summary.max_depth_m - 200.0).abs() < 5.0, "as deep as the piston: {} m", summary.max_depth_m);
    // An overpressure of 1 m of water is more than the engine's depth while it floats.
    let afloat = fly_with(1, bladder(-1e4), |_| {}, |_| {});
    assert!(afloat.max_depth_m < 1.0, "{} m", afloat.max_depth_m);
}

#[test]
fn a_pump_that_is_weaker_at_depth_and_a_dead_zone_change_the_dive_but_do_not_end_it() {
    let change = |vehicle: &mut Vehicle| {
        let engine = &mut vehicle.buoyancy.as_mut().unwrap().engine;
        engine.kind = EngineKind::Piston { dead_zone_m3: 42e-6 };
        engine.pump_rate_at = vec![[0.0, 42e-6], [2e6, 21e-6]];
        engine.bleed_power_w = 2.0;
        engine.pot_noise_m3 = 1e-7;
    };
    let summary = fly_with(1, change, |_| {}, |_| {});
    assert_eq!(summary.outcome, Outcome::Completed);
    assert!((200.0..215.0).contains(&summary.max_depth_m), "{} m", summary.max_depth_m);
}

#[test]
fn a_leak_makes_it_heavy_and_the_pot_does_not_know() {
    // 20 g at 1 MPa per minute, for half an hour, and a leak detector that says nothing.
    let dead = Dropout { instrument: Instrument::Leak, from_s: 0.0, until_s: 1e9 };
    let leak = Faults { leak: Seep { rate_m3_s: 0.3e-6, from_s: 300.0 }, dropouts: vec![dead], ..Faults::default() };
    let mut shown_less_true_ul = 0.0;
    let neutral_m3 = Vehicle::load("slocum-paper").unwrap().neutral_volume_m3();
    fly_with(
        1,
        |_| {},
        |flying| flying.faults = leak,
        |tick| {
            let truth_ul = 1e9 * (tick.state.displaced_volume_m3 - neutral_m3);
            shown_less_true_ul = f64::from(tick.measurements.vbd_ul) - truth_ul;
        },
    );
    assert!(shown_less_true_ul > 1e5, "{shown_less_true_ul} µl of water are not seen");
}

#[test]
fn a_silent_pressure_sensor_aborts_the_mission_and_it_comes_up() {
    let gap = |until_s| Faults {
        dropouts: vec![Dropout { instrument: Instrument::Pressure, from_s: 400.0, until_s }],
        ..Faults::default()
    };
    let short = fly_with(1, |_| {}, |flying| flying.faults = gap(430.0), |_| {});
    assert_eq!(short.outcome, Outcome::Completed, "half of the time that the controller waits");
    let mut depth_m = f64::MAX;
    let long = fly_with(1, |_| {}, |flying| flying.faults = gap(1e9), |tick| depth_m = tick.state.position_m.z);
    assert_eq!((long.outcome, long.aborts), (Outcome::Aborted, vec!["StaleDepth".to_string()]));
    assert!(depth_m < 1.0, "back at the surface, not {depth_m} m deep");
}

/// A drop-out silences one instrument and changes no other's errors.
#[test]
fn what_is_not_heard_draws_its_noise_all_the_same() {
    let attitudes = |faults: Faults| {
        let mut seen = Vec::new();
        fly_with(
            4,
            |_| {},
            |flying| flying.faults = faults,
            |tick| {
                seen.push((tick.measurements.attitude, tick.measurements.pressure_pa));
            },
        );
        seen
    };
    let gps = Dropout { instrument: Instrument::Gps, from_s: 0.0, until_s: 50.0 };
    let (sound, silent) =
        (attitudes(Faults::default()), attitudes(Faults { dropouts: vec![gps], ..Faults::default() }));
    // The mission starts after a minute at the surface; until then it does the same, position or not.
    assert_eq!(sound[..200], silent[..200]);
}

/// Errors of one instrument, and how often it draws, are its own affair.
#[test]
fn a_worse_instrument_makes_no_other_worse() {
    let flown = |devices: fn(&mut FlyingVehicle<'_>)| {
        let mut seen = Vec::new();
        fly_with(4, |_| {}, devices, |tick| seen.push(*tick.measurements));
        seen
    };
    let usual = flown(|_| {});
    let worse = flown(|flying| {
        flying.sensor_errors.housekeeping.voltage_noise_v = 0.2;
        flying.sensor_errors.altimeter.dropout = 0.9;
    });
    assert!(usual.iter().zip(&worse).any(|(usual, worse)| usual.battery_mv != worse.battery_mv));
    let but_voltage = |seen: &[Measurements]| -> Vec<Measurements> {
        seen.iter().map(|said| Measurements { battery_mv: None, ..*said }).collect()
    };
    assert!(but_voltage(&usual) == but_voltage(&worse), "all else to the last bit");
}

/// Satellites and modem are heard only with the antenna in air, each after its own time.
#[test]
fn under_water_nothing_is_heard_from_shore() {
    let mut heard = Vec::new();
    fly_with(
        1,
        |_| {},
        |_| {},
        |tick| heard.push((tick.state.position_m.z, tick.measurements.modem_up, tick.measurements.gps.is_some())),
    );
    assert!(heard.iter().filter(|(depth_m, ..)| *depth_m > 2.0).all(|(_, modem, gps)| !modem && !gps));
    let first = |of: fn(&(f64, bool, bool)) -> bool| heard.iter().position(of);
    assert_eq!((first(|(_, modem, _)| *modem), first(|(.., gps)| *gps)), (Some(10 * 4 - 1), Some(20 * 4 - 1)));
    assert!(heard.last().is_some_and(|(_, modem, gps)| *modem && *gps), "and again in the end");
}

/// The battery's terminals under the pump's load, at rest, and after it.
#[test]
fn voltage_sags_while_the_pump_works_at_depth() {
    let mut sagged = Vec::new();
    fly_with(
        1,
        |_| {},
        |flying| flying.sensor_errors.housekeeping.voltage_noise_v = 0.0,
        |tick| {
            if tick.commands.phase == Phase::Apogee {
                sagged.push(f64::from(tick.measurements.battery_mv.unwrap()) / 1e3);
            }
        },
    );
    // 660 W of pump at 200 m through 0.03 Ω: V (15 − V) = 660 × 0.03, so 13.5 V.
    let least_v = sagged.iter().copied().fold(f64::MAX, f64::min);
    assert!((least_v - 13.5).abs() < 0.1, "{least_v} V");
    assert!(sagged[0] > 14.9, "before the pump starts: {} V", sagged[0]);
}

#[test]
fn an_uncalibrated_compass_misses_the_place_by_tens_of_degrees_and_still_comes_home() {
    let miss = |errors: CompassErrors| {
        let summary = fly_with(3, |_| {}, |flying| flying.sensor_errors.compass = errors, |_| {});
        assert_eq!(summary.outcome, Outcome::Completed);
        let (predicted, actual) = (summary.surfacing.predicted.unwrap(), summary.surfacing.actual.unwrap());
        (predicted.north_m - actual.north_m).hypot(predicted.east_m - actual.east_m)
    };
    let (calibrated, raw) = (miss(CompassErrors::default()), miss(CompassErrors::uncalibrated()));
    assert!(raw > 3.0 * calibrated, "{raw:.0} m against {calibrated:.0} m");
}
