//! How large a lung, for a speed: equations (11) to (13) and (17) at the flattest glide.
//!
//! C_D0 depends on the Reynolds number and so on speed: (17) is explicit in speed and implicit in the lung capacity. Where a
//! boundary layer turns turbulent the drag jumps, and with it the capacity.
//!
//! # What the paper says of the trends, and where it holds
//! Within one state of flow, coefficients from geometry alone, around the printed geometry (`tests/trends.rs`):
//!
//! | statement | every other parameter held | 52 kg held |
//! |---|---|---|
//! | 4.2.1: a longer hull, a higher AR and a smaller 𝒷 need less lung | yes | yes |
//! | 4.2.1: a higher fineness needs less lung | no, more: at one length the hull thins, and its lung with it | yes |
//! | 4.2.1: L/D grows with 𝒷 | yes | yes |
//! | 4.2.1: L/D grows with length | yes | no, it falls, as section 6 says |
//! | 4.2.1: L/D hardly depends on AR | yes | yes |
//! | 4.2.1: L/D hardly depends on fineness | no: more than on length | less than on length, but by a sixth |
//! | 6: at one lung and mass, longer, finer, smaller span, higher AR are faster | | yes |
//!
//! Anchored on slocum-paper, L/D *falls* with AR: the identified K is five times the estimate, so a higher AR takes little of
//! it away, while the hull's drag weighs more on the smaller wing.
//!
//! # The paper's 52 kg
//! Figs. 7, 8 and 10 are "of a 52 kg glider". The printed geometry displaces (π/4)d²lρ = 54.1 kg, which is V_max in (11); its
//! neutral mass V_max ρ/(1 + η) is 52 kg at η = 4 %. Which is meant is not said. [`Hold`] offers both readings: the
//! geometry as printed, or a hull that displaces a given mass at most.

use std::f64::consts::PI;

use serde::Serialize;

use super::{Polar, PolarPoint};
use crate::model::coefficients::{
    BoundaryLayer, CRITICAL_REYNOLDS_HULL, CRITICAL_REYNOLDS_WING, Parameter, Shape, Study,
};

/// Slowest and fastest speed that is looked for, m/s.
const SPEEDS_M_S: [f64; 2] = [1e-3, 1e2];
/// Halvings of that range: down to the rounding of a speed.
const BISECTIONS: usize = 100;

/// What stays while one parameter of the geometry changes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Hold {
    /// Every other parameter.
    #[default]
    Geometry,
    /// The mass of water, kg, that the hull's cylinder displaces: the fineness gives way, or the length where the fineness is
    /// what changes.
    Displacement(f64),
}

impl Hold {
    /// The shape with one parameter changed.
    #[must_use]
    pub fn with(self, shape: &Shape, parameter: Parameter, value: f64, density_kg_m3: f64) -> Shape {
        let mut changed = shape.clone();
        *parameter.of(&mut changed) = value;
        if let Self::Displacement(mass_kg) = self {
            let volume_m3 = mass_kg / density_kg_m3;
            let hull = &mut changed.hull;
            // (π/4) l³/f² is the volume.
            if parameter == Parameter::HullFineness {
                hull.length_m = libm::cbrt(4.0 / PI * volume_m3 * hull.fineness * hull.fineness);
            } else {
                hull.fineness = (PI / 4.0 * hull.length_m * hull.length_m * hull.length_m / volume_m3).sqrt();
            }
        }
        changed
    }
}

/// A glider of some shape at its flattest glide.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Size {
    /// V_md, m/s.
    pub speed_m_s: f64,
    /// η, as a fraction of the neutral displacement; none where no lung is large enough.
    pub lung_capacity: Option<f64>,
    /// ΔW/g, kg: the most that it weighs in water.
    pub net_mass_kg: f64,
    /// 2ΔW/(ρg), m³: from heaviest to lightest.
    pub stroke_m3: f64,
    /// ρ V_max = ρ (π/4) d² l, kg.
    pub displaced_mass_kg: f64,
    /// ρ V_NB = ρ V_max/(1 + η), kg: what it weighs in air.
    pub neutral_mass_kg: Option<f64>,
    /// C_D0 at this speed.
    pub c_d_zero: f64,
    /// K.
    pub c_d_induced: f64,
    /// The flattest glide.
    pub glide: PolarPoint,
    /// Re_l.
    pub hull_reynolds: f64,
    /// Re_c.
    pub wing_reynolds: f64,
    /// Flow along the hull.
    pub hull_flow: BoundaryLayer,
    /// Flow along the wing.
    pub wing_flow: BoundaryLayer,
    /// Flow along the fin; that of the wing where there is none.
    pub fin_flow: BoundaryLayer,
}

