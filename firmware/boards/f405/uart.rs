//! The link on USART1: received by interrupt into a ring, sent byte by byte.

#![allow(unsafe_code, reason = "the interrupt and the panic handler reach their UART without owning it")]

use core::sync::atomic::{AtomicU8, AtomicUsize, Ordering};

use embedded_io::{ErrorKind, ErrorType, Read, ReadReady, Write};
use stm32f4xx_hal::pac::{USART1, interrupt, usart1::RegisterBlock};

/// Bytes that may arrive while the application is busy; a power of two.
const RING: usize = 1024;
/// Polls for one byte to leave: at 115,200 baud it takes 1,400 clocks of 16 MHz, and a poll some ten.
const SEND_POLLS: u32 = 10_000;

static BYTES: [AtomicU8; RING] = [const { AtomicU8::new(0) }; RING];
/// Bytes ever written to the ring, by the interrupt only.
static WRITTEN: AtomicUsize = AtomicUsize::new(0);
/// Bytes ever read from it, by the application only.
static TAKEN: AtomicUsize = AtomicUsize::new(0);

/// Both directions of USART1, set up by whoever makes this.
#[derive(Debug)]
pub(crate) struct Link(());

impl Link {
    /// Goes on with a UART that is set up and interrupts on every byte.
    pub(crate) const fn new() -> Self {
        Self(())
    }

    /// Whether nothing waits to be read.
    pub(crate) fn is_empty() -> bool {
        WRITTEN.load(Ordering::Acquire) == TAKEN.load(Ordering::Relaxed)
    }
}

#[interrupt]
fn USART1() {
    // SAFETY: only this interrupt reads the data register; reading status and data has no effect on sending.
    let uart = unsafe { &*USART1::ptr() };
    let status = uart.sr().read();
    // Reading the data clears every error flag; a byte that came with one is left to the frame's CRC.
    let byte = uart.dr().read().dr().bits() as u8;
    let written = WRITTEN.load(Ordering::Relaxed);
    let full = written.wrapping_sub(TAKEN.load(Ordering::Acquire)) >= RING;
    if status.rxne().bit_is_set()
        && !full
        && let Some(slot) = BYTES.get(written % RING)
    {
        slot.store(byte, Ordering::Relaxed);
        WRITTEN.store(written.wrapping_add(1), Ordering::Release);
    }
}

/// Sends one byte, unless the UART is off or does not get rid of it in time.
pub(crate) fn send(uart: &RegisterBlock, byte: u8) -> Result<(), ErrorKind> {
    let on = uart.cr1().read().ue().bit_is_set();
    if on && (0..SEND_POLLS).any(|_| uart.sr().read().txe().bit_is_set()) {
        uart.dr().write(|w| w.dr().set(u16::from(byte)));
        return Ok(());
    }
    Err(ErrorKind::TimedOut)
}

impl ErrorType for Link {
    type Error = ErrorKind;
}

impl ReadReady for Link {
    fn read_ready(&mut self) -> Result<bool, ErrorKind> {
        Ok(!Self::is_empty())
    }
}

impl Read for Link {
    /// Sleeps until there is something.
    fn read(&mut self, buffer: &mut [u8]) -> Result<usize, ErrorKind> {
        while Self::is_empty() {
            super::board::sleep_unless(|| !Self::is_empty());
        }
        let taken = TAKEN.load(Ordering::Relaxed);
        let there = WRITTEN.load(Ordering::Acquire).wrapping_sub(taken);
        let ring = BYTES.iter().cycle().skip(taken % RING);
        let mut count = 0_usize;
        for (slot, byte) in buffer.iter_mut().zip(ring.take(there)) {
            *slot = byte.load(Ordering::Relaxed);
            count = count.wrapping_add(1);
        }
        TAKEN.store(taken.wrapping_add(count), Ordering::Release);
        Ok(count)
    }
}

impl Write for Link {
    fn write(&mut self, bytes: &[u8]) -> Result<usize, ErrorKind> {
        // SAFETY: only the application sends on this UART.
        let uart = unsafe { &*USART1::ptr() };
        bytes.iter().try_for_each(|byte| send(uart, *byte))?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> Result<(), ErrorKind> {
        Ok(())
    }
}
