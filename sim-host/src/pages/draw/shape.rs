//! What is drawn of a vehicle: its outline and what is inside.

use super::{
    DrawnGlide,
    pen::{Point, px},
};
use crate::model::vehicle::Vehicle;

/// Diameter of the buoyancy engine's cylinder over the hull's.
const ENGINE_BORE: f64 = 0.55;
/// A vehicle's outline and what is drawn inside it, m from the centre of buoyancy in body axes.
pub(super) struct Shape {
    pub(super) hull_length_m: f64,
    pub(super) diameter_m: f64,
    pub(super) span_m: f64,
    pub(super) chord_m: f64,
    pub(super) wing_thickness_m: f64,
    pub(super) quarter_chord_m: f64,
    pub(super) tip_aft_m: f64,
    pub(super) tip_up_m: f64,
    pub(super) wing_up_m: f64,
    pub(super) fin_span_m: f64,
    pub(super) fin_chord_m: f64,
    pub(super) fin_thickness_m: f64,
    pub(super) fin_quarter_chord_m: f64,
    pub(super) fin_up_m: f64,
    pub(super) centre_of_mass_m: [f64; 3],
    pub(super) particle_m: [f64; 3],
    pub(super) particle_radius_m: f64,
    pub(super) particle_kg: f64,
    pub(super) travel_m: [f64; 2],
    pub(super) roll_rad: [f64; 2],
    pub(super) engine: Option<Engine>,
    /// Extents from the centre of buoyancy.
    pub(super) aft_m: f64,
    pub(super) above_m: f64,
    pub(super) below_m: f64,
}

pub(super) struct Engine {
    pub(super) position_m: f64,
    pub(super) length_m: f64,
    pub(super) bore_m: f64,
    pub(super) litres: [f64; 2],
}

impl Shape {
    pub(super) fn new(vehicle: &Vehicle, glide: &DrawnGlide) -> Self {
        let (hull, wing, fin, mass) = (&vehicle.hull, &vehicle.wing, &vehicle.fin, &vehicle.moving_mass);
        let diameter_m = hull.diameter_m();
        let (half_span_m, chord_m) = (wing.span_m(hull) / 2.0, wing.chord_m(hull));
        let quarter_chord_m = -wing.position * hull.length_m;
        let tip_aft_m = half_span_m * wing.sweep_deg.to_radians().tan();
        let (sin_mu, cos_mu) = glide.mu_rad.sin_cos();
        let particle_m = [glide.r_px_m, -mass.radius_m * sin_mu, mass.radius_m * cos_mu];
        let body_m = vehicle.body.centre_of_mass_m;
        let total = vehicle.mass_kg();
        let mean = |axis: usize| (vehicle.body.mass_kg * body_m[axis] + mass.mass_kg * particle_m[axis]) / total;
        let bore_m = ENGINE_BORE * diameter_m;
        let engine = vehicle.buoyancy.as_ref().map(|engine| {
            let [least, most] = engine.volume_m3;
            let length_m = (most - least) / (std::f64::consts::PI * bore_m * bore_m / 4.0);
            Engine { position_m: engine.position_m, length_m, bore_m, litres: [1e3 * least, 1e3 * most] }
        });
        let fin_quarter_chord_m = -fin.position * hull.length_m;
        let (fin_span_m, fin_chord_m) = (fin.span_m(hull), fin.chord_m(hull));
        let half_fin_m = fin_span_m / 2.0;
        Self {
            hull_length_m: hull.length_m,
            diameter_m,
            span_m: 2.0 * half_span_m,
            chord_m,
            wing_thickness_m: wing.thickness_ratio * chord_m,
            quarter_chord_m,
            tip_aft_m,
            tip_up_m: wing.height_m + half_span_m * wing.dihedral_deg.to_radians().tan(),
            wing_up_m: wing.height_m,
            fin_span_m,
            fin_chord_m,
            fin_thickness_m: fin.thickness_ratio * fin_chord_m,
            fin_quarter_chord_m,
            fin_up_m: fin.height_m,
            centre_of_mass_m: [mean(0), mean(1), mean(2)],
            particle_m,
            particle_radius_m: mass.radius_m,
            particle_kg: mass.mass_kg,
            travel_m: mass.travel_m,
            roll_rad: mass.roll_deg.map(f64::to_radians),
            engine,
            aft_m: [
                hull.length_m / 2.0,
                0.75 * fin_chord_m - fin_quarter_chord_m,
                0.75 * chord_m + tip_aft_m - quarter_chord_m,
            ]
            .into_iter()
            .fold(0.0, f64::max),
            above_m: (diameter_m / 2.0).max(fin.height_m + half_fin_m),
            below_m: (diameter_m / 2.0).max(half_fin_m - fin.height_m),
        }
    }

    pub(super) fn length_m(&self) -> f64 {
        self.aft_m + self.hull_length_m / 2.0
    }

    pub(super) fn height_m(&self) -> f64 {
        self.above_m + self.below_m
    }

    /// Half the hull's outline along its axis, as seen from any side: (x, half width).
    pub(super) fn hull_path(&self, at: impl Fn(f64, f64) -> Point, px_per_m: f64) -> String {
        let (half, radius) = (self.hull_length_m / 2.0, self.diameter_m / 2.0);
        let cap = self.diameter_m.min(half);
        let (rx, ry) = (px(cap * px_per_m), px(radius * px_per_m));
        let turn = at(1.0, 0.0) - at(0.0, 0.0);
        let turn = px(turn.y.atan2(turn.x).to_degrees());
        let point = |x: f64, y: f64| {
            let place = at(x, y);
            format!("{} {}", px(place.x), px(place.y))
        };
        format!(
            "M{} L{} A{rx} {ry} {turn} 0 1 {} A{rx} {ry} {turn} 0 1 {} L{} A{rx} {ry} {turn} 0 1 {} A{rx} {ry} {turn} 0 1 {} Z",
            point(cap - half, -radius),
            point(half - cap, -radius),
            point(half, 0.0),
            point(half - cap, radius),
            point(cap - half, radius),
            point(-half, 0.0),
            point(cap - half, -radius),
        )
    }
}
