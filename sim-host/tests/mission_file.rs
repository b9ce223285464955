//! A mission file's human units become the mission's integers; its mistakes are answered with one line.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use shared::{
    mission::{Course, Mission},
    model::table::TrimTable,
    parameters::Parameters,
};
use sim_host::{
    analysis::table::{Envelope, generate},
    flight::{
        FlyingVehicle,
        mission_file::{MissionFile, Start},
    },
    model::vehicle::Vehicle,
};

const DEFAULT: &str = include_str!("../missions/default.toml");

fn mistake(passage: &str, replacement: &str) -> String {
    assert_eq!(DEFAULT.matches(passage).count(), 1, "`{passage}` must stand once");
    MissionFile::from_toml(&DEFAULT.replace(passage, replacement), "m.toml").unwrap_err().to_string()
}

#[test]
fn the_default_mission_is_two_yos_to_200_m_with_a_turn() {
    let file = MissionFile::load("default").unwrap();
    assert_eq!(file.vehicle, "slocum-paper");
    assert_eq!(file.start, Start { latitude_deg: 59.0, longitude_deg: 5.0, heading_deg: 0.0 });
    assert_eq!(file.parameters, Parameters::default());
    let expected = Mission {
        yos: 2,
        surfacings: 1,
        dive_to_mm: 200_000,
        climb_to_mm: 5_000,
        dive_path_angle_cdeg: -2_600,
        climb_path_angle_cdeg: 2_600,
        dive_net_mass_g: 250,
        climb_net_mass_g: -250,
        course: Course::Headings([3_000, 6_000, 6_000, 6_000].into_iter().collect()),
        drift_time_s: 0,
        flare_depth_mm: 0,
        surface_time_s: 60,
        altitude_mm: 0,
        abort_depth_mm: 215_000,
        max_duration_s: 10_800,
    };
    assert_eq!(file.mission, expected);
}

#[test]
fn headings_wrap_into_one_turn() {
    let text = DEFAULT.replace("[30, 60, 60, 60]", "[-10, 360, 359.999, 90.5]");
    let course = MissionFile::from_toml(&text, "m.toml").unwrap().mission.course;
    assert_eq!(course, Course::Headings([35_000, 0, 0, 9_050].into_iter().collect()));
}

#[test]
fn a_dive_may_turn_above_the_floor() {
    let text = DEFAULT.replace("# altitude_m = 15", "altitude_m = 15.5");
    assert_eq!(MissionFile::from_toml(&text, "m.toml").unwrap().mission.altitude_mm, 15_500);
}

#[test]
fn parameters_override_their_defaults_within_bounds() {
    let text = DEFAULT.to_owned() + "[parameters]\nmu_limit_cdeg = 3000\n";
    let parameters = MissionFile::from_toml(&text, "m.toml").unwrap().parameters;
    assert_eq!(parameters, Parameters { mu_limit_cdeg: 3_000, ..Parameters::default() });

    let text = DEFAULT.to_owned() + "[parameters]\nmu_limit_cdeg = 99\n";
    let line = MissionFile::from_toml(&text, "m.toml").unwrap_err().to_string();
    assert_eq!(line, "m.toml:24:17: `parameters.mu_limit_cdeg` is 99, but must be a whole number from 100 to 9000");
}

