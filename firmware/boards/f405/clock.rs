//! The clock tree: the crystal if it starts in time, else the internal oscillator. No PLL, so nothing else to wait for.

use stm32f4xx_hal::{
    pac::RCC,
    prelude::*,
    rcc::{Config, Rcc},
};

/// The crystal of the board, MHz.
const CRYSTAL_MHZ: u32 = 8;
/// Polls before the crystal is given up: a start takes 2 ms, and a poll of the 16 MHz core some ten clocks.
const CRYSTAL_POLLS: u32 = 20_000;

/// Starts the clocks; also tells whether the crystal keeps the time, rather than the oscillator with its 1 %.
pub(crate) fn start(rcc: RCC) -> (Rcc, bool) {
    rcc.cr().modify(|_, w| w.hseon().on());
    let crystal = (0..CRYSTAL_POLLS).any(|_| rcc.cr().read().hserdy().is_ready());
    let config = if crystal { Config::hse(CRYSTAL_MHZ.MHz()) } else { Config::hsi() };
    (rcc.freeze(config), crystal)
}
