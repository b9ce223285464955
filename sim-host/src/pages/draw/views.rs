//! The three views: outlines to scale, what is inside, labels and dimensions.

use super::{
    pen::{Anchor, Pen, Point, minus, px, spread, width_px},
    shape::Shape,
};

/// Radius of the marks for centres and the moving mass, px.
const MARK_PX: f64 = 6.5;
/// Size of label text, px.
const LABEL_PX: f64 = 13.0;
/// Room between two labels of a row, px.
const LABEL_GAP_PX: f64 = 22.0;

/// Where a view's origin stands on the sheet, and its scale.
pub(super) struct View {
    pub(super) origin: Point,
    pub(super) px_per_m: f64,
}

impl View {
    /// A place right of and below the origin, m.
    fn at(&self, right_m: f64, down_m: f64) -> Point {
        self.origin + Point::new(right_m, down_m) * self.px_per_m
    }
}

/// The top view; the span's dimension stands at `dimension_x`.
pub(super) fn top(pen: &mut Pen, shape: &Shape, view: &View, dimension_x: f64) {
    let at = |x: f64, y: f64| view.at(x, y);
    let (lead, trail) = (shape.quarter_chord_m + 0.25 * shape.chord_m, shape.quarter_chord_m - 0.75 * shape.chord_m);
    let (half, aft) = (shape.span_m / 2.0, shape.tip_aft_m);
    let wing = [
        at(lead - aft, -half),
        at(lead, 0.0),
        at(lead - aft, half),
        at(trail - aft, half),
        at(trail, 0.0),
        at(trail - aft, -half),
    ];
    pen.polygon("surface", &wing);
    pen.path("hull", shape.hull_path(at, view.px_per_m));
    let fin_lead = shape.fin_quarter_chord_m + 0.25 * shape.fin_chord_m;
    let half_fin = (0.5 * shape.fin_thickness_m).max(0.5 / view.px_per_m);
    pen.polygon(
        "surface",
        &[
            at(fin_lead, -half_fin),
            at(fin_lead, half_fin),
            at(fin_lead - shape.fin_chord_m, half_fin),
            at(fin_lead - shape.fin_chord_m, -half_fin),
        ],
    );
    centre_line(pen, view, shape);
    inside(pen, shape, view, 1);
    for tip in [-half, half] {
        pen.line(
            "extension",
            at(trail - aft, tip) - Point::new(6.0, 0.0),
            Point::new(dimension_x - 6.0, at(0.0, tip).y),
        );
    }
    pen.dimension(
        Point::new(dimension_x, at(0.0, half).y),
        Point::new(dimension_x, at(0.0, -half).y),
        &format!("span {:.3} m", shape.span_m),
    );
    // Clear of the leading edge, 32 px in from the tip.
    let beside = wing[0] + Point::new(10.0 + 32.0 * (aft / half).max(0.0), 0.0);
    pen.text("size", beside + Point::new(0.0, 12.0), Anchor::Start, &format!("chord {:.3} m", shape.chord_m));
    let place = if shape.quarter_chord_m > 0.0 { "ahead" } else { "aft" };
    let words = format!("quarter chord {:.3} m {place}", shape.quarter_chord_m.abs());
    pen.text("size", beside + Point::new(0.0, 28.0), Anchor::Start, &words);
    axes(pen, view.at(shape.hull_length_m / 2.0, half) - Point::new(50.0, 46.0), [("b₁", 1.0, 0.0), ("b₂", 0.0, 1.0)]);
    pen.text("caption", Point::new(at(0.0, 0.0).x, at(0.0, half).y + 26.0), Anchor::Middle, "TOP");
}

/// The side view; labels stay within `bounds`.
pub(super) fn side(pen: &mut Pen, shape: &Shape, view: &View, bounds: [f64; 2]) {
    let at = |x: f64, z: f64| view.at(x, z);
    let fin_lead = shape.fin_quarter_chord_m + 0.25 * shape.fin_chord_m;
    let (fin_top, fin_bottom) = (-shape.fin_up_m - shape.fin_span_m / 2.0, -shape.fin_up_m + shape.fin_span_m / 2.0);
    let fin_trail = fin_lead - shape.fin_chord_m;
    pen.polygon(
        "surface",
        &[at(fin_lead, fin_top), at(fin_lead, fin_bottom), at(fin_trail, fin_bottom), at(fin_trail, fin_top)],
    );
    pen.path("hull", shape.hull_path(at, view.px_per_m));
    wing_section(pen, shape, view);
    centre_line(pen, view, shape);
    inside(pen, shape, view, 2);
    side_labels(pen, shape, view, bounds);

    let half = shape.hull_length_m / 2.0;
    let y = at(0.0, shape.below_m).y + 62.0;
    for end in [-half, half] {
        pen.line("extension", at(end, 0.0), Point::new(at(end, 0.0).x, y + 6.0));
    }
    pen.dimension(
        Point::new(at(-half, 0.0).x, y),
        Point::new(at(half, 0.0).x, y),
        &format!("hull {:.3} m", shape.hull_length_m),
    );
    pen.text("caption", Point::new(at(0.0, 0.0).x, y + 22.0), Anchor::Middle, "SIDE");
}

