//! The application on `mps2-an386` (Cortex-M4F) under QEMU, at two FIFOs of the host.
//!
//! The emulator's working directory holds `to-firmware`, `from-firmware` and, written here, `log.defmt`. The emulation ends
//! with success when the host closes its end, and with failure when there is no link, no table, or after a panic.

#![no_std]
#![no_main]

mod board;
mod log;
mod semihosting;
mod start;

use cortex_m_rt::entry;

#[entry]
fn main() -> ! {
    let mut app = start::start();
    if let Some(app) = app.as_mut() {
        app.simulate();
    }
    start::end(app.is_some())
}
