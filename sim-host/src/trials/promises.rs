//! What is promised of flights.

use super::{Claim, Flights, Limit};
use crate::{
    campaign::{Flown, parties, quantile, sorted},
    flight::Outcome,
};

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

/// Which of many values counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantile {
    /// Half of them are no greater.
    Median,
    /// Nine tenths of them are no greater.
    P90,
    /// The greatest.
    Worst,
}

impl Quantile {
    fn of(self, values: Vec<f64>) -> f64 {
        let share = match self {
            Self::Median => 0.5,
            Self::P90 => 0.9,
            Self::Worst => 1.0,
        };
        quantile(&sorted(values), share)
    }
}

impl Measure {
    /// What is taken of the flights.
    const fn name(self) -> &'static str {
        match self {
            Self::Completed => "share",
            Self::Figure(_, Quantile::Median) | Self::OverBaseline(_, Quantile::Median) => "median",
            Self::Figure(_, Quantile::P90) | Self::OverBaseline(_, Quantile::P90) => "p90",
            Self::Figure(_, Quantile::Worst) | Self::OverBaseline(_, Quantile::Worst) => "worst",
        }
    }
}

const FAST: &[&str] = &["default", "fast-50"];
const SLOW: &[&str] = &["slow-200", "slow-1000"];
const SLOW_AND_SHALLOW: &[&str] = &["slow-50"];
const ALL: &[&str] = &["default", "fast-50", "slow-50", "slow-200", "slow-1000"];
const IN_CURRENT: &[&str] = &["default-in-current"];

const TOO_DEEP: Measure = Measure::Figure("apogee_over_percent", Quantile::Worst);
const TOO_SHALLOW: Measure = Measure::Figure("apogee_under_percent", Quantile::Worst);
const HEADING: &str = "heading_rms_deg";
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
    at_most(
        3.0,
        "heading on steady glides, half of the flights, ° rms",
        ALL,
        Measure::Figure(HEADING, Quantile::Median),
    ),
    at_most(
        3.0,
        "heading on steady glides, nine tenths of the flights, ° rms",
        ALL,
        Measure::Figure(HEADING, Quantile::P90),
    ),
    at_most(
        5.0,
        "surfacing predicted, first dive into an unknown 0.2 m/s, % of the way",
        IN_CURRENT,
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