impl Size {
    /// Whether every surface of both has the same flow: no step of Figs. 7 and 8 lies between them.
    #[must_use]
    pub fn flows_like(&self, other: &Self) -> bool {
        let flows = |size: &Self| [size.hull_flow, size.wing_flow, size.fin_flow];
        flows(self) == flows(other)
    }
}

/// Sizes of changed shapes of one vehicle.
#[derive(Clone, Debug)]
pub struct Sizing<'a> {
    /// Where coefficients come from.
    pub study: Study<'a>,
}

impl Sizing<'_> {
    /// The polar of a shape at a speed.
    ///
    /// # Errors
    /// One line, where the shape is so far from an identified vehicle that its drag is not positive.
    pub fn polar(&self, shape: &Shape, speed_m_s: f64) -> Result<Polar, String> {
        let [c_d_zero, c_d_induced] = self.study.coefficients(shape, speed_m_s, 0.0).drag;
        if c_d_zero > 0.0 && c_d_induced > 0.0 {
            return Ok(Polar { c_d_zero, c_d_induced });
        }
        Err(format!(
            "this shape of {} at {speed_m_s} m/s has C_D0 = {c_d_zero:.4} and K = {c_d_induced:.4}: too far from the identified ones",
            self.study.vehicle.name
        ))
    }

    /// What a speed takes: equation (17).
    ///
    /// # Errors
    /// As [`Sizing::polar`].
    pub fn at_speed(&self, shape: &Shape, speed_m_s: f64) -> Result<Size, String> {
        let polar = self.polar(shape, speed_m_s)?;
        let glide = polar.best_glide();
        // Γ, with V²/(l g) in place of Re_l² ν²/(l³ g).
        let gamma = self.speed_squared_at_no_limit(shape) / (speed_m_s * speed_m_s * glide.resultant());
        let lung_capacity = (gamma > 1.0).then(|| 1.0 / (gamma - 1.0));
        let water = &self.study.vehicle.water;
        let displaced_mass_kg = water.density_kg_m3 * shape.hull.volume_m3();
        let stream = self.study.stream(speed_m_s, 0.0);
        let (hull_reynolds, wing_reynolds) = (shape.hull_reynolds(&stream), shape.wing_reynolds(&stream));
        let fin_reynolds = shape.fin_reynolds(&stream);
        // η/(1 + η) = 1/Γ.
        let net_mass_kg = displaced_mass_kg / gamma;
        Ok(Size {
            speed_m_s,
            lung_capacity,
            net_mass_kg,
            stroke_m3: 2.0 * net_mass_kg / water.density_kg_m3,
            displaced_mass_kg,
            neutral_mass_kg: lung_capacity.map(|eta| displaced_mass_kg / (1.0 + eta)),
            c_d_zero: polar.c_d_zero,
            c_d_induced: polar.c_d_induced,
            glide,
            hull_reynolds,
            wing_reynolds,
            hull_flow: BoundaryLayer::at(hull_reynolds, CRITICAL_REYNOLDS_HULL),
            wing_flow: BoundaryLayer::at(wing_reynolds, CRITICAL_REYNOLDS_WING),
            fin_flow: BoundaryLayer::at(fin_reynolds.unwrap_or(wing_reynolds), CRITICAL_REYNOLDS_WING),
        })
    }

    /// How fast a lung makes it: equation (13), solved for the speed that its C_D0 depends on.
    ///
    /// Drag grows with speed everywhere, so there is one answer. A lung that would do for more than the critical speed in
    /// laminar flow, and for less in turbulent flow, gives the critical speed itself, with the laminar drag.
    ///
    /// # Errors
    /// One line, if the lung capacity is not positive, or as [`Sizing::polar`].
    pub fn at_lung_capacity(&self, shape: &Shape, lung_capacity: f64) -> Result<Size, String> {
        if !(lung_capacity > 0.0 && lung_capacity.is_finite()) {
            return Err(format!("lung capacity {lung_capacity}: must be a positive fraction"));
        }
        let drive = self.speed_squared_at_no_limit(shape) * lung_capacity / (1.0 + lung_capacity);
        let [mut slow, mut fast] = SPEEDS_M_S;
        for _ in 0..BISECTIONS {
            let middle = (slow * fast).sqrt();
            if middle * middle * self.polar(shape, middle)?.best_glide().resultant() < drive {
                slow = middle;
            } else {
                fast = middle;
            }
        }
        self.at_speed(shape, slow)
    }

    /// (π/2) g l AR/𝒷², m²/s²: V² √(C_L² + C_D²) of a lung without limit, in (12).
    fn speed_squared_at_no_limit(&self, shape: &Shape) -> f64 {
        let Shape { hull, wing, .. } = shape;
        PI / 2.0 * self.study.vehicle.water.gravity_m_s2 * hull.length_m * wing.aspect_ratio
            / (wing.span_ratio * wing.span_ratio)
    }
}
