//! What the paper prints, beside ours.

use std::sync::LazyLock;

use sim_host::{
    analysis::paper::{Reproduction, reproduce, tables::compare},
    model::vehicle::Vehicle,
};

static ALL: LazyLock<Reproduction> = LazyLock::new(|| reproduce(&Vehicle::load("slocum-paper").unwrap()).unwrap());

/// Of the trim and the eigenvalues all printed digits come back but three numbers, for reasons that the remarks give.
#[test]
fn the_printed_trim_and_eigenvalues_are_reproduced() {
    let rows = compare(&Vehicle::load("slocum-paper").unwrap()).unwrap();
    let of_a_vector = |quantity: &str| quantity.contains("magnitude") || quantity.contains("phase");
    let missed: Vec<&str> = rows
        .iter()
        .filter(|row| !row.reproduced && !of_a_vector(&row.quantity) && !row.quantity.contains("tanθ"))
        .map(|row| row.quantity.as_str())
        .collect();
    assert_eq!(missed, ["net mass, kg", "λ1 real part, 1/s", "λ1 real part, 1/s"]);
    assert!(rows.iter().all(|row| row.reproduced || !row.remark.is_empty()));
}

/// Magnitudes are within 0.005 of the printed ones, angles within half a degree: what constants of three digits allow.
#[test]
fn the_printed_eigenvectors_are_met_closely() {
    for row in compare(&Vehicle::load("slocum-paper").unwrap()).unwrap() {
        let most = if row.quantity.contains("phase") { 0.5 } else { 0.0051 };
        let of_a_vector = row.quantity.contains("magnitude") || row.quantity.contains("phase");
        assert!(!of_a_vector || row.difference.abs() < most, "{row:?}");
    }
}

/// Every figure from 5 to 15 has curves with values; Fig 6 starts at arctan(1/√2), and Fig 9 passes 54.1 kg at 1.5 m.
#[test]
fn every_figure_is_drawn() {
    let all = &*ALL;
    let names: Vec<&str> = all.figures.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(names, (5..=15).map(|number| format!("fig{number}")).collect::<Vec<_>>());
    for (name, figure) in &all.figures {
        for line in figure.panels.iter().flat_map(|panel| &panel.lines) {
            assert!(line.points.iter().any(|[x, y]| x.is_finite() && y.is_finite()), "{name}: {:?}", line.name);
        }
        assert!(figure.panels.iter().all(|panel| panel.lines.len() > usize::from(name == "fig5")), "{name}");
    }
    let first =
        |name: &str, panel: usize| &all.figures.iter().find(|(n, _)| n == name).unwrap().1.panels[panel].lines[0];
    assert!((first("fig6", 1).points[0][1] - 0.5_f64.sqrt().atan().to_degrees()).abs() < 1e-12);
    let middle = first("fig9", 0).points[80];
    assert!((middle[1] - std::f64::consts::PI / 4.0 * 1000.0 * 1.5_f64.powi(3) / 49.0).abs() < 1e-12, "{middle:?}");
}

/// Each stated trend holds in at least one reading, and the comparison says in which.
#[test]
fn every_stated_trend_holds_in_some_reading() {
    assert_eq!(ALL.trends.len(), 14);
    for trend in &ALL.trends {
        assert!(trend.readings.len() > 1 && trend.readings.iter().any(|reading| reading.holds), "{trend:?}");
    }
}

#[test]
fn comparison_and_figures_are_written() {
    let folder = tempfile::tempdir().unwrap();
    ALL.write(folder.path()).unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("comparison.md").contains("| 5.1 | r_px, m | 0.2826 | 0.2826 |"));
    assert!(read("comparison.html").contains("<svg") && !read("comparison.html").contains("NaN"));
    assert!(!read("fig11.svg").contains("NaN") && read("fig11.csv").starts_with("panel,line,x,y\n"));
}
