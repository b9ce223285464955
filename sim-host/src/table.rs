//! Generates the trim table that flies, from the plant, and measures how well it interpolates.

use shared::{
    table::{Axis, Grid, Header, Node, QUANTITIES, TableError, TrimTable, write},
    vehicle::{Actuators, FlightVehicle, GlideConstants, Range},
};

use crate::{
    helix::{Helix, HelixSolver, Slope, Turn},
    trim::{Condition, Scale, wings_level},
    vehicle::Vehicle,
};

/// Nodes along path angle, √(net mass) and sin μ, on each side.
const NODES: [u8; 3] = [13, 5, 5];
/// Rotation at which the slope of the turn rate at μ = 0 is taken, as its sine.
const SMALL_SIN_MU: f64 = 1e-3;
/// Larger than any table of [`NODES`].
const MOST_BYTES: usize = 64 * 1024;

/// What the table shall cover.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Envelope {
    /// Flattest and steepest dive, deg, positive numbers.
    pub dive_deg: [f64; 2],
    /// Flattest and steepest climb, deg.
    pub climb_deg: [f64; 2],
    /// Least and most net mass, kg, positive numbers for both sides.
    pub net_mass_kg: [f64; 2],
    /// Largest rotation of the mass, deg.
    pub mu_deg: f64,
}

impl Default for Envelope {
    /// Where slocum-paper flies: short of the control reversal of its dives at −39.3°.
    fn default() -> Self {
        Self { dive_deg: [12.0, 35.0], climb_deg: [12.0, 40.0], net_mass_kg: [0.05, 0.6], mu_deg: 60.0 }
    }
}

/// Largest errors of the table against exact trim, midway between its nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct InterpolationError {
    /// Of the speed, relative.
    pub speed: f64,
    /// Of the turn rate, relative to the turn rate.
    pub turn_rate: f64,
    /// Of the angle of attack, rad.
    pub alpha_rad: f64,
    /// Of the axial position, m.
    pub r_px_m: f64,
}

/// Both sides of [`InterpolationError`].
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
pub struct TableErrors {
    /// On dives.
    pub dive: InterpolationError,
    /// On climbs.
    pub climb: InterpolationError,
}

/// The bytes of the vehicle's trim table.
///
/// # Errors
/// One line: what the vehicle file lacks to fly, or which node has no steady motion.
pub fn generate(vehicle: &Vehicle, envelope: &Envelope) -> Result<Vec<u8>, String> {
    let solver = HelixSolver::new(vehicle);
    let [dive, climb] = envelope.grids()?;
    let sides = [side_nodes(vehicle, &solver, &dive, 1.0)?, side_nodes(vehicle, &solver, &climb, -1.0)?];
    let header = Header::new(flight_vehicle(vehicle)?, dive, climb);
    let mut file = vec![0; MOST_BYTES];
    let written = write(&header, &sides[0], &sides[1], &mut file).map_err(|error| describe(&error))?;
    Ok(written.to_vec())
}

/// Why a table may not be flown, in one line.
#[must_use]
pub fn describe(error: &TableError) -> String {
    match error {
        TableError::Corrupt => "the table is damaged: its CRC does not fit".into(),
        TableError::NotATable => "not a trim table".into(),
        TableError::OtherVersion(version) => {
            format!("a trim table of version {version}; this program reads version {}", shared::table::VERSION)
        }
        TableError::Malformed => "the table's axes and nodes do not fit together".into(),
        TableError::OtherVehicle(hash) => format!("the table is for another vehicle, {hash:016x}; generate it anew"),
        TableError::NoRoom => format!("the table is larger than {MOST_BYTES} bytes"),
    }
}

/// Measures a table against exact trim, midway between all its nodes.
///
/// # Errors
/// One line if some midpoint has no steady motion.
pub fn measure(vehicle: &Vehicle, table: &TrimTable<'_>) -> Result<TableErrors, String> {
    let solver = HelixSolver::new(vehicle);
    let header = table.header();
    Ok(TableErrors {
        dive: side_error(vehicle, &solver, table, &header.dive, 1.0)?,
        climb: side_error(vehicle, &solver, table, &header.climb, -1.0)?,
    })
}

