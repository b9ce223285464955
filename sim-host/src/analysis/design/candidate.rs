//! One geometry: what it displaces, how it glides, how it turns.

use serde::Serialize;

use super::{Drive, Objective, Spec};
use crate::analysis::{
    modes::{RollKinematics, modes},
    performance::{Hold, Size, Sizing},
    trim::{Condition, Scale, glide},
    turn::Turns,
};
use crate::model::{
    coefficients::{Anchoring, Coefficients, MassRule, Parameter, Shape, Study},
    vehicle::{MomentFrame, Vehicle},
};

/// Share of an identified coefficient that a change of shape must leave.
const LEAST_LEFT: f64 = 0.5;

/// What a geometry is judged by.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Candidate {
    /// Everything at its flattest glide.
    pub size: Size,
    /// Ideal range of the battery, m: any share of a dive counts.
    pub range_m: f64,
    /// Largest of all modes, 1/s.
    pub largest_real_part_per_s: f64,
    /// Least of the modes that oscillate; 1 if none does.
    pub least_damping_ratio: f64,
    /// α, rad.
    pub alpha_rad: f64,
    /// Fastest right turn within the travel of the moving mass, rad/s.
    pub turn_rate_rad_s: f64,
    /// The vehicle.
    #[serde(skip)]
    pub vehicle: Vehicle,
}

/// Makes candidates of a specification.
#[derive(Clone, Debug)]
pub(super) struct Maker<'a> {
    pub(super) spec: &'a Spec,
    pub(super) vehicle: &'a Vehicle,
    /// What is varied: all bounds, but the fineness where the length is there.
    pub(super) free: Vec<(Parameter, [f64; 2])>,
}

impl Candidate {
    /// A figure of it.
    #[must_use]
    pub fn value(&self, objective: Objective) -> f64 {
        match objective {
            Objective::Range => self.range_m,
            Objective::LiftToDrag => self.size.glide.lift_to_drag,
            Objective::Speed => self.size.speed_m_s,
            Objective::TurnRate => self.turn_rate_rad_s,
        }
    }

    /// Its value of a parameter.
    #[must_use]
    pub fn parameter(&self, parameter: Parameter) -> f64 {
        *parameter.of(&mut Shape::of(&self.vehicle))
    }
}

impl<'a> Maker<'a> {
    pub(super) fn new(spec: &'a Spec, vehicle: &'a Vehicle) -> Self {
        let by_length = spec.bounds.iter().any(|(parameter, _)| *parameter == Parameter::HullLength);
        let follows = |parameter: Parameter| by_length && parameter == Parameter::HullFineness;
        let free = spec.bounds.iter().copied().filter(|(parameter, _)| !follows(*parameter)).collect();
        Self { spec, vehicle, free }
    }

    /// Where the vehicle itself lies within the bounds, 0 to 1 each.
    pub(super) fn nominal(&self) -> Vec<f64> {
        let mut shape = Shape::of(self.vehicle);
        let share = |(parameter, [least, most]): &(Parameter, [f64; 2])| {
            ((*parameter.of(&mut shape) - least) / (most - least)).clamp(0.0, 1.0)
        };
        self.free.iter().map(share).collect()
    }

    /// The geometry at a place within the bounds, 0 to 1 each.
    ///
    /// # Errors
    /// One line, where there is no such vehicle or no glide of it.
    pub(super) fn at(&self, place: &[f64]) -> Result<Candidate, String> {
        let mut shape = Shape::of(self.vehicle);
        for ((parameter, [least, most]), share) in self.free.iter().zip(place) {
            *parameter.of(&mut shape) = least * (1.0 - share) + most * share;
        }
        let by_fineness = self.free.iter().any(|(parameter, _)| *parameter == Parameter::HullFineness);
        let kept = if by_fineness { Parameter::HullFineness } else { Parameter::HullLength };
        let (value, density) = (*kept.of(&mut shape.clone()), self.vehicle.water.density_kg_m3);
        let shape = Hold::Displacement(self.spec.displaced_mass_kg).with(&shape, kept, value, density);
        Parameter::HullFineness.check(shape.hull.fineness)?;
        self.candidate(&shape)
    }

