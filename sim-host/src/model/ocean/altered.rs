//! The same ocean, a little different: what a campaign draws.

use super::{Ocean, current::Current};

impl Ocean {
    /// Here the vehicle was made neutral for water of this density, kg/m³.
    #[must_use]
    pub fn with_ballast_density(self, density_kg_m3: f64) -> Self {
        Self { ballast_density_kg_m3: Some(density_kg_m3), ..self }
    }

    /// A steady current on top of all others, the same at every depth: north and east, m/s.
    #[must_use]
    pub fn carried_along(self, north_east_m_s: [f64; 2]) -> Self {
        let current = self.current.unwrap_or_else(|| Current::new(vec![[0.0; 3]]));
        Self { current: Some(current.carried_along(north_east_m_s)), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::vehicle::Vehicle;
    use nalgebra::Vector3;

    #[test]
    fn a_current_adds_to_the_others_at_every_depth() {
        let water = Vehicle::load("slocum-paper").unwrap().water;
        let text = "[current]\nprofile = [[0, 0.1, 0.2], [100, 0, 0]]";
        let sheared = Ocean::from_toml(text, "test", &water).unwrap();
        for ocean in [Ocean::still(&water), sheared] {
            let carried = ocean.clone().carried_along([0.3, -0.4]);
            for depth_m in [0.0, 40.0, 500.0] {
                let at = |ocean: &Ocean| ocean.sample(&Vector3::new(0.0, 0.0, depth_m), 7.0).around.current_m_s;
                let added = at(&carried) - at(&ocean);
                assert!((added - Vector3::new(0.3, -0.4, 0.0)).amax() < 1e-15, "{depth_m} m: {added}");
            }
        }
    }

    #[test]
    fn the_ballast_is_the_pilots_word_not_the_columns() {
        let water = Vehicle::load("slocum-paper").unwrap().water;
        let ocean = Ocean::load("temperate", &water).unwrap();
        assert_eq!(ocean.with_ballast_density(1_026.5).ballast_density_kg_m3(100.0), 1_026.5);
    }
}
