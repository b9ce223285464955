//! What a mission will come to before it is flown: how long, how much energy, and where the vehicle will surface.
//!
//! The nominal flight has everything as the files say and instruments without errors. Beside it flies an ensemble: each
//! member is a vehicle, a current and instruments that its seed drew, as in a campaign ([`crate::studies::campaign`]), with the
//! controller that will fly. Where the members surface is taken as a normal distribution.
//!
//! The unknown current is normally distributed too, the same in all directions: of a given speed it would lie on a ring, which
//! no ellipse describes.

mod ellipse;
mod geojson;
mod limits;
mod page;

use std::{num::NonZero, ops::RangeInclusive};

use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use serde::Serialize;
use shared::{autopilot::Autopilot, device::TICK_HZ};

pub use ellipse::{Ellipse, Scatter};
pub use geojson::geojson;
pub use limits::{Limit, limits};
pub use page::{figure, html};

use crate::flight::{
    NorthEast, Outcome, SensorErrors, Summary,
    mission_file::{MissionFile, Start},
};
use crate::model::{ocean::Ocean, vehicle::Vehicle};
use crate::parallel;
use crate::studies::campaign::{Drawn, DrawnFlight, Spread, sensor_errors};

/// Shares for which ellipses are given.
const SHARES: [f64; 2] = [0.5, 0.9];
/// Ticks between two places of the nominal track.
const TRACK_TICKS: u32 = 5 * TICK_HZ;
/// Keeps the draws of the current's speed apart from all others of the same seed.
const STREAM: u64 = 0x706c_616e_6e65_645f;

/// What is to be flown, by whom and where.
#[derive(Clone, Debug)]
pub struct Planned<'a> {
    /// The vehicle as its file says.
    pub vehicle: &'a Vehicle,
    /// What is flown.
    pub file: &'a MissionFile,
    /// The water as it is charted.
    pub ocean: &'a Ocean,
    /// The controller, which has not flown yet.
    pub autopilot: &'a Autopilot<'a>,
    /// Root of the mean square of an unknown steady current's speed, m/s.
    pub current_m_s: f64,
    /// The ensemble's members.
    pub seeds: RangeInclusive<u64>,
}

/// What one flight came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Member {
    /// Its seed; none for the nominal flight.
    pub seed: Option<u64>,
    /// How it ended.
    pub outcome: Outcome,
    /// Why it ended early or did not come back; empty if neither.
    pub reason: String,
    /// From the start to the end, s.
    pub duration_s: f64,
    /// Electrical energy, J.
    pub energy_j: f64,
    /// Deepest place, m.
    pub max_depth_m: f64,
    /// Least height above the sea floor, m, if there is one.
    pub min_altitude_m: Option<f64>,
    /// Where it came up, if it did.
    pub surfacing: Option<NorthEast>,
}

/// A place of the nominal flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TrackPoint {
    /// Since the start, s.
    pub time_s: f64,
    /// From above.
    pub place: NorthEast,
    /// Depth, m.
    pub depth_m: f64,
}

/// Where the members surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Surfacing {
    /// Mean of those that completed.
    #[serde(flatten)]
    pub mean: NorthEast,
    /// The same as a position, deg.
    pub latitude_deg: f64,
    /// Its longitude, deg.
    pub longitude_deg: f64,
    /// [[north north, north east], [east north, east east]], m².
    pub covariance_m2: [[f64; 2]; 2],
    /// Where half and where nine tenths of all surfacings are expected.
    pub ellipses: Vec<HoldingEllipse>,
}

/// An ellipse, and how many members it holds: a check on the normal distribution.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct HoldingEllipse {
    /// The ellipse.
    #[serde(flatten)]
    pub ellipse: Ellipse,
    /// Share of the completed members inside.
    pub share_inside: f64,
}

/// What a mission will come to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Plan {
    /// The flight with everything as the files say.
    pub nominal: Member,
    /// Share of the members that completed the mission; the spreads and the surfacing are over these.
    pub completed_share: f64,
    /// Duration, s.
    pub duration_s: Option<Spread>,
    /// Electrical energy, J.
    pub energy_j: Option<Spread>,
    /// Deepest place, m.
    pub max_depth_m: Option<Spread>,
    /// Where it will come up; nothing if fewer than three members complete.
    pub surfacing: Option<Surfacing>,
    /// What limits the mission, and how near the worst flight comes.
    pub limits: Vec<Limit>,
    /// The ensemble.
    pub members: Vec<Member>,
    /// Way of the nominal flight.
    #[serde(skip)]
    pub track: Vec<TrackPoint>,
    /// Where it starts.
    #[serde(skip)]
    pub start: Start,
}

