//! The moving mass under motors, eight degrees of freedom: beside the kinematic drive, at its stops, in its brake, and what it costs.

use shared::{autopilot::Autopilot, commands::Commands, device::Measurements, model::table::TrimTable};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{EnergyUsed, FlyingVehicle, Outcome, Summary, TICK_S, fly, mission_file::MissionFile, pilot::Pilot},
    model::{
        ocean::Ocean,
        plant::State,
        vehicle::{AxialDrive, Drive, RotationDrive, Vehicle},
    },
};

/// What each tick ends with.
type Trace = Vec<(Commands, State<f64>, EnergyUsed)>;

/// Repeats commands, whatever is measured; stops at their end.
struct Replay(Vec<Commands>);

impl Pilot for Replay {
    fn step(&mut self, tick: u32, _: &Measurements) -> Result<Commands, String> {
        self.0.get(tick as usize).copied().ok_or_else(|| "the end".into())
    }
}

fn slocum(drive: Drive) -> Vehicle {
    let mut vehicle = Vehicle::load("slocum-paper").unwrap();
    vehicle.moving_mass.drive = drive;
    vehicle
}

/// Motors that take up any speed at once, without friction or play, and never tire.
fn ideal() -> Drive {
    Drive::Dynamic {
        axial: AxialDrive {
            acceleration_m_s2: 1e9,
            friction_n: 0.0,
            backlash_m: 0.0,
            stall_n: 1e12,
            ..AxialDrive::default()
        },
        rotation: RotationDrive {
            acceleration_deg_s2: 1e9,
            friction_nm: 0.0,
            backlash_deg: 0.0,
            stall_nm: 1e12,
            ..RotationDrive::default()
        },
    }
}

fn usual() -> Drive {
    Drive::Dynamic { axial: AxialDrive::default(), rotation: RotationDrive::default() }
}

fn fly_under(vehicle: &Vehicle, pilot: &mut dyn Pilot) -> (Result<Summary, String>, Trace) {
    let file = MissionFile::load("default").unwrap();
    let flying = FlyingVehicle::new(vehicle).unwrap();
    let mut trace = Trace::new();
    let summary = fly(&flying, &Ocean::still(&vehicle.water), &file.mission, &file.start, 1, pilot, &mut |tick| {
        trace.push((*tick.commands, *tick.state, *tick.energy));
    });
    (summary, trace)
}

fn fly_default(vehicle: &Vehicle) -> (Summary, Trace) {
    let file = MissionFile::load("default").unwrap();
    let bytes = generate(vehicle, &Envelope::default()).unwrap();
    let table = TrimTable::parse(&bytes).unwrap();
    let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
    let (summary, trace) = fly_under(vehicle, &mut autopilot);
    (summary.unwrap(), trace)
}

/// The same commands for `ticks` ticks from the launch.
fn hold(vehicle: &Vehicle, ticks: usize, commands: Commands) -> Trace {
    fly_under(vehicle, &mut Replay(vec![commands; ticks])).1
}

/// The commands of a dive and climb, replayed to both formulations.
#[test]
fn six_and_eight_degrees_of_freedom_fly_the_same_dive() {
    let (_, kinematic) = fly_default(&slocum(Drive::Kinematic));
    let commands: Vec<_> = kinematic.iter().map(|(commands, ..)| *commands).collect();
    let (_, dynamic) = fly_under(&slocum(ideal()), &mut Replay(commands));
    assert_eq!(dynamic.len(), kinematic.len());
    let pairs = || dynamic.iter().zip(&kinematic).map(|((_, d, _), (_, k, _))| (d, k));
    let stops_m = slocum(Drive::Kinematic).moving_mass.travel_m;
    let at_stop = |state: &State<f64>| stops_m.iter().any(|stop_m| (state.r_px_m - stop_m).abs() < 1e-9);
    let off_m = |stopped: bool| {
        let those = pairs().filter(|(_, k)| at_stop(k) == stopped);
        those.map(|(d, k)| (d.r_px_m - k.r_px_m).abs()).fold(0.0, f64::max)
    };
    let (mass_m, beyond_stop_m) = (off_m(false), off_m(true));
    let mass_rad = pairs().map(|(d, k)| (d.mu_rad - k.mu_rad).abs()).fold(0.0, f64::max);
    let apart_m = pairs().map(|(d, k)| (d.position_m - k.position_m).norm()).fold(0.0, f64::max);
    let way_m: f64 = kinematic.windows(2).map(|pair| (pair[1].1.position_m - pair[0].1.position_m).norm()).sum();
    println!("mass {:.4} mm, {:.4}°; {apart_m:.4} m apart after {way_m:.0} m", 1e3 * mass_m, mass_rad.to_degrees());
    // A forced start takes one sub-step of 1/64 s, a jump none. That lag, 0.08 mm at 1 cm/s and 0.12° at 15 °/s, falls to 41 % per
    // sub-step: to under a tenth by the end of a tick's motion.
    // At a stop the kinematic mass stands still at once, and the other overruns it by half a sub-step's way at most.
    assert!(beyond_stop_m < 8e-5, "{beyond_stop_m} m");
    assert!(mass_m < 8e-6 && mass_rad.to_degrees() < 0.012, "{mass_m} m, {mass_rad} rad");
    // Half of those 0.012° left standing turns the vehicle by 1e-5 °/s: over half an hour, by 0.03° or 5e-4 of the way.
    assert!(apart_m < 5e-4 * way_m, "{apart_m} m apart after {way_m:.0} m");
}

