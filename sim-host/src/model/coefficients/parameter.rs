//! The geometric parameters by the names that the vehicle file gives them.

use std::{fmt, str::FromStr};

use super::Shape;
use crate::files::toml_file::Rule;

/// One number of a [`Shape`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "documented where they stand: `Hull`, `Wing`, `Fin`")]
pub enum Parameter {
    HullLength,
    HullFineness,
    WingAspectRatio,
    WingSpanRatio,
    WingThicknessRatio,
    WingPosition,
    WingSweep,
    WingDihedral,
    WingHeight,
    FinAreaRatio,
    FinPosition,
    FinAspectRatio,
    FinThicknessRatio,
    FinHeight,
}

impl Parameter {
    /// All of them, in the file's order.
    pub const ALL: [Self; 14] = [
        Self::HullLength,
        Self::HullFineness,
        Self::WingAspectRatio,
        Self::WingSpanRatio,
        Self::WingThicknessRatio,
        Self::WingPosition,
        Self::WingSweep,
        Self::WingDihedral,
        Self::WingHeight,
        Self::FinAreaRatio,
        Self::FinPosition,
        Self::FinAspectRatio,
        Self::FinThicknessRatio,
        Self::FinHeight,
    ];

    /// The key in the vehicle file, with its section.
    #[must_use]
    pub fn key(self) -> &'static str {
        match self {
            Self::HullLength => "hull.length_m",
            Self::HullFineness => "hull.fineness",
            Self::WingAspectRatio => "wing.aspect_ratio",
            Self::WingSpanRatio => "wing.span_ratio",
            Self::WingThicknessRatio => "wing.thickness_ratio",
            Self::WingPosition => "wing.position",
            Self::WingSweep => "wing.sweep_deg",
            Self::WingDihedral => "wing.dihedral_deg",
            Self::WingHeight => "wing.height_m",
            Self::FinAreaRatio => "fin.area_ratio",
            Self::FinPosition => "fin.position",
            Self::FinAspectRatio => "fin.aspect_ratio",
            Self::FinThicknessRatio => "fin.thickness_ratio",
            Self::FinHeight => "fin.height_m",
        }
    }

    /// What the vehicle file accepts for it.
    #[must_use]
    pub fn rule(self) -> Rule {
        match self {
            Self::HullLength | Self::WingAspectRatio | Self::FinAspectRatio => Rule::Positive,
            Self::HullFineness | Self::WingSpanRatio => Rule::Above(1.0),
            Self::WingThicknessRatio | Self::FinThicknessRatio => Rule::Within(0.0, 1.0),
            Self::WingPosition | Self::FinPosition => Rule::Within(-1.0, 1.0),
            Self::WingSweep | Self::WingDihedral => Rule::Within(-80.0, 80.0),
            Self::WingHeight | Self::FinHeight => Rule::Finite,
            Self::FinAreaRatio => Rule::NotNegative,
        }
    }

    /// Whether a value is possible.
    ///
    /// # Errors
    /// One line that says what would be right.
    pub fn check(self, value: f64) -> Result<(), String> {
        let rule = self.rule();
        if rule.holds(value) { Ok(()) } else { Err(format!("`{self}` is {value}, but must be {rule}")) }
    }

    /// Where it stands in a shape.
    pub fn of<T>(self, shape: &mut Shape<T>) -> &mut T {
        let Shape { hull, wing, fin } = shape;
        match self {
            Self::HullLength => &mut hull.length_m,
            Self::HullFineness => &mut hull.fineness,
            Self::WingAspectRatio => &mut wing.aspect_ratio,
            Self::WingSpanRatio => &mut wing.span_ratio,
            Self::WingThicknessRatio => &mut wing.thickness_ratio,
            Self::WingPosition => &mut wing.position,
            Self::WingSweep => &mut wing.sweep_deg,
            Self::WingDihedral => &mut wing.dihedral_deg,
            Self::WingHeight => &mut wing.height_m,
            Self::FinAreaRatio => &mut fin.area_ratio,
            Self::FinPosition => &mut fin.position,
            Self::FinAspectRatio => &mut fin.aspect_ratio,
            Self::FinThicknessRatio => &mut fin.thickness_ratio,
            Self::FinHeight => &mut fin.height_m,
        }
    }
}

impl fmt::Display for Parameter {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.key())
    }
}

impl FromStr for Parameter {
    type Err = String;

    fn from_str(key: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|parameter| parameter.key() == key).ok_or_else(|| {
            let known: Vec<_> = Self::ALL.iter().map(|parameter| parameter.key()).collect();
            format!("`{key}` is no geometric parameter; known: {}", known.join(", "))
        })
    }
}
