//! Axes and grids: on what steady motions are stored, and how they are interpolated.

use serde::{Deserialize, Serialize};

use super::{Envelope, NODE_BYTES, QUANTITIES};
use crate::device::RAD_PER_CDEG;
use crate::math;
use crate::model::vehicle::Range;

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
    pub(super) fn find(&self, value: f32) -> (usize, f32, bool) {
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
///
/// Steady flight is smooth in these coordinates: a flat path and a light vehicle, where it changes fastest, get the most nodes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Root of |path angle|, √rad.
    pub root_path_angle: Axis,
    /// Fourth root of |net mass|, kg^¼.
    pub fourth_root_net_mass: Axis,
    /// The mass's rotation, rad; from 0 on if the vehicle is symmetric.
    pub mu_rad: Axis,
    /// What a stored ±32767 stands for, per quantity.
    pub full_scale: [f32; QUANTITIES],
}

impl Grid {
    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        [self.root_path_angle, self.fourth_root_net_mass, self.mu_rad]
            .iter()
            .fold(1, |product, axis| usize::from(axis.count).saturating_mul(product))
    }

    pub(super) fn bytes(&self) -> usize {
        self.nodes().saturating_mul(NODE_BYTES)
    }

    pub(super) fn is_sound(&self) -> bool {
        self.root_path_angle.is_sound()
            && self.fourth_root_net_mass.is_sound()
            && self.mu_rad.is_sound()
            && self.full_scale.iter().all(|scale| scale.is_finite())
    }

    /// Number of a node.
    pub(super) fn place(&self, i: usize, j: usize, k: usize) -> usize {
        i.saturating_mul(usize::from(self.fourth_root_net_mass.count))
            .saturating_add(j)
            .saturating_mul(usize::from(self.mu_rad.count))
            .saturating_add(k)
    }

    /// The axes in integers, rounded inwards; `sign` is that of the side's net mass.
    pub(super) fn envelope(&self, sign: f32) -> Envelope {
        let cdeg = |root: f32| -sign * root * root / RAD_PER_CDEG;
        let grams = |root: f32| sign * root * root * root * root * GRAMS_PER_KG;
        let (path_angle, net_mass) = (self.root_path_angle, self.fourth_root_net_mass);
        Envelope {
            path_angle_cdeg: inwards(cdeg(path_angle.first), cdeg(path_angle.last)),
            net_mass_g: inwards(grams(net_mass.first), grams(net_mass.last)),
        }
    }
}

/// The whole numbers between two edges, given in any order.
fn inwards(one: f32, other: f32) -> Range {
    /// An edge that was meant to be whole may come out a rounding error short.
    const SLACK: f32 = 0.01;
    let (low, high) = if one < other { (one, other) } else { (other, one) };
    Range { min: math::round_to_i32(low + 0.5 - SLACK), max: math::round_to_i32(high - 0.5 + SLACK) }
}
