//! Places on the Earth, as a way north and east of an origin on a sphere.

use crate::device::{GpsFix, MM_PER_M, RAD_PER_CDEG};
use crate::math;

/// Metres per 1e-7° of latitude, on a sphere of 6371 km.
const M_PER_E7: f32 = 0.011_119_493;
/// Micrometres per millimetre.
const UM_PER_MM: i64 = 1_000;

/// How far north and east of the origin a place lies, µm.
pub(super) fn from_origin_um(origin: &GpsFix, place: &GpsFix) -> (i64, i64) {
    let north_e7 = place.lat_e7.wrapping_sub(origin.lat_e7);
    let east_e7 = wrap_e7(i64::from(place.lon_e7).saturating_sub(i64::from(origin.lon_e7)));
    let m_per_e7_east = M_PER_E7 * math::cos(origin.lat_e7 as f32 * (RAD_PER_CDEG * 1e-5));
    let um = |e7: f32, m_per_e7: f32| i64::from(math::round_to_i32(e7 * m_per_e7 * MM_PER_M)).saturating_mul(UM_PER_MM);
    (um(north_e7 as f32, M_PER_E7), um(east_e7 as f32, m_per_e7_east))
}

/// Micrometres as millimetres, held to what an `i32` reaches.
pub(super) fn saturated_mm(um: i64) -> i32 {
    let mm = um / UM_PER_MM;
    i32::try_from(mm).unwrap_or(if mm < 0 { i32::MIN } else { i32::MAX })
}

/// A difference of longitudes, 1e-7°, the short way round: across the date line too.
const fn wrap_e7(difference: i64) -> i64 {
    const TURN: i64 = 3_600_000_000;
    difference.wrapping_add(TURN / 2).rem_euclid(TURN).wrapping_sub(TURN / 2)
}
