//! One firmware in one emulator, in a scratch folder.

use std::{
    fs::File,
    path::{Path, PathBuf},
};

use sim_host::flight::link::{Emulator, FirmwarePilot, Machine, Stream};
use tempfile::TempDir;

use crate::{dive::Dive, image, log};

/// An emulated board that was just switched on.
#[derive(Debug)]
pub struct Bench {
    /// Our end of the link.
    pub stream: Stream,
    /// The emulator.
    pub emulator: Emulator,
    image: PathBuf,
    folder: TempDir,
}

impl Bench {
    /// Builds `bin` and starts it on the board that it is for.
    ///
    /// # Panics
    /// If it does not build or start.
    #[must_use]
    pub fn start(machine: Machine, bin: &str) -> Self {
        let image = image::build(image::feature(machine), bin);
        let folder = tempfile::tempdir().expect("a scratch folder");
        let (emulator, stream) = Emulator::start(machine, &image, folder.path()).expect("an emulated board");
        Self { stream, emulator, image, folder }
    }

    /// Gives the firmware a dive to fly, and logs the link. The scratch folder and the image stay, to look at afterwards.
    ///
    /// # Panics
    /// If the firmware does not take it.
    #[must_use]
    pub fn pilot(mut self, dive: &Dive) -> (FirmwarePilot, Traces) {
        let traces = Traces { image: self.image, folder: self.folder };
        self.stream.log_to(File::create(traces.frames()).expect("a log in the scratch folder"));
        let pilot =
            FirmwarePilot::connect(self.stream, Some(self.emulator), dive.vehicle_hash(), &dive.configuration());
        (pilot.unwrap_or_else(|error| panic!("{error}; log: {:#?}", traces.log())), traces)
    }

    /// What it has logged so far.
    #[must_use]
    pub fn log(&self) -> Vec<String> {
        read_log(&self.image, self.folder.path())
    }
}

/// What a run leaves behind.
#[derive(Debug)]
pub struct Traces {
    image: PathBuf,
    folder: TempDir,
}

impl Traces {
    /// What was logged.
    #[must_use]
    pub fn log(&self) -> Vec<String> {
        read_log(&self.image, self.folder.path())
    }

    /// What went over the link.
    #[must_use]
    pub fn frames(&self) -> PathBuf {
        self.folder().join("flight.frames")
    }

    /// The scratch folder.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }
}

fn read_log(image: &Path, folder: &Path) -> Vec<String> {
    let frames = std::fs::read(folder.join("log.defmt")).unwrap_or_default();
    log::decode(image, &frames)
}
