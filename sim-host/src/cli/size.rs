//! `glider size`: how large a lung a speed takes, for the vehicle's shape or a changed one.

use serde::Serialize;

use crate::analysis::performance::{Hold, Size, Sizing};
use crate::model::{
    coefficients::{Anchoring, Parameter, Shape, Study},
    vehicle::Vehicle,
};

/// Points of a sweep.
const POINTS: u32 = 11;

/// Which shape, and where its coefficients come from.
#[derive(Debug, clap::Args)]
pub(super) struct ShapeArgs {
    /// Change the geometry: a key of the vehicle file and its value, such as hull.length_m=1.8; may be repeated
    #[arg(long, value_name = "KEY=VALUE", value_parser = change)]
    set: Vec<(Parameter, f64)>,
    /// Mass of water that the hull displaces, kg: its diameter gives way (or its length, where the fineness is set)
    #[arg(long, value_name = "KG")]
    displacement: Option<f64>,
    #[command(flatten)]
    anchoring: AnchoringArgs,
}

/// Where a changed shape's coefficients come from.
#[derive(Debug, clap::Args)]
pub(super) struct AnchoringArgs {
    /// Take coefficients from the geometry alone, instead of changing the vehicle's own by what the geometry changes
    #[arg(long)]
    unanchored: bool,
}

impl AnchoringArgs {
    pub(super) fn study<'a>(&self, vehicle: &'a Vehicle) -> Study<'a> {
        let anchoring = if self.unanchored { Anchoring::Unanchored } else { Anchoring::Anchored };
        Study { anchoring, ..Study::new(vehicle) }
    }
}

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// Speed at the flattest glide, m/s (default: the vehicle's nominal speed)
    #[arg(long, value_name = "M_S", conflicts_with = "lung_capacity")]
    speed: Option<f64>,
    /// Lung capacity as a fraction of the neutral displacement, to find the speed
    #[arg(long, value_name = "FRACTION")]
    lung_capacity: Option<f64>,
    #[command(flatten)]
    shape: ShapeArgs,
    /// Also vary one key of the geometry between two values
    #[arg(long, num_args = 3, value_names = ["KEY", "FROM", "TO"], allow_negative_numbers = true)]
    vary: Option<Vec<String>>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

/// One key and value of the geometry.
fn change(text: &str) -> Result<(Parameter, f64), String> {
    let (key, value) = text.split_once('=').ok_or("must be KEY=VALUE")?;
    Ok((key.parse()?, number(value)?))
}

fn number(text: &str) -> Result<f64, String> {
    text.parse().ok().filter(|value: &f64| value.is_finite()).ok_or_else(|| format!("`{text}` must be a finite number"))
}

impl ShapeArgs {
    /// The changed shape, checked as the vehicle file is.
    pub(super) fn shape(&self, vehicle: &Vehicle) -> Result<Shape, String> {
        self.with(vehicle, &self.set)
    }

    fn with(&self, vehicle: &Vehicle, changes: &[(Parameter, f64)]) -> Result<Shape, String> {
        let mut shape = Shape::of(vehicle);
        let hold = match self.displacement {
            Some(mass_kg) if mass_kg > 0.0 && mass_kg.is_finite() => Hold::Displacement(mass_kg),
            Some(mass_kg) => return Err(format!("displacement {mass_kg} kg: must be positive")),
            None => Hold::Geometry,
        };
        for (parameter, value) in changes {
            parameter.check(*value)?;
            *parameter.of(&mut shape) = *value;
        }
        let by_length = changes.iter().any(|(parameter, _)| *parameter == Parameter::HullFineness);
        let (kept, value) = if by_length {
            (Parameter::HullFineness, shape.hull.fineness)
        } else {
            (Parameter::HullLength, shape.hull.length_m)
        };
        let held = hold.with(&shape, kept, value, vehicle.water.density_kg_m3);
        Parameter::HullFineness.check(held.hull.fineness).map(|()| held)
    }

