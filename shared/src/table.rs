//! The trim table: steady glides and turns of one vehicle, generated from its plant.
//!
//! ```text
//! postcard(Header) | nodes: i16 LE | CRC-32: u32 LE
//! ```
//!
//! Each side (dive, climb) is a grid over axes on which steady flight is smooth: path angle, √|net mass|, sin `mu`.
//! A node holds [`QUANTITIES`] values, quantised to 16 bits; `mu` runs fastest, then net mass, then path angle.
//! Speed and turn rate grow with √|net mass|, so a node stores them divided by it.

use serde::{Deserialize, Serialize};

use crate::{
    device::RAD_PER_CDEG,
    math,
    vehicle::{FlightVehicle, Range},
    wire::crc32,
};

/// Version of the file format.
pub const VERSION: u16 = 1;
/// Values stored in a node, in the order of [`Node`]'s fields.
pub const QUANTITIES: usize = 6;

const MAGIC: u32 = u32::from_le_bytes(*b"GTRM");
const CRC_BYTES: usize = 4;
const VALUE_BYTES: usize = 2;
const NODE_BYTES: usize = QUANTITIES * VALUE_BYTES;
const FULL_SCALE: f32 = 32_767.0;
const GRAMS_PER_KG: f32 = 1_000.0;

/// A uniform axis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// Value at the first node.
    pub first: f32,
    /// Value at the last node.
    pub last: f32,
    /// Number of nodes, at least 2.
    pub count: u8,
}

impl Axis {
    /// Value at one node.
    #[must_use]
    pub fn at(&self, node: u8) -> f32 {
        let last = self.count.saturating_sub(1);
        self.first + (self.last - self.first) * f32::from(node) / f32::from(last)
    }

    /// The cell that holds `value`, the place in it (0 to 1), and whether `value` lay outside the axis.
    fn find(&self, value: f32) -> (usize, f32, bool) {
        let cells = f32::from(self.count.saturating_sub(1));
        let place = (value - self.first) / (self.last - self.first) * cells;
        let inside = math::clamp(place, 0.0, cells);
        // In range by the line above, so the cast truncates to the cell's number.
        let cell = math::clamp(inside, 0.0, cells - 1.0) as u8;
        // The inexact edges of a measured value are no reason to say that it lies outside.
        let outside = math::abs(place - inside) > 1e-3;
        (usize::from(cell), inside - f32::from(cell), outside || !place.is_finite())
    }

    fn is_sound(&self) -> bool {
        self.count >= 2 && self.first.is_finite() && self.last.is_finite() && self.last > self.first
    }
}

/// One side of the table: dives or climbs.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Path angle, rad.
    pub path_angle_rad: Axis,
    /// Square root of |net mass|, √kg.
    pub root_net_mass: Axis,
    /// Sine of the mass's rotation.
    pub sin_mu: Axis,
    /// What a stored ±32767 stands for, per quantity.
    pub full_scale: [f32; QUANTITIES],
}

impl Grid {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        [self.path_angle_rad, self.root_net_mass, self.sin_mu]
            .iter()
            .fold(1, |product, axis| usize::from(axis.count).saturating_mul(product))
    }

    fn bytes(&self) -> usize {
        self.nodes().saturating_mul(NODE_BYTES)
    }

    fn is_sound(&self) -> bool {
        self.path_angle_rad.is_sound()
            && self.root_net_mass.is_sound()
            && self.root_net_mass.first > 0.0
            && self.sin_mu.is_sound()
            && self.full_scale.iter().all(|scale| scale.is_finite())
    }
}

/// What stands in front of the nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    magic: u32,
    version: u16,
    /// The vehicle that the table was generated for.
    pub vehicle: FlightVehicle,
    /// Path angle < 0, net mass > 0.
    pub dive: Grid,
    /// Path angle > 0, net mass < 0.
    pub climb: Grid,
}

impl Header {
    /// Describes a table about to be written.
    #[must_use]
    pub const fn new(vehicle: FlightVehicle, dive: Grid, climb: Grid) -> Self {
        Self { magic: MAGIC, version: VERSION, vehicle, dive, climb }
    }
}

/// One steady motion as a node stores it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// Axial position of the moving mass, m.
    pub r_px_m: f32,
    /// Speed over √|net mass|, m/s/√kg.
    pub speed_factor: f32,
    /// Angle of attack, rad.
    pub alpha_rad: f32,
    /// Roll, rad.
    pub roll_rad: f32,
    /// Turn rate beyond `turn_bias` over (√|net mass| sin `mu`), rad/s/√kg; its sign is the vehicle's sense of turn.
    pub turn_factor: f32,
    /// Turn rate at `mu` = 0 over √|net mass|, rad/s/√kg; 0 for a symmetric vehicle.
    pub turn_bias: f32,
}

