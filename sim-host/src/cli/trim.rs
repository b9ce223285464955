//! `glider trim` and `glider draw`: a wings-level glide in numbers, and in a picture.

use std::{io::Write, path::PathBuf};

use crate::analysis::trim::{Condition, Glide, Scale, glide};
use crate::files::whole_file;
use crate::model::vehicle::Vehicle;
use crate::pages::draw::{DrawnGlide, sheet};

/// Which glide, and how fast.
#[derive(Debug, clap::Args)]
pub(super) struct GlideArgs {
    /// Path angle, degrees; negative glides down
    #[arg(long, value_name = "DEG", allow_negative_numbers = true, group = "condition")]
    path_angle_deg: Option<f64>,
    /// The dive that goes farthest per time
    #[arg(long, group = "condition")]
    max_horizontal_speed: bool,
    /// The flattest dive
    #[arg(long, group = "condition")]
    min_glide_angle: bool,
    /// Speed, m/s (default: the vehicle's nominal speed)
    #[arg(long, value_name = "M_S", group = "scale")]
    speed: Option<f64>,
    /// Net mass, kg; positive sinks
    #[arg(long, value_name = "KG", allow_negative_numbers = true, group = "scale")]
    net_mass: Option<f64>,
}

#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("condition").required(true)))]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    glide: GlideArgs,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct DrawArgs {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    glide: GlideArgs,
    /// Where the SVG goes (default: stdout)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl GlideArgs {
    pub(super) fn solve(&self, vehicle: &Vehicle) -> Result<Glide, String> {
        let (condition, scale) = self.wanted(vehicle);
        glide(vehicle, condition, scale)
    }

    /// Which glide is asked for, and how fast.
    pub(super) fn wanted(&self, vehicle: &Vehicle) -> (Condition, Scale) {
        let condition = match self.path_angle_deg {
            Some(degrees) => Condition::PathAngle(degrees.to_radians()),
            None if self.min_glide_angle => Condition::MinGlideAngle,
            None => Condition::MaxHorizontalSpeed,
        };
        let scale = match (self.net_mass, self.speed) {
            (Some(net_mass_kg), _) => Scale::NetMass(net_mass_kg),
            (None, Some(speed_m_s)) => Scale::Speed(speed_m_s),
            (None, None) => Scale::Speed(vehicle.nominal_speed_m_s),
        };
        (condition, scale)
    }
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let glide = args.glide.solve(&vehicle)?;
    if args.json {
        return super::print_json(&glide);
    }
    for warning in &glide.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(&describe(&vehicle, &glide))
}

fn describe(vehicle: &Vehicle, glide: &Glide) -> String {
    let degrees = f64::to_degrees;
    [
        format!("{} in {} kg/m³", vehicle.name, vehicle.water.density_kg_m3),
        format!("  speed            {:9.4} m/s", glide.speed_m_s),
        format!("  path angle       {:9.4}°", degrees(glide.path_angle_rad)),
        format!("  angle of attack  {:9.4}°", degrees(glide.alpha_rad)),
        format!("  pitch            {:9.4}°", degrees(glide.pitch_rad)),
        format!("  bank, sideslip   {:9.4}°, {:.4}°", degrees(glide.phi_rad), degrees(glide.beta_rad)),
        format!("  net mass         {:9.4} kg", glide.net_mass_kg),
        format!("  r_px, mu         {:9.4} m, {:.4}°", glide.r_px_m, degrees(glide.mu_rad)),
        format!("  displaced volume {:9.6} m³", glide.displaced_volume_m3),
        format!("  C_L, C_D         {:9.5}, {:.5}", glide.lift_coefficient, glide.drag_coefficient),
    ]
    .join("\n")
}

pub(super) fn draw(args: &DrawArgs) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let glide = args.glide.solve(&vehicle)?;
    let sheet = sheet(&vehicle, &DrawnGlide::new(&vehicle, &glide));
    match &args.output {
        Some(path) => whole_file::write(path, |file| writeln!(file, "{sheet}")),
        None => super::print(&sheet),
    }
}
