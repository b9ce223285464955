//! The dive in figures, as HTML tables.

use maud::{Markup, html};

use super::{
    Flight,
    figures::{self, Leg, Moves, ON_HEADING_DEG},
};
use crate::flight::{NorthEast, Outcome, TICK_S};

/// The figures that say at once how it went.
pub(super) fn headline(flight: &Flight<'_>) -> Markup {
    let summary = flight.summary;
    let outcome = match summary.outcome {
        Outcome::Completed => "completed",
        Outcome::Aborted => "aborted",
        Outcome::Lost => "lost",
    };
    let made_good_m = summary.surfacing.actual.map(|place| place.north_m.hypot(place.east_m));
    let cards = [
        ("Duration", duration(summary.duration_s)),
        ("Deepest", format!("{:.1} m", summary.max_depth_m)),
        ("Made good", optional(made_good_m, |m| format!("{m:.0} m"))),
        ("Surfacing missed by", optional(miss_m(flight), |m| format!("{m:.0} m"))),
        ("Energy", format!("{:.1} kJ", 1e-3 * summary.energy_j.total())),
    ];
    html! {
        dl.headline {
            div { dt { "Outcome" } dd.(outcome) { (outcome) @for abort in &summary.aborts { " " small { (spaced(abort)) } } } }
            @for (name, value) in &cards { div { dt { (name) } dd { (value) } } }
        }
    }
}

/// One row per dive and climb.
pub(super) fn legs(flight: &Flight<'_>) -> Markup {
    let legs = figures::legs(flight.record);
    html! {
        table {
            caption { "Legs" }
            thead { tr {
                th { "" } th { "time" } th { "turned at" } th { "off target" } th { "vertical" } th { "horizontal" }
                th { "heading" } th { "within ±" (ON_HEADING_DEG) "° after" } th { "rms from then" }
            } }
            tbody { @for leg in &legs { (leg_row(flight, leg)) } }
        }
    }
}

fn leg_row(flight: &Flight<'_>, leg: &Leg) -> Markup {
    let mission = flight.mission;
    let last_climb = leg.climbing && mission.surfaces_after(leg.yo);
    let target_mm = if leg.climbing { mission.climb_to_mm } else { mission.dive_to_mm };
    let off_m = leg.turning_depth_m - f64::from(target_mm) / 1e3;
    html! {
        tr {
            th { (if leg.climbing { "climb " } else { "dive " }) (leg.yo) }
            td { (duration(leg.duration_s)) }
            @if last_climb {
                td { "surface" } td { "" }
            } @else {
                td { (format!("{:.1} m", leg.turning_depth_m)) } td { (signed(off_m, 1)) " m" }
            }
            td { (format!("{:.3} m/s ", leg.vertical_speed_m_s.abs())) (if leg.climbing { "up" } else { "down" }) }
            td { (format!("{:.3} m/s", leg.horizontal_speed_m_s)) }
            td { (format!("{:.0}°", leg.target_heading_deg)) }
            td { (optional(leg.on_heading_after_s, |s| format!("{s:.0} s"))) }
            td { (optional(leg.heading_rms_deg, |deg| format!("{deg:.2}°"))) }
        }
    }
}

/// What the drives did, and what they and the rest took.
pub(super) fn drives(flight: &Flight<'_>) -> Markup {
    let energy = &flight.summary.energy_j;
    let record = flight.record;
    let rows = [
        ("axial drive", Some(figures::moves(record, |s| s.commands.r_px_rate_um_s)), energy.pitch),
        ("rotation drive", Some(figures::moves(record, |s| s.commands.mu_rate_cdeg_s.into())), energy.roll),
        ("pump", Some(figures::moves(record, |s| s.commands.vbd_rate_ul_s.max(0))), energy.pump),
        ("bleed valve", Some(figures::moves(record, |s| s.commands.vbd_rate_ul_s.min(0))), 0.0),
        ("hotel", None, energy.hotel),
    ];
    html! {
        table {
            caption { "Drives and energy" }
            thead { tr { th { "" } th { "moves" } th { "running" } th { "energy" } th { "per move" } th { "share" } } }
            tbody {
                @for (name, moves, used_j) in &rows { (drive_row(name, *moves, *used_j, energy.total())) }
            }
        }
    }
}

