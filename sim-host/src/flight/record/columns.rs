//! The columns of a record: one table for every format.
//!
//! OG1 names (OceanGliders format 1.0, upper case) stand where one exists, in OG1's units: degrees, metres, dbar. All other
//! names carry their unit; those of measurements and commands are the controller's own, in its integers, so that a record
//! replays. OG1's `TIME` counts from 1970, which a simulation does not know: the time is `time_s`.

use shared::{
    commands::{Aim, Phase},
    device::{Attitude, GpsFix, MM_PER_M},
};

use super::{Record, Sample};
use crate::flight::mission_file::M_PER_DEG;

/// Pascals per decibar.
const PA_PER_DBAR: f64 = 1e4;
/// Depth below which a vehicle in recovery still ascends, m.
const AFLOAT_M: f64 = 1.0;

/// One column: a name, what it means with its unit, and how to get its value.
#[derive(Clone, Copy, Debug)]
pub struct Column {
    /// Its name, the same in every format.
    pub name: &'static str,
    /// What it means.
    pub about: &'static str,
    /// How to get its value.
    pub value: Value,
}

/// How to get a value; nothing where there is none.
#[derive(Clone, Copy, Debug)]
pub enum Value {
    /// A whole number.
    Integer(fn(&Sample) -> Option<i64>),
    /// A number.
    Real(fn(&Record, &Sample) -> Option<f64>),
    /// A word.
    Text(fn(&Sample) -> Option<String>),
}

const fn integer(name: &'static str, about: &'static str, get: fn(&Sample) -> Option<i64>) -> Column {
    Column { name, about, value: Value::Integer(get) }
}

const fn real(name: &'static str, about: &'static str, get: fn(&Record, &Sample) -> Option<f64>) -> Column {
    Column { name, about, value: Value::Real(get) }
}

const fn text(name: &'static str, about: &'static str, get: fn(&Sample) -> Option<String>) -> Column {
    Column { name, about, value: Value::Text(get) }
}

