//! Strokes, arrows, dimensions and words, in pixels.

use nalgebra::Vector2;
use svg::{
    Node,
    node::element::{Circle, Group, Line, Path, Polygon, Rectangle, Text},
};

/// A place on the sheet, px, y down.
pub(super) type Point = Vector2<f64>;

/// Half length of a dimension's end strokes, px.
const TICK_PX: f64 = 4.0;
/// Length of an arrow's head, px.
const HEAD_PX: f64 = 10.0;
/// Mean width of a character over the size of the font.
const CHARACTER_WIDTH: f64 = 0.53;

/// How a text stands to its place.
#[derive(Clone, Copy, Debug)]
pub(super) enum Anchor {
    Start,
    Middle,
    End,
}

/// Draws into one group.
pub(super) struct Pen(Group);

impl Pen {
    pub(super) fn new() -> Self {
        Self(Group::new())
    }

    pub(super) fn into_group(self) -> Group {
        self.0
    }

    pub(super) fn line(&mut self, class: &str, from: Point, to: Point) {
        self.0.append(
            Line::new()
                .set("class", class)
                .set("x1", px(from.x))
                .set("y1", px(from.y))
                .set("x2", px(to.x))
                .set("y2", px(to.y)),
        );
    }

    pub(super) fn polygon(&mut self, class: &str, points: &[Point]) {
        let points: Vec<_> = points.iter().map(|point| format!("{},{}", px(point.x), px(point.y))).collect();
        self.0.append(Polygon::new().set("class", class).set("points", points.join(" ")));
    }

    /// SVG path data, already in pixels.
    pub(super) fn path(&mut self, class: &str, data: String) {
        self.0.append(Path::new().set("class", class).set("d", data));
    }

    pub(super) fn circle(&mut self, class: &str, centre: Point, radius: f64) {
        self.0.append(
            Circle::new().set("class", class).set("cx", px(centre.x)).set("cy", px(centre.y)).set("r", px(radius)),
        );
    }

    pub(super) fn rectangle(&mut self, class: &str, corner: Point, size: Point) {
        self.0.append(
            Rectangle::new()
                .set("class", class)
                .set("x", px(corner.x))
                .set("y", px(corner.y))
                .set("width", px(size.x))
                .set("height", px(size.y)),
        );
    }

    pub(super) fn text(&mut self, class: &str, at: Point, anchor: Anchor, words: &str) {
        self.0.append(text(class, at, anchor, words));
    }

    /// A text that reads upwards.
    pub(super) fn upright_text(&mut self, class: &str, at: Point, words: &str) {
        let turn = format!("rotate(-90 {} {})", px(at.x), px(at.y));
        self.0.append(text(class, at, Anchor::Middle, words).set("transform", turn));
    }

    /// A line with a head at its end; nothing if it has no length.
    pub(super) fn arrow(&mut self, class: &str, from: Point, to: Point) {
        let length = (to - from).norm();
        if length < 1.0 {
            return;
        }
        let along = (to - from) / length;
        let across = Point::new(-along.y, along.x);
        let neck = to - along * HEAD_PX.min(0.6 * length);
        self.line(class, from, neck);
        let half = 0.38 * HEAD_PX;
        self.polygon(&format!("{class} head"), &[to, neck + across * half, neck - across * half]);
    }

    /// A dimension between two places, with its words beside the middle: above, or to the left of an upright one.
    pub(super) fn dimension(&mut self, from: Point, to: Point, words: &str) {
        let along = (to - from).normalize();
        let across = Point::new(-along.y, along.x);
        self.line("dimension", from, to);
        for end in [from, to] {
            self.line("dimension", end - across * TICK_PX, end + across * TICK_PX);
        }
        let middle = (from + to) / 2.0;
        if along.x.abs() > along.y.abs() {
            self.text("size", middle - Point::new(0.0, 5.0), Anchor::Middle, words);
        } else {
            self.upright_text("size", middle - Point::new(6.0, 0.0), words);
        }
    }

    /// The quartered disc that marks a centre of mass.
    pub(super) fn centre_of_mass(&mut self, at: Point, radius: f64) {
        self.circle("mass-disc", at, radius);
        let r = px(radius);
        for (x, y) in [(radius, -radius), (-radius, radius)] {
            let (corner, end) = (at + Point::new(x, 0.0), at + Point::new(0.0, y));
            let data = format!(
                "M{} {}L{} {}A{r} {r} 0 0 0 {} {}Z",
                px(at.x),
                px(at.y),
                px(corner.x),
                px(corner.y),
                px(end.x),
                px(end.y)
            );
            self.path("mass-quarter", data);
        }
    }
}

fn text(class: &str, at: Point, anchor: Anchor, words: &str) -> Text {
    let anchor = match anchor {
        Anchor::Start => "start",
        Anchor::Middle => "middle",
        Anchor::End => "end",
    };
    Text::new(words).set("class", class).set("x", px(at.x)).set("y", px(at.y)).set("text-anchor", anchor)
}

/// A tenth of a pixel is enough.
pub(super) fn px(value: f64) -> String {
    let rounded = (value * 10.0).round() / 10.0;
    // No negative zero.
    format!("{}", rounded + 0.0)
}

/// Numbers with a true minus sign.
pub(super) fn minus(words: String) -> String {
    words.replace('-', "−")
}

/// About how wide a text is, px.
pub(super) fn width_px(words: &str, font_px: f64) -> f64 {
    words.chars().count() as f64 * CHARACTER_WIDTH * font_px
}

/// Moves the middles of texts in a row apart until none overlaps, within bounds if they fit at all.
pub(super) fn spread(middles: &[f64], widths: &[f64], bounds: [f64; 2]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..middles.len()).collect();
    order.sort_by(|a, b| middles[*a].total_cmp(&middles[*b]));
    let mut placed = middles.to_vec();
    let mut free = bounds[0];
    for &index in &order {
        placed[index] = middles[index].max(free + widths[index] / 2.0);
        free = placed[index] + widths[index] / 2.0;
    }
    let mut limit = bounds[1];
    for &index in order.iter().rev() {
        placed[index] = placed[index].min(limit - widths[index] / 2.0);
        limit = placed[index] - widths[index] / 2.0;
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::spread;

    #[test]
    fn texts_in_a_row_keep_apart_and_inside() {
        assert_eq!(spread(&[50.0, 52.0], &[20.0, 20.0], [0.0, 100.0]), [50.0, 70.0]);
        assert_eq!(spread(&[95.0, 90.0], &[20.0, 20.0], [0.0, 100.0]), [90.0, 70.0]);
        assert_eq!(spread(&[1.0], &[20.0], [0.0, 100.0]), [10.0]);
    }
}