impl Node {
    const fn to_array(self) -> [f32; QUANTITIES] {
        [self.r_px_m, self.speed_factor, self.alpha_rad, self.roll_rad, self.turn_factor, self.turn_bias]
    }

    const fn from_array(values: [f32; QUANTITIES]) -> Self {
        let [r_px_m, speed_factor, alpha_rad, roll_rad, turn_factor, turn_bias] = values;
        Self { r_px_m, speed_factor, alpha_rad, roll_rad, turn_factor, turn_bias }
    }
}

/// A steady glide or turn, looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Glide {
    /// Axial position of the moving mass that holds it, m.
    pub r_px_m: f32,
    /// Speed through the water, m/s.
    pub speed_m_s: f32,
    /// Angle of attack, rad.
    pub alpha_rad: f32,
    /// Roll, rad.
    pub roll_rad: f32,
    /// Vertical speed, m/s, down positive.
    pub sink_rate_m_s: f32,
    /// Turn rate, rad/s, right positive.
    pub turn_rate_rad_s: f32,
    /// Whether what was asked lay outside the table, so that this is its nearest edge.
    pub saturated: bool,
}

/// Why bytes are not a table that may be flown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub enum TableError {
    /// The bytes do not add up to their CRC.
    Corrupt,
    /// The bytes are no trim table.
    NotATable,
    /// A table of another format version.
    OtherVersion(u16),
    /// Fewer or more nodes than the axes ask for, or an axis that is none.
    Malformed,
    /// The table was generated for the vehicle with this fingerprint.
    OtherVehicle(u64),
    /// The buffer that the table should be written to is too small.
    NoRoom,
}

/// What a table covers, on one side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Envelope {
    /// Path angles, 0.01°.
    pub path_angle_cdeg: Range,
    /// Net masses, g.
    pub net_mass_g: Range,
}

/// A trim table over the bytes of its file.
#[derive(Clone, Debug)]
pub struct TrimTable<'a> {
    header: Header,
    dive_nodes: &'a [u8],
    climb_nodes: &'a [u8],
}

impl<'a> TrimTable<'a> {
    /// Reads a table from the bytes of its file.
    ///
    /// # Errors
    /// Anything but a whole, undamaged table of this version.
    pub fn parse(file: &'a [u8]) -> Result<Self, TableError> {
        let (content, crc) = file.split_last_chunk::<CRC_BYTES>().ok_or(TableError::NotATable)?;
        if content.first_chunk() != Some(&MAGIC_VARINT) {
            return Err(TableError::NotATable);
        }
        if crc32(content) != u32::from_le_bytes(*crc) {
            return Err(TableError::Corrupt);
        }
        let (header, nodes) = postcard::take_from_bytes::<Header>(content).map_err(|_| TableError::NotATable)?;
        if header.version != VERSION {
            return Err(TableError::OtherVersion(header.version));
        }
        if !header.dive.is_sound() || !header.climb.is_sound() {
            return Err(TableError::Malformed);
        }
        let (dive_nodes, climb_nodes) = nodes.split_at_checked(header.dive.bytes()).ok_or(TableError::Malformed)?;
        if climb_nodes.len() != header.climb.bytes() {
            return Err(TableError::Malformed);
        }
        Ok(Self { header, dive_nodes, climb_nodes })
    }

    /// Refuses a table of another vehicle.
    ///
    /// # Errors
    /// [`TableError::OtherVehicle`] with the fingerprint of the vehicle that it is for.
    pub fn for_vehicle(self, hash: u64) -> Result<Self, TableError> {
        if self.header.vehicle.hash == hash {
            Ok(self)
        } else {
            Err(TableError::OtherVehicle(self.header.vehicle.hash))
        }
    }

    /// The vehicle that the table is for.
    #[must_use]
    pub const fn vehicle(&self) -> &FlightVehicle {
        &self.header.vehicle
    }

    /// Axes and scales.
    #[must_use]
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// What dives it covers.
    #[must_use]
    pub fn dive_envelope(&self) -> Envelope {
        envelope(&self.header.dive, 1.0)
    }

    /// What climbs it covers.
    #[must_use]
    pub fn climb_envelope(&self) -> Envelope {
        envelope(&self.header.climb, -1.0)
    }

