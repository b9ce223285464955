//! The reduced model against the full plant, in both arithmetics, and the proof that fixed point does not overflow.

mod common;

use common::Interval;
use shared::{
    autopilot::Autopilot,
    mission::{Course, Phase},
    number::{Fixed, Number},
    reduced::{Drive, Model, Motion, limits},
    table::TrimTable,
    vehicle::GlideConstants,
};
use sim_host::{
    flight::{FlyingVehicle, fly},
    mission_file::MissionFile,
    ocean::Ocean,
    plant::{Plant, State, euler_from_quaternion},
    table::{Envelope, flight_vehicle, generate},
    trim::{Condition, Scale, glide},
    vehicle::Vehicle,
};

const TICK_S: f32 = 0.25;

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn model<N: Number>(vehicle: &Vehicle) -> Model<N> {
    let flying = flight_vehicle(vehicle, &Envelope::default()).unwrap();
    Model::new(&flying.glide, flying.gravity_m_s2, TICK_S)
}

/// One tick of a flight as the truth has it.
#[derive(Clone, Copy)]
struct Truth {
    phase: Phase,
    state: State<f64>,
    density_kg_m3: f64,
    net_mass_kg: f64,
    reference_density_kg_m3: f64,
}

impl Truth {
    fn drive<N: Number>(&self) -> Drive<N> {
        let euler = euler_from_quaternion(&self.state.quaternion);
        let number = |value: f64| N::new(value as f32);
        Drive {
            pitch_rad: number(euler.y),
            roll_rad: number(euler.x),
            pitch_rate_rad_s: number(self.state.rate_rad_s.y),
            r_px_m: number(self.state.r_px_m),
            net_mass_kg: number(self.net_mass_kg),
            density_ratio: number(self.density_kg_m3 / self.reference_density_kg_m3),
        }
    }

    fn speed_m_s(&self) -> f64 {
        self.state.velocity_m_s.norm()
    }
}

/// Every tick of a mission under water.
fn flown(vehicle: &Vehicle, ocean: &Ocean, change: impl FnOnce(&mut MissionFile)) -> Vec<Truth> {
    let mut file = MissionFile::load("default").unwrap();
    change(&mut file);
    let bytes = generate(vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(vehicle).unwrap();
    let mut truth = Vec::new();
    fly(&flying, ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
        let density_kg_m3 = tick.water.around.density_kg_m3;
        truth.push(Truth {
            phase: tick.commands.phase,
            state: *tick.state,
            density_kg_m3,
            net_mass_kg: vehicle.mass_kg() - density_kg_m3 * tick.state.displaced_volume_m3,
            reference_density_kg_m3: vehicle.water.density_kg_m3,
        });
    })
    .unwrap();
    truth.retain(|t| t.state.position_m.z > 3.0);
    truth
}

/// Largest error of speed, m/s, and of depth, m, over a stretch of a flight that the model enters at the true velocity.
fn errors<N: Number>(vehicle: &Vehicle, stretch: &[Truth]) -> (f64, f64) {
    let model = model::<N>(vehicle);
    let first = stretch[0].state.velocity_m_s;
    let mut motion = Motion::new(N::new(first.x as f32), N::new(first.z as f32));
    let mut depth_m = stretch[0].state.position_m.z;
    let mut before_m_s = 0.0;
    let (mut of_speed, mut of_depth) = (0.0_f64, 0.0_f64);
    for (i, truth) in stretch.iter().enumerate() {
        let drive = truth.drive::<N>();
        if i > 0 {
            motion = model.step(&motion, &drive);
        }
        let sink_m_s = f64::from(motion.sink_rate_m_s(drive.pitch_rad, drive.roll_rad).value());
        if i > 0 {
            depth_m += 0.5 * f64::from(TICK_S) * (before_m_s + sink_m_s);
        }
        before_m_s = sink_m_s;
        of_speed = of_speed.max((f64::from(motion.speed_m_s().value()) - truth.speed_m_s()).abs());
        of_depth = of_depth.max((depth_m - truth.state.position_m.z).abs());
    }
    (of_speed, of_depth)
}

