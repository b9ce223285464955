//! Root loci: how a vehicle's modes move when a parameter changes, each branch followed continuously.

use nalgebra::Complex;
use serde::Serialize;

use crate::analysis::{
    modes::{Modes, RollKinematics, modes},
    trim::{Condition, Scale, glide},
};
use crate::model::{
    coefficients::{Anchoring, Parameter, Shape, Study},
    vehicle::Vehicle,
};

/// Steps of the parameter between two points that are kept.
const SUB_STEPS: usize = 8;

/// Four eigenvalues over the values of a parameter.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Locus {
    /// Values of the parameter.
    pub values: Vec<f64>,
    /// One per mode: [re, im] at each value, 1/s; no branch jumps to another one.
    pub branches: [Vec<[f64; 2]>; 4],
}

/// What is varied.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Varied {
    /// A geometric parameter; the coefficients follow from it.
    Shape(Parameter),
    /// C_lβ alone: the effect of sweep, dihedral and height of the wing together.
    RollBySideslip,
}

/// Both root loci of one study.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Loci {
    /// Motion in the plane of symmetry.
    pub longitudinal: Locus,
    /// Motion out of it.
    pub lateral: Locus,
}

/// Root loci of a vehicle whose shape or C_lβ varies, trimmed anew at each value.
///
/// # Errors
/// One line that says at which value there is no such vehicle or glide.
pub fn vary(
    study: &Study<'_>,
    varied: Varied,
    range: [f64; 2],
    points: usize,
    condition: Condition,
    scale: Scale,
    roll: RollKinematics,
) -> Result<Loci, String> {
    let lift_coefficient = glide(study.vehicle, condition, scale)?.lift_coefficient;
    let modes_at = |value: f64| -> Result<Modes, String> {
        let vehicle = varied.vehicle(study, value, lift_coefficient)?;
        let glide = glide(&vehicle, condition, scale)?;
        modes(&vehicle, &glide, roll)
    };
    let modes_at = |value| modes_at(value).map_err(|error| format!("{varied} = {value}: {error}"));
    Ok(Loci {
        longitudinal: follow(range, points, |value| Ok(modes_at(value)?.longitudinal.eigenvalues))?,
        lateral: follow(range, points, |value| Ok(modes_at(value)?.lateral.eigenvalues))?,
    })
}

impl Varied {
    /// The vehicle at a value of what is varied, its coefficients those of the nominal speed.
    ///
    /// Anchored ones are taken without lift, so that the nominal value gives the vehicle's own; others with the lift coefficient.
    ///
    /// # Errors
    /// One line if there is no such vehicle.
    pub fn vehicle(self, study: &Study<'_>, value: f64, lift_coefficient: f64) -> Result<Vehicle, String> {
        let mut shape = Shape::of(study.vehicle);
        if let Self::Shape(parameter) = self {
            *parameter.of(&mut shape) = value;
        }
        let lift_coefficient = match study.anchoring {
            Anchoring::Anchored => 0.0,
            Anchoring::Unanchored => lift_coefficient,
        };
        let mut vehicle = study.vehicle(&shape, study.vehicle.nominal_speed_m_s, lift_coefficient)?;
        if self == Self::RollBySideslip {
            vehicle.hydrodynamics.c_roll_beta = value;
        }
        Ok(vehicle)
    }
}

impl std::fmt::Display for Varied {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Shape(parameter) => parameter.fmt(f),
            Self::RollBySideslip => f.write_str("hydrodynamics.roll.beta"),
        }
    }
}

impl std::str::FromStr for Varied {
    type Err = String;

    fn from_str(key: &str) -> Result<Self, String> {
        if key == Self::RollBySideslip.to_string() { Ok(Self::RollBySideslip) } else { key.parse().map(Self::Shape) }
    }
}

