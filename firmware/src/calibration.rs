//! From the raw counts of a converter to device integers.

use shared::model::vehicle::Range;

/// A raw reading of the analogue converter.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Counts(pub u16);

/// A potentiometer that reads what no healthy one does: broken wire or short circuit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "defmt", derive(defmt::Format))]
pub struct Implausible(pub Counts);

/// A line through two calibrated points of a position potentiometer.
///
/// Positions are in the device integer of the actuator: µl, µm or 0.01°.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Line {
    low: (Counts, i32),
    high: (Counts, i32),
    healthy: (Counts, Counts),
}

impl Line {
    /// Through two points, believed between two readings. `None` if the points share a reading.
    #[must_use]
    pub fn new(low: (Counts, i32), high: (Counts, i32), healthy: (Counts, Counts)) -> Option<Self> {
        (low.0 != high.0).then_some(Self { low, high, healthy })
    }

    /// Maps the travel onto the middle of a converter of 4096 steps, with a tenth left at each end for faults to show.
    #[must_use]
    pub const fn over(travel: Range) -> Self {
        Self {
            low: (Counts(410), travel.min),
            high: (Counts(3_686), travel.max),
            healthy: (Counts(205), Counts(3_891)),
        }
    }

    /// The position that a reading stands for.
    ///
    /// # Errors
    /// [`Implausible`] outside the healthy readings.
    pub fn position(&self, reading: Counts) -> Result<i32, Implausible> {
        if reading < self.healthy.0 || reading > self.healthy.1 {
            return Err(Implausible(reading));
        }
        let counts = |to: Counts| i64::from(to.0).saturating_sub(i64::from(self.low.0.0));
        let rise = i64::from(self.high.1).saturating_sub(i64::from(self.low.1));
        // 12 bits of counts times 32 of position stay far inside 64.
        let scaled = rise.saturating_mul(counts(reading)).checked_div(counts(self.high.0)).unwrap_or(0);
        i32::try_from(i64::from(self.low.1).saturating_add(scaled)).map_err(|_| Implausible(reading))
    }

    /// The reading at a position, for whoever simulates the potentiometer.
    #[must_use]
    pub fn reading(&self, position: i32) -> Counts {
        let from_low = i64::from(position).saturating_sub(i64::from(self.low.1));
        let span = i64::from(self.high.0.0).saturating_sub(i64::from(self.low.0.0));
        let rise = i64::from(self.high.1).saturating_sub(i64::from(self.low.1));
        let counts = from_low.saturating_mul(span).checked_div(rise).unwrap_or(0);
        let reading = i64::from(self.low.0.0).saturating_add(counts);
        Counts(u16::try_from(reading).unwrap_or(if reading < 0 { 0 } else { u16::MAX }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRAVEL: Range = Range { min: -300_000, max: 300_000 };

    #[test]
    fn readings_and_positions_go_both_ways_within_a_count() {
        let line = Line::over(TRAVEL);
        for position in (TRAVEL.min..=TRAVEL.max).step_by(1_237) {
            let back = line.position(line.reading(position)).unwrap();
            assert!((back - position).abs() <= 600_000 / 3_276 + 1, "{position} came back as {back}");
        }
    }

    #[test]
    fn a_broken_wire_and_a_short_are_no_positions() {
        for raw in [0, 204, 3_892, 4_095] {
            assert_eq!(Line::over(TRAVEL).position(Counts(raw)), Err(Implausible(Counts(raw))));
        }
    }

    #[test]
    fn a_reversed_potentiometer_is_a_line_too() {
        let line = Line::new((Counts(3_000), 0), (Counts(1_000), 2_000), (Counts(500), Counts(3_500))).unwrap();
        assert_eq!(line.position(Counts(2_500)), Ok(500));
        assert_eq!(Line::new((Counts(7), 0), (Counts(7), 1), (Counts(0), Counts(9))), None);
    }
}
