//! A vehicle file's mistakes are answered with one line; its values, not its layout, make its fingerprint.

#![allow(clippy::unwrap_used, reason = "in a test a panic is the report")]

use sim_host::model::vehicle::{Elasticity, Vehicle};

const SLOCUM: &str = include_str!("../vehicles/slocum-paper.toml");

fn slocum() -> Vehicle {
    Vehicle::load("slocum-paper").unwrap()
}

/// The embedded file with one passage replaced.
fn with(passage: &str, replacement: &str) -> String {
    assert_eq!(SLOCUM.matches(passage).count(), 1, "`{passage}` must stand once");
    SLOCUM.replace(passage, replacement)
}

fn mistake(text: &str) -> String {
    Vehicle::from_toml(text, "v.toml").unwrap_err().to_string()
}

/// Line and column of a passage, from 1.
fn place(text: &str, passage: &str) -> String {
    place_of(text, text.find(passage).unwrap())
}

fn place_of(text: &str, offset: usize) -> String {
    let before = &text[..offset];
    let column = before.chars().rev().take_while(|character| *character != '\n').count();
    format!("v.toml:{}:{}: ", before.lines().count() + usize::from(column == 0), column + 1)
}

#[test]
fn the_papers_coefficients_give_back_its_k_form() {
    let slocum = slocum();
    let hydrodynamics = &slocum.hydrodynamics;
    let q_s = 0.5 * slocum.water.density_kg_m3 * hydrodynamics.area_m2;
    let (span, chord) = (hydrodynamics.span_m, hydrodynamics.chord_m);
    let per_rate = q_s / (2.0 * slocum.nominal_speed_m_s) * slocum.nominal_speed_m_s.powi(2);
    let rows = [
        ("K_D0", q_s * hydrodynamics.c_d_zero, 2.0),
        ("K_D", q_s * hydrodynamics.c_d_induced * hydrodynamics.c_l_alpha.powi(2), 45.0),
        ("K_L", q_s * hydrodynamics.c_l_alpha, 135.0),
        ("K_beta", -q_s * hydrodynamics.c_y_beta, 20.0),
        ("K_MR", q_s * span * hydrodynamics.c_roll_beta, -60.0),
        ("K_M", q_s * chord * hydrodynamics.c_m_alpha, -50.0),
        ("K_MY", q_s * span * hydrodynamics.c_n_beta, 100.0),
        ("K_p at V0", per_rate * span * span * hydrodynamics.c_roll_p, -20.0),
        ("K_q at V0", per_rate * chord * chord * hydrodynamics.c_m_q, -60.0),
        ("K_r at V0", per_rate * span * span * hydrodynamics.c_n_r, -20.0),
    ];
    for (name, value, printed) in rows {
        assert!((value / printed - 1.0).abs() < 1e-12, "{name} is {value}, not {printed}");
    }
    assert_eq!(slocum.mass_kg(), 50.0);
}

#[test]
fn a_mistyped_key_of_any_section_is_named_with_the_nearest() {
    let rows = [
        ("nominal_speed_m_s", "nominal_sped_m_s"),
        ("length_m", "lenght_m"),
        ("span_ratio", "span_ration"),
        ("area_ratio", "area_ratios"),
        ("ballast_kg", "balast_kg"),
        ("radius_m", "radus_m"),
        ("coupling_kg_m", "coupling_kg"),
        ("moment_frame", "momentframe"),
        ("induced", "inducd"),
        ("pump_rate_m3_s", "pump_rate_m_s"),
        ("hotel_w", "hotel"),
        ("crush_depth_m", "crash_depth_m"),
        ("density_kg_m3", "density_kg_m"),
    ];
    for (right, mistyped) in rows {
        let text = with(&format!("{right} ="), &format!("{mistyped} ="));
        let expected = format!("unknown key `{mistyped}`; did you mean `{right}`?");
        assert_eq!(mistake(&text), place(&text, mistyped) + &expected);
    }
    let text = with("[limits]", "[limit]");
    assert_eq!(mistake(&text), place(&text, "limit]") + "unknown key `limit`; did you mean `limits`?");
    let text = with("fineness = 7", "fineness = 7\ncolour = 1");
    assert_eq!(mistake(&text), place(&text, "colour") + "unknown key `colour`; known here: `length_m`, `fineness`");
}

