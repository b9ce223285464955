//! Figures 5 to 10: the polar, what a speed takes, and how far a battery goes; and what sections 4.2.1 and 6 say of them.

use super::{
    Reproduction,
    comparison::{Reading, Row, Trend},
};
use crate::analysis::performance::{Account, Endurance, Hold, Polar, PolarPoint, Size, Sizing};
use crate::model::{
    coefficients::{Anchoring, Parameter, Shape, Study},
    ocean::Ocean,
    vehicle::Vehicle,
};
use crate::pages::chart::{Figure, Line, Mark, Panel, Place, Scale, Stroke, contours};

/// Parameters of Figs 7 and 8 in the paper's order, with the values that are drawn: the nominal one in the middle. The paper's
/// own ranges are not legible.
pub const VARIED: [(Parameter, [f64; 5]); 4] = [
    (Parameter::HullLength, [1.0, 1.25, 1.5, 1.75, 2.0]),
    (Parameter::WingAspectRatio, [7.0, 9.0, 11.0, 13.0, 15.0]),
    (Parameter::WingSpanRatio, [4.0, 5.0, 6.0, 7.0, 8.0]),
    (Parameter::HullFineness, [5.0, 6.0, 7.0, 8.0, 9.0]),
];
/// Speeds of Figs 7, 8 and 10, m/s.
const SPEEDS_M_S: [f64; 2] = [0.2, 1.0];
/// Depths of Fig 10, m.
const DEPTHS_M: [f64; 2] = [20.0, 200.0];
/// The paper's battery, J.
const BATTERY_J: f64 = 540e3;
/// The paper's glider, kg of displaced water.
const GLIDER_KG: f64 = 52.0;
/// Points of a curve.
const POINTS: usize = 161;
/// Points each way of Fig 10.
const GRID: usize = 41;

/// A quantity of an account.
type OfAccount = fn(&Account) -> f64;

/// The figures by their file names, printed values and trends.
///
/// # Errors
/// One line if the vehicle has no such glides.
pub fn reproduce(vehicle: &Vehicle) -> Result<Reproduction, String> {
    let sizing = Sizing { study: Study { anchoring: Anchoring::Unanchored, ..Study::new(vehicle) } };
    let printed_polar = Polar::from(&vehicle.hydrodynamics);
    let figure = |title: &str, columns, panels: Vec<Panel>| Figure { title: title.into(), columns, panels };
    let mass = Hold::Displacement(GLIDER_KG);
    let with_mass = |of: fn(&Sizing<'_>, Hold) -> Vec<Panel>| {
        let both = of(&sizing, Hold::Geometry).into_iter().map(|panel| named(panel, "every other parameter held"));
        both.chain(of(&sizing, mass).into_iter().map(|panel| named(panel, "52 kg held"))).collect::<Vec<_>>()
    };
    let figures = [
        ("fig5", figure("Fig 5  Drag polar", 1, vec![polar(&printed_polar)])),
        ("fig6", figure("Fig 6  Flight at maximum horizontal speed", 2, max_horizontal_speed().into())),
        (
            "fig7",
            figure("Fig 7  Required lung capacity over the speed of the flattest glide", 4, with_mass(lung_capacity)),
        ),
        (
            "fig8",
            figure("Fig 8  Maximum lift over drag over the speed of the flattest glide", 4, with_mass(lift_to_drag)),
        ),
        ("fig9", figure("Fig 9  Neutral displacement", 1, vec![neutral_displacement(vehicle)])),
        (
            "fig10",
            figure(
                "Fig 10  540 kJ at the flattest glide: ideal as in the paper, and with all losses",
                3,
                endurance(&sizing),
            ),
        ),
    ];
    let rows = vec![
        Row::new(
            "4.1, Fig 5",
            "best glide of the Slocum model, deg",
            "8",
            printed_polar.best_glide().descent_rad.to_degrees(),
            "",
        ),
        Row::new("4.1, Fig 6", "least descent at maximum speed, deg", "35.26", limit().to_degrees(), ""),
        Row::new(
            "4.2.1",
            "mass of the glider with l = 1.5 m, f = 7, kg",
            "52",
            displaced_kg(vehicle),
            "(π/4) d² l ρ; 52 kg would be the neutral mass with a lung of 4 %",
        ),
    ];
    let figures = figures.map(|(name, figure)| (name.to_owned(), figure)).into();
    Ok(Reproduction { figures, rows, trends: trends(&sizing)? })
}

