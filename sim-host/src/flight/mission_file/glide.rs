//! What a file asks of a glide: a path angle or a pitch, a net mass or a vertical speed.

use shared::{device::RAD_PER_CDEG, model::table::TrimTable};

use super::{MissionFile, scaled};
use crate::files::toml_file::{FileError, Rule, Section};

/// Largest net mass that the mission's integers hold, kg.
const NET_MASS_KG: f64 = 32.0;
/// Fastest vertical speed that a file may name, m/s.
const VERTICAL_SPEED_M_S: f64 = 5.0;
/// Halvings of the table's range: to a hundredth of its integers' last digit.
const HALVINGS: u32 = 24;
/// Rounds in which path angle and net mass are fitted to each other: the angle of attack hardly knows the net mass.
const ROUNDS: u32 = 4;

/// A glide as it is asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Asked {
    side: &'static Keys,
    angle: Angle,
    drive: Drive,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Angle {
    Path { deg: f64 },
    Pitch { deg: f64 },
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Drive {
    NetMass { kg: f64 },
    VerticalSpeed { m_s: f64 },
}

/// Keys of one side, and the sign of its net mass.
#[derive(Debug, PartialEq)]
struct Keys {
    path_angle: &'static str,
    pitch: &'static str,
    net_mass: &'static str,
    vertical_speed: &'static str,
    sign: f64,
}

const DIVE: Keys = Keys {
    path_angle: "dive_path_angle_deg",
    pitch: "dive_pitch_deg",
    net_mass: "dive_net_mass_kg",
    vertical_speed: "dive_vertical_speed_m_s",
    sign: 1.0,
};

const CLIMB: Keys = Keys {
    path_angle: "climb_path_angle_deg",
    pitch: "climb_pitch_deg",
    net_mass: "climb_net_mass_kg",
    vertical_speed: "climb_vertical_speed_m_s",
    sign: -1.0,
};

pub(super) fn dive(mission: &mut Section<'_>) -> Asked {
    Asked::read(mission, &DIVE)
}

pub(super) fn climb(mission: &mut Section<'_>) -> Asked {
    Asked::read(mission, &CLIMB)
}

impl Asked {
    fn read(mission: &mut Section<'_>, side: &'static Keys) -> Self {
        let (downwards, upwards) = (|most| Rule::Within(0.0, most), |most: f64| Rule::Within(-most, 0.0));
        let (angles, drives): (Rule, fn(f64) -> Rule) =
            if side.sign > 0.0 { (upwards(90.0), downwards) } else { (downwards(90.0), upwards) };
        let angle = one_of(mission, (side.path_angle, angles), (side.pitch, angles));
        let net_masses = (side.net_mass, drives(NET_MASS_KG));
        let drive = one_of(mission, net_masses, (side.vertical_speed, drives(VERTICAL_SPEED_M_S)));
        Self {
            side,
            angle: angle.map_or_else(|deg| Angle::Pitch { deg }, |deg| Angle::Path { deg }),
            drive: drive.map_or_else(|m_s| Drive::VerticalSpeed { m_s }, |kg| Drive::NetMass { kg }),
        }
    }

    /// Zero where a pitch stands in its place.
    pub(super) fn path_angle_cdeg(&self) -> i16 {
        match self.angle {
            Angle::Path { deg } => scaled(deg, 1e2),
            Angle::Pitch { .. } => 0,
        }
    }

    /// Zero where a vertical speed stands in its place.
    pub(super) fn net_mass_g(&self) -> i16 {
        match self.drive {
            Drive::NetMass { kg } => scaled(kg, 1e3),
            Drive::VerticalSpeed { .. } => 0,
        }
    }

    /// Path angle, 0.01°, and net mass, g; else the key that cannot be had, what it is, and the range that can.
    fn resolve(&self, table: &TrimTable<'_>) -> Result<(i16, i16), Beyond> {
        let envelope = if self.side.sign > 0.0 { table.dive_envelope() } else { table.climb_envelope() };
        let angles = [envelope.path_angle_cdeg.min, envelope.path_angle_cdeg.max].map(|cdeg| f64::from(cdeg) / 100.0);
        let masses = [envelope.net_mass_g.min, envelope.net_mass_g.max].map(|g| f64::from(g) / 1e3);
        let at = |path_deg: f64, kg: f64| table.look_up(path_deg as f32 * 100.0 * RAD_PER_CDEG, kg as f32, 0.0);
        let pitch_deg = |path_deg: f64, kg: f64| f64::from(at(path_deg, kg).pitch_rad).to_degrees();
        let sink_m_s = |path_deg: f64, kg: f64| f64::from(at(path_deg, kg).sink_rate_m_s);
        let mut path_deg = match self.angle {
            Angle::Path { deg } => deg,
            Angle::Pitch { .. } => f64::midpoint(angles[0], angles[1]),
        };
        let mut kg = match self.drive {
            Drive::NetMass { kg } => kg,
            Drive::VerticalSpeed { .. } => f64::midpoint(masses[0], masses[1]),
        };
        for _ in 0..ROUNDS {
            if let Angle::Pitch { deg } = self.angle {
                path_deg = inverse(|path_deg| pitch_deg(path_deg, kg), angles, deg).map_err(|range| Beyond {
                    key: self.side.pitch,
                    value: deg,
                    range,
                })?;
            }
            if let Drive::VerticalSpeed { m_s } = self.drive {
                kg = inverse(|kg| sink_m_s(path_deg, kg), masses, m_s).map_err(|range| Beyond {
                    key: self.side.vertical_speed,
                    value: m_s,
                    range,
                })?;
            }
        }
        Ok((scaled(path_deg, 1e2), scaled(kg, 1e3)))
    }
}

/// A value that no glide of the trim table has.
struct Beyond {
    key: &'static str,
    value: f64,
    range: [f64; 2],
}

/// The first of two keys that stands, `Ok`, or the second, `Err`; both or neither is a mistake.
fn one_of(
    mission: &mut Section<'_>,
    (first, first_rule): (&'static str, Rule),
    (second, second_rule): (&'static str, Rule),
) -> Result<f64, f64> {
    let value = mission.optional_number(first, first_rule);
    let other = mission.optional_number(second, second_rule);
    mission.refuse_if(value.is_some() && other.is_some(), second, &format!("left out beside `{first}`"));
    match (value, other) {
        (None, Some(other)) => Err(other),
        (Some(value), _) => Ok(value),
        (None, None) => Ok(mission.number(first, first_rule)),
    }
}

/// Where a rising function has a value; else the range that it has.
fn inverse(rising: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2], value: f64) -> Result<f64, [f64; 2]> {
    let range = [rising(low), rising(high)];
    if !(range[0]..=range[1]).contains(&value) {
        return Err(range);
    }
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        if rising(middle) < value { low = middle } else { high = middle }
    }
    Ok(f64::midpoint(low, high))
}

impl MissionFile {
    /// The mission with pitches and vertical speeds turned into the path angles and net masses of a vehicle.
    ///
    /// # Errors
    /// A pitch or a vertical speed that no glide of the trim table has.
    pub fn resolve(mut self, table: &TrimTable<'_>) -> Result<Self, FileError> {
        let [dive, climb] = self.glides.map(|glide| glide.resolve(table));
        let glides = dive.and_then(|dive| Ok((dive, climb?)));
        let (dive, climb) = glides.map_err(|Beyond { key, value, range: [least, most] }| {
            let message = format!(
                "`mission.{key}` is {value}, but this vehicle and its trim table take {least:.2} to {most:.2} there"
            );
            self.mistake(&format!("mission.{key}"), message)
        })?;
        (self.mission.dive_path_angle_cdeg, self.mission.dive_net_mass_g) = dive;
        (self.mission.climb_path_angle_cdeg, self.mission.climb_net_mass_g) = climb;
        Ok(self)
    }
}
