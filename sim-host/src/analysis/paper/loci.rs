//! Figures 12 to 15: root loci, and what sections 5.2 and 6 say of them.

use super::{
    Reproduction,
    comparison::{Reading, Trend},
};
use crate::analysis::{
    locus::{Locus, Varied, vary},
    modes::RollKinematics,
    trim::{Condition, Scale},
};
use crate::model::{
    coefficients::{Anchoring, Parameter, Study},
    vehicle::Vehicle,
};
use crate::pages::chart::{Figure, Line, Mark, Panel, Place, Scale as Axis, Stroke};

/// Section 5.2 keeps the speed for both flight conditions, m/s.
const SPEED_M_S: f64 = 0.77;
const POINTS: usize = 401;
const CONDITIONS: [(&str, Condition); 2] =
    [("maximum speed", Condition::MaxHorizontalSpeed), ("minimum glide angle", Condition::MinGlideAngle)];

/// One of the four figures.
struct Study4 {
    figure: &'static str,
    title: &'static str,
    varied: Varied,
    /// From the red circle to the blue square.
    range: [f64; 2],
    longitudinal: bool,
    says: &'static str,
    /// Whether the end of the range is said to be the more stable one.
    end_is_more_stable: bool,
}

const STUDIES: [Study4; 4] = [
    Study4 {
        figure: "fig12",
        title: "Fig 12  Longitudinal root locus, l_w from 0 to 0.2",
        varied: Varied::Shape(Parameter::WingPosition),
        range: [0.0, 0.2],
        longitudinal: true,
        says: "the farther aft the wing, the more stable the longitudinal dynamics",
        end_is_more_stable: true,
    },
    Study4 {
        figure: "fig13",
        title: "Fig 13  Lateral root locus, l_v from 0.5 to 1",
        varied: Varied::Shape(Parameter::FinPosition),
        range: [0.5, 1.0],
        longitudinal: false,
        says: "the farther aft the fin, the more stable the lateral dynamics",
        end_is_more_stable: true,
    },
    Study4 {
        figure: "fig14",
        title: "Fig 14  Lateral root locus, S_v from 0.5 to 1.2 of the frontal area",
        varied: Varied::Shape(Parameter::FinAreaRatio),
        range: [0.5, 1.2],
        longitudinal: false,
        says: "the larger the fin, the more stable the lateral dynamics",
        end_is_more_stable: true,
    },
    Study4 {
        figure: "fig15",
        title: "Fig 15  Lateral root locus, C_lβ from −0.8 to −0.2",
        varied: Varied::RollBySideslip,
        range: [-0.8, -0.2],
        longitudinal: false,
        says: "the more negative C_lβ, the more stable the lateral dynamics",
        end_is_more_stable: false,
    },
];

/// The four figures by their file names, and the trends.
///
/// # Errors
/// One line if a shape on the way is impossible or does not glide.
pub fn reproduce(vehicle: &Vehicle) -> Result<Reproduction, String> {
    let mut all = Reproduction::default();
    for study in &STUDIES {
        let anchored = study.loci(vehicle, Anchoring::Anchored)?;
        let readings =
            [(Anchoring::Anchored, &anchored), (Anchoring::Unanchored, &study.loci(vehicle, Anchoring::Unanchored)?)]
                .into_iter()
                .flat_map(|(anchoring, loci)| {
                    loci.iter().zip(CONDITIONS).map(move |(locus, (condition, _))| (anchoring, condition, locus))
                })
                .flat_map(|(anchoring, condition, locus)| {
                    study.readings(locus, &format!("{}, {condition}", name(anchoring)))
                })
                .collect();
        let panels = anchored.iter().zip(CONDITIONS).map(|(locus, (condition, _))| panel(condition, locus)).collect();
        all.figures.push((study.figure.to_owned(), Figure { title: study.title.into(), columns: 2, panels }));
        all.trends.push(Trend { place: format!("5.2, 6 ({})", study.figure), says: study.says.into(), readings });
    }
    Ok(all)
}

fn name(anchoring: Anchoring) -> &'static str {
    match anchoring {
        Anchoring::Anchored => "anchored on the identified coefficients",
        Anchoring::Unanchored => "coefficients from geometry alone",
    }
}

impl Study4 {
    /// At both flight conditions.
    fn loci(&self, vehicle: &Vehicle, anchoring: Anchoring) -> Result<[Locus; 2], String> {
        let study = Study { anchoring, ..Study::new(vehicle) };
        let locus = |(_, condition)| {
            let loci = vary(
                &study,
                self.varied,
                self.range,
                POINTS,
                condition,
                Scale::Speed(SPEED_M_S),
                RollKinematics::Exact,
            )?;
            Ok::<_, String>(if self.longitudinal { loci.longitudinal } else { loci.lateral })
        };
        let [fast, flat] = CONDITIONS;
        Ok([locus(fast)?, locus(flat)?])
    }

    /// "More stable", read for the slowest mode, for all of them together, and branch by branch.
    fn readings(&self, locus: &Locus, held: &str) -> Vec<Reading> {
        let ends = |branch: &Vec<[f64; 2]>| match (branch.first(), branch.last()) {
            (Some(first), Some(last)) if self.end_is_more_stable => [first[0], last[0]],
            (Some(first), Some(last)) => [last[0], first[0]],
            _ => [f64::NAN; 2],
        };
        let branches: Vec<[f64; 2]> = locus.branches.iter().map(ends).collect();
        let most = |end: usize| branches.iter().map(|branch| branch[end]).fold(f64::NEG_INFINITY, f64::max);
        let sum = |end: usize| branches.iter().map(|branch| branch[end]).sum::<f64>();
        let reading = |what: &str, [less, more]: [f64; 2]| Reading {
            reading: format!("{held}: {what}"),
            holds: more < less,
            found: format!("{less:+.4} → {more:+.4} 1/s"),
        };
        let mut readings = vec![
            reading("largest real part of all modes", [most(0), most(1)]),
            reading("sum of the real parts", [sum(0), sum(1)]),
        ];
        readings.extend(
            branches.iter().zip(1..).map(|(branch, number)| reading(&format!("real part of branch {number}"), *branch)),
        );
        readings
    }
}

/// A root locus: branches in their colours, from red circles to blue squares, the axis of stability dotted.
pub(crate) fn panel(title: &str, locus: &Locus) -> Panel {
    let ends = |branch: &Vec<[f64; 2]>| {
        let place = |at: Option<&[f64; 2]>, mark| at.map(|at| Place { at: *at, mark });
        [place(branch.first(), Mark::From), place(branch.last(), Mark::To)].into_iter().flatten().collect::<Vec<_>>()
    };
    let branch = |(colour, points): (usize, &Vec<[f64; 2]>)| Line {
        name: Some(format!("branch {}", colour + 1)),
        stroke: Stroke::Solid(colour),
        points: points.clone(),
    };
    let height = locus.branches.iter().flatten().map(|[_, im]| im.abs()).fold(0.1, f64::max) * 1.1;
    let stability = Line { name: None, stroke: Stroke::Aid, points: vec![[0.0, -height], [0.0, height]] };
    Panel {
        title: title.into(),
        x: Axis::around("real part, 1/s"),
        y: Axis::exactly("imaginary part, 1/s", [-height, height]),
        lines: std::iter::once(stability).chain(locus.branches.iter().enumerate().map(branch)).collect(),
        places: locus.branches.iter().flat_map(ends).collect(),
    }
}
