//! `glider plan`: what a mission will come to before it is flown.

use std::{fs, io::Write, num::NonZero, path::PathBuf, thread};

use serde::Serialize;
use shared::model::table::TrimTable;

use super::{campaign::check_current, progress};
use crate::analysis::table::{Envelope, describe, generate};
use crate::files::whole_file;
use crate::flight::{FlyingVehicle, mission_file::MissionFile, pilot::ready};
use crate::model::ocean::Ocean;
use crate::studies::{
    campaign::Spread,
    plan::{self, Limit, Plan, Planned, Surfacing},
};

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a mission file, or the name of an embedded mission: default, fast-50, slow-50, slow-200,
    /// slow-1000, legs, zigzag, waypoints, mooring, drift
    mission: String,
    /// Path of a vehicle file, or the name of an embedded vehicle (default: the mission's)
    #[arg(long, value_name = "VEHICLE")]
    vehicle: Option<String>,
    /// Where: as `glider fly` takes it
    #[arg(long, value_name = "ENVIRONMENT", default_value = "still")]
    environment: String,
    /// Speed (root mean square) of an unknown steady current, besides those of the environment
    #[arg(long, value_name = "M_S", default_value_t = 0.0, allow_negative_numbers = true)]
    current: f64,
    /// Flights of the ensemble: seeds 1 to N
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = clap::value_parser!(u64).range(3..=100_000))]
    members: u64,
    /// Folder for plan.json, plan.html, plan.svg and track.geojson
    #[arg(long, value_name = "DIR", default_value = "plan")]
    out: PathBuf,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct Answer<'a> {
    mission: &'a str,
    vehicle: &'a str,
    environment: &'a str,
    current_m_s: f64,
    #[serde(flatten)]
    plan: &'a Plan,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    check_current(args.current)?;
    let asked = MissionFile::load(&args.mission).map_err(|error| error.to_string())?;
    let vehicle = super::load_vehicle(args.vehicle.as_ref().unwrap_or(&asked.vehicle))?;
    let flying = FlyingVehicle::new(&vehicle)?;
    let ocean = Ocean::load(&args.environment, &vehicle.water).map_err(|error| error.to_string())?;
    let table_bytes = generate(&vehicle, &Envelope::default())?;
    let table = TrimTable::parse(&table_bytes).map_err(|error| format!("trim table: {}", describe(&error)))?;
    let (file, autopilot) = ready(asked, &flying, &table, &ocean)?;
    fs::create_dir_all(&args.out).map_err(|error| format!("{}: {error}", args.out.display()))?;

    let planned = Planned {
        vehicle: &vehicle,
        file: &file,
        ocean: &ocean,
        autopilot: &autopilot,
        current_m_s: args.current,
        seeds: 1..=args.members,
    };
    let bar = progress::flights(args.members);
    let threads = thread::available_parallelism().unwrap_or(NonZero::<usize>::MIN);
    let plan = plan::plan(&planned, threads, |_| bar.inc(1))?;
    bar.finish_and_clear();

    let Args { mission, environment, current: current_m_s, .. } = args;
    let answer = Answer { mission, vehicle: &vehicle.name, environment, current_m_s: *current_m_s, plan: &plan };
    let current = if *current_m_s > 0.0 { format!(", an unknown current of {current_m_s} m/s") } else { String::new() };
    let title = format!("{mission}, {}, {environment}{current}", vehicle.name);
    let lines = in_words(&plan);
    write_folder(args, &title, &lines, &answer)?;
    if args.json {
        return super::print_json(&answer);
    }
    let text: Vec<_> = lines.iter().map(|[name, words]| format!("{name:<22}{words}")).collect();
    super::print(&format!("{title}\n{}\n{}", text.join("\n"), args.out.join("plan.html").display()))
}

/// The plan as data, as a page, as a picture and for maps, in one folder.
fn write_folder(args: &Args, title: &str, lines: &[[String; 2]], answer: &Answer<'_>) -> Result<(), String> {
    let (out, plan) = (&args.out, answer.plan);
    whole_file::write(&out.join("plan.svg"), |file| writeln!(file, "{}", plan::figure(title, plan).svg()))?;
    whole_file::write(&out.join("plan.html"), |file| writeln!(file, "{}", plan::html(title, lines, plan)))?;
    whole_file::write(&out.join("track.geojson"), |file| writeln!(file, "{}", plan::geojson(plan)))?;
    whole_file::write(&out.join("plan.json"), |file| {
        serde_json::to_writer_pretty(&mut *file, answer)?;
        writeln!(file)
    })
}

/// The numbers of a plan, each with its name.
fn in_words(plan: &Plan) -> Vec<[String; 2]> {
    let count = plan.members.len();
    let completed = format!("{:.1} % of {count} flights, each a little off its file", 100.0 * plan.completed_share);
    let nominal = &plan.nominal;
    let mut lines = vec![
        ["completes".into(), completed],
        ["duration".into(), spread(nominal.duration_s, plan.duration_s, 60.0, "min")],
        ["energy".into(), spread(nominal.energy_j, plan.energy_j, 1e3, "kJ")],
        ["deepest".into(), spread(nominal.max_depth_m, plan.max_depth_m, 1.0, "m")],
    ];
    match &plan.surfacing {
        Some(surfacing) => lines.extend(surfacing_in_words(surfacing)),
        None => lines.push(["surfaces".into(), "nobody knows where: fewer than three members complete".into()]),
    }
    lines.extend(plan.limits.iter().map(limit_in_words));
    let reasons = plan.members.iter().chain([nominal]).filter(|member| !member.reason.is_empty());
    lines.extend(reasons.map(|member| {
        let name = member.seed.map_or_else(|| "nominal".into(), |seed| format!("seed {seed}"));
        [name, format!("{:?} ({})", member.outcome, member.reason)]
    }));
    lines
}

/// The nominal value, and where eight of ten members end up.
fn spread(nominal: f64, spread: Option<Spread>, scale: f64, unit: &str) -> String {
    let nominal = format!("{:.1} {unit} nominal", nominal / scale);
    spread.map_or_else(
        || nominal.clone(),
        |Spread { p10, p90, .. }| format!("{nominal}; {:.1} to {:.1} {unit} in 8 of 10", p10 / scale, p90 / scale),
    )
}

fn surfacing_in_words(surfacing: &Surfacing) -> Vec<[String; 2]> {
    let Surfacing { mean, latitude_deg, longitude_deg, ellipses, .. } = surfacing;
    let place = format!(
        "{latitude_deg:.5}, {longitude_deg:.5} (latitude, longitude); {:.0} m north, {:.0} m east of the start",
        mean.north_m, mean.east_m
    );
    let ellipse = |holding: &plan::HoldingEllipse| {
        let plan::Ellipse { share, semi_axes_m: [longer, shorter], bearing_rad, .. } = holding.ellipse;
        let (bearing_deg, inside) = (bearing_rad.to_degrees(), 100.0 * holding.share_inside);
        let words = format!("±{longer:.0} m towards {bearing_deg:.0}°, ±{shorter:.0} m across; {inside:.1} % inside");
        [format!("  {:.0} % ellipse", 100.0 * share), words]
    };
    [["surfaces".into(), place]].into_iter().chain(ellipses.iter().map(ellipse)).collect()
}

fn limit_in_words(limit: &Limit) -> [String; 2] {
    let Limit { name, beyond, worst, limit, unit, holds } = limit;
    let verdict = if *holds { "holds".to_string() } else { format!("NOT KEPT: {beyond}") };
    [format!("limit: {name}"), format!("{worst:.0} {unit} at worst, limit {limit:.0} {unit}: {verdict}")]
}
