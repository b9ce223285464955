//! A sampled loop around a linear plant: its eigenvalues, and how much more gain and delay it bears.
//!
//! The plant is carried from tick to tick exactly (zero-order hold: the actuator stands still during a tick). Once per
//! period the law sets the actuator's target from what was seen; the actuator is there some ticks later. State, sum and
//! targets after a period are then a matrix times those before it, and the loop is stable if all its eigenvalues lie inside
//! the unit circle (Åström & Wittenmark, "Computer-Controlled Systems", 3rd ed., 1997, sections 2.3 and 3.2).

use nalgebra::{DMatrix, DVector, RowDVector, Schur};
use serde::Serialize;

/// Greatest gain margin that is looked for.
const MOST_GAIN: f64 = 100.0;
/// Factor between two gains that are tried.
const GAIN_STEP: f64 = 1.02;
/// Halvings of the last step.
const HALVINGS: u32 = 30;
/// Greatest delay margin that is looked for, in periods.
const MOST_PERIODS: usize = 20;
/// What counts as zero below the diagonal, of entries around 1: delays make defective zeros, on which a finer one never ends.
const ZERO: f64 = 1e-12;
/// Iterations of the eigenvalue solver; it takes some tens.
const ITERATIONS: usize = 1_000;
/// Multiples of the unit matrix that are added before it begins.
const SHIFTS: [f64; 3] = [0.0, 0.37, -0.53];

/// How a law makes its target of what it sees, y, whose wanted value is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    /// −gain · y, as it is when the period begins.
    Proportional,
    /// −gain · the mean of y over the last period's ticks.
    ProportionalMean,
    /// The target before, less gain · the mean of y over the last period's ticks.
    IntegratedMean,
}

/// A plant, a law and an actuator.
#[derive(Clone, Debug, PartialEq)]
pub struct SampledLoop {
    /// Plant's state after a tick by the state before.
    pub step: DMatrix<f64>,
    /// Plant's state after a tick by the actuator's place.
    pub drive: DVector<f64>,
    /// What is seen, by the plant's state.
    pub seen: RowDVector<f64>,
    /// The law.
    pub law: Law,
    /// Its gain.
    pub gain: f64,
    /// Ticks between two looks, at least 1.
    pub period_ticks: usize,
    /// Ticks until the actuator has followed its target.
    pub delay_ticks: usize,
    /// Duration of a tick, s.
    pub tick_s: f64,
}

/// How stable a loop is.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Margins {
    /// Largest modulus of an eigenvalue over one period: below 1 if stable.
    pub spectral_radius: f64,
    /// Factor on the gain that makes it unstable; nothing if none up to 100 does, or if it already is.
    pub gain_margin: Option<f64>,
    /// Further delay that makes it unstable, s, in whole ticks; nothing if none up to 20 periods does, or if it already is.
    pub delay_margin_s: Option<f64>,
}

impl Margins {
    /// Whether the loop is stable.
    #[must_use]
    pub fn is_stable(&self) -> bool {
        self.spectral_radius < 1.0
    }
}

/// A plant ẋ = A x + b u over a time with u held: x after it by x before, and by u.
#[must_use]
pub fn held(a: &DMatrix<f64>, b: &DVector<f64>, time_s: f64) -> (DMatrix<f64>, DVector<f64>) {
    let size = a.nrows();
    let mut both = DMatrix::zeros(size + 1, size + 1);
    both.view_mut((0, 0), (size, size)).copy_from(a);
    both.view_mut((0, size), (size, 1)).copy_from(b);
    let both = (both * time_s).exp();
    (both.view((0, 0), (size, size)).into_owned(), both.view((0, size), (size, 1)).column(0).into_owned())
}

impl SampledLoop {
    /// Its margins.
    ///
    /// # Errors
    /// One line if eigenvalues cannot be found.
    pub fn margins(&self) -> Result<Margins, String> {
        let spectral_radius = self.radius(1.0, 0)?;
        let stable = spectral_radius < 1.0;
        Ok(Margins {
            spectral_radius,
            gain_margin: if stable { self.gain_margin()? } else { None },
            delay_margin_s: if stable { self.delay_margin_s()? } else { None },
        })
    }

