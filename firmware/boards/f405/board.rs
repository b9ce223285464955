//! What is wired to which pin of the F405, and how it starts.
//!
//! | pin | what |
//! |---|---|
//! | PA9, PA10 | USART1: link, 115,200 baud |
//! | PA2, PA3 | USART2: log (PA3 unused) |
//! | PA6, PA7, PB0 | TIM3 PWM: pump, axial mass, rotation of the mass |
//! | PB1 | bleed valve, high opens |
//! | PB12, PB13 | axial mass: direction, brake (high releases) |
//! | PB14, PB15 | rotation of the mass: direction, brake (high releases) |
//! | PB5 | bench jumper to ground |
//! | PC0, PC1, PC2, PC3 | potentiometers of piston, axis and rotation; battery over 11 |

use core::sync::atomic::{AtomicU32, Ordering};

use cortex_m::peripheral::{SYST, syst::SystClkSource};
use cortex_m_rt::exception;
use firmware::{
    BEAT_HZ, TRIM_TABLE,
    actuators::{Actuators, Readings},
    app::Board,
    flight::Stopwatch,
    mass::{Axis, AxisCalibration},
    pump::{Pump, PumpCalibration},
};
use shared::{commands::Commands, device::Measurements, model::table::TrimTable};
use stm32f4xx_hal::{
    gpio::{AnyPin, Input, Output},
    pac::{Interrupt, NVIC, Peripherals, TIM3},
    prelude::*,
    serial::config::Config,
    timer::ErasedChannel,
};

use crate::{
    clock,
    converter::{Channel, Converter},
    uart::Link,
};

const BAUD: u32 = 115_200;
/// Above hearing, and slow enough for 400 steps of duty at the crystal's 8 MHz.
const PWM_KHZ: u32 = 20;
/// Battery voltage per count: 3.3 V over 4096 steps behind a divider by 11, µV.
const BATTERY_UV_PER_COUNT: u32 = 8_862;
const UV_PER_MV: u32 = 1_000;

static BEATS: AtomicU32 = AtomicU32::new(0);