/// The front view, seen from ahead: the vehicle's right is on the left.
pub(super) fn front(pen: &mut Pen, shape: &Shape, view: &View) {
    let at = |right: f64, down: f64| view.at(-right, down);
    let half = shape.span_m / 2.0;
    let thick = (0.5 * shape.wing_thickness_m).max(0.75 / view.px_per_m);
    for side in [-1.0, 1.0] {
        let (root, tip) = (-shape.wing_up_m, -shape.tip_up_m);
        pen.polygon(
            "surface",
            &[at(0.0, root - thick), at(side * half, tip - thick), at(side * half, tip + thick), at(0.0, root + thick)],
        );
    }
    let half_fin = (0.5 * shape.fin_thickness_m).max(0.75 / view.px_per_m);
    let fin = [-shape.fin_up_m - shape.fin_span_m / 2.0, -shape.fin_up_m + shape.fin_span_m / 2.0];
    pen.polygon("surface", &[at(-half_fin, fin[0]), at(half_fin, fin[0]), at(half_fin, fin[1]), at(-half_fin, fin[1])]);
    pen.circle("hull", view.origin, 0.5 * shape.diameter_m * view.px_per_m);
    let roll = shape.roll_rad.map(|mu| at(-shape.particle_radius_m * mu.sin(), shape.particle_radius_m * mu.cos()));
    let radius = px(shape.particle_radius_m * view.px_per_m);
    pen.path(
        "travel",
        format!("M{} {}A{radius} {radius} 0 0 0 {} {}", px(roll[0].x), px(roll[0].y), px(roll[1].x), px(roll[1].y)),
    );
    mark_buoyancy(pen, view.origin);
    pen.centre_of_mass(at(shape.centre_of_mass_m[1], shape.centre_of_mass_m[2]), MARK_PX);
    pen.circle("particle", at(shape.particle_m[1], shape.particle_m[2]), MARK_PX);

    let [low, high] = shape.roll_rad.map(f64::to_degrees);
    let words = minus(format!("rotation {low:+.0}° to {high:+.0}°, left positive"));
    let below = view.at(0.0, shape.below_m);
    pen.text("label", below + Point::new(0.0, 34.0), Anchor::Middle, &words);
    pen.line(
        "leader",
        view.at(0.0, shape.particle_radius_m) + Point::new(0.0, MARK_PX + 3.0),
        below + Point::new(0.0, 20.0),
    );
    let above = Point::new(view.origin.x, view.at(0.0, -shape.above_m).y - 22.0);
    let reach = 0.5 * shape.diameter_m * view.px_per_m;
    for side in [-reach, reach] {
        pen.line("extension", view.origin + Point::new(side, -4.0), Point::new(view.origin.x + side, above.y - 6.0));
    }
    let size = format!("diameter {:.3} m", shape.diameter_m);
    pen.dimension(above - Point::new(reach, 0.0), above + Point::new(reach, 0.0), &size);
    axes(pen, view.at(half, 0.0) + Point::new(-6.0, 34.0), [("b₂", -1.0, 0.0), ("b₃", 0.0, 1.0)]);
    pen.text("caption", Point::new(view.origin.x, view.at(0.0, shape.below_m).y + 84.0), Anchor::Middle, "FRONT");
}

/// What is inside the hull, seen from above (`down` = 1, the body's right axis) or from the side (2, the down axis).
fn inside(pen: &mut Pen, shape: &Shape, view: &View, down: usize) {
    if let Some(engine) = &shape.engine {
        let corner = view.at(engine.position_m - engine.length_m / 2.0, -engine.bore_m / 2.0);
        pen.rectangle("engine", corner, Point::new(engine.length_m, engine.bore_m) * view.px_per_m);
    }
    let [from, to] = shape.travel_m.map(|x| view.at(x, shape.particle_m[down]));
    pen.line("travel", from, to);
    for end in [from, to] {
        pen.line("travel", end - Point::new(0.0, 5.0), end + Point::new(0.0, 5.0));
    }
    mark_buoyancy(pen, view.origin);
    pen.centre_of_mass(view.at(shape.centre_of_mass_m[0], shape.centre_of_mass_m[down]), MARK_PX);
    pen.circle("particle", view.at(shape.particle_m[0], shape.particle_m[down]), MARK_PX);
}

