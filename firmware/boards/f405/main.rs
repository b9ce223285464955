//! The application on an STM32F405, at its USART1.
//!
//! The same image boots under QEMU as `netduinoplus2`, where no crystal starts and every pin, the bench jumper's too, reads
//! low. Without a link or a sound table it stays safe for good.

#![no_std]
#![no_main]

mod board;
mod clock;
mod converter;
mod log;
mod uart;

use cortex_m_rt::entry;
use firmware::app::App;

#[entry]
fn main() -> ! {
    run();
    log::stay_safe()
}

/// Flies for good, or simulates for as long as there is a link; `None` if that could not even begin.
fn run() -> Option<()> {
    let (board, link, table) = board::start()?;
    let mut app = App::start(link, board, table).ok()?;
    if app.is_simulation() {
        app.simulate()
    } else {
        app.fly()
    };
    Some(())
}
