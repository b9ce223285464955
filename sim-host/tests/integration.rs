//! The integrator: fourth order on a whole dive.

use shared::{autopilot::Autopilot, table::TrimTable};
use sim_host::{
    flight::{FlyingVehicle, TICK_S, fly},
    mission_file::MissionFile,
    ocean::Ocean,
    plant::{Particle, Plant, State, rk4_step},
    table::{Envelope, generate},
    vehicle::Vehicle,
};

/// Rates that hold for one tick.
#[derive(Clone, Copy)]
struct Held {
    r_px_m_s: f64,
    mu_rad_s: f64,
    volume_m3_s: f64,
}

/// A dive of the default mission as the motors ran, below the surface.
fn dive() -> (Vehicle, State<f64>, Vec<Held>) {
    let file = MissionFile::load("default").unwrap();
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let mut states = Vec::new();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let ocean = Ocean::still(&vehicle.water);
    fly(&flying, &ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| states.push(*tick.state)).unwrap();
    let begin = states.iter().position(|state| state.position_m.z > 3.0).unwrap();
    let length = states[begin..].iter().position(|state| state.position_m.z < 2.5).unwrap();
    let held = states[begin..begin + length]
        .windows(2)
        .map(|pair| Held {
            r_px_m_s: (pair[1].r_px_m - pair[0].r_px_m) / TICK_S,
            mu_rad_s: (pair[1].mu_rad - pair[0].mu_rad) / TICK_S,
            volume_m3_s: (pair[1].displaced_volume_m3 - pair[0].displaced_volume_m3) / TICK_S,
        })
        .collect();
    (vehicle.clone(), states[begin], held)
}

/// Flies the same motor motions with `steps` integration steps per tick.
fn end_of(plant: &Plant<f64>, start: &State<f64>, motors: &[Held], steps: u32) -> State<f64> {
    motors.iter().fold(*start, |state, held| {
        let state = plant.with_particle_rates(&state, held.r_px_m_s, held.mu_rad_s);
        let particle = Particle::Driven { u_b_m3_s: held.volume_m3_s };
        (0..steps).fold(state, |state, _| rk4_step(plant, &state, &particle, TICK_S / f64::from(steps), &plant.still()))
    })
}

#[test]
fn halving_the_step_of_a_whole_dive_leaves_a_sixteenth_of_the_error() {
    let (vehicle, start, motors) = dive();
    assert!(motors.len() > 5_000, "a whole dive and climb");
    let plant = Plant::<f64>::new(&vehicle);
    let [coarse, middle, fine, finest] = [1, 2, 4, 32].map(|steps| end_of(&plant, &start, &motors, steps).position_m);
    let errors = [coarse, middle, fine].map(|position| (position - finest).norm());
    let orders = [errors[0] / errors[1], errors[1] / errors[2]].map(f64::log2);
    assert!(orders.iter().all(|order| (3.7..4.5).contains(order)), "orders {orders:?} from errors {errors:?} m");
    // What a flight integrates with: one step per tick.
    assert!(errors[0] < 2e-3, "{} m off after a dive", errors[0]);
}
