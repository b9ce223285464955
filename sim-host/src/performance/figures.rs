//! The curves of the paper's Figs. 5 to 10 as plain data; nothing is drawn here.
//!
//! A family has one curve per value of a parameter (or per depth), all on the same abscissas; points that do not exist (no lung
//! is large enough, no dive is possible) are left out.

use super::{Endurance, Hold, Polar, PolarPoint, Size, Sizing};
use crate::{
    coefficients::{Parameter, Shape},
    ocean::Ocean,
};

/// A line of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What tells it from its neighbours.
    pub label: String,
    /// (x, y).
    pub points: Vec<[f64; 2]>,
}

/// One panel of a figure.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Number in the paper, such as "7a".
    pub number: &'static str,
    /// What it shows.
    pub title: String,
    /// Abscissa, with its unit.
    pub x: &'static str,
    /// Ordinate, with its unit.
    pub y: &'static str,
    /// Lines.
    pub curves: Vec<Curve>,
}

/// Parameters of Figs. 7 and 8 in the paper's order, with the values that are drawn: the nominal one in the middle. The paper's
/// own ranges are not legible.
pub const VARIED: [(Parameter, [f64; 5]); 4] = [
    (Parameter::HullLength, [1.0, 1.25, 1.5, 1.75, 2.0]),
    (Parameter::WingAspectRatio, [7.0, 9.0, 11.0, 13.0, 15.0]),
    (Parameter::WingSpanRatio, [4.0, 5.0, 6.0, 7.0, 8.0]),
    (Parameter::HullFineness, [5.0, 6.0, 7.0, 8.0, 9.0]),
];
/// Speeds of Figs. 7, 8 and 10, m/s.
const SPEEDS_M_S: [f64; 2] = [0.2, 1.0];
/// Points of a curve.
const POINTS: u32 = 161;

/// Points from one value to another.
fn along([from, to]: [f64; 2]) -> impl Iterator<Item = f64> {
    let share = |i: u32| f64::from(i) / f64::from(POINTS - 1);
    (0..POINTS).map(move |i| from * (1.0 - share(i)) + to * share(i))
}

fn curve(label: impl Into<String>, points: impl Iterator<Item = [f64; 2]>) -> Curve {
    Curve { label: label.into(), points: points.collect() }
}

/// Fig. 5: the polar, its tangent from the origin, and the two marked glides.
#[must_use]
pub fn polar(polar: &Polar) -> Panel {
    let best = polar.best_glide();
    let marked = |point: PolarPoint| [[point.drag_coefficient, point.lift_coefficient]].into_iter();
    let at = |lift: f64| [polar.at(lift).drag_coefficient, lift];
    let most = 2.0 * best.lift_coefficient;
    Panel {
        number: "5",
        title: format!("Drag polar; best glide {:.2}°", best.descent_rad.to_degrees()),
        x: "C_D",
        y: "C_L",
        curves: vec![
            curve("polar", along([0.0, most]).map(at)),
            curve("tangent", [0.0, 1.5].into_iter().map(|t| [t * best.drag_coefficient, t * best.lift_coefficient])),
            curve("best glide", marked(best)),
            curve("maximum horizontal speed", marked(polar.max_horizontal_speed())),
        ],
    }
}

/// Fig. 6: drag over lift and descent angle (deg) at maximum horizontal speed, against 2KC_D0.
#[must_use]
pub fn max_horizontal_speed() -> [Panel; 2] {
    let title = "Flight at maximum horizontal speed".to_string();
    // With C_D0 = 1, K = δ/2.
    let at = |delta: f64| Polar { c_d_zero: 1.0, c_d_induced: 0.5 * delta }.max_horizontal_speed();
    let panel = |number, y, of: fn(PolarPoint) -> f64| {
        let points = along([0.0, 1.0]).map(|delta| [delta, of(at(delta))]);
        Panel { number, title: title.clone(), x: "2KC_D0", y, curves: vec![curve(y, points)] }
    };
    [
        panel("6 left", "drag over lift", |point| 1.0 / point.lift_to_drag),
        panel("6 right", "descent angle, °", |point| point.descent_rad.to_degrees()),
    ]
}

