//! Trim tables: as good as they promise, all over their envelope, whatever the vehicle.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use shared::model::table::TrimTable;
use sim_host::{
    analysis::{
        helix::{Helix, HelixSolver, Slope, Turn},
        table::{BOUND, Envelope, InterpolationError, generate, measure},
        trim::{Condition, Scale, glide},
    },
    model::vehicle::Vehicle,
};

/// Random places in each envelope; a table of this size has some 300 cells.
const PLACES: usize = 2_000;

/// An engine and limits to write into the table; they change no steady motion.
fn with_engine(mut vehicle: Vehicle) -> Vehicle {
    let slocum = Vehicle::load("slocum-paper").unwrap();
    (vehicle.buoyancy, vehicle.energy, vehicle.limits) = (slocum.buoyancy, slocum.energy, slocum.limits);
    vehicle
}

/// Seawing glides no flatter than 15°, and on climbs with more than 0.3 kg its turns reverse.
fn seawing() -> (Vehicle, Envelope) {
    let envelope = Envelope { dive_deg: [18.0, 40.0], climb_deg: [18.0, 40.0], net_mass_kg: [0.1, 0.3], mu_deg: 60.0 };
    (with_engine(Vehicle::load("seawing").unwrap()), envelope)
}

fn assert_within_bound(error: &InterpolationError, place: &str) {
    assert!(error.speed <= BOUND.speed, "{place}: {error:?}");
    assert!(error.turn_rate <= BOUND.turn_rate, "{place}: {error:?}");
    assert!(error.pitch_rad <= BOUND.angle_rad, "{place}: {error:?}");
    assert!(error.alpha_rad <= BOUND.angle_rad, "{place}: {error:?}");
}

fn check(vehicle: &Vehicle, envelope: &Envelope) -> usize {
    let bytes = generate(vehicle, envelope).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let middles = measure(vehicle, &table).unwrap();
    assert_within_bound(&middles.dive, "middles of the dives' cells");
    assert_within_bound(&middles.climb, "middles of the climbs' cells");
    let solver = HelixSolver::new(vehicle);
    let mut random = Pcg64Mcg::seed_from_u64(12);
    for place in 0..PLACES {
        let mut between = |[low, high]: [f64; 2]| random.random_range(low..high);
        let (sign, slopes) = if place % 2 == 0 { (1.0, envelope.dive_deg) } else { (-1.0, envelope.climb_deg) };
        let path_angle_rad = -sign * between(slopes).to_radians();
        let net_mass_kg = sign * between(envelope.net_mass_kg);
        let mu_rad = between([-envelope.mu_deg, envelope.mu_deg]).to_radians();
        let wings_level = glide(vehicle, Condition::PathAngle(path_angle_rad), Scale::NetMass(net_mass_kg)).unwrap();
        let turn =
            |near: &Helix, mu_rad: f64| solver.solve(near, Slope::PathAngle(path_angle_rad), Turn::Mu(mu_rad)).unwrap();
        let level = turn(&Helix::from(&wings_level), 0.0);
        let exact = [0.25, 0.5, 0.75, 1.0].iter().fold(level, |near, share| turn(&near, share * mu_rad));
        let found = table.look_up(path_angle_rad as f32, net_mass_kg as f32, mu_rad as f32);
        assert!(!found.saturated);
        let error = InterpolationError::of(&found, &exact, &level);
        assert_within_bound(&error, &format!("{path_angle_rad} rad, {net_mass_kg} kg, {mu_rad} rad"));
        let sink_rate_m_s = -exact.speed_m_s * path_angle_rad.sin();
        assert!((f64::from(found.sink_rate_m_s) / sink_rate_m_s - 1.0).abs() <= BOUND.speed);
    }
    bytes.len()
}

#[test]
fn the_papers_slocum_is_interpolated_within_the_bounds_in_a_few_kib() {
    let bytes = check(&Vehicle::load("slocum-paper").unwrap(), &Envelope::default());
    assert!(bytes < 8 * 1024, "{bytes} bytes");
}

#[test]
fn seawing_is_interpolated_within_the_bounds_in_a_few_kib() {
    let (vehicle, envelope) = seawing();
    let bytes = check(&vehicle, &envelope);
    // The reversal of its climbs is near: turn rates are steep there.
    assert!(bytes < 12 * 1024, "{bytes} bytes");
}

/// A hull out of true: the centre of mass to the right, and a coupled roll. It turns with the mass hanging straight down.
#[test]
fn a_lopsided_vehicle_keeps_both_sides_and_stays_within_the_bounds() {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    vehicle.body.centre_of_mass_m.y = 0.002;
    let envelope = Envelope { dive_deg: [15.0, 28.0], climb_deg: [15.0, 28.0], net_mass_kg: [0.15, 0.4], mu_deg: 45.0 };
    let bytes = generate(&vehicle, &envelope).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    assert!(!table.header().symmetric);
    let turn_rate = |mu_rad: f32| table.look_up(-0.4, 0.25, mu_rad).turn_rate_rad_s;
    assert!(turn_rate(0.0) != 0.0 && turn_rate(0.5) != -turn_rate(-0.5));
    check(&vehicle, &envelope);
}

#[test]
fn a_vehicle_without_an_engine_and_an_envelope_without_glides_are_refused_in_one_line() {
    let seawing = Vehicle::load("seawing").unwrap();
    let message = generate(&seawing, &Envelope::default()).unwrap_err();
    assert!(message.contains("[buoyancy]"), "{message}");
    let slocum = Vehicle::load("slocum-paper").unwrap();
    let too_flat = Envelope { dive_deg: [3.0, 35.0], ..Envelope::default() };
    let message = generate(&slocum, &too_flat).unwrap_err();
    assert!(message.contains("path angle -3.0000°") && message.lines().count() == 1, "{message}");
    // The control reversal of its dives at −39.3° is a pole, which no table interpolates.
    let across_the_reversal = Envelope { dive_deg: [12.0, 45.0], ..Envelope::default() };
    let message = generate(&slocum, &across_the_reversal).unwrap_err();
    assert!(message.lines().count() == 1, "{message}");
}
