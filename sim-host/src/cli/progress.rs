//! Simulated time, depth and phase of a flight under way, or how many of a campaign have landed; on a terminal only.

use indicatif::{ProgressBar, ProgressStyle};
use shared::mission::Mission;

use crate::flight::{TICK_S, Tick};

/// Ticks between two looks: a flight runs a million ticks per second or so.
const EVERY_TICKS: u32 = 400;

/// The bar; it hides itself where stderr is no terminal.
pub(super) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    pub(super) fn new(mission: &Mission) -> Self {
        let bar = ProgressBar::new(u64::from(mission.total_yos()));
        let template = "{spinner} {msg} [{bar:30}] yo {pos}/{len}";
        bar.set_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()));
        Self { bar }
    }

    pub(super) fn show(&self, tick: &Tick<'_>) {
        if !tick.tick.is_multiple_of(EVERY_TICKS) || self.bar.is_hidden() {
            return;
        }
        let minutes = f64::from(tick.tick) * TICK_S / 60.0;
        let depth_m = tick.state.position_m.z;
        self.bar.set_position(u64::from(tick.commands.yo));
        self.bar.set_message(format!("{minutes:7.1} min {depth_m:6.1} m {:<9}", format!("{:?}", tick.commands.phase)));
    }

    pub(super) fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

/// A bar for many flights.
pub(super) fn flights(count: u64) -> ProgressBar {
    let bar = ProgressBar::new(count);
    let template = "{spinner} [{bar:30}] {pos}/{len} flights, {eta} left";
    bar.with_style(ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar()))
}
