//! Continuation: when one search does not reach what is asked, the motion is led there in steps, as far as it goes.

use super::{
    Helix, HelixSolver, Scale, Slope, Turn,
    search::{Asked, Miss},
};

/// Part of the way below which a step is not halved again: the nearest motion is found to this part.
const LEAST_STEP: f64 = 1e-3;

impl HelixSolver {
    /// What is asked, by one search from `near` or else in steps from there.
    pub(super) fn reach(&self, near: &Helix, asked: Asked) -> Result<Helix, String> {
        self.search(near, &asked).or_else(|miss| {
            self.follow(near, &asked).map_err(|nearest| {
                let nearest = nearest.map_or_else(String::new, |helix| format!("; the nearest found has {helix}"));
                format!("no steady helix with {asked}: {miss}{nearest}")
            })
        })
    }

    /// From the motion that `near` is, or lies close to, towards what is asked; if that is not reached, the nearest on the way.
    fn follow(&self, near: &Helix, asked: &Asked) -> Result<Helix, Option<Helix>> {
        let start = asked.with_values_of(near);
        let mut helix = self.search(near, &start).map_err(|_| None)?;
        let (mut done, mut step) = (0.0, 0.5);
        while step > LEAST_STEP {
            let share: f64 = (done + step).min(1.0);
            match self.search(&helix, &start.towards(asked, share)) {
                Ok(arrived) if share == 1.0 => return Ok(arrived),
                Ok(next) => {
                    helix = next;
                    done = share;
                }
                Err(_) => step *= 0.5,
            }
        }
        Err(Some(helix))
    }
}

impl Asked {
    /// The same kinds of givens, with the values that a helix has.
    fn with_values_of(&self, helix: &Helix) -> Self {
        Self {
            scale: match self.scale {
                Scale::Speed(_) => Scale::Speed(helix.speed_m_s),
                Scale::NetMass(_) => Scale::NetMass(helix.net_mass_kg),
            },
            slope: match self.slope {
                Slope::PathAngle(_) => Slope::PathAngle(helix.path_angle_rad()),
                Slope::Pitch(_) => Slope::Pitch(helix.pitch_rad),
            },
            turn: match self.turn {
                Turn::Mu(_) => Turn::Mu(helix.mu_rad),
                Turn::Rate(_) => Turn::Rate(helix.turn_rate_rad_s),
            },
        }
    }

    /// Part of the way to the values of another, which gives the same kinds.
    fn towards(&self, other: &Self, share: f64) -> Self {
        let mix = |from: f64, to: f64| if share == 1.0 { to } else { from + (to - from) * share };
        Self {
            scale: match (self.scale, other.scale) {
                (Scale::Speed(from), Scale::Speed(to)) => Scale::Speed(mix(from, to)),
                (Scale::NetMass(from), Scale::NetMass(to)) => Scale::NetMass(mix(from, to)),
                (_, scale) => scale,
            },
            slope: match (self.slope, other.slope) {
                (Slope::PathAngle(from), Slope::PathAngle(to)) => Slope::PathAngle(mix(from, to)),
                (Slope::Pitch(from), Slope::Pitch(to)) => Slope::Pitch(mix(from, to)),
                (_, slope) => slope,
            },
            turn: match (self.turn, other.turn) {
                (Turn::Mu(from), Turn::Mu(to)) => Turn::Mu(mix(from, to)),
                (Turn::Rate(from), Turn::Rate(to)) => Turn::Rate(mix(from, to)),
                (_, turn) => turn,
            },
        }
    }
}

impl std::fmt::Display for Asked {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}, {}, {}", self.slope, self.turn, self.scale)
    }
}

impl std::fmt::Display for Miss {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Residual(left) => write!(f, "a residual of {left:.2e} N is left"),
            Self::NoFlight => write!(f, "only a motion backwards or abeam balances"),
        }
    }
}
