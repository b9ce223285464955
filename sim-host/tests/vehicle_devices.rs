//! The keys of a vehicle file that describe its devices.

use sim_host::model::vehicle::{AxialDrive, Drive, EngineKind, Vehicle};

/// The paper's Slocum with more lines at the top of one section.
fn slocum_with(section: &str, lines: &str) -> Result<Vehicle, String> {
    let text = include_str!("../vehicles/slocum-paper.toml");
    let header = format!("[{section}]");
    assert!(text.contains(&header));
    let text = text.replacen(&header, &format!("{header} #"), 1);
    let begin = text.find(&header).unwrap();
    let end = begin + text[begin..].find('\n').unwrap() + 1;
    let text = format!("{}{lines}\n{}", &text[..end], &text[end..]);
    Vehicle::from_toml(&text, "slocum.toml").map_err(|error| error.message)
}

fn kind(lines: &str) -> EngineKind {
    slocum_with("buoyancy", lines).unwrap().buoyancy.unwrap().engine.kind
}

#[test]
fn a_buoyancy_engine_is_a_piston_unless_it_is_a_bladder() {
    assert_eq!(kind(""), EngineKind::Piston { dead_zone_m3: 0.0 });
    assert_eq!(kind("dead_zone_m3 = 42e-6"), EngineKind::Piston { dead_zone_m3: 42e-6 });
    let bladder = kind("kind = \"bladder\"\nvacuum_pa = 20e3");
    assert_eq!(bladder, EngineKind::Bladder { vacuum_pa: 20e3, full_bleed_head_pa: 1e5 });
    let refused = slocum_with("buoyancy", "vacuum_pa = 20e3").unwrap_err();
    assert!(refused.starts_with("unknown key `vacuum_pa`"), "a piston has no vacuum: {refused}");
}

#[test]
fn tables_over_pressure_rise() {
    let read = slocum_with("buoyancy", "pump_rate_at = [[0, 2e-6], [1e7, 1.1e-6]]").unwrap();
    assert_eq!(read.buoyancy.unwrap().engine.pump_rate_at, [[0.0, 2e-6], [1e7, 1.1e-6]]);
    for wrong in ["pump_rate_at = []", "pump_power_at = [[1e6, 5], [0, 4]]", "pump_power_at = [[0, 0]]"] {
        let refused = slocum_with("buoyancy", wrong).unwrap_err();
        assert!(refused.contains("must be rows of [pressure in Pa, rising;"), "{wrong}: {refused}");
    }
}

#[test]
fn a_dynamic_drive_may_leave_out_what_it_likes() {
    assert_eq!(slocum_with("moving_mass", "").unwrap().moving_mass.drive, Drive::Kinematic);
    let read = slocum_with("moving_mass", "drive = \"dynamic\"\naxial = { friction_n = 20, backlash_m = 0 }").unwrap();
    let Drive::Dynamic { axial, rotation } = read.moving_mass.drive else { panic!("not dynamic") };
    assert_eq!(axial, AxialDrive { friction_n: 20.0, backlash_m: 0.0, ..AxialDrive::default() });
    assert_eq!(rotation, Default::default());
    let refused = slocum_with("moving_mass", "axial = { friction_n = 20 }").unwrap_err();
    assert!(refused.starts_with("unknown key `axial`"), "a kinematic drive has no friction: {refused}");
}

/// At the crush depth, 300 m or 2.943 MPa, the pump's efficiency is 0.08 + 0.19 · 1.943/4 = 0.1723: 5 W + 2.943e6 ·
/// 42e-6 W/0.1723.
#[test]
fn a_peak_power_bears_the_strongest_motor_alone() {
    let peak_w = |lines: &str| slocum_with("energy", lines).map(|vehicle| vehicle.energy.unwrap().peak_power_w);
    assert_eq!((peak_w(""), peak_w("peak_power_w = 723")), (Ok(None), Ok(Some(723.0))));
    let refused = peak_w("peak_power_w = 722").unwrap_err();
    assert!(refused.contains("peak_power_w") && refused.contains("at least 722.4"), "{refused}");
}

#[test]
fn how_it_is_driven_and_built_changes_the_fingerprint() {
    let plain = slocum_with("buoyancy", "").unwrap().hash();
    for (section, lines) in [
        ("buoyancy", "kind = \"bladder\""),
        ("buoyancy", "dead_zone_m3 = 1e-6"),
        ("buoyancy", "bleed_power_w = 1"),
        ("moving_mass", "drive = \"dynamic\""),
        ("energy", "peak_power_w = 800"),
    ] {
        assert_ne!(slocum_with(section, lines).unwrap().hash(), plain, "{lines}");
    }
}