fn named(panel: Panel, held: &str) -> Panel {
    Panel { title: format!("{}, {held}", panel.title), ..panel }
}

/// Descent at maximum horizontal speed as K C_D0 goes to 0, rad.
fn limit() -> f64 {
    Polar { c_d_zero: 1.0, c_d_induced: 0.0 }.max_horizontal_speed().descent_rad
}

fn displaced_kg(vehicle: &Vehicle) -> f64 {
    vehicle.water.density_kg_m3 * vehicle.hull.volume_m3()
}

/// Evenly spaced values from one to another.
fn along([from, to]: [f64; 2], points: usize) -> impl Iterator<Item = f64> {
    let share = move |i: usize| i as f64 / (points - 1) as f64;
    (0..points).map(move |i| from * (1.0 - share(i)) + to * share(i))
}

fn line(name: impl Into<String>, stroke: Stroke, points: impl Iterator<Item = [f64; 2]>) -> Line {
    Line { name: Some(name.into()), stroke, points: points.collect() }
}

/// Fig 5: the polar, its tangent from the origin, and both marked glides.
#[must_use]
pub fn polar(polar: &Polar) -> Panel {
    let (best, fast) = (polar.best_glide(), polar.max_horizontal_speed());
    let most = 2.0 * best.lift_coefficient;
    let mark = |point: PolarPoint| [point.drag_coefficient, point.lift_coefficient];
    let widest = polar.at(most).drag_coefficient;
    let note = |point: PolarPoint, words: String| Place {
        at: [point.drag_coefficient + 0.16 * widest, point.lift_coefficient],
        mark: Mark::Note(words),
    };
    let dot = |point| Place { at: mark(point), mark: Mark::Point };
    Panel {
        title: format!("best glide {:.2}°", best.descent_rad.to_degrees()),
        x: Scale::exactly("C_D", [0.0, widest]),
        y: Scale::exactly("C_L", [0.0, most]),
        lines: vec![
            line("C_D = C_D0 + K C_L²", Stroke::Solid(0), along([0.0, most], POINTS).map(|lift| mark(polar.at(lift)))),
            line(
                "tangent from the origin",
                Stroke::Dashed(1),
                [0.0, 1.8].into_iter().map(|t| mark(best).map(|x| t * x)),
            ),
        ],
        places: vec![
            dot(best),
            note(best, format!("{:.2}°", best.descent_rad.to_degrees())),
            dot(fast),
            note(fast, format!("max speed {:.2}°", fast.descent_rad.to_degrees())),
        ],
    }
}

/// Fig 6: drag over lift and descent angle (deg) at maximum horizontal speed, against 2KC_D0.
#[must_use]
pub fn max_horizontal_speed() -> [Panel; 2] {
    // With C_D0 = 1, K = δ/2.
    let at = |delta: f64| Polar { c_d_zero: 1.0, c_d_induced: 0.5 * delta }.max_horizontal_speed();
    let panel = |title: &str, label: &str, of: fn(PolarPoint) -> f64| Panel {
        title: title.into(),
        x: Scale::exactly("2KC_D0", [0.0, 1.0]),
        y: Scale::around(label),
        lines: vec![line(label, Stroke::Solid(0), along([0.0, 1.0], POINTS).map(|delta| [delta, of(at(delta))]))],
        places: Vec::new(),
    };
    let mut angle = panel("(b) descent angle", "descent angle, °", |point| point.descent_rad.to_degrees());
    let least = limit().to_degrees();
    angle.places = vec![
        Place { at: [0.0, least], mark: Mark::Printed },
        Place { at: [0.2, least], mark: Mark::Note("printed limit 35.26°".into()) },
    ];
    [panel("(a) drag over lift", "drag over lift", |point| 1.0 / point.lift_to_drag), angle]
}

/// Fig 7: required lung capacity (%) against V_md, one panel per varied parameter.
#[must_use]
pub fn lung_capacity(sizing: &Sizing<'_>, hold: Hold) -> Vec<Panel> {
    by_parameter(sizing, hold, "lung capacity, %", |size| size.lung_capacity.map_or(f64::NAN, |eta| 100.0 * eta))
}

/// Fig 8: largest lift over drag against V_md, one panel per varied parameter.
#[must_use]
pub fn lift_to_drag(sizing: &Sizing<'_>, hold: Hold) -> Vec<Panel> {
    by_parameter(sizing, hold, "lift over drag", |size| size.glide.lift_to_drag)
}

