//! A vehicle that turns the other way is flown by the same controller: the sense of a turn stands in its table.

use shared::{autopilot::Autopilot, commands::Phase, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{FlyingVehicle, Outcome, fly, mission_file::MissionFile},
    model::{ocean::Ocean, plant::euler_from_quaternion, vehicle::Vehicle},
};

fn vehicle_and_table() -> (Vehicle, Vec<u8>) {
    let vehicle = Vehicle::load("reversed-turn").unwrap();
    // As its file says.
    let envelope = Envelope { dive_deg: [20.0, 30.0], climb_deg: [20.0, 30.0], net_mass_kg: [0.15, 0.4], mu_deg: 45.0 };
    let bytes = generate(&vehicle, &envelope).unwrap();
    (vehicle, bytes)
}

/// What all Seagliders do, and the paper's Slocum does not.
#[test]
fn rolled_to_the_right_it_turns_left_on_a_dive_and_right_on_a_climb() {
    let (_, bytes) = vehicle_and_table();
    let reversed = TrimTable::parse(&bytes).unwrap();
    let slocum = generate(&Vehicle::load("slocum-paper").unwrap(), &Envelope::default()).unwrap();
    let slocum = TrimTable::parse(&slocum).unwrap();
    for (table, sense) in [(&reversed, 1.0), (&slocum, -1.0)] {
        // A mass swung to the right, which is negative, banks to the right.
        let (dive, climb) = (table.look_up(-0.45, 0.25, -0.5), table.look_up(0.45, -0.25, -0.5));
        assert!(dive.roll_rad > 0.0 && climb.roll_rad > 0.0);
        assert!(dive.turn_rate_rad_s * sense < 0.0 && climb.turn_rate_rad_s * sense > 0.0);
    }
}

#[test]
fn it_flies_the_default_mission_and_holds_its_headings() {
    let file = MissionFile::load("default").unwrap();
    let (vehicle, bytes) = vehicle_and_table();
    let table = TrimTable::parse(&bytes).unwrap();
    let flying = FlyingVehicle::new(&vehicle).unwrap();
    for seed in 1..=4 {
        let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
        let mut errors_deg = Vec::new();
        let ocean = Ocean::still(&vehicle.water);
        let summary = fly(&flying, &ocean, &file.mission, &file.start, seed, &mut autopilot, &mut |tick| {
            let heading_deg = euler_from_quaternion(&tick.state.quaternion).z.to_degrees();
            let error = f64::from(tick.commands.target_heading_cdeg) / 100.0 - heading_deg;
            if tick.commands.yo == 2 && tick.commands.phase != Phase::Complete {
                errors_deg.push((error + 180.0).rem_euclid(360.0) - 180.0);
            }
        })
        .unwrap();
        assert_eq!(summary.outcome, Outcome::Completed, "seed {seed}");
        let reached = errors_deg.iter().position(|error: &f64| error.abs() < 5.0).expect("the heading is reached");
        let held = &errors_deg[reached..];
        let rms_deg = (held.iter().map(|error| error * error).sum::<f64>() / held.len() as f64).sqrt();
        println!("seed {seed}: {rms_deg:.2}° rms");
        assert!(held.len() > 4_000, "most of the second yo is judged");
        // The heading loop's deadband is 1.5°; it corrects every 8 s, and turns set in slowly.
        assert!(rms_deg < 5.0, "seed {seed}: heading held to {rms_deg:.2}° rms");
    }
}