/// Every column, in order.
pub const COLUMNS: &[Column] = &[
    integer("tick", "ticks since the start", |s| Some(s.tick.into())),
    real("time_s", "time since the start", |_, s| Some(s.time_s())),
    // OG1
    integer("PHASE", "1 ascent, 2 descent, 3 surfacing, 4 parking, 5 inflexion", |s| Some(og1_phase(s))),
    integer("PROFILE_NUMBER", "descents and ascents, counted from 1; 0 before the first", |s| Some(profile_number(s))),
    real("PRES", "measured pressure above the air's, dbar", |_, s| Some(pressure_pa(s)? / PA_PER_DBAR)),
    real("DEPTH", "depth from the measured pressure, m", |r, s| {
        Some(pressure_pa(s)? / (r.water.density_kg_m3 * r.water.gravity_m_s2))
    }),
    real("PITCH", "measured pitch, deg, nose up positive", |_, s| Some(degrees(attitude(s)?.pitch_cdeg))),
    real("ROLL", "measured roll, deg, right wing down positive", |_, s| Some(degrees(attitude(s)?.roll_cdeg))),
    real("HEADING", "measured heading, deg clockwise from true north", |_, s| Some(degrees(attitude(s)?.heading_cdeg))),
    real("LATITUDE", "dead-reckoned latitude, deg", |r, s| Some(latitude_deg(r, s))),
    real("LONGITUDE", "dead-reckoned longitude, deg", |r, s| Some(longitude_deg(r, s))),
    real("LATITUDE_GPS", "latitude of a position fix, deg", |_, s| Some(f64::from(fix(s)?.lat_e7) / 1e7)),
    real("LONGITUDE_GPS", "longitude of a position fix, deg", |_, s| Some(f64::from(fix(s)?.lon_e7) / 1e7)),
    real("TEMP", "temperature of the water at the vehicle, °C; a truth, there is no CTD on board", |_, s| {
        s.truth.water.around.temperature_c
    }),
    real("PSAL", "its practical salinity", |_, s| s.truth.water.salinity),
    real("DENSITY", "its in-situ density, kg/m³", |_, s| Some(s.truth.water.around.density_kg_m3)),
    // What the controller was told
    integer("pressure_pa", "pressure above the air's", |s| Some(s.measurements.pressure_pa?.into())),
    integer("roll_cdeg", "roll", |s| Some(attitude(s)?.roll_cdeg.into())),
    integer("pitch_cdeg", "pitch", |s| Some(attitude(s)?.pitch_cdeg.into())),
    integer("heading_cdeg", "heading", |s| Some(attitude(s)?.heading_cdeg.into())),
    integer("pitch_rate_cdeg_s", "pitch rate", |s| Some(attitude(s)?.pitch_rate_cdeg_s.into())),
    integer("yaw_rate_cdeg_s", "yaw rate", |s| Some(attitude(s)?.yaw_rate_cdeg_s.into())),
    integer("r_px_um", "axial position of the moving mass", |s| Some(s.measurements.r_px_um.into())),
    integer("mu_cdeg", "rotation of the moving mass, left positive", |s| Some(s.measurements.mu_cdeg.into())),
    integer("vbd_ul", "volume of the buoyancy device beyond neutral", |s| Some(s.measurements.vbd_ul.into())),
    integer("battery_mv", "battery voltage under load", |s| Some(s.measurements.battery_mv?.into())),
    integer("charge_mc", "charge drawn from the battery", |s| s.measurements.charge_mc),
    integer("altitude_mm", "height above the sea floor", |s| Some(s.measurements.altitude_mm?.into())),
    integer("leak_mv", "voltage of the leak detector, high while dry", |s| Some(s.measurements.leak_mv?.into())),
    integer("vacuum_pa", "air pressure less the hull's", |s| Some(s.measurements.vacuum_pa?.into())),
    integer("lat_e7", "latitude of a position fix, 1e-7 deg", |s| Some(fix(s)?.lat_e7.into())),
    integer("lon_e7", "longitude of a position fix, 1e-7 deg", |s| Some(fix(s)?.lon_e7.into())),
    integer("modem_up", "1 with a link to shore, 0 without", |s| Some(s.measurements.modem_up.into())),
    // What it answered
    integer("r_px_rate_um_s", "commanded speed of the moving mass", |s| Some(s.commands.r_px_rate_um_s.into())),
    integer("mu_rate_cdeg_s", "commanded rotation of the moving mass", |s| Some(s.commands.mu_rate_cdeg_s.into())),
    integer("vbd_rate_ul_s", "commanded flow, pump positive", |s| Some(s.commands.vbd_rate_ul_s.into())),
    text("phase", "the controller's phase", |s| Some(format!("{:?}", s.commands.phase))),
    integer("yo", "dive cycle under way, from 1", |s| Some(s.commands.yo.into())),
    text("abort", "why the mission ended early", |s| Some(format!("{:?}", s.commands.abort?))),
    integer("target_pitch_cdeg", "pitch aimed at", |s| Some(s.commands.target_pitch_cdeg.into())),
    integer("target_heading_cdeg", "heading aimed at", |s| Some(s.commands.target_heading_cdeg.into())),
    text("aim", "what that heading is for", |s| Some(aim_word(s.commands.aim))),
    integer("north_mm", "dead-reckoned north of the start", |s| Some(s.commands.north_mm.into())),
    integer("east_mm", "dead-reckoned east of the start", |s| Some(s.commands.east_mm.into())),
    integer("weight_g", "learned weight beyond the buoyancy device's", |s| Some(s.commands.learned.weight_g.into())),
    integer("drag_permille", "learned drag beyond the vehicle file's", |s| {
        Some(s.commands.learned.drag_permille.into())
    }),
    integer("learned_current_north_mm_s", "learned current, north", |s| {
        Some(s.commands.learned.current_north_mm_s.into())
    }),
    integer("learned_current_east_mm_s", "learned current, east", |s| {
        Some(s.commands.learned.current_east_mm_s.into())
    }),
    integer("speed_permille", "learned speed beyond the reckoned one", |s| {
        Some(s.commands.learned.speed_permille.into())
    }),
    integer("compass_cdeg", "learned error of the compass", |s| Some(s.commands.learned.compass_cdeg.into())),
    integer("turn_bias_mdeg_s", "learned turn rate with the mass hanging down", |s| {
        Some(s.commands.learned.turn_bias_mdeg_s.into())
    }),
    integer("trim_um", "learned correction of the axial position", |s| Some(s.commands.learned.trim_um.into())),
    // What was
    real("true_north_m", "north of the start", |_, s| Some(s.truth.position_m.x)),
    real("true_east_m", "east of the start", |_, s| Some(s.truth.position_m.y)),
    real("true_depth_m", "depth of the centre of buoyancy", |_, s| Some(s.truth.position_m.z)),
    real("true_altitude_m", "height above the sea floor", |_, s| s.truth.altitude_m()),
    real("true_roll_rad", "roll", |_, s| Some(s.truth.euler_rad.x)),
    real("true_pitch_rad", "pitch", |_, s| Some(s.truth.euler_rad.y)),
    real("true_heading_rad", "heading", |_, s| Some(s.truth.euler_rad.z)),
    real("true_u_m_s", "velocity through the water along the body's forward axis", |_, s| Some(s.truth.velocity_m_s.x)),
    real("true_v_m_s", "velocity through the water along the body's right axis", |_, s| Some(s.truth.velocity_m_s.y)),
    real("true_w_m_s", "velocity through the water along the body's down axis", |_, s| Some(s.truth.velocity_m_s.z)),
    real("true_p_rad_s", "roll rate", |_, s| Some(s.truth.rate_rad_s.x)),
    real("true_q_rad_s", "pitch rate", |_, s| Some(s.truth.rate_rad_s.y)),
    real("true_r_rad_s", "yaw rate", |_, s| Some(s.truth.rate_rad_s.z)),
    real("true_r_px_m", "axial position of the moving mass", |_, s| Some(s.truth.r_px_m)),
    real("true_mu_rad", "rotation of the moving mass, left positive", |_, s| Some(s.truth.mu_rad)),
    real("true_displaced_volume_m3", "displaced volume", |_, s| Some(s.truth.displaced_volume_m3)),
    real("true_speed_m_s", "speed through the water", |_, s| Some(s.truth.speed_m_s())),
    real("true_alpha_rad", "angle of attack", |_, s| Some(s.truth.alpha_rad())),
    real("true_beta_rad", "sideslip", |_, s| Some(s.truth.beta_rad())),
    real("true_path_angle_rad", "path angle through the water, climbing positive", |_, s| {
        Some(s.truth.path_angle_rad())
    }),
    real("current_north_m_s", "velocity of the water, north", |_, s| Some(s.truth.water.around.current_m_s.x)),
    real("current_east_m_s", "velocity of the water, east", |_, s| Some(s.truth.water.around.current_m_s.y)),
    real("current_down_m_s", "velocity of the water, down", |_, s| Some(s.truth.water.around.current_m_s.z)),
    real("energy_pump_j", "used so far by the buoyancy pump", |_, s| Some(s.energy_j.pump)),
    real("energy_pitch_j", "used so far by the axial drive", |_, s| Some(s.energy_j.pitch)),
    real("energy_roll_j", "used so far by the rotation drive", |_, s| Some(s.energy_j.roll)),
    real("energy_hotel_j", "used so far by everything else", |_, s| Some(s.energy_j.hotel)),
    real("pump_work_j", "ideal work p ΔV of the pump so far", |_, s| Some(s.pump_work_j)),
    real("charge_c", "charge drawn from the battery so far", |_, s| Some(s.charge_c)),
];

