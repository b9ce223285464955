//! What a number in a file may be.

use std::fmt;

use serde_json::{Value, json};

/// Bounds of a number; an infinite or undefined number never holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rule {
    /// Any finite number.
    Finite,
    /// More than zero.
    Positive,
    /// Zero or more.
    NotNegative,
    /// Zero or less.
    NotPositive,
    /// More than this.
    Above(f64),
    /// From the first to the second.
    Within(f64, f64),
}

impl Rule {
    /// Whether the value may stand.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        value.is_finite()
            && match self {
                Self::Finite => true,
                Self::Positive => value > 0.0,
                Self::NotNegative => value >= 0.0,
                Self::NotPositive => value <= 0.0,
                Self::Above(least) => value > least,
                Self::Within(least, most) => (least..=most).contains(&value),
            }
    }
}

impl Rule {
    /// The rule in the words of JSON Schema.
    pub(super) fn schema(self) -> Value {
        match self {
            Self::Finite => json!({ "type": "number" }),
            Self::Positive => json!({ "type": "number", "exclusiveMinimum": 0 }),
            Self::NotNegative => json!({ "type": "number", "minimum": 0 }),
            Self::NotPositive => json!({ "type": "number", "maximum": 0 }),
            Self::Above(least) => json!({ "type": "number", "exclusiveMinimum": least }),
            Self::Within(least, most) => json!({ "type": "number", "minimum": least, "maximum": most }),
        }
    }
}

impl fmt::Display for Rule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Finite => write!(f, "a finite number"),
            Self::Positive => write!(f, "a number above 0"),
            Self::NotNegative => write!(f, "a number of 0 or more"),
            Self::NotPositive => write!(f, "a number of 0 or less"),
            Self::Above(least) => write!(f, "a number above {least}"),
            Self::Within(least, most) => write!(f, "a number from {least} to {most}"),
        }
    }
}
