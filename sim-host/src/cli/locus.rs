//! `glider locus`: how the modes move when the shape changes.

use std::{io::Write, path::PathBuf};

use serde::Serialize;

use super::{size::AnchoringArgs, trim::GlideArgs};
use crate::analysis::{
    locus::{Loci, Locus, Varied, vary},
    modes::RollKinematics,
    paper::loci::panel,
};
use crate::files::whole_file;
use crate::pages::chart::Figure;

#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("condition").required(true)))]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// What varies: a key of [hull], [wing] or [fin] with its section, as wing.position, or hydrodynamics.roll.beta
    #[arg(long, value_name = "KEY")]
    parameter: Varied,
    /// Its first value
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    from: f64,
    /// Its last value
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    to: f64,
    /// Number of values
    #[arg(long, value_name = "N", default_value_t = 101, value_parser = clap::value_parser!(u16).range(2..=10_000))]
    points: u16,
    #[command(flatten)]
    glide: GlideArgs,
    /// φ̇ = p + r tanθ, or φ̇ = p as in the paper's Table 2
    #[arg(long, value_enum, default_value_t = RollKinematics::Exact)]
    roll_kinematics: RollKinematics,
    #[command(flatten)]
    anchoring: AnchoringArgs,
    /// Also draw both loci, as SVG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    parameter: String,
    #[serde(flatten)]
    loci: &'a Loci,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let study = args.anchoring.study(&vehicle);
    let (condition, scale) = args.glide.wanted(&vehicle);
    let points = usize::from(args.points);
    let loci = vary(&study, args.parameter, [args.from, args.to], points, condition, scale, args.roll_kinematics)?;
    if let Some(path) = &args.output {
        let title = format!("{}: root loci, {} from {} to {}", vehicle.name, args.parameter, args.from, args.to);
        let panels = vec![panel("longitudinal", &loci.longitudinal), panel("lateral", &loci.lateral)];
        let figure = Figure { title, columns: 2, panels };
        whole_file::write(path, |file| writeln!(file, "{}", figure.svg()))?;
    }
    if args.json {
        return super::print_json(&Answer { parameter: args.parameter.to_string(), loci: &loci });
    }
    super::print(&format!("{}\n{}", describe("longitudinal", &loci.longitudinal), describe("lateral", &loci.lateral)))
}

/// Where each branch begins and ends.
fn describe(title: &str, locus: &Locus) -> String {
    let words = |[re, im]: &[f64; 2]| if *im == 0.0 { format!("{re:.4}") } else { format!("{re:.4} {im:+.4}i") };
    let mut lines = vec![format!("{title}: 1/s")];
    for branch in &locus.branches {
        if let (Some(first), Some(last)) = (branch.first(), branch.last()) {
            lines.push(format!("  {:>20}  →  {:>20}", words(first), words(last)));
        }
    }
    lines.join("\n")
}
