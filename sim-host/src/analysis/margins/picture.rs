//! Margins over the envelope, as curves: path angle along, a colour per net mass.

use super::{ENOUGH_GAIN, Envelope, Margins, Node};
use crate::pages::chart::{Figure, Line, Panel, Scale, Stroke};

/// Both margins of both loops.
#[must_use]
pub fn figure(title: &str, envelope: &Envelope) -> Figure {
    let gain = |margins: Margins| margins.gain_margin;
    let delay = |margins: Margins| margins.delay_margin_s;
    let nodes = &envelope.nodes;
    let mut panels = vec![
        panel("pitch", "gain margin, factor", nodes, |node| gain(node.pitch)),
        panel("pitch", "delay margin, s", nodes, |node| delay(node.pitch)),
        panel("heading", "gain margin, factor", nodes, |node| gain(node.heading)),
        panel("heading", "delay margin, s", nodes, |node| delay(node.heading)),
    ];
    for panel in panels.iter_mut().step_by(2) {
        panel.lines.push(enough());
    }
    Figure { title: title.into(), columns: 2, panels }
}

/// The gain margin that a loop should have, from the steepest dive to the steepest climb there is.
fn enough() -> Line {
    let points = vec![[-90.0, ENOUGH_GAIN], [90.0, ENOUGH_GAIN]];
    Line { name: Some(format!("{ENOUGH_GAIN}, or 6 dB")), stroke: Stroke::Aid, points }
}

fn panel(title: &str, label: &str, nodes: &[Node], value: impl Fn(&Node) -> Option<f64>) -> Panel {
    // Dives and climbs at the same net mass but for its sign share a colour.
    let mut sizes_kg: Vec<f64> = nodes.iter().map(|node| node.net_mass_kg.abs()).collect();
    sizes_kg.sort_by(f64::total_cmp);
    sizes_kg.dedup();
    let line = |side: &[Node]| {
        let size_kg = side.first().map_or(0.0, |node| node.net_mass_kg.abs());
        let colour = sizes_kg.iter().position(|size| *size == size_kg).unwrap_or_default();
        let point = |node: &Node| [node.path_angle_rad.to_degrees(), value(node).unwrap_or(f64::NAN)];
        Line {
            name: Some(format!("{size_kg:.3} kg")),
            stroke: Stroke::Solid(colour),
            points: side.iter().map(point).collect(),
        }
    };
    let lines: Vec<Line> = nodes.chunk_by(|a, b| a.net_mass_kg == b.net_mass_kg).map(line).collect();
    let path_angles = nodes.iter().map(|node| node.path_angle_rad.to_degrees());
    let path_angles = path_angles.fold([0.0_f64; 2], |[min, max], angle| [min.min(angle - 2.0), max.max(angle + 2.0)]);
    let most = lines.iter().flat_map(|line| &line.points).map(|[_, value]| *value).filter(|value| value.is_finite());
    let most = most.fold(1.0, f64::max);
    Panel {
        title: title.into(),
        x: Scale::exactly("path angle, deg (dives left, climbs right)", path_angles),
        y: Scale::exactly(label, [0.0, 1.05 * most]),
        lines,
        places: Vec::new(),
    }
}