fn mark_buoyancy(pen: &mut Pen, at: Point) {
    pen.circle("buoyancy", at, MARK_PX);
    pen.circle("buoyancy-dot", at, 2.0);
}

fn wing_section(pen: &mut Pen, shape: &Shape, view: &View) {
    let middle = view.at(shape.quarter_chord_m - 0.25 * shape.chord_m, -shape.wing_up_m);
    let half = Point::new(0.5 * shape.chord_m, (0.5 * shape.wing_thickness_m).max(1.2 / view.px_per_m)) * view.px_per_m;
    let (rx, ry) = (px(half.x), px(half.y));
    let (left, right) = (px(middle.x - half.x), px(middle.x + half.x));
    let y = px(middle.y);
    pen.path("surface", format!("M{left} {y}A{rx} {ry} 0 0 1 {right} {y}A{rx} {ry} 0 0 1 {left} {y}Z"));
}

fn centre_line(pen: &mut Pen, view: &View, shape: &Shape) {
    let reach = Point::new(14.0, 0.0);
    pen.line("axis", view.at(-shape.aft_m, 0.0) - reach, view.at(shape.hull_length_m / 2.0, 0.0) + reach);
}

/// Labels above and below the side view, on leaders that never cross.
fn side_labels(pen: &mut Pen, shape: &Shape, view: &View, bounds: [f64; 2]) {
    let mass = &shape.centre_of_mass_m;
    let mut above = vec![(view.origin, "centre of buoyancy".to_owned())];
    if let Some(engine) = &shape.engine {
        let words = minus(format!("buoyancy engine {:+.2} to {:+.2} L", engine.litres[0], engine.litres[1]));
        above.push((view.at(engine.position_m, -engine.bore_m / 2.0), words));
    }
    let section = view.at(shape.quarter_chord_m - 0.6 * shape.chord_m, -shape.wing_up_m);
    above.push((section, format!("wing, t/c {:.2}", shape.wing_thickness_m / shape.chord_m)));
    let fin = view.at(shape.fin_quarter_chord_m - 0.25 * shape.fin_chord_m, -shape.fin_up_m - 0.4 * shape.fin_span_m);
    above.push((fin, format!("fin {:.2} × {:.2} m", shape.fin_span_m, shape.fin_chord_m)));
    let [least, most] = shape.travel_m;
    let below = vec![
        (view.at(mass[0], mass[2]), minus(format!("centre of mass {:+.3}, {:+.3} m", mass[0], mass[2]))),
        (
            view.at(shape.particle_m[0], shape.particle_m[2]),
            minus(format!("moving mass {} kg at {:+.3} m", shape.particle_kg, shape.particle_m[0])),
        ),
        (view.at(least, shape.particle_m[2]), minus(format!("travel {least:+.2} to {most:+.2} m"))),
    ];
    row(pen, &above, view.at(0.0, -shape.above_m).y - 26.0, -1.0, bounds);
    row(pen, &below, view.at(0.0, shape.below_m).y + 34.0, 1.0, bounds);
}

/// One row of labels at `y`; `side` is −1 above what they point at, +1 below.
fn row(pen: &mut Pen, labels: &[(Point, String)], y: f64, side: f64, bounds: [f64; 2]) {
    let middles: Vec<_> = labels.iter().map(|(target, _)| target.x).collect();
    let widths: Vec<_> = labels.iter().map(|(_, words)| width_px(words, LABEL_PX) + LABEL_GAP_PX).collect();
    for ((target, words), x) in labels.iter().zip(spread(&middles, &widths, bounds)) {
        let foot = Point::new(x, y - side * if side < 0.0 { 5.0 } else { 13.0 });
        let gap = (foot - target).normalize() * (MARK_PX + 1.0);
        pen.line("leader", target + gap, foot);
        pen.text("label", Point::new(x, y), Anchor::Middle, words);
    }
}

/// Two body axes, named.
fn axes(pen: &mut Pen, at: Point, directions: [(&str, f64, f64); 2]) {
    for (name, x, y) in directions {
        let tip = at + Point::new(x, y) * 28.0;
        pen.arrow("b-axis", at, tip);
        pen.text("size", tip + Point::new(x * 11.0, y * 12.0 + 4.0), Anchor::Middle, name);
    }
}
