//! The board as the emulator has it: a core clock, and no devices.

use cortex_m::peripheral::{SYST, syst::SystClkSource};
use firmware::{app::Board, flight::Stopwatch};
use shared::{commands::Commands, device::Measurements};

/// SysTick counts down through all of its 24 bits.
const FULL_TURN: u32 = 0x00ff_ffff;

/// A core clock, and no devices: this board only ever simulates.
pub(crate) struct Emulated(());

impl Emulated {
    /// Starts the stopwatch.
    pub(crate) fn new(mut systick: SYST) -> Self {
        systick.set_clock_source(SystClkSource::Core);
        systick.set_reload(FULL_TURN);
        systick.clear_current();
        systick.enable_counter();
        Self(())
    }
}

impl Stopwatch for Emulated {
    fn now(&self) -> u32 {
        SYST::get_current()
    }

    fn clocks_since(&self, start: u32) -> u32 {
        start.wrapping_sub(self.now()) & FULL_TURN
    }
}

impl Board for Emulated {
    const NAME: &'static str = "mps2-an386";

    fn bench_jumper_fitted(&mut self) -> bool {
        true
    }

    fn beats(&self) -> u32 {
        0
    }

    fn run_actuators(&mut self) {}

    fn measure(&mut self) -> Measurements {
        Measurements::silent()
    }

    fn order(&mut self, _: &Commands) {}

    fn make_safe(&mut self) {}

    fn sleep(&mut self, _: u32) {}
}
