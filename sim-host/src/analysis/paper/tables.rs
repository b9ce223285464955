//! The trim of section 5.1, Table 1 and Table 2 beside ours.

use super::comparison::Row;
use crate::analysis::{
    modes::{ModeSet, RollKinematics, modes},
    trim::{Condition, Scale, glide},
};
use crate::model::vehicle::Vehicle;

/// An eigenvalue as printed, and its eigenvector as [magnitude, angle in degrees].
///
/// The print lost decimal points and signs; each is put back so that θ = q/λ and φ = p/λ hold.
struct PrintedMode {
    name: &'static str,
    eigenvalue: [&'static str; 2],
    entries: [[&'static str; 2]; 4],
    remark: &'static str,
}

const T1_1: &str = "the printed θ/q says −3.275, which a pitch inertia of 14.31 instead of 14.26 kg m² gives";
const T1_2: &str = "the printed θ/q says |λ| = 0.8925, ours is 0.8957: identified constants carry three digits";
const T1_4: &str = "identified constants carry three digits";
const T2_3: &str =
    "with φ̇ = p; the printed φ/p says |λ| = 1.837, so the printed vector does not fit its own eigenvalue";
const T2_1: &str = "with φ̇ = p; the printed φ/p says |λ| = 2.173, the printed eigenvalue 2.198";
const T2_4: &str = "with φ̇ = p; identified constants carry three digits";

const TABLE_1: [PrintedMode; 3] = [
    PrintedMode {
        name: "λ1",
        eigenvalue: ["-3.28", "0"],
        entries: [["0.0315", "0"], ["0.0631", "0"], ["1", "180"], ["0.1306", "0"]],
        remark: T1_1,
    },
    PrintedMode {
        name: "λ2",
        eigenvalue: ["-0.85", "0.27"],
        entries: [["0.0661", "-126"], ["0.6694", "0"], ["1", "84.5"], ["0.4793", "-78"]],
        remark: T1_2,
    },
    PrintedMode {
        name: "λ4",
        eigenvalue: ["-0.06", "0"],
        entries: [["1", "0"], ["0.0231", "180"], ["0.0005", "180"], ["0.0038", "0"]],
        remark: T1_4,
    },
];

const TABLE_2: [PrintedMode; 3] = [
    PrintedMode {
        name: "λ3",
        eigenvalue: ["-1.81", "0"],
        entries: [["0.1313", "0"], ["0.9125", "0"], ["1", "0"], ["0.2125", "180"]],
        remark: T2_3,
    },
    PrintedMode {
        name: "λ1",
        eigenvalue: ["-1.33", "1.75"],
        entries: [["0.0363", "-131"], ["1", "0"], ["0.5026", "150"], ["0.1969", "-127"]],
        remark: T2_1,
    },
    PrintedMode {
        name: "λ4",
        eigenvalue: ["-0.17", "0"],
        entries: [["0.7647", "0"], ["0.40", "0"], ["0.0235", "180"], ["1", "180"]],
        remark: T2_4,
    },
];

/// Entry that the printed phases are taken from.
const fn phase_entry(mode: &PrintedMode) -> usize {
    match mode.entries[0][1].as_bytes() {
        b"0" => 0,
        _ => 1,
    }
}

/// The trim and both tables; Table 2 with its own kinematics and with the right ones.
///
/// # Errors
/// One line if the vehicle does not glide at −35°.
pub fn compare(vehicle: &Vehicle) -> Result<Vec<Row>, String> {
    let glide = glide(vehicle, Condition::PathAngle(-35_f64.to_radians()), Scale::Speed(0.77))?;
    let gravity = "with g = 9.81 m/s²; 0.2130 needs g = 9.806";
    let mut rows = vec![
        Row::new("5.1", "net mass, kg", "0.2130", glide.net_mass_kg, gravity),
        Row::new("5.1", "r_px, m", "0.2826", glide.r_px_m, ""),
        Row::new("5.1", "angle of attack, deg", "1.2", glide.alpha_rad.to_degrees(), ""),
    ];
    let exact = modes(vehicle, &glide, RollKinematics::Exact)?;
    let paper = modes(vehicle, &glide, RollKinematics::Paper)?;
    rows.extend(mode_rows("Table 1", &TABLE_1, &exact.longitudinal, ["u/V0", "w/V0", "q·1.8 m/V0", "θ"]));
    rows.extend(mode_rows("Table 2", &TABLE_2, &paper.lateral, ["v/V0", "p·1.8 m/V0", "r·1.8 m/V0", "φ"]));
    let right = "φ̇ = p + r tanθ follows from the paper's equation (2); its Table 2 has φ̇ = p";
    let [fast, [pair_re, pair_im], _, [slow, _]] = exact.lateral.eigenvalues;
    let with_yaw = [
        ("λ3 real", "-1.81", fast[0]),
        ("λ1 real", "-1.33", pair_re),
        ("λ1 imaginary", "1.75", pair_im),
        ("λ4 real", "-0.17", slow),
    ];
    rows.extend(with_yaw.map(|(part, printed, ours)| {
        Row::new("Table 2", &format!("{part} part with φ̇ = p + r tanθ, 1/s"), printed, ours, right)
    }));
    Ok(rows)
}

fn mode_rows(place: &str, printed: &[PrintedMode], set: &ModeSet, entries: [&str; 4]) -> Vec<Row> {
    printed.iter().flat_map(|mode| one_mode(place, mode, set, entries)).collect()
}

/// The mode of ours whose eigenvalue lies nearest to a printed one, entry by entry.
fn one_mode(place: &str, printed: &PrintedMode, set: &ModeSet, entries: [&str; 4]) -> Vec<Row> {
    let number = |text: &str| text.parse::<f64>().unwrap_or(f64::NAN);
    let [re, im] = printed.eigenvalue.map(number);
    let distance = |i: &usize| (set.eigenvalues[*i][0] - re).hypot(set.eigenvalues[*i][1] - im);
    let Some(nearest) = (0..4).min_by(|a, b| distance(a).total_cmp(&distance(b))) else { return Vec::new() };
    let value = set.eigenvalues[nearest];
    let mut rows = vec![Row::new(
        place,
        &format!("{} real part, 1/s", printed.name),
        printed.eigenvalue[0],
        value[0],
        printed.remark,
    )];
    if im != 0.0 {
        let quantity = format!("{} imaginary part, 1/s", printed.name);
        rows.push(Row::new(place, &quantity, printed.eigenvalue[1], value[1], printed.remark));
    }
    let vector = set.eigenvectors[nearest];
    let phase = |i: usize| vector[i][1].atan2(vector[i][0]).to_degrees();
    let reference = phase_entry(printed);
    let offset = phase(reference) - number(printed.entries[reference][1]);
    for (i, [magnitude, angle]) in printed.entries.iter().enumerate() {
        let [re, im] = vector[i];
        let quantity = format!("{} {} magnitude", printed.name, entries[i]);
        rows.push(Row::new(place, &quantity, magnitude, re.hypot(im), printed.remark));
        // Of −180° to 180°, the turn that lies nearest to the printed one.
        let target = number(angle);
        let turned = target + (phase(i) - offset - target + 180.0).rem_euclid(360.0) - 180.0;
        rows.push(Row::new(
            place,
            &format!("{} {} phase, deg", printed.name, entries[i]),
            angle,
            turned,
            printed.remark,
        ));
    }
    // A remark explains what is missed.
    rows.iter_mut().filter(|row| row.reproduced).for_each(|row| row.remark.clear());
    rows
}
