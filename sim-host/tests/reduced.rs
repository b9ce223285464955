//! The reduced model against the full plant, in both arithmetics, and the proof that fixed point does not overflow.

mod common;

use common::Interval;
use shared::{
    device::TICK_S,
    model::{
        number::{Fixed, Number},
        reduced::{Drive, Model, Motion, limits},
        vehicle::GlideConstants,
    },
};
use sim_host::{
    analysis::{
        reduced_error::{self, BOUND, error, submerged},
        table::{Envelope, flight_vehicle},
        trim::{Condition, Scale, glide},
    },
    flight::mission_file::MissionFile,
    model::{plant::Plant, vehicle::Vehicle},
};

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn model<N: Number>(vehicle: &Vehicle) -> Model<N> {
    let flying = flight_vehicle(vehicle, &Envelope::default()).unwrap();
    Model::new(&flying.glide, flying.gravity_m_s2, TICK_S)
}

/// Net mass, slope: the corners and the middle of the envelope.
#[test]
fn steady_glides_are_the_plants() {
    let vehicle = slocum();
    let worst = |settle: fn(&Vehicle, &sim_host::analysis::trim::Glide) -> f64| {
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

fn settled<N: Number>(vehicle: &Vehicle, exact: &sim_host::analysis::trim::Glide) -> f64 {
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

/// Two yos, hence two apogees and a crest, with each pump.
#[test]
fn inflections_with_a_fast_and_a_slow_pump_are_followed() {
    let inflections = reduced_error::inflections().unwrap();
    assert_eq!(inflections.len(), 2 * 3);
    for inflection in inflections {
        println!("{inflection:?}");
        for error in [inflection.float, inflection.fixed] {
            assert!(error.speed_m_s <= BOUND.speed_m_s && error.depth_m <= BOUND.depth_m, "{inflection:?}");
        }
    }
}

/// In turns the side velocity is missing.
#[test]
fn a_whole_mission_with_turns_stays_close() {
    let vehicle = slocum();
    let flight = submerged(&vehicle, &MissionFile::load("default").unwrap()).unwrap();
    for error in [error::<f32>(&vehicle, &flight).unwrap(), error::<Fixed>(&vehicle, &flight).unwrap()] {
        println!("mission: {error:?}");
        assert!(error.speed_m_s < 0.005 && error.depth_m < 0.2, "{error:?}");
    }
}

/// Between the limits of state and drive no intermediate result leaves the range of [`Fixed`]: [`Interval`] says so of every one.
#[test]
fn fixed_point_never_overflows() {
    let mut seawing = Vehicle::load("seawing").unwrap();
    (seawing.buoyancy, seawing.limits, seawing.energy) = (slocum().buoyancy, slocum().limits, slocum().energy);
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
