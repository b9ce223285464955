//! `glider schema`: what a file may hold, for editors that complete and check it.

use crate::flight::mission_file::MissionFile;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// Kind of file
    #[arg(value_enum)]
    kind: Kind,
}

#[derive(Clone, Copy, Debug, clap::ValueEnum)]
enum Kind {
    /// What `glider fly` flies
    Mission,
}

pub(super) fn run(args: &Args) -> Result<(), String> {
    let schema = match args.kind {
        Kind::Mission => MissionFile::schema(),
    };
    super::print(&format!("{schema:#}"))
}
