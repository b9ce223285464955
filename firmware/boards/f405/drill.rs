//! A drill: starts like the application, runs the motors, then panics, so that a test sees what a panic leaves behind.

#![no_std]
#![no_main]

mod board;
mod clock;
mod converter;
mod log;
mod uart;

use cortex_m_rt::entry;
use embedded_io::Read;
use firmware::{actuators::Readings, calibration::Counts};
use shared::commands::Commands;

/// The emulated converter never completes a conversion, so the drill brings its own readings: all in the middle.
const MIDDLE: Readings = Readings { vbd: Counts(2_048), r_px: Counts(2_048), mu: Counts(2_048) };

#[entry]
fn main() -> ! {
    if let Some((mut board, mut link, _)) = board::start() {
        let forward =
            Commands { vbd_rate_ul_s: 20_000, r_px_rate_um_s: 5_000, mu_rate_cdeg_s: 500, ..Commands::safe() };
        board.actuators.order(&forward);
        board.actuators.beat(&MIDDLE);
        defmt::info!("running");
        // Goes on at the host's word, when it has seen the motors run.
        let _ = link.read(&mut [0]);
        panic!("this is a drill");
    }
    log::stay_safe()
}
