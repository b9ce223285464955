//! A table's file: header, nodes, CRC.

use serde::{Deserialize, Serialize};

use super::{Grid, Node, QUANTITIES, TrimTable};
use crate::checksum::crc32;
use crate::math;
use crate::model::vehicle::FlightVehicle;

/// Version of the file format.
pub const VERSION: u16 = 4;
/// What a stored value goes up to.
pub(super) const FULL_SCALE: f32 = 32_767.0;

/// The first bytes of every table.
const MAGIC: [u8; 4] = *b"GTRM";
const CRC_BYTES: usize = 4;

/// What stands in front of the nodes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    magic: [u8; 4],
    version: u16,
    /// The vehicle that the table was generated for.
    pub vehicle: FlightVehicle,
    /// Whether its left mirrors its right, so that only `mu` ≥ 0 is stored.
    pub symmetric: bool,
    /// Path angle < 0, net mass > 0.
    pub dive: Grid,
    /// Path angle > 0, net mass < 0.
    pub climb: Grid,
}

impl Header {
    /// Describes a table about to be written.
    #[must_use]
    pub const fn new(vehicle: FlightVehicle, symmetric: bool, dive: Grid, climb: Grid) -> Self {
        Self { magic: MAGIC, version: VERSION, vehicle, symmetric, dive, climb }
    }
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

impl<'a> TrimTable<'a> {
    /// Reads a table from the bytes of its file.
    ///
    /// # Errors
    /// Anything but a whole, undamaged table of this version.
    pub fn parse(file: &'a [u8]) -> Result<Self, TableError> {
        let (content, crc) = file.split_last_chunk::<CRC_BYTES>().ok_or(TableError::NotATable)?;
        if content.first_chunk() != Some(&MAGIC) {
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
