//! `glider turn` and `glider modes`: what a glide does when it is turned or disturbed.

use serde::Serialize;

use super::trim::GlideArgs;
use crate::analysis::{
    modes::{ModeSet, RollKinematics, modes},
    turn::{Authorities, Authority, Sensitivities, Sensitivity, Turns},
};

#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("condition").required(true)))]
pub(super) struct TurnArgs {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    glide: GlideArgs,
    /// Also solve for the exact helix at this turn rate; right positive
    #[arg(long, value_name = "W", allow_negative_numbers = true)]
    turn_rate_rad_s: Option<f64>,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, clap::Args)]
#[command(group(clap::ArgGroup::new("condition").required(true)))]
pub(super) struct ModesArgs {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    #[command(flatten)]
    glide: GlideArgs,
    /// φ̇ = p + r tanθ, or φ̇ = p as in the paper's Table 2
    #[arg(long, value_enum, default_value_t = RollKinematics::Exact)]
    roll_kinematics: RollKinematics,
    /// One JSON object instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Serialize)]
struct TurnAnswer {
    sensitivity: Sensitivities,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<Exact>,
    authority: Authorities,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct Exact {
    alpha_rad: f64,
    beta_rad: f64,
    phi_rad: f64,
    pitch_rad: f64,
    path_angle_rad: f64,
    mu_rad: f64,
    r_px_m: f64,
    speed_m_s: f64,
    radius_m: f64,
}

pub(super) fn turn(args: &TurnArgs) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let glide = args.glide.solve(&vehicle)?;
    let turns = Turns::new(&vehicle, &glide)?;
    let helix = args.turn_rate_rad_s.map(|rate| turns.at_rate(rate)).transpose()?;
    let mut warnings = glide.warnings.clone();
    if let Some(helix) = &helix {
        let (mu_deg, [left, right]) = (helix.mu_rad.to_degrees(), vehicle.moving_mass.roll_deg);
        if !(left..=right).contains(&mu_deg) {
            warnings.push(format!("mu {mu_deg:.2}° is beyond the rotation of the moving mass, {left} to {right}°"));
        }
    }
    let answer = TurnAnswer {
        sensitivity: turns.sensitivities(&glide),
        exact: helix.map(|helix| Exact {
            alpha_rad: helix.alpha_rad,
            beta_rad: helix.beta_rad,
            phi_rad: helix.roll_rad,
            pitch_rad: helix.pitch_rad,
            path_angle_rad: helix.path_angle_rad(),
            mu_rad: helix.mu_rad,
            r_px_m: helix.r_px_m,
            speed_m_s: helix.speed_m_s,
            radius_m: helix.radius_m(),
        }),
        authority: turns.authorities(),
        warnings,
    };
    if args.json {
        return super::print_json(&answer);
    }
    for warning in &answer.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(&describe_turn(&vehicle.name, turns.sense(), &answer))
}

fn describe_turn(name: &str, sense: f64, answer: &TurnAnswer) -> String {
    let side = if sense > 0.0 { "left (mu > 0)" } else { "right (mu < 0)" };
    let mut lines = vec![
        format!("{name} turns right when its mass swings to the {side}"),
        "per °/s of turn rate              mu          roll      sideslip".into(),
        sensitivity_line("full equations", answer.sensitivity.numeric),
        sensitivity_line("linear system", answer.sensitivity.linear),
        sensitivity_line("eqs (14)-(16)", answer.sensitivity.closed_form),
        authority_line("right", &answer.authority.right),
        authority_line("left", &answer.authority.left),
    ];
    if let Some(exact) = &answer.exact {
        let d = f64::to_degrees;
        lines.push(format!(
            "helix: radius {:.1} m, speed {:.4} m/s, mu {:.3}°, roll {:.3}°, sideslip {:.3}°, angle of attack {:.4}°, path angle {:.3}°, r_px {:.4} m",
            exact.radius_m,
            exact.speed_m_s,
            d(exact.mu_rad),
            d(exact.phi_rad),
            d(exact.beta_rad),
            d(exact.alpha_rad),
            d(exact.path_angle_rad),
            exact.r_px_m
        ));
    }
    lines.join("\n")
}

fn sensitivity_line(name: &str, sensitivity: Option<Sensitivity>) -> String {
    // Degrees per °/s are rad per rad/s.
    sensitivity.map_or_else(
        || format!("  {name:<20} does not apply to this vehicle"),
        |s| format!("  {name:<20} {:10.3}°   {:10.3}°   {:9.4}°", s.mu_s, s.phi_s, s.beta_s),
    )
}

fn authority_line(side: &str, authority: &Authority) -> String {
    format!(
        "  fastest {side:<5} {:+.4} °/s within the mass's travel; {:+.4} °/s at mu {:.1}°, where {}",
        authority.within_travel_rad_s.to_degrees(),
        authority.largest_turn_rate_rad_s.to_degrees(),
        authority.mu_rad.to_degrees(),
        if authority.reverses { "the response reverses" } else { "steady turns end" }
    )
}

pub(super) fn run_modes(args: &ModesArgs) -> Result<(), String> {
    let vehicle = super::load_vehicle(&args.vehicle)?;
    let glide = args.glide.solve(&vehicle)?;
    let answer = modes(&vehicle, &glide, args.roll_kinematics)?;
    if args.json {
        return super::print_json(&answer);
    }
    for warning in &answer.warnings {
        eprintln!("warning: {warning}");
    }
    super::print(&format!(
        "{}\n{}",
        describe_modes("longitudinal", &answer.longitudinal),
        describe_modes("lateral", &answer.lateral)
    ))
}

fn describe_modes(title: &str, set: &ModeSet) -> String {
    let states = set.states.map(|state| format!("{state:>16}")).join("");
    let mut lines = vec![format!("{title:<14} eigenvalue, 1/s      {states}   damping  period, s  half in, s")];
    for i in 0..set.names.len() {
        let [re, im] = set.eigenvalues[i];
        let entries = set.eigenvectors[i]
            .map(|[re, im]| format!("{:>9.4}∠{:<6.1}", re.hypot(im), im.atan2(re).to_degrees()))
            .join("");
        let figure = |value: Option<f64>, decimals: usize| {
            value.map_or_else(|| "–".to_owned(), |value| format!("{value:.decimals$}"))
        };
        let [damping, period, half] =
            [figure(set.damping_ratio[i], 3), figure(set.period_s[i], 2), figure(set.time_to_half_s[i], 2)];
        lines
            .push(format!("  {re:>10.4} {im:>+9.4}i {entries} {damping:>8} {period:>10} {half:>11}  {}", set.names[i]));
    }
    if let Some(participation) = set.participation {
        lines.push(format!("  participation, %       {states}"));
        for (shares, name) in participation.iter().zip(set.names) {
            let shares = shares.map(|share| format!("{:>16.1}", 100.0 * share)).join("");
            lines.push(format!("  {:<22} {shares}   {name}", ""));
        }
    }
    lines.join("\n")
}
