//! What the trials show of one flight, and of what is known before one.

use std::num::NonZero;

use super::{Equipped, Picture, example, learning};
use crate::analysis::margins::{self, Envelope};
use crate::flight::NorthEast;
use crate::studies::{
    campaign::{Campaign, Flyer},
    plan::{self, Planned},
};

/// Most members of the ensemble that is planned with.
const MEMBERS: u64 = 64;

/// Pictures of single flights; `envelopes` are the margins of each vehicle.
///
/// # Errors
/// One line: what cannot be flown.
pub(super) fn draw(
    equipped: &[Equipped],
    seeds: u64,
    threads: NonZero<usize>,
    envelopes: &[(String, Envelope)],
) -> Result<Vec<Picture>, String> {
    let mut pictures = Vec::new();
    if let Some(first) = equipped.first() {
        let figure = first.with_campaign(1, |campaign| example::figure(first.trial.mission, campaign))?;
        let about = "One reversal, flown by both pilots: the same vehicle on the same day.";
        pictures.push(Picture { name: "example".into(), about: about.into(), figure });
    }
    if let Some(adrift) = equipped.iter().rfind(|one| one.trial.current_m_s > 0.0) {
        let name = adrift.trial.name;
        let figure = adrift.with_campaign(1, |campaign| learning::figure(name, campaign))?;
        let about = format!(
            "What the autopilot learns on {name}, in a current of {} m/s that nobody told it of. Each position fix after a \
             dive teaches current, speed and compass together; weight and drag are learned from the depth rate.",
            adrift.trial.current_m_s
        );
        pictures.push(Picture { name: "learning".into(), about, figure });
        pictures.push(planned(adrift, seeds, threads)?);
    }
    for (vehicle, envelope) in envelopes {
        let title = format!("{vehicle}: stability margins of pitch and heading");
        let about = format!("The loops' margins at every node of the trim table of {vehicle}.");
        let figure = margins::figure(&title, envelope);
        pictures.push(Picture { name: format!("margins-{vehicle}"), about, figure });
    }
    Ok(pictures)
}

/// Where a mission is planned to surface, with as many members as seeds, but three at least.
fn planned(adrift: &Equipped, seeds: u64, threads: NonZero<usize>) -> Result<Picture, String> {
    let members = seeds.clamp(3, MEMBERS);
    let plan = adrift.with_campaign(1, |&Campaign { vehicle, file, waters, current_m_s, .. }| {
        let water = waters.first().ok_or("no water to fly in")?;
        let autopilot = water.pilots.iter().find_map(|flyer| match flyer {
            Flyer::Autopilot(autopilot) => Some(autopilot.as_ref()),
            Flyer::Baseline(_) => None,
        });
        let autopilot = autopilot.ok_or("no autopilot to plan for")?;
        let ocean = &water.ocean;
        plan::plan(&Planned { vehicle, file, ocean, autopilot, current_m_s, seeds: 1..=members }, threads, |_| {})
    })?;
    let far_m = plan.nominal.surfacing.map_or(0.0, |NorthEast { north_m, east_m }| north_m.hypot(east_m));
    let about = format!(
        "The same mission planned, with {members} members in an unknown current: it comes up {far_m:.0} m from its start, \
         if nothing is off."
    );
    let title = format!("{}: where it will surface", adrift.trial.name);
    Ok(Picture { name: "plan".into(), about, figure: plan::figure(&title, &plan) })
}
