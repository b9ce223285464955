//! What is promised of flights.

use super::{Claim, Flights, Limit};
use crate::flight::Outcome;
use crate::studies::campaign::{Flown, parties, quantile, sorted};

/// A promise about the flights of some trials: it has to hold in each of their waters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Promise {
    /// What it says, with its unit.
    pub what: &'static str,
    /// For which trials, by their names.
    pub trials: &'static [&'static str],
    /// What is measured.
    pub measure: Measure,
    /// What it may be.
    pub limit: Limit,
}

/// What is measured of the autopilot's flights in one water.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Measure {
    /// How many completed their mission, %.
    Completed,
    /// A figure of a campaign.
    Figure(&'static str, Quantile),
    /// A figure over that of the baseline on the same seed, where both completed.
    OverBaseline(&'static str, Quantile),
}

/// What many values come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantile {
    /// Half of them are no greater.
    Median,
    /// Nine tenths of them are no greater.
    P90,
    /// The greatest.
    Worst,
    /// The root of their mean square: what holds for all flights together.
    Rms,
}

impl Quantile {
    fn of(self, values: Vec<f64>) -> f64 {
        let at = |share: f64| quantile(&sorted(values.iter().copied()), share);
        match self {
            Self::Median => at(0.5),
            Self::P90 => at(0.9),
            Self::Worst => at(1.0),
            Self::Rms => (values.iter().map(|value| value * value).sum::<f64>() / values.len() as f64).sqrt(),
        }
    }

    const fn name(self) -> &'static str {
        match self {
            Self::Median => "median",
            Self::P90 => "p90",
            Self::Worst => "worst",
            Self::Rms => "rms",
        }
    }
}

impl Measure {
    /// What is taken of the flights.
    const fn name(self) -> &'static str {
        match self {
            Self::Completed => "share",
            Self::Figure(_, quantile) | Self::OverBaseline(_, quantile) => quantile.name(),
        }
    }
}

const FAST: &[&str] = &["default", "fast-50"];
const SLOW: &[&str] = &["slow-200", "slow-1000"];
const SLOW_AND_SHALLOW: &[&str] = &["slow-50"];
const ALL: &[&str] = &["default", "fast-50", "slow-50", "slow-200", "slow-1000"];

const TOO_DEEP: Measure = Measure::Figure("apogee_over_percent", Quantile::Worst);
const TOO_SHALLOW: Measure = Measure::Figure("apogee_under_percent", Quantile::Worst);
const HEADING: Measure = Measure::Figure("heading_rms_deg", Quantile::Rms);
const BY_COMPASS: Measure = Measure::Figure("compass_rms_deg", Quantile::P90);
const SURFACING: &str = "surfacing_error_percent";

const fn at_most(most: f64, what: &'static str, trials: &'static [&'static str], measure: Measure) -> Promise {
    Promise { what, trials, measure, limit: Limit::AtMost(most) }
}

const fn at_least(least: f64, what: &'static str, trials: &'static [&'static str], measure: Measure) -> Promise {
    Promise { what, trials, measure, limit: Limit::AtLeast(least) }
}

const fn no_more_than_baseline(what: &'static str, metric: &'static str) -> Promise {
    at_most(1.0, what, ALL, Measure::OverBaseline(metric, Quantile::Median))
}

/// All of them.
pub const PROMISES: &[Promise] = &[
    at_least(100.0, "missions completed, %", ALL, Measure::Completed),
    at_most(2.0, "apogee too deep, fast pump to 50 and 200 m, % of target", FAST, TOO_DEEP),
    at_most(2.0, "apogee too shallow, fast pump to 50 and 200 m, % of target", FAST, TOO_SHALLOW),
    at_most(2.0, "apogee too deep, slow pump to 200 and 1000 m, % of target", SLOW, TOO_DEEP),
    at_most(2.0, "apogee too shallow, slow pump to 200 and 1000 m, % of target", SLOW, TOO_SHALLOW),
    at_most(4.0, "apogee too deep, slow pump to 50 m, % of target", SLOW_AND_SHALLOW, TOO_DEEP),
    at_most(4.0, "apogee too shallow, slow pump to 50 m, % of target", SLOW_AND_SHALLOW, TOO_SHALLOW),
    at_most(3.0, "heading on steady glides, all flights together, ° rms", ALL, HEADING),
    at_most(3.0, "heading as the compass shows it, nine tenths of the flights, ° rms", ALL, BY_COMPASS),
    at_most(
        5.0,
        "surfacing predicted, third dive on a heading, % of the way",
        &["legs"],
        Measure::Figure(SURFACING, Quantile::P90),
    ),
    at_most(
        5.0,
        "surfacing predicted, right after a turn of 60°, % of the way",
        &["turn"],
        Measure::Figure(SURFACING, Quantile::Median),
    ),
    at_most(
        5.0,
        "surfacing predicted, after two headings, % of the way",
        &["zigzag"],
        Measure::Figure(SURFACING, Quantile::P90),
    ),
    no_more_than_baseline("energy per km, over the baseline's", "energy_j_per_km"),
    no_more_than_baseline("moves of the pitch drive per km, over the baseline's", "pitch_moves_per_km"),
    no_more_than_baseline("moves of the roll drive per km, over the baseline's", "roll_moves_per_km"),
    no_more_than_baseline("moves of the pump per km, over the baseline's", "pump_moves_per_km"),
];

/// Judges a promise by the trial and water where it is worst; nothing if none of its trials was flown.
#[must_use]
pub fn judge(promise: &Promise, flights: &[Flights]) -> Option<Claim> {
    let trials = flights.iter().filter(|trial| promise.trials.contains(&trial.name));
    let of_autopilot = |party: &&[Flown]| party.iter().any(|flight| flight.pilot == "autopilot");
    let parties = trials.flat_map(|trial| parties(&trial.flown).filter(of_autopilot).map(move |party| (trial, party)));
    let parties: Vec<(&Flights, &[Flown])> = parties.collect();
    let (_, first) = parties.first()?;
    let each = if parties.len() > 1 { format!(", worst of {}", parties.len()) } else { String::new() };
    let over = format!("{} of {} flights{each}", promise.measure.name(), first.len());
    let value = |(trial, party): &(&Flights, &[Flown])| {
        let water = party.first().map_or("", |flight| flight.water.as_str());
        (value(promise.measure, party, &trial.flown), format!("{}, {water}", trial.name))
    };
    Claim::worst(promise.what, promise.limit, &over, parties.iter().map(value).collect())
}

/// What one pilot's flights in one water come to; not a number if there is none to judge by.
fn value(measure: Measure, party: &[Flown], trial: &[Flown]) -> f64 {
    let completed = |flight: &&Flown| flight.outcome == Outcome::Completed;
    match measure {
        Measure::Completed => 100.0 * party.iter().filter(completed).count() as f64 / party.len() as f64,
        Measure::Figure(name, quantile) => {
            quantile.of(party.iter().filter(completed).filter_map(|flight| flight.value(name)).collect())
        }
        Measure::OverBaseline(name, quantile) => {
            let opponent = |flight: &Flown| {
                let same = |other: &&Flown| {
                    (&other.water, other.seed, other.pilot) == (&flight.water, flight.seed, "baseline")
                };
                trial.iter().filter(completed).find(same)
            };
            let ratio = |flight: &Flown| Some(flight.value(name)? / opponent(flight)?.value(name)?);
            quantile.of(party.iter().filter(completed).filter_map(ratio).collect())
        }
    }
}
