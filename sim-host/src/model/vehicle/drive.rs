//! The drives of the moving mass: what its file says beyond travel and rates.
//!
//! Optional in `[moving_mass]`: `drive` (`"kinematic"`, the default, or `"dynamic"`, then with the sections `axial` and `rotation`,
//! whose every key may be left out).

use serde::Serialize;

use crate::files::toml_file::{Rule, Section};

/// How the moving mass is driven in flight.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum Drive {
    /// It has the commanded speed at once, whatever force that takes: six degrees of freedom. Fast.
    Kinematic,
    /// Motors push it, friction and end stops hold it, brakes clamp it: eight degrees of freedom while it moves.
    Dynamic {
        /// Along the axis.
        axial: AxialDrive,
        /// About the axis.
        rotation: RotationDrive,
    },
}

/// A motor with a lead screw. Every default is chosen; together they make 2 to 5 J per move (`tests/mass_drive.rs`).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct AxialDrive {
    /// How fast its speed changes, m/s².
    pub acceleration_m_s2: f64,
    /// Coulomb friction of the carriage, N.
    pub friction_n: f64,
    /// Play between screw and carriage, m.
    pub backlash_m: f64,
    /// Load at which the motor stands still, N.
    pub stall_n: f64,
    /// Load that the brake holds, N.
    pub brake_n: f64,
    /// Work on the carriage over electrical work.
    pub efficiency: f64,
    /// Electrical power of running without load, W.
    pub idle_power_w: f64,
}

/// A motor with a gear. Every default is chosen; together they make 2 to 6 J per move (`tests/mass_drive.rs`).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RotationDrive {
    /// How fast its speed changes, deg/s².
    pub acceleration_deg_s2: f64,
    /// Coulomb friction of the bearings, N m.
    pub friction_nm: f64,
    /// Play of the gear at the mass, deg.
    pub backlash_deg: f64,
    /// Load at which the motor stands still, N m.
    pub stall_nm: f64,
    /// Load that the brake holds, N m.
    pub brake_nm: f64,
    /// Work on the mass over electrical work.
    pub efficiency: f64,
    /// Electrical power of running without load, W.
    pub idle_power_w: f64,
}

impl Default for AxialDrive {
    fn default() -> Self {
        Self {
            acceleration_m_s2: 0.05,
            friction_n: 10.0,
            backlash_m: 2e-4,
            stall_n: 300.0,
            brake_n: 300.0,
            efficiency: 0.3,
            idle_power_w: 1.0,
        }
    }
}

impl Default for RotationDrive {
    fn default() -> Self {
        Self {
            acceleration_deg_s2: 60.0,
            friction_nm: 0.3,
            backlash_deg: 0.3,
            stall_nm: 20.0,
            brake_nm: 20.0,
            efficiency: 0.4,
            idle_power_w: 1.0,
        }
    }
}

impl Drive {
    pub(super) fn read(mass: &mut Section<'_>) -> Self {
        let drives = [("kinematic", false), ("dynamic", true)];
        if !mass.choice_or_first("drive", &drives).unwrap_or(false) {
            return Self::Kinematic;
        }
        Self::Dynamic {
            axial: mass.optional_section("axial", axial).unwrap_or_default(),
            rotation: mass.optional_section("rotation", rotation).unwrap_or_default(),
        }
    }
}

fn axial(drive: &mut Section<'_>) -> AxialDrive {
    let chosen = AxialDrive::default();
    AxialDrive {
        acceleration_m_s2: drive.number_or("acceleration_m_s2", Rule::Positive, chosen.acceleration_m_s2),
        friction_n: drive.number_or("friction_n", Rule::NotNegative, chosen.friction_n),
        backlash_m: drive.number_or("backlash_m", Rule::NotNegative, chosen.backlash_m),
        stall_n: drive.number_or("stall_n", Rule::Positive, chosen.stall_n),
        brake_n: drive.number_or("brake_n", Rule::Positive, chosen.brake_n),
        efficiency: drive.number_or("efficiency", Rule::Within(0.01, 1.0), chosen.efficiency),
        idle_power_w: drive.number_or("idle_power_w", Rule::NotNegative, chosen.idle_power_w),
    }
}

fn rotation(drive: &mut Section<'_>) -> RotationDrive {
    let chosen = RotationDrive::default();
    RotationDrive {
        acceleration_deg_s2: drive.number_or("acceleration_deg_s2", Rule::Positive, chosen.acceleration_deg_s2),
        friction_nm: drive.number_or("friction_nm", Rule::NotNegative, chosen.friction_nm),
        backlash_deg: drive.number_or("backlash_deg", Rule::NotNegative, chosen.backlash_deg),
        stall_nm: drive.number_or("stall_nm", Rule::Positive, chosen.stall_nm),
        brake_nm: drive.number_or("brake_nm", Rule::Positive, chosen.brake_nm),
        efficiency: drive.number_or("efficiency", Rule::Within(0.01, 1.0), chosen.efficiency),
        idle_power_w: drive.number_or("idle_power_w", Rule::NotNegative, chosen.idle_power_w),
    }
}
