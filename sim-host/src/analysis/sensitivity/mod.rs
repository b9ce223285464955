//! What every geometric parameter does to what a glider is judged by: exact derivatives, by dual numbers.
//!
//! The derivative of a figure is total: trim moves with the parameter. **Held** are the vehicle's mass with all that is in it, the
//! speed at which coefficients are taken (the nominal one), the condition (path angle; or whatever the flattest or the fastest
//! glide then is), and the speed or the net mass that was asked for. The speed's own figure always holds the net mass.
//!
//! How: the coefficients, the added mass and hence the plant carry the derivative by the parameter; the trim and its linearisation
//! carry, outside of it, that by the plant's eight unknowns ([`crate::analysis::helix`]). So dA is exact, and with the right and left
//! eigenvectors v and w of A, dλ = wᵀ dA v/(wᵀ v) (Lancaster, *Numerische Mathematik* 6, 1964). Where the fastest turn lies at
//! a reversal, its μ moves without effect to first order (the envelope theorem), so it is held.
//!
//! Within one state of flow all of this is smooth. Where a boundary layer turns turbulent the drag jumps: [`Switch`] tells how
//! near that is.

mod eigenvalue;
mod figure;
mod flow;

use serde::Serialize;

pub use flow::{Flow, Switch};

use crate::analysis::{
    helix::{Along, Helix, HelixAlong, Nested, Scale as HelixScale, Slope, Turn, rate, with_rate},
    modes::{Modes, RollKinematics, jacobian, modes},
    performance::Polar,
    trim::{Condition, Glide, Scale, glide},
    turn::Turns,
};
use crate::model::{
    coefficients::{Anchoring, Parameter, Shape, Study},
    plant::Plant,
    real::Real,
    vehicle::Vehicle,
};

/// Every derivative of one vehicle at one glide.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Sensitivities {
    /// The glide.
    pub glide: Glide,
    /// What it is judged by.
    pub figures: Vec<Merit>,
    /// The flow along each surface at the nominal speed.
    pub flows: Vec<Flow>,
    /// Parameters that a flow's state changes within reach of, and where: no derivative sees beyond.
    pub switches: Vec<Switch>,
    /// Those of the glide and of the modes.
    pub warnings: Vec<String>,
}

/// One figure of merit.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Merit {
    /// Quantity with its unit.
    pub name: String,
    /// What it is, in words.
    pub meaning: String,
    /// Its value; none where it does not exist.
    pub value: Option<f64>,
    /// By each parameter, in the file's order.
    pub effects: Vec<Effect>,
}

/// What one parameter does to one figure.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Effect {
    /// Key of the parameter.
    pub parameter: &'static str,
    /// Its value.
    pub at: f64,
    /// Unit of the figure per unit of the parameter; none where it does not exist.
    pub derivative: Option<f64>,
    /// Derivative times |parameter| over |figure|: % per %, the derivative's sign; none for a parameter that is 0.
    pub elasticity: Option<f64>,
}

/// A figure along one parameter; not finite where it does not exist.
struct Value {
    name: String,
    meaning: String,
    value: Along,
}

/// The vehicle, its glide, and what follows from both.
struct Base<'a> {
    study: &'a Study<'a>,
    vehicle: &'a Vehicle,
    lift_coefficient: f64,
    condition: Condition,
    scale: Scale,
    roll: RollKinematics,
    glide: Glide,
    modes: Modes,
    /// None where the full equations have no straight glide.
    turn: Option<[Helix; 2]>,
}

