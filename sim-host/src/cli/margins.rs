//! `glider margins`: how stable the controller's loops are.

use std::{fs, io::Write, num::NonZero, path::PathBuf, thread};

use serde::Serialize;
use shared::{model::table::TrimTable, parameters::Parameters};

use super::envelope::EnvelopeArgs;
use crate::analysis::{
    margins::{self, ENOUGH_GAIN, Envelope, Loop, Margins},
    table::{describe, generate},
};
use crate::files::whole_file;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    envelope: EnvelopeArgs,
    /// Also write margins.json and margins.svg into this folder
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    vehicle: &'a str,
    #[serde(flatten)]
    envelope: &'a Envelope,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let table_bytes = generate(&vehicle, &args.envelope.envelope()?)?;
    let table = TrimTable::parse(&table_bytes).map_err(|error| format!("trim table: {}", describe(&error)))?;
    let threads = thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let envelope = margins::margins(&vehicle, &table, &Parameters::default(), threads)?;
    let answer = Answer { vehicle: &vehicle.name, envelope: &envelope };
    if let Some(out) = &args.out {
        fs::create_dir_all(out).map_err(|error| format!("{}: {error}", out.display()))?;
        let title = format!("{}: stability margins of pitch and heading", vehicle.name);
        let svg = margins::figure(&title, &envelope).svg();
        whole_file::write(&out.join("margins.svg"), |file| writeln!(file, "{svg}"))?;
        whole_file::write(&out.join("margins.json"), |file| {
            serde_json::to_writer_pretty(&mut *file, &answer)?;
            writeln!(file)
        })?;
    }
    if args.json { super::print_json(&answer) } else { super::print(&in_words(&vehicle.name, &envelope)) }
}

fn in_words(name: &str, envelope: &Envelope) -> String {
    let mut lines = vec![
        format!("{name}: worst of {} nodes of the trim table", envelope.nodes.len()),
        format!("{:<9}{:>16}{:>13}{:>14}   {}", "loop", "spectral radius", "gain margin", "delay margin", "where"),
        loop_in_words("pitch", &envelope.pitch),
        loop_in_words("heading", &envelope.heading),
        row("servo", &envelope.servo, "everywhere"),
    ];
    for (name, worst) in [("pitch", &envelope.pitch), ("heading", &envelope.heading)] {
        let Loop { unstable_nodes, weak_nodes, longest_move_s, delay_margin_s, .. } = worst;
        lines.push(format!(
            "{name}: {weak_nodes} nodes with a gain margin below {ENOUGH_GAIN}, {unstable_nodes} of them unstable; \
             its longest move takes {longest_move_s:.1} s, {}",
            match delay_margin_s {
                Some(delay_s) if longest_move_s < delay_s => "less than the delay margin",
                None if worst.stable => "less than the delay margin",
                Some(_) | None => "NOT less than the delay margin",
            }
        ));
    }
    let powerless = envelope.nodes.iter().filter(|node| !node.has_authority).count();
    if powerless > 0 {
        lines.push(format!(
            "heading: no authority at {powerless} nodes: the mass is left alone, no heading is held there"
        ));
    }
    lines.join("\n")
}

fn loop_in_words(name: &str, worst: &Loop) -> String {
    let [path_angle_rad, net_mass_kg] = worst.worst_at;
    let Loop { spectral_radius, gain_margin, delay_margin_s, .. } = *worst;
    let place = format!("path angle {:.1}°, net mass {net_mass_kg:.3} kg", path_angle_rad.to_degrees());
    row(name, &Margins { spectral_radius, gain_margin, delay_margin_s }, &place)
}

fn row(name: &str, margins: &Margins, place: &str) -> String {
    let or_none =
        |value: Option<f64>, unit: &str| value.map_or_else(|| "none".into(), |value| format!("{value:.2}{unit}"));
    let [gain, delay] = [or_none(margins.gain_margin, ""), or_none(margins.delay_margin_s, " s")];
    let unstable = if margins.is_stable() { "" } else { "   UNSTABLE" };
    format!("{name:<9}{:>16.4}{gain:>13}{delay:>14}   {place}{unstable}", margins.spectral_radius)
}
