//! Frames defmt's log lines, and hands them to the board's `transmit`.

#![allow(unsafe_code, reason = "`defmt::Logger` is an unsafe trait, and its line is shared with interrupts")]

use core::{cell::UnsafeCell, panic::PanicInfo};

use critical_section::RestoreState;

use super::transmit;

#[defmt::global_logger]
struct Logger;

/// What a log line needs from its first byte to its last.
struct Line {
    interrupts: UnsafeCell<RestoreState>,
    encoder: UnsafeCell<defmt::Encoder>,
}

// SAFETY: the cells are touched between `acquire` and `release` only, where interrupts are off on the only core.
unsafe impl Sync for Line {}

static LINE: Line =
    Line { interrupts: UnsafeCell::new(RestoreState::invalid()), encoder: UnsafeCell::new(defmt::Encoder::new()) };

// SAFETY: `acquire` turns interrupts off until `release`, so there is one line at a time. A panic inside a line begins another
// line, and interrupts then stay off, as they should.
unsafe impl defmt::Logger for Logger {
    fn acquire() {
        // SAFETY: `release` restores what this returns.
        let interrupts = unsafe { critical_section::acquire() };
        // SAFETY: interrupts are off, and no reference to the cells outlives a call.
        unsafe {
            *LINE.interrupts.get() = interrupts;
            (*LINE.encoder.get()).start_frame(transmit);
        }
    }

    unsafe fn flush() {}

    unsafe fn release() {
        // SAFETY: as in `acquire`, which was called before.
        unsafe {
            (*LINE.encoder.get()).end_frame(transmit);
            critical_section::release(*LINE.interrupts.get());
        }
    }

    unsafe fn write(bytes: &[u8]) {
        // SAFETY: as in `acquire`, which was called before.
        unsafe { (*LINE.encoder.get()).write(bytes, transmit) }
    }
}

/// Says where and why, without the formatting of `core::fmt`, which could panic itself.
pub(super) fn log_panic(info: &PanicInfo<'_>) {
    let (file, line) = info.location().map_or(("?", 0), |place| (place.file(), place.line()));
    defmt::error!("panic at {}:{}: {}", file, line, info.message().as_str().unwrap_or("(a message with values)"));
}