#[test]
fn mistakes_are_answered_with_their_place() {
    let rows = [
        ("yos = 2", "yoz = 2", "m.toml:11:1: unknown key `yoz`; did you mean `yos`?"),
        ("heading_deg = 0", "heading = 0", "m.toml:8:1: unknown key `heading`; did you mean `heading_deg`?"),
        ("vehicle =", "vehicel =", "m.toml:3:1: unknown key `vehicel`; did you mean `vehicle`?"),
        ("yos = 2", "yos = 0", "m.toml:11:7: `mission.yos` is 0, but must be a whole number from 1 to 65535"),
        ("yos = 2", "yos = 2.5", "m.toml:11:7: `mission.yos` is 2.5, but must be a whole number from 1 to 65535"),
        ("yos = 2", "", "m.toml:10:1: missing key `mission.yos`: a whole number from 1 to 65535"),
        (
            "climb_to_m = 5",
            "climb_to_m = 200",
            "m.toml:13:14: `mission.climb_to_m` is 200, but must be less than `dive_to_m`",
        ),
        ("= 215", "= 199", "m.toml:20:17: `mission.abort_depth_m` is 199, but must be more than `dive_to_m`"),
        ("= -26", "= 26", "m.toml:14:23: `mission.dive_path_angle_deg` is 26, but must be a number from -90 to 0"),
        (
            "[30, 60, 60, 60]",
            "[]",
            "m.toml:18:16: `mission.headings_deg` is [], but must be 1 to 32 numbers, each a number from -360 to 360",
        ),
        (
            "yos = 2",
            "yos = 2\naltitude_m = 101",
            "m.toml:12:14: `mission.altitude_m` is 101, but must be a number from 0 to 100",
        ),
        ("= 59.0", "= 95", "m.toml:6:16: `start.latitude_deg` is 95, but must be a number from -90 to 90"),
    ];
    for (passage, replacement, expected) in rows {
        assert_eq!(mistake(passage, replacement), expected);
    }
}

/// What an editor offers and requires is what the reader reads: missions of every kind, key by key.
#[test]
fn the_schema_knows_every_key_of_the_embedded_missions() {
    fn knows(schema: &serde_json::Value, table: &toml_edit::Table, path: &str) {
        for (key, item) in table {
            let property = &schema["properties"][key];
            assert!(property.is_object(), "{path}{key}");
            if let Some(section) = item.as_table() {
                knows(property, section, &format!("{path}{key}."));
            }
        }
    }
    let schema = MissionFile::schema();
    let texts = [
        include_str!("../missions/default.toml"),
        include_str!("../missions/drift.toml"),
        include_str!("../missions/mooring.toml"),
        WAYPOINTS,
    ];
    for text in texts {
        knows(&schema, &text.parse::<toml_edit::DocumentMut>().unwrap(), "");
    }
    let sections = &schema["properties"];
    assert!(sections["mission"]["required"].as_array().unwrap().contains(&"yos".into()));
    let period = &sections["parameters"]["properties"]["pitch_period_s"];
    assert_eq!((&period["minimum"], &period["default"]), (&2.into(), &40.into()));
    assert!(period["description"].as_str().unwrap().contains("pitch corrections"));
}

const WAYPOINTS: &str = include_str!("../missions/waypoints.toml");

fn slocum() -> (Vehicle, Vec<u8>) {
    let vehicle = Vehicle::load("slocum-paper").unwrap();
    let table = generate(&vehicle, &Envelope::default()).unwrap();
    (vehicle, table)
}

#[test]
fn pitch_and_vertical_speed_become_the_glide_that_has_them() {
    let (_, bytes) = slocum();
    let table = TrimTable::parse(&bytes).unwrap();
    let mission = MissionFile::load("waypoints").unwrap().resolve(&table).unwrap().mission;
    for (path_cdeg, net_mass_g, pitch_deg, sink_m_s) in [
        (mission.dive_path_angle_cdeg, mission.dive_net_mass_g, -22.0, 0.25),
        (mission.climb_path_angle_cdeg, mission.climb_net_mass_g, 22.0, -0.25),
    ] {
        let path_rad = (f32::from(path_cdeg) / 100.0).to_radians();
        let glide = table.look_up(path_rad, f32::from(net_mass_g) / 1e3, 0.0);
        // Path angles are whole hundredths of a degree and net masses whole grams: 1 g of 150 is 0.3 % of speed.
        assert!((f64::from(glide.pitch_rad).to_degrees() - pitch_deg).abs() < 0.02, "{glide:?}");
        assert!((f64::from(glide.sink_rate_m_s) / sink_m_s - 1.0).abs() < 0.005, "{glide:?}");
    }
}

