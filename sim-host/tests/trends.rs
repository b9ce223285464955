//! The trends that sections 4.2.1 and 6 of the paper state: where they hold, and what happens where they do not.

use sim_host::{
    analysis::{
        paper::performance::VARIED,
        performance::{Hold, Size, Sizing},
    },
    model::{
        coefficients::{Anchoring, Parameter, Shape, Study},
        vehicle::Vehicle,
    },
};

const HOLDS: [Hold; 2] = [Hold::Geometry, Hold::Displacement(52.0)];

/// Pairs of neighbours, the parameter growing, whose every surface has the same flow, at 17 speeds of the paper's figures.
fn neighbours(anchoring: Anchoring, hold: Hold, parameter: Parameter) -> Vec<(Size, Size)> {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let sizing = Sizing { study: Study { anchoring, ..Study::new(&vehicle) } };
    let (_, values) = VARIED.into_iter().find(|(varied, _)| *varied == parameter).unwrap();
    let mut pairs = Vec::new();
    for step in 0..=16 {
        let sizes = values.map(|value| {
            let shape = hold.with(&Shape::of(&vehicle), parameter, value, 1000.0);
            sizing.at_speed(&shape, 0.2 + 0.05 * f64::from(step)).unwrap()
        });
        pairs.extend(sizes.windows(2).map(|pair| (pair[0], pair[1])).filter(|(a, b)| a.flows_like(b)));
    }
    assert!(pairs.len() > 30, "{parameter}: {} pairs", pairs.len());
    pairs
}

/// How a figure of the size changes along each pair, relative.
fn changes(pairs: &[(Size, Size)], of: impl Fn(&Size) -> f64) -> Vec<f64> {
    pairs.iter().map(|(a, b)| of(b) / of(a) - 1.0).collect()
}

fn lung(size: &Size) -> f64 {
    size.lung_capacity.unwrap()
}

fn lift_to_drag(size: &Size) -> f64 {
    size.glide.lift_to_drag
}

fn grows(changes: &[f64]) -> bool {
    changes.iter().all(|change| *change > 0.0)
}

fn falls(changes: &[f64]) -> bool {
    changes.iter().all(|change| *change < 0.0)
}

fn mean_size(changes: &[f64]) -> f64 {
    changes.iter().map(|change| change.abs()).sum::<f64>() / changes.len() as f64
}

#[test]
fn a_longer_hull_a_higher_aspect_ratio_and_a_smaller_span_need_less_lung() {
    for hold in HOLDS {
        let of = |parameter| changes(&neighbours(Anchoring::Unanchored, hold, parameter), lung);
        assert!(falls(&of(Parameter::HullLength)), "{hold:?}");
        assert!(falls(&of(Parameter::WingAspectRatio)), "{hold:?}");
        assert!(grows(&of(Parameter::WingSpanRatio)), "{hold:?}");
    }
}

/// Section 4.2.1 says less. At one length a finer hull is thinner, and has less lung to a percent; at 52 kg it is longer.
#[test]
fn a_finer_hull_needs_less_lung_at_one_mass_and_more_at_one_length() {
    let of = |hold| changes(&neighbours(Anchoring::Unanchored, hold, Parameter::HullFineness), lung);
    assert!(falls(&of(Hold::Displacement(52.0))));
    assert!(grows(&of(Hold::Geometry)));
}

#[test]
fn lift_over_drag_grows_with_span() {
    for hold in HOLDS {
        assert!(grows(&changes(&neighbours(Anchoring::Unanchored, hold, Parameter::WingSpanRatio), lift_to_drag)));
        assert!(grows(&changes(&neighbours(Anchoring::Anchored, hold, Parameter::WingSpanRatio), lift_to_drag)));
    }
}

/// Section 4.2.1 says that longer hulls raise it, section 6 (at given mass) that they lower it: both are right.
#[test]
fn lift_over_drag_grows_with_length_at_one_fineness_and_falls_at_one_mass() {
    for anchoring in [Anchoring::Unanchored, Anchoring::Anchored] {
        let of = |hold| changes(&neighbours(anchoring, hold, Parameter::HullLength), lift_to_drag);
        assert!(grows(&of(Hold::Geometry)));
        assert!(falls(&of(Hold::Displacement(52.0))));
    }
}

/// Section 4.2.1 calls lift over drag less sensitive to fineness and aspect ratio than to length and span ratio. It is to
/// aspect ratio; to fineness it is less than to span ratio, but at one geometry more than to length.
#[test]
fn lift_over_drag_hardly_depends_on_aspect_ratio_yet_on_fineness() {
    for hold in HOLDS {
        let of = |parameter| mean_size(&changes(&neighbours(Anchoring::Unanchored, hold, parameter), lift_to_drag));
        let (length, span) = (of(Parameter::HullLength), of(Parameter::WingSpanRatio));
        let (fineness, aspect) = (of(Parameter::HullFineness), of(Parameter::WingAspectRatio));
        assert!(aspect < length && aspect < 0.2 * span, "{hold:?}");
        assert!(fineness < 0.5 * span, "{hold:?}");
        assert_eq!(fineness < length, hold != Hold::Geometry, "{hold:?}");
    }
}

/// The identified K is five times the estimate for this aspect ratio: most of it stays when the wing grows slender.
#[test]
fn anchored_on_slocum_lift_over_drag_falls_with_aspect_ratio() {
    for hold in HOLDS {
        assert!(falls(&changes(&neighbours(Anchoring::Anchored, hold, Parameter::WingAspectRatio), lift_to_drag)));
    }
}

/// Section 6, at given mass and lung capacity: a lung of 0.2 %, which leaves every flow laminar.
#[test]
fn at_one_mass_and_lung_long_fine_hulls_with_short_slender_wings_are_fastest() {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let sizing = Sizing { study: Study { anchoring: Anchoring::Unanchored, ..Study::new(&vehicle) } };
    for (parameter, values) in VARIED {
        let sizes = values.map(|value| {
            let shape = Hold::Displacement(52.0).with(&Shape::of(&vehicle), parameter, value, 1000.0);
            sizing.at_lung_capacity(&shape, 0.002).unwrap()
        });
        let pairs: Vec<_> = sizes.windows(2).map(|pair| (pair[0], pair[1])).collect();
        assert!(pairs.iter().all(|(a, b)| a.flows_like(b)), "{parameter}");
        let speeds = changes(&pairs, |size| size.speed_m_s);
        assert!(if parameter == Parameter::WingSpanRatio { falls(&speeds) } else { grows(&speeds) }, "{parameter}");
    }
}
