//! The drivers against simulated devices: rates, end stops, stale orders, faults, safe states.

use firmware::{
    BEAT_HZ, TRIM_TABLE,
    calibration::{Counts, Implausible},
    order::ORDER_LIFE_BEATS,
    pump::{Fault, Pump},
};
use hil_tests::devices::{Devices, Pin, Piston, Pwm, Slide};
use shared::{commands::Commands, model::table::TrimTable};

const BROKEN_WIRE: Counts = Counts(0);

fn devices() -> Devices {
    Devices::new(&TrimTable::parse(TRIM_TABLE).unwrap().vehicle().actuators)
}

/// Runs a device for some beats, its order renewed at every one.
fn pump_for(beats: u32, rate_ul_s: i32, piston: &mut Piston, driver: &mut Pump<Pwm, Pin>) {
    for _ in 0..beats {
        driver.order(rate_ul_s);
        driver.beat(piston.reading()).unwrap();
        piston.advance();
    }
}

#[test]
fn the_pump_moves_what_was_ordered() {
    let mut piston = devices().piston;
    let mut driver = piston.driver();
    let full = piston.calibration.full_pump_ul_s;
    for share in [1, 2, 3, 10] {
        let before = piston.volume_ul;
        pump_for(BEAT_HZ, full / share, &mut piston, &mut driver);
        let (moved, ordered) = (piston.volume_ul - before, f64::from(full / share));
        // A step of duty is a thousandth of full flow.
        assert!((moved - ordered).abs() <= f64::from(full) / 1_000.0, "{moved} µl instead of {ordered}");
    }
}

#[test]
fn the_valve_bleeds_what_was_ordered_in_whole_beats() {
    let mut piston = devices().piston;
    let mut driver = piston.driver();
    let full = piston.calibration.full_bleed_ul_s;
    for share in [1, 2, 3, 10] {
        let before = piston.volume_ul;
        pump_for(BEAT_HZ, -full / share, &mut piston, &mut driver);
        pump_for(1, 0, &mut piston, &mut driver);
        let (moved, ordered) = (piston.volume_ul - before, f64::from(-full / share));
        assert!((moved - ordered).abs() <= f64::from(full) / f64::from(BEAT_HZ), "{moved} µl instead of {ordered}");
    }
}

#[test]
fn nothing_runs_past_an_end_stop() {
    // Every device checks its own travel at every beat.
    let mut devices = devices();
    let mut drivers = devices.drivers();
    for sign in [1, -1, 1] {
        let commands = Commands {
            vbd_rate_ul_s: sign * i32::MAX,
            r_px_rate_um_s: sign * i32::MAX,
            mu_rate_cdeg_s: i16::try_from(sign).unwrap() * i16::MAX,
            ..Commands::safe()
        };
        for _ in 0..120 * BEAT_HZ {
            drivers.order(&commands);
            drivers.beat(&devices.readings());
            devices.advance();
        }
        let arrived = |position: f64, travel: shared::model::vehicle::Range| {
            let stop = f64::from(if sign > 0 { travel.max } else { travel.min });
            (position - stop).abs() / f64::from(travel.max - travel.min) < 0.01
        };
        assert!(arrived(devices.piston.volume_ul, devices.piston.calibration.travel_ul), "{devices:?}");
        assert!(arrived(devices.axial.position, devices.axial.calibration.travel), "{devices:?}");
        assert!(arrived(devices.rotation.position, devices.rotation.calibration.travel), "{devices:?}");
    }
}

#[test]
fn the_mass_moves_what_was_ordered_and_is_braked_at_rest() {
    for mut slide in [devices().axial, devices().rotation] {
        let mut driver = slide.driver();
        for rate in [slide.calibration.full_rate, -slide.calibration.full_rate / 3] {
            let before = slide.position;
            run(BEAT_HZ, rate, &mut slide, &mut driver);
            let moved = slide.position - before;
            let tolerance = f64::from(slide.calibration.full_rate) / 1_000.0;
            assert!((moved - f64::from(rate)).abs() <= tolerance, "{moved} instead of {rate}");
        }
        run(1, 0, &mut slide, &mut driver);
        assert!(slide.motor.0.get() == 0 && !slide.brake.high.get(), "not braked");
    }
}

fn run(beats: u32, rate: i32, slide: &mut Slide, driver: &mut firmware::mass::Axis<Pwm, Pin>) {
    for _ in 0..beats {
        driver.order(rate);
        driver.beat(slide.reading()).unwrap();
        slide.advance();
    }
}

#[test]
fn without_new_orders_everything_stops() {
    for sign in [1, -1] {
        let mut devices = devices();
        let mut drivers = devices.drivers();
        let commands = Commands {
            vbd_rate_ul_s: sign * 42_000,
            r_px_rate_um_s: sign * 5_000,
            mu_rate_cdeg_s: 500,
            ..Commands::safe()
        };
        drivers.order(&commands);
        for beat in 0..=ORDER_LIFE_BEATS {
            drivers.beat(&devices.readings());
            assert_eq!(devices.are_safe(), beat == ORDER_LIFE_BEATS, "at beat {beat}");
            devices.advance();
        }
    }
}

#[test]
fn a_broken_potentiometer_stops_its_own_actuator_only() {
    let devices = devices();
    let mut drivers = devices.drivers();
    let commands = Commands { vbd_rate_ul_s: 10_000, r_px_rate_um_s: 5_000, mu_rate_cdeg_s: 500, ..Commands::safe() };
    drivers.order(&commands);
    drivers.beat(&devices.readings());
    assert!(devices.piston.motor.0.get() > 0 && devices.axial.motor.0.get() > 0);
    let mut readings = devices.readings();
    readings.vbd = BROKEN_WIRE;
    drivers.beat(&readings);
    assert_eq!(devices.piston.motor.0.get(), 0);
    assert!(devices.axial.motor.0.get() > 0);
    drivers.beat(&devices.readings());
    assert_eq!(devices.piston.motor.0.get(), 0, "a fault ends the order");
    drivers.order(&commands);
    drivers.beat(&devices.readings());
    assert!(devices.piston.motor.0.get() > 0, "it works again");
}

#[test]
fn a_fault_says_what_was_read() {
    let piston = devices().piston;
    let fault = piston.driver().beat(BROKEN_WIRE).unwrap_err();
    assert_eq!(fault, Fault::Potentiometer(Implausible(BROKEN_WIRE)));
}

#[test]
fn safe_is_tried_everywhere_even_if_one_output_is_broken() {
    let devices = devices();
    let mut drivers = devices.drivers();
    let commands = Commands { vbd_rate_ul_s: 10_000, r_px_rate_um_s: 5_000, mu_rate_cdeg_s: 500, ..Commands::safe() };
    drivers.order(&commands);
    drivers.beat(&devices.readings());
    assert!(!devices.are_safe());
    devices.axial.brake.broken.set(true);
    drivers.make_safe();
    assert_eq!([&devices.piston.motor, &devices.axial.motor, &devices.rotation.motor].map(|pwm| pwm.0.get()), [0; 3]);
    assert!(!devices.rotation.brake.high.get());
    devices.axial.brake.broken.set(false);
    drivers.make_safe();
    assert!(devices.are_safe());
}