#[test]
fn a_missing_key_or_section_is_named() {
    let text = with("length_m = 1.5", "");
    assert_eq!(mistake(&text), place(&text, "[hull]") + "missing key `hull.length_m`: a number above 0");
    let text = with("alpha = 1.79666666666667, ", "");
    let expected = "missing key `hydrodynamics.lift.alpha`: a number above 0";
    assert_eq!(mistake(&text), place(&text, "{ zero = 0, q = 0 }") + expected);
    let text = with("[water]\ndensity_kg_m3 = 1000 # I\ngravity_m_s2 = 9.81 # I\n", "");
    assert_eq!(mistake(&text), "v.toml:1:1: missing section `water`");
}

#[test]
fn coefficients_and_added_mass_may_each_come_from_the_geometry() {
    let without = |from: &str, to: &str| {
        let [from, to] = [from, to].map(|passage| SLOCUM.find(passage).unwrap());
        Vehicle::from_toml(&SLOCUM.replace(&SLOCUM[from..to], ""), "v.toml").unwrap()
    };
    let given = slocum();
    let light = without("[added_mass]", "# Coefficients come");
    assert_eq!(light.hydrodynamics, given.hydrodynamics);
    // Lamb's factors of a spheroid of fineness 7: 0.036 along, 0.933 across, of 54.1 kg; the wing adds to heave.
    assert!((light.added_mass.mass_kg.m11 - 0.036 * 54.1).abs() < 0.05);
    assert!(light.added_mass.mass_kg.m33 > light.added_mass.mass_kg.m22);
    let estimated = without("[hydrodynamics]", "[buoyancy]");
    assert_eq!(estimated.added_mass, given.added_mass);
    assert_ne!(estimated.hydrodynamics, given.hydrodynamics);
    assert_ne!(estimated.hash(), given.hash());
}

#[test]
fn a_wrong_value_is_quoted_with_what_would_be_right() {
    let rows = [
        ("\"slocum-paper\"", "\"\"", "`name` is \"\", but must be a text of 1 to 32 characters"),
        ("0.77", "nan", "`nominal_speed_m_s` is nan, but must be a number above 0"),
        ("1.5 # P", "-1.5 # P", "`hull.length_m` is -1.5, but must be a number above 0"),
        ("1.5 # P", "\"long\" # P", "`hull.length_m` is \"long\", but must be a number above 0"),
        ("7 # P  f", "1 # P  f", "`hull.fineness` is 1, but must be a number above 1"),
        ("11 # P", "inf # P", "`wing.aspect_ratio` is inf, but must be a number above 0"),
        ("0.05 # c", "5 # c", "`wing.position` is 5, but must be a number from -1 to 1"),
        ("0.8 # c", "-0.8 # c", "`fin.area_ratio` is -0.8, but must be a number of 0 or more"),
        (
            "[0, 0, 0.0713975]",
            "[0, 0.0713975]",
            "`body.centre_of_mass_m` is [0, 0.0713975], but must be 3 numbers, each a finite number",
        ),
        (
            "[[0.6, 0, 0], [0, 7, 0], [0, 0, 7]]",
            "[[0.6, 0.1, 0], [0, 7, 0], [0, 0, 7]]",
            "`body.inertia_kg_m2` is [[0.6, 0.1, 0], [0, 7, 0], [0, 0, 7]], but must be symmetric",
        ),
        (
            "[[0.6, 0, 0], [0, 7, 0], [0, 0, 7]]",
            "[[0.2, 0, 0], [0, 7, 0], [0, 0, 7]]",
            "`body.inertia_kg_m2` is [[0.2, 0, 0], [0, 7, 0], [0, 0, 7]], but must be positive definite, also when taken about the \
             centre of mass",
        ),
        (
            "[-0.35, 0.35]",
            "[0.35, -0.35]",
            "`moving_mass.travel_m` is [0.35, -0.35], but must be [min, max] with min below max",
        ),
        (
            "[[5, 0, 0], [0, 60, 0], [0, 0, 70]]",
            "5",
            "`added_mass.mass_kg` is 5, but must be 3 rows of 3 finite numbers",
        ),
        (
            "[[5, 0, 0], [0, 60, 0], [0, 0, 70]]",
            "[[-5, 0, 0], [0, 60, 0], [0, 0, 70]]",
            "`added_mass.mass_kg` is [[-5, 0, 0], [0, 60, 0], [0, 0, 70]], but must be without a negative eigenvalue",
        ),
        (
            "[[0, 0, 0], [0, 0, 0], [0, 0, 0]]",
            "[[0, 0, 0], [0, 0, 30], [0, 0, 0]]",
            "`added_mass.coupling_kg_m` is [[0, 0, 0], [0, 0, 30], [0, 0, 0]], but must be small enough that the 6×6 added mass has \
             no negative eigenvalue",
        ),
        ("\"body\"", "\"wind\"", "`hydrodynamics.moment_frame` is \"wind\", but must be \"body\" or \"current\""),
        ("-0.266172839506173", "0.2", "`hydrodynamics.side.beta` is 0.2, but must be a number of 0 or less"),
        (
            "[1e7, 0.40]",
            "[1e7, 1.4]",
            concat!(
                "`buoyancy.efficiency` is [[0, 0.03], [1e6, 0.08], [5e6, 0.27], [1…, but must be ",
                "rows of [pressure in Pa, rising; efficiency above 0, at most 1]"
            ),
        ),
        ("8e6", "false", "`energy.battery_j` is false, but must be a number above 0"),
        ("300 # chosen", "150 # chosen", "`limits.crush_depth_m` is 150, but must be a number above 200"),
        ("9.81", "0", "`water.gravity_m_s2` is 0, but must be a number above 0"),
    ];
    for (passage, replacement, expected) in rows {
        let text = with(passage, replacement);
        // The mistake stands where the value begins; that of a list where the list begins.
        let value = if passage == "[1e7, 0.40]" { "[[0, 0.03]" } else { passage };
        assert_eq!(mistake(&text), place_of(&text, SLOCUM.find(value).unwrap()) + expected);
    }
}