fn attitude(sample: &Sample) -> Option<Attitude> {
    sample.measurements.attitude
}

fn fix(sample: &Sample) -> Option<GpsFix> {
    sample.measurements.gps
}

fn pressure_pa(sample: &Sample) -> Option<f64> {
    sample.measurements.pressure_pa.map(f64::from)
}

fn degrees(cdeg: impl Into<f64>) -> f64 {
    cdeg.into() / 100.0
}

fn latitude_deg(record: &Record, sample: &Sample) -> f64 {
    record.start.latitude_deg + f64::from(sample.commands.north_mm) / f64::from(MM_PER_M) / M_PER_DEG
}

fn longitude_deg(record: &Record, sample: &Sample) -> f64 {
    let parallel = M_PER_DEG * record.start.latitude_deg.to_radians().cos();
    let east_deg = f64::from(sample.commands.east_mm) / f64::from(MM_PER_M) / parallel;
    (record.start.longitude_deg + east_deg + 180.0).rem_euclid(360.0) - 180.0
}

/// OG1's code of a phase; a recovery counts as an ascent until it is afloat.
fn og1_phase(sample: &Sample) -> i64 {
    match sample.commands.phase {
        Phase::Climb | Phase::Surfacing => 1,
        Phase::Dive => 2,
        Phase::Surface | Phase::Complete => 3,
        Phase::Drift => 4,
        Phase::Apogee | Phase::Crest => 5,
        Phase::Recovery if sample.truth.position_m.z > AFLOAT_M => 1,
        Phase::Recovery => 3,
    }
}

/// The waypoint is numbered from 1; a `!` says that the current cannot be stemmed.
fn aim_word(aim: Aim) -> String {
    match aim {
        Aim::Heading => "heading".into(),
        Aim::Waypoint(number) => format!("waypoint {number}"),
        Aim::UnstemmedWaypoint(number) => format!("waypoint {number}!"),
        Aim::Spiral => "spiral".into(),
        Aim::Station => "station".into(),
        Aim::UnstemmedStation => "station!".into(),
    }
}

fn profile_number(sample: &Sample) -> i64 {
    let ascents = 2 * i64::from(sample.commands.yo);
    match sample.commands.phase {
        Phase::Dive | Phase::Drift | Phase::Apogee => ascents - 1,
        Phase::Surface | Phase::Climb | Phase::Crest | Phase::Surfacing | Phase::Complete | Phase::Recovery => ascents,
    }
}
