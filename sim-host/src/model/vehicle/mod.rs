//! A vehicle: what its file says, in SI units.

mod compass;
mod drive;
mod engine;
mod file;
mod geometry;
mod hash;

pub use compass::Compass;
pub use drive::{AxialDrive, Drive, RotationDrive};
pub use engine::{Engine, EngineKind};
pub use geometry::{plan_area_m2, side_area_m2};

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

/// Everything known of a vehicle.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Vehicle {
    /// Its name.
    pub name: String,
    /// V0, m/s: scales the rate derivatives, whatever the actual speed.
    pub nominal_speed_m_s: f64,
    /// Hull, for geometry.
    pub hull: Hull,
    /// Wing, for geometry.
    pub wing: Wing,
    /// Vertical fin, for geometry.
    pub fin: Fin,
    /// Rigid body without the moving mass.
    pub body: Body,
    /// The moving mass and its drives.
    pub moving_mass: MovingMass,
    /// Added mass and inertia of the water.
    pub added_mass: AddedMass,
    /// Coefficients of the viscous forces.
    pub hydrodynamics: Hydrodynamics,
    /// Separated flow at large angles; without it the linear law holds at every angle.
    pub crossflow: Option<Crossflow>,
    /// Buoyancy engine; needed only to fly.
    pub buoyancy: Option<Buoyancy>,
    /// Electrical loads; needed only to fly.
    pub energy: Option<Energy>,
    /// How deep it may go; needed only to fly.
    pub limits: Option<Limits>,
    /// How the battery deflects the compass; without it nothing is corrected.
    pub compass: Option<Compass>,
    /// The water of the static analyses.
    pub water: Water,
}

/// A slender body of revolution.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Hull<T = f64> {
    /// l, m.
    pub length_m: T,
    /// f = l/d.
    pub fineness: T,
}

/// The wing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Wing<T = f64> {
    /// AR = b²/S.
    pub aspect_ratio: T,
    /// 𝒷 = b/d.
    pub span_ratio: T,
    /// t̄ = t/c̄.
    pub thickness_ratio: T,
    /// l_w: quarter chord aft of the centre of buoyancy, over the hull's length.
    pub position: T,
    /// Sweep, deg, back positive.
    pub sweep_deg: T,
    /// Dihedral, deg, tips up positive.
    pub dihedral_deg: T,
    /// Height above the hull's axis, m, up positive.
    pub height_m: T,
}

/// The vertical fin.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Fin<T = f64> {
    /// S_v over the hull's frontal area πd²/4.
    pub area_ratio: T,
    /// l_v: aft of the centre of buoyancy, over the hull's length.
    pub position: T,
    /// Aspect ratio.
    pub aspect_ratio: T,
    /// Thickness over chord.
    pub thickness_ratio: T,
    /// Height of its centre above the hull's axis, m, up positive.
    pub height_m: T,
}

/// The rigid body without the moving mass.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Body {
    /// m_rb, kg.
    pub mass_kg: f64,
    /// m_b, kg, at the origin.
    pub ballast_kg: f64,
    /// r_rb, m from the centre of buoyancy, body axes.
    pub centre_of_mass_m: Vector3<f64>,
    /// J_rb about the centre of buoyancy, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
}

/// The moving mass: a particle that slides along the axis and swings about it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MovingMass {
    /// m_p, kg.
    pub mass_kg: f64,
    /// R_p, m.
    pub radius_m: f64,
    /// Axial travel [min, max], m, forward positive.
    pub travel_m: [f64; 2],
    /// Axial speed of its drive, m/s.
    pub rate_m_s: f64,
    /// Rotation [min, max], deg, positive to the left.
    pub roll_deg: [f64; 2],
    /// Speed of its rotation, deg/s.
    pub roll_rate_deg_s: f64,
    /// Inertia about its own centre, kg m², in the particle frame: turns with mu; zero for a particle.
    pub inertia_kg_m2: Vector3<f64>,
    /// What drives it in flight.
    pub drive: Drive,
}

/// Added mass and inertia.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AddedMass {
    /// M_f, kg.
    pub mass_kg: Matrix3<f64>,
    /// J_f, kg m².
    pub inertia_kg_m2: Matrix3<f64>,
    /// C_f, kg m: row moment axis, column velocity axis.
    pub coupling_kg_m: Matrix3<f64>,
}

/// Frame in which the coefficients of moment are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub enum MomentFrame {
    /// Body axes (the paper's).
    Body,
    /// Axes of the oncoming flow.
    Current,
}