/// Follows eigenvalues from one value of a parameter to another, over `points` evenly spaced values (at least two).
///
/// Between two values each eigenvalue goes on about as it went before, so branches may cross.
///
/// # Errors
/// The first error of `eigenvalues`.
pub fn follow(
    [from, to]: [f64; 2],
    points: usize,
    mut eigenvalues: impl FnMut(f64) -> Result<[[f64; 2]; 4], String>,
) -> Result<Locus, String> {
    let steps = SUB_STEPS * points.max(2).saturating_sub(1);
    let mut current = eigenvalues(from)?.map(complex);
    let mut before = current;
    let mut locus = Locus { values: vec![from], branches: current.map(|value| vec![pair(value)]) };
    for step in 1..=steps {
        let value = from + (to - from) * step as f64 / steps as f64;
        let expected: [Complex<f64>; 4] = std::array::from_fn(|i| current[i] * 2.0 - before[i]);
        let next = nearest_order(&eigenvalues(value)?.map(complex), &expected);
        (before, current) = (current, next);
        if step % SUB_STEPS == 0 {
            locus.values.push(value);
            for (branch, value) in locus.branches.iter_mut().zip(current) {
                branch.push(pair(value));
            }
        }
    }
    Ok(locus)
}

/// The order of four values in which they lie nearest to the expected ones (sum of squared distances).
fn nearest_order(values: &[Complex<f64>; 4], expected: &[Complex<f64>; 4]) -> [Complex<f64>; 4] {
    let distance = |order: &[usize; 4]| -> f64 {
        order.iter().zip(expected).map(|(place, expected)| (values[*place] - expected).norm_sqr()).sum()
    };
    let best = orders().min_by(|a, b| distance(a).total_cmp(&distance(b)));
    best.map_or(*values, |order| order.map(|place| values[place]))
}

/// The 24 orders of four places.
fn orders() -> impl Iterator<Item = [usize; 4]> {
    let all = (0..4).flat_map(|a| (0..4).flat_map(move |b| (0..4).map(move |c| (a, b, c))));
    all.filter(|(a, b, c)| a != b && b != c && a != c).map(|(a, b, c)| [a, b, c, 6 - a - b - c])
}

fn complex([re, im]: [f64; 2]) -> Complex<f64> {
    Complex::new(re, im)
}

fn pair(value: Complex<f64>) -> [f64; 2] {
    [value.re, value.im]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By increasing real part, as the modes give them.
    fn sorted(mut values: [[f64; 2]; 4]) -> Result<[[f64; 2]; 4], String> {
        values.sort_by(|a, b| a[0].total_cmp(&b[0]).then(b[1].total_cmp(&a[1])));
        Ok(values)
    }

    #[test]
    fn branches_that_cross_go_on_as_they_came() {
        let lines = |k: f64| sorted([[k, 0.0], [1.0 - k, 0.0], [-2.0, 0.0], [-3.0 + 2.0 * k, 0.0]]);
        let locus = follow([0.0, 1.0], 11, lines).unwrap();
        for (k, i) in locus.values.iter().zip(0..) {
            let mut left: Vec<f64> = locus.branches.iter().map(|branch| branch[i][0]).collect();
            // Sorted at k = 0: −3, −2, 0, 1.
            let right = [-3.0 + 2.0 * k, -2.0, *k, 1.0 - k];
            left.iter_mut().zip(right).for_each(|(value, right)| *value -= right);
            assert!(left.iter().all(|error| error.abs() < 1e-12), "{k}: {left:?}");
        }
    }

    /// λ² + 2λ + k: real for k < 1, a pair beyond.
    #[test]
    fn a_pair_that_is_born_moves_without_a_jump() {
        let quadratic = |k: f64| {
            let root = Complex::new(1.0 - k, 0.0).sqrt();
            sorted([[-1.0 - root.re, -root.im], [-1.0 + root.re, root.im], [-5.0, 0.0], [-6.0, 0.0]])
        };
        let locus = follow([0.0, 2.0], 201, quadratic).unwrap();
        for branch in &locus.branches {
            for step in branch.windows(2) {
                // Near its birth a pair moves with the root of the parameter: √0.01.
                assert!((step[1][0] - step[0][0]).hypot(step[1][1] - step[0][1]) <= 0.1 + 1e-9, "{step:?}");
            }
        }
        let ends: Vec<f64> = locus.branches.iter().map(|branch| branch[200][1]).collect();
        assert!(ends.iter().any(|im| (im - 1.0).abs() < 1e-12) && ends.iter().any(|im| (im + 1.0).abs() < 1e-12));
    }

    #[test]
    fn an_error_on_the_way_is_given_back() {
        let failing = |k: f64| if k > 0.5 { Err("beyond".to_owned()) } else { Ok([[0.0; 2]; 4]) };
        assert_eq!(follow([0.0, 1.0], 3, failing), Err("beyond".to_owned()));
    }
}
