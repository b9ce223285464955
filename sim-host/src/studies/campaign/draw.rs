//! What is unknown about a vehicle and its day: drawn from a seed.

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

use crate::model::{
    ocean::Ocean,
    vehicle::{Hydrodynamics, Vehicle},
};

/// Coefficients of forces and moments are known to this part, either way, evenly.
const COEFFICIENTS: f64 = 0.10;
/// Damping is known to this part.
const DAMPING: f64 = 0.20;
/// Ballast is known to this mass, kg.
const BALLAST_KG: f64 = 0.03;
/// Keeps these draws apart from those of the instruments, which come from the same seed.
const STREAM: u64 = 0x6361_6d70_6169_676e;

/// One coefficient that is not known exactly.
#[derive(Clone, Copy, Debug)]
pub struct Factor {
    /// Its name.
    pub name: &'static str,
    /// Most by which its factor differs from 1.
    size: f64,
    /// Where it stands.
    of: fn(&mut Hydrodynamics) -> &mut f64,
}

const fn factor(name: &'static str, size: f64, of: fn(&mut Hydrodynamics) -> &mut f64) -> Factor {
    Factor { name, size, of }
}

/// Number of [`FACTORS`].
const COUNT: usize = 17;

/// Every coefficient, in the order in which its factor is drawn.
pub const FACTORS: [Factor; COUNT] = [
    factor("c_d_zero", COEFFICIENTS, |h| &mut h.c_d_zero),
    factor("c_d_induced", COEFFICIENTS, |h| &mut h.c_d_induced),
    factor("c_l_zero", COEFFICIENTS, |h| &mut h.c_l_zero),
    factor("c_l_alpha", COEFFICIENTS, |h| &mut h.c_l_alpha),
    factor("c_y_beta", COEFFICIENTS, |h| &mut h.c_y_beta),
    factor("c_roll_beta", COEFFICIENTS, |h| &mut h.c_roll_beta),
    factor("c_m_zero", COEFFICIENTS, |h| &mut h.c_m_zero),
    factor("c_m_alpha", COEFFICIENTS, |h| &mut h.c_m_alpha),
    factor("c_n_beta", COEFFICIENTS, |h| &mut h.c_n_beta),
    factor("c_l_q", DAMPING, |h| &mut h.c_l_q),
    factor("c_y_p", DAMPING, |h| &mut h.c_y_p),
    factor("c_y_r", DAMPING, |h| &mut h.c_y_r),
    factor("c_roll_p", DAMPING, |h| &mut h.c_roll_p),
    factor("c_roll_r", DAMPING, |h| &mut h.c_roll_r),
    factor("c_m_q", DAMPING, |h| &mut h.c_m_q),
    factor("c_n_p", DAMPING, |h| &mut h.c_n_p),
    factor("c_n_r", DAMPING, |h| &mut h.c_n_r),
];

/// What one seed drew.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawn {
    /// In the order of [`FACTORS`].
    pub factors: [f64; COUNT],
    /// Mass beyond neutral with the buoyancy device at zero, kg, positive sinks.
    pub ballast_kg: f64,
    /// Steady current, north and east, m/s.
    pub current_m_s: [f64; 2],
}

impl Drawn {
    /// Draws everything; the current has this speed, and a direction that the seed chooses.
    #[must_use]
    pub fn new(seed: u64, current_m_s: f64) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(seed ^ STREAM);
        let factors = FACTORS.map(|factor| 1.0 + factor.size * random.random_range(-1.0..1.0));
        let ballast_kg = BALLAST_KG * random.random_range(-1.0..1.0);
        let towards_rad: f64 = random.random_range(0.0..std::f64::consts::TAU);
        Self {
            factors,
            ballast_kg,
            current_m_s: [current_m_s * libm::cos(towards_rad), current_m_s * libm::sin(towards_rad)],
        }
    }

    /// Everything as its file says, no current.
    #[must_use]
    pub fn nominal() -> Self {
        Self { factors: [1.0; COUNT], ballast_kg: 0.0, current_m_s: [0.0; 2] }
    }

    /// The vehicle that it makes of the one in the file.
    #[must_use]
    pub fn vehicle(&self, nominal: &Vehicle) -> Vehicle {
        let mut vehicle = nominal.clone();
        for (factor, by) in FACTORS.iter().zip(self.factors) {
            *(factor.of)(&mut vehicle.hydrodynamics) *= by;
        }
        vehicle
    }

    /// The ocean that it makes of the charted one, for a vehicle that was ballasted for dives to some depth, m.
    ///
    /// As a pilot ballasts: neutral half-way, with the hull as pressure and warmth leave it there; this mass off.
    #[must_use]
    pub fn ocean(&self, charted: &Ocean, nominal: &Vehicle, dive_to_m: f64) -> Ocean {
        let strain = 0.5 * (strain(nominal, charted, 0.0) + strain(nominal, charted, dive_to_m));
        let neutral_kg_m3 = charted.ballast_density_kg_m3(dive_to_m) * (1.0 + strain);
        let mass_kg = nominal.mass_kg();
        let ocean = charted.clone().with_ballast_density(neutral_kg_m3 * mass_kg / (mass_kg - self.ballast_kg));
        if self.current_m_s == [0.0; 2] { ocean } else { ocean.carried_along(self.current_m_s) }
    }
}

/// Relative change of the displaced volume at a depth, m.
fn strain(vehicle: &Vehicle, ocean: &Ocean, depth_m: f64) -> f64 {
    let Some(buoyancy) = &vehicle.buoyancy else { return 0.0 };
    let (elasticity, water) = (buoyancy.elasticity, ocean.sample(&[0.0, 0.0, depth_m].into(), 0.0).around);
    let warmth_c = water.temperature_c.map_or(0.0, |temperature_c| temperature_c - elasticity.reference_temperature_c);
    elasticity.thermal_expansion_per_c * warmth_c - elasticity.compressibility_per_pa * water.pressure_pa
}