fn by_parameter(sizing: &Sizing<'_>, hold: Hold, label: &str, of: fn(&Size) -> f64) -> Vec<Panel> {
    let vehicle = sizing.study.vehicle;
    let panel = |(letter, (parameter, values)): (char, (Parameter, [f64; 5]))| Panel {
        title: format!("({letter}) {parameter}"),
        x: Scale::exactly("V_md, m/s", SPEEDS_M_S),
        y: Scale::around(label),
        lines: values
            .into_iter()
            .enumerate()
            .map(|(colour, value)| {
                let shape = hold.with(&Shape::of(vehicle), parameter, value, vehicle.water.density_kg_m3);
                stepped(value.to_string(), Stroke::Solid(colour), sizing, &shape, of)
            })
            .collect(),
        places: Vec::new(),
    };
    ('a'..).zip(VARIED).map(panel).collect()
}

/// A curve over speed that breaks where a boundary layer turns turbulent.
fn stepped(name: String, stroke: Stroke, sizing: &Sizing<'_>, shape: &Shape, of: fn(&Size) -> f64) -> Line {
    let mut points: Vec<[f64; 2]> = Vec::with_capacity(POINTS + 3);
    let mut before: Option<Size> = None;
    for speed_m_s in along(SPEEDS_M_S, POINTS) {
        let size = sizing.at_speed(shape, speed_m_s).ok();
        if let (Some(before), Some(size)) = (&before, &size)
            && !before.flows_like(size)
        {
            points.push([0.5 * (before.speed_m_s + speed_m_s), f64::NAN]);
        }
        points.push([speed_m_s, size.as_ref().map_or(f64::NAN, of)]);
        before = size;
    }
    Line { name: Some(name), stroke, points }
}

/// Fig 9: displaced mass (kg) against length, at the vehicle's fineness, with the printed 52 kg.
#[must_use]
pub fn neutral_displacement(vehicle: &Vehicle) -> Panel {
    let at = |length_m: f64| {
        let mut shape = Shape::of(vehicle);
        shape.hull.length_m = length_m;
        [length_m, vehicle.water.density_kg_m3 * shape.hull.volume_m3()]
    };
    let length_m = vehicle.hull.length_m;
    Panel {
        title: format!("fineness {}", vehicle.hull.fineness),
        x: Scale::exactly("length, m", [1.0, 2.0]),
        y: Scale::around("displaced mass, kg"),
        lines: vec![line("(π/4) ρ l³/f²", Stroke::Solid(0), along([1.0, 2.0], POINTS).map(at))],
        places: vec![
            Place { at: [length_m, GLIDER_KG], mark: Mark::Printed },
            Place { at: [length_m + 0.14, GLIDER_KG - 4.0], mark: Mark::Note("printed: 52 kg".into()) },
        ],
    }
}

/// Fig 10: contours of dives, range and endurance over speed and depth, ideal and with all losses.
#[must_use]
pub fn endurance(sizing: &Sizing<'_>) -> Vec<Panel> {
    let vehicle = sizing.study.vehicle;
    let (shape, ocean) = (Shape::of(vehicle), Ocean::still(&vehicle.water));
    let (speeds, depths): (Vec<f64>, Vec<f64>) = (along(SPEEDS_M_S, GRID).collect(), along(DEPTHS_M, GRID).collect());
    let grid: Vec<Vec<Option<Endurance>>> = depths
        .iter()
        .map(|depth_m| {
            let at = |speed: &f64| Endurance::new(sizing, &shape, (*speed, *depth_m, BATTERY_J), &ocean).ok();
            speeds.iter().map(at).collect()
        })
        .collect();
    // Without the floor of N, which would set steps on every line.
    let panels: [(&str, OfAccount, &[f64]); 3] = [
        ("(a) dives", dives, &[20.0, 50.0, 100.0, 200.0, 500.0, 1_000.0, 2_000.0]),
        (
            "(b) range, km",
            |account| dives(account) * account.dive_distance_m / 1e3,
            &[10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1_000.0],
        ),
        (
            "(c) endurance, days",
            |account| dives(account) * account.dive_duration_s / 86_400.0,
            &[0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0],
        ),
    ];
    let panel = |(title, of, levels): (&str, OfAccount, &[f64])| {
        let value = |i: usize, j: usize, real: bool| {
            let both: Option<&Endurance> = grid.get(j).and_then(|row| row.get(i)).and_then(Option::as_ref);
            let account =
                both.and_then(|e| if real { e.realistic.as_ref().map(|r| &r.account) } else { Some(&e.ideal) });
            account.map_or(0.0, of)
        };
        let mut panel = Panel {
            title: title.into(),
            x: Scale::exactly("speed, m/s", SPEEDS_M_S),
            y: Scale { downwards: true, ..Scale::exactly("depth, m", DEPTHS_M) },
            lines: Vec::new(),
            places: Vec::new(),
        };
        for (name, stroke, real) in [("ideal", Stroke::Solid(0), false), ("with all losses", Stroke::Dashed(1), true)] {
            for level in levels {
                for points in contours(&speeds, &depths, |i, j| value(i, j, real), *level) {
                    if let Some(at) = points.get(points.len() * if real { 4 } else { 2 } / 6) {
                        panel.places.push(Place { at: *at, mark: Mark::Note(level.to_string()) });
                    }
                    panel.lines.push(Line { name: Some(name.into()), stroke, points });
                }
            }
        }
        panel
    };
    panels.into_iter().map(panel).collect()
}

