//! Where places scatter: their mean, their covariance, and the ellipse that holds a share of them.

use nalgebra::{Matrix2, SymmetricEigen, Vector2};
use serde::Serialize;

use crate::flight::NorthEast;

/// Fewest places that say anything about a scatter in two directions.
const LEAST_PLACES: usize = 3;
/// Corners of a drawn ellipse.
const CORNERS: u32 = 96;

/// Places on a plane, as a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scatter {
    /// Their mean.
    pub mean: NorthEast,
    /// [[north north, north east], [east north, east east]], m².
    pub covariance_m2: [[f64; 2]; 2],
}

/// The smallest ellipse that holds a share of a normal distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Ellipse {
    /// The share, 0 to 1.
    pub share: f64,
    /// Its centre.
    #[serde(skip)]
    centre: NorthEast,
    /// The longer and the shorter semi-axis, m.
    pub semi_axes_m: [f64; 2],
    /// Direction of the longer one, rad clockwise from north, 0 to below π.
    pub bearing_rad: f64,
}

impl Scatter {
    /// Of some places; nothing of fewer than three, or if they stand on one line.
    #[must_use]
    pub fn of(places: &[NorthEast]) -> Option<Self> {
        if places.len() < LEAST_PLACES {
            return None;
        }
        let count = places.len() as f64;
        let mean = places.iter().map(vector).sum::<Vector2<f64>>() / count;
        let spread = |place: &NorthEast| (vector(place) - mean) * (vector(place) - mean).transpose();
        let covariance: Matrix2<f64> = places.iter().map(spread).sum::<Matrix2<f64>>() / (count - 1.0);
        covariance.cholesky()?;
        let rows = [[covariance.m11, covariance.m12], [covariance.m21, covariance.m22]];
        Some(Self { mean: NorthEast { north_m: mean.x, east_m: mean.y }, covariance_m2: rows })
    }

    /// The ellipse of a share below 1: the squared distance from the mean, in standard deviations, is distributed as χ² with
    /// two degrees of freedom, whose quantile is −2 ln(1 − share).
    #[must_use]
    pub fn ellipse(&self, share: f64) -> Ellipse {
        let SymmetricEigen { eigenvalues, eigenvectors } = Matrix2::from(self.covariance_m2).symmetric_eigen();
        let quantile = -2.0 * libm::log(1.0 - share);
        let (longer, shorter) = (eigenvalues.imax(), eigenvalues.imin());
        let direction = eigenvectors.column(longer);
        let turn = std::f64::consts::PI;
        Ellipse {
            share,
            centre: self.mean,
            semi_axes_m: [longer, shorter].map(|axis| (quantile * eigenvalues[axis]).sqrt()),
            bearing_rad: libm::atan2(direction.y, direction.x).rem_euclid(turn) % turn,
        }
    }
}

impl Ellipse {
    /// Whether a place lies in it.
    #[must_use]
    pub fn holds(&self, place: &NorthEast) -> bool {
        let (sin, cos) = libm::sincos(self.bearing_rad);
        let off = vector(place) - vector(&self.centre);
        let [along, across] = [off.x * cos + off.y * sin, off.y * cos - off.x * sin];
        let [longer, shorter] = self.semi_axes_m;
        (along / longer).powi(2) + (across / shorter).powi(2) <= 1.0
    }

    /// Its outline, counter-clockwise on a map, closed.
    pub fn outline(&self) -> impl Iterator<Item = NorthEast> {
        let (sin, cos) = libm::sincos(self.bearing_rad);
        let [longer, shorter] = self.semi_axes_m;
        (0..=CORNERS).map(move |corner| {
            let part = f64::from(corner % CORNERS) / f64::from(CORNERS);
            let (y, x) = libm::sincos(-std::f64::consts::TAU * part);
            let [along, across] = [longer * x, shorter * y];
            let [north, east] = [along * cos - across * sin, along * sin + across * cos];
            NorthEast { north_m: self.centre.north_m + north, east_m: self.centre.east_m + east }
        })
    }
}

fn vector(place: &NorthEast) -> Vector2<f64> {
    Vector2::new(place.north_m, place.east_m)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flight::NorthEast as Place;

    /// Standard deviations 3 m towards north-east and 1 m across: four places on the axes with that covariance exactly.
    fn slanted() -> Scatter {
        let root = 1.5_f64.sqrt();
        let at = |along: f64, across: f64| Place {
            north_m: 10.0 + root * (along - across) * 0.5_f64.sqrt(),
            east_m: -20.0 + root * (along + across) * 0.5_f64.sqrt(),
        };
        Scatter::of(&[at(3.0, 0.0), at(-3.0, 0.0), at(0.0, 1.0), at(0.0, -1.0)]).unwrap()
    }

    /// By the table of χ² with two degrees of freedom: 1.386 at 50 %, 4.605 at 90 %.
    #[test]
    fn its_axes_are_those_of_the_scatter() {
        for (share, quantile) in [(0.5, 1.386_f64), (0.9, 4.605)] {
            let ellipse = slanted().ellipse(share);
            let [longer, shorter] = ellipse.semi_axes_m;
            assert!((longer / quantile.sqrt() - 3.0).abs() < 1e-3 && (shorter / quantile.sqrt() - 1.0).abs() < 1e-3);
            assert!((ellipse.bearing_rad.to_degrees() - 45.0).abs() < 1e-9, "{ellipse:?}");
        }
    }

    #[test]
    fn what_is_inside_the_outline_is_held() {
        let ellipse = slanted().ellipse(0.9);
        let scaled = |by: f64, place: Place| Place {
            north_m: 10.0 + by * (place.north_m - 10.0),
            east_m: -20.0 + by * (place.east_m + 20.0),
        };
        let outline: Vec<Place> = ellipse.outline().collect();
        assert!(outline.iter().all(|place| ellipse.holds(&scaled(0.999, *place))));
        assert!(!outline.iter().any(|place| ellipse.holds(&scaled(1.001, *place))));
        assert_eq!(outline.first(), outline.last());
        // Twice the area by the shoelace formula, x east and y north: positive if counter-clockwise. The polygon of 96 corners
        // lacks 0.07 %.
        let twice: f64 = outline.windows(2).map(|p| p[0].east_m * p[1].north_m - p[1].east_m * p[0].north_m).sum();
        let [longer, shorter] = ellipse.semi_axes_m;
        assert!((twice / (std::f64::consts::TAU * longer * shorter) - 1.0).abs() < 1e-3, "{twice}");
    }

    #[test]
    fn places_on_a_line_or_too_few_have_no_ellipse() {
        let at = |north_m: f64| Place { north_m, east_m: 0.0 };
        assert_eq!(Scatter::of(&[at(0.0), at(1.0), at(2.0)]), None);
        assert_eq!(Scatter::of(&[at(0.0), Place { north_m: 1.0, east_m: 1.0 }]), None);
    }
}
