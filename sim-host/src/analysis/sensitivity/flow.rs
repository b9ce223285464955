//! Where the flow along a surface turns from laminar to turbulent.

use serde::Serialize;

use crate::analysis::helix::{Along, rate, with_rate};
use crate::model::coefficients::{
    BoundaryLayer, CRITICAL_REYNOLDS_HULL, CRITICAL_REYNOLDS_WING, Parameter, Shape, Stream,
};
use crate::model::real::Real;

/// Change of a parameter within which a switch is told, of its value.
const WITHIN: f64 = 0.2;
/// Relative distance from the critical Reynolds number below which rounding decides.
const AT_THE_STEP: f64 = 1e-9;

/// Flow along one surface.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Flow {
    /// Which one.
    pub surface: &'static str,
    /// Its Reynolds number.
    pub reynolds: f64,
    /// Where it turns turbulent.
    pub critical_reynolds: f64,
    /// What it is.
    pub flow: BoundaryLayer,
}

/// A value of a parameter at which a flow changes and figures jump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Switch {
    /// Key of the parameter.
    pub parameter: &'static str,
    /// Surface whose flow changes.
    pub surface: &'static str,
    /// Value of the parameter there.
    pub at: f64,
}

impl Flow {
    /// What is wrong with derivatives right at the step.
    pub(super) fn warning(&self) -> Option<String> {
        let at_the_step = (self.reynolds / self.critical_reynolds - 1.0).abs() < AT_THE_STEP;
        at_the_step.then(|| {
            format!("the flow along the {} is just turning turbulent: derivatives hold on one side only", self.surface)
        })
    }
}

/// Surfaces with their Reynolds and critical Reynolds numbers.
fn surfaces<T: Real>(shape: &Shape<T>, stream: &Stream<T>) -> Vec<(&'static str, T, f64)> {
    let hull = ("hull", shape.hull_reynolds(stream), CRITICAL_REYNOLDS_HULL);
    let wing = ("wing", shape.wing_reynolds(stream), CRITICAL_REYNOLDS_WING);
    let fin = shape.fin_reynolds(stream).map(|reynolds| ("fin", reynolds, CRITICAL_REYNOLDS_WING));
    [hull, wing].into_iter().chain(fin).collect()
}

pub(super) fn flows(shape: &Shape, stream: &Stream) -> Vec<Flow> {
    let flow = |(surface, reynolds, critical_reynolds): (&'static str, f64, f64)| Flow {
        surface,
        reynolds,
        critical_reynolds,
        flow: BoundaryLayer::at(reynolds, critical_reynolds),
    };
    surfaces(shape, stream).into_iter().map(flow).collect()
}

/// Switches within reach. A Reynolds number is a power of each parameter, so where it becomes critical is exact.
pub(super) fn switches(nominal: &Shape, stream: &Stream) -> Vec<Switch> {
    let constant = Along::constant;
    let stream = Stream {
        speed_m_s: constant(stream.speed_m_s),
        kinematic_viscosity_m2_s: constant(stream.kinematic_viscosity_m2_s),
        lift_coefficient: constant(stream.lift_coefficient),
    };
    let mut switches = Vec::new();
    for parameter in Parameter::ALL {
        let value = *parameter.of(&mut nominal.clone());
        let mut shape: Shape<Along> = nominal.lift();
        *parameter.of(&mut shape) = with_rate(value, 1.0);
        for (surface, reynolds, critical) in surfaces(&shape, &stream) {
            let exponent = rate(reynolds) * value / reynolds.re;
            let at = value * libm::pow(critical / reynolds.re, 1.0 / exponent);
            if exponent != 0.0 && (at / value - 1.0).abs() < WITHIN {
                switches.push(Switch { parameter: parameter.key(), surface, at });
            }
        }
    }
    switches
}
