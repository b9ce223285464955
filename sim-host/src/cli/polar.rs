//! `glider polar`: the drag polar's two marked glides.

use serde::Serialize;

use crate::analysis::performance::{Polar, PolarPoint};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer {
    c_d_zero: f64,
    c_d_induced: f64,
    best_glide: PolarPoint,
    max_horizontal_speed: PolarPoint,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let polar = Polar::from(&vehicle.hydrodynamics);
    let answer = Answer {
        c_d_zero: polar.c_d_zero,
        c_d_induced: polar.c_d_induced,
        best_glide: polar.best_glide(),
        max_horizontal_speed: polar.max_horizontal_speed(),
    };
    if args.json {
        return super::print_json(&answer);
    }
    let line = |name: &str, point: &PolarPoint| {
        format!(
            "  {name:<24} {:8.4}  {:8.5}  {:9.4}°  {:6.3}",
            point.lift_coefficient,
            point.drag_coefficient,
            point.descent_rad.to_degrees(),
            point.lift_to_drag
        )
    };
    super::print(
        &[
            format!("{}: C_D = {:.5} + {:.5} C_L²", vehicle.name, polar.c_d_zero, polar.c_d_induced),
            format!("  {:<24} {:>8}  {:>8}  {:>10}  {:>6}", "", "C_L", "C_D", "descent", "L/D"),
            line("best glide", &answer.best_glide),
            line("maximum horizontal speed", &answer.max_horizontal_speed),
        ]
        .join("\n"),
    )
}
