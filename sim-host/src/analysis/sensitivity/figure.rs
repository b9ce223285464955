//! Ranked bars: one panel per figure of merit, what counts most on top.

use super::{Effect, Merit, Sensitivities};
use crate::pages::chart::{Figure, Line, Mark, Panel, Place, Scale, Stroke};

/// Rows that a panel has room for at least.
const LEAST_ROWS: usize = 8;
/// Share of the largest effect below which none is drawn.
const LEAST_SHARE: f64 = 0.003;
/// Effects below this are none, %.
const NOTHING: f64 = 1e-9;

/// One bar.
struct Bar {
    words: String,
    percent: f64,
    /// Whether the parameter is 0, so that its change is not relative.
    absolute: bool,
}

impl Sensitivities {
    /// The elasticities as bars; a figure on which no parameter has any effect is left out.
    #[must_use]
    pub fn figure(&self, title: &str) -> Figure {
        Figure { title: title.into(), columns: 3, panels: self.figures.iter().filter_map(panel).collect() }
    }
}

impl Effect {
    /// What a parameter that is 0 is changed by: 1°, 1 cm, or 1; with its words.
    #[must_use]
    pub fn small_change(&self) -> (f64, &'static str) {
        if self.parameter.ends_with("_deg") {
            (1.0, "°")
        } else if self.parameter.ends_with("_m") {
            (0.01, "cm")
        } else {
            (1.0, "1")
        }
    }
}

impl Merit {
    /// The parameters that matter, the most first, those that are 0 after the others.
    fn bars(&self) -> Vec<Bar> {
        let size = self.value.unwrap_or(f64::NAN).abs();
        let bar = |effect: &Effect| {
            let absolute = effect.at == 0.0;
            let (change, unit) = effect.small_change();
            let percent = if absolute { 100.0 * effect.derivative? * change / size } else { effect.elasticity? };
            let words = if absolute { format!("{} per {unit}", effect.parameter) } else { effect.parameter.into() };
            (percent.is_finite() && percent.abs() > NOTHING).then_some(Bar { words, percent, absolute })
        };
        let mut bars: Vec<Bar> = self.effects.iter().filter_map(bar).collect();
        let largest = bars.iter().map(|bar| bar.percent.abs()).fold(0.0, f64::max);
        bars.retain(|bar| bar.percent.abs() > LEAST_SHARE * largest);
        bars.sort_by(|a, b| a.absolute.cmp(&b.absolute).then(b.percent.abs().total_cmp(&a.percent.abs())));
        bars
    }
}

fn panel(merit: &Merit) -> Option<Panel> {
    let bars = merit.bars();
    let largest = bars.iter().map(|bar| bar.percent.abs()).reduce(f64::max)?;
    let rows = bars.len().max(LEAST_ROWS);
    let line = |(row, bar): (usize, &Bar)| Line {
        name: Some(if bar.absolute { "% per ° or cm, of what is 0" } else { "% per %" }.into()),
        stroke: Stroke::Bar(usize::from(bar.absolute)),
        points: vec![[0.0, row as f64], [bar.percent, row as f64]],
    };
    // The name stands on the other side of zero.
    let name = |(row, bar): (usize, &Bar)| Place {
        at: [0.0, row as f64],
        mark: if bar.percent > 0.0 { Mark::Before(bar.words.clone()) } else { Mark::After(bar.words.clone()) },
    };
    let zero = Line { name: None, stroke: Stroke::Aid, points: vec![[0.0, -0.7], [0.0, rows as f64]] };
    let value = merit.value.unwrap_or(f64::NAN);
    Some(Panel {
        title: format!("{}: {value:.4}", merit.meaning),
        x: Scale::exactly("change of the figure, %", [-1.08 * largest, 1.08 * largest]),
        y: Scale::rows(rows),
        lines: std::iter::once(zero).chain(bars.iter().enumerate().map(line)).collect(),
        places: bars.iter().enumerate().map(name).collect(),
    })
}
