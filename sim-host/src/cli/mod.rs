//! The command line of `glider`: answers on stdout, everything else on stderr, one clear line on bad input.

mod campaign;
mod design;
mod endurance;
mod envelope;
mod fly;
mod locus;
mod margins;
mod paper;
mod plan;
mod polar;
mod progress;
mod replay;
mod schema;
mod sensitivity;
mod size;
mod stability;
mod swing;
mod table;
mod trials;
mod trim;

use std::{
    io::{self, Read, Write},
    process::ExitCode,
};

use clap::{Parser, Subcommand};
use serde::Serialize;

use crate::analysis::eval;
use crate::model::vehicle::Vehicle;

/// Underwater gliders: see how one flies before cutting metal, and fly what was seen.
#[derive(Debug, Parser)]
#[command(name = "glider", version, arg_required_else_help = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Fly a mission, controller in the loop, and report on it
    Fly(fly::Args),
    /// Replay a recorded flight: does the controller still command what it commanded, bit for bit?
    Replay(replay::Args),
    /// Plan a mission: how long, how much energy, and where the vehicle will surface, with an ellipse of uncertainty
    Plan(plan::Args),
    /// Fly a mission with many vehicles, each a little off its file, and compare the autopilot with a classical controller
    Campaign(campaign::Args),
    /// Fly the autopilot's sea trials: every mission in three waters, and each promise beside its number
    Trials(trials::Args),
    /// Find a steady straight glide: wings level, or banked if the vehicle is not symmetric
    Trim(trim::Args),
    /// Turn a glide: how much mu, roll and sideslip it takes, and how fast it can turn
    Turn(stability::TurnArgs),
    /// Disturb a glide: eigenvalues and modes
    Modes(stability::ModesArgs),
    /// Close the controller's loops around the linearised plant: their gain and delay margins over the trim table's envelope
    Margins(margins::Args),
    /// Vary the shape: how the modes move, as root loci
    Locus(locus::Args),
    /// Rank the geometry: exact derivatives of performance, modes and turning by every parameter
    Sensitivity(sensitivity::Args),
    /// Find the best geometry within bounds, and what range costs in agility
    Design(design::Args),
    /// Reproduce every figure and table of the paper, side by side with what it prints
    Paper(paper::Args),
    /// Mark the drag polar: flattest glide and maximum horizontal speed
    Polar(polar::Args),
    /// Size the buoyancy engine: the lung that a speed takes, for this shape or another
    Size(size::Args),
    /// Count the dives of a battery: range and endurance, ideal and realistic
    Endurance(endurance::Args),
    /// Generate the trim table that flies
    Table(table::Args),
    /// Swing the compass on the pier: its errors over the battery's position, as the vehicle file's section [compass]
    Swing(swing::Args),
    /// Draw a three-view to scale and the forces of a steady glide, as SVG
    Draw(trim::DrawArgs),
    /// Print the JSON Schema of a kind of file, for editors that complete and check it
    Schema(schema::Args),
    /// Put one state through the equations: JSON from stdin, JSON to stdout
    Eval(EvalArgs),
}

#[derive(Debug, clap::Args)]
struct EvalArgs {
    /// Path of a vehicle file, or the name of an embedded vehicle
    vehicle: String,
    /// One JSON object (the only form there is)
    #[arg(long)]
    json: bool,
}

/// Runs the command line; the exit code is 0 if all went well.
#[must_use]
pub fn main() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Fly(args) => fly::run(&args),
        Command::Replay(args) => replay::run(&args),
        Command::Plan(args) => plan::run(&args),
        Command::Campaign(args) => campaign::run(&args),
        Command::Trials(args) => trials::run(&args),
        Command::Trim(args) => trim::run(&args),
        Command::Turn(args) => stability::turn(&args),
        Command::Modes(args) => stability::run_modes(&args),
        Command::Margins(args) => margins::run(&args),
        Command::Locus(args) => locus::run(&args),
        Command::Sensitivity(args) => sensitivity::run(&args),
        Command::Design(args) => design::run(&args),
        Command::Paper(args) => paper::run(&args),
        Command::Polar(args) => polar::run(&args),
        Command::Size(args) => size::run(&args),
        Command::Endurance(args) => endurance::run(&args),
        Command::Table(args) => table::run(&args),
        Command::Swing(args) => swing::run(&args),
        Command::Draw(args) => trim::draw(&args),
        Command::Schema(args) => schema::run(&args),
        Command::Eval(args) => run_eval(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn run_eval(args: &EvalArgs) -> Result<(), String> {
    let vehicle = load_vehicle(&args.vehicle)?;
    let mut text = String::new();
    io::stdin().read_to_string(&mut text).map_err(|error| format!("stdin: {error}"))?;
    let request = serde_json::from_str(&text).map_err(|error| format!("stdin: {error}"))?;
    print_json(&eval::eval(&vehicle, &request))
}

fn load_vehicle(name_or_path: &str) -> Result<Vehicle, String> {
    Vehicle::load(name_or_path).map_err(|error| error.to_string())
}

/// One object on stdout.
fn print_json(answer: &impl Serialize) -> Result<(), String> {
    let text = serde_json::to_string(answer).map_err(|error| format!("JSON: {error}"))?;
    print(&text)
}

/// A line on stdout. A reader that has gone away is no error.
fn print(text: &str) -> Result<(), String> {
    match writeln!(io::stdout(), "{text}") {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(format!("stdout: {error}")),
        Ok(()) | Err(_) => Ok(()),
    }
}
