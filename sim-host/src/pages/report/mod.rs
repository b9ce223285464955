//! The report of a flight: one HTML file that needs nothing else.

pub mod figures;
mod picture;
mod surroundings;
mod tables;
mod traces;
mod track;

use maud::{Markup, PreEscaped, html};
use shared::mission::{Course, Mission};

use crate::analysis::trim::{Condition, Scale, glide};
use crate::flight::{Summary, record::Record};
use crate::model::vehicle::Vehicle;
use crate::pages::{
    chart::plot::{self, BELOW_PX, LEFT_PX, Plot},
    draw::{DrawnGlide, sheet},
    page::page,
};
pub use picture::picture;
use traces::{DepthTargets, Trace, Traces};
use track::{PLACE_KEY, TRACK_KEY};

/// Everything a report is made of.
#[derive(Clone, Copy, Debug)]
pub struct Flight<'a> {
    /// Who flew.
    pub vehicle: &'a Vehicle,
    /// What was to be flown.
    pub mission: &'a Mission,
    /// What was flown, tick by tick.
    pub record: &'a Record,
    /// What came of it.
    pub summary: &'a Summary,
}

impl Flight<'_> {
    fn depth_targets(&self) -> DepthTargets {
        let metres = |mm: i32| f64::from(mm) / 1e3;
        DepthTargets { dive_to_m: metres(self.mission.dive_to_mm), climb_to_m: metres(self.mission.climb_to_mm) }
    }

    /// The dives of the mission as a steady glide.
    fn drawing(&self) -> Option<String> {
        let path_angle_rad = (f64::from(self.mission.dive_path_angle_cdeg) / 100.0).to_radians();
        let net_mass_kg = f64::from(self.mission.dive_net_mass_g) / 1e3;
        let trim = glide(self.vehicle, Condition::PathAngle(path_angle_rad), Scale::NetMass(net_mass_kg)).ok()?;
        Some(sheet(self.vehicle, &DrawnGlide::new(self.vehicle, &trim)))
    }
}

/// The report as one self-contained HTML document.
#[must_use]
pub fn html(flight: &Flight<'_>) -> String {
    let name = &flight.vehicle.name;
    let title = format!("Dive of {name}");
    let body = html! {
                header { h1 { (title) } p { (mission_line(flight.mission)) } }
                main {
                    (tables::headline(flight))
                    (over_time(flight))
                    (tracks(flight))
                    section {
                        h2 { "Figures" }
                        div.scroll { (tables::legs(flight)) }
                        div.pair { div.scroll { (tables::drives(flight)) } div.scroll { (tables::navigation(flight)) } }
                    }
                    @if let Some(drawing) = flight.drawing() {
                        section.drawing { h2 { "Vehicle" } div.scroll { (PreEscaped(drawing)) } }
                    }
                }
    };
    page(&title, &[include_str!("report.css"), plot::CSS].concat(), &body)
}

/// The mission in one line.
fn mission_line(mission: &Mission) -> String {
    let leg = |name: &str, path_cdeg: i16, net_mass_g: i16| {
        let (path_deg, net_mass_kg) = (f64::from(path_cdeg) / 100.0, f64::from(net_mass_g) / 1e3);
        format!("{name} {path_deg:+}° at {net_mass_kg:+} kg").replace('-', "−")
    };
    let mut line = format!(
        "{} yo{} between {} and {} m: {}, {}, {}",
        mission.total_yos(),
        if mission.total_yos() == 1 { "" } else { "s" },
        f64::from(mission.climb_to_mm) / 1e3,
        f64::from(mission.dive_to_mm) / 1e3,
        leg("dives", mission.dive_path_angle_cdeg, mission.dive_net_mass_g),
        leg("climbs", mission.climb_path_angle_cdeg, mission.climb_net_mass_g),
        course_words(&mission.course)
    );
    if mission.surfacings > 1 {
        line += &format!(", up to {} surfacings", mission.surfacings);
    }
    if mission.drift_time_s > 0 {
        line += &format!(", {} min adrift at depth", f64::from(mission.drift_time_s) / 60.0);
    }
    line
}

fn course_words(course: &Course) -> String {
    match course {
        Course::Headings(headings) => {
            let headings: Vec<_> = headings.iter().map(|cdeg| format!("{}°", f64::from(*cdeg) / 100.0)).collect();
            format!("headings {}", headings.join(", "))
        }
        Course::Waypoints(route) => format!("{} waypoints", route.places.len()),
        Course::Spiral(mooring) => {
            let rate_deg_s = f64::from(mooring.turn_rate_cdeg_s) / 100.0;
            format!("spirals at {rate_deg_s:+} °/s within {} m", f64::from(mooring.radius_mm) / 1e3).replace('-', "−")
        }
    }
}

fn over_time(flight: &Flight<'_>) -> Markup {
    let traces = Traces::new(flight.record);
    let phases = PHASES.iter().filter(|(class, _)| traces.has_band(class));
    let traces = traces.all(&flight.depth_targets());
    html! {
        section {
            h2 { "Over time, min" }
            p.phases {
                @for (class, words) in phases { span { i.(class) {} (words) } }
            }
            div.traces { @for trace in &traces { (figure(trace)) } }
        }
    }
}

/// Key of the bands behind the plots.
const PHASES: [(&str, &str); 6] = [
    ("surface", "at the surface"),
    ("dive", "dive"),
    ("turn", "apogee and crest"),
    ("drift", "drift"),
    ("climb", "climb"),
    ("recovery", "recovery"),
];

fn figure(trace: &Trace) -> Markup {
    html! {
        figure {
            figcaption {
                b { (trace.title) } " " span.unit { (trace.unit) }
                (key(trace.key.iter().map(|(class, words)| (*class, words.as_str()))))
            }
            (boxed(&trace.plot, if trace.tall { "tall" } else { "" }, None))
        }
    }
}

/// A plot with room for its words; `shape` is width over height.
fn boxed(plot: &Plot, class: &str, shape: Option<f64>) -> Markup {
    let room = format!("margin:8px 10px {BELOW_PX}px {LEFT_PX}px");
    let style = shape.map_or(room.clone(), |shape| format!("{room};height:auto;aspect-ratio:{shape:.3}"));
    html! { div class=(format!("box {class}")) style=(style) { (PreEscaped(plot.svg().to_string())) } }
}

fn key<'a>(entries: impl IntoIterator<Item = (&'a str, &'a str)>) -> Markup {
    html! { span.key { @for (class, words) in entries { span { i.(class) {} (words) } } } }
}

fn tracks(flight: &Flight<'_>) -> Markup {
    let top = track::top(flight.record, &flight.summary.surfacing);
    html! {
        section {
            h2 { "Track" }
            div.pair {
                figure {
                    figcaption { b { "From above" } " " span.unit { "north over east, m" } (key(PLACE_KEY)) }
                    (boxed(&top.plot, "", Some(top.shape)))
                }
                figure {
                    figcaption { b { "From the side" } " " span.unit { "depth over way, m" } (key(TRACK_KEY)) }
                    (boxed(&track::side(flight.record), "", Some(top.shape)))
                }
            }
        }
    }
}
