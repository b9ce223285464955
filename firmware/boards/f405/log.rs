//! The log on USART2, and what is left to do after a panic.

#![allow(unsafe_code, reason = "a log line may come from anywhere, and a panic owns nothing")]

use core::panic::PanicInfo;

use stm32f4xx_hal::pac::{GPIOB, TIM3, USART2};

use crate::uart::send;

#[path = "../logger.rs"]
mod logger;
use logger::log_panic;

/// Best effort: a log that nobody takes stops nothing.
fn transmit(bytes: &[u8]) {
    // SAFETY: log lines are sent with interrupts off, one at a time.
    let uart = unsafe { &*USART2::ptr() };
    let _ = bytes.iter().try_for_each(|byte| send(uart, *byte));
}

/// Stops the three motors, shuts the valve and drops the brakes, by registers alone: it owns nothing and waits for nothing.
fn force_safe() {
    // SAFETY: the program is over; nobody else will touch these registers again.
    let (motors, pins) = unsafe { (&*TIM3::ptr(), &*GPIOB::ptr()) };
    for channel in 0..3 {
        motors.ccr(channel).write(|w| w.ccr().set(0));
    }
    // Duties are preloaded: this takes them over at once.
    motors.egr().write(|w| w.ug().update());
    pins.bsrr().write(|w| w.br1().reset().br13().reset().br15().reset());
}

/// Safe for good: interrupts off, asleep.
pub(crate) fn stay_safe() -> ! {
    cortex_m::interrupt::disable();
    force_safe();
    loop {
        cortex_m::asm::wfi();
    }
}

#[panic_handler]
fn panic(info: &PanicInfo<'_>) -> ! {
    cortex_m::interrupt::disable();
    force_safe();
    log_panic(info);
    stay_safe()
}

#[defmt::panic_handler]
fn defmt_panic() -> ! {
    stay_safe()
}

#[cortex_m_rt::exception]
unsafe fn HardFault(_: &cortex_m_rt::ExceptionFrame) -> ! {
    force_safe();
    defmt::error!("hard fault");
    stay_safe()
}
