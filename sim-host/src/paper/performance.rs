//! Figures 5 to 10.
use super::comparison::{Row, Trend};
use crate::{chart::Figure, vehicle::Vehicle};
/// stub
pub fn reproduce(_: &Vehicle) -> Result<(Vec<(String, Figure)>, Vec<Row>, Vec<Trend>), String> {
    Ok((vec![], vec![], vec![]))
}