/// All derivatives of a vehicle's figures at a glide.
///
/// # Errors
/// One line: no such glide, or no finite linearisation there.
pub fn sensitivities(
    study: &Study<'_>,
    condition: Condition,
    scale: Scale,
    roll: RollKinematics,
) -> Result<Sensitivities, String> {
    let nominal = Shape::of(study.vehicle);
    let lift_coefficient = match study.anchoring {
        Anchoring::Anchored => 0.0,
        Anchoring::Unanchored => glide(study.vehicle, condition, scale)?.lift_coefficient,
    };
    let vehicle = study.vehicle(&nominal, study.vehicle.nominal_speed_m_s, lift_coefficient)?;
    let glide = glide(&vehicle, condition, scale)?;
    if condition == Condition::MinGlideAngle && glide.phi_rad != 0.0 {
        let degrees = glide.path_angle_rad.to_degrees();
        return Err(format!(
            "{}: flies banked, and has no flattest glide to differentiate: give a path angle below {degrees:.3}°",
            vehicle.name
        ));
    }
    let modes = modes(&vehicle, &glide, roll)?;
    let turn = Turns::new(&vehicle, &glide).ok().map(|turns| [*turns.straight(), turns.fastest_right()]);
    let base = Base { study, vehicle: &vehicle, lift_coefficient, condition, scale, roll, glide, modes, turn };
    let columns: Vec<(Parameter, Vec<Value>)> =
        Parameter::ALL.map(|parameter| (parameter, base.along(parameter))).into();
    let stream = study.stream(study.vehicle.nominal_speed_m_s, lift_coefficient);
    let flows = flow::flows(&nominal, &stream);
    let mut warnings = base.modes.warnings.clone();
    warnings.extend(flows.iter().filter_map(Flow::warning));
    Ok(Sensitivities {
        figures: merits(&nominal, &columns),
        switches: flow::switches(&nominal, &stream),
        flows,
        warnings,
        glide: base.glide,
    })
}

/// Columns by parameter, turned into rows by figure.
fn merits(nominal: &Shape, columns: &[(Parameter, Vec<Value>)]) -> Vec<Merit> {
    let first = columns.first().map_or(&[][..], |(_, values)| values);
    let merit = |(row, head): (usize, &Value)| Merit {
        name: head.name.clone(),
        meaning: head.meaning.clone(),
        value: finite(head.value.re),
        effects: columns
            .iter()
            .filter_map(|(parameter, values)| Some(effect(nominal, *parameter, values.get(row)?.value)))
            .collect(),
    };
    first.iter().enumerate().map(merit).collect()
}

fn effect(nominal: &Shape, parameter: Parameter, value: Along) -> Effect {
    let at = *parameter.of(&mut nominal.clone());
    let derivative = rate(value);
    Effect {
        parameter: parameter.key(),
        at,
        derivative: finite(derivative),
        elasticity: finite(derivative * at.abs() / value.re.abs()).filter(|_| at != 0.0),
    }
}

fn finite(value: f64) -> Option<f64> {
    value.is_finite().then_some(value)
}