    fn candidate(&self, shape: &Shape) -> Result<Candidate, String> {
        let (spec, study) = (self.spec, self.study());
        let sizing = Sizing { study: study.clone() };
        let size = match spec.drive {
            Drive::LungCapacity(capacity) => sizing.at_lung_capacity(shape, capacity)?,
            Drive::NetMass(net_mass_kg) => {
                sizing.at_lung_capacity(shape, net_mass_kg / (spec.displaced_mass_kg - net_mass_kg))?
            }
            Drive::Speed(speed_m_s) => sizing.at_speed(shape, speed_m_s)?,
        };
        let vehicle = self.designed(&study, shape, size.speed_m_s)?;
        let glide = glide(&vehicle, Condition::MinGlideAngle, Scale::Speed(size.speed_m_s))?;
        let modes = modes(&vehicle, &glide, RollKinematics::Exact)?;
        let eigenvalues = || modes.longitudinal.eigenvalues.iter().chain(&modes.lateral.eigenvalues);
        let ratio = |[re, im]: &[f64; 2]| -re / re.hypot(*im);
        // Δx/ΔE of the paper's ideal dive is (L/D)/(m̃ g).
        let weight_n = size.net_mass_kg * vehicle.water.gravity_m_s2;
        Ok(Candidate {
            size,
            range_m: spec.battery_j * size.glide.lift_to_drag / weight_n,
            largest_real_part_per_s: eigenvalues().map(|[re, _]| *re).fold(f64::NEG_INFINITY, f64::max),
            least_damping_ratio: eigenvalues().filter(|[_, im]| *im != 0.0).map(ratio).fold(1.0, f64::min),
            alpha_rad: glide.alpha_rad,
            turn_rate_rad_s: Turns::new(&vehicle, &glide)?.fastest_right().turn_rate_rad_s,
            vehicle,
        })
    }

    fn study(&self) -> Study<'a> {
        Study { vehicle: self.vehicle, anchoring: self.spec.anchoring, mass_rule: MassRule::Neutral }
    }

    /// The vehicle of a shape. Its body weighs what makes it neutral; the moving mass keeps its place in proportion.
    ///
    /// From geometry alone, its nominal speed is that of the glide, so that its file gives the same coefficients.
    fn designed(&self, study: &Study<'_>, shape: &Shape, speed_m_s: f64) -> Result<Vehicle, String> {
        let mut vehicle = study.vehicle(shape, speed_m_s, 0.0)?;
        let (hull, nominal) = (&shape.hull, &self.vehicle.hull);
        vehicle.name.clone_from(&self.spec.name);
        vehicle.moving_mass.radius_m *= hull.diameter_m() / nominal.diameter_m();
        vehicle.moving_mass.travel_m =
            vehicle.moving_mass.travel_m.map(|place| place * hull.length_m / nominal.length_m);
        if self.spec.anchoring == Anchoring::Unanchored {
            vehicle.nominal_speed_m_s = speed_m_s;
            vehicle.hydrodynamics.moment_frame = MomentFrame::Body;
        } else {
            self.near_enough(study, &vehicle)?;
        }
        Ok(vehicle)
    }

    /// Whether anchored coefficients still say something: a search would else find where they cancel.
    fn near_enough(&self, study: &Study<'_>, vehicle: &Vehicle) -> Result<(), String> {
        let own = study.coefficients(&Shape::of(self.vehicle), self.vehicle.nominal_speed_m_s, 0.0);
        let now = Coefficients::from(&vehicle.hydrodynamics);
        let signed = |c: &Coefficients| {
            [
                ("C_D0", c.drag[0]),
                ("K", c.drag[1]),
                ("C_Lα", c.lift[1]),
                ("C_Yβ", c.side[0]),
                ("C_lp", c.roll[1]),
                ("C_mq", c.pitch[2]),
                ("C_nr", c.yaw[2]),
            ]
        };
        let lost = signed(&own).into_iter().zip(signed(&now)).find(|((_, own), (_, now))| now / own < LEAST_LEFT);
        lost.map_or(Ok(()), |((name, own), (_, now))| {
            Err(format!("{name} comes out as {now:.4} of {own:.4}: too far from the identified shape"))
        })
    }
}
