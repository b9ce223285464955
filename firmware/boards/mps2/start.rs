//! From reset to hello, the same for every binary of this board.

use cortex_m_semihosting::debug::{EXIT_FAILURE, EXIT_SUCCESS, exit};
use firmware::{TRIM_TABLE, app::App};
use shared::model::table::TrimTable;

use crate::{
    board::Emulated,
    log,
    semihosting::{HostFile, HostLink},
};

/// Opens log and link and says hello; `None` if there is no link or no sound trim table.
pub(crate) fn start() -> Option<App<'static, HostLink, Emulated>> {
    log::open();
    let from_host = HostFile::to_read(c"to-firmware")?;
    let to_host = HostFile::to_write(c"from-firmware")?;
    let core = cortex_m::Peripherals::take()?;
    let table = TrimTable::parse(TRIM_TABLE).inspect_err(|error| defmt::error!("trim table: {:?}", error)).ok()?;
    App::start(HostLink { from_host, to_host }, Emulated::new(core.SYST), table).ok()
}

/// Ends the emulation.
pub(crate) fn end(success: bool) -> ! {
    loop {
        exit(if success { EXIT_SUCCESS } else { EXIT_FAILURE });
    }
}
