//! Where the vehicle is and how it moves: depth and its rate, attitude, dead-reckoned position.

use nalgebra::{Matrix3, Vector3};

use crate::{
    device::{Attitude, GpsFix, MM_PER_M, Measurements, RAD_PER_CDEG, TICK_HZ, TICK_S, UM_PER_M},
    math,
    reduced::{Drive, Model, Motion},
    vehicle::FlightVehicle,
};

/// Share of a depth innovation that is believed at once.
const DEPTH_GAIN: f32 = 0.2;
/// Share of it that goes to the rate: critically damped, 2(2 − g) − 4√(1 − g).
const DEPTH_RATE_GAIN: f32 = 0.022_291_2;
/// Silence of the pressure sensor that the last rate still bridges: 5 s.
const SILENCE_TICKS: u32 = 5 * TICK_HZ;
/// Time without a fix from which on the next one tells something of the current: 5 min.
const LEAST_DIVE_TICKS: u32 = 300 * TICK_HZ;
/// Metres per 1e-7° of latitude, on a sphere of 6371 km.
const M_PER_E7: f32 = 0.011_119_493;
/// Micrometres per millimetre.
const UM_PER_MM: i64 = 1_000;

/// The estimate of the vehicle's state.
#[derive(Clone, Debug)]
pub struct Navigator {
    /// Depth of the centre of buoyancy, m.
    pub depth_m: f32,
    /// Rate of depth, m/s, down positive.
    pub depth_rate_m_s: f32,
    /// Last attitude.
    pub attitude: Attitude,
    /// Tick of the last fresh depth, once there was one.
    pub depth_tick: Option<u32>,
    /// Tick of the last fresh attitude, once there was one.
    pub attitude_tick: Option<u32>,
    /// Depth-averaged motion of the water on the last dive, to north and east, m/s; zero before the first.
    pub current_m_s: (f32, f32),
    origin: Option<GpsFix>,
    fix_tick: u32,
    water: Motion<f32>,
    north_um: i64,
    east_um: i64,
}

impl Default for Navigator {
    fn default() -> Self {
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
            current_m_s: (0.0, 0.0),
            origin: None,
            fix_tick: 0,
            water: Motion::at_rest(),
            north_um: 0,
            east_um: 0,
        }
    }
}

