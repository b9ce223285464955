//! `glider sensitivity`: what every geometric parameter does, exactly.

use std::{io::Write, path::PathBuf};

use super::{size::AnchoringArgs, trim::GlideArgs};
use crate::analysis::{
    modes::RollKinematics,
    sensitivity::{Effect, Merit, Sensitivities, sensitivities},
};
use crate::files::whole_file;

#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("condition").required(true)))]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    glide: GlideArgs,
    /// φ̇ = p + r tanθ, or φ̇ = p as in the paper's Table 2
    #[arg(long, value_enum, default_value_t = RollKinematics::Exact)]
    roll_kinematics: RollKinematics,
    #[command(flatten)]
    anchoring: AnchoringArgs,
    /// Also draw the ranking, as SVG
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let study = args.anchoring.study(&vehicle);
    let (condition, scale) = args.glide.wanted(&vehicle);
    let found = sensitivities(&study, condition, scale, args.roll_kinematics)?;
    if let Some(path) = &args.output {
        let figure = found.figure(&format!("{}: what each parameter does", vehicle.name));
        whole_file::write(path, |file| writeln!(file, "{}", figure.svg()))?;
    }
    if args.json {
        return super::print_json(&found);
    }
    for warning in &found.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(&describe(&vehicle.name, &found))
}

fn describe(name: &str, found: &Sensitivities) -> String {
    let glide = &found.glide;
    let mut lines = vec![format!(
        "{name} at {:.4} m/s, {:.3}°, net mass {:.4} kg; changes in % per % of the parameter, or of one that is 0 per ° or cm",
        glide.speed_m_s,
        glide.path_angle_rad.to_degrees(),
        glide.net_mass_kg
    )];
    for merit in &found.figures {
        lines.push(describe_merit(merit));
    }
    let flows = found.flows.iter().map(|flow| format!("{} {} (Re {:.3e})", flow.surface, flow.flow, flow.reynolds));
    lines.push(format!("flow: {}", flows.collect::<Vec<_>>().join(", ")));
    lines.extend(found.switches.iter().map(|switch| {
        format!("  jumps at {} = {:.4}: the flow along the {} changes", switch.parameter, switch.at, switch.surface)
    }));
    lines.join("\n")
}

/// Its value, and the parameters that matter, the most first.
fn describe_merit(merit: &Merit) -> String {
    let Some(value) = merit.value else { return format!("{}: does not exist", merit.meaning) };
    let mut effects: Vec<(f64, String)> = merit.effects.iter().filter_map(|effect| described(effect, value)).collect();
    effects.sort_by(|(a, _), (b, _)| b.abs().total_cmp(&a.abs()));
    let words: Vec<String> = effects.into_iter().map(|(_, words)| words).collect();
    let words = if words.is_empty() { "nothing".to_owned() } else { words.join(", ") };
    format!("{}: {value:.5}\n    {words}", merit.meaning)
}

fn described(effect: &Effect, value: f64) -> Option<(f64, String)> {
    let (change, unit) = effect.small_change();
    let (percent, unit) = match effect.elasticity {
        Some(elasticity) => (elasticity, String::new()),
        None => (100.0 * effect.derivative? * change / value.abs(), format!(" per {unit}")),
    };
    // Less than this is not worth a place in a ranking of hundredths.
    (percent.abs() >= 5e-4).then(|| (percent, format!("{} {percent:+.3}{unit}", effect.parameter)))
}