    pub(super) fn study<'a>(&self, vehicle: &'a Vehicle) -> Study<'a> {
        self.anchoring.study(vehicle)
    }
}

#[derive(Serialize)]
struct Answer {
    #[serde(flatten)]
    size: Size,
    #[serde(skip_serializing_if = "Option::is_none")]
    sweep: Option<Sweep>,
}

#[derive(Serialize)]
struct Sweep {
    parameter: &'static str,
    points: Vec<Point>,
}

#[derive(Serialize)]
struct Point {
    value: f64,
    #[serde(flatten)]
    size: Size,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let sizing = Sizing { study: args.shape.study(&vehicle) };
    let speed_m_s = args.speed.unwrap_or(vehicle.nominal_speed_m_s);
    if !(speed_m_s > 0.0 && speed_m_s.is_finite()) {
        return Err(format!("speed {speed_m_s} m/s: must be positive"));
    }
    let size = |shape: &Shape| match args.lung_capacity {
        Some(lung_capacity) => sizing.at_lung_capacity(shape, lung_capacity),
        None => sizing.at_speed(shape, speed_m_s),
    };
    let mut answer = Answer { size: size(&args.shape.shape(&vehicle)?)?, sweep: None };
    if let Some([key, from, to]) = args.vary.as_deref() {
        let parameter: Parameter = key.parse()?;
        let (from, to) = (number(from)?, number(to)?);
        let point = |i: u32| {
            let share = f64::from(i) / f64::from(POINTS - 1);
            let value = from * (1.0 - share) + to * share;
            let changes: Vec<_> = args.shape.set.iter().copied().chain([(parameter, value)]).collect();
            Ok(Point { value, size: size(&args.shape.with(&vehicle, &changes)?)? })
        };
        let points = (0..POINTS).map(point).collect::<Result<_, String>>()?;
        answer.sweep = Some(Sweep { parameter: parameter.key(), points });
    }
    if args.json {
        return super::print_json(&answer);
    }
    super::print(&describe(&vehicle.name, &answer))
}

fn describe(name: &str, answer: &Answer) -> String {
    let mut lines = vec![format!("{name} at its flattest glide"), describe_size(&answer.size)];
    if let Some(sweep) = &answer.sweep {
        lines.push(format!(
            "{:>20}  speed m/s  capacity %  net mass kg  displaces kg      L/D  hull       wing",
            sweep.parameter
        ));
        lines.extend(sweep.points.iter().map(|point| {
            let Point { value, size } = point;
            format!(
                "{value:>20.4} {:>10.4} {:>11} {:>12.4} {:>13.2} {:>8.3}  {:<9}  {}",
                size.speed_m_s,
                percent(size.lung_capacity),
                size.net_mass_kg,
                size.displaced_mass_kg,
                size.glide.lift_to_drag,
                size.hull_flow,
                size.wing_flow
            )
        }));
    }
    lines.join("\n")
}

/// A size as indented lines.
pub(super) fn describe_size(size: &Size) -> String {
    [
        format!("  speed             {:9.4} m/s", size.speed_m_s),
        format!("  lung capacity     {:>9} % of the neutral displacement", percent(size.lung_capacity)),
        format!("  net mass          {:9.4} kg, a stroke of {:.4} L", size.net_mass_kg, 1e3 * size.stroke_m3),
        format!("  hull displaces    {:9.3} kg at most", size.displaced_mass_kg),
        format!("  descent           {:9.4}°, L/D {:.3}", size.glide.descent_rad.to_degrees(), size.glide.lift_to_drag),
        format!("  C_D0, K           {:9.5}, {:.5}", size.c_d_zero, size.c_d_induced),
        format!("  flow along hull   {} (Re {:.3e})", size.hull_flow, size.hull_reynolds),
        format!("  flow along wing   {} (Re {:.3e})", size.wing_flow, size.wing_reynolds),
    ]
    .join("\n")
}

fn percent(lung_capacity: Option<f64>) -> String {
    lung_capacity.map_or_else(|| "none".into(), |eta| format!("{:.4}", 100.0 * eta))
}