impl Navigator {
    /// Takes one tick of measurements. `afloat`: at the surface on purpose, where the vehicle does not glide.
    pub fn update(&mut self, vehicle: &FlightVehicle, tick: u32, measurements: &Measurements, afloat: bool) {
        self.take_pressure(vehicle, tick, measurements.pressure_pa);
        if let Some(attitude) = measurements.attitude {
            self.attitude = attitude;
            self.attitude_tick = Some(tick);
        }
        if afloat {
            self.water = Motion::at_rest();
        } else {
            self.dead_reckon(vehicle, measurements);
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
        let measured = pressure_pa as f32 / (vehicle.density_kg_m3 * vehicle.gravity_m_s2);
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

    fn dead_reckon(&mut self, vehicle: &FlightVehicle, measurements: &Measurements) {
        let attitude = &self.attitude;
        let rad = |cdeg: i16| f32::from(cdeg) * RAD_PER_CDEG;
        let drive = Drive {
            pitch_rad: rad(attitude.pitch_cdeg),
            roll_rad: rad(attitude.roll_cdeg),
            pitch_rate_rad_s: rad(attitude.pitch_rate_cdeg_s),
            r_px_m: measurements.r_px_um as f32 / UM_PER_M,
            net_mass_kg: vehicle.net_mass_kg(measurements.vbd_ul),
            // Nothing measures it; the vehicle is ballasted for the water that its file names.
            density_ratio: 1.0,
        };
        self.water = Model::new(&vehicle.glide, vehicle.gravity_m_s2, TICK_S).step(&self.water, &drive);
        let to_inertial = rotation(drive.roll_rad, drive.pitch_rad, f32::from(attitude.heading_cdeg) * RAD_PER_CDEG);
        let velocity = to_inertial * Vector3::new(self.water.u_m_s, 0.0, self.water.w_m_s);
        let um = |metres_per_second: f32| i64::from(math::round_to_i32(metres_per_second * TICK_S * UM_PER_M));
        self.north_um = self.north_um.saturating_add(um(velocity.x + self.current_m_s.0));
        self.east_um = self.east_um.saturating_add(um(velocity.y + self.current_m_s.1));
    }

    /// How far north and east of the vehicle a place lies, mm; nothing before the first fix.
    #[must_use]
    pub fn offset_mm(&self, place: &GpsFix) -> Option<(i32, i32)> {
        let (north_um, east_um) = from_origin_um(&self.origin?, place);
        let north_mm = saturated_mm(north_um.saturating_sub(self.north_um));
        Some((north_mm, saturated_mm(east_um.saturating_sub(self.east_um))))
    }

    /// Sets the position to the fix; the first one becomes the origin. The first one after a dive tells the current.
    fn take_fix(&mut self, tick: u32, fix: GpsFix) {
        let first = self.origin.is_none();
        let origin = *self.origin.get_or_insert(fix);
        let (north_um, east_um) = from_origin_um(&origin, &fix);
        let away_ticks = tick.saturating_sub(self.fix_tick);
        if !first && away_ticks >= LEAST_DIVE_TICKS {
            let missed_m_s = |um: i64| um as f32 / UM_PER_M / (away_ticks as f32 * TICK_S);
            self.current_m_s.0 += missed_m_s(north_um.saturating_sub(self.north_um));
            self.current_m_s.1 += missed_m_s(east_um.saturating_sub(self.east_um));
        }
        (self.north_um, self.east_um, self.fix_tick) = (north_um, east_um, tick);
    }
}

/// How far north and east of the origin a place lies, µm.
fn from_origin_um(origin: &GpsFix, place: &GpsFix) -> (i64, i64) {
    let north_e7 = place.lat_e7.wrapping_sub(origin.lat_e7);
    let east_e7 = wrap_e7(i64::from(place.lon_e7).saturating_sub(i64::from(origin.lon_e7)));
    let m_per_e7_east = M_PER_E7 * math::cos(origin.lat_e7 as f32 * (RAD_PER_CDEG * 1e-5));
    let um = |e7: f32, m_per_e7: f32| i64::from(math::round_to_i32(e7 * m_per_e7 * MM_PER_M)).saturating_mul(UM_PER_MM);
    (um(north_e7 as f32, M_PER_E7), um(east_e7 as f32, m_per_e7_east))
}

/// Micrometres as millimetres, held to what an `i32` reaches.
fn saturated_mm(um: i64) -> i32 {
    let mm = um / UM_PER_MM;
    i32::try_from(mm).unwrap_or(if mm < 0 { i32::MIN } else { i32::MAX })
}

/// A difference of longitudes, 1e-7°, the short way round: across the date line too.
const fn wrap_e7(difference: i64) -> i64 {
    const TURN: i64 = 3_600_000_000;
    difference.wrapping_add(TURN / 2).rem_euclid(TURN).wrapping_sub(TURN / 2)
}

/// Rotation from body axes to north, east, down: 3-2-1 Euler angles, rad.
fn rotation(phi: f32, theta: f32, psi: f32) -> Matrix3<f32> {
    let (sf, cf) = (math::sin(phi), math::cos(phi));
    let (st, ct) = (math::sin(theta), math::cos(theta));
    let (sp, cp) = (math::sin(psi), math::cos(psi));
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
mod tests {
    use super::*;
    use crate::table::{TrimTable, tests::file};

    fn at(pressure_pa: i32, heading_cdeg: u16) -> Measurements {
        Measurements {
            pressure_pa: Some(pressure_pa),
            attitude: Some(Attitude {
                roll_cdeg: 0,
                pitch_cdeg: -3_378,
                heading_cdeg,
                pitch_rate_cdeg_s: 0,
                yaw_rate_cdeg_s: 0,
            }),
            vbd_ul: -212_900,
            ..Measurements::silent()
        }
    }

    #[test]
    fn the_depth_rate_of_a_steady_dive_is_found() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let mut navigator = Navigator::default();
        for tick in 0..400 {
            let depth_m = 0.3 * 0.25 * tick as f32;
            navigator.update(table.vehicle(), tick, &at((depth_m * 9_810.0) as i32, 0), false);
        }
        assert!((navigator.depth_rate_m_s - 0.3).abs() < 1e-3);
        assert!((navigator.depth_m - 0.3 * 0.25 * 399.0).abs() < 1e-2);
    }

    /// Diving at the polar's 0.44 m/s when pressure falls silent, then light and nose up: the model follows both.
    #[test]
    fn without_pressure_the_model_keeps_track_of_depth() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let mut navigator = Navigator::default();
        let sink_m_s = 0.77 * 35_f32.to_radians().sin();
        let depth_at = |tick: u32| sink_m_s * TICK_S * tick as f32;
        for tick in 0..800 {
            navigator.update(table.vehicle(), tick, &at((depth_at(tick) * 9_810.0) as i32, 0), false);
        }
        let silent = Measurements { pressure_pa: None, ..at(0, 0) };
        for tick in 800..1_200 {
            navigator.update(table.vehicle(), tick, &silent, false);
        }
        assert!(
            (navigator.depth_m - depth_at(1_199)).abs() < 0.5,
            "{} m, {} m in truth",
            navigator.depth_m,
            depth_at(1_199)
        );
        let mut rising = Measurements { vbd_ul: 212_900, ..silent };
        rising.attitude.as_mut().unwrap().pitch_cdeg = 3_378;
        for tick in 1_200..3_000 {
            navigator.update(table.vehicle(), tick, &rising, false);
        }
        assert_eq!(navigator.depth_m, 0.0, "at the surface, and not above it");
    }

    #[test]
    fn dead_reckoning_goes_where_the_nose_points_at_the_polars_speed() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let mut navigator = Navigator::default();
        for tick in 0..4_000 {
            navigator.update(table.vehicle(), tick, &at(0, 9_000), false);
        }
        let (north_mm, east_mm) = navigator.position_mm();
        // 0.77 m/s at −35° for 1000 s is 630.7 m; getting up to speed costs some metres.
        assert!((615_000..631_500).contains(&east_mm), "{east_mm}");
        assert!(north_mm.abs() < 100, "{north_mm}");
    }

