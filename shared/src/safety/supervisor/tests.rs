//! Each row just below and just beyond its limit, and what single samples cannot do.

use super::*;
use crate::mission::Course;
use heapless::Vec;

const SOUND: Measurements = Measurements {
    battery_mv: Some(14_800),
    charge_mc: Some(50_000_000),
    leak_mv: Some(2_500),
    vacuum_pa: Some(27_000),
    ..Measurements::silent()
};

const WELL: Vitals<'_> = Vitals {
    tick: 1_000,
    depth_mm: 150_000,
    depth_tick: 1_000,
    attitude_tick: 1_000,
    under_way: true,
    against_model: Some(false),
    measurements: &SOUND,
};

/// 100,000 C of battery, so that 90,000,000 mC may be drawn.
const PARAMETERS: fn() -> Parameters = || Parameters { battery_capacity_c: 100_000, ..Parameters::default() };

fn supervisor(parameters: &Parameters) -> Supervisor {
    let mission = Mission {
        yos: 1,
        surfacings: 1,
        dive_to_mm: 200_000,
        climb_to_mm: 3_000,
        dive_path_angle_cdeg: -2_600,
        climb_path_angle_cdeg: 2_600,
        dive_net_mass_g: 250,
        climb_net_mass_g: -250,
        course: Course::Headings(Vec::new()),
        drift_time_s: 0,
        flare_depth_mm: 0,
        surface_time_s: 0,
        altitude_mm: 0,
        abort_depth_mm: 215_000,
        max_duration_s: 3_600,
    };
    Supervisor::new(&mission, parameters)
}

fn judge(vitals: Vitals<'_>) -> Option<Abort> {
    supervisor(&PARAMETERS()).judge(&mut Watch::default(), &vitals)
}

/// What is said, sample by sample, of instruments that read these; the first of them is sample 1.
fn samples(said: impl IntoIterator<Item = Measurements>) -> std::vec::Vec<Option<Abort>> {
    let (supervisor, mut watch) = (supervisor(&PARAMETERS()), Watch::default());
    said.into_iter()
        .map(|measurements| supervisor.judge(&mut watch, &Vitals { measurements: &measurements, ..WELL }))
        .collect()
}

#[test]
fn a_healthy_dive_goes_on() {
    assert_eq!(judge(WELL), None);
    assert_eq!(
        judge(Vitals { measurements: &Measurements::silent(), ..WELL }),
        None,
        "what is not measured is not judged"
    );
}

#[test]
fn depth_time_and_silence_abort_just_beyond_their_limits() {
    assert_eq!(judge(Vitals { depth_mm: 215_000, ..WELL }), None);
    assert_eq!(judge(Vitals { depth_mm: 215_001, ..WELL }), Some(Abort::Overdepth));
    let late = 3_600 * TICK_HZ;
    let fresh = Vitals { depth_tick: late, attitude_tick: late, ..WELL };
    assert_eq!(judge(Vitals { tick: late, ..fresh }), None);
    assert_eq!(judge(Vitals { tick: late + 1, ..fresh }), Some(Abort::MissionTimeout));
    assert_eq!(judge(Vitals { depth_tick: 1_000 - 60 * TICK_HZ, ..WELL }), None);
    assert_eq!(judge(Vitals { depth_tick: 999 - 60 * TICK_HZ, ..WELL }), Some(Abort::StaleDepth));
    assert_eq!(judge(Vitals { attitude_tick: 1_000 - 120 * TICK_HZ, ..WELL }), None);
    assert_eq!(judge(Vitals { attitude_tick: 999 - 120 * TICK_HZ, ..WELL }), Some(Abort::StaleAttitude));
}

/// Readings at the limit, readings just beyond it, and the abort that these are.
const LIMITS: [(Measurements, Measurements, Abort); 5] = [
    (Measurements { leak_mv: Some(2_000), ..SOUND }, Measurements { leak_mv: Some(1_999), ..SOUND }, Abort::Leak),
    (
        Measurements { vacuum_pa: Some(13_546), ..SOUND },
        Measurements { vacuum_pa: Some(13_545), ..SOUND },
        Abort::Vacuum,
    ),
    (
        Measurements { vacuum_pa: Some(40_637), ..SOUND },
        Measurements { vacuum_pa: Some(40_638), ..SOUND },
        Abort::Vacuum,
    ),
    (
        Measurements { battery_mv: Some(10_000), ..SOUND },
        Measurements { battery_mv: Some(9_999), ..SOUND },
        Abort::Undervolts,
    ),
    (
        Measurements { charge_mc: Some(90_000_000), ..SOUND },
        Measurements { charge_mc: Some(90_000_001), ..SOUND },
        Abort::LowCharge,
    ),
];

