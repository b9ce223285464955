//! Polar, size and endurance: closed forms against searches and against each other, a realistic yo against the flown one.

use std::f64::consts::PI;

use num_dual::DualSVec64;
use shared::{autopilot::Autopilot, commands::Phase, model::table::TrimTable};
use sim_host::{
    analysis::{
        paper::performance::VARIED,
        performance::{Account, Endurance, Hold, Polar, Sizing, Yo},
        table::{Envelope, generate},
        trim::{Condition, Glide, Scale, glide},
    },
    flight::{FlyingVehicle, TICK_S, fly, mission_file::MissionFile},
    model::{
        coefficients::{Anchoring, BoundaryLayer, Shape, Study},
        ocean::Ocean,
        plant::rotation_from_quaternion,
        real::Real,
        vehicle::Vehicle,
    },
};

type Dual = DualSVec64<1>;

const POLARS: [Polar; 4] = [
    Polar { c_d_zero: 0.0266, c_d_induced: 0.1855 },
    Polar { c_d_zero: 0.04, c_d_induced: 0.034 },
    Polar { c_d_zero: 0.3, c_d_induced: 2.0 },
    Polar { c_d_zero: 1e-4, c_d_induced: 0.05 },
];

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found}, not {expected}");
}

/// Where a figure of merit over C_L stops growing: bisection on its exact slope.
fn peak(merit: impl Fn(Dual) -> Dual) -> f64 {
    let slope = |lift: f64| {
        let merit = merit(Dual::from_re(lift).derivative(0));
        merit.eps.unwrap_generic(nalgebra::Const::<1>, nalgebra::Const::<1>)[0]
    };
    let [mut low, mut high] = [1e-6, 10.0];
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

fn dual_drag(polar: &Polar, lift: Dual) -> Dual {
    Dual::constant(polar.c_d_zero) + Dual::constant(polar.c_d_induced) * lift * lift
}

#[test]
fn marked_glides_are_where_a_search_finds_them() {
    for polar in POLARS {
        let flattest = peak(|lift| lift / dual_drag(&polar, lift));
        near(polar.best_glide().lift_coefficient, flattest, 1e-9);
        let fastest = peak(|lift| {
            let drag = dual_drag(&polar, lift);
            lift / Real::powf(lift * lift + drag * drag, 0.75)
        });
        near(polar.max_horizontal_speed().lift_coefficient, fastest, 1e-9);
        for point in [polar.best_glide(), polar.max_horizontal_speed()] {
            let same = polar.at(point.lift_coefficient);
            near(point.drag_coefficient, same.drag_coefficient, 1e-14);
            near(point.descent_rad, same.descent_rad, 1e-14);
            near(point.lift_to_drag, same.lift_to_drag, 1e-14);
        }
    }
}

#[test]
fn the_papers_slocum_glides_best_at_8_degrees() {
    let best = Polar::from(&slocum().hydrodynamics).best_glide();
    assert!((best.descent_rad.to_degrees() - 8.0003).abs() < 5e-5);
}

#[test]
fn the_fastest_glide_is_as_printed_and_tends_to_35_degrees() {
    for polar in POLARS {
        let Polar { c_d_zero, c_d_induced } = polar;
        let delta = 2.0 * c_d_induced * c_d_zero;
        let r = -(1.0 + delta) + ((1.0 + delta).powi(2) + 8.0 * delta * delta).sqrt();
        let fastest = polar.max_horizontal_speed();
        // The printed r loses as many digits as 1/δ² has.
        let tolerance = 1e-15 / (delta * delta);
        near(fastest.lift_coefficient, (2.0 * r).sqrt() / (4.0 * c_d_induced), tolerance);
        near(fastest.drag_coefficient, c_d_zero + r / (8.0 * c_d_induced), tolerance);
    }
    let limit = Polar { c_d_zero: 0.02, c_d_induced: 0.0 }.max_horizontal_speed();
    assert!((limit.descent_rad.to_degrees() - 35.264).abs() < 5e-4);
    near(limit.lift_coefficient, 2_f64.sqrt() * 0.02, 1e-15);
    near(limit.drag_coefficient, 0.02, 1e-15);
    // To the first order in KC_D0.
    let small = Polar { c_d_zero: 0.02, c_d_induced: 1e-5 }.max_horizontal_speed();
    near(small.drag_coefficient, 0.02 * (1.0 + 2.0 * 1e-5 * 0.02), 1e-12);
}

/// Equations (12) and (13) as printed.
#[test]
fn a_lung_gives_the_speed_of_equations_12_and_13() {
    let vehicle = slocum();
    for anchoring in [Anchoring::Anchored, Anchoring::Unanchored] {
        let sizing = Sizing { study: Study { anchoring, ..Study::new(&vehicle) } };
        let shape = Shape::of(&vehicle);
        for eta in [0.001, 0.004, 0.03] {
            let size = sizing.at_lung_capacity(&shape, eta).unwrap();
            let lead = PI / 2.0 * 9.81 * 1.5 * 11.0 / 36.0 * eta / (1.0 + eta);
            let (k, c_d_zero) = (size.c_d_induced, size.c_d_zero);
            let by_12 = (lead / size.glide.resultant()).sqrt();
            let by_13 = (lead * (k / (c_d_zero * (1.0 + 4.0 * k * c_d_zero))).sqrt()).sqrt();
            near(size.speed_m_s, by_12, 1e-12);
            near(by_13, by_12, 1e-14);
            near(size.lung_capacity.unwrap(), eta, 1e-12);
        }
    }
}

/// Equation (17) as printed, and the weight that trim finds for the same glide.
#[test]
fn a_speed_takes_the_lung_of_equation_17_and_the_weight_of_its_trim() {
    let vehicle = Vehicle::load("from-geometry").unwrap();
    let sizing = Sizing { study: Study::new(&vehicle) };
    let shape = Shape::of(&vehicle);
    for speed_m_s in [0.25, 0.5, 0.77, 1.0] {
        let size = sizing.at_speed(&shape, speed_m_s).unwrap();
        let scale = 9.81 * 1.5_f64.powi(3) * 11.0 / (36.0 * 1e-12);
        let gamma = PI / 2.0 * scale / (size.hull_reynolds.powi(2) * size.glide.resultant());
        near(size.lung_capacity.unwrap(), 1.0 / (gamma - 1.0), 1e-12);
        near(size.wing_reynolds, size.hull_reynolds * 6.0 / (7.0 * 11.0), 1e-12);
        let at_speed = sizing.study.vehicle(&shape, speed_m_s, 0.0).unwrap();
        let trimmed = glide(&at_speed, Condition::MinGlideAngle, Scale::Speed(speed_m_s)).unwrap();
        near(size.net_mass_kg, trimmed.net_mass_kg, 1e-12);
        // Equation (11).
        let eta = size.lung_capacity.unwrap();
        near(size.net_mass_kg, eta / (1.0 + eta) * size.displaced_mass_kg, 1e-12);
    }
}

#[test]
fn no_lung_is_large_enough_for_any_speed() {
    let vehicle = slocum();
    let size = Sizing { study: Study::new(&vehicle) }.at_speed(&Shape::of(&vehicle), 10.0).unwrap();
    assert_eq!((size.lung_capacity, size.neutral_mass_kg), (None, None));
    assert!(size.net_mass_kg > size.displaced_mass_kg);
}

/// A lung that is too large for laminar flow and too small for turbulent flow holds the glider at the critical speed.
#[test]
fn between_laminar_and_turbulent_a_lung_gives_the_critical_speed() {
    let vehicle = slocum();
    let sizing = Sizing { study: Study { anchoring: Anchoring::Unanchored, ..Study::new(&vehicle) } };
    let shape = Shape::of(&vehicle);
    let critical_m_s = 5e5 * 1e-6 / 1.5;
    let lung = |speed: f64| sizing.at_speed(&shape, speed).unwrap().lung_capacity.unwrap();
    let (laminar, turbulent) = (lung(critical_m_s * (1.0 - 1e-9)), lung(critical_m_s * (1.0 + 1e-9)));
    assert!(turbulent > 1.2 * laminar);
    let between = sizing.at_lung_capacity(&shape, 0.5 * (laminar + turbulent)).unwrap();
    near(between.speed_m_s, critical_m_s, 1e-12);
    assert_eq!(between.hull_flow, BoundaryLayer::Laminar);
}

#[test]
fn a_hull_held_at_52_kg_displaces_52_kg() {
    let shape = Shape::of(&slocum());
    for (parameter, values) in VARIED {
        for value in values {
            let mut held = Hold::Displacement(52.0).with(&shape, parameter, value, 1000.0);
            near(1000.0 * held.hull.volume_m3(), 52.0, 1e-12);
            assert_eq!(*parameter.of(&mut held), value);
        }
    }
}

#[test]
fn ideal_range_and_endurance_depend_on_depth_by_less_than_a_dive() {
    let vehicle = slocum();
    let size = Sizing { study: Study::new(&vehicle) }.at_speed(&Shape::of(&vehicle), 0.4).unwrap();
    let account = |depth_m| Account::ideal(&size, depth_m, 540e3, 9.81);
    let without_floor = |a: &Account| 540e3 / a.dive_energy_j * a.dive_distance_m;
    let shallow = account(10.0);
    for depth_m in [10.0, 50.0, 200.0, 1000.0] {
        let deep = account(depth_m);
        near(without_floor(&deep), without_floor(&shallow), 1e-12);
        assert!((0.0..deep.dive_distance_m).contains(&(without_floor(&deep) - deep.range_m)), "{depth_m} m");
        near(deep.endurance_s / deep.range_m, shallow.endurance_s / shallow.range_m, 1e-12);
        // As printed: Δx = z/√(KC_D0), ΔE = ρgz · 2η/(1 + η) · (π/4) l³/f².
        near(deep.dive_distance_m, depth_m / (size.c_d_induced * size.c_d_zero).sqrt(), 1e-12);
        let eta = size.lung_capacity.unwrap();
        let stroke_m3 = 2.0 * eta / (1.0 + eta) * PI / 4.0 * 1.5_f64.powi(3) / 49.0;
        near(deep.dive_energy_j, 1000.0 * 9.81 * depth_m * stroke_m3, 1e-12);
    }
}

fn best_glide(vehicle: &Vehicle, speed_m_s: f64) -> Glide {
    glide(vehicle, Condition::MinGlideAngle, Scale::Speed(speed_m_s)).unwrap()
}

/// With a perfect pump, devices without delay, no loads and one water, the realistic yo is the ideal one.
#[test]
fn what_makes_a_yo_realistic_can_be_switched_off() {
    let mut vehicle = slocum();
    let buoyancy = vehicle.buoyancy.as_mut().unwrap();
    (buoyancy.pump_rate_m3_s, buoyancy.bleed_rate_m3_s, buoyancy.idle_power_w) = (1e9, 1e9, 0.0);
    buoyancy.efficiency = vec![[0.0, 1.0]];
    vehicle.moving_mass.rate_m_s = 1e12;
    vehicle.energy.as_mut().unwrap().hotel_w = 0.0;
    let size = Sizing { study: Study::new(&vehicle) }.at_speed(&Shape::of(&vehicle), 0.77).unwrap();
    let ideal = Account::ideal(&size, 200.0, 540e3, 9.81);
    let still = Ocean::still(&vehicle.water);
    let yo = Yo::new(&vehicle, &best_glide(&vehicle, 0.77), &still, [0.0, 200.0]).unwrap();
    // What is left: inflections of some 1e-11 s.
    near(yo.distance_m, ideal.dive_distance_m, 1e-11);
    near(yo.duration_s, ideal.dive_duration_s, 1e-11);
    near(yo.energy.total_j(), ideal.dive_energy_j, 1e-11);
    near(yo.pump_efficiency, 1.0, 1e-12);
}

/// The bottom half of a yo of the default mission, flown by the plant with the controller in the loop.
#[test]
fn a_realistic_yo_is_as_long_and_far_as_the_flown_one() {
    for name in ["slocum-paper", "from-geometry"] {
        let (file, vehicle) = (MissionFile::load("default").unwrap(), Vehicle::load(name).unwrap());
        let bytes = generate(&vehicle, &Envelope::default()).unwrap();
        let table = TrimTable::parse(&bytes).unwrap();
        let mut autopilot = Autopilot::new(&table, &file.mission, &file.parameters).unwrap();
        let flying = FlyingVehicle::new(&vehicle).unwrap();
        let ocean = Ocean::still(&vehicle.water);
        let (mut deepest_m, mut duration_s, mut distance_m) = (0.0_f64, 0.0, 0.0);
        fly(&flying, &ocean, &file.mission, &file.start, 1, &mut autopilot, &mut |tick| {
            let depth_m = tick.state.position_m.z;
            let second = tick.commands.yo == 2 && tick.commands.phase != Phase::Surface;
            if second && depth_m > 100.0 {
                deepest_m = deepest_m.max(depth_m);
                duration_s += TICK_S;
                let over_ground = rotation_from_quaternion(&tick.state.quaternion) * tick.state.velocity_m_s;
                distance_m += over_ground.x.hypot(over_ground.y) * TICK_S;
            }
        })
        .unwrap();
        let condition = Condition::PathAngle(-26_f64.to_radians());
        let glide = glide(&vehicle, condition, Scale::NetMass(0.25)).unwrap();
        // A yo has two inflections, this half of one has one: half of a yo that is as high twice.
        let yo = Yo::new(&vehicle, &glide, &ocean, [100.0, 100.0 + 2.0 * (deepest_m - 100.0)]).unwrap();
        // Of 660 and 850 s, and of 420 m: noise of the sensors, a heading that is held, an apogee that is not quite symmetric.
        near(0.5 * yo.duration_s, duration_s, 0.01);
        near(0.5 * yo.distance_m, distance_m, 0.01);
        // The inflection itself: without it the yo would be 4 % shorter.
        let without_s = duration_s - 0.5 * (yo.duration_s - 0.5 * yo.inflections_s);
        near(0.25 * yo.inflections_s, without_s, 0.15);
    }
}

#[test]
fn denser_water_below_slows_the_dive_and_hastens_the_climb_unless_the_hull_gives_way_as_much() {
    let mut vehicle = slocum();
    let ocean = Ocean::load("temperate", &vehicle.water).unwrap();
    let spread = |vehicle: &Vehicle, ocean: &Ocean| {
        let yo = Yo::new(vehicle, &best_glide(vehicle, 0.4), ocean, [0.0, 200.0]).unwrap();
        yo.fastest_m_s - yo.slowest_m_s
    };
    assert!(spread(&vehicle, &Ocean::still(&vehicle.water)) < 1e-12);
    let stiff = spread(&vehicle, &ocean);
    assert!(stiff > 0.05, "{stiff} m/s");
    // A hull that shrinks in cold water as the water does: 1.4 kg/m³ of 1026 on 7 °C.
    vehicle.buoyancy.as_mut().unwrap().elasticity.thermal_expansion_per_c = 2e-4;
    let yielding = spread(&vehicle, &ocean);
    assert!(yielding < 0.8 * stiff, "{yielding} of {stiff} m/s");
}

#[test]
fn a_glider_too_light_for_the_water_below_is_told_where_it_stops() {
    let vehicle = slocum();
    let ocean = Ocean::load("baltic", &vehicle.water).unwrap();
    let refusal = Yo::new(&vehicle, &best_glide(&vehicle, 0.15), &ocean, [0.0, 150.0]).unwrap_err();
    assert!(refusal.contains("m slocum-paper no longer sinks"), "{refusal}");
    let sizing = Sizing { study: Study::new(&vehicle) };
    let answer = Endurance::new(&sizing, &Shape::of(&vehicle), (0.15, 150.0, 540e3), &ocean).unwrap();
    assert_eq!(answer.realistic, None);
    assert!(answer.warnings[0].starts_with("no realistic account: at "), "{}", answer.warnings[0]);
}

#[test]
fn every_loss_costs_range() {
    let vehicle = slocum();
    let sizing = Sizing { study: Study::new(&vehicle) };
    let ocean = Ocean::load("temperate", &vehicle.water).unwrap();
    for depth_m in [50.0, 200.0] {
        let answer = Endurance::new(&sizing, &Shape::of(&vehicle), (0.4, depth_m, 540e3), &ocean).unwrap();
        let realistic = answer.realistic.unwrap();
        assert!(realistic.account.range_m < answer.ideal.range_m);
        assert!(realistic.energy.pump_j > answer.ideal.dive_energy_j);
        assert!(realistic.pump_efficiency < 1.0);
        assert!(realistic.account.dive_duration_s > answer.ideal.dive_duration_s);
    }
}
