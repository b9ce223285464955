//! Where the vehicle is and how it moves: depth and its rate, attitude, dead-reckoned position.

mod place;

use nalgebra::{Matrix3, Vector2, Vector3};

use place::{from_origin_um, saturated_mm};

use crate::device::{Attitude, GpsFix, MM_PER_M, Measurements, RAD_PER_CDEG, TICK_HZ, TICK_S, UM_PER_M};
use crate::estimate::{buoyancy::Buoyancy, drift::Drift};
use crate::math;
use crate::model::{
    reduced::{Drive, Model, Motion},
    vehicle::FlightVehicle,
};
use crate::parameters::Parameters;

/// Share of a depth innovation that is believed at once.
const DEPTH_GAIN: f32 = 0.2;
/// Share of it that goes to the rate: critically damped, 2(2 − g) − 4√(1 − g).
const DEPTH_RATE_GAIN: f32 = 0.022_291_2;
/// Silence of the pressure sensor that the last rate still bridges: 5 s.
const SILENCE_TICKS: u32 = 5 * TICK_HZ;
/// Depth above which waves and the surface itself say where the vehicle goes, m.
const SUBMERGED_M: f32 = 5.0;
/// Modelled vertical speed below which it says nothing of where the vehicle must go, m/s.
const SLOW_M_S: f32 = 0.1;
/// Least part of it that a sound vehicle makes good.
const MADE_GOOD: f32 = 0.25;
/// Least density that is one, kg/m³; a parameter below it says nothing.
const LEAST_DENSITY_KG_M3: i32 = 900;

/// The estimate of the vehicle's state.
#[derive(Clone, Debug)]
pub struct Navigator {
    /// Depth of the centre of buoyancy, m.
    pub depth_m: f32,
    /// Rate of depth, m/s, down positive.
    pub depth_rate_m_s: f32,
    /// Last attitude, its heading as the vehicle's table corrects it.
    pub attitude: Attitude,
    /// Tick of the last fresh depth, once there was one.
    pub depth_tick: Option<u32>,
    /// Tick of the last fresh attitude, once there was one.
    pub attitude_tick: Option<u32>,
    origin: Option<GpsFix>,
    water_density_kg_m3: Option<f32>,
    water: Motion<f32>,
    modelled_sink_m_s: f32,
    drive: Drive<f32>,
    buoyancy: Buoyancy,
    drift: Drift,
    north_um: i64,
    east_um: i64,
    since_fix: SinceFix,
}

/// What happened since the last position fix.
#[derive(Clone, Copy, Debug, Default)]
struct SinceFix {
    tick: u32,
    fix_um: [i64; 2],
    /// Way through the water as reckoned.
    water_um: [i64; 2],
    dived: bool,
}

impl Default for Navigator {
    fn default() -> Self {
        Self::new(&Parameters::default())
    }
}

impl Navigator {
    /// Knows nothing yet.
    #[must_use]
    pub fn new(parameters: &Parameters) -> Self {
        let density_kg_m3 = parameters.water_density_kg_m3;
        Self {
            depth_m: 0.0,
            depth_rate_m_s: 0.0,
            attitude: Attitude {
                roll_cdeg: 0,
                pitch_cdeg: 0,
                heading_cdeg: 0,
                pitch_rate_cdeg_s: 0,
                yaw_rate_cdeg_s: 0,
            },
            depth_tick: None,
            attitude_tick: None,
            origin: None,
            water_density_kg_m3: (density_kg_m3 >= LEAST_DENSITY_KG_M3).then_some(density_kg_m3 as f32),
            water: Motion::at_rest(),
            modelled_sink_m_s: 0.0,
            drive: Drive {
                pitch_rad: 0.0,
                roll_rad: 0.0,
                pitch_rate_rad_s: 0.0,
                r_px_m: 0.0,
                net_mass_kg: 0.0,
                density_ratio: 1.0,
            },
            buoyancy: Buoyancy::new(parameters),
            drift: Drift::new(parameters),
            north_um: 0,
            east_um: 0,
            since_fix: SinceFix::default(),
        }
    }