    /// The steady motion at one path angle, net mass and rotation of the mass.
    ///
    /// The sign of the path angle chooses the side; the net mass counts by its size.
    #[must_use]
    pub fn look_up(&self, path_angle_rad: f32, net_mass_kg: f32, mu_rad: f32) -> Glide {
        let root = math::sqrt(math::abs(net_mass_kg));
        let sin_mu = math::sin(mu_rad);
        let (node, saturated) = self.interpolate(path_angle_rad, root, sin_mu);
        let speed_m_s = node.speed_factor * root;
        Glide {
            r_px_m: node.r_px_m,
            speed_m_s,
            alpha_rad: node.alpha_rad,
            roll_rad: node.roll_rad,
            sink_rate_m_s: -speed_m_s * math::sin(path_angle_rad),
            turn_rate_rad_s: root * (node.turn_bias + node.turn_factor * sin_mu),
            saturated,
        }
    }

    /// The rotation of the mass that turns at `turn_rate_rad_s`, held to ±`limit_rad`, rad.
    ///
    /// `near_mu_rad` is where the mass is now: authority depends a little on the rotation itself.
    #[must_use]
    pub fn mu_for_turn(
        &self,
        path_angle_rad: f32,
        net_mass_kg: f32,
        turn_rate_rad_s: f32,
        near_mu_rad: f32,
        limit_rad: f32,
    ) -> f32 {
        let root = math::sqrt(math::abs(net_mass_kg));
        let limit = math::sin(math::clamp(limit_rad, 0.0, math::FRAC_PI_2));
        let mut sin_mu = math::clamp(math::sin(near_mu_rad), -limit, limit);
        for _ in 0..2 {
            let (node, _) = self.interpolate(path_angle_rad, root, sin_mu);
            let wanted = (turn_rate_rad_s / root - node.turn_bias) / node.turn_factor;
            sin_mu = math::clamp(math::finite_or(wanted, 0.0), -limit, limit);
        }
        math::asin(sin_mu)
    }

    fn interpolate(&self, path_angle_rad: f32, root_net_mass: f32, sin_mu: f32) -> (Node, bool) {
        let (grid, nodes) = if path_angle_rad < 0.0 {
            (&self.header.dive, self.dive_nodes)
        } else {
            (&self.header.climb, self.climb_nodes)
        };
        let (i, x, x_outside) = grid.path_angle_rad.find(path_angle_rad);
        let (j, y, y_outside) = grid.root_net_mass.find(root_net_mass);
        let (k, z, z_outside) = grid.sin_mu.find(sin_mu);
        let mut sums = [0.0; QUANTITIES];
        for (a, x) in [(0, 1.0 - x), (1, x)] {
            for (b, y) in [(0, 1.0 - y), (1, y)] {
                for (c, z) in [(0, 1.0 - z), (1, z)] {
                    let place = place(grid, i.saturating_add(a), j.saturating_add(b), k.saturating_add(c));
                    add_node(&mut sums, nodes, place, x * y * z);
                }
            }
        }
        for (sum, scale) in sums.iter_mut().zip(grid.full_scale) {
            *sum *= scale / FULL_SCALE;
        }
        (Node::from_array(sums), x_outside || y_outside || z_outside)
    }
}

/// The first bytes of every table: the magic number as postcard writes it.
const MAGIC_VARINT: [u8; 4] = {
    let m = MAGIC;
    [
        (m & 0x7f) as u8 | 0x80,
        (m >> 7 & 0x7f) as u8 | 0x80,
        (m >> 14 & 0x7f) as u8 | 0x80,
        (m >> 21 & 0x7f) as u8 | 0x80,
    ]
};

/// Number of a node in its grid.
fn place(grid: &Grid, i: usize, j: usize, k: usize) -> usize {
    i.saturating_mul(usize::from(grid.root_net_mass.count))
        .saturating_add(j)
        .saturating_mul(usize::from(grid.sin_mu.count))
        .saturating_add(k)
}

/// Adds one node's stored values, weighted. A place outside the grid, which `parse` rules out, adds nothing.
fn add_node(sums: &mut [f32; QUANTITIES], nodes: &[u8], place: usize, weight: f32) {
    let start = place.saturating_mul(NODE_BYTES);
    let Some(node) = nodes.get(start..).and_then(|rest| rest.first_chunk::<NODE_BYTES>()) else { return };
    let (values, _) = node.as_chunks::<VALUE_BYTES>();
    for (sum, value) in sums.iter_mut().zip(values) {
        *sum += weight * f32::from(i16::from_le_bytes(*value));
    }
}

