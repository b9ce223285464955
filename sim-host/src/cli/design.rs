//! `glider design`: the best geometry within bounds.

use std::{fs, io::Write, path::PathBuf};

use crate::analysis::design::{Candidate, Design, Front, Spec, design, vehicle_toml};
use crate::files::whole_file;
use crate::model::vehicle::Vehicle;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a design file, or the name of an embedded one: default
    spec: String,
    /// Folder for the vehicle that is found, and for range against turn rate as picture and data
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let spec = Spec::load(&args.spec).map_err(|error| error.to_string())?;
    let vehicle = super::load_vehicle(&spec.vehicle)?;
    let found = design(&spec, &vehicle).map_err(|error| format!("{}: {error}", args.spec))?;
    if let Some(folder) = &args.out {
        fs::create_dir_all(folder).map_err(|error| format!("{}: {error}", folder.display()))?;
        let start = Vehicle::text(&spec.vehicle).map_err(|error| error.to_string())?;
        let text = vehicle_toml(&spec, &found.best, &start)?;
        whole_file::write(&folder.join("vehicle.toml"), |file| write!(file, "{text}"))?;
        if let Some(front) = &found.front {
            let bounds: Vec<_> = spec.bounds.iter().map(|(parameter, bounds)| (parameter.key(), *bounds)).collect();
            let figure = front.figure(&format!("{}: what range costs in agility", spec.name), &bounds);
            whole_file::write(&folder.join("front.svg"), |file| writeln!(file, "{}", figure.svg()))?;
            whole_file::write(&folder.join("front.csv"), |file| front.write_csv(file))?;
        }
    }
    if args.json {
        return super::print_json(&found);
    }
    super::print(&describe(&spec, &found))
}

fn describe(spec: &Spec, found: &Design) -> String {
    let mut lines = vec![
        format!("{}, {} kg, from {}", spec.name, spec.displaced_mass_kg, spec.vehicle),
        format!("                         {:>10} {:>10}", "found", "start"),
    ];
    let mut row = |name: &str, of: fn(&Candidate) -> f64| {
        let start = found.start.as_ref().map_or_else(|| "none".to_owned(), |start| format!("{:.4}", of(start)));
        lines.push(format!("  {name:<22} {:>10.4} {start:>10}", of(&found.best)));
    };
    row("range, km", |candidate| candidate.range_m / 1e3);
    row("lift to drag", |candidate| candidate.size.glide.lift_to_drag);
    row("speed, m/s", |candidate| candidate.size.speed_m_s);
    row("net mass, kg", |candidate| candidate.size.net_mass_kg);
    row("angle of attack, °", |candidate| candidate.alpha_rad.to_degrees());
    row("turn rate, °/s", |candidate| candidate.turn_rate_rad_s.to_degrees());
    row("largest real part, 1/s", |candidate| candidate.largest_real_part_per_s);
    row("least damping ratio", |candidate| candidate.least_damping_ratio);
    for placed in &found.parameters {
        let [least, most] = placed.bounds;
        let reached = placed.reached.map_or(String::new(), |bound| format!(": at its {bound}"));
        lines.push(format!("  {:<22} {:>10.4} within {least} to {most}{reached}", placed.parameter, placed.value));
    }
    lines.extend(found.active.iter().map(|active| format!("  {} = {} holds it back", active.constraint, active.asked)));
    let size = &found.best.size;
    lines.push(format!("  flow: hull {}, wing {}, fin {}", size.hull_flow, size.wing_flow, size.fin_flow));
    lines.extend(found.front.as_ref().map(describe_front));
    lines.join("\n")
}

fn describe_front(front: &Front) -> String {
    let mut lines = vec!["  turn rate, °/s    range, km  speed, m/s".to_owned()];
    lines.extend(front.points.iter().map(|point| {
        let candidate = &point.candidate;
        format!(
            "  {:14.4} {:12.2} {:11.4}",
            candidate.turn_rate_rad_s.to_degrees(),
            candidate.range_m / 1e3,
            candidate.size.speed_m_s
        )
    }));
    lines.join("\n")
}
