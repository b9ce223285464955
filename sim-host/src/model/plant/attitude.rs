//! Attitude: unit quaternions inside, 3-2-1 Euler angles towards people.

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::model::real::Real;

/// R_IB: rotation from body to inertial axes of a unit quaternion (w, x, y, z).
#[must_use]
pub fn rotation_from_quaternion<T: Real>(quaternion: &Vector4<T>) -> Matrix3<T> {
    let [w, x, y, z] = [quaternion[0], quaternion[1], quaternion[2], quaternion[3]];
    let (one, two) = (T::constant(1.0), T::constant(2.0));
    Matrix3::new(
        one - two * (y * y + z * z),
        two * (x * y - w * z),
        two * (x * z + w * y),
        two * (x * y + w * z),
        one - two * (x * x + z * z),
        two * (y * z - w * x),
        two * (x * z - w * y),
        two * (y * z + w * x),
        one - two * (x * x + y * y),
    )
}

/// Quaternion of roll, pitch, heading, rad.
#[must_use]
pub fn quaternion_from_euler<T: Real>(euler_rad: &Vector3<T>) -> Vector4<T> {
    let half = euler_rad.map(|angle| angle * T::constant(0.5));
    let (sf, cf) = (half.x.sin(), half.x.cos());
    let (st, ct) = (half.y.sin(), half.y.cos());
    let (sp, cp) = (half.z.sin(), half.z.cos());
    Vector4::new(
        cf * ct * cp + sf * st * sp,
        sf * ct * cp - cf * st * sp,
        cf * st * cp + sf * ct * sp,
        cf * ct * sp - sf * st * cp,
    )
}

/// Roll, pitch, heading, rad; pitch within ±π/2, the others within ±π.
#[must_use]
pub fn euler_from_quaternion<T: Real>(quaternion: &Vector4<T>) -> Vector3<T> {
    let r = rotation_from_quaternion(quaternion);
    let cos_pitch = T::hypot(r.m11, r.m21);
    Vector3::new(r.m32.atan2(r.m33), (-r.m31).atan2(cos_pitch), r.m21.atan2(r.m11))
}

/// Rate of the quaternion under a body rate: ½ q ⊗ (0, ω).
pub(super) fn quaternion_rate<T: Real>(quaternion: &Vector4<T>, rate_rad_s: &Vector3<T>) -> Vector4<T> {
    let [w, x, y, z] = [quaternion[0], quaternion[1], quaternion[2], quaternion[3]];
    let (p, q, r) = (rate_rad_s.x, rate_rad_s.y, rate_rad_s.z);
    Vector4::new(-x * p - y * q - z * r, w * p + y * r - z * q, w * q + z * p - x * r, w * r + x * q - y * p)
        * T::constant(0.5)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn euler_angles_survive_the_way_through_the_quaternion() {
        for euler in [[0.3, -0.6, 2.9], [-3.0, 1.5, -3.1], [0.0, 0.0, 0.0]] {
            let euler = Vector3::from(euler);
            let back = euler_from_quaternion(&quaternion_from_euler(&euler));
            assert!((back - euler).norm() < 1e-14, "{euler} came back as {back}");
        }
    }

    #[test]
    fn heading_turns_the_nose_from_north_to_east_and_pitch_lifts_it() {
        let east =
            rotation_from_quaternion(&quaternion_from_euler(&Vector3::new(0.0, 0.0, std::f64::consts::FRAC_PI_2)));
        assert!((east * Vector3::x() - Vector3::y()).norm() < 1e-15);
        let up = rotation_from_quaternion(&quaternion_from_euler(&Vector3::new(0.0, 0.5, 0.0)));
        assert!((up * Vector3::x()).z < 0.0);
    }
}