#[exception]
fn SysTick() {
    BEATS.store(BEATS.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
}

/// Sleeps until an interrupt comes, unless `busy`; an interrupt between the question and the sleep still wakes it.
pub(crate) fn sleep_unless(busy: impl Fn() -> bool) {
    cortex_m::interrupt::free(|_| {
        if !busy() {
            cortex_m::asm::wfi();
        }
    });
}

/// The devices of the F405.
pub(crate) struct F405 {
    pub(crate) actuators: Actuators<ErasedChannel<TIM3>, AnyPin<Output>>,
    converter: Converter,
    jumper: AnyPin<Input>,
    clocks_per_beat: u32,
}

/// Starts clocks and devices, actuators stopped. `None`: called twice, no sound trim table, or a baud rate out of reach.
pub(crate) fn start() -> Option<(F405, Link, TrimTable<'static>)> {
    let (core, device) = (cortex_m::Peripherals::take()?, Peripherals::take()?);
    let (mut rcc, crystal) = clock::start(device.RCC);
    let (gpioa, gpiob) = (device.GPIOA.split(&mut rcc), device.GPIOB.split(&mut rcc));
    let gpioc = device.GPIOC.split(&mut rcc);

    let baud = || Config::default().baudrate(BAUD.bps());
    device.USART2.serial::<u8>((gpioa.pa2, gpioa.pa3), baud(), &mut rcc).ok()?;
    if !crystal {
        defmt::warn!("no crystal: time may be 1 % off");
    }
    let table = TrimTable::parse(TRIM_TABLE).inspect_err(|error| defmt::error!("trim table: {:?}", error)).ok()?;

    let mut link = device.USART1.serial::<u8>((gpioa.pa9, gpioa.pa10), baud(), &mut rcc).ok()?;
    link.listen(stm32f4xx_hal::serial::Event::RxNotEmpty);
    unmask_link();

    let (_, (pump, axial, rotation, _)) = device.TIM3.pwm_hz(PWM_KHZ.kHz(), &mut rcc);
    let mut motors = (pump.with(gpioa.pa6), axial.with(gpioa.pa7), rotation.with(gpiob.pb0));
    motors.0.enable();
    motors.1.enable();
    motors.2.enable();
    let drives = &table.vehicle().actuators;
    let pump = Pump::new(motors.0.erase(), gpiob.pb1.into_push_pull_output().erase(), PumpCalibration::nominal(drives));
    let axial = Axis::new(
        motors.1.erase(),
        gpiob.pb12.into_push_pull_output().erase(),
        gpiob.pb13.into_push_pull_output().erase(),
        AxisCalibration::nominal_axial(drives),
    );
    let rotation = Axis::new(
        motors.2.erase(),
        gpiob.pb14.into_push_pull_output().erase(),
        gpiob.pb15.into_push_pull_output().erase(),
        AxisCalibration::nominal_rotation(drives),
    );
    let _ = (gpioc.pc0.into_analog(), gpioc.pc1.into_analog(), gpioc.pc2.into_analog(), gpioc.pc3.into_analog());
    let converter = Converter::new(device.ADC1, &mut rcc);
    let board = F405 {
        actuators: Actuators::new(pump, axial, rotation),
        converter,
        jumper: gpiob.pb5.into_pull_up_input().erase(),
        clocks_per_beat: start_beats(core.SYST, rcc.clocks.hclk().raw()),
    };
    Some((board, Link::new(), table))
}

/// Starts SysTick at the drivers' rate; returns the counts of the core clock in a beat.
fn start_beats(mut systick: SYST, core_hz: u32) -> u32 {
    let clocks_per_beat = core_hz / BEAT_HZ;
    systick.set_clock_source(SystClkSource::Core);
    systick.set_reload(clocks_per_beat.saturating_sub(1));
    systick.clear_current();
    systick.enable_counter();
    systick.enable_interrupt();
    clocks_per_beat
}

#[allow(unsafe_code, reason = "unmasking may break a critical section by mask; there is none yet")]
fn unmask_link() {
    // SAFETY: no critical section depends on this interrupt being masked.
    unsafe { NVIC::unmask(Interrupt::USART1) };
}

impl Stopwatch for F405 {
    fn now(&self) -> u32 {
        SYST::get_current()
    }

    /// SysTick counts down, once around per beat.
    fn clocks_since(&self, start: u32) -> u32 {
        let now = self.now();
        if now <= start { start - now } else { start.wrapping_add(self.clocks_per_beat).wrapping_sub(now) }
    }
}

impl Board for F405 {
    const NAME: &'static str = "f405";

    fn bench_jumper_fitted(&mut self) -> bool {
        self.jumper.is_low()
    }

    fn beats(&self) -> u32 {
        BEATS.load(Ordering::Relaxed)
    }

    fn run_actuators(&mut self) {
        let readings = Readings {
            vbd: self.converter.read(Channel::Vbd),
            r_px: self.converter.read(Channel::RPx),
            mu: self.converter.read(Channel::Mu),
        };
        self.actuators.beat(&readings);
    }

    fn measure(&mut self) -> Measurements {
        let positions = self.actuators.positions();
        // No count at all: the converter did not answer, for a battery of 0 V runs no board.
        let battery_counts = Some(u32::from(self.converter.read(Channel::Battery).0)).filter(|counts| *counts > 0);
        let battery_mv = battery_counts.map(|counts| counts.saturating_mul(BATTERY_UV_PER_COUNT) / UV_PER_MV);
        Measurements {
            r_px_um: positions.r_px_um,
            mu_cdeg: positions.mu_cdeg,
            vbd_ul: positions.vbd_ul,
            battery_mv: battery_mv.map(|mv| u16::try_from(mv).unwrap_or(u16::MAX)),
            ..Measurements::silent()
        }
    }

    fn order(&mut self, commands: &Commands) {
        self.actuators.order(commands);
    }

    fn make_safe(&mut self) {
        self.actuators.make_safe();
    }

    fn sleep(&mut self, beats_done: u32) {
        sleep_unless(|| !Link::is_empty() || self.beats() != beats_done);
    }
}
