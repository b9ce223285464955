//! What a geometry must keep.

use serde::Serialize;

use super::{Candidate, Spec};
use crate::model::coefficients::Parameter;

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
    let figures = [
        limits.least_speed_m_s.map(|asked| Constraint::at_least("least_speed_m_s", asked, 0.0, |c| c.size.speed_m_s)),
        limits.least_range_m.map(|asked| Constraint::at_least("least_range_m", asked, 0.0, |c| c.range_m)),
        limits
            .largest_real_part_per_s
            .map(|asked| Constraint::at_most("largest_real_part_per_s", asked, 0.01, |c| c.largest_real_part_per_s)),
        limits
            .least_damping_ratio
            .map(|asked| Constraint::at_least("least_damping_ratio", asked, 0.05, |c| c.least_damping_ratio)),
        limits
            .largest_angle_of_attack_deg
            .map(|asked| Constraint::at_most("largest_angle_of_attack_deg", asked, 0.0, |c| c.alpha_rad.to_degrees())),
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
    let of = |candidate: &Candidate| candidate.parameter(Parameter::HullFineness);
    vec![
        Constraint::at_least("least hull.fineness", least, 0.0, of),
        Constraint::at_most("most hull.fineness", most, 0.0, of),
    ]
}

impl Constraint {
    /// A figure that must not be less; a shortfall counts over what is asked for, or over `least_scale` if that is more.
    fn at_least(name: &'static str, asked: f64, least_scale: f64, of: fn(&Candidate) -> f64) -> Self {
        Self { name, asked, at_least: true, scale: asked.abs().max(least_scale), of }
    }

    /// A figure that must not be more; likewise.
    fn at_most(name: &'static str, asked: f64, least_scale: f64, of: fn(&Candidate) -> f64) -> Self {
        Self { at_least: false, ..Self::at_least(name, asked, least_scale, of) }
    }

    /// A least turn rate, deg/s.
    pub(super) fn turn_rate(asked: f64) -> Self {
        Self::at_least("least_turn_rate_deg_s", asked, 1e-3, |candidate| candidate.turn_rate_rad_s.to_degrees())
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