    /// Takes one tick of measurements. `afloat`: at the surface on purpose, where the vehicle does not glide.
    pub fn update(&mut self, vehicle: &FlightVehicle, tick: u32, measurements: &Measurements, afloat: bool) {
        self.take_pressure(vehicle, tick, measurements.pressure_pa);
        if let Some(attitude) = measurements.attitude {
            let heading_cdeg = vehicle.compass.heading_cdeg(&attitude, measurements.r_px_um, measurements.mu_cdeg);
            self.attitude = Attitude { heading_cdeg, ..attitude };
            self.attitude_tick = Some(tick);
        }
        if afloat {
            self.water = Motion::at_rest();
            self.modelled_sink_m_s = 0.0;
            self.move_on(&Vector2::zeros());
        } else {
            self.dead_reckon(vehicle, tick, measurements);
        }
        if let Some(fix) = measurements.gps {
            self.take_fix(tick, fix);
        }
    }

    /// Whether a position was fixed since power-up.
    #[must_use]
    pub const fn has_position(&self) -> bool {
        self.origin.is_some()
    }

    /// Motion through the water and what drives it.
    #[must_use]
    pub const fn motion(&self) -> (&Motion<f32>, &Drive<f32>) {
        (&self.water, &self.drive)
    }

    /// What was learned of weight and drag.
    #[must_use]
    pub const fn buoyancy(&self) -> &Buoyancy {
        &self.buoyancy
    }

    /// What was learned of current, speed and compass.
    #[must_use]
    pub const fn drift(&self) -> &Drift {
        &self.drift
    }

    /// Heading, with what was learned of the compass's error, 0.01°.
    #[must_use]
    pub fn heading_cdeg(&self) -> i32 {
        let learned_cdeg = math::round_to_i32(self.drift.compass_rad() / RAD_PER_CDEG);
        i32::from(self.attitude.heading_cdeg).saturating_add(learned_cdeg)
    }

    /// Whether the vehicle makes good less than a quarter of the vertical speed that the reduced model says, with all that
    /// was learned of weight and drag, or goes the other way; nothing while pressure is silent.
    #[must_use]
    pub fn goes_against_model(&self, tick: u32) -> Option<bool> {
        (self.depth_tick == Some(tick)).then(|| {
            let (modelled_m_s, made_good_m_s) = (self.modelled_sink_m_s, MADE_GOOD * self.modelled_sink_m_s);
            self.depth_m > SUBMERGED_M
                && math::abs(modelled_m_s) > SLOW_M_S
                && if modelled_m_s > 0.0 {
                    self.depth_rate_m_s < made_good_m_s
                } else {
                    self.depth_rate_m_s > made_good_m_s
                }
        })
    }

    /// Modelled speed through the water, m/s.
    #[must_use]
    pub fn speed_m_s(&self) -> f32 {
        self.water.speed_m_s()
    }

    /// Position north and east of the origin, mm, held to what an `i32` reaches (2147 km).
    #[must_use]
    pub fn position_mm(&self) -> (i32, i32) {
        (saturated_mm(self.north_um), saturated_mm(self.east_um))
    }

    /// How far north and east of the vehicle a place lies, mm; nothing before the first fix.
    #[must_use]
    pub fn offset_mm(&self, place: &GpsFix) -> Option<(i32, i32)> {
        let (north_um, east_um) = from_origin_um(&self.origin?, place);
        let north_mm = saturated_mm(north_um.saturating_sub(self.north_um));
        Some((north_mm, saturated_mm(east_um.saturating_sub(self.east_um))))
    }

    /// Depth, mm.
    #[must_use]
    pub fn depth_mm(&self) -> i32 {
        math::round_to_i32(self.depth_m * MM_PER_M)
    }

    fn take_pressure(&mut self, vehicle: &FlightVehicle, tick: u32, pressure_pa: Option<i32>) {
        let predicted = self.depth_m + self.depth_rate_m_s * TICK_S;
        let Some(pressure_pa) = pressure_pa else {
            self.do_without_pressure(tick, predicted);
            return;
        };
        let density_kg_m3 = self.water_density_kg_m3.unwrap_or(vehicle.density_kg_m3);
        let measured = pressure_pa as f32 / (density_kg_m3 * vehicle.gravity_m_s2);
        if self.depth_tick.is_none() {
            self.depth_m = measured;
        } else {
            let innovation = measured - predicted;
            self.depth_m = predicted + DEPTH_GAIN * innovation;
            self.depth_rate_m_s += DEPTH_RATE_GAIN / TICK_S * innovation;
        }
        self.depth_tick = Some(tick);
    }