    fn gain_margin(&self) -> Result<Option<f64>, String> {
        let mut stable = 1.0;
        while self.radius(stable * GAIN_STEP, 0)? < 1.0 {
            stable *= GAIN_STEP;
            if stable > MOST_GAIN {
                return Ok(None);
            }
        }
        let mut unstable = stable * GAIN_STEP;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (stable + unstable);
            *(if self.radius(middle, 0)? < 1.0 { &mut stable } else { &mut unstable }) = middle;
        }
        Ok(Some(unstable))
    }

    fn delay_margin_s(&self) -> Result<Option<f64>, String> {
        for further in 1..=MOST_PERIODS * self.period_ticks {
            if self.radius(1.0, further)? >= 1.0 {
                return Ok(Some(further as f64 * self.tick_s));
            }
        }
        Ok(None)
    }

    /// Largest modulus of an eigenvalue with another gain, and with further ticks of delay.
    fn radius(&self, gain_factor: f64, further_ticks: usize) -> Result<f64, String> {
        let matrix = self.over_a_period(gain_factor * self.gain, self.delay_ticks + further_ticks);
        let shifted = |shift: f64| {
            let schur =
                Schur::try_new(&matrix + DMatrix::identity(matrix.nrows(), matrix.ncols()) * shift, ZERO, ITERATIONS)?;
            Some(schur.complex_eigenvalues().iter().map(|value| (value - shift).norm()).fold(0.0, f64::max))
        };
        // The solver's own shifts may run in circles; from elsewhere they do not.
        SHIFTS.into_iter().find_map(shifted).ok_or_else(|| "no eigenvalues of a sampled loop".into())
    }

    /// The loop's state after a period by the one before: plant, sum of what is seen, targets from the newest on.
    fn over_a_period(&self, gain: f64, delay_ticks: usize) -> DMatrix<f64> {
        let (periods, ticks) = (delay_ticks / self.period_ticks, delay_ticks % self.period_ticks);
        let plant = self.step.nrows();
        let (sum, newest) = (plant, plant + 1);
        let targets = periods + 2;
        let size = newest + targets;

        let mut decide = DMatrix::zeros(size, size);
        decide.view_mut((0, 0), (plant, plant)).fill_with_identity();
        for age in 1..targets {
            decide[(newest + age, newest + age - 1)] = 1.0;
        }
        match self.law {
            Law::Proportional => decide.view_mut((newest, 0), (1, plant)).copy_from(&(&self.seen * -gain)),
            Law::ProportionalMean => decide[(newest, sum)] = -gain / self.period_ticks as f64,
            Law::IntegratedMean => {
                decide[(newest, newest)] = 1.0;
                decide[(newest, sum)] = -gain / self.period_ticks as f64;
            }
        }

        let tick = |age: usize| {
            let mut tick = DMatrix::identity(size, size);
            tick.view_mut((0, 0), (plant, plant)).copy_from(&self.step);
            tick.view_mut((0, newest + age), (plant, 1)).copy_from(&self.drive);
            tick.view_mut((sum, 0), (1, plant)).copy_from(&self.seen);
            tick
        };
        power(tick(periods), self.period_ticks - ticks) * power(tick(periods + 1), ticks) * decide
    }
}

/// A matrix times itself.
fn power(mut matrix: DMatrix<f64>, mut times: usize) -> DMatrix<f64> {
    let mut product = DMatrix::identity(matrix.nrows(), matrix.nrows());
    while times > 0 {
        if times % 2 == 1 {
            product *= &matrix;
        }
        matrix = &matrix * &matrix;
        times /= 2;
    }
    product
}

#[cfg(test)]
mod tests {
    use super::*;

    const TICK_S: f64 = 0.25;

    /// ẋ = u, sampled: all its margins are known in closed form.
    fn integrator(law: Law, gain: f64, period_ticks: usize) -> SampledLoop {
        let (step, drive) = held(&DMatrix::zeros(1, 1), &DVector::from_element(1, 1.0), TICK_S);
        let seen = RowDVector::from_element(1, 1.0);
        SampledLoop { step, drive, seen, law, gain, period_ticks, delay_ticks: 0, tick_s: TICK_S }
    }

    /// x⁺ = (1 − k T) x.
    #[test]
    fn an_integrator_overshoots_by_its_gain() {
        let margins = integrator(Law::Proportional, 0.1, 16).margins().unwrap();
        assert!((margins.spectral_radius - 0.6).abs() < 1e-12, "{margins:?}");
        assert!((margins.gain_margin.unwrap() - 5.0).abs() < 1e-6, "{margins:?}");
    }

    /// With one period of delay z² − z + k T = 0 has |z| = 1 at k T = 1. At kT = 1/2 two periods are stable no more:
    /// z³ − z² + 1/2 has its pair at |z|² = 1/0.5652 · 1/2 … below 1, and z^(d+1) = z^d − kT reaches the circle where
    /// 2 sin(π/(2(2d + 1))) = kT (Levin & May, 1976): at d = 2 for 0.618, at d = 3 for 0.445.
    #[test]
    fn a_delayed_integrator_follows_levin_and_may() {
        for (product, periods) in [(0.99, 2), (0.63, 2), (0.61, 3), (0.46, 3), (0.44, 4)] {
            let margins = integrator(Law::Proportional, product / TICK_S, 1).margins().unwrap();
            assert_eq!(margins.delay_margin_s, Some(f64::from(periods) * TICK_S), "{product}");
        }
        let delayed = SampledLoop { delay_ticks: 16, ..integrator(Law::Proportional, 0.1, 16) };
        assert!((delayed.margins().unwrap().gain_margin.unwrap() - 2.5).abs() < 1e-6);
    }

    /// A plant that follows its actuator within a tick, under an integrating law of gain k: z = 1 − k but for the first of a
    /// period's ticks, which still shows the place before: z² − (1 − k (n − 1)/n) z + k/n = 0.
    #[test]
    fn a_mean_is_taken_over_the_ticks_of_a_period() {
        let (gain, ticks) = (0.6, 8);
        let follows = SampledLoop {
            step: DMatrix::zeros(1, 1),
            drive: DVector::from_element(1, 1.0),
            ..integrator(Law::IntegratedMean, gain, ticks)
        };
        let n = ticks as f64;
        let (half, last): (f64, f64) = (0.5 * (1.0 - gain * (n - 1.0) / n), gain / n);
        let expected = if half * half < last { last.sqrt() } else { half.abs() + (half * half - last).sqrt() };
        assert!((follows.margins().unwrap().spectral_radius - expected).abs() < 1e-9);
    }

    /// ẋ = −x + u over a second with u held: e⁻¹ and 1 − e⁻¹.
    #[test]
    fn a_lag_is_carried_on_exactly() {
        let (step, drive) = held(&DMatrix::from_element(1, 1, -1.0), &DVector::from_element(1, 1.0), 1.0);
        let e = (-1.0_f64).exp();
        assert!((step[(0, 0)] - e).abs() < 1e-15 && (drive[0] - (1.0 - e)).abs() < 1e-15);
    }
}