#[test]
fn what_is_not_toml_is_one_line_too() {
    assert_eq!(mistake("name = \"x\"\nhull = [\n"), "v.toml:2:9: unclosed array, expected `]`");
    assert_eq!(mistake("name = \"x\"\nname = \"y\"\n"), "v.toml:2:1: duplicate key");
    let unreadable = Vehicle::load("no-such-vehicle").unwrap_err().to_string();
    assert!(unreadable.starts_with("no-such-vehicle: not a readable file ("), "{unreadable}");
    let names = "`slocum-paper`, `from-geometry`, `slocum-deep`, `reversed-turn`, `seawing`";
    assert!(unreadable.ends_with(&format!("), nor an embedded one ({names})")), "{unreadable}");
}

#[test]
fn a_section_that_is_no_table_is_a_mistake() {
    let text = with("[limits]\nworking_depth_m = 200 # chosen\ncrush_depth_m = 300 # chosen\n", "[[limits]]\n");
    let line = mistake(&text);
    assert!(line.ends_with("but must be a table"), "{line}");
    let text = with("[hull]\nlength_m = 1.5 # P  l\nfineness = 7 # P  f = l/d, so d = 0.21429 m\n", "hull = 3\n");
    assert_eq!(mistake(&text), place(&text, "3\n") + "`hull` is 3, but must be a table");
}

#[test]
fn a_file_cut_off_anywhere_or_without_a_line_is_one_line_of_error_or_a_vehicle() {
    let cut = SLOCUM.char_indices().map(|(offset, _)| SLOCUM[..offset].to_owned());
    let lines: Vec<_> = SLOCUM.lines().collect();
    let without = (0..lines.len()).map(|index| [&lines[..index], &lines[index + 1..]].concat().join("\n"));
    for text in cut.chain(without) {
        if let Err(error) = Vehicle::from_toml(&text, "v.toml") {
            let line = error.to_string();
            assert!(line.starts_with("v.toml:") && !line.contains('\n'), "{line}");
        }
    }
}

#[test]
fn reference_lengths_default_to_the_wings() {
    let hydrodynamics = slocum().hydrodynamics;
    assert!((hydrodynamics.area_m2 - 0.150_278).abs() < 1e-6);
    assert!((hydrodynamics.span_m - 1.285_71).abs() < 1e-5);
    assert!((hydrodynamics.chord_m - 0.116_883).abs() < 1e-6);
    let text = with("moment_frame", "area_m2 = 0.2\nmoment_frame");
    assert_eq!(Vehicle::from_toml(&text, "v.toml").unwrap().hydrodynamics.area_m2, 0.2);
}

