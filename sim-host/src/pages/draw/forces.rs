//! The forces of a steady glide, seen from the side (Figs 1–4 of Fan & Woolsey): north to the right, down is down.

use super::{
    DrawnGlide,
    pen::{Anchor, Pen, Point, minus, px},
    shape::Shape,
};

/// Length of the longest force, over the panel's width.
const LONGEST: f64 = 0.33;
/// Length of the hull over the panel's width.
const HULL: f64 = 0.5;
/// Length of the velocity over the panel's width.
const VELOCITY: f64 = 0.40;

/// Draws the panel into the box `[corner, size]`.
pub(super) fn panel(pen: &mut Pen, shape: &Shape, glide: &DrawnGlide, [corner, size]: [Point; 2]) {
    pen.rectangle("frame", corner, size);
    let climbs = glide.path_angle_rad > 0.0;
    let origin = corner + Point::new(0.43 * size.x, if climbs { 0.5 } else { 0.42 } * size.y);
    let pitch_rad = glide.path_angle_rad + glide.alpha_rad;
    pen.text("caption", corner + Point::new(16.0, 26.0), Anchor::Start, "STEADY GLIDE, SIDE");
    pen.line("horizon", origin - Point::new(0.34 * size.x, 0.0), origin + Point::new(0.5 * size.x, 0.0));
    body(pen, shape, origin, pitch_rad, HULL * size.x / shape.hull_length_m);

    let along = direction(glide.path_angle_rad);
    let velocity_tip = origin + along * (VELOCITY * size.x);
    pen.line("axis", origin, origin + direction(pitch_rad) * (VELOCITY * size.x + 34.0));
    pen.arrow("velocity", origin, velocity_tip);
    angles(pen, glide, origin, size.x);
    forces(pen, glide, origin, size.x);
    let beside = Point::new(8.0, if climbs { -8.0 } else { 18.0 });
    pen.text(
        "force",
        velocity_tip + beside - Point::new(44.0, 0.0),
        Anchor::Middle,
        &format!("V {:.3} m/s", glide.speed_m_s),
    );
    values(pen, glide, pitch_rad, corner + Point::new(16.0, size.y - 50.0), size.x - 32.0);
}

/// Hull and wing, pitched.
fn body(pen: &mut Pen, shape: &Shape, origin: Point, pitch_rad: f64, px_per_m: f64) {
    let forward = direction(pitch_rad);
    let down = Point::new(-forward.y, forward.x);
    pen.path("ghost", shape.hull_path(|x, z| origin + (forward * x + down * z) * px_per_m, px_per_m));
    pen.circle("buoyancy-dot", origin, 3.0);
}

/// γ to the path and α from the path to the body's axis.
fn angles(pen: &mut Pen, glide: &DrawnGlide, origin: Point, width: f64) {
    let pitch_rad = glide.path_angle_rad + glide.alpha_rad;
    let radius = 0.30 * width;
    arc(pen, origin, radius, 0.0, glide.path_angle_rad);
    let middle = direction(glide.path_angle_rad / 2.0);
    pen.text(
        "label",
        origin + middle * (radius + 8.0) + Point::new(0.0, 4.0),
        Anchor::Start,
        &degrees("γ", glide.path_angle_rad),
    );
    let radius = VELOCITY * width + 16.0;
    arc(pen, origin, radius, glide.path_angle_rad, pitch_rad);
    let end = origin + direction(pitch_rad.max(glide.path_angle_rad)) * (radius + 12.0);
    pen.text("label", end + Point::new(-4.0, -8.0), Anchor::Start, &degrees("α", glide.alpha_rad));
}

/// Lift, drag and net weight from the centre of buoyancy; lift and drag together hold the net weight.
fn forces(pen: &mut Pen, glide: &DrawnGlide, origin: Point, width: f64) {
    let longest = glide.lift_n.abs().max(glide.drag_n.abs()).max(glide.net_weight_n.abs());
    let px_per_n = if longest > 0.0 { LONGEST * width / longest } else { 0.0 };
    let along = direction(glide.path_angle_rad);
    let upper = Point::new(along.y, -along.x);
    let lift = origin + upper * (glide.lift_n * px_per_n);
    let drag = origin - along * (glide.drag_n * px_per_n);
    let weight = origin + Point::new(0.0, glide.net_weight_n * px_per_n);
    let sum = lift + drag - origin;
    for (from, to) in [(lift, sum), (drag, sum), (origin, sum)] {
        pen.line("sum", from, to);
    }
    pen.arrow("lift", origin, lift);
    pen.arrow("drag", origin, drag);
    pen.arrow("weight", origin, weight);
    let name = if glide.net_weight_n < 0.0 { "net buoyancy" } else { "net weight" };
    let rows = [
        (lift, Anchor::Start, format!("lift {:.2} N", glide.lift_n.abs())),
        (drag, Anchor::End, format!("drag {:.2} N", glide.drag_n.abs())),
        (weight, Anchor::Middle, format!("{name} {:.2} N", glide.net_weight_n.abs())),
    ];
    for (tip, anchor, words) in rows {
        let beside = match anchor {
            Anchor::Start => Point::new(10.0, 4.0),
            Anchor::Middle if glide.net_weight_n < 0.0 => Point::new(0.0, -10.0),
            Anchor::Middle => Point::new(0.0, 20.0),
            Anchor::End => Point::new(-8.0, 4.0),
        };
        pen.text("force", tip + beside, anchor, &words);
    }
}

/// The numbers, in columns at the panel's foot.
fn values(pen: &mut Pen, glide: &DrawnGlide, pitch_rad: f64, at: Point, width: f64) {
    let lift_to_drag = if glide.drag_n > 0.0 { (glide.lift_n / glide.drag_n).abs() } else { 0.0 };
    let columns = [
        ("path angle γ", minus(format!("{:.2}°", glide.path_angle_rad.to_degrees()))),
        ("pitch θ = γ + α", minus(format!("{:.2}°", pitch_rad.to_degrees()))),
        ("lift/drag", format!("{lift_to_drag:.2}")),
        ("moving mass", minus(format!("{:+.3} m", glide.r_px_m))),
    ];
    for (index, (name, value)) in columns.iter().enumerate() {
        let place = at + Point::new(index as f64 * width / columns.len() as f64, 0.0);
        pen.text("size", place + Point::new(0.0, 12.0), Anchor::Start, name);
        pen.text("label", place + Point::new(0.0, 32.0), Anchor::Start, value);
    }
}

fn degrees(name: &str, angle_rad: f64) -> String {
    minus(format!("{name} {:.2}°", angle_rad.to_degrees()))
}

/// Unit vector on the sheet for an angle above the horizon.
fn direction(angle_rad: f64) -> Point {
    Point::new(angle_rad.cos(), -angle_rad.sin())
}

fn arc(pen: &mut Pen, centre: Point, radius: f64, from_rad: f64, to_rad: f64) {
    let (from, to) = (centre + direction(from_rad) * radius, centre + direction(to_rad) * radius);
    let sweep = u8::from(to_rad < from_rad);
    let r = px(radius);
    pen.path("angle", format!("M{} {}A{r} {r} 0 0 {sweep} {} {}", px(from.x), px(from.y), px(to.x), px(to.y)));
}