#[test]
fn the_default_mission_completes_under_motors_with_friction_and_play() {
    let (summary, trace) = fly_default(&slocum(usual()));
    assert_eq!(summary.outcome, Outcome::Completed);
    assert!((summary.max_depth_m - 200.0).abs() < 5.0, "{} m", summary.max_depth_m);
    let moving = trace.iter().filter(|(_, state, _)| state.r_px_rate_m_s != 0.0 || state.mu_rate_rad_s != 0.0).count();
    println!("{} ticks of {} with a moving mass; {:?}", moving, trace.len(), summary.energy_j);
    assert!(2 * moving < trace.len(), "locked most of the time: {moving} of {} ticks", trace.len());
}

#[test]
fn end_stops_hold() {
    let vehicle = slocum(usual());
    for (rate_um_s, rate_cdeg_s) in [(10_000, 1_500), (-10_000, -1_500)] {
        let commands = Commands { r_px_rate_um_s: rate_um_s, mu_rate_cdeg_s: rate_cdeg_s, ..Commands::safe() };
        let trace = hold(&vehicle, 600, commands);
        let stop = |[low, high]: [f64; 2]| if rate_um_s > 0 { high } else { low };
        let (stop_m, stop_rad) = (stop(vehicle.moving_mass.travel_m), stop(vehicle.moving_mass.roll_deg).to_radians());
        let over_m = trace.iter().map(|(_, s, _)| (s.r_px_m - stop_m) * stop_m.signum()).fold(f64::MIN, f64::max);
        let over_rad = trace.iter().map(|(_, s, _)| (s.mu_rad - stop_rad) * stop_rad.signum()).fold(f64::MIN, f64::max);
        // Half a sub-step's way, 0.08 mm and 0.12°, as the trapezoid of a speed that falls to zero within it.
        assert!(over_m < 1e-4 && over_rad.to_degrees() < 0.15, "{over_m} m and {over_rad} rad beyond the stops");
        let (_, end, _) = trace.last().unwrap();
        assert!((end.r_px_m - stop_m).abs() < 3e-4, "there but for the play: {} m", end.r_px_m);
        assert!((end.mu_rad - stop_rad).to_degrees().abs() < 0.4, "there but for the play: {} rad", end.mu_rad);
    }
}

#[test]
fn a_brake_holds_what_it_is_rated_for_and_slips_beyond() {
    // Nose down by 30° at the launch, the mass pulls with 44 N; the mission's commands are never given.
    let with_brake = |brake_n: f64| {
        let axial = AxialDrive { brake_n, ..AxialDrive::default() };
        let mut vehicle = slocum(Drive::Dynamic { axial, rotation: RotationDrive::default() });
        vehicle.moving_mass.travel_m = [-0.35, 0.35];
        vehicle
    };
    let back = Commands { r_px_rate_um_s: -10_000, ..Commands::safe() };
    for (brake_n, holds) in [(60.0, true), (5.0, false)] {
        let mut commands = vec![back; 40];
        commands.extend(vec![Commands::safe(); 400]);
        let (_, trace) = fly_under(&with_brake(brake_n), &mut Replay(commands));
        let places: Vec<f64> = trace[60..].iter().map(|(_, state, _)| state.r_px_m).collect();
        let moved = places.iter().any(|place| *place != places[0]);
        assert_eq!(!moved, holds, "{brake_n} N: from {} to {} m", places[0], places[places.len() - 1]);
    }
}

/// Fielded drives: 2 to 5 J for a move in pitch, 2 to 6 J in roll.
#[test]
fn a_typical_move_costs_what_fielded_ones_cost() {
    let vehicle = slocum(usual());
    let seconds = |s: f64| (s / TICK_S) as usize;
    // From the forward stop 10 mm back, uphill; and from below 30° to the left.
    let pitch = Commands { r_px_rate_um_s: -10_000, ..Commands::safe() };
    let roll = Commands { mu_rate_cdeg_s: 1_500, ..Commands::safe() };
    let spent = |moves: Commands, duration_s: f64| {
        let mut commands = vec![moves; seconds(duration_s)];
        commands.extend(vec![Commands::safe(); 20]);
        let (_, trace) = fly_under(&vehicle, &mut Replay(commands));
        let ((_, start, _), (_, end, energy)) = (trace[0], trace[trace.len() - 1]);
        (end.r_px_m - start.r_px_m, (end.mu_rad - start.mu_rad).to_degrees(), energy)
    };
    let (way_m, _, energy) = spent(pitch, 1.0);
    println!("pitch {:.2} mm for {:.2} J", 1e3 * way_m, energy.pitch);
    // The play of 0.2 mm is lost where the load changes sides.
    assert!((way_m + 0.01).abs() < 5e-4 && (2.0..5.0).contains(&energy.pitch), "{way_m} m for {} J", energy.pitch);
    let (_, angle_deg, energy) = spent(roll, 2.0);
    println!("roll {angle_deg:.2}° for {:.2} J", energy.roll);
    assert!((angle_deg - 30.0).abs() < 0.5 && (2.0..6.0).contains(&energy.roll), "{angle_deg}° for {} J", energy.roll);
}
