//! What is promised, and what was measured.

use serde::Serialize;

/// One promise beside its number.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Claim {
    /// What is promised, with its unit.
    pub what: String,
    /// What it may be.
    #[serde(flatten)]
    pub limit: Limit,
    /// What it is, where it is worst; nothing if nobody came to it.
    pub measured: Option<f64>,
    /// Of what it is the worst, or which quantile of it.
    pub over: String,
    /// Where it is worst.
    pub place: String,
    /// Whether it is so.
    pub holds: bool,
}

/// On which side of a number a value may be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Limit {
    /// No more than this.
    AtMost(f64),
    /// No less.
    AtLeast(f64),
}

impl Limit {
    /// Whether a value is worse than another; none at all is the worst.
    #[must_use]
    pub fn is_worse(self, value: f64, than: f64) -> bool {
        match self {
            Self::AtMost(_) => value > than || value.is_nan(),
            Self::AtLeast(_) => value < than || value.is_nan(),
        }
    }

    fn allows(self, value: f64) -> bool {
        match self {
            Self::AtMost(most) => value <= most,
            Self::AtLeast(least) => value >= least,
        }
    }
}

impl std::fmt::Display for Limit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::AtMost(most) => write!(f, "≤ {most}"),
            Self::AtLeast(least) => write!(f, "≥ {least}"),
        }
    }
}

impl Claim {
    /// Judges a value that was found `over` something at a place; what was not measured is not so.
    #[must_use]
    pub fn new(what: impl Into<String>, limit: Limit, value: f64, [over, place]: [String; 2]) -> Self {
        let measured = value.is_finite().then_some(value);
        Self {
            what: what.into(),
            limit,
            measured,
            over,
            place,
            holds: measured.is_some_and(|value| limit.allows(value)),
        }
    }

    /// Judges the worst of several values, each with its place; nothing of none.
    #[must_use]
    pub fn worst(what: impl Into<String>, limit: Limit, over: &str, values: Vec<(f64, String)>) -> Option<Self> {
        let worse = |one: (f64, String), other: (f64, String)| if limit.is_worse(one.0, other.0) { one } else { other };
        let (value, place) = values.into_iter().reduce(|known, value| worse(value, known))?;
        Some(Self::new(what, limit, value, [over.into(), place]))
    }

    /// The verdict in words.
    #[must_use]
    pub const fn verdict(&self) -> &'static str {
        if self.holds { "holds" } else { "does not hold" }
    }
}