impl Base<'_> {
    /// Every figure along one parameter, always in one order.
    fn along(&self, parameter: Parameter) -> Vec<Value> {
        let constant = |value: f64| Nested::constant(value);
        let nominal = Shape::of(self.study.vehicle);
        let mut shape: Shape<Nested> = nominal.lift();
        *parameter.of(&mut shape) = Nested::from_re(with_rate(*parameter.of(&mut nominal.clone()), 1.0));
        let speed_m_s = constant(self.study.vehicle.nominal_speed_m_s);
        let outside = self.study.outside(&shape, speed_m_s, constant(self.lift_coefficient));
        let plant = Plant::with(self.vehicle, &outside);
        let [c_d_zero, c_d_induced] = outside.coefficients.drag.map(|coefficient| coefficient.re);
        let polar = Polar { c_d_zero, c_d_induced };
        let trims = self.trims(&plant, &polar, outside.coefficients.lift.map(|coefficient| coefficient.re));
        let mut values = self.performance(&polar, trims.as_ref());
        values.extend(self.eigenvalues(&plant, trims.as_ref()));
        values.extend(self.turning(&plant, trims.as_ref()));
        values
    }

    /// γ: held, or that of the polar's marked point.
    fn path_angle_rad(&self, polar: &Polar<Along>) -> Along {
        let descent_rad = match self.condition {
            Condition::PathAngle(_) => return Along::constant(self.glide.path_angle_rad),
            Condition::MinGlideAngle => polar.best_glide().descent_rad,
            Condition::MaxHorizontalSpeed => polar.max_horizontal_speed().descent_rad,
        };
        with_rate(self.glide.path_angle_rad, -rate(descent_rad))
    }

    fn trims(
        &self,
        plant: &Plant<Nested>,
        polar: &Polar<Along>,
        [lift_zero, by_alpha, _]: [Along; 3],
    ) -> Option<Trims> {
        let found = Helix::from(&self.glide);
        let path_angle_rad = self.path_angle_rad(polar);
        let slope = if self.condition == Condition::MinGlideAngle {
            // The flattest path angle is that of two glides that are one: it says nothing of how the incidence moves.
            let alpha_rad = (polar.best_glide().lift_coefficient - lift_zero) / by_alpha;
            Slope::Pitch(with_rate(self.glide.pitch_rad, rate(path_angle_rad + alpha_rad)))
        } else {
            Slope::PathAngle(path_angle_rad)
        };
        let straight = |scale| HelixAlong { plant }.helix(&found, scale, slope, Turn::Rate(Along::constant(0.0)));
        let asked = match self.scale {
            Scale::Speed(speed_m_s) => HelixScale::Speed(Along::constant(speed_m_s)),
            Scale::NetMass(net_mass_kg) => HelixScale::NetMass(Along::constant(net_mass_kg)),
        };
        let net_mass = HelixScale::NetMass(Along::constant(self.glide.net_mass_kg));
        Some(Trims { path_angle_rad, asked: straight(asked)?, at_net_mass: straight(net_mass)? })
    }

    fn performance(&self, polar: &Polar<Along>, trims: Option<&Trims>) -> Vec<Value> {
        let weight = |net_mass_kg: Along| net_mass_kg * Along::constant(self.vehicle.water.gravity_m_s2);
        let range = trims.map(|trims| {
            let (cos, sin) = (Real::cos(trims.path_angle_rad), Real::sin(trims.path_angle_rad));
            // Gliding down takes a positive net mass, climbing a negative one: the quotient is positive.
            -cos / (sin * weight(trims.asked.net_mass_kg))
        });
        vec![
            value("lift_to_drag", "polar: largest lift to drag", Some(polar.best_glide().lift_to_drag)),
            value("range_m_j", "glide: ideal range per energy of the pump, m/J", range),
            value("speed_m_s", "glide: speed at this net mass, m/s", trims.map(|trims| trims.at_net_mass.speed_m_s)),
        ]
    }

    fn eigenvalues(&self, plant: &Plant<Nested>, trims: Option<&Trims>) -> Vec<Value> {
        let matrix = trims.map(|trims| jacobian(plant, &trims.asked, self.roll));
        let sets = [("longitudinal", 0, &self.modes.longitudinal), ("lateral", 4, &self.modes.lateral)];
        sets.into_iter()
            .flat_map(|(name, first, set)| {
                let block = matrix.map(|matrix| matrix.fixed_view::<4, 4>(first, first).into_owned());
                eigenvalue::values(name, set, block.as_ref())
            })
            .collect()
    }

    fn turning(&self, plant: &Plant<Nested>, trims: Option<&Trims>) -> Vec<Value> {
        let values = self.turn.zip(trims).and_then(|([straight, fastest], trims)| {
            let along = HelixAlong { plant };
            let scale = HelixScale::NetMass(trims.asked.net_mass_kg);
            let slope = Slope::Pitch(trims.asked.pitch_rad);
            let straight = along.helix(&straight, scale, slope, Turn::Rate(Along::constant(0.0)))?;
            let fastest = along.helix(&fastest, scale, slope, Turn::Mu(Along::constant(fastest.mu_rad)))?;
            let slope_of_rate = along.turn_per_mu(&straight)?;
            Some([slope_of_rate * Along::constant(slope_of_rate.re.signum()), fastest.turn_rate_rad_s])
        });
        vec![
            value("turn_rate_per_mu_per_s", "turn: rate per rotation of the mass, 1/s", values.map(|[slope, _]| slope)),
            value(
                "turn_rate_rad_s",
                "turn: fastest within the mass's travel, rad/s",
                values.map(|[_, fastest]| fastest),
            ),
        ]
    }
}

/// The straight glide along one parameter.
struct Trims {
    path_angle_rad: Along,
    /// With what was asked for held: the speed, or the net mass.
    asked: Helix<Along>,
    /// With the net mass held.
    at_net_mass: Helix<Along>,
}

fn value(name: &str, meaning: &str, value: Option<Along>) -> Value {
    Value { name: name.into(), meaning: meaning.into(), value: value.unwrap_or_else(|| with_rate(f64::NAN, f64::NAN)) }
}