fn drive_row(name: &str, moves: Option<Moves>, used_j: f64, total_j: f64) -> Markup {
    let per_move = moves.filter(|moves| moves.count > 0 && used_j > 0.0).map(|moves| used_j / f64::from(moves.count));
    html! {
        tr {
            th { (name) }
            td { (optional(moves, |moves| moves.count.to_string())) }
            td { (optional(moves, |moves| format!("{:.0} s", f64::from(moves.ticks) * TICK_S))) }
            td { (format!("{:.2} kJ", 1e-3 * used_j)) }
            td { (optional(per_move, |j| if j < 1e3 { format!("{j:.1} J") } else { format!("{:.2} kJ", 1e-3 * j) })) }
            td { (format!("{:.1} %", if total_j > 0.0 { 100.0 * used_j / total_j } else { 0.0 })) }
        }
    }
}

/// Where it came up, how well it held its heading, and what identifies the flight.
pub(super) fn navigation(flight: &Flight<'_>) -> Markup {
    let summary = flight.summary;
    let place = |place: &Option<NorthEast>| {
        optional(*place, |place| format!("{} m north, {} m east", signed(place.north_m, 1), signed(place.east_m, 1)))
    };
    let yo = flight.record.samples.last().map_or(0, |sample| sample.commands.yo);
    let rms = figures::yo_heading_rms_deg(flight.record, yo);
    let rows = [
        ("surfaced, as expected", place(&summary.surfacing.predicted)),
        ("surfaced, in truth", place(&summary.surfacing.actual)),
        ("missed by", optional(miss_m(flight), |m| format!("{m:.1} m"))),
        (
            "heading on the last yo",
            optional(rms, |deg| format!("{deg:.2}° rms from the first entry within ±{ON_HEADING_DEG}°")),
        ),
        ("ticks", format!("{} at 4 Hz", summary.ticks)),
        ("simulated", format!("{:.0} times faster than real time", summary.real_time_factor)),
        ("vehicle's fingerprint", format!("{:016x}", flight.vehicle.hash())),
    ];
    html! {
        table.facts {
            caption { "Navigation and identity" }
            tbody {
                @for (name, value) in &rows { tr { th { (name) } td { (value) } } }
                tr { th { "trace of commands" } td.hash { (summary.trace_hash) } }
            }
        }
    }
}

fn miss_m(flight: &Flight<'_>) -> Option<f64> {
    let (predicted, actual) = (flight.summary.surfacing.predicted?, flight.summary.surfacing.actual?);
    Some((predicted.north_m - actual.north_m).hypot(predicted.east_m - actual.east_m))
}

/// Minutes and seconds, or hours and minutes.
pub(super) fn duration(seconds: f64) -> String {
    let whole = seconds.round() as i64;
    if whole < 3_600 {
        format!("{} min {:02} s", whole / 60, whole % 60)
    } else {
        format!("{} h {:02} min", whole / 3_600, whole % 3_600 / 60)
    }
}

/// The words of a name in CamelCase.
fn spaced(name: &str) -> String {
    let words = name.chars().enumerate().flat_map(|(index, letter)| {
        let gap = (index > 0 && letter.is_uppercase()).then_some(' ');
        gap.into_iter().chain(letter.to_lowercase())
    });
    words.collect()
}

fn optional<T>(value: Option<T>, words: impl Fn(T) -> String) -> String {
    value.map_or_else(|| "—".into(), words)
}

fn signed(value: f64, decimals: usize) -> String {
    format!("{value:+.decimals$}").replace('-', "−")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn durations_and_names_read_well() {
        assert_eq!(duration(59.6), "1 min 00 s");
        assert_eq!(duration(3_599.4), "59 min 59 s");
        assert_eq!(duration(3_600.0), "1 h 00 min");
        assert_eq!(spaced("MissionTimeout"), "mission timeout");
    }
}
