//! A plan drawn: the way from above, where it comes up, depth over time; as a figure and as a page with its numbers.

use maud::{PreEscaped, html};

use super::Plan;
use crate::flight::{NorthEast, Outcome};
use crate::pages::{
    chart::{Figure, Line, Mark, Panel, Place, Scale, Stroke},
    page::{STYLE, page},
};

const ABOUT: &str = "The nominal flight has everything as the files say. Each member of the ensemble is a vehicle that differs \
    a little from its file: coefficients by up to 10 %, damping by up to 20 %, ballast by up to 30 g, a compass that deviates by \
    2° rms, and the unknown current if there is one. Dots are where members that completed the mission came up, open circles \
    where others did.";

/// The plan as one page that needs nothing else; `title` says what is flown, `lines` are its numbers in words.
#[must_use]
pub fn html(title: &str, lines: &[[String; 2]], plan: &Plan) -> String {
    let body = html! {
                h1 { (title) }
                dl { @for [name, words] in lines { dt { (name) } dd { (words) } } }
                div.scroll { (PreEscaped(figure(title, plan).svg())) }
                p { (ABOUT) }
    };
    page(title, STYLE, &body)
}

/// The plan as a figure.
#[must_use]
pub fn figure(title: &str, plan: &Plan) -> Figure {
    Figure { title: title.into(), columns: 2, panels: vec![track(plan), surfacings(plan), depth(plan), spread(plan)] }
}

/// East and north.
fn on_map(place: &NorthEast) -> [f64; 2] {
    [place.east_m, place.north_m]
}

fn solid(name: &str, colour: usize, points: Vec<[f64; 2]>) -> Line {
    Line { name: Some(name.into()), stroke: Stroke::Solid(colour), points }
}

fn track_line(plan: &Plan) -> Line {
    solid("nominal flight", 0, plan.track.iter().map(|point| on_map(&point.place)).collect())
}

/// The ellipses, the wider one first.
fn ellipses(plan: &Plan) -> Vec<Line> {
    let holding = plan.surfacing.iter().flat_map(|surfacing| surfacing.ellipses.iter().rev());
    let line = |(colour, share, points): (usize, f64, Vec<[f64; 2]>)| {
        solid(&format!("{:.0} % of surfacings", 100.0 * share), colour, points)
    };
    holding
        .enumerate()
        .map(|(index, holding)| {
            let outline = holding.ellipse.outline().map(|place| on_map(&place)).collect();
            line((1 + index, holding.ellipse.share, outline))
        })
        .collect()
}

fn dots(plan: &Plan) -> Vec<Place> {
    let mark = |outcome: Outcome| if outcome == Outcome::Completed { Mark::Dot } else { Mark::Printed };
    let dot = |place: &NorthEast, outcome| Place { at: on_map(place), mark: mark(outcome) };
    plan.members.iter().filter_map(|member| Some(dot(member.surfacing.as_ref()?, member.outcome))).collect()
}

fn map(title: &str, lines: Vec<Line>, places: Vec<Place>) -> Panel {
    let shown = lines.iter().flat_map(|line| &line.points).chain(places.iter().map(|place| &place.at));
    let [x, y] = Scale::equal(["east, m", "north, m"], shown.copied());
    Panel { title: title.into(), x, y, lines, places }
}

fn track(plan: &Plan) -> Panel {
    let mut lines = vec![track_line(plan)];
    lines.extend(ellipses(plan));
    let mut places = dots(plan);
    places.push(Place { at: [0.0, 0.0], mark: Mark::From });
    map("the way, from the start (red)", lines, places)
}

/// The members alone set the axes; the track goes through.
fn surfacings(plan: &Plan) -> Panel {
    let mut panel = map("where it surfaces", ellipses(plan), dots(plan));
    panel.lines.insert(0, track_line(plan));
    panel
}

fn depth(plan: &Plan) -> Panel {
    let points = plan.track.iter().map(|point| [point.time_s / 60.0, point.depth_m]).collect();
    Panel {
        title: "depth".into(),
        x: Scale::around("time, min"),
        y: Scale { downwards: true, ..Scale::around("depth, m") },
        lines: vec![solid("nominal flight", 0, points)],
        places: Vec::new(),
    }
}

fn spread(plan: &Plan) -> Panel {
    let place = |member: &super::Member, mark| Place { at: [member.duration_s / 60.0, member.energy_j / 1e3], mark };
    let completed = plan.members.iter().filter(|member| member.outcome == Outcome::Completed);
    let mut places: Vec<Place> = completed.map(|member| place(member, Mark::Dot)).collect();
    places.push(place(&plan.nominal, Mark::To));
    Panel {
        title: "duration and energy; nominal: square".into(),
        x: Scale::around("duration, min"),
        y: Scale::around("energy, kJ"),
        lines: Vec::new(),
        places,
    }
}
