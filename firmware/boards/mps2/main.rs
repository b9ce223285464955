//! The application on `mps2-an386` (Cortex-M4F) under QEMU, at two FIFOs of the host.
//!
//! The emulator's working directory holds `to-firmware`, `from-firmware` and, written here, `log.defmt`. The emulation ends
//! with success when the host closes its end, and with failure when there is no link, no table, or after a panic.

#![no_std]
#![no_main]

mod board;
mod log;
mod semihosting;

use board::Emulated;
use cortex_m_rt::entry;
use cortex_m_semihosting::debug::{EXIT_FAILURE, EXIT_SUCCESS, exit};
use firmware::{TRIM_TABLE, app::App};
use semihosting::{HostFile, HostLink};
use shared::table::TrimTable;

#[entry]
fn main() -> ! {
    log::open();
    let status = if run().is_some() { EXIT_SUCCESS } else { EXIT_FAILURE };
    loop {
        exit(status);
    }
}

/// Serves the link until the host closes it; `None` if that could not even begin.
fn run() -> Option<()> {
    let from_host = HostFile::to_read(c"to-firmware")?;
    let to_host = HostFile::to_write(c"from-firmware")?;
    let core = cortex_m::Peripherals::take()?;
    let table = TrimTable::parse(TRIM_TABLE).inspect_err(|error| defmt::error!("trim table: {:?}", error)).ok()?;
    let mut app = App::start(HostLink { from_host, to_host }, Emulated::new(core.SYST), table).ok()?;
    app.simulate();
    Some(())
}