#[test]
fn what_is_sampled_aborts_beyond_its_limit_with_the_tenth_consecutive_sample() {
    for (at, beyond, abort) in LIMITS {
        assert_eq!(samples([at; 100]), [None; 100], "{abort:?} at its limit");
        let said = samples([beyond; 10]);
        assert_eq!((&said[..9], said[9]), (&[None; 9][..], Some(abort)));
    }
}

#[test]
fn glitches_abort_nothing_and_silence_hides_nothing() {
    for (_, beyond, abort) in LIMITS {
        let glitches = (0..1_000).map(|sample| if sample % 10 == 0 { SOUND } else { beyond });
        assert!(samples(glitches).iter().all(Option::is_none), "{abort:?}: nine of ten samples are bad");
        let gaps = (0..20).map(|sample| if sample % 2 == 0 { Measurements::silent() } else { beyond });
        assert_eq!(samples(gaps)[19], Some(abort), "the tenth sample of twenty ticks");
    }
}

#[test]
fn a_battery_of_unknown_capacity_is_never_low() {
    let supervisor = supervisor(&Parameters { abort_samples: 1, ..Parameters::default() });
    let drained = Measurements { charge_mc: Some(i64::MAX), ..SOUND };
    assert_eq!(supervisor.judge(&mut Watch::default(), &Vitals { measurements: &drained, ..WELL }), None);
}

/// The last word after `seconds` at depths given over time in seconds.
fn after(seconds: u32, under_way: bool, depth_mm: impl Fn(u32) -> i32) -> Option<Abort> {
    let (supervisor, mut watch) = (supervisor(&PARAMETERS()), Watch::default());
    let mut said = None;
    for tick in 0..=seconds.saturating_mul(TICK_HZ) {
        let depth_mm = depth_mm(tick.div_euclid(TICK_HZ));
        said = supervisor
            .judge(&mut watch, &Vitals { tick, depth_mm, depth_tick: tick, attitude_tick: tick, under_way, ..WELL });
    }
    said
}

#[test]
fn a_vehicle_that_hangs_at_one_depth_is_called_home() {
    let hangs = |_| 100_000;
    assert_eq!(after(900, true, hangs), None);
    assert_eq!(after(901, true, hangs), Some(Abort::NoVerticalMotion));
    assert_eq!(after(3_600, false, hangs), None, "at the surface it may");
    // Carried up and down by 3 m it still hangs; sinking 3 m and a bit in a quarter of an hour is motion.
    let carried = |second: u32| if second % 600 < 300 { 100_000 } else { 103_000 };
    assert_eq!(after(901, true, carried), Some(Abort::NoVerticalMotion));
    assert_eq!(after(3_600, true, |second| 100_000 + i32::try_from(second).unwrap() * 3_010 / 900), None);
}

#[test]
fn the_gravest_reason_is_given_first() {
    let all = Vitals { tick: 1_000_000, depth_mm: 300_000, depth_tick: 0, attitude_tick: 0, ..WELL };
    assert_eq!(judge(all), Some(Abort::Overdepth));
    let wet = Measurements { leak_mv: Some(0), ..SOUND };
    let parameters = Parameters { abort_samples: 1, ..Parameters::default() };
    let said = supervisor(&parameters).judge(&mut Watch::default(), &Vitals { measurements: &wet, ..all });
    assert_eq!(said, Some(Abort::Leak));
}

#[test]
fn a_minute_against_the_model_aborts_and_a_moment_with_it_begins_anew() {
    let supervisor = supervisor(&PARAMETERS());
    let mut watch = Watch::default();
    let mut judge = |against| supervisor.judge(&mut watch, &Vitals { against_model: against, ..WELL });
    for against in [Some(true), None] {
        for _ in 1..60 * TICK_HZ {
            assert_eq!(judge(against), None);
        }
    }
    assert_eq!(judge(Some(false)), None);
    for _ in 1..60 * TICK_HZ {
        assert_eq!(judge(Some(true)), None);
    }
    assert_eq!(judge(Some(true)), Some(Abort::AgainstModel));
}
