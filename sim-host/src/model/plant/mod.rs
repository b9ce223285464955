//! The plant: eight degrees of freedom of a rigid body with a moving particle and a variable displaced volume.
//!
//! Equations (1)–(8) and Appendix A of Fan & Woolsey (2013). Body axes forward, right, down, origin at the centre of
//! buoyancy; inertial axes north, east, down; the particle's polar angle `mu` hangs down at 0 and swings left when positive.
//! The velocity `η = (v, ω, ṙ_px, μ̇)`; the kinetic energy is `½ ηᵀ M(r_p) η`; `M η̇ = rhs − Ṁ η` is solved, never lagged.

mod attitude;
mod crossflow;
mod dynamics;
mod hydrodynamics;
mod inertia;
mod integrate;
mod outside;
mod solve;
mod station;
mod surface;
mod surroundings;

pub use attitude::{euler_from_quaternion, quaternion_from_euler, rotation_from_quaternion};
pub use dynamics::{Input, Reaction};
pub use hydrodynamics::{Flow, Viscous};
pub use inertia::Matrix8;
pub use integrate::{Particle, rk4_step};
pub use outside::Outside;
pub use surroundings::{Medium, Surroundings, Unrest};

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::model::{
    coefficients::Coefficients,
    real::Real,
    vehicle::{MomentFrame, Vehicle},
};

/// Where the vehicle is and how it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<T: Real> {
    /// X: north, east, down, m.
    pub position_m: Vector3<T>,
    /// Unit quaternion (w, x, y, z) from body to inertial axes.
    pub quaternion: Vector4<T>,
    /// v: relative to the water, body axes, m/s.
    pub velocity_m_s: Vector3<T>,
    /// ω: body axes, rad/s.
    pub rate_rad_s: Vector3<T>,
    /// r_px: axial position of the particle, m.
    pub r_px_m: T,
    /// Its rate, m/s.
    pub r_px_rate_m_s: T,
    /// μ: polar angle of the particle, rad.
    pub mu_rad: T,
    /// Its rate, rad/s.
    pub mu_rate_rad_s: T,
    /// V_d, m³.
    pub displaced_volume_m3: T,
}

impl<T: Real> State<T> {
    /// At rest at the origin, level, the particle centred.
    #[must_use]
    pub fn at_rest(displaced_volume_m3: T) -> Self {
        let zero = T::constant(0.0);
        Self {
            position_m: Vector3::repeat(zero),
            quaternion: Vector4::new(T::constant(1.0), zero, zero, zero),
            velocity_m_s: Vector3::repeat(zero),
            rate_rad_s: Vector3::repeat(zero),
            r_px_m: zero,
            r_px_rate_m_s: zero,
            mu_rad: zero,
            mu_rate_rad_s: zero,
            displaced_volume_m3,
        }
    }
}

/// The constants of one vehicle, and the density of its static analyses.
#[derive(Clone, Debug)]
pub struct Plant<T: Real> {
    mass_kg: T,
    density_kg_m3: T,
    gravity_m_s2: T,
    nominal_speed_m_s: T,
    /// m_rb r_rb, kg m.
    body_moment_kg_m: Vector3<T>,
    /// m_p, kg.
    particle_kg: T,
    /// R_p, m.
    particle_radius_m: T,
    /// Inertia of the moving mass about its own centre, particle frame, kg m².
    particle_inertia_kg_m2: Vector3<T>,
    /// Constant part of M's translational block: m_rb + m_b + M_f.
    fixed_mass_kg: Matrix3<T>,
    /// Constant part of M's lower left block (row moment, column velocity): m_rb r̂_rb + C_f.
    fixed_coupling_kg_m: Matrix3<T>,
    /// Constant part of M's rotational block: J_rb + J_f.
    fixed_inertia_kg_m2: Matrix3<T>,
    /// M_f, kg.
    added_mass_kg: Matrix3<T>,
    /// C_f, kg m.
    added_coupling_kg_m: Matrix3<T>,
    /// κ: loss of displaced volume with pressure, 1/Pa.
    compressibility_per_pa: T,
    /// α_T: gain of displaced volume with temperature, 1/°C.
    thermal_expansion_per_c: T,
    reference_temperature_c: T,
    coefficients: Coefficients<T>,
    moment_frame: MomentFrame,
    crossflow: Option<crossflow::Crossflow<T>>,
    /// Present where the variable volume acts away from the centre of buoyancy.
    station: Option<station::Station<T>>,
    /// Present where the water has a surface.
    hull: Option<surface::Hull<T>>,
}

impl<T: Real> Plant<T> {
    /// The plant of a vehicle in the water of its static analyses.
    #[must_use]
    pub fn new(vehicle: &Vehicle) -> Self {
        Self::with(vehicle, &Outside::of(vehicle))
    }

    /// The plant of a vehicle with another outside, which may carry derivatives.
    #[must_use]
    pub fn with(vehicle: &Vehicle, outside: &Outside<T>) -> Self {
        let c = T::constant;
        let vector = |v: &Vector3<f64>| v.map(c);
        let (body, water) = (&vehicle.body, &vehicle.water);
        let moment = body.centre_of_mass_m * body.mass_kg;
        let elastic = vehicle.buoyancy.as_ref().map(|buoyancy| buoyancy.elasticity).unwrap_or_default();
        let fixed_kg = Matrix3::from_diagonal_element(body.mass_kg + body.ballast_kg);
        let added = &outside.added_mass;
        Self {
            mass_kg: c(vehicle.mass_kg()),
            density_kg_m3: c(water.density_kg_m3),
            gravity_m_s2: c(water.gravity_m_s2),
            nominal_speed_m_s: c(vehicle.nominal_speed_m_s),
            body_moment_kg_m: vector(&moment),
            particle_kg: c(vehicle.moving_mass.mass_kg),
            particle_radius_m: c(vehicle.moving_mass.radius_m),
            particle_inertia_kg_m2: vector(&vehicle.moving_mass.inertia_kg_m2),
            fixed_mass_kg: fixed_kg.map(c) + added.mass_kg,
            fixed_coupling_kg_m: moment.cross_matrix().map(c) + added.coupling_kg_m,
            fixed_inertia_kg_m2: body.inertia_kg_m2.map(c) + added.inertia_kg_m2,
            added_mass_kg: added.mass_kg,
            added_coupling_kg_m: added.coupling_kg_m,
            compressibility_per_pa: c(elastic.compressibility_per_pa),
            thermal_expansion_per_c: c(elastic.thermal_expansion_per_c),
            reference_temperature_c: c(elastic.reference_temperature_c),
            coefficients: outside.coefficients,
            moment_frame: vehicle.hydrodynamics.moment_frame,
            crossflow: crossflow::Crossflow::new(vehicle, outside),
            station: station::Station::new(vehicle),
            hull: None,
        }
    }

    /// Net mass m̃ = m − ρ V_d in the static water, kg, positive sinks.
    #[must_use]
    pub fn net_mass_kg(&self, displaced_volume_m3: T) -> T {
        self.mass_kg - self.density_kg_m3 * displaced_volume_m3
    }

    /// Displaced volume for a net mass in the static water, m³.
    #[must_use]
    pub fn displaced_volume_m3(&self, net_mass_kg: T) -> T {
        (self.mass_kg - net_mass_kg) / self.density_kg_m3
    }
}
