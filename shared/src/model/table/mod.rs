//! The trim table: steady glides and turns of one vehicle, generated from its plant.
//!
//! ```text
//! postcard(Header) | nodes: i16 LE | CRC-32: u32 LE
//! ```
//!
//! Each side (dive, climb) is a grid over axes on which steady flight is smooth: √|path angle|, ⁴√|net mass|, `mu`.
//! A node holds [`QUANTITIES`] values, quantised to 16 bits; `mu` runs fastest, then net mass, then path angle.
//! Speed and turn rate grow with √|net mass|, so a node stores them divided by it.
//!
//! A vehicle whose left mirrors its right needs only `mu` ≥ 0; its header says so. The generator chooses as many nodes as
//! it takes to keep the interpolation within 0.5 % of speed, 0.2° of pitch and 2 % of turn rate.

mod file;
mod grid;

pub use file::{Header, TableError, VERSION, write};
pub use grid::{Axis, Grid};

use crate::device::RAD_PER_CDEG;
use crate::math;
use crate::model::vehicle::{FlightVehicle, Range};

/// Values stored in a node, in the order of [`Node`]'s fields.
pub const QUANTITIES: usize = 7;

const VALUE_BYTES: usize = 2;
const NODE_BYTES: usize = QUANTITIES * VALUE_BYTES;

/// One steady motion as a node stores it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// Axial position of the moving mass, m.
    pub r_px_m: f32,
    /// Speed over √|net mass|, m/s/√kg.
    pub speed_factor: f32,
    /// Angle of attack, rad.
    pub alpha_rad: f32,
    /// Pitch beyond the path angle, rad: the angle of attack, with the wings level.
    pub incidence_rad: f32,
    /// Roll, rad.
    pub roll_rad: f32,
    /// Turn rate beyond `turn_bias` over (√|net mass| sin `mu`), rad/s/√kg; its sign is the vehicle's sense of turn.
    pub turn_factor: f32,
    /// Turn rate at `mu` = 0 over √|net mass|, rad/s/√kg; 0 for a symmetric vehicle.
    pub turn_bias: f32,
}

impl Node {
    const fn to_array(self) -> [f32; QUANTITIES] {
        [
            self.r_px_m,
            self.speed_factor,
            self.alpha_rad,
            self.incidence_rad,
            self.roll_rad,
            self.turn_factor,
            self.turn_bias,
        ]
    }

    const fn from_array(values: [f32; QUANTITIES]) -> Self {
        let [r_px_m, speed_factor, alpha_rad, incidence_rad, roll_rad, turn_factor, turn_bias] = values;
        Self { r_px_m, speed_factor, alpha_rad, incidence_rad, roll_rad, turn_factor, turn_bias }
    }

    /// The same motion of a symmetric vehicle with left and right exchanged; its turn rate changes sign with sin `mu`.
    const fn mirrored(self) -> Self {
        Self { roll_rad: -self.roll_rad, turn_bias: -self.turn_bias, ..self }
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
    /// Pitch, rad.
    pub pitch_rad: f32,
    /// Roll, rad.
    pub roll_rad: f32,
    /// Vertical speed, m/s, down positive.
    pub sink_rate_m_s: f32,
    /// Turn rate, rad/s, right positive.
    pub turn_rate_rad_s: f32,
    /// Whether what was asked lay outside the table, so that this is its nearest edge.
    pub saturated: bool,
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

impl TrimTable<'_> {
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
        self.header.dive.envelope(1.0)
    }

    /// What climbs it covers.
    #[must_use]
    pub fn climb_envelope(&self) -> Envelope {
        self.header.climb.envelope(-1.0)
    }

    /// The steady motion at one path angle, net mass and rotation of the mass.
    ///
    /// The sign of the path angle chooses the side; the net mass counts by its size.
    #[must_use]
    pub fn look_up(&self, path_angle_rad: f32, net_mass_kg: f32, mu_rad: f32) -> Glide {
        let root = math::sqrt(math::abs(net_mass_kg));
        let (node, saturated) = self.interpolate(path_angle_rad, net_mass_kg, mu_rad);
        let speed_m_s = node.speed_factor * root;
        Glide {
            r_px_m: node.r_px_m,
            speed_m_s,
            alpha_rad: node.alpha_rad,
            pitch_rad: path_angle_rad + node.incidence_rad,
            roll_rad: node.roll_rad,
            sink_rate_m_s: -speed_m_s * math::sin(path_angle_rad),
            turn_rate_rad_s: root * (node.turn_bias + node.turn_factor * math::sin(mu_rad)),
            saturated,
        }
    }

    /// The largest rotation of the mass, to either side, that the vehicle reaches and both sides of the table cover, rad.
    #[must_use]
    pub fn mu_limit_rad(&self) -> f32 {
        let Range { min, max } = self.vehicle().actuators.mu_cdeg;
        let vehicle_rad = max.min(min.saturating_neg()) as f32 * RAD_PER_CDEG;
        let covered_rad = math::clamp(self.header.dive.mu_rad.last, 0.0, self.header.climb.mu_rad.last);
        math::clamp(vehicle_rad, 0.0, covered_rad)
    }

    /// The rotation of the mass that turns at `turn_rate_rad_s`, held to ±`limit_rad` and to what the table covers, rad.
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
        let reach = self.side(path_angle_rad).0.mu_rad.last;
        let limit = math::clamp(math::clamp(limit_rad, 0.0, reach), 0.0, math::FRAC_PI_2);
        let mut mu_rad = math::clamp(near_mu_rad, -limit, limit);
        for _ in 0..2 {
            let (node, _) = self.interpolate(path_angle_rad, net_mass_kg, mu_rad);
            let wanted = (turn_rate_rad_s / root - node.turn_bias) / node.turn_factor;
            mu_rad = math::clamp(math::asin(math::finite_or(wanted, 0.0)), -limit, limit);
        }
        mu_rad
    }

    /// Dives or climbs, by the sign of the path angle.
    const fn side(&self, path_angle_rad: f32) -> (&Grid, &[u8]) {
        if path_angle_rad < 0.0 { (&self.header.dive, self.dive_nodes) } else { (&self.header.climb, self.climb_nodes) }
    }

    fn interpolate(&self, path_angle_rad: f32, net_mass_kg: f32, mu_rad: f32) -> (Node, bool) {
        let (grid, nodes) = self.side(path_angle_rad);
        let mirrored = self.header.symmetric && mu_rad < 0.0;
        let (i, x, x_outside) = grid.root_path_angle.find(math::sqrt(math::abs(path_angle_rad)));
        let (j, y, y_outside) = grid.fourth_root_net_mass.find(math::sqrt(math::sqrt(math::abs(net_mass_kg))));
        let (k, z, z_outside) = grid.mu_rad.find(if mirrored { -mu_rad } else { mu_rad });
        let mut sums = [0.0; QUANTITIES];
        for (a, x) in [(0, 1.0 - x), (1, x)] {
            for (b, y) in [(0, 1.0 - y), (1, y)] {
                for (c, z) in [(0, 1.0 - z), (1, z)] {
                    let place = grid.place(i.saturating_add(a), j.saturating_add(b), k.saturating_add(c));
                    add_node(&mut sums, nodes, place, x * y * z);
                }
            }
        }
        for (sum, scale) in sums.iter_mut().zip(grid.full_scale) {
            *sum *= scale / file::FULL_SCALE;
        }
        let node = Node::from_array(sums);
        (if mirrored { node.mirrored() } else { node }, x_outside || y_outside || z_outside)
    }
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

#[cfg(test)]
pub(crate) mod tests;
