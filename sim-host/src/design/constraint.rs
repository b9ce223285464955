//! What a geometry must keep.

use serde::Serialize;

use super::{Candidate, Spec};
use crate::coefficients::Parameter;

/// A bound of one figure.
#[derive(Clone, Debug)]
pub struct Constraint {
    /// Its key in the file.
    name: &'static str,
    asked: f64,
    /// Whether the figure must not be less; else it must not be more.
    at_least: bool,
    /// Of a shortfall that matters as much as the whole.
    scale: f64,
    of: fn(&Candidate) -> f64,
}

/// A constraint that holds the best geometry back.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Active {
    /// Its key in the file.
    pub constraint: &'static str,
    /// What was asked for.
    pub asked: f64,
    /// What it is.
    pub value: f64,
}

/// Everything that a specification asks for.
pub(super) fn constraints(spec: &Spec) -> Vec<Constraint> {
    let limits = &spec.limits;
    let relative = |name, asked: Option<f64>, of| {
        asked.map(|asked| Constraint { name, asked, at_least: true, scale: asked.abs(), of })
    };
    let real_part = limits.largest_real_part_per_s.map(|asked| Constraint {
        name: "largest_real_part_per_s",
        asked,
        at_least: false,
        scale: asked.abs().max(0.01),
        of: |candidate| candidate.largest_real_part_per_s,
    });
    let damping = limits.least_damping_ratio.map(|asked| Constraint {
        name: "least_damping_ratio",
        asked,
        at_least: true,
        scale: asked.abs().max(0.05),
        of: |candidate| candidate.least_damping_ratio,
    });
    let incidence = limits.largest_angle_of_attack_deg.map(|asked| Constraint {
        name: "largest_angle_of_attack_deg",
        asked,
        at_least: false,
        scale: asked,
        of: |candidate| candidate.alpha_rad.to_degrees(),
    });
    let figures = [
        relative("least_speed_m_s", limits.least_speed_m_s, |candidate| candidate.size.speed_m_s),
        relative("least_range_m", limits.least_range_m, |candidate| candidate.range_m),
        real_part,
        damping,
        incidence,
        limits.least_turn_rate_deg_s.map(Constraint::turn_rate),
    ];
    figures.into_iter().flatten().chain(fineness(spec)).collect()
}

/// The bounds of the fineness, where it follows from the length.
fn fineness(spec: &Spec) -> Vec<Constraint> {
    let bounds = |wanted| spec.bounds.iter().find(|(parameter, _)| *parameter == wanted).map(|(_, bounds)| *bounds);
    let (Some(_), Some([least, most])) = (bounds(Parameter::HullLength), bounds(Parameter::HullFineness)) else {
        return Vec::new();
    };
    let bound = |name, asked: f64, at_least| Constraint {
        name,
        asked,
        at_least,
        scale: asked,
        of: |candidate| candidate.parameter(Parameter::HullFineness),
    };
    vec![bound("least hull.fineness", least, true), bound("most hull.fineness", most, false)]
}

impl Constraint {
    /// A least turn rate, deg/s.
    pub(super) fn turn_rate(asked: f64) -> Self {
        let of = |candidate: &Candidate| candidate.turn_rate_rad_s.to_degrees();
        Self { name: "least_turn_rate_deg_s", asked, at_least: true, scale: asked.abs().max(1e-3), of }
    }

    /// Whether it bounds the same figure.
    pub(super) fn is_like(&self, other: &Self) -> bool {
        self.name == other.name
    }

    /// By how much it is met, over its scale.
    pub(super) fn slack(&self, candidate: &Candidate) -> f64 {
        let more = self.value_of(candidate) - self.asked;
        if self.at_least { more / self.scale } else { -more / self.scale }
    }

    pub(super) fn value_of(&self, candidate: &Candidate) -> f64 {
        (self.of)(candidate)
    }

    pub(super) fn active(&self, candidate: &Candidate, reached: f64) -> Option<Active> {
        let holds_back = self.slack(candidate) < reached;
        holds_back.then(|| Active { constraint: self.name, asked: self.asked, value: self.value_of(candidate) })
    }
}

impl std::fmt::Display for Constraint {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} = {}", self.name, self.asked)
    }
}
