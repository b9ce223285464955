//! What is promised of the models that the autopilot flies by.

use std::num::NonZero;

use super::{Claim, Equipped, GlideMargins, Limit};
use crate::analysis::{
    margins::{self, ENOUGH_GAIN, Envelope, Margins, Node},
    reduced_error::{self, Inflection, ModelError},
    table::{BOUND, InterpolationError, TableErrors, measure},
};

/// What is known of a vehicle's table, with the vehicle's name.
type OfTable = (String, InterpolationError);

/// What checking the models came to.
pub(super) struct Checked {
    /// What is promised of them.
    pub(super) claims: Vec<Claim>,
    /// The loops' margins in each mission's glides.
    pub(super) margins: Vec<GlideMargins>,
    /// And over the trim table of each vehicle, with its name.
    pub(super) envelopes: Vec<(String, Envelope)>,
}

/// Checks the tables, the reduced model and the loops of all vehicles that fly.
///
/// # Errors
/// One line: a motion that does not exist.
pub(super) fn check(equipped: &[Equipped], threads: NonZero<usize>) -> Result<Checked, String> {
    let (mut tables, mut glides) = (Vec::<OfTable>::new(), Vec::<GlideMargins>::new());
    let (mut envelopes, mut known) = (Vec::<(String, Envelope)>::new(), Vec::new());
    for one in equipped {
        let (mission, name, table) = (one.trial.mission, &one.vehicle.name, one.table()?);
        if !tables.iter().any(|(known, _)| known == name) {
            let TableErrors { dive, climb } = measure(&one.vehicle, &table)?;
            tables.push((name.clone(), dive.max(&climb)));
            let envelope = margins::margins(&one.vehicle, &table, &one.file.parameters, threads)?;
            envelopes.push((name.clone(), envelope));
        }
        for steady in margins::glides(&one.file.mission) {
            // Some missions share their glides.
            let glide = (name, steady.path_angle_rad.to_bits(), steady.net_mass_kg.to_bits());
            if !known.contains(&glide) {
                known.push(glide);
                let node = margins::at(&one.vehicle, &table, &one.file.parameters, steady)?;
                glides.push(GlideMargins { mission, node });
            }
        }
    }
    let inflections = reduced_error::inflections()?;
    let claims = of_tables(&tables).chain(of_reduced_model(&inflections)).chain(of_loops(&envelopes)).flatten();
    Ok(Checked { claims: claims.collect(), margins: glides, envelopes })
}

fn of_tables(tables: &[OfTable]) -> impl Iterator<Item = Option<Claim>> {
    type Part = fn(&InterpolationError) -> f64;
    let parts: [(&str, f64, Part); 4] = [
        ("trim table: speed, %", 100.0 * BOUND.speed, |error| 100.0 * error.speed),
        ("trim table: pitch, °", BOUND.angle_rad.to_degrees(), |error| error.pitch_rad.to_degrees()),
        ("trim table: angle of attack, °", BOUND.angle_rad.to_degrees(), |error| error.alpha_rad.to_degrees()),
        ("trim table: turn rate, %", 100.0 * BOUND.turn_rate, |error| 100.0 * error.turn_rate),
    ];
    parts.into_iter().map(|(what, most, part)| {
        let values = tables.iter().map(|(vehicle, error)| (part(error), vehicle.clone()));
        Claim::worst(what, Limit::AtMost(most), "middles of all cells", values.collect())
    })
}

fn of_reduced_model(inflections: &[Inflection]) -> impl Iterator<Item = Option<Claim>> {
    type Part = fn(&ModelError) -> f64;
    type Arithmetic = fn(&Inflection) -> &ModelError;
    let parts: [(&str, f64, Part); 2] = [
        ("speed, mm/s", 1e3 * reduced_error::BOUND.speed_m_s, |error| 1e3 * error.speed_m_s),
        ("depth, mm", 1e3 * reduced_error::BOUND.depth_m, |error| 1e3 * error.depth_m),
    ];
    let arithmetics: [(&str, Arithmetic); 2] = [("f32", |both| &both.float), ("fixed point", |both| &both.fixed)];
    let over = format!("{} inflections", inflections.len());
    let all = parts.into_iter().flat_map(move |part| arithmetics.map(|arithmetic| (part, arithmetic)));
    all.map(move |((what, most, part), (name, arithmetic))| {
        let values = inflections.iter().map(|both| (part(arithmetic(both)), both.pump.to_owned()));
        Claim::worst(format!("reduced model in {name}: {what}"), Limit::AtMost(most), &over, values.collect())
    })
}

fn of_loops(envelopes: &[(String, Envelope)]) -> impl Iterator<Item = Option<Claim>> {
    type Loop = fn(&Node) -> Margins;
    let loops: [(&str, Loop); 2] = [("pitch", |node| node.pitch), ("heading", |node| node.heading)];
    loops.into_iter().map(|(name, of)| {
        let nodes =
            || envelopes.iter().flat_map(|(vehicle, envelope)| envelope.nodes.iter().map(move |at| (vehicle, at)));
        let values = nodes().map(|(vehicle, node)| {
            (gain(of(node)), format!("{vehicle}, {:.1}°, {:.3} kg", node.path_angle_rad.to_degrees(), node.net_mass_kg))
        });
        let over = format!("{} nodes", nodes().count());
        Claim::worst(format!("gain margin of the {name} loop"), Limit::AtLeast(ENOUGH_GAIN), &over, values.collect())
    })
}

/// The gain margin: nothing left of a loop that is unstable, and a hundred where none was found.
fn gain(margins: Margins) -> f64 {
    const NONE_FOUND: f64 = 100.0;
    if margins.is_stable() { margins.gain_margin.unwrap_or(NONE_FOUND) } else { 0.0 }
}