/// Coefficients of section 4 of the equations, Nelson's signs: side force along b2 positive.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[allow(
    missing_docs,
    reason = "the field's own names: c_y_beta is the derivative of the side force's coefficient by beta"
)]
pub struct Hydrodynamics {
    pub area_m2: f64,
    pub span_m: f64,
    pub chord_m: f64,
    pub moment_frame: MomentFrame,
    pub c_d_zero: f64,
    /// K: induced drag over C_L².
    pub c_d_induced: f64,
    pub c_l_zero: f64,
    pub c_l_alpha: f64,
    pub c_l_q: f64,
    pub c_y_beta: f64,
    pub c_y_p: f64,
    pub c_y_r: f64,
    pub c_roll_beta: f64,
    pub c_roll_p: f64,
    pub c_roll_r: f64,
    pub c_m_zero: f64,
    pub c_m_alpha: f64,
    pub c_m_q: f64,
    pub c_n_beta: f64,
    pub c_n_p: f64,
    pub c_n_r: f64,
}

/// Cross-flow drag of separated flow.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Crossflow {
    /// c_dc: drag coefficient of the cross section in a flow across it.
    pub drag_coefficient: f64,
    /// Area seen along b3 (hull and wing), m².
    pub plan_area_m2: f64,
    /// Area seen along b2 (hull and fin), m².
    pub side_area_m2: f64,
    /// Incidence up to which the flow stays attached, deg.
    pub stall_deg: f64,
    /// Incidence from which it has separated, deg.
    pub separated_deg: f64,
}

/// The variable buoyancy device.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Buoyancy {
    /// Volume [min, max] beyond neutral in the static water, m³.
    pub volume_m3: [f64; 2],
    /// Pumping rate, m³/s.
    pub pump_rate_m3_s: f64,
    /// Bleeding rate, m³/s.
    pub bleed_rate_m3_s: f64,
    /// Station on the hull's axis, m forward of the centre of buoyancy.
    pub position_m: f64,
    /// Whether the volume beyond neutral acts at the station; else, with all the rest, at the centre of buoyancy.
    pub acts_at_station: bool,
    /// Ideal work over electrical energy, as (gauge pressure in Pa, efficiency), pressure rising.
    pub efficiency: Vec<[f64; 2]>,
    /// Electrical power of the pump that no pressure takes away (friction, electronics), W.
    pub idle_power_w: f64,
    /// How it is built.
    pub engine: Engine,
    /// How the displaced volume gives way.
    pub elasticity: Elasticity,
}

/// How pressure and temperature change the displaced volume: `V_d (1 − κ p + α_T (T − T_ref))`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Elasticity {
    /// κ, 1/Pa of pressure above the air's.
    pub compressibility_per_pa: f64,
    /// α_T, 1/°C.
    pub thermal_expansion_per_c: f64,
    /// T_ref, °C.
    pub reference_temperature_c: f64,
}

/// Electrical loads.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Energy {
    /// Battery, J.
    pub battery_j: f64,
    /// Battery voltage, V.
    pub battery_v: f64,
    /// Everything that always runs, W.
    pub hotel_w: f64,
    /// Axial drive while it moves, W.
    pub pitch_motor_w: f64,
    /// Rotation drive while it moves, W.
    pub roll_motor_w: f64,
    /// Most that pump and drives may draw together, W; nothing: no limit.
    pub peak_power_w: Option<f64>,
}

/// How deep it may go.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Limits {
    /// Deepest planned depth, m.
    pub working_depth_m: f64,
    /// Depth that breaks the hull, m.
    pub crush_depth_m: f64,
}

/// The water of the static analyses.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Water {
    /// ρ, kg/m³.
    pub density_kg_m3: f64,
    /// g, m/s².
    pub gravity_m_s2: f64,
    /// ν, m²/s: sets Reynolds numbers. It flies only through coefficients from geometry, and these are in the fingerprint.
    #[serde(skip)]
    pub kinematic_viscosity_m2_s: f64,
}

impl Vehicle {
    /// m = m_rb + m_p + m_b, kg.
    #[must_use]
    pub fn mass_kg(&self) -> f64 {
        self.body.mass_kg + self.moving_mass.mass_kg + self.body.ballast_kg
    }

    /// Displaced volume at which it neither sinks nor rises in the static water, m³.
    #[must_use]
    pub fn neutral_volume_m3(&self) -> f64 {
        self.mass_kg() / self.water.density_kg_m3
    }
}