    /// Adrift for 1000 s in 0.2 m/s to the east, as far as the fixes say; the next dive is reckoned with it.
    #[test]
    fn a_fix_after_a_dive_tells_the_current() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let mut navigator = Navigator::default();
        let fix = |east_m: f32| Measurements {
            gps: Some(GpsFix { lat_e7: 0, lon_e7: (east_m / M_PER_E7) as i32 }),
            ..Measurements::silent()
        };
        navigator.update(table.vehicle(), 0, &fix(0.0), true);
        navigator.update(table.vehicle(), 4_000, &fix(200.0), true);
        let (north_m_s, east_m_s) = navigator.current_m_s;
        assert!((east_m_s - 0.2).abs() < 1e-4 && north_m_s == 0.0, "{north_m_s}, {east_m_s}");
        navigator.update(table.vehicle(), 4_100, &fix(200.0), true);
        assert_eq!(navigator.current_m_s, (north_m_s, east_m_s), "too soon to tell anything");
    }

    #[test]
    fn the_first_fix_is_the_origin_and_later_ones_are_metres_from_it() {
        let file = file();
        let table = TrimTable::parse(&file).unwrap();
        let mut navigator = Navigator::default();
        let fix = |lat_e7, lon_e7| Measurements { gps: Some(GpsFix { lat_e7, lon_e7 }), ..at(0, 0) };
        navigator.update(table.vehicle(), 0, &fix(600_000_000, 1_799_999_000), true);
        assert!(navigator.has_position());
        assert_eq!(navigator.position_mm(), (0, 0));
        navigator.update(table.vehicle(), 1, &fix(600_010_000, -1_799_999_000), true);
        let (north_mm, east_mm) = navigator.position_mm();
        assert!((north_mm - 111_195).abs() <= 1, "{north_mm}");
        assert!((east_mm - 11_119).abs() <= 1, "{east_mm}, across the date line at 60° north");
    }
}