impl Envelope {
    fn grids(&self) -> Result<[Grid; 2], String> {
        let pairs =
            [("dive", self.dive_deg, 90.0), ("climb", self.climb_deg, 90.0), ("net mass", self.net_mass_kg, f64::MAX)];
        for (name, [least, most], limit) in pairs {
            if !(least > 0.0 && most > least && most < limit) {
                return Err(format!("envelope: {name} {least} to {most} must be positive and rising"));
            }
        }
        if !(self.mu_deg > 0.0 && self.mu_deg <= 90.0) {
            return Err(format!("envelope: mu {}° must lie between 0 and 90°", self.mu_deg));
        }
        let axis = |first: f64, last: f64, count: u8| Axis { first: first as f32, last: last as f32, count };
        let [least, most] = self.net_mass_kg.map(f64::sqrt);
        let reach = libm::sin(self.mu_deg.to_radians());
        let grid = |path_angle_rad: Axis| Grid {
            path_angle_rad,
            root_net_mass: axis(least, most, NODES[1]),
            sin_mu: axis(-reach, reach, NODES[2]),
            full_scale: [0.0; QUANTITIES],
        };
        let [flat, steep] = self.dive_deg.map(f64::to_radians);
        let [low, high] = self.climb_deg.map(f64::to_radians);
        Ok([grid(axis(-steep, -flat, NODES[0])), grid(axis(low, high, NODES[0]))])
    }
}

/// What the controller must know of the vehicle.
///
/// # Errors
/// One line: which section the vehicle file lacks to fly.
pub fn flight_vehicle(vehicle: &Vehicle) -> Result<FlightVehicle, String> {
    let lacks = |section: &str| format!("{}: flying needs the section [{section}]", vehicle.name);
    let buoyancy = vehicle.buoyancy.as_ref().ok_or_else(|| lacks("buoyancy"))?;
    let limits = vehicle.limits.as_ref().ok_or_else(|| lacks("limits"))?;
    let (mass, hydro, water) = (&vehicle.moving_mass, &vehicle.hydrodynamics, &vehicle.water);
    let integer = |value: f64| value.round() as i32;
    let range = |[min, max]: [f64; 2], scale: f64| Range { min: integer(min * scale), max: integer(max * scale) };
    let (um, ul, cdeg, mm) = (1e6, 1e9, 100.0, 1e3);
    let q_s = 0.5 * water.density_kg_m3 * hydro.area_m2;
    Ok(FlightVehicle {
        hash: vehicle.hash(),
        name: vehicle.name.as_str().try_into().map_err(|_| format!("name {:?}: at most 32 bytes", vehicle.name))?,
        density_kg_m3: water.density_kg_m3 as f32,
        gravity_m_s2: water.gravity_m_s2 as f32,
        actuators: Actuators {
            r_px_um: range(mass.travel_m, um),
            mu_cdeg: range(mass.roll_deg, cdeg),
            vbd_ul: range(buoyancy.volume_m3, ul),
            r_px_rate_um_s: integer(mass.rate_m_s * um),
            mu_rate_cdeg_s: integer(mass.roll_rate_deg_s * cdeg),
            pump_rate_ul_s: integer(buoyancy.pump_rate_m3_s * ul),
            bleed_rate_ul_s: integer(buoyancy.bleed_rate_m3_s * ul),
        },
        working_depth_mm: integer(limits.working_depth_m * mm),
        glide: GlideConstants {
            mass_u_kg: (vehicle.mass_kg() + vehicle.added_mass.mass_kg.m11) as f32,
            mass_w_kg: (vehicle.mass_kg() + vehicle.added_mass.mass_kg.m33) as f32,
            drag_zero: (q_s * hydro.c_d_zero) as f32,
            drag_induced: (hydro.c_d_induced / q_s) as f32,
            lift_zero: (q_s * hydro.c_l_zero) as f32,
            lift_alpha: (q_s * hydro.c_l_alpha) as f32,
        },
    })
}

