//! How fast the plant steps and a flight flies: `cargo bench -p sim-host`.
//!
//! A flight is reported as simulated seconds per second ("elem/s"); everything else as time per call.

#![allow(clippy::unwrap_used, reason = "in a benchmark a panic is the report")]
#![allow(missing_docs, reason = "criterion's macros write functions")]

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use shared::{
    autopilot::Autopilot,
    device::{Attitude, Measurements},
    model::table::TrimTable,
};
use sim_host::{
    analysis::{
        table::{Envelope, generate},
        trim::{Condition, Scale, glide},
    },
    flight::{FlyingVehicle, TICK_S, fly, mission_file::MissionFile},
    model::{
        ocean::Ocean,
        plant::{Input, Particle, Plant, State, rk4_step},
        vehicle::Vehicle,
    },
};

/// The paper's glider in a dive, a little off its trim, so that every term has something to do.
fn diving() -> (Plant<f64>, State<f64>) {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let trim = glide(&vehicle, Condition::PathAngle(-0.45), Scale::NetMass(0.25)).unwrap().state();
    let state = State { rate_rad_s: nalgebra::Vector3::new(0.01, 0.005, 0.02), mu_rad: 0.1, ..trim };
    (Plant::new(&vehicle), state)
}

fn plant(criterion: &mut Criterion) {
    let (plant, state) = diving();
    let still = plant.still();
    let free = Particle::Free(Input::none());
    let locked = Particle::Driven { u_b_m3_s: 0.0 };
    criterion.bench_function("plant: derivative, locked", |bencher| {
        bencher.iter(|| plant.derivative_driven(black_box(&state), 0.0, &still));
    });
    criterion.bench_function("plant: derivative, 8 degrees of freedom", |bencher| {
        bencher.iter(|| plant.derivative(black_box(&state), &Input::none(), &still));
    });
    criterion.bench_function("plant: RK4 step of 0.25 s, locked", |bencher| {
        bencher.iter(|| rk4_step(&plant, black_box(&state), &locked, TICK_S, &still));
    });
    criterion.bench_function("plant: RK4 step, 8 degrees of freedom", |bencher| {
        bencher.iter(|| rk4_step(&plant, black_box(&state), &free, TICK_S / 16.0, &still));
    });
}

fn flight(criterion: &mut Criterion) {
    let file = MissionFile::load("default").unwrap();
    let vehicle = Vehicle::load(&file.vehicle).unwrap();
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let autopilot = || Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    let still = Ocean::still(&vehicle.water);
    let fly_once = || fly(&flying, &still, &file.mission, &file.start, 1, &mut autopilot(), &mut |_| ()).unwrap();

    criterion.bench_function("autopilot: step", |bencher| {
        let mut autopilot = autopilot();
        let mut tick = 0;
        bencher.iter(|| {
            tick += 1;
            // Under water on its course, so that every part of the controller is busy.
            autopilot.step(tick, black_box(&under_water(tick)))
        });
    });
    let mut group = criterion.benchmark_group("flight");
    group.sample_size(20).throughput(Throughput::Elements(fly_once().duration_s as u64));
    group.bench_function("closed loop, still water", |bencher| bencher.iter(fly_once));
    group.finish();
}

/// Measurements of a dive at 1 mm per tick.
fn under_water(tick: u32) -> Measurements {
    Measurements {
        pressure_pa: Some(500_000 + 10 * tick as i32),
        attitude: Some(Attitude {
            roll_cdeg: 50,
            pitch_cdeg: -2_500,
            heading_cdeg: 2_900,
            pitch_rate_cdeg_s: 1,
            yaw_rate_cdeg_s: 2,
        }),
        r_px_um: 100_000,
        mu_cdeg: 10,
        vbd_ul: -250_000,
        battery_mv: Some(14_900),
        ..Measurements::silent()
    }
}

criterion_group!(benches, plant, flight);
criterion_main!(benches);
