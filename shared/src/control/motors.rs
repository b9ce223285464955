//! Whose turn it is: which motors run at the same time, so that together they draw no more than the supply bears.
//!
//! A pump draws tens of watts against the pressure at depth; a drive on top makes the voltage of an old or cold battery
//! sag below what ends a mission. Gliders therefore do one thing at a time: pitch, then buoyancy, then roll. So do the
//! motors here wherever the vehicle's peak power asks for it:
//!
//! * A move that is under way is finished before another starts.
//! * Of those that wait, the one that has waited longest is next; of those that began to wait together, pitch goes
//!   before buoyancy, and buoyancy before roll.
//! * When the vehicle is to come up, all of them start afresh, buoyancy first and with the longer turns.
//! * A turn is short while others wait: a slow pump lets attitude moves through, and a jammed drive keeps no pump from
//!   its work. What is left of the move follows at the next turn.

use core::cmp::Reverse;

use crate::device::TICK_HZ;
use crate::model::vehicle::MotorPower;

/// Longest turn of pump or bleed while others wait, s: a heading loop looks every 8 s, and should not wait for much
/// longer.
const BUOYANCY_TURN_S: u32 = 10;
/// Longest turn of a drive of the mass while others wait, s: at 1 cm/s the way from level to a climb of 26° takes 24 s.
const ATTITUDE_TURN_S: u32 = 30;
/// The same on the way up, s: even beside two jammed drives buoyancy has three quarters of the time.
const RISING_BUOYANCY_TURN_S: u32 = 60;
const RISING_ATTITUDE_TURN_S: u32 = 10;

/// For how long each motor has run or waited: the axial drive, the buoyancy device, the rotation drive.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Turns {
    standings: [Standing; 3],
    coming_up: bool,
}

/// Without a break; neither if it has nothing to do.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
struct Standing {
    ran_ticks: u32,
    waited_ticks: u32,
}

/// A motor that would run.
struct Request<'s> {
    standing: &'s mut Standing,
    draw_mw: u32,
    rank: Rank,
    runs: bool,
}

/// Who goes first: the smallest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Rank {
    claim: Claim,
    waited_ticks: Reverse<u32>,
    order: u8,
}

/// What a motor's wish to run rests on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Claim {
    /// It runs, and its turn is not over.
    UnderWay,
    /// It waits.
    Waiting,
    /// It runs, and its turn is over.
    Served,
    /// It does not wish to run.
    Idle,
}

impl Turns {
    /// Which of the motors run until the next tick, given the rates at which they would: at 0 there is nothing to do.
    ///
    /// All of them, if the vehicle has no peak power. Else together they draw that at most; a single one always may
    /// run.
    pub fn take(&mut self, power: &MotorPower, rates: [i32; 3], coming_up: bool) -> [bool; 3] {
        let Some(peak_mw) = power.peak_mw else { return rates.map(|rate| rate != 0) };
        if coming_up && !self.coming_up {
            self.standings = Default::default();
        }
        self.coming_up = coming_up;
        let [pitch, buoyancy, roll] = &mut self.standings;
        let [pitch_mw, buoyancy_mw, roll_mw] = power.draws_mw(rates);
        let (buoyancy_order, buoyancy_s, attitude_s) = if coming_up {
            (0, RISING_BUOYANCY_TURN_S, RISING_ATTITUDE_TURN_S)
        } else {
            (2, BUOYANCY_TURN_S, ATTITUDE_TURN_S)
        };
        let [pitch_rate, buoyancy_rate, roll_rate] = rates;
        let mut requests = [
            Request::new(pitch, pitch_rate != 0, pitch_mw, (1, attitude_s)),
            Request::new(buoyancy, buoyancy_rate != 0, buoyancy_mw, (buoyancy_order, buoyancy_s)),
            Request::new(roll, roll_rate != 0, roll_mw, (3, attitude_s)),
        ];
        share(&mut requests, peak_mw);
        requests.map(Request::settle)
    }
}

