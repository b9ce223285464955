//! Counts consecutive samples, so that a single bad one decides nothing.

/// Consecutive samples for which something held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Streak {
    samples: u32,
}

impl Streak {
    /// Takes a sample; tells whether it held for as many as are `needed`, this one included.
    ///
    /// No sample is no news: it neither adds to the streak nor ends it, and it never completes one.
    pub const fn take(&mut self, held: Option<bool>, needed: u32) -> bool {
        match held {
            Some(true) => self.samples = self.samples.saturating_add(1),
            Some(false) => self.samples = 0,
            None => return false,
        }
        self.samples >= needed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_good_sample_ends_a_streak_and_a_missing_one_does_not() {
        let mut streak = Streak::default();
        let mut take = |held| streak.take(held, 3);
        assert_eq!([Some(true), Some(true), Some(false), Some(true)].map(&mut take), [false; 4]);
        assert_eq!([None, Some(true), None, Some(true), Some(true)].map(&mut take), [false, false, false, true, true]);
    }

    #[test]
    fn no_streak_completes_without_a_sample() {
        assert!(!Streak::default().take(None, 0));
        assert!(!Streak::default().take(Some(false), 1));
    }
}
