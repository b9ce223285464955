//! Steady helices of the full equations: turns at constant rate along a path of constant slope, straight glides among them.

mod along;
mod follow;
mod search;

use nalgebra::{SVector, Vector3};

use crate::model::{
    plant::{Plant, State, quaternion_from_euler},
    real::Real,
};
pub(crate) use along::{Along, HelixAlong, Nested, rate, with_rate};
pub use search::HelixSolver;

/// (V or m̃, α, β, φ, θ, r_px, μ, Ω): speed or net mass, whichever is not given.
type Unknowns<T> = SVector<T, 8>;

/// A steady helix: a turn at constant rate along a path of constant slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Helix<T = f64> {
    /// m̃, kg, positive sinks.
    pub net_mass_kg: T,
    /// V, m/s.
    pub speed_m_s: T,
    /// α, rad.
    pub alpha_rad: T,
    /// β, rad.
    pub beta_rad: T,
    /// φ, rad, right wing down.
    pub roll_rad: T,
    /// θ, rad.
    pub pitch_rad: T,
    /// Axial position of the moving mass, m.
    pub r_px_m: T,
    /// μ, rad.
    pub mu_rad: T,
    /// Ω, rad/s, right positive.
    pub turn_rate_rad_s: T,
}

/// What is given of a glide's size: how fast, or how heavy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale<T = f64> {
    /// Speed, m/s.
    Speed(T),
    /// Net mass, kg, positive sinks.
    NetMass(T),
}

/// What is given of the helix's slope.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slope<T = f64> {
    /// γ, rad.
    PathAngle(T),
    /// θ, rad.
    Pitch(T),
}

/// What is given of its turn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Turn<T = f64> {
    /// μ, rad.
    Mu(T),
    /// Ω, rad/s.
    Rate(T),
}

impl Helix {
    /// γ, rad, climbing positive.
    #[must_use]
    pub fn path_angle_rad(&self) -> f64 {
        libm::asin(climb(&self.unknowns(Scale::NetMass(self.net_mass_kg))))
    }

    /// Radius of the helix seen from above, m; infinite for a straight glide.
    #[must_use]
    pub fn radius_m(&self) -> f64 {
        self.speed_m_s * libm::cos(self.path_angle_rad()) / self.turn_rate_rad_s.abs()
    }
}

impl<T: Real> Helix<T> {
    /// The helix as a state of the plant, heading north, at depth 0.
    #[must_use]
    pub fn state(&self, plant: &Plant<T>) -> State<T> {
        let scale = Scale::NetMass(self.net_mass_kg);
        steady_state(plant, &self.unknowns(scale), scale)
    }

    fn unknowns(&self, scale: Scale<T>) -> Unknowns<T> {
        let size = match scale {
            Scale::Speed(_) => self.net_mass_kg,
            Scale::NetMass(_) => self.speed_m_s,
        };
        Unknowns::from([
            size,
            self.alpha_rad,
            self.beta_rad,
            self.roll_rad,
            self.pitch_rad,
            self.r_px_m,
            self.mu_rad,
            self.turn_rate_rad_s,
        ])
    }

    fn from_unknowns(x: &Unknowns<T>, scale: Scale<T>) -> Self {
        let [size, alpha_rad, beta_rad, roll_rad, pitch_rad, r_px_m, mu_rad, turn_rate_rad_s] = (*x).into();
        let [speed_m_s, net_mass_kg] = scale.speed_and_net_mass(size);
        Self { net_mass_kg, speed_m_s, alpha_rad, beta_rad, roll_rad, pitch_rad, r_px_m, mu_rad, turn_rate_rad_s }
    }

    /// v, body axes, m/s.
    pub(crate) fn velocity_m_s(&self) -> Vector3<T> {
        direction(&self.unknowns(Scale::NetMass(self.net_mass_kg))) * self.speed_m_s
    }
}

impl<T: Real> Scale<T> {
    /// Both, the one that is not given being the unknown.
    fn speed_and_net_mass(self, unknown: T) -> [T; 2] {
        match self {
            Self::Speed(speed_m_s) => [speed_m_s, unknown],
            Self::NetMass(net_mass_kg) => [unknown, net_mass_kg],
        }
    }
}

/// Unit vector of the velocity, body axes.
fn direction<T: Real>(x: &Unknowns<T>) -> Vector3<T> {
    let (alpha, beta) = (x[1], x[2]);
    Vector3::new(alpha.cos() * beta.cos(), beta.sin(), alpha.sin() * beta.cos())
}

/// Direction of gravity, body axes.
fn zeta<T: Real>(x: &Unknowns<T>) -> Vector3<T> {
    let (roll, pitch) = (x[3], x[4]);
    Vector3::new(-pitch.sin(), pitch.cos() * roll.sin(), pitch.cos() * roll.cos())
}

/// sin γ.
fn climb<T: Real>(x: &Unknowns<T>) -> T {
    -direction(x).dot(&zeta(x))
}

/// The state whose rates vanish if the helix is steady.
fn steady_state<T: Real>(plant: &Plant<T>, x: &Unknowns<T>, scale: Scale<T>) -> State<T> {
    let [speed_m_s, net_mass_kg] = scale.speed_and_net_mass(x[0]);
    State {
        quaternion: quaternion_from_euler(&Vector3::new(x[3], x[4], T::constant(0.0))),
        velocity_m_s: direction(x) * speed_m_s,
        rate_rad_s: zeta(x) * x[7],
        r_px_m: x[5],
        mu_rad: x[6],
        ..State::at_rest(plant.displaced_volume_m3(net_mass_kg))
    }
}

impl std::fmt::Display for Helix {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let (slope, pitch) = (Slope::PathAngle(self.path_angle_rad()), Slope::Pitch(self.pitch_rad));
        let (turn, mu) = (Turn::Rate(self.turn_rate_rad_s), Turn::Mu(self.mu_rad));
        let (speed, net_mass) = (Scale::Speed(self.speed_m_s), Scale::NetMass(self.net_mass_kg));
        write!(f, "{slope}, {pitch}, {turn}, {mu}, {speed}, {net_mass}, roll {:.2}°", self.roll_rad.to_degrees())
    }
}

impl std::fmt::Display for Scale {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Speed(speed) => write!(f, "speed {speed:.4} m/s"),
            Self::NetMass(net_mass) => write!(f, "net mass {net_mass:.4} kg"),
        }
    }
}

impl std::fmt::Display for Slope {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::PathAngle(angle) => write!(f, "path angle {:.3}°", angle.to_degrees()),
            Self::Pitch(angle) => write!(f, "pitch {:.3}°", angle.to_degrees()),
        }
    }
}

impl std::fmt::Display for Turn {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Mu(angle) => write!(f, "mu {:.2}°", angle.to_degrees()),
            Self::Rate(rate) => write!(f, "turn rate {rate:.6} rad/s"),
        }
    }
}
