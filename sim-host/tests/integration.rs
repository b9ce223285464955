//! The integrator: fourth order on a whole dive, and in agreement with a library's adaptive method.

mod common;

use common::lopsided;
use differential_equations::prelude::{ExplicitRungeKutta, IVP, ODE};
use nalgebra::{Vector3, Vector4};
use shared::{autopilot::Autopilot, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, TICK_S, fly, mission_file::MissionFile},
    model::{
        ocean::Ocean,
        plant::{Particle, Plant, State, quaternion_from_euler, rk4_step},
        vehicle::Vehicle,
    },
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

/// The plant with its drives running, as the library wants it.
struct Driven<'a> {
    plant: &'a Plant<f64>,
    u_b_m3_s: f64,
}

impl ODE<f64, [f64; 18]> for Driven<'_> {
    fn diff(&self, _time_s: f64, y: &[f64; 18], rates: &mut [f64; 18]) {
        *rates = flat(&self.plant.derivative_driven(&from_flat(y), self.u_b_m3_s, &self.plant.still()));
    }
}

fn flat(state: &State<f64>) -> [f64; 18] {
    let (x, q, v, w) = (state.position_m, state.quaternion, state.velocity_m_s, state.rate_rad_s);
    [
        x.x,
        x.y,
        x.z,
        q[0],
        q[1],
        q[2],
        q[3],
        v.x,
        v.y,
        v.z,
        w.x,
        w.y,
        w.z,
        state.r_px_m,
        state.r_px_rate_m_s,
        state.mu_rad,
        state.mu_rate_rad_s,
        state.displaced_volume_m3,
    ]
}

fn from_flat(y: &[f64; 18]) -> State<f64> {
    State {
        position_m: Vector3::new(y[0], y[1], y[2]),
        quaternion: Vector4::new(y[3], y[4], y[5], y[6]),
        velocity_m_s: Vector3::new(y[7], y[8], y[9]),
        rate_rad_s: Vector3::new(y[10], y[11], y[12]),
        r_px_m: y[13],
        r_px_rate_m_s: y[14],
        mu_rad: y[15],
        mu_rate_rad_s: y[16],
        displaced_volume_m3: y[17],
    }
}

/// Fourth order at 5 ms and an adaptive eighth order at 1e-12 end in the same state, every drive running.
#[test]
fn a_librarys_adaptive_integrator_agrees() {
    for vehicle in [Vehicle::load("slocum-paper").unwrap(), lopsided()] {
        let plant = Plant::<f64>::new(&vehicle);
        let start = State {
            quaternion: quaternion_from_euler(&Vector3::new(0.3, -0.5, 0.2)),
            velocity_m_s: Vector3::new(0.6, 0.1, 0.05),
            rate_rad_s: Vector3::new(0.1, -0.05, 0.08),
            r_px_m: 0.05,
            r_px_rate_m_s: -0.01,
            mu_rad: -0.4,
            mu_rate_rad_s: 0.1,
            ..State::at_rest(plant.displaced_volume_m3(0.2))
        };
        let u_b_m3_s = 2e-5;
        let particle = Particle::Driven { u_b_m3_s };
        let ours = (0..4_000).fold(start, |state, _| rk4_step(&plant, &state, &particle, 5e-3, &plant.still()));
        let solution = IVP::ode(&Driven { plant: &plant, u_b_m3_s }, 0.0, 20.0, flat(&start))
            .method(ExplicitRungeKutta::dop853().rtol(1e-12).atol(1e-12))
            .solve()
            .unwrap();
        let reference = solution.y.last().unwrap();
        for (place, (ours, theirs)) in flat(&ours).iter().zip(reference).enumerate() {
            assert!((ours - theirs).abs() < 1e-8 * theirs.abs().max(1.0), "state {place}: {ours}, {theirs}");
        }
    }
}