/// The axes in integers, rounded inwards; `sign` is that of the side's net mass.
fn envelope(grid: &Grid, sign: f32) -> Envelope {
    let inwards =
        |low: f32, high: f32| Range { min: math::round_to_i32(low + 0.49), max: math::round_to_i32(high - 0.49) };
    let gamma = grid.path_angle_rad;
    let mass = grid.root_net_mass;
    let edges = [mass.first, mass.last].map(|root| sign * root * root * GRAMS_PER_KG);
    let [near, far] = edges;
    // An edge that was meant to be whole may come out a rounding error short.
    let slack = 0.01;
    Envelope {
        path_angle_cdeg: inwards(gamma.first / RAD_PER_CDEG - slack, gamma.last / RAD_PER_CDEG + slack),
        net_mass_g: if sign > 0.0 { inwards(near - slack, far + slack) } else { inwards(far - slack, near + slack) },
    }
}

/// Writes a table's file and returns it. `dive` and `climb` are in the order of the file.
///
/// # Errors
/// [`TableError::NoRoom`] if `file` is too short, [`TableError::Malformed`] if the nodes are not as many as the axes ask for.
pub fn write<'f>(header: &Header, dive: &[Node], climb: &[Node], file: &'f mut [u8]) -> Result<&'f [u8], TableError> {
    let header = Header {
        dive: Grid { full_scale: full_scale(dive), ..header.dive },
        climb: Grid { full_scale: full_scale(climb), ..header.climb },
        ..header.clone()
    };
    if dive.len() != header.dive.nodes() || climb.len() != header.climb.nodes() {
        return Err(TableError::Malformed);
    }
    let mut used = postcard::to_slice(&header, file).map_err(|_| TableError::NoRoom)?.len();
    for (nodes, scales) in [(dive, header.dive.full_scale), (climb, header.climb.full_scale)] {
        for (value, scale) in nodes.iter().flat_map(|node| node.to_array().into_iter().zip(scales)) {
            let stored = if scale > 0.0 { math::round_to_i32(value / scale * FULL_SCALE) } else { 0 };
            // |value| ≤ scale, so it fits.
            used = append(file, used, &(stored as i16).to_le_bytes())?;
        }
    }
    let crc = crc32(file.get(..used).ok_or(TableError::NoRoom)?);
    used = append(file, used, &crc.to_le_bytes())?;
    file.get(..used).ok_or(TableError::NoRoom)
}

fn append(file: &mut [u8], used: usize, bytes: &[u8]) -> Result<usize, TableError> {
    let end = used.saturating_add(bytes.len());
    file.get_mut(used..end).ok_or(TableError::NoRoom)?.copy_from_slice(bytes);
    Ok(end)
}

