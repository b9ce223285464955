//! The command line as a user meets it: answers on stdout, one clear line on bad input, nothing half written.

use std::{
    fs,
    io::Write,
    path::Path,
    process::{Command, Output, Stdio},
};

use serde_json::Value;
use shared::wire::{Decoder, MAX_FRAME, Message, encode};

fn glider(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_glider")).args(arguments).output().unwrap()
}

fn json(output: &Output) -> Value {
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The one line of an error, and nothing on stdout.
fn refusal(output: &Output) -> String {
    assert!(!output.status.success());
    assert!(output.stdout.is_empty());
    let text = String::from_utf8(output.stderr.clone()).unwrap();
    let line = text.strip_suffix('\n').unwrap();
    assert!(!line.contains('\n'), "one line, not: {text}");
    line.to_string()
}

fn in_folder(test: impl FnOnce(&Path)) {
    let folder = tempfile::tempdir().unwrap();
    test(folder.path());
}

#[test]
fn trim_answers_in_json_as_promised() {
    let answer = json(&glider(&["trim", "slocum-paper", "--path-angle-deg", "-35", "--speed", "0.77", "--json"]));
    assert!((answer["net_mass_kg"].as_f64().unwrap() - 0.2129).abs() < 5e-5);
    assert!((answer["alpha_rad"].as_f64().unwrap().to_degrees() - 1.2247).abs() < 5e-5);
    assert!((answer["r_px_m"].as_f64().unwrap() - 0.2826).abs() < 5e-5);
    assert_eq!(answer["warnings"], Value::Array(Vec::new()));
}

#[test]
fn a_limit_of_an_actuator_is_a_warning_on_stderr_not_an_error() {
    let output = glider(&["trim", "slocum-paper", "--path-angle-deg", "-60"]);
    assert!(output.status.success());
    assert!(String::from_utf8_lossy(&output.stderr).contains("warning: r_px"));
}

#[test]
fn a_lopsided_vehicle_keeps_the_contract_of_every_analysis() {
    in_folder(|folder| {
        let file = folder.join("lopsided.toml");
        let text = include_str!("../vehicles/slocum-paper.toml")
            .replace("[0, 0, 0.0713975]", "[0.005, 0.004, 0.07]")
            .replace("[[0, 0, 0], [0, 0, 0], [0, 0, 0]]", "[[0.5, -1, 0.8], [1.2, 0.4, -2], [0.7, 3, -0.6]]");
        fs::write(&file, text).unwrap();
        let ask = |command: &str, more: &[&str]| {
            let vehicle = file.to_str().unwrap();
            json(&glider(
                &[&[command, vehicle, "--path-angle-deg", "-26", "--net-mass", "0.25", "--json"], more].concat(),
            ))
        };
        let banked = |answer: &Value| {
            let warnings = answer["warnings"].as_array().unwrap();
            assert!(warnings.iter().any(|line| line.as_str().unwrap().contains("glides straight with a bank of")));
        };
        let trim = ask("trim", &[]);
        banked(&trim);
        assert_eq!(trim["net_mass_kg"], 0.25);
        assert!(["beta_rad", "phi_rad", "mu_rad"].iter().all(|name| trim[name].is_f64()), "{trim}");
        let turn = ask("turn", &["--turn-rate-rad-s", "0"]);
        banked(&turn);
        assert!(turn["sensitivity"]["linear"].is_null() && turn["sensitivity"]["closed_form"].is_null());
        assert!(turn["sensitivity"]["numeric"]["mu_s"].is_f64() && turn["exact"]["radius_m"].is_null(), "{turn}");
        assert!((turn["exact"]["mu_rad"].as_f64().unwrap() - trim["mu_rad"].as_f64().unwrap()).abs() < 1e-9);
        let modes = ask("modes", &[]);
        banked(&modes);
        assert!(modes["warnings"].as_array().unwrap().iter().any(|line| line.as_str().unwrap().contains("coupled")));
        assert_eq!(modes["coupled_eigenvalues"].as_array().unwrap().len(), 8);
    });
}

#[test]
fn what_cannot_be_flown_is_said_with_the_nearest_that_can() {
    let glide = ["slocum-paper", "--path-angle-deg", "-35"];
    let ask = |command: &str, more: &[&str]| refusal(&glider(&[&[command], &glide[..], more].concat()));
    let line = ask("turn", &["--turn-rate-rad-s", "0.1", "--json"]);
    let start = "error: turn rate 0.1 rad/s: the largest that slocum-paper reaches at this pitch and net mass is 0.00";
    assert!(line.starts_with(start) && line.contains(" rad/s, at mu -") && line.contains("speed 0."), "{line}");
    assert_eq!(ask("turn", &["--turn-rate-rad-s", "nan"]), "error: turn rate NaN rad/s: must be a finite number");
    for command in ["trim", "turn", "modes"] {
        let line = ask(command, &["--speed", "1e300", "--json"]);
        assert_eq!(line, "error: speed 1e300 m/s: takes a net mass of inf kg, but slocum-paper has only 50 kg in all");
    }
    in_folder(|folder| {
        let file = folder.join("listing.toml");
        let text = include_str!("../vehicles/slocum-paper.toml").replace("[0, 0, 0.0713975]", "[0, 0.03, 0.07]");
        fs::write(&file, text).unwrap();
        for command in ["trim", "turn", "modes"] {
            let line = refusal(&glider(&[command, file.to_str().unwrap(), "--path-angle-deg", "-26", "--json"]));
            let start = "error: slocum-paper: no steady helix with path angle -26.000°, turn rate 0.000000 rad/s, speed 0.7700 m/s: ";
            assert!(
                line.starts_with(start) && line.contains(" N is left; the nearest found has path angle -26.000°"),
                "{line}"
            );
            assert!(
                ["mu ", "speed ", "roll ", "net mass "].iter().all(|name| line.matches(name).count() >= 1),
                "{line}"
            );
        }
        let table = folder.join("steep.table");
        let steep = ["--dive-deg", "12", "60", "--mu-deg", "90", "-o", table.to_str().unwrap()];
        let line = refusal(&glider(&[&["table", "slocum-paper"], &steep[..]].concat()));
        assert!(line.contains("no steady helix with path angle -") && line.contains("the nearest found has"), "{line}");
        assert!(!table.exists());
    });
}

#[test]
fn eval_reads_stdin_and_refuses_what_it_does_not_know() {
    let ask = |text: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_glider"))
            .args(["eval", "slocum-paper", "--json"])
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
        child.wait_with_output().unwrap()
    };
    assert_eq!(
        refusal(&ask(r#"{"positon_m": [0, 0, 0]}"#)).split(',').next().unwrap(),
        "error: stdin: unknown field `positon_m`"
    );
    assert!(refusal(&ask("{")).starts_with("error: stdin: EOF while parsing an object at line 1 column 1"));
}

#[test]
fn fly_writes_a_folder_and_the_same_bits_every_time() {
    in_folder(|folder| {
        let out = folder.join("dive");
        let arguments = ["fly", "--json", "--seed", "7", "--out", out.to_str().unwrap()];
        let (first, second) = (json(&glider(&arguments)), json(&glider(&arguments)));
        assert_eq!(first["outcome"], "completed");
        assert_eq!(first["trace_hash"], second["trace_hash"]);
        let summary: Value = serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
        assert_eq!(summary, second);
        let record = fs::read_to_string(out.join("record.csv")).unwrap();
        assert_eq!(record.lines().count() as u64, 1 + second["ticks"].as_u64().unwrap());
        for file in ["report.html", "record.parquet"] {
            assert!(fs::metadata(out.join(file)).unwrap().len() > 10_000, "{file}");
        }
    });
}

#[test]
fn a_flown_folder_replays_and_a_changed_log_does_not() {
    in_folder(|folder| {
        let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
        let flown = json(&glider(&["fly", "slow-50", "--json", "--out", &path("")]));
        let replayed = json(&glider(&["replay", &path("flight.frames"), "--json"]));
        assert_eq!(replayed["same"], true);
        assert_eq!((&replayed["ticks"], &replayed["trace_hash"]), (&flown["ticks"], &flown["trace_hash"]));

        let line = refusal(&glider(&["replay", &path("record.csv")]));
        assert!(
            line.contains("record.table: ") && line.ends_with("--table names the trim table that flew it"),
            "{line}"
        );
        let with_table = |log: &str, more: &[&str]| {
            glider(&[&["replay", &path(log), "--table", &path("flight.table")], more].concat())
        };
        let line = refusal(&with_table("record.csv", &[]));
        assert!(line.contains("record.csv: byte 0: hello: no end of a frame within 512 bytes"), "{line}");

        // The last answer once more, with another command: the position 1 mm farther north.
        let mut frames: Vec<Vec<u8>> =
            fs::read(path("flight.frames")).unwrap().split_inclusive(|byte| *byte == 0).map(<[u8]>::to_vec).collect();
        let last = frames.pop().unwrap();
        let mut decoder = Decoder::default();
        let (header, mut message) = last.iter().find_map(|byte| decoder.push(*byte)).unwrap().unwrap();
        let Message::Actuators(answer) = &mut message else { panic!("{message:?}") };
        answer.commands.north_mm += 1;
        let tick = answer.tick;
        frames.push(encode(&header, &message, &mut [0; MAX_FRAME]).unwrap().to_vec());
        fs::write(path("changed.frames"), frames.concat()).unwrap();
        let line = refusal(&with_table("changed.frames", &[]));
        assert!(line.contains(&format!(": tick {tick} (")) && line.contains("`north_mm` was "), "{line}");
        let output = with_table("changed.frames", &["--json"]);
        assert!(!output.status.success());
        let answer: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((&answer["same"], &answer["difference"]["tick"]), (&Value::from(false), &Value::from(tick)));
    });
}

#[test]
fn a_mission_beyond_the_vehicle_is_refused_before_anything_is_written() {
    in_folder(|folder| {
        let mission = folder.join("deep.toml");
        let text = include_str!("../missions/default.toml").replace("dive_to_m = 200", "dive_to_m = 210");
        fs::write(&mission, text).unwrap();
        let out = folder.join("dive");
        let line = refusal(&glider(&["fly", mission.to_str().unwrap(), "--out", out.to_str().unwrap()]));
        assert!(
            line.contains(
                "deep.toml:12:13: `mission.dive_to_m` is 210, but this vehicle and its trim table take 1 to 200"
            ),
            "{line}"
        );
        assert!(!out.exists());
    });
}

#[test]
fn faults_are_flown_and_named_in_the_summary() {
    in_folder(|folder| {
        let out = folder.join("dive");
        let fly = |faults: &str| glider(&["fly", "--faults", faults, "--json", "--out", out.to_str().unwrap()]);
        let answer = json(&fly("leak"));
        assert_eq!((&answer["faults"], &answer["outcome"]), (&Value::from("leak"), &Value::from("aborted")));
        assert_eq!(answer["aborts"], serde_json::json!(["Leak"]));
        let summary: Value = serde_json::from_slice(&fs::read(out.join("summary.json")).unwrap()).unwrap();
        assert_eq!(summary, answer);
    });
}

#[test]
fn bad_faults_are_refused_before_anything_is_written() {
    in_folder(|folder| {
        let (faults, out) = (folder.join("faults.toml"), folder.join("dive"));
        fs::write(&faults, "[sensors]\ngps_nose_m = 3\n").unwrap();
        let line = refusal(&glider(&["fly", "--faults", faults.to_str().unwrap(), "--out", out.to_str().unwrap()]));
        assert!(line.ends_with("faults.toml:2:1: unknown key `gps_nose_m`; did you mean `gps_noise_m`?"), "{line}");
        assert!(!out.exists());
    });
}

#[test]
fn a_table_for_another_vehicle_or_a_damaged_one_is_refused() {
    in_folder(|folder| {
        let (vehicle, table) = (folder.join("light.toml"), folder.join("light.table"));
        let text = include_str!("../vehicles/slocum-paper.toml").replace("mass_kg = 40 ", "mass_kg = 41 ");
        fs::write(&vehicle, text).unwrap();
        let made = glider(&["table", vehicle.to_str().unwrap(), "-o", table.to_str().unwrap(), "--json"]);
        let errors = &json(&made)["interpolation_error"];
        assert!(
            errors["dive"]["speed"].as_f64().unwrap() < 0.01 && errors["climb"]["turn_rate"].as_f64().unwrap() < 0.05
        );

        let fly = || glider(&["fly", "--table", table.to_str().unwrap(), "--out", folder.to_str().unwrap()]);
        assert!(refusal(&fly()).contains("light.table: the table is for another vehicle"));
        let mut bytes = fs::read(&table).unwrap();
        bytes[100] ^= 1;
        fs::write(&table, bytes).unwrap();
        assert!(refusal(&fly()).ends_with("light.table: the table is damaged: its CRC does not fit"));
    });
}

#[test]
fn an_output_that_cannot_be_written_is_named() {
    let line = refusal(&glider(&["table", "slocum-paper", "-o", "/no/such/folder/t.table"]));
    assert_eq!(line, "error: /no/such/folder/t.table: No such file or directory (os error 2)");
}
