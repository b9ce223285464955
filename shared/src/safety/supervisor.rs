//! Ends the mission when it must end.

use crate::commands::Abort;
use crate::device::{Measurements, TICK_HZ};
use crate::mission::Mission;
use crate::parameters::Parameters;
use crate::safety::streak::Streak;

/// Limits of one mission, in ticks and device integers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Supervisor {
    abort_depth_mm: i32,
    max_ticks: u32,
    stale_depth_ticks: u32,
    stale_attitude_ticks: u32,
    samples: u32,
    dry_mv: i32,
    least_vacuum_pa: i32,
    most_vacuum_pa: i32,
    least_mv: i32,
    /// Charge that may be drawn; none if the battery's is not known.
    most_drawn_mc: Option<i64>,
    no_motion_ticks: u32,
    no_motion_mm: i32,
    against_model_ticks: u32,
}

/// What the supervisor remembers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Watch {
    leak: Streak,
    vacuum: Streak,
    undervolts: Streak,
    low_charge: Streak,
    against_model: Streak,
    /// Tick and depth, mm, from which on there was no vertical motion.
    rest: Option<(u32, i32)>,
}

/// What the supervisor looks at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Vitals<'a> {
    /// Ticks since the mission began.
    pub tick: u32,
    /// Depth last measured, mm.
    pub depth_mm: i32,
    /// Tick of the last fresh depth.
    pub depth_tick: u32,
    /// Tick of the last fresh attitude.
    pub attitude_tick: u32,
    /// Whether depth should be changing.
    pub under_way: bool,
    /// Whether depth does not go where the reduced model says; nothing if neither can be told.
    pub against_model: Option<bool>,
    /// What the other instruments say; what says nothing is not judged.
    pub measurements: &'a Measurements,
}

impl Supervisor {
    /// Watches over one mission.
    #[must_use]
    pub fn new(mission: &Mission, parameters: &Parameters) -> Self {
        let ticks = |seconds: u32| seconds.saturating_mul(TICK_HZ);
        let seconds = |parameter: i32| ticks(parameter.unsigned_abs());
        // Millicoulombs of one per cent of a coulomb.
        let percent_mc = i64::from(parameters.battery_capacity_c).saturating_mul(10);
        let may_draw_percent = 100_i64.saturating_sub(parameters.low_charge_percent.into());
        Self {
            abort_depth_mm: mission.abort_depth_mm,
            max_ticks: ticks(mission.max_duration_s),
            stale_depth_ticks: seconds(parameters.stale_depth_s),
            stale_attitude_ticks: seconds(parameters.stale_attitude_s),
            samples: parameters.abort_samples.unsigned_abs(),
            dry_mv: parameters.leak_mv,
            least_vacuum_pa: parameters.vacuum_min_pa,
            most_vacuum_pa: parameters.vacuum_max_pa,
            least_mv: parameters.undervolts_mv,
            most_drawn_mc: (percent_mc > 0).then_some(percent_mc.saturating_mul(may_draw_percent)),
            no_motion_ticks: seconds(parameters.no_motion_s),
            no_motion_mm: parameters.no_motion_mm,
            against_model_ticks: seconds(parameters.against_model_s),
        }
    }

    /// The reason to abort now, the gravest first.
    pub fn judge(&self, watch: &mut Watch, vitals: &Vitals<'_>) -> Option<Abort> {
        let said = vitals.measurements;
        let age = |since: u32| vitals.tick.saturating_sub(since);
        let wet = said.leak_mv.map(|mv| i32::from(mv) < self.dry_mv);
        let bad_vacuum = said.vacuum_pa.map(|pa| pa < self.least_vacuum_pa || pa > self.most_vacuum_pa);
        let weak = said.battery_mv.map(|mv| i32::from(mv) < self.least_mv);
        let spent = said.charge_mc.zip(self.most_drawn_mc).map(|(drawn, most)| drawn > most);
        // All are evaluated, so that every streak gets its sample.
        let rows = [
            (watch.leak.take(wet, self.samples), Abort::Leak),
            (vitals.depth_mm > self.abort_depth_mm, Abort::Overdepth),
            (age(vitals.depth_tick) > self.stale_depth_ticks, Abort::StaleDepth),
            (watch.vacuum.take(bad_vacuum, self.samples), Abort::Vacuum),
            (watch.undervolts.take(weak, self.samples), Abort::Undervolts),
            (watch.low_charge.take(spent, self.samples), Abort::LowCharge),
            (age(vitals.attitude_tick) > self.stale_attitude_ticks, Abort::StaleAttitude),
            (watch.against_model.take(vitals.against_model, self.against_model_ticks), Abort::AgainstModel),
            (age(self.at_rest_since(watch, vitals)) > self.no_motion_ticks, Abort::NoVerticalMotion),
            (vitals.tick > self.max_ticks, Abort::MissionTimeout),
        ];
        rows.into_iter().find(|(met, _)| *met).map(|(_, abort)| abort)
    }

    /// Tick since which depth has stayed within a band although it should change; now, if it moves.
    fn at_rest_since(&self, watch: &mut Watch, vitals: &Vitals<'_>) -> u32 {
        let stays = |depth_mm: i32| vitals.depth_mm.saturating_sub(depth_mm).saturating_abs() <= self.no_motion_mm;
        let rest = watch.rest.filter(|(_, depth_mm)| vitals.under_way && stays(*depth_mm));
        let (tick, depth_mm) = rest.unwrap_or((vitals.tick, vitals.depth_mm));
        watch.rest = Some((tick, depth_mm));
        tick
    }
}

#[cfg(test)]
mod tests;