/// Nodes of one side in the order of the file. `sign`: of the net mass.
fn side_nodes(vehicle: &Vehicle, solver: &HelixSolver, grid: &Grid, sign: f64) -> Result<Vec<Node>, String> {
    let mut nodes = Vec::with_capacity(grid.nodes());
    for i in 0..grid.path_angle_rad.count {
        for j in 0..grid.root_net_mass.count {
            let root = f64::from(grid.root_net_mass.at(j));
            let path_angle_rad = f64::from(grid.path_angle_rad.at(i));
            let level = level_helix(vehicle, solver, path_angle_rad, sign * root * root)?;
            let slightly_turned = turned_helix(solver, &level, path_angle_rad, SMALL_SIN_MU)?;
            for k in 0..grid.sin_mu.count {
                let sin_mu = f64::from(grid.sin_mu.at(k));
                let turned = turned_helix(solver, &level, path_angle_rad, sin_mu)?;
                let (over, turned_for_slope) =
                    if sin_mu.abs() < SMALL_SIN_MU { (SMALL_SIN_MU, &slightly_turned) } else { (sin_mu, &turned) };
                nodes.push(Node {
                    r_px_m: turned.r_px_m as f32,
                    speed_factor: (turned.speed_m_s / root) as f32,
                    alpha_rad: turned.alpha_rad as f32,
                    roll_rad: turned.roll_rad as f32,
                    turn_factor: ((turned_for_slope.turn_rate_rad_s - level.turn_rate_rad_s) / (root * over)) as f32,
                    turn_bias: (level.turn_rate_rad_s / root) as f32,
                });
            }
        }
    }
    Ok(nodes)
}

/// The motion with the mass hanging straight down: wings level, if the vehicle is symmetric.
fn level_helix(
    vehicle: &Vehicle,
    solver: &HelixSolver,
    path_angle_rad: f64,
    net_mass_kg: f64,
) -> Result<Helix, String> {
    let level = wings_level(vehicle, Condition::PathAngle(path_angle_rad), Scale::NetMass(net_mass_kg))?;
    solver.solve(&Helix::from(&level), Slope::PathAngle(path_angle_rad), Turn::Mu(0.0))
}

/// Follows the helix from `level` to a rotation of the mass in steps that Newton's method takes easily.
fn turned_helix(solver: &HelixSolver, level: &Helix, path_angle_rad: f64, sin_mu: f64) -> Result<Helix, String> {
    const STEPS: u32 = 4;
    let mut helix = *level;
    for step in 1..=STEPS {
        let sine = sin_mu * f64::from(step) / f64::from(STEPS);
        helix = solver.solve(&helix, Slope::PathAngle(path_angle_rad), Turn::Mu(libm::asin(sine)))?;
    }
    Ok(helix)
}

fn side_error(
    vehicle: &Vehicle,
    solver: &HelixSolver,
    table: &TrimTable<'_>,
    grid: &Grid,
    sign: f64,
) -> Result<InterpolationError, String> {
    let mut worst = InterpolationError::default();
    let between = |axis: &Axis, cell: u8| 0.5 * f64::from(axis.at(cell) + axis.at(cell + 1));
    for i in 0..grid.path_angle_rad.count - 1 {
        let path_angle_rad = between(&grid.path_angle_rad, i);
        for j in 0..grid.root_net_mass.count - 1 {
            let root = between(&grid.root_net_mass, j);
            let net_mass_kg = sign * root * root;
            let level = level_helix(vehicle, solver, path_angle_rad, net_mass_kg)?;
            for k in 0..grid.sin_mu.count - 1 {
                let exact = turned_helix(solver, &level, path_angle_rad, between(&grid.sin_mu, k))?;
                let found = table.look_up(path_angle_rad as f32, net_mass_kg as f32, exact.mu_rad as f32);
                let grow = |worst: &mut f64, error: f64| *worst = worst.max(error.abs());
                grow(&mut worst.speed, f64::from(found.speed_m_s) / exact.speed_m_s - 1.0);
                grow(&mut worst.turn_rate, f64::from(found.turn_rate_rad_s) / exact.turn_rate_rad_s - 1.0);
                grow(&mut worst.alpha_rad, f64::from(found.alpha_rad) - exact.alpha_rad);
                grow(&mut worst.r_px_m, f64::from(found.r_px_m) - exact.r_px_m);
            }
        }
    }
    Ok(worst)
}
