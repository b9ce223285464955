//! The command line as a user meets it: answers on stdout, one clear line on bad input, nothing half written.

use std::{
    fs,
    io::Write,
    path::Path,
    process::{Command, Output, Stdio},
};

use serde_json::Value;

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
