//! A drill: starts like the application, then panics, so that a test sees what a panic leaves behind.

#![no_std]
#![no_main]

mod board;
mod log;
mod semihosting;
mod start;

use cortex_m_rt::entry;

#[entry]
fn main() -> ! {
    if start::start().is_some() {
        panic!("this is a drill");
    }
    start::end(false)
}
