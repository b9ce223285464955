//! What the controller must know of the vehicle, from its file.

use shared::model::vehicle::{Actuators, FlightVehicle, GlideConstants, MotorPower, Range};

use super::{Envelope, gain::critical_heading_gains, lag::turn_lengths_m};
use crate::model::vehicle::{Buoyancy, Compass, Energy, Limits, Vehicle, Water};

/// What the controller must know of the vehicle, for flights in an envelope.
///
/// # Errors
/// One line: which section the vehicle file lacks to fly.
pub fn flight_vehicle(vehicle: &Vehicle, envelope: &Envelope) -> Result<FlightVehicle, String> {
    let lacks = |section: &str| format!("{}: flying needs the section [{section}]", vehicle.name);
    let buoyancy = vehicle.buoyancy.as_ref().ok_or_else(|| lacks("buoyancy"))?;
    let energy = vehicle.energy.as_ref().ok_or_else(|| lacks("energy"))?;
    let limits = vehicle.limits.as_ref().ok_or_else(|| lacks("limits"))?;
    let (mass, hydro, water) = (&vehicle.moving_mass, &vehicle.hydrodynamics, &vehicle.water);
    let integer = |value: f64| value.round() as i32;
    let range = |[min, max]: [f64; 2], scale: f64| Range { min: integer(min * scale), max: integer(max * scale) };
    let (um, ul, cdeg, mm) = (1e6, 1e9, 100.0, 1e3);
    let body_moment = vehicle.body.centre_of_mass_m * vehicle.body.mass_kg;
    let added_coupling = &vehicle.added_mass.coupling_kg_m;
    let q_s = 0.5 * water.density_kg_m3 * hydro.area_m2;
    Ok(FlightVehicle {
        hash: vehicle.hash(),
        name: vehicle.name.as_str().try_into().map_err(|_| format!("name {:?}: at most 32 bytes", vehicle.name))?,
        density_kg_m3: water.density_kg_m3 as f32,
        gravity_m_s2: water.gravity_m_s2 as f32,
        actuators: Actuators {
            r_px_um: range(mass.travel_m, um),
            mu_cdeg: range(mass.roll_deg, cdeg),
            vbd_ul: range(buoyancy.volume_m3, ul),
            r_px_rate_um_s: integer(mass.rate_m_s * um),
            mu_rate_cdeg_s: integer(mass.roll_rate_deg_s * cdeg),
            pump_rate_ul_s: integer(buoyancy.pump_rate_m3_s * ul),
            bleed_rate_ul_s: integer(buoyancy.bleed_rate_m3_s * ul),
        },
        power: motor_power(buoyancy, energy, limits, water),
        working_depth_mm: integer(limits.working_depth_m * mm),
        glide: GlideConstants {
            mass_kg: vehicle.mass_kg() as f32,
            mass_u_kg: (vehicle.mass_kg() + vehicle.added_mass.mass_kg.m11) as f32,
            mass_w_kg: (vehicle.mass_kg() + vehicle.added_mass.mass_kg.m33) as f32,
            drag_zero: (q_s * hydro.c_d_zero) as f32,
            drag_induced: (hydro.c_d_induced / q_s) as f32,
            lift_zero: (q_s * hydro.c_l_zero) as f32,
            lift_alpha: (q_s * hydro.c_l_alpha) as f32,
            lift_rate: (q_s * hydro.c_l_q * hydro.chord_m / (2.0 * vehicle.nominal_speed_m_s)) as f32,
            surge_coupling_kg_m: (body_moment.z + mass.mass_kg * mass.radius_m + added_coupling.m21) as f32,
            heave_coupling_kg_m: (body_moment.x - added_coupling.m23) as f32,
            moving_mass_kg: mass.mass_kg as f32,
            turn_length_m: turn_lengths_m(vehicle, envelope)?.map(|length_m| length_m as f32),
        },
        critical_heading_gain: critical_heading_gains(vehicle, envelope)?,
        compass: vehicle.compass.as_ref().map(Compass::flown).unwrap_or_default(),
    })
}

/// Powers are rounded up and the limit down, so that rounding never lets the motors draw more.
fn motor_power(buoyancy: &Buoyancy, energy: &Energy, limits: &Limits, water: &Water) -> MotorPower {
    const MW_PER_W: f64 = 1e3;
    let mw = |power_w: f64| (power_w * MW_PER_W).ceil() as u32;
    MotorPower {
        r_px_mw: mw(energy.pitch_motor_w),
        mu_mw: mw(energy.roll_motor_w),
        pump_mw: mw(buoyancy.most_pump_power_w(limits, water)),
        bleed_mw: mw(buoyancy.engine.bleed_power_w),
        peak_mw: energy.peak_power_w.map(|power_w| (power_w * MW_PER_W).floor() as u32),
    }
}
