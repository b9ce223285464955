//! The moving mass: one geared motor along the axis, one around it, each with a brake.
//!
//! The brakes hold without power, so that a reset or a dead processor leaves the mass where it is.

use embedded_hal::{
    digital::{OutputPin, PinState},
    pwm::SetDutyCycle,
};
use shared::model::vehicle::{Actuators, Range};

use crate::{
    calibration::{Counts, Line},
    order::{Order, duty, within_travel},
    pump::Fault,
};

/// What this very axis does, in µm or 0.01°.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AxisCalibration {
    /// Potentiometer of the axis.
    pub position: Line,
    /// Positions between the end stops.
    pub travel: Range,
    /// Speed at full duty, per second.
    pub full_rate: i32,
}

impl AxisCalibration {
    /// The vehicle's nominal axial drive, µm.
    #[must_use]
    pub const fn nominal_axial(actuators: &Actuators) -> Self {
        Self { position: Line::over(actuators.r_px_um), travel: actuators.r_px_um, full_rate: actuators.r_px_rate_um_s }
    }

    /// The vehicle's nominal rotation drive, 0.01°.
    #[must_use]
    pub const fn nominal_rotation(actuators: &Actuators) -> Self {
        Self { position: Line::over(actuators.mu_cdeg), travel: actuators.mu_cdeg, full_rate: actuators.mu_rate_cdeg_s }
    }
}

/// Driver of one motor of the moving mass.
#[derive(Debug)]
pub struct Axis<Motor, Pin> {
    motor: Motor,
    direction: Pin,
    brake: Pin,
    calibration: AxisCalibration,
    order: Order,
    position: i32,
}

impl<Motor: SetDutyCycle, Pin: OutputPin> Axis<Motor, Pin> {
    /// Takes a motor's PWM, a direction (high is forward, or to the left) and a brake that is released by high.
    pub const fn new(motor: Motor, direction: Pin, brake: Pin, calibration: AxisCalibration) -> Self {
        Self { motor, direction, brake, calibration, order: Order::STALE, position: 0 }
    }

    /// Orders a speed, in device units per second; 0 stops and brakes.
    pub const fn order(&mut self, rate: i32) {
        self.order = Order::new(rate);
    }

    /// Position when a reading last made sense, in device units.
    pub const fn position(&self) -> i32 {
        self.position
    }

    /// Runs for one beat at what the order, the end stops and the potentiometer allow.
    ///
    /// # Errors
    /// A [`Fault`], after the motor was stopped and braked.
    pub fn beat(&mut self, reading: Counts) -> Result<(), Fault> {
        let rate = self.order.take_beat();
        let driven = match self.calibration.position.position(reading) {
            Ok(position) => {
                self.position = position;
                self.drive(within_travel(rate, position, self.calibration.travel))
            }
            Err(implausible) => Err(Fault::Potentiometer(implausible)),
        };
        if driven.is_err() {
            self.make_safe()?;
        }
        driven
    }

    /// Stops, brakes and forgets the order. Both are tried, whatever happens to the first.
    ///
    /// # Errors
    /// [`Fault::Output`] if one of them did not take it.
    pub fn make_safe(&mut self) -> Result<(), Fault> {
        self.order = Order::STALE;
        let motor = self.motor.set_duty_cycle_fully_off().is_ok();
        let brake = self.brake.set_low().is_ok();
        if motor && brake { Ok(()) } else { Err(Fault::Output) }
    }

    fn drive(&mut self, rate: i32) -> Result<(), Fault> {
        if rate == 0 {
            self.motor.set_duty_cycle_fully_off().map_err(|_| Fault::Output)?;
            return self.brake.set_low().map_err(|_| Fault::Output);
        }
        self.direction.set_state(PinState::from(rate > 0)).map_err(|_| Fault::Output)?;
        self.brake.set_high().map_err(|_| Fault::Output)?;
        let duty = duty(rate, self.calibration.full_rate, self.motor.max_duty_cycle());
        self.motor.set_duty_cycle(duty).map_err(|_| Fault::Output)
    }
}
