//! Whether the battery lasts for a mission.

use shared::{device::RAD_PER_CDEG, mission::Mission, model::table::TrimTable};

use super::MissionFile;
use crate::files::toml_file::FileError;
use crate::flight::FlyingVehicle;

/// Joules per megajoule.
const J_PER_MJ: f64 = 1e6;

/// What a mission takes, J.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Need {
    pump_j: f64,
    hotel_j: f64,
}

impl Need {
    /// Of steady glides, of the pump at every apogee, and of its way to the lightest at every surfacing. A mission that takes
    /// longer than it may is flown in part.
    fn new(flying: &FlyingVehicle<'_>, table: &TrimTable<'_>, mission: &Mission) -> Self {
        let metres = |mm: i32| f64::from(mm) / 1e3;
        let sink_m_s = |path_cdeg: i16, net_mass_g: i16| {
            let path_rad = f32::from(path_cdeg) * RAD_PER_CDEG;
            f64::from(table.look_up(path_rad, f32::from(net_mass_g) / 1e3, 0.0).sink_rate_m_s).abs()
        };
        let height_m = metres(mission.dive_to_mm) - metres(mission.climb_to_mm);
        let glides_s = height_m / sink_m_s(mission.dive_path_angle_cdeg, mission.dive_net_mass_g)
            + height_m / sink_m_s(mission.climb_path_angle_cdeg, mission.climb_net_mass_g);
        let (yos, surfacings) = (f64::from(mission.total_yos()), f64::from(mission.surfacings));
        let planned_s =
            yos * (glides_s + f64::from(mission.drift_time_s)) + surfacings * f64::from(mission.surface_time_s);
        let flown = (f64::from(mission.max_duration_s) / planned_s).min(1.0);

        let water = &flying.vehicle.water;
        let pump_j = |depth_m: f64, volume_m3: f64| {
            let pressure_pa = water.density_kg_m3 * water.gravity_m_s2 * depth_m;
            let rate_m3_s = flying.buoyancy.pump_rate_at_m3_s(pressure_pa);
            flying.buoyancy.pump_power_w(pressure_pa, rate_m3_s) * volume_m3 / rate_m3_s
        };
        let volume_m3 = |net_mass_g: i16| -f64::from(net_mass_g) / 1e3 / water.density_kg_m3;
        let (heavy_m3, light_m3) = (volume_m3(mission.dive_net_mass_g), volume_m3(mission.climb_net_mass_g));
        let apogee_j = pump_j(metres(mission.dive_to_mm), light_m3 - heavy_m3);
        let surfacing_j = pump_j(metres(mission.climb_to_mm), flying.buoyancy.volume_m3[1] - light_m3);
        Self {
            pump_j: flown * (yos * apogee_j + surfacings * surfacing_j),
            hotel_j: flown * planned_s * flying.energy.hotel_w,
        }
    }
}

impl MissionFile {
    /// Checks that the battery holds what the mission takes, by the steady glides of the trim table.
    ///
    /// # Errors
    /// One line with what it would take.
    pub fn check_energy(&self, flying: &FlyingVehicle<'_>, table: &TrimTable<'_>) -> Result<(), FileError> {
        let Need { pump_j, hotel_j } = Need::new(flying, table, &self.mission);
        let battery_j = flying.energy.battery_j;
        if pump_j + hotel_j <= battery_j {
            return Ok(());
        }
        let message = format!(
            "`mission.yos` is {} for {} surfacing{}, which takes {:.2} MJ (pump {:.2}, hotel {:.2}), but the battery holds {:.2} MJ",
            self.mission.yos,
            self.mission.surfacings,
            if self.mission.surfacings == 1 { "" } else { "s" },
            (pump_j + hotel_j) / J_PER_MJ,
            pump_j / J_PER_MJ,
            hotel_j / J_PER_MJ,
            battery_j / J_PER_MJ
        );
        Err(self.mistake("mission.yos", message))
    }
}