#[test]
fn a_hull_is_rigid_unless_the_file_says_how_it_gives_way() {
    let elasticity =
        |text: &str| Vehicle::from_toml(text, "v.toml").map(|vehicle| vehicle.buoyancy.unwrap().elasticity);
    let rigid = Elasticity { reference_temperature_c: 15.0, ..Elasticity::default() };
    assert_eq!(elasticity(SLOCUM), Ok(rigid));
    let text = with("idle_power_w = 5", "compressibility_per_pa = 5e-10\nidle_power_w = 5");
    assert_eq!(elasticity(&text), Ok(Elasticity { compressibility_per_pa: 5e-10, ..rigid }));
    // Per decibar by mistake.
    let error = elasticity(&with("idle_power_w = 5", "compressibility_per_pa = 4.2e-6\nidle_power_w = 5")).unwrap_err();
    assert!(error.message.ends_with("must be a number from 0 to 0.00000001"), "{error}");
}

#[test]
fn the_variable_volume_acts_at_the_centre_of_buoyancy_unless_the_file_says_at_its_station() {
    assert!(!slocum().buoyancy.unwrap().acts_at_station);
    let said = |value: &str| with("position_m = 0.55", &format!("acts_at_station = {value}\nposition_m = 0.55"));
    assert!(Vehicle::from_toml(&said("true"), "v.toml").unwrap().buoyancy.unwrap().acts_at_station);
    let text = said("\"yes\"");
    let expected = "`buoyancy.acts_at_station` is \"yes\", but must be true or false";
    assert_eq!(mistake(&text), place(&text, "\"yes\"") + expected);
}

#[test]
fn layout_does_not_change_the_fingerprint() {
    let bare: String = SLOCUM.lines().map(|line| line.split(" #").next().unwrap().to_owned() + "\n\n").collect();
    let reordered = with(
        "length_m = 1.5 # P  l\nfineness = 7 # P  f = l/d, so d = 0.21429 m\n",
        "fineness = 7.0\nlength_m = 15e-1\n",
    );
    for text in [bare, reordered] {
        assert_eq!(Vehicle::from_toml(&text, "v.toml").unwrap().hash(), slocum().hash());
    }
}

#[test]
fn every_value_changes_the_fingerprint() {
    let mut hashes = vec![slocum().hash()];
    let mut changed = |text: String| {
        let hash = Vehicle::from_toml(&text, "v.toml").unwrap().hash();
        assert!(!hashes.contains(&hash), "same fingerprint as another vehicle:\n{text}");
        hashes.push(hash);
    };
    let mut numbers = 0;
    for (start, end) in numbers_of(SLOCUM) {
        let value: f64 = SLOCUM[start..end].parse().unwrap();
        // Small enough that matrices stay symmetric.
        let other = if value == 0.0 { 1e-30 } else { value * (1.0 + 1e-6) };
        changed(format!("{}{other:e}{}", &SLOCUM[..start], &SLOCUM[end..]));
        numbers += 1;
    }
    assert_eq!(numbers, 104);
    changed(with("name = \"slocum-paper\"", "name = \"slocum\""));
    changed(with("\"body\"", "\"current\""));
    changed(with("position_m = 0.55", "position_m = 0.55\nacts_at_station = true"));
    changed(with("radius_m", "inertia_kg_m2 = [0, 0, 1]\nradius_m"));
    for length in ["area_m2", "span_m", "chord_m"] {
        changed(with("moment_frame", &format!("{length} = 0.7\nmoment_frame")));
    }
}

/// Where the numbers of a file's values stand, comments and keys left out.
fn numbers_of(text: &str) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let mut line_start = 0;
    for line in text.split_inclusive('\n') {
        let code = line.split('#').next().unwrap();
        let mut from = 0;
        for token in code.split([' ', '[', ']', ',', '\n']) {
            if token.parse::<f64>().is_ok() {
                found.push((line_start + from, line_start + from + token.len()));
            }
            from += token.len() + 1;
        }
        line_start += line.len();
    }
    found
}
