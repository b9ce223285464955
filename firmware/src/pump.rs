//! The buoyancy device: a pump that makes the vehicle lighter, a bleed valve that makes it heavier.
//!
//! Motor and valve never work against each other, and neither works without a healthy potentiometer and a fresh order.

use embedded_hal::{digital::OutputPin, pwm::SetDutyCycle};
use shared::model::vehicle::{Actuators, Range};

use crate::{
    BEAT_HZ,
    calibration::{Counts, Implausible, Line},
    order::{Order, duty, within_travel},
};

/// What this very device does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PumpCalibration {
    /// Potentiometer of the piston, µl beyond neutral.
    pub vbd_ul: Line,
    /// Volumes between the end stops, µl.
    pub travel_ul: Range,
    /// Flow of the motor at full duty, µl/s.
    pub full_pump_ul_s: i32,
    /// Flow through the open valve, µl/s.
    pub full_bleed_ul_s: i32,
}

impl PumpCalibration {
    /// The vehicle's nominal device, before its own is measured.
    #[must_use]
    pub const fn nominal(actuators: &Actuators) -> Self {
        Self {
            vbd_ul: Line::over(actuators.vbd_ul),
            travel_ul: actuators.vbd_ul,
            full_pump_ul_s: actuators.pump_rate_ul_s,
            full_bleed_ul_s: actuators.bleed_rate_ul_s,
        }
    }
}

/// Why an actuator stands still although it was ordered to move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum Fault {
    /// The potentiometer reads nonsense.
    Potentiometer(Implausible),
    /// A pin or a PWM channel did not take its value.
    Output,
}

/// Driver of the pump's motor and the bleed valve.
#[derive(Debug)]
pub struct Pump<Motor, Valve> {
    motor: Motor,
    valve: Valve,
    calibration: PumpCalibration,
    order: Order,
    bleed_owed_ul_s: i32,
    vbd_ul: i32,
}

impl<Motor: SetDutyCycle, Valve: OutputPin> Pump<Motor, Valve> {
    /// Takes a motor's PWM and a valve that opens when its pin is high.
    pub const fn new(motor: Motor, valve: Valve, calibration: PumpCalibration) -> Self {
        Self { motor, valve, calibration, order: Order::STALE, bleed_owed_ul_s: 0, vbd_ul: 0 }
    }

    /// Orders a flow, µl/s: pump positive, bleed negative, 0 stops and shuts.
    pub const fn order(&mut self, rate_ul_s: i32) {
        self.order = Order::new(rate_ul_s);
    }

    /// Volume beyond neutral when a reading last made sense, µl.
    pub const fn vbd_ul(&self) -> i32 {
        self.vbd_ul
    }

    /// Runs for one beat at what the order, the end stops and the potentiometer allow.
    ///
    /// # Errors
    /// A [`Fault`], after everything was stopped.
    pub fn beat(&mut self, reading: Counts) -> Result<(), Fault> {
        let rate_ul_s = self.order.take_beat();
        let driven = match self.calibration.vbd_ul.position(reading) {
            Ok(vbd_ul) => {
                self.vbd_ul = vbd_ul;
                self.drive(within_travel(rate_ul_s, vbd_ul, self.calibration.travel_ul))
            }
            Err(implausible) => Err(Fault::Potentiometer(implausible)),
        };
        if driven.is_err() {
            self.make_safe()?;
        }
        driven
    }

    /// Stops the motor, shuts the valve and forgets the order. Both are tried, whatever happens to the first.
    ///
    /// # Errors
    /// [`Fault::Output`] if one of them did not take it.
    pub fn make_safe(&mut self) -> Result<(), Fault> {
        self.order = Order::STALE;
        self.bleed_owed_ul_s = 0;
        let motor = self.motor.set_duty_cycle_fully_off().is_ok();
        let valve = self.valve.set_low().is_ok();
        if motor && valve { Ok(()) } else { Err(Fault::Output) }
    }

    fn drive(&mut self, rate_ul_s: i32) -> Result<(), Fault> {
        if rate_ul_s > 0 {
            self.bleed_owed_ul_s = 0;
            self.valve.set_low().map_err(|_| Fault::Output)?;
            let duty = duty(rate_ul_s, self.calibration.full_pump_ul_s, self.motor.max_duty_cycle());
            return self.motor.set_duty_cycle(duty).map_err(|_| Fault::Output);
        }
        self.motor.set_duty_cycle_fully_off().map_err(|_| Fault::Output)?;
        let open = self.bleeds_now(rate_ul_s);
        self.valve.set_state(open.into()).map_err(|_| Fault::Output)
    }

    /// The valve is open or shut for whole beats: of a slower flow each beat owes a part, and full parts are paid.
    fn bleeds_now(&mut self, rate_ul_s: i32) -> bool {
        let full_ul_s = self.calibration.full_bleed_ul_s;
        let whole_beat_ul = full_ul_s.checked_div(BEAT_HZ.cast_signed()).unwrap_or(0);
        let room_ul = self.vbd_ul.saturating_sub(self.calibration.travel_ul.min);
        if rate_ul_s == 0 || room_ul < whole_beat_ul {
            self.bleed_owed_ul_s = 0;
            return false;
        }
        self.bleed_owed_ul_s = self.bleed_owed_ul_s.saturating_add(rate_ul_s.saturating_neg()).min(full_ul_s);
        let open = self.bleed_owed_ul_s >= full_ul_s;
        if open {
            self.bleed_owed_ul_s = self.bleed_owed_ul_s.saturating_sub(full_ul_s);
        }
        open
    }
}
