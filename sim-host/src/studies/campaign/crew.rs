//! Who flies a campaign, and what they are told of the vehicle and the water.

use clap::ValueEnum;
use shared::{
    autopilot::Autopilot, device::RAD_PER_CDEG, mission::Mission, model::table::TrimTable, parameters::Parameters,
};

use crate::flight::{
    baseline::{Baseline, Turn, TurnSense},
    mission_file::MissionFile,
    pilot::{Pilot, autopilot, briefed},
};
use crate::model::{ocean::Ocean, vehicle::Vehicle};

/// One water.
#[derive(Clone, Debug)]
pub struct Water<'a> {
    /// Its name.
    pub name: String,
    /// What it is.
    pub ocean: Ocean,
    /// Who flies there; they know the vehicle of the file, and what a chart tells of the water.
    pub pilots: Vec<Flyer<'a>>,
}

/// Who flies.
#[derive(Clone, Debug)]
pub enum Flyer<'a> {
    /// The autopilot.
    Autopilot(Box<Autopilot<'a>>),
    /// The classical controller.
    Baseline(Box<Baseline>),
}

/// Whom to fly.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Pilots {
    /// The autopilot alone.
    Autopilot,
    /// The classical controller alone.
    Baseline,
    /// One after the other.
    Both,
}

impl<'a> Water<'a> {
    /// A water by its name, and who flies there; one that is too shallow for the mission would say nothing about them.
    ///
    /// # Errors
    /// One line: no such water, one that is too shallow, or what of the mission cannot be flown.
    pub fn new(
        name: &str,
        who: Pilots,
        vehicle: &Vehicle,
        table: &TrimTable<'a>,
        file: &MissionFile,
    ) -> Result<Self, String> {
        let mission = &file.mission;
        let ocean = Ocean::load(name, &vehicle.water).map_err(|error| error.to_string())?;
        let dive_to_m = f64::from(mission.dive_to_mm) / 1e3;
        match ocean.floor_depth_m(0.0, 0.0) {
            Some(floor_m) if floor_m <= dive_to_m => {
                Err(format!("{name}: the sea floor lies at {floor_m} m, and the mission dives to {dive_to_m} m"))
            }
            Some(_) | None => {
                let parameters = briefed(&file.parameters, mission, &ocean, &vehicle.water);
                Ok(Self { name: name.into(), ocean, pilots: pilots(who, table, file, &parameters)? })
            }
        }
    }
}

impl<'a> Flyer<'a> {
    /// As it is called in tables and files.
    #[must_use]
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Autopilot(_) => "autopilot",
            Self::Baseline(_) => "baseline",
        }
    }

    /// One that has not flown yet.
    pub(crate) fn fresh(&self) -> Box<dyn Pilot + 'a> {
        match self {
            Self::Autopilot(autopilot) => autopilot.clone(),
            Self::Baseline(baseline) => baseline.clone(),
        }
    }
}

fn pilots<'a>(
    who: Pilots,
    table: &TrimTable<'a>,
    file: &MissionFile,
    parameters: &Parameters,
) -> Result<Vec<Flyer<'a>>, String> {
    // Also checks the mission, which the classical controller takes as it is.
    let autopilot = autopilot(table, file, parameters)?;
    if who != Pilots::Autopilot && !Baseline::knows(&file.mission) {
        return Err("the baseline flies headings and no drift; --pilot autopilot flies this mission alone".into());
    }
    let sense = turn_sense(table, &file.mission);
    let baseline = Baseline::new(table.vehicle(), &file.mission, parameters, sense);
    let both = [
        (Pilots::Autopilot, Flyer::Autopilot(Box::new(autopilot))),
        (Pilots::Baseline, Flyer::Baseline(Box::new(baseline))),
    ];
    Ok(both.into_iter().filter(|(pilot, _)| who == Pilots::Both || who == *pilot).map(|(_, flyer)| flyer).collect())
}

/// What a builder would tell the classical controller: which way the vehicle turns with the mass to the left.
fn turn_sense(table: &TrimTable<'_>, mission: &Mission) -> TurnSense {
    const MU_RAD: f32 = 0.5;
    let turn = |path_angle_cdeg: i16, net_mass_g: i16| {
        let path_angle_rad = f32::from(path_angle_cdeg) * RAD_PER_CDEG;
        let glide = table.look_up(path_angle_rad, f32::from(net_mass_g) / 1e3, MU_RAD);
        if glide.turn_rate_rad_s < 0.0 { Turn::Left } else { Turn::Right }
    };
    TurnSense {
        dive: turn(mission.dive_path_angle_cdeg, mission.dive_net_mass_g),
        climb: turn(mission.climb_path_angle_cdeg, mission.climb_net_mass_g),
    }
}