/// Flies the ensemble on some threads, whose number changes nothing; `landed` hears of each member.
///
/// # Errors
/// What keeps the vehicle from flying, in one line.
pub fn plan(planned: &Planned<'_>, threads: NonZero<usize>, landed: impl FnMut(&Member)) -> Result<Plan, String> {
    let (nominal, track) = nominal(planned)?;
    let seeds: Vec<u64> = planned.seeds.clone().collect();
    let members = parallel::in_order(seeds.len(), threads, |index| member(planned, seeds[index]), landed)?;
    let completed: Vec<&Member> = members.iter().filter(|member| member.outcome == Outcome::Completed).collect();
    let spread = |value: fn(&Member) -> f64| Spread::new(completed.iter().map(|member| value(member)));
    let start = planned.file.start;
    Ok(Plan {
        completed_share: completed.len() as f64 / members.len().max(1) as f64,
        duration_s: spread(|member| member.duration_s),
        energy_j: spread(|member| member.energy_j),
        max_depth_m: spread(|member| member.max_depth_m),
        surfacing: surfacing(&completed, &start),
        limits: limits(planned, &nominal, &members)?,
        nominal,
        members,
        track,
        start,
    })
}

/// The flight with everything as the files say, and its way.
fn nominal(planned: &Planned<'_>) -> Result<(Member, Vec<TrackPoint>), String> {
    let drawn = Drawn::nominal();
    let mut track = Vec::new();
    let member = fly(planned, &drawn, None, SensorErrors::none(), |point, ticks| {
        if ticks.is_multiple_of(TRACK_TICKS) {
            track.push(point);
        }
    })?;
    Ok((member, track))
}

fn member(planned: &Planned<'_>, seed: u64) -> Result<Member, String> {
    let mut random = Pcg64Mcg::seed_from_u64(seed ^ STREAM);
    // The speed of a current whose parts north and east are normally distributed: Rayleigh's distribution.
    let from_one: f64 = 1.0 - random.random_range(0.0..1.0);
    let speed_m_s = planned.current_m_s * (-libm::log(from_one)).sqrt();
    fly(planned, &Drawn::new(seed, speed_m_s), Some(seed), sensor_errors(), |_, _| {})
}

/// One flight; `observe` hears where it is, tick by tick.
fn fly(
    planned: &Planned<'_>,
    drawn: &Drawn,
    seed: Option<u64>,
    sensor_errors: SensorErrors,
    mut observe: impl FnMut(TrackPoint, u32),
) -> Result<Member, String> {
    let (nominal, charted, file) = (planned.vehicle, planned.ocean, planned.file);
    let flight = DrawnFlight { nominal, charted, file, drawn, seed: seed.unwrap_or_default(), sensor_errors };
    let mut min_altitude_m: Option<f64> = None;
    let summary = flight.fly(&mut planned.autopilot.clone(), &mut |tick| {
        let position = &tick.state.position_m;
        if let Some(floor_m) = tick.floor_depth_m {
            let altitude_m = floor_m - position.z;
            min_altitude_m = Some(min_altitude_m.map_or(altitude_m, |least| least.min(altitude_m)));
        }
        let place = NorthEast { north_m: position.x, east_m: position.y };
        let time_s = f64::from(tick.tick) / f64::from(TICK_HZ);
        observe(TrackPoint { time_s, place, depth_m: position.z }, tick.tick);
    })?;
    Ok(Member::new(seed, min_altitude_m, &summary))
}

impl Member {
    fn new(seed: Option<u64>, min_altitude_m: Option<f64>, summary: &Summary) -> Self {
        Self {
            seed,
            outcome: summary.outcome,
            reason: summary.reason(),
            duration_s: summary.duration_s,
            energy_j: summary.energy_j.total(),
            max_depth_m: summary.max_depth_m,
            min_altitude_m,
            surfacing: summary.surfacing.actual.filter(|_| summary.outcome != Outcome::Lost),
        }
    }
}

/// Where those that completed the mission came up.
fn surfacing(completed: &[&Member], start: &Start) -> Option<Surfacing> {
    let places: Vec<NorthEast> = completed.iter().filter_map(|member| member.surfacing).collect();
    let scatter = Scatter::of(&places)?;
    let holding = |share: f64| {
        let ellipse = scatter.ellipse(share);
        let inside = places.iter().filter(|place| ellipse.holds(place)).count();
        HoldingEllipse { ellipse, share_inside: inside as f64 / places.len() as f64 }
    };
    let [latitude_deg, longitude_deg] = scatter.mean.latitude_longitude_deg(start);
    Some(Surfacing {
        mean: scatter.mean,
        latitude_deg,
        longitude_deg,
        covariance_m2: scatter.covariance_m2,
        ellipses: SHARES.map(holding).to_vec(),
    })
}
