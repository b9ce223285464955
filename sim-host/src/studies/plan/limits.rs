//! What limits a mission, and how near its worst flight comes.

use serde::Serialize;

use super::{Member, Planned};
use crate::flight::FlyingVehicle;

/// One limit.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Limit {
    /// What is limited.
    pub name: &'static str,
    /// What happens beyond it.
    pub beyond: &'static str,
    /// The worst of all flights, the nominal one among them.
    pub worst: f64,
    /// The limit: most, but least for the altitude.
    pub limit: f64,
    /// Unit of both.
    pub unit: &'static str,
    /// Whether every flight kept it.
    pub holds: bool,
}

/// All limits of a mission.
///
/// # Errors
/// One line that names the section that the vehicle file lacks to fly.
pub fn limits(planned: &Planned<'_>, nominal: &Member, members: &[Member]) -> Result<Vec<Limit>, String> {
    let flying = FlyingVehicle::new(planned.vehicle)?;
    let flights = || members.iter().chain([nominal]);
    let most = |name, beyond, value: fn(&Member) -> f64, limit: f64, unit| {
        let worst = flights().map(value).fold(0.0, f64::max);
        Limit { name, beyond, worst, limit, unit, holds: worst <= limit }
    };
    let mission = &planned.file.mission;
    // A mission below the working depth never gets here: the controller refuses it.
    let depth_m = flying.limits.crush_depth_m.min(f64::from(mission.abort_depth_mm) / 1e3);
    let duration_s = mission.max_duration_s.into();
    let mut limits = vec![
        most(
            "depth",
            "deeper than the mission's `abort_depth_m`, or than the hull bears",
            |m| m.max_depth_m,
            depth_m,
            "m",
        ),
        most("energy", "more than the battery holds", |m| m.energy_j, flying.energy.battery_j, "J"),
        most("duration", "longer than the mission's `max_duration_s`", |m| m.duration_s, duration_s, "s"),
    ];
    if let Some(worst) = flights().filter_map(|member| member.min_altitude_m).reduce(f64::min) {
        let (name, beyond) = ("altitude", "it runs aground");
        limits.push(Limit { name, beyond, worst, limit: 0.0, unit: "m", holds: worst > 0.0 });
    }
    Ok(limits)
}
