//! Simulated devices behind `embedded-hal`: what the drivers do to them moves a piston and a mass.

use std::{cell::Cell, convert::Infallible, rc::Rc};

use embedded_hal::{
    digital::{self, OutputPin},
    pwm::{self, SetDutyCycle},
};
use firmware::{
    BEAT_HZ,
    actuators::{Actuators, Readings},
    calibration::Counts,
    mass::{Axis, AxisCalibration},
    pump::{Pump, PumpCalibration},
};
use shared::model::vehicle;

/// Steps of a PWM channel.
pub const FULL_DUTY: u16 = 1_000;

/// A PWM channel, seen from both sides.
#[derive(Clone, Debug, Default)]
pub struct Pwm(pub Rc<Cell<u16>>);

/// An output pin, seen from both sides.
#[derive(Clone, Debug, Default)]
pub struct Pin {
    /// Its level.
    pub high: Rc<Cell<bool>>,
    /// Whether it no longer does what it is told.
    pub broken: Rc<Cell<bool>>,
}

/// A pin that does not do what it is told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Broken;

impl pwm::ErrorType for Pwm {
    type Error = Infallible;
}

impl SetDutyCycle for Pwm {
    fn max_duty_cycle(&self) -> u16 {
        FULL_DUTY
    }

    fn set_duty_cycle(&mut self, duty: u16) -> Result<(), Infallible> {
        assert!(duty <= FULL_DUTY, "a duty of {duty}");
        self.0.set(duty);
        Ok(())
    }
}

impl digital::Error for Broken {
    fn kind(&self) -> digital::ErrorKind {
        digital::ErrorKind::Other
    }
}

impl digital::ErrorType for Pin {
    type Error = Broken;
}

impl Pin {
    fn set(&mut self, high: bool) -> Result<(), Broken> {
        if self.broken.get() {
            return Err(Broken);
        }
        self.high.set(high);
        Ok(())
    }
}

impl OutputPin for Pin {
    fn set_low(&mut self) -> Result<(), Broken> {
        self.set(false)
    }

    fn set_high(&mut self) -> Result<(), Broken> {
        self.set(true)
    }
}

/// The buoyancy device: a motor that pumps, a valve that bleeds, a piston in between.
#[derive(Clone, Debug)]
pub struct Piston {
    /// The pump's motor.
    pub motor: Pwm,
    /// The bleed valve.
    pub valve: Pin,
    /// How it was calibrated.
    pub calibration: PumpCalibration,
    /// Volume beyond neutral, µl.
    pub volume_ul: f64,
}

impl Piston {
    /// At neutral.
    #[must_use]
    pub fn new(actuators: &vehicle::Actuators) -> Self {
        let calibration = PumpCalibration::nominal(actuators);
        Self { motor: Pwm::default(), valve: Pin::default(), calibration, volume_ul: 0.0 }
    }

    /// Its driver.
    #[must_use]
    pub fn driver(&self) -> Pump<Pwm, Pin> {
        Pump::new(self.motor.clone(), self.valve.clone(), self.calibration)
    }

    /// What its potentiometer reads.
    #[must_use]
    pub fn reading(&self) -> Counts {
        self.calibration.vbd_ul.reading(self.volume_ul as i32)
    }

    /// Moves for one beat. A valve that is open while the motor runs breaks the device.
    ///
    /// # Panics
    /// If it breaks, or runs into an end stop.
    pub fn advance(&mut self) {
        let (duty, open) = (self.motor.0.get(), self.valve.high.get());
        assert!(duty == 0 || !open, "it pumps and bleeds at once");
        let pumped = f64::from(self.calibration.full_pump_ul_s) * f64::from(duty) / f64::from(FULL_DUTY);
        let bled = if open { f64::from(self.calibration.full_bleed_ul_s) } else { 0.0 };
        self.volume_ul += (pumped - bled) / f64::from(BEAT_HZ);
        self.assert_in_travel();
    }

