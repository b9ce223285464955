//! A vehicle of which only the geometry is known trims, turns, has decaying modes and flies the default mission.

use shared::{autopilot::Autopilot, model::table::TrimTable};
use sim_host::{
    analysis::{
        modes::{RollKinematics, modes},
        table::{Envelope, generate},
        trim::{Condition, Scale, glide},
        turn::Turns,
    },
    flight::{FlyingVehicle, Outcome, fly, mission_file::MissionFile},
    model::{ocean::Ocean, vehicle::Vehicle},
};

fn vehicle() -> Vehicle {
    Vehicle::load("from-geometry").unwrap()
}

#[test]
fn it_trims_within_its_devices_and_every_mode_decays() {
    for (path_angle_deg, net_mass_kg) in [(-26.0_f64, 0.25), (26.0, -0.25)] {
        let vehicle = vehicle();
        let condition = Condition::PathAngle(path_angle_deg.to_radians());
        let glide = glide(&vehicle, condition, Scale::NetMass(net_mass_kg)).unwrap();
        assert_eq!(glide.warnings, [""; 0]);
        let modes = modes(&vehicle, &glide, RollKinematics::Exact).unwrap();
        for [re, _] in modes.longitudinal.eigenvalues.into_iter().chain(modes.lateral.eigenvalues) {
            assert!(re < 0.0, "{path_angle_deg}°: {re} 1/s");
        }
    }
}

#[test]
fn it_turns_both_ways_alike() {
    let vehicle = vehicle();
    let condition = Condition::PathAngle(-26_f64.to_radians());
    let glide = glide(&vehicle, condition, Scale::NetMass(0.25)).unwrap();
    let turns = Turns::new(&vehicle, &glide).unwrap();
    let authorities = turns.authorities();
    let [right, left] = [authorities.right, authorities.left].map(|authority| authority.within_travel_rad_s);
    // Fielded gliders turn by 0.2 to 0.5 °/s.
    assert!(right.to_degrees() > 0.2, "{:.3} °/s", right.to_degrees());
    // By mirror symmetry, to the convergence of the helix.
    assert!((right + left).abs() < 1e-9);
}

#[test]
fn it_flies_the_default_mission() {
    let (file, vehicle) = (MissionFile::load("default").unwrap(), vehicle());
    let bytes = generate(&vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    for seed in 1..=3 {
        let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
        let flying = FlyingVehicle::new(&vehicle).unwrap();
        let ocean = Ocean::still(&vehicle.water);
        let summary = fly(&flying, &ocean, &file.mission, &file.start, seed, &mut autopilot, &mut |_| {}).unwrap();
        assert_eq!((summary.outcome, summary.aborts.as_slice()), (Outcome::Completed, &[][..]), "seed {seed}");
        assert!((summary.max_depth_m - 200.0).abs() < 5.0, "seed {seed}: {:.1} m", summary.max_depth_m);
    }
}
