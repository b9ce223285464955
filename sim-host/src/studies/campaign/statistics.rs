//! Spreads over flights: sorting is all that quantiles take.

use serde::Serialize;

use super::{Flown, METRICS};
use crate::flight::Outcome;

/// How a figure is spread over flights.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Spread {
    /// A tenth of the flights is below.
    pub p10: f64,
    /// Half of them.
    pub median: f64,
    /// Nine tenths.
    pub p90: f64,
    /// The greatest, as less is better in every figure.
    pub worst: f64,
}

impl Spread {
    /// Of finite values in any order; nothing of none.
    #[must_use]
    pub fn new(values: impl IntoIterator<Item = f64>) -> Option<Self> {
        let sorted = sorted(values);
        let worst = *sorted.last()?;
        let [p10, median, p90] = [0.1, 0.5, 0.9].map(|share| quantile(&sorted, share));
        Some(Self { p10, median, p90, worst })
    }
}

/// Values, the least first.
pub(crate) fn sorted(values: impl IntoIterator<Item = f64>) -> Vec<f64> {
    let mut sorted: Vec<f64> = values.into_iter().collect();
    sorted.sort_by(f64::total_cmp);
    sorted
}

/// Linear between the sorted values, of which the first is the quantile 0 and the last the quantile 1: type 7 of Hyndman &
/// Fan, "Sample quantiles in statistical packages", The American Statistician 50(4), 1996.
pub(crate) fn quantile(sorted: &[f64], share: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else { return f64::NAN };
    let place = share.clamp(0.0, 1.0) * last as f64;
    let below = place as usize;
    let above = (below + 1).min(last);
    sorted[below] + (sorted[above] - sorted[below]) * (place - below as f64)
}

/// All flights of one pilot in one water.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Tally {
    /// Name of the water.
    pub environment: String,
    /// Name of the pilot.
    pub pilot: &'static str,
    /// How many flew.
    pub flights: usize,
    /// How many completed the mission; the spreads are over these.
    pub completed: usize,
    /// In the order of [`METRICS`].
    #[serde(serialize_with = "by_name")]
    pub spreads: Vec<Option<Spread>>,
}

/// The tallies of a campaign, in the order of its flights.
#[must_use]
pub fn tallies(flown: &[Flown]) -> Vec<Tally> {
    parties(flown).map(tally).collect()
}

/// The flights of each pilot in each water.
pub(crate) fn parties(flown: &[Flown]) -> impl Iterator<Item = &[Flown]> {
    flown.chunk_by(|a, b| (&a.water, a.pilot) == (&b.water, b.pilot))
}

/// One figure of all completed flights.
pub(super) fn values(party: &[Flown], metric: usize) -> impl Iterator<Item = f64> {
    let completed = party.iter().filter(|flight| flight.outcome == Outcome::Completed);
    completed.filter_map(move |flight| flight.values.get(metric).copied().flatten())
}

fn tally(party: &[Flown]) -> Tally {
    Tally {
        environment: party.first().map(|flight| flight.water.clone()).unwrap_or_default(),
        pilot: party.first().map_or("", |flight| flight.pilot),
        flights: party.len(),
        completed: party.iter().filter(|flight| flight.outcome == Outcome::Completed).count(),
        spreads: (0..METRICS.len()).map(|metric| Spread::new(values(party, metric))).collect(),
    }
}

/// An object with a spread under each figure's name.
fn by_name<S: serde::Serializer>(spreads: &[Option<Spread>], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_map(METRICS.iter().map(|metric| metric.name).zip(spreads))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_of_known_values() {
        // 0 to 100 in hundredths of the way: each quantile is its own percentage.
        let spread = Spread::new((0..=100).rev().map(f64::from)).unwrap();
        assert_eq!(spread, Spread { p10: 10.0, median: 50.0, p90: 90.0, worst: 100.0 });
        assert_eq!(Spread::new([3.0, 1.0]).map(|spread| spread.median), Some(2.0));
        assert_eq!(Spread::new([]), None);
    }
}