#[test]
fn a_glide_out_of_reach_is_refused_with_what_is_within() {
    let (_, bytes) = slocum();
    let table = TrimTable::parse(&bytes).unwrap();
    for (passage, replacement, begin) in [
        ("dive_pitch_deg = -22", "dive_pitch_deg = -60", "m.toml:15:18: `mission.dive_pitch_deg` is -60, but"),
        ("climb_pitch_deg = 22", "climb_pitch_deg = 2", "m.toml:16:19: `mission.climb_pitch_deg` is 2, but"),
        ("_s = 0.25 ", "_s = 2 ", "m.toml:17:27: `mission.dive_vertical_speed_m_s` is 2, but"),
    ] {
        let file = MissionFile::from_toml(&WAYPOINTS.replace(passage, replacement), "m.toml").unwrap();
        let line = file.resolve(&table).unwrap_err().to_string();
        assert!(line.starts_with(begin) && line.contains("take"), "{line}");
    }
}

#[test]
fn a_battery_too_small_for_the_mission_is_told() {
    let (mut vehicle, bytes) = slocum();
    let table = TrimTable::parse(&bytes).unwrap();
    let file = MissionFile::load("default").unwrap();
    let check = |vehicle: &Vehicle| file.check_energy(&FlyingVehicle::new(vehicle).unwrap(), &table);
    assert_eq!(check(&vehicle), Ok(()));
    vehicle.energy.as_mut().unwrap().battery_j = 5e3;
    let line = check(&vehicle).unwrap_err().to_string();
    assert!(
        line.starts_with("missions/default.toml:11:7: `mission.yos` is 2 for 1 surfacing, which takes 0.0"),
        "{line}"
    );
    assert!(
        line.ends_with("but the battery holds 0.01 MJ") || line.ends_with("but the battery holds 0.00 MJ"),
        "{line}"
    );
}

#[test]
fn a_course_is_one_of_three_and_its_mistakes_have_a_place() {
    let row = |text: &str, passage: &str, replacement: &str| {
        assert_eq!(text.matches(passage).count(), 1, "`{passage}` must stand once");
        MissionFile::from_toml(&text.replace(passage, replacement), "m.toml").unwrap_err().to_string()
    };
    assert!(
        row(DEFAULT, "headings_deg = [30, 60, 60, 60]", "")
            .starts_with("m.toml:10:1: missing key `mission.headings_deg`")
    );
    assert_eq!(
        row(WAYPOINTS, "surface_time_s = 300", "surface_time_s = 300\nheadings_deg = [7]"),
        "m.toml:20:16: `mission.headings_deg` is [7], but must be left out beside `waypoints`"
    );
    assert_eq!(
        row(WAYPOINTS, "dive_pitch_deg = -22", "dive_pitch_deg = -22\ndive_path_angle_deg = -26"),
        "m.toml:15:18: `mission.dive_pitch_deg` is -22, but must be left out beside `dive_path_angle_deg`"
    );
    assert_eq!(
        row(WAYPOINTS, "capture_radius_m = 200", "capture_radius_m = 5"),
        "m.toml:25:20: `mission.waypoints.capture_radius_m` is 5, but must be a number from 10 to 100000"
    );
    assert_eq!(
        row(WAYPOINTS, "places_m = [[2000, 0], [2000, 1500], [0, 0]]", "places_deg = [[91, 0]]"),
        "m.toml:24:14: `mission.waypoints.places_deg` is [[91, 0]], but must be 1 to 16 rows of [north, east] on the Earth"
    );
}

#[test]
fn places_in_metres_lie_where_the_sphere_has_them() {
    let Course::Waypoints(route) = MissionFile::load("waypoints").unwrap().mission.course else { panic!("a route") };
    // 2000 m of 6371 km is 0.0179864°; a degree of longitude at 59° north is 0.5150381 of one of latitude.
    let place = &route.places[1];
    assert!((place.lat_e7 - 590_179_864).abs() <= 1, "{place:?}");
    assert!((place.lon_e7 - 50_261_920).abs() <= 5, "{place:?}");
    assert_eq!((route.places[2].lat_e7, route.places[2].lon_e7), (590_000_000, 50_000_000));
}
