//! Constrained search by COBYLA (Powell 1994) from several places.
//!
//! Drag jumps where a flow turns turbulent, so linear models of figures are wrong there: hence starts on both sides, and of all
//! geometries that were tried the best one counts, not the last.

use std::cell::RefCell;

use super::{Candidate, Constraint, Maker, Objective};

/// Starts besides the vehicle itself and the middle of the bounds.
const SCATTERED: u32 = 4;
/// Evaluations from one start.
const MOST_EVALUATIONS: usize = 220;
/// First steps, and those from the best place again, as shares of the bounds.
const FIRST_STEPS: [f64; 2] = [0.25, 0.05];
/// Steps at which a search ends.
const LAST_STEP: f64 = 1e-4;
/// Shortfall of a constraint, over its scale, that counts as met.
pub(super) const MET: f64 = 1e-6;
/// What a geometry without a glide counts, for every constraint and beyond the objective of any other.
const NO_GLIDE: f64 = 10.0;

/// A geometry with its place within the bounds.
#[derive(Clone, Debug)]
pub(super) struct Found {
    pub(super) place: Vec<f64>,
    pub(super) candidate: Candidate,
    /// Largest shortfall of all constraints, over their scales.
    pub(super) shortfall: f64,
}

/// What is maximised, and what must be kept.
pub(super) struct Search<'a> {
    pub(super) maker: &'a Maker<'a>,
    /// Without one, the constraints themselves are what counts.
    pub(super) objective: Option<Objective>,
    pub(super) constraints: &'a [Constraint],
}

/// The last evaluation, and the best of all.
#[derive(Default)]
struct Memory {
    place: Vec<f64>,
    cost: f64,
    slacks: Vec<f64>,
    best: Option<Found>,
}

impl Search<'_> {
    /// The best geometry, or else the one that comes nearest to the constraints; none where no geometry glides.
    pub(super) fn run(&self, more_starts: &[Vec<f64>]) -> Option<Found> {
        let memory = RefCell::new(Memory::default());
        let starts = [self.maker.nominal(), vec![0.5; self.maker.free.len()]];
        let scattered = (1..=SCATTERED).map(|index| halton(index, self.maker.free.len()));
        for start in more_starts.iter().cloned().chain(starts).chain(scattered) {
            self.descend(&memory, &start, FIRST_STEPS[0]);
        }
        let best = memory.borrow().best.as_ref().map(|best| best.place.clone());
        if let Some(place) = best {
            self.descend(&memory, &place, FIRST_STEPS[1]);
        }
        memory.into_inner().best
    }

    /// From the given places only: where a neighbour's answer is known.
    pub(super) fn run_from(&self, starts: &[Vec<f64>]) -> Option<Found> {
        let memory = RefCell::new(Memory::default());
        for start in starts {
            for step in FIRST_STEPS {
                self.descend(&memory, start, step);
            }
        }
        memory.into_inner().best
    }

    fn descend(&self, memory: &RefCell<Memory>, start: &[f64], step: f64) {
        let cost = |place: &[f64], _: &mut ()| self.evaluated(memory, place, |memory| memory.cost);
        let slack = |index: usize| {
            move |place: &[f64], _: &mut ()| {
                self.evaluated(memory, place, |memory| memory.slacks.get(index).copied().unwrap_or(0.0))
            }
        };
        let slacks: Vec<_> = (0..self.constraints.len()).map(slack).collect();
        let tolerances = cobyla::StopTols { xtol_abs: vec![LAST_STEP; start.len()], ..Default::default() };
        let bounds = vec![(0.0, 1.0); start.len()];
        let steps = cobyla::RhoBeg::All(step);
        // How it ends does not matter: the memory has the best of everything that was tried.
        let _ = cobyla::minimize(cost, start, &bounds, &slacks, (), MOST_EVALUATIONS, steps, Some(tolerances));
    }

    /// Something of the evaluation at a place, which is done once.
    fn evaluated(&self, memory: &RefCell<Memory>, place: &[f64], of: impl Fn(&Memory) -> f64) -> f64 {
        let mut memory = memory.borrow_mut();
        if memory.place != place || memory.slacks.len() != self.constraints.len() {
            self.evaluate(&mut memory, place);
        }
        of(&memory)
    }

    fn evaluate(&self, memory: &mut Memory, place: &[f64]) {
        memory.place = place.to_vec();
        // The library may ask a hair outside of the bounds.
        let place: Vec<f64> = place.iter().map(|share| share.clamp(0.0, 1.0)).collect();
        let Ok(candidate) = self.maker.at(&place) else {
            memory.cost = NO_GLIDE;
            memory.slacks = vec![-NO_GLIDE; self.constraints.len()];
            return;
        };
        memory.slacks = self.constraints.iter().map(|constraint| constraint.slack(&candidate)).collect();
        let shortfall = memory.slacks.iter().fold(0.0_f64, |most, slack| most.max(-slack));
        // A logarithm has no unit: a hundredth of any figure counts the same.
        memory.cost =
            self.objective.map_or(0.0, |objective| -libm::log(candidate.value(objective).max(f64::MIN_POSITIVE)));
        let found = Found { place, candidate, shortfall };
        if memory.best.as_ref().is_none_or(|best| self.is_better(&found, best)) {
            memory.best = Some(found);
        }
    }

    fn is_better(&self, new: &Found, old: &Found) -> bool {
        let (new_meets, old_meets) = (new.shortfall <= MET, old.shortfall <= MET);
        match self.objective {
            Some(objective) if new_meets && old_meets => {
                new.candidate.value(objective) > old.candidate.value(objective)
            }
            _ => new.shortfall < old.shortfall && !old_meets,
        }
    }
}

/// A place that is far from its neighbours: Halton's sequence, in the bases of the first primes.
fn halton(index: u32, dimensions: usize) -> Vec<f64> {
    const PRIMES: [u32; 14] = [2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43];
    let radical_inverse = |base: u32| {
        let (mut left, mut share, mut sum) = (index, 1.0, 0.0);
        while left > 0 {
            share /= f64::from(base);
            sum += share * f64::from(left % base);
            left /= base;
        }
        sum
    };
    PRIMES.into_iter().cycle().take(dimensions).map(radical_inverse).collect()
}
