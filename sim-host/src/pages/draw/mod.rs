//! A vehicle on one sheet: a three-view to scale, and the forces of a steady glide (Figs 1–4 of Fan & Woolsey).
//!
//! Third-angle projection, nose to the right: top view above the side view, front view to its right. The hull is drawn as
//! a cylinder whose ends are half ellipsoids one diameter long; its middle is the centre of buoyancy.

mod forces;
mod pen;
mod shape;
mod views;

use svg::{
    Document,
    node::element::{Rectangle, Style},
};

use crate::analysis::trim::Glide;
use crate::model::vehicle::Vehicle;
use pen::{Anchor, Pen, Point};
use shape::Shape;

/// Width of the sheet, px.
const SHEET_PX: f64 = 1200.0;
/// Free margin around the sheet, px.
const MARGIN_PX: f64 = 36.0;
/// Height of the title, px.
const TITLE_PX: f64 = 56.0;
/// Room left of the top and side views for upright dimensions, px.
const LEFT_PX: f64 = 40.0;
/// Room between the columns, px.
const GAP_PX: f64 = 70.0;
/// Room above and below the side view for its labels, px.
const LABELS_PX: f64 = 54.0;
/// Height of scale bar and notes at the foot, px.
const FOOT_PX: f64 = 84.0;

/// A steady glide, as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DrawnGlide {
    /// γ, rad, climbing positive.
    pub path_angle_rad: f64,
    /// α, rad.
    pub alpha_rad: f64,
    /// V, m/s.
    pub speed_m_s: f64,
    /// L, N, towards the body's upper side positive.
    pub lift_n: f64,
    /// D, N.
    pub drag_n: f64,
    /// m̃g, N, sinking positive.
    pub net_weight_n: f64,
    /// Axial position of the moving mass, m.
    pub r_px_m: f64,
    /// Rotation of the moving mass, rad, positive to the left.
    pub mu_rad: f64,
}

impl DrawnGlide {
    /// A wings-level trim with its forces: L = m̃ g cosγ, D = −m̃ g sinγ.
    #[must_use]
    pub fn new(vehicle: &Vehicle, glide: &Glide) -> Self {
        let net_weight_n = glide.net_mass_kg * vehicle.water.gravity_m_s2;
        let (sin, cos) = glide.path_angle_rad.sin_cos();
        Self {
            path_angle_rad: glide.path_angle_rad,
            alpha_rad: glide.alpha_rad,
            speed_m_s: glide.speed_m_s,
            lift_n: net_weight_n * cos,
            drag_n: -net_weight_n * sin,
            net_weight_n,
            r_px_m: glide.r_px_m,
            mu_rad: glide.mu_rad,
        }
    }
}

/// Draws the sheet as an SVG document, 1200 px wide, text as text.
#[must_use]
pub fn sheet(vehicle: &Vehicle, glide: &DrawnGlide) -> String {
    let shape = Shape::new(vehicle, glide);
    let column_m = [shape.length_m(), shape.span_m];
    let px_per_m = (SHEET_PX - 2.0 * MARGIN_PX - LEFT_PX - GAP_PX) / (column_m[0] + column_m[1]);
    let top_row = MARGIN_PX + TITLE_PX;
    let side_row = top_row + shape.span_m * px_per_m + LABELS_PX + 20.0;
    let height = side_row + shape.height_m() * px_per_m + LABELS_PX + 30.0 + FOOT_PX;
    let left = MARGIN_PX + LEFT_PX;
    let right = left + column_m[0] * px_per_m + GAP_PX;
    let origin_x = left + shape.aft_m * px_per_m;
    let origin_z = side_row + shape.above_m * px_per_m;

    let mut pen = Pen::new();
    pen.text("title", Point::new(MARGIN_PX, MARGIN_PX + 18.0), Anchor::Start, &vehicle.name);
    let view = |x: f64, y: f64| views::View { origin: Point::new(x, y), px_per_m };
    let half_span_px = shape.span_m * px_per_m / 2.0;
    views::top(&mut pen, &shape, &view(origin_x, top_row + half_span_px), left - 22.0);
    views::side(&mut pen, &shape, &view(origin_x, origin_z), [MARGIN_PX, right - 20.0]);
    views::front(&mut pen, &shape, &view(right + half_span_px, origin_z));
    let panel = [Point::new(right, top_row - 10.0), Point::new(2.0 * half_span_px, 2.0 * half_span_px + 20.0)];
    forces::panel(&mut pen, &shape, glide, panel);
    foot(&mut pen, vehicle, px_per_m, height);

    Document::new()
        .set("viewBox", format!("0 0 {SHEET_PX} {}", height.round()))
        .set("class", "glider-sheet")
        .set("role", "img")
        .set("aria-label", format!("Three-view of {} and the forces of a steady glide", vehicle.name))
        .add(Style::new(include_str!("sheet.css")))
        .add(Rectangle::new().set("width", "100%").set("height", "100%").set("class", "paper"))
        .add(pen.into_group())
        .to_string()
}

/// Scale bar, masses and what the drawing assumes.
fn foot(pen: &mut Pen, vehicle: &Vehicle, px_per_m: f64, height: f64) {
    let y = height - FOOT_PX + 30.0;
    let bar = Point::new(MARGIN_PX, y);
    pen.rectangle("scale-dark", bar, Point::new(0.25 * px_per_m, 5.0));
    pen.rectangle("scale-light", bar + Point::new(0.25 * px_per_m, 0.0), Point::new(0.25 * px_per_m, 5.0));
    for (metres, words) in [(0.0, "0"), (0.25, "0.25"), (0.5, "0.5 m")] {
        pen.text("size", bar + Point::new(metres * px_per_m, 20.0), Anchor::Middle, words);
    }
    let body = &vehicle.body;
    let masses = format!(
        "mass {} kg = body {} + moving {} + ballast {} kg · neutral in {} kg/m³ at {:.2} L",
        vehicle.mass_kg(),
        body.mass_kg,
        vehicle.moving_mass.mass_kg,
        body.ballast_kg,
        vehicle.water.density_kg_m3,
        1e3 * vehicle.neutral_volume_m3()
    );
    let text = Point::new(MARGIN_PX + 0.5 * px_per_m + 60.0, y + 3.0);
    pen.text("note", text, Anchor::Start, &masses);
    let assumed = "To scale. Hull drawn as a cylinder with half-ellipsoid ends, one diameter long; its middle is the centre of buoyancy.";
    pen.text("note faint", text + Point::new(0.0, 19.0), Anchor::Start, assumed);
}
