//! The analogue converter: one channel after the other, each wait bounded.

use firmware::calibration::Counts;
use stm32f4xx_hal::{
    pac::ADC1,
    rcc::{Enable, Rcc},
};

/// Polls for one conversion: it takes 492 converter clocks, and a poll some ten of the core's.
const CONVERSION_POLLS: u32 = 1_000;
/// 480 converter clocks of sampling: potentiometers are slow sources.
const LONGEST_SAMPLE: u8 = 0b111;

/// Channels 10 to 13, on PC0 to PC3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Channel {
    Vbd = 10,
    RPx = 11,
    Mu = 12,
    Battery = 13,
}

pub(crate) struct Converter(ADC1);

impl Converter {
    /// Switches the converter on; its pins must be analogue.
    pub(crate) fn new(adc: ADC1, rcc: &mut Rcc) -> Self {
        ADC1::enable(rcc);
        adc.smpr1().modify(|_, w| {
            w.smp10().set(LONGEST_SAMPLE);
            w.smp11().set(LONGEST_SAMPLE);
            w.smp12().set(LONGEST_SAMPLE);
            w.smp13().set(LONGEST_SAMPLE)
        });
        adc.cr2().modify(|_, w| w.adon().enabled());
        Self(adc)
    }

    /// One reading; 0, which no healthy potentiometer gives, if the converter does not answer.
    pub(crate) fn read(&mut self, channel: Channel) -> Counts {
        self.choose(channel);
        let adc = &self.0;
        adc.cr2().modify(|_, w| w.swstart().start());
        let done = (0..CONVERSION_POLLS).any(|_| adc.sr().read().eoc().is_complete());
        Counts(if done { adc.dr().read().data().bits() } else { 0 })
    }

    #[allow(unsafe_code, reason = "the register's description does not know which channels there are")]
    fn choose(&mut self, channel: Channel) {
        // SAFETY: every `Channel` is a channel of ADC1.
        self.0.sqr3().modify(|_, w| unsafe { w.sq1().bits(channel as u8) });
    }
}