/// From 20 s before an inflection to 60 s after it.
fn inflections(flight: &[Truth]) -> Vec<&[Truth]> {
    let begins =
        |phase: Phase| flight.windows(2).position(move |pair| pair[0].phase != phase && pair[1].phase == phase);
    let ends = |phase: Phase| flight.windows(2).rposition(move |pair| pair[0].phase == phase && pair[1].phase != phase);
    [Phase::Apogee, Phase::Crest]
        .into_iter()
        .filter_map(|phase| Some(&flight[begins(phase)? - 80..ends(phase)? + 240]))
        .collect()
}

/// Net mass, slope: the corners and the middle of the envelope.
#[test]
fn steady_glides_are_the_plants() {
    let vehicle = slocum();
    let worst = |settle: fn(&Vehicle, &sim_host::trim::Glide) -> f64| {
        let mut worst = 0.0_f64;
        for path_angle_deg in [-35.0_f64, -26.0, -12.0, 12.0, 26.0, 40.0] {
            for net_mass_kg in [0.05, 0.25, 0.6] {
                let condition = Condition::PathAngle(path_angle_deg.to_radians());
                let exact = glide(&vehicle, condition, Scale::NetMass(-path_angle_deg.signum() * net_mass_kg)).unwrap();
                worst = worst.max(settle(&vehicle, &exact));
            }
        }
        worst
    };
    let (float, fixed) = (worst(settled::<f32>), worst(settled::<Fixed>));
    println!("steady glides, worst error of speed: f32 {:.1e} m/s, fixed {:.1e} m/s", float, fixed);
    // f32 carries 1.3 m/s to 1.2e-7 and a balance of a few such terms; in fixed point, a step of 9.5e-7 a tick against
    // a time constant of 35 s at the lightest leaves 1e-4 m/s.
    assert!(float < 5e-6);
    assert!(fixed < 3e-4);
}

fn settled<N: Number>(vehicle: &Vehicle, exact: &sim_host::trim::Glide) -> f64 {
    let model = model::<N>(vehicle);
    let drive = Drive {
        pitch_rad: N::new(exact.pitch_rad as f32),
        roll_rad: N::new(0.0),
        pitch_rate_rad_s: N::new(0.0),
        r_px_m: N::new(exact.r_px_m as f32),
        net_mass_kg: N::new(exact.net_mass_kg as f32),
        density_ratio: N::new(1.0),
    };
    let motion = (0..4_000).fold(Motion::at_rest(), |motion, _| model.step(&motion, &drive));
    (f64::from(motion.speed_m_s().value()) - exact.speed_m_s).abs()
}

fn check_inflections(name: &str, vehicle: &Vehicle, ocean: &Ocean, change: impl FnOnce(&mut MissionFile)) {
    let flight = flown(vehicle, ocean, change);
    let inflections = inflections(&flight);
    assert_eq!(inflections.len(), 2);
    for stretch in inflections {
        for (kind, (of_speed, of_depth)) in
            [("f32", errors::<f32>(vehicle, stretch)), ("fixed", errors::<Fixed>(vehicle, stretch))]
        {
            println!("{name}, {kind}: speed {:.2} mm/s, depth {:.3} m", 1e3 * of_speed, of_depth);
            assert!(of_speed <= 1e-4 && of_depth <= 0.01, "{name}, {kind}: {of_speed} m/s, {of_depth} m");
        }
    }
}

/// Straight ahead, so that the errors are those of the inflection.
fn straight(file: &mut MissionFile) {
    file.mission.course = Course::Headings([0].into_iter().collect());
}

#[test]
fn an_inflection_with_a_fast_pump_is_followed() {
    let vehicle = slocum();
    check_inflections("42 cc/s", &vehicle, &Ocean::still(&vehicle.water), straight);
}

