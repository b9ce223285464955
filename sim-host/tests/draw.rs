//! The drawing of a vehicle has everything on it, whatever the vehicle and its glide.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use sim_host::{
    analysis::trim::{Condition, Scale, glide},
    model::vehicle::Vehicle,
    pages::draw::{DrawnGlide, sheet},
};

const SLOCUM: &str = include_str!("../vehicles/slocum-paper.toml");

fn drawn(text: &str, path_angle_deg: f64, net_mass_kg: f64) -> String {
    let vehicle = Vehicle::from_toml(text, "v.toml").unwrap();
    let trim = glide(&vehicle, Condition::PathAngle(path_angle_deg.to_radians()), Scale::NetMass(net_mass_kg)).unwrap();
    sheet(&vehicle, &DrawnGlide::new(&vehicle, &trim))
}

#[test]
fn the_papers_glider_is_labelled_with_its_sizes_and_forces() {
    let svg = drawn(SLOCUM, -26.0, 0.25);
    let words = [
        "slocum-paper",
        "span 1.286 m",
        "chord 0.117 m",
        "quarter chord 0.075 m aft",
        "hull 1.500 m",
        "diameter 0.214 m",
        "fin 0.24 × 0.12 m",
        "centre of buoyancy",
        "centre of mass +0.034, +0.075 m",
        "moving mass 9 kg at +0.191 m",
        "travel −0.35 to +0.35 m",
        "rotation −60° to +60°, left positive",
        "buoyancy engine −0.30 to +0.30 L",
        "lift 2.20 N",
        "drag 1.08 N",
        "net weight 2.45 N",
        "γ −26.00°",
        "α 1.78°",
        "V 0.725 m/s",
    ];
    for words in words {
        assert!(svg.contains(&format!(">\n{words}\n</text>")), "`{words}` is missing:\n{svg}");
    }
}

#[test]
fn a_climb_is_carried_by_its_net_buoyancy() {
    assert!(drawn(SLOCUM, 35.0, -0.2).contains("net buoyancy 1.96 N"));
}

#[test]
fn every_number_is_finite_whatever_the_vehicle() {
    let swept = SLOCUM
        .replace("sweep_deg = 0", "sweep_deg = 43")
        .replace("dihedral_deg = 0", "dihedral_deg = -5")
        .replace("area_ratio = 0.8", "area_ratio = 0");
    let engine = swept.find("[buoyancy]").unwrap()..swept.find("[energy]").unwrap();
    let without_engine = swept.replace(&swept[engine], "");
    for text in [SLOCUM, &swept, &without_engine] {
        for (path_angle_deg, net_mass_kg) in [(-26.0, 0.25), (60.0, -0.01)] {
            let svg = drawn(text, path_angle_deg, net_mass_kg);
            assert!(!svg.contains("NaN") && !svg.contains("inf\""), "{svg}");
        }
    }
}
