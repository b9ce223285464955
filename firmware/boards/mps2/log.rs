//! The log as a file of the host, and what is left to do after a panic.

use core::{cell::Cell, panic::PanicInfo};

use critical_section::Mutex;
use embedded_io::Write;

use crate::{semihosting::HostFile, start::end};

#[path = "../logger.rs"]
mod logger;
use logger::log_panic;

static LOG: Mutex<Cell<Option<HostFile>>> = Mutex::new(Cell::new(None));

/// From here on, log lines go to this file of the host.
pub(crate) fn open() {
    let file = HostFile::to_write(c"log.defmt");
    critical_section::with(|token| LOG.borrow(token).set(file));
}

/// Best effort: a log that cannot be written stops nothing.
fn transmit(bytes: &[u8]) {
    let file = critical_section::with(|token| LOG.borrow(token).get());
    if let Some(mut file) = file
        && !bytes.is_empty()
    {
        let _ = file.write_all(bytes);
    }
}

/// There are no actuators to put safe; ends the emulation, so that whoever waits for an answer learns of it.
#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    log_panic(info);
    end(false)
}

#[defmt::panic_handler]
fn defmt_panic() -> ! {
    end(false)
}

#[allow(unsafe_code, reason = "cortex-m-rt asks for it, since the stack may be gone")]
#[cortex_m_rt::exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    defmt::error!("hard fault");
    end(false)
}