impl<'s> Request<'s> {
    fn new(standing: &'s mut Standing, wishes: bool, draw_mw: u32, (order, turn_s): (u8, u32)) -> Self {
        let claim = match (wishes, standing.ran_ticks) {
            (false, _) => Claim::Idle,
            (true, 0) => Claim::Waiting,
            (true, ran_ticks) if ran_ticks < turn_s.saturating_mul(TICK_HZ) => Claim::UnderWay,
            (true, _) => Claim::Served,
        };
        let rank = Rank { claim, waited_ticks: Reverse(standing.waited_ticks), order };
        Self { standing, draw_mw, rank, runs: false }
    }

    /// Takes down whether it ran or waited.
    fn settle(self) -> bool {
        let Standing { ran_ticks, waited_ticks } = *self.standing;
        *self.standing = match (self.rank.claim, self.runs) {
            (Claim::Idle, _) => Standing::default(),
            (_, true) => Standing { ran_ticks: ran_ticks.saturating_add(1), waited_ticks: 0 },
            (_, false) => Standing { ran_ticks: 0, waited_ticks: waited_ticks.saturating_add(1) },
        };
        self.runs
    }
}

/// Lets motors run, the smallest rank first, until one does not fit: those after it wait too, or it might wait for
/// ever.
fn share(requests: &mut [Request<'_>; 3], peak_mw: u32) {
    let (mut drawn_mw, mut last) = (0_u32, None);
    let is_after = |request: &Request<'_>, last| request.rank.claim != Claim::Idle && Some(request.rank) > last;
    while let Some(next) = requests.iter_mut().filter(|request| is_after(request, last)).min_by_key(|next| next.rank) {
        let with_it_mw = drawn_mw.saturating_add(next.draw_mw);
        if drawn_mw > 0 && with_it_mw > peak_mw {
            return;
        }
        next.runs = true;
        (drawn_mw, last) = (with_it_mw, Some(next.rank));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A pump that bears no company, drives that bear each other's.
    const POWER: MotorPower =
        MotorPower { r_px_mw: 3_000, mu_mw: 2_000, pump_mw: 40_000, bleed_mw: 1_000, peak_mw: Some(41_000) };
    const PUMP: i32 = 1_200;

    /// Who runs in each of some ticks with wishes that last: the rates of pitch, buoyancy and roll.
    fn ticks(turns: &mut Turns, rates: [i32; 3], coming_up: bool, count: u32) -> std::vec::Vec<[bool; 3]> {
        (0..count).map(|_| turns.take(&POWER, rates, coming_up)).collect()
    }

    /// The first tick at which a motor runs.
    fn first(ticks: &[[bool; 3]], motor: usize) -> Option<usize> {
        ticks.iter().position(|runs| runs[motor])
    }

    #[test]
    fn without_a_peak_power_all_run_at_once() {
        let power = MotorPower { peak_mw: None, ..POWER };
        assert_eq!(Turns::default().take(&power, [-5, PUMP, 5], false), [true; 3]);
        assert_eq!(Turns::default().take(&power, [0, PUMP, 0], true), [false, true, false]);
    }

    #[test]
    fn what_fits_runs_together() {
        assert_eq!(Turns::default().take(&POWER, [5, 0, 5], false), [true, false, true], "5 W");
        assert_eq!(Turns::default().take(&POWER, [5, -PUMP, 5], false), [true; 3], "6 W: it bleeds");
        assert_eq!(Turns::default().take(&POWER, [5, PUMP, 0], false), [true, false, false], "43 W");
        let weak = MotorPower { peak_mw: Some(10), ..POWER };
        assert_eq!(Turns::default().take(&weak, [0, PUMP, 5], true), [false, true, false], "one always may");
    }

    #[test]
    fn pitch_goes_before_buoyancy_and_buoyancy_before_roll() {
        let power = MotorPower { peak_mw: Some(1), ..POWER };
        let mut turns = Turns::default();
        assert_eq!(turns.take(&power, [5, PUMP, 5], false), [true, false, false]);
        assert_eq!(turns.take(&power, [0, PUMP, 5], false), [false, true, false]);
        assert_eq!(turns.take(&power, [0, 0, 5], false), [false, false, true]);
    }

    #[test]
    fn coming_up_buoyancy_is_first_even_of_moves_under_way() {
        let mut turns = Turns::default();
        assert_eq!(turns.take(&POWER, [5, PUMP, 5], false), [true, false, false]);
        assert_eq!(turns.take(&POWER, [5, PUMP, 5], true), [false, true, false]);
    }

    #[test]
    fn a_move_under_way_is_finished_before_another_starts() {
        let mut turns = Turns::default();
        turns.take(&POWER, [0, PUMP, 0], false);
        assert_eq!(turns.take(&POWER, [5, PUMP, 5], false), [false, true, false], "a pump that has just begun");
        let mut turns = Turns::default();
        turns.take(&POWER, [5, 0, 0], false);
        let while_pitching = ticks(&mut turns, [5, PUMP, 0], false, 25 * TICK_HZ);
        assert!(while_pitching.iter().all(|runs| *runs == [true, false, false]), "a pitch move of 25 s");
    }

    #[test]
    fn alone_a_turn_has_no_end() {
        let mut turns = Turns::default();
        assert!(ticks(&mut turns, [0, PUMP, 0], false, 3_000).iter().all(|runs| *runs == [false, true, false]));
    }

    /// A pump runs for ten minutes; a roll move of 3 s is asked for when it has run for five.
    #[test]
    fn a_slow_pump_pauses_for_an_attitude_move_and_goes_on() {
        let mut turns = Turns::default();
        ticks(&mut turns, [0, PUMP, 0], false, 300 * TICK_HZ);
        let rolls = ticks(&mut turns, [0, PUMP, 5], false, 3 * TICK_HZ);
        assert!(rolls.iter().all(|runs| *runs == [false, false, true]));
        assert_eq!(turns.take(&POWER, [0, PUMP, 0], false), [false, true, false]);
    }

    /// All three wish to run for ever, as jammed drives do: whatever the phase, each waits for no longer than the
    /// others' turns.
    #[test]
    fn nobody_starves() {
        let power = MotorPower { peak_mw: Some(1), ..POWER };
        for (coming_up, buoyancy_s, attitude_s) in
            [(false, BUOYANCY_TURN_S, ATTITUDE_TURN_S), (true, RISING_BUOYANCY_TURN_S, RISING_ATTITUDE_TURN_S)]
        {
            let round = buoyancy_s.saturating_add(attitude_s.saturating_mul(2)).saturating_mul(TICK_HZ) as usize;
            let mut turns = Turns::default();
            let flown: std::vec::Vec<_> =
                (0..round.saturating_mul(10)).map(|_| turns.take(&power, [5, PUMP, 5], coming_up)).collect();
            assert!(flown.iter().all(|runs| runs.iter().filter(|runs| **runs).count() == 1), "one at a time");
            for (motor, window) in (0..3).flat_map(|motor| flown.windows(round).map(move |window| (motor, window))) {
                assert!(first(window, motor).is_some(), "motor {motor}, coming up {coming_up}");
            }
        }
    }

    /// Both drives of the mass are jammed: their moves never end.
    #[test]
    fn on_the_way_up_buoyancy_has_most_of_the_time() {
        let runs = ticks(&mut Turns::default(), [1, PUMP, 1], true, 4 * 3_600);
        let share = runs.iter().filter(|runs| runs[1]).count() as f32 / runs.len() as f32;
        assert!(share >= 0.74, "{share} of the time");
        assert!(runs.iter().any(|runs| runs[0]) && runs.iter().any(|runs| runs[2]), "nobody starves");
    }

    /// A wish that fits beside a running motor does not jump the queue, or short moves could keep a pump waiting for
    /// ever.
    #[test]
    fn small_moves_do_not_pass_a_pump_that_waits() {
        let mut turns = Turns::default();
        turns.take(&POWER, [5, 0, 0], false);
        turns.take(&POWER, [5, PUMP, 0], false);
        assert_eq!(turns.take(&POWER, [5, PUMP, 5], false), [true, false, false]);
        assert_eq!(turns.take(&POWER, [0, PUMP, 5], false), [false, true, false]);
    }
}