/// The largest size of each quantity.
fn full_scale(nodes: &[Node]) -> [f32; QUANTITIES] {
    let mut scales = [0.0; QUANTITIES];
    for node in nodes {
        for (scale, value) in scales.iter_mut().zip(node.to_array()) {
            let size = math::abs(value);
            if size > *scale {
                *scale = size;
            }
        }
    }
    scales
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::vehicle::{Actuators, GlideConstants};
    use std::vec::Vec;

    fn vehicle() -> FlightVehicle {
        FlightVehicle {
            hash: 42,
            name: "test".try_into().unwrap(),
            density_kg_m3: 1000.0,
            gravity_m_s2: 9.81,
            actuators: Actuators {
                r_px_um: Range { min: -350_000, max: 350_000 },
                mu_cdeg: Range { min: -6_000, max: 6_000 },
                vbd_ul: Range { min: -300_000, max: 300_000 },
                r_px_rate_um_s: 10_000,
                mu_rate_cdeg_s: 1_500,
                pump_rate_ul_s: 42_000,
                bleed_rate_ul_s: 42_000,
            },
            working_depth_mm: 200_000,
            glide: GlideConstants {
                mass_u_kg: 55.0,
                mass_w_kg: 120.0,
                drag_zero: 2.0,
                drag_induced: 45.0 / (135.0 * 135.0),
                lift_zero: 0.0,
                lift_alpha: 135.0,
            },
        }
    }

    /// A made-up vehicle whose nodes are linear in the axes, so that interpolation must be exact but for quantisation.
    /// It turns right with `mu` < 0 on dives and `mu` > 0 on climbs, like the paper's.
    pub(crate) fn file() -> Vec<u8> {
        let grid = |low: f32, high: f32| Grid {
            path_angle_rad: Axis { first: low, last: high, count: 5 },
            root_net_mass: Axis { first: 0.2, last: 0.8, count: 3 },
            sin_mu: Axis { first: -0.9, last: 0.9, count: 3 },
            full_scale: [0.0; QUANTITIES],
        };
        let (dive, climb) = (grid(-0.6, -0.2), grid(0.2, 0.7));
        let nodes = |grid: &Grid| {
            let mut nodes = Vec::new();
            for i in 0..grid.path_angle_rad.count {
                for _ in 0..grid.root_net_mass.count {
                    for k in 0..grid.sin_mu.count {
                        nodes.push(node(grid.path_angle_rad.at(i), grid.sin_mu.at(k)));
                    }
                }
            }
            nodes
        };
        let mut bytes = std::vec![0; 4096];
        let header = Header::new(vehicle(), dive, climb);
        let used = write(&header, &nodes(&dive), &nodes(&climb), &mut bytes).unwrap().len();
        bytes.truncate(used);
        bytes
    }

    fn node(path_angle_rad: f32, sin_mu: f32) -> Node {
        Node {
            r_px_m: -0.42 * path_angle_rad,
            speed_factor: 1.0 + 0.8 * math::abs(path_angle_rad),
            alpha_rad: -0.03 * path_angle_rad.signum(),
            roll_rad: 0.2 * sin_mu * path_angle_rad.signum(),
            turn_factor: 0.03 * path_angle_rad.signum(),
            turn_bias: 0.0,
        }
    }

    #[test]
    fn a_written_table_reads_back_within_its_quantisation() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        for (gamma, mass, mu) in [(-0.45_f32, 0.25_f32, 0.3_f32), (-0.2, 0.6, -0.8), (0.33, -0.1, 0.5)] {
            let glide = table.look_up(gamma, mass, mu);
            let exact = node(gamma, mu.sin());
            let root = mass.abs().sqrt();
            assert!((glide.r_px_m - exact.r_px_m).abs() < 1e-5);
            assert!((glide.speed_m_s - exact.speed_factor * root).abs() < 5e-5);
            assert!((glide.turn_rate_rad_s - exact.turn_factor * root * mu.sin()).abs() < 1e-6);
            assert!(!glide.saturated);
        }
    }

    #[test]
    fn outside_the_envelope_it_saturates_and_says_so() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let beyond = table.look_up(-1.2, 0.25, 0.0);
        assert!(beyond.saturated);
        assert_eq!(beyond.r_px_m, table.look_up(-0.6, 0.25, 0.0).r_px_m);
    }

    #[test]
    fn the_rotation_for_a_turn_gives_that_turn_with_the_vehicles_own_sense() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        for gamma in [-0.4, 0.4] {
            let mu = table.mu_for_turn(gamma, 0.25, 0.005, 0.0, 1.0);
            assert!((table.look_up(gamma, 0.25, mu).turn_rate_rad_s - 0.005).abs() < 1e-6);
            assert_eq!(mu > 0.0, gamma > 0.0);
        }
        assert!((table.mu_for_turn(-0.4, 0.25, 1.0, 0.0, 0.7) + 0.7).abs() < 1e-5, "held to the limit");
    }

    #[test]
    fn damaged_truncated_foreign_and_older_tables_are_refused() {
        let good = file();
        for place in 4..good.len() {
            let mut bad = good.clone();
            bad[place] ^= 0x20;
            assert_eq!(TrimTable::parse(&bad).unwrap_err(), TableError::Corrupt, "byte {place}");
        }
        assert_eq!(TrimTable::parse(&good[..good.len() - 12]).unwrap_err(), TableError::Corrupt);
        assert_eq!(TrimTable::parse(b"hello, table").unwrap_err(), TableError::NotATable);
        let table = TrimTable::parse(&good).unwrap();
        assert_eq!(table.for_vehicle(7).unwrap_err(), TableError::OtherVehicle(42));
    }

    #[test]
    fn the_envelope_is_told_in_device_units() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        assert_eq!(table.dive_envelope().net_mass_g, Range { min: 40, max: 640 });
        assert_eq!(table.climb_envelope().net_mass_g, Range { min: -640, max: -40 });
        assert_eq!(table.dive_envelope().path_angle_cdeg, Range { min: -3_437, max: -1_146 });
    }
}