    /// A short silence is bridged at the last rate; in a long one the reduced model says how fast depth changes.
    fn do_without_pressure(&mut self, tick: u32, predicted_m: f32) {
        let silence_ticks = tick.saturating_sub(self.depth_tick.unwrap_or(0));
        if silence_ticks > SILENCE_TICKS {
            let rad = |cdeg: i16| f32::from(cdeg) * RAD_PER_CDEG;
            self.depth_rate_m_s = self.water.sink_rate_m_s(rad(self.attitude.pitch_cdeg), rad(self.attitude.roll_cdeg));
        }
        // Above the surface there is no depth.
        self.depth_m = if predicted_m > 0.0 { predicted_m } else { 0.0 };
    }

    fn dead_reckon(&mut self, vehicle: &FlightVehicle, tick: u32, measurements: &Measurements) {
        let attitude = &self.attitude;
        let rad = |cdeg: i16| f32::from(cdeg) * RAD_PER_CDEG;
        let nominal_kg = vehicle.net_mass_kg(measurements.vbd_ul);
        let drive = Drive {
            pitch_rad: rad(attitude.pitch_cdeg),
            roll_rad: rad(attitude.roll_cdeg),
            pitch_rate_rad_s: rad(attitude.pitch_rate_cdeg_s),
            r_px_m: measurements.r_px_um as f32 / UM_PER_M,
            net_mass_kg: self.buoyancy.net_mass_kg(nominal_kg),
            // Net mass and drag go with it alike; what is left counts as weight.
            density_ratio: 1.0,
        };
        self.water = Model::new(&vehicle.glide, vehicle.gravity_m_s2, TICK_S).step(&self.water, &drive);
        let to_inertial = rotation(drive.roll_rad, drive.pitch_rad, f32::from(attitude.heading_cdeg) * RAD_PER_CDEG);
        let velocity = to_inertial * Vector3::new(self.water.u_m_s, 0.0, self.water.w_m_s);
        self.drive = drive;
        self.modelled_sink_m_s = velocity.z;
        if self.depth_tick == Some(tick) && self.attitude_tick == Some(tick) {
            self.buoyancy.update(nominal_kg, velocity.z, self.depth_rate_m_s);
        }
        let water_m_s = velocity.xy();
        let [north_um, east_um] = &mut self.since_fix.water_um;
        *north_um = north_um.saturating_add(um_per_tick(water_m_s.x));
        *east_um = east_um.saturating_add(um_per_tick(water_m_s.y));
        self.since_fix.dived = true;
        self.move_on(&water_m_s);
    }

    /// One tick over ground, at a velocity through the water.
    fn move_on(&mut self, water_m_s: &Vector2<f32>) {
        let velocity = self.drift.over_ground(water_m_s);
        self.north_um = self.north_um.saturating_add(um_per_tick(velocity.x));
        self.east_um = self.east_um.saturating_add(um_per_tick(velocity.y));
    }

    /// Sets the position to the fix; the first one becomes the origin. The first one after a dive teaches the drift.
    fn take_fix(&mut self, tick: u32, fix: GpsFix) {
        let first = self.origin.is_none();
        let origin = *self.origin.get_or_insert(fix);
        (self.north_um, self.east_um) = from_origin_um(&origin, &fix);
        let fix_um = [self.north_um, self.east_um];
        let since = self.since_fix;
        if since.dived && !first {
            let metres = |um: [i64; 2]| Vector2::from(um.map(|um| um as f32 / UM_PER_M));
            let made_m = metres(fix_um) - metres(since.fix_um);
            let time_s = tick.saturating_sub(since.tick) as f32 * TICK_S;
            self.drift.take_dive(&made_m, &metres(since.water_um), time_s);
        }
        self.since_fix = SinceFix { tick, fix_um, ..SinceFix::default() };
    }
}

/// Way in one tick, µm.
fn um_per_tick(metres_per_second: f32) -> i64 {
    i64::from(math::round_to_i32(metres_per_second * TICK_S * UM_PER_M))
}

/// Rotation from body axes to north, east, down: 3-2-1 Euler angles, rad.
fn rotation(phi: f32, theta: f32, psi: f32) -> Matrix3<f32> {
    let ((sf, cf), (st, ct), (sp, cp)) = (math::sin_cos(phi), math::sin_cos(theta), math::sin_cos(psi));
    Matrix3::new(
        ct * cp,
        sf * st * cp - cf * sp,
        cf * st * cp + sf * sp,
        ct * sp,
        sf * st * sp + cf * cp,
        cf * st * sp - sf * cp,
        -st,
        sf * ct,
        cf * ct,
    )
}

#[cfg(test)]
mod tests;
