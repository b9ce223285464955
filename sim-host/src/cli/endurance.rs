//! `glider endurance`: how far and how long a battery lasts, ideal and realistic side by side.

use super::size::{ShapeArgs, describe_size};
use crate::analysis::performance::{Account, Endurance, Sizing};
use crate::model::{ocean::Ocean, vehicle::Vehicle};

/// The paper's battery, for a vehicle file without one, J.
const PAPER_BATTERY_J: f64 = 540e3;
/// For a vehicle file without limits, m.
const DEPTH_M: f64 = 200.0;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// Speed at the flattest glide, m/s (default: the vehicle's nominal speed)
    #[arg(long, value_name = "M_S")]
    speed: Option<f64>,
    /// Depth of the dives, m (default: the vehicle's working depth, or 200)
    #[arg(long, value_name = "M")]
    depth: Option<f64>,
    /// Energy of the battery, J (default: the vehicle's, or the paper's 540 kJ)
    #[arg(long, value_name = "J")]
    battery: Option<f64>,
    /// Water of the realistic account: an environment file, a CTD cast (.csv), or an embedded environment
    #[arg(long, default_value = "temperate")]
    environment: String,
    #[command(flatten)]
    shape: ShapeArgs,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let ocean = Ocean::load(&args.environment, &vehicle.water).map_err(|error| error.to_string())?;
    let sizing = Sizing { study: args.shape.study(&vehicle) };
    let speed_m_s = args.speed.unwrap_or(vehicle.nominal_speed_m_s);
    let depth_m =
        args.depth.unwrap_or_else(|| vehicle.limits.as_ref().map_or(DEPTH_M, |limits| limits.working_depth_m));
    let battery_j =
        args.battery.unwrap_or_else(|| vehicle.energy.as_ref().map_or(PAPER_BATTERY_J, |energy| energy.battery_j));
    let shape = args.shape.shape(&vehicle)?;
    let answer = Endurance::new(&sizing, &shape, (speed_m_s, depth_m, battery_j), &ocean)?;
    if args.json {
        return super::print_json(&answer);
    }
    for warning in &answer.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(&describe(&vehicle, &args.environment, &answer))
}

fn describe(vehicle: &Vehicle, environment: &str, answer: &Endurance) -> String {
    let real = answer.realistic.as_ref();
    let row = |name: &str, unit: &str, of: &dyn Fn(&Account) -> f64| {
        let realistic = real.map_or_else(|| "none".into(), |real| format!("{:.2}", of(&real.account)));
        format!("  {name:<22} {:>12.2} {realistic:>12} {unit}", of(&answer.ideal))
    };
    let mut lines = vec![
        format!("{} at its flattest glide, {:.0} kJ", vehicle.name, answer.battery_j / 1e3),
        describe_size(&answer.size),
        format!("yos to {} m; realistic in `{environment}`", answer.depth_m),
        format!("  {:<22} {:>12} {:>12}", "", "ideal", "realistic"),
        row("one dive: distance", "m", &|a| a.dive_distance_m),
        row("          duration", "s", &|a| a.dive_duration_s),
        row("          energy", "J", &|a| a.dive_energy_j),
        row("dives", "", &|a| a.dives),
        row("range", "km", &|a| a.range_m / 1e3),
        row("endurance", "days", &|a| a.endurance_s / 86_400.0),
    ];
    if let Some(real) = real {
        let e = &real.energy;
        lines.push(format!(
            "  energy of a realistic dive: pump {:.0} J ({:.0} % of it ideal work), bleed {:.0} J, pitch {:.0} J, hotel {:.0} J",
            e.pump_j,
            100.0 * real.pump_efficiency,
            e.bleed_j,
            e.pitch_j,
            e.hotel_j
        ));
        lines.push(format!(
            "  speed {:.3} to {:.3} m/s; inflections take {:.0} s",
            real.slowest_m_s, real.fastest_m_s, real.inflections_s
        ));
    }
    lines.join("\n")
}
