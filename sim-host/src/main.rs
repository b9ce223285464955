//! The command `glider`.

use std::process::ExitCode;

fn main() -> ExitCode {
    sim_host::cli::main()
}