/// A deep glider's engine: 1.2 cc/s up, 8 cc/s down.
#[test]
fn an_inflection_with_a_slow_pump_is_followed() {
    let mut vehicle = slocum();
    let buoyancy = vehicle.buoyancy.as_mut().unwrap();
    (buoyancy.pump_rate_m3_s, buoyancy.bleed_rate_m3_s) = (1.2e-6, 8e-6);
    check_inflections("1.2 and 8 cc/s", &vehicle, &Ocean::still(&vehicle.water), |file| {
        straight(file);
        file.mission.abort_depth_mm = 300_000;
        file.mission.max_duration_s = 20_000;
    });
}

/// In turns the side velocity is missing.
#[test]
fn a_whole_mission_with_turns_stays_close() {
    let vehicle = slocum();
    let flight = flown(&vehicle, &Ocean::still(&vehicle.water), |_| {});
    for (kind, (of_speed, of_depth)) in
        [("f32", errors::<f32>(&vehicle, &flight)), ("fixed", errors::<Fixed>(&vehicle, &flight))]
    {
        println!("mission, {kind}: speed {:.1} mm/s, depth {:.2} m", 1e3 * of_speed, of_depth);
        assert!(of_speed < 0.005 && of_depth < 0.2);
    }
}

/// Between the limits of state and drive no intermediate result leaves the range of [`Fixed`]: [`Interval`] says so of every one.
#[test]
fn fixed_point_never_overflows() {
    let mut seawing = Vehicle::load("seawing").unwrap();
    (seawing.buoyancy, seawing.limits) = (slocum().buoyancy, slocum().limits);
    let steeper = Envelope { dive_deg: [18.0, 40.0], climb_deg: [18.0, 40.0], ..Envelope::default() };
    for (vehicle, envelope) in [(slocum(), Envelope::default()), (seawing, steeper)] {
        let glide: GlideConstants = flight_vehicle(&vehicle, &envelope).unwrap().glide;
        let model = Model::<Interval>::new(&glide, 9.81, TICK_S);
        let within = Interval::within;
        let any = Drive {
            pitch_rad: within(limits::ANGLE_RAD),
            roll_rad: within(limits::ANGLE_RAD),
            pitch_rate_rad_s: within(limits::RATE_RAD_S),
            r_px_m: within(limits::R_PX_M),
            net_mass_kg: within(limits::NET_MASS_KG),
            density_ratio: Interval::between(limits::DENSITY_RATIO[0], limits::DENSITY_RATIO[1]),
        };
        let any_motion = Motion::new(within(limits::SPEED_M_S), within(limits::SPEED_M_S));
        let once = model.step(&any_motion, &any);
        // The second step starts from another drive than it ends with.
        let twice = model.step(&once, &any);
        assert!(twice.u_m_s.is_within(limits::SPEED_M_S) && twice.w_m_s.is_within(limits::SPEED_M_S));
        let _held = twice.sink_rate_m_s(any.pitch_rad, any.roll_rad);
        println!("{}: no intermediate beyond {:.0} of 2048", vehicle.name, Interval::largest());
    }
}

#[test]
fn an_interval_that_leaves_the_range_is_seen() {
    let big = Interval::within(60.0);
    assert!(std::panic::catch_unwind(|| big * big).is_err());
}

/// The plant that the steady glides are taken from is the one that flies.
#[test]
fn density_makes_net_mass() {
    let vehicle = slocum();
    let flying = flight_vehicle(&vehicle, &Envelope::default()).unwrap();
    let plant = Plant::<f64>::new(&vehicle);
    for (vbd_ul, density_kg_m3) in [(-250_000, 1000.0), (0, 1003.0), (250_000, 998.0)] {
        let volume_m3 = plant.displaced_volume_m3(0.0) + f64::from(vbd_ul) * 1e-9;
        let exact = vehicle.mass_kg() - density_kg_m3 * volume_m3;
        let found = f64::from(flying.net_mass_in_kg(vbd_ul, density_kg_m3 as f32));
        // A density as f32 has 6e-8 of it, which 50 kg displaces.
        assert!((found - exact).abs() < 1e-5, "{found} {exact}");
    }
}