/// Fig. 7: required lung capacity (%) against V_md, one panel per varied parameter.
#[must_use]
pub fn lung_capacity(sizing: &Sizing<'_>, hold: Hold) -> [Panel; 4] {
    let of = |size: &Size| size.lung_capacity.map(|eta| 100.0 * eta);
    let numbers = ["7a", "7b", "7c", "7d"];
    by_parameter(sizing, hold, numbers, ("Required lung capacity", "lung capacity, %"), of)
}

/// Fig. 8: largest lift over drag against V_md, one panel per varied parameter.
#[must_use]
pub fn lift_to_drag(sizing: &Sizing<'_>, hold: Hold) -> [Panel; 4] {
    let of = |size: &Size| Some(size.glide.lift_to_drag);
    by_parameter(sizing, hold, ["8a", "8b", "8c", "8d"], ("Maximum lift over drag", "lift over drag"), of)
}

fn by_parameter(
    sizing: &Sizing<'_>,
    hold: Hold,
    numbers: [&'static str; 4],
    (title, y): (&str, &'static str),
    of: impl Fn(&Size) -> Option<f64>,
) -> [Panel; 4] {
    let vehicle = sizing.study.vehicle;
    let nominal = Shape::of(vehicle);
    let family = |parameter: Parameter, value: f64| {
        let shape = hold.with(&nominal, parameter, value, vehicle.water.density_kg_m3);
        let at = |speed| sizing.at_speed(&shape, speed).ok().and_then(|size| of(&size)).map(|y| [speed, y]);
        curve(format!("{parameter} = {value}"), along(SPEEDS_M_S).filter_map(at))
    };
    std::array::from_fn(|i| {
        let (parameter, values) = VARIED[i];
        let curves = values.into_iter().map(|value| family(parameter, value)).collect();
        Panel { number: numbers[i], title: format!("{title} over {parameter}"), x: "V_md, m/s", y, curves }
    })
}

/// Fig. 9: displaced mass (kg) against length, at the vehicle's fineness.
#[must_use]
pub fn neutral_displacement(sizing: &Sizing<'_>) -> Panel {
    let vehicle = sizing.study.vehicle;
    let mut shape = Shape::of(vehicle);
    let fineness = shape.hull.fineness;
    let points = along([1.0, 2.0]).map(|length_m| {
        shape.hull.length_m = length_m;
        [length_m, vehicle.water.density_kg_m3 * shape.hull.volume_m3()]
    });
    Panel {
        number: "9",
        title: format!("Neutral displacement at fineness {fineness}"),
        x: "length, m",
        y: "displaced mass, kg",
        curves: vec![curve("(π/4) ρ l³/f²", points)],
    }
}

/// Fig. 10: number of dives, range (km) and endurance (days) against speed, an ideal and a realistic curve per depth.
#[must_use]
pub fn endurance(sizing: &Sizing<'_>, shape: &Shape, battery_j: f64, depths_m: &[f64], ocean: &Ocean) -> [Panel; 3] {
    let accounts: Vec<Vec<Endurance>> = depths_m
        .iter()
        .map(|depth_m| {
            let at = |speed| Endurance::new(sizing, shape, (speed, *depth_m, battery_j), ocean).ok();
            along(SPEEDS_M_S).filter_map(at).collect()
        })
        .collect();
    let panel = |number, y, of: fn(&super::Account) -> f64| {
        let curves = accounts.iter().zip(depths_m).flat_map(|(accounts, depth_m)| {
            let ideal = accounts.iter().map(|e| [e.size.speed_m_s, of(&e.ideal)]);
            let real = accounts.iter().filter_map(|e| Some([e.size.speed_m_s, of(&e.realistic.as_ref()?.account)]));
            [curve(format!("ideal, {depth_m} m"), ideal), curve(format!("realistic, {depth_m} m"), real)]
        });
        let title = format!("{:.0} kJ at the flattest glide", battery_j / 1e3);
        Panel { number, title, x: "speed, m/s", y, curves: curves.collect() }
    };
    [
        panel("10a", "dives", |account| account.dives),
        panel("10b", "range, km", |account| account.range_m / 1e3),
        panel("10c", "endurance, days", |account| account.endurance_s / 86_400.0),
    ]
}