/// Dives that the paper's battery pays for, parts of dives included.
fn dives(account: &Account) -> f64 {
    BATTERY_J / account.dive_energy_j
}

/// Sections 4.2.1 and 6: how lung capacity, lift over drag and speed change with the geometry, within one state of flow.
fn trends(sizing: &Sizing<'_>) -> Result<Vec<Trend>, String> {
    let lung: fn(&Size) -> f64 = |size| size.lung_capacity.unwrap_or(f64::NAN);
    let ratio: fn(&Size) -> f64 = |size| size.glide.lift_to_drag;
    let [longer, slenderer, wider, finer] = VARIED.map(|(parameter, _)| parameter);
    let said = [
        ("4.2.1", "a longer hull needs less lung", longer, lung, false),
        ("4.2.1", "a higher aspect ratio needs less lung", slenderer, lung, false),
        ("4.2.1", "a smaller span ratio needs less lung", wider, lung, true),
        ("4.2.1", "a higher fineness needs less lung", finer, lung, false),
        ("4.2.1", "a longer hull raises lift over drag", longer, ratio, true),
        ("4.2.1, 6", "a larger span ratio raises lift over drag", wider, ratio, true),
        ("6", "a shorter hull raises lift over drag", longer, ratio, false),
    ];
    let mut trends = Vec::new();
    for (place, says, parameter, of, grows) in said {
        let mut readings = Vec::new();
        for (from, anchoring) in [("geometry alone", Anchoring::Unanchored), ("anchored", Anchoring::Anchored)] {
            let sizing = Sizing { study: Study { anchoring, ..sizing.study.clone() } };
            for (held, hold) in [("all else held", Hold::Geometry), ("52 kg held", Hold::Displacement(GLIDER_KG))] {
                let changes = changes(&sizing, hold, parameter, of)?;
                let holds = changes.iter().all(|change| (*change > 0.0) == grows);
                let mean = 100.0 * changes.iter().sum::<f64>() / changes.len().max(1) as f64;
                let found = format!("{mean:+.1} % per step of the figure, {} steps", changes.len());
                readings.push(Reading { reading: format!("{from}, {held}"), holds, found });
            }
        }
        trends.push(Trend { place: place.into(), says: says.into(), readings });
    }
    Ok(trends)
}

/// Relative changes between neighbouring values whose every surface has the same flow, at 17 speeds.
fn changes(sizing: &Sizing<'_>, hold: Hold, parameter: Parameter, of: fn(&Size) -> f64) -> Result<Vec<f64>, String> {
    let vehicle = sizing.study.vehicle;
    let values =
        VARIED.into_iter().find(|(varied, _)| *varied == parameter).map_or([f64::NAN; 5], |(_, values)| values);
    let mut changes = Vec::new();
    for speed_m_s in along(SPEEDS_M_S, 17) {
        let at = |value: f64| {
            let shape = hold.with(&Shape::of(vehicle), parameter, value, vehicle.water.density_kg_m3);
            sizing.at_speed(&shape, speed_m_s)
        };
        let sizes = values.into_iter().map(at).collect::<Result<Vec<_>, _>>()?;
        let alike = sizes.windows(2).filter(|pair| pair[0].flows_like(&pair[1]));
        changes.extend(alike.map(|pair| of(&pair[1]) / of(&pair[0]) - 1.0));
    }
    Ok(changes)
}