    /// A count of the converter is all that the driver may be off by.
    fn assert_in_travel(&self) {
        let travel = self.calibration.travel_ul;
        let count_ul = f64::from(travel.max - travel.min) / 3_276.0;
        let inside = f64::from(travel.min) - count_ul..=f64::from(travel.max) + count_ul;
        assert!(inside.contains(&self.volume_ul), "driven past its end stop: {} µl", self.volume_ul);
    }
}

/// One axis of the moving mass: a motor, its direction, a brake.
#[derive(Clone, Debug)]
pub struct Slide {
    /// The motor.
    pub motor: Pwm,
    /// High towards larger positions.
    pub direction: Pin,
    /// High releases.
    pub brake: Pin,
    /// How it was calibrated.
    pub calibration: AxisCalibration,
    /// Position, in the axis's device unit.
    pub position: f64,
}

impl Slide {
    /// In the middle.
    #[must_use]
    pub fn new(calibration: AxisCalibration) -> Self {
        let (motor, direction, brake) = (Pwm::default(), Pin::default(), Pin::default());
        Self { motor, direction, brake, calibration, position: 0.0 }
    }

    /// Its driver.
    #[must_use]
    pub fn driver(&self) -> Axis<Pwm, Pin> {
        Axis::new(self.motor.clone(), self.direction.clone(), self.brake.clone(), self.calibration)
    }

    /// What its potentiometer reads.
    #[must_use]
    pub fn reading(&self) -> Counts {
        self.calibration.position.reading(self.position as i32)
    }

    /// Moves for one beat. A motor that runs against its brake burns.
    ///
    /// # Panics
    /// If it burns, or runs into an end stop.
    pub fn advance(&mut self) {
        let duty = self.motor.0.get();
        assert!(duty == 0 || self.brake.high.get(), "it runs against its brake");
        let speed = f64::from(self.calibration.full_rate) * f64::from(duty) / f64::from(FULL_DUTY);
        let sign = if self.direction.high.get() { 1.0 } else { -1.0 };
        self.position += sign * speed / f64::from(BEAT_HZ);
        let travel = self.calibration.travel;
        let count = f64::from(travel.max - travel.min) / 3_276.0;
        let inside = f64::from(travel.min) - count..=f64::from(travel.max) + count;
        assert!(inside.contains(&self.position), "driven past its end stop: {}", self.position);
    }
}

/// All three, as a vehicle has them.
#[derive(Clone, Debug)]
pub struct Devices {
    /// The buoyancy device.
    pub piston: Piston,
    /// The mass along the axis, µm.
    pub axial: Slide,
    /// The mass around the axis, 0.01°.
    pub rotation: Slide,
}

impl Devices {
    /// As a vehicle has them, in the middle.
    #[must_use]
    pub fn new(actuators: &vehicle::Actuators) -> Self {
        Self {
            piston: Piston::new(actuators),
            axial: Slide::new(AxisCalibration::nominal_axial(actuators)),
            rotation: Slide::new(AxisCalibration::nominal_rotation(actuators)),
        }
    }

    /// Their drivers.
    #[must_use]
    pub fn drivers(&self) -> Actuators<Pwm, Pin> {
        Actuators::new(self.piston.driver(), self.axial.driver(), self.rotation.driver())
    }

    /// What the potentiometers read.
    #[must_use]
    pub fn readings(&self) -> Readings {
        Readings { vbd: self.piston.reading(), r_px: self.axial.reading(), mu: self.rotation.reading() }
    }

    /// Moves all three for one beat.
    pub fn advance(&mut self) {
        self.piston.advance();
        self.axial.advance();
        self.rotation.advance();
    }

    /// Whether every motor is off, the valve shut and the brakes on.
    #[must_use]
    pub fn are_safe(&self) -> bool {
        let off = [&self.piston.motor, &self.axial.motor, &self.rotation.motor].iter().all(|pwm| pwm.0.get() == 0);
        let shut = [&self.piston.valve, &self.axial.brake, &self.rotation.brake].iter().all(|pin| !pin.high.get());
        off && shut
    }
}
