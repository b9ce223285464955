//! The vehicle that was found, as a file: that of the vehicle it started from, with new values.

use nalgebra::Matrix3;
use toml_edit::{Array, DocumentMut, InlineTable, Item, Table, Value};

use super::{Candidate, Spec};
use crate::model::{
    coefficients::{Anchoring, Parameter},
    vehicle::{MomentFrame, Vehicle},
};

/// The text of its file; `start` is that of the vehicle that it started from.
///
/// Coefficients are left to the geometry, unless the design was anchored.
///
/// # Errors
/// One line, if `start` is no TOML.
pub fn vehicle_toml(spec: &Spec, candidate: &Candidate, start: &str) -> Result<String, String> {
    let mut file: DocumentMut = start.parse().map_err(|error| format!("{}: {error}", spec.vehicle))?;
    let vehicle = &candidate.vehicle;
    set(&mut file, "name", spec.name.as_str());
    set(&mut file, "nominal_speed_m_s", vehicle.nominal_speed_m_s);
    if let Some(mut first) = file.key_mut("name") {
        let origin = format!(
            "# Found by `glider design`, from {}; what it changed is marked \"found\"; other marks as there.\n\n",
            spec.vehicle
        );
        first.leaf_decor_mut().set_prefix(origin);
    }
    for name in ["hull", "wing", "fin"] {
        with_table(&mut file, name, |table| {
            for parameter in Parameter::ALL {
                let key = parameter.key().split_once('.').filter(|(section, _)| *section == name);
                if let Some((_, key)) = key {
                    set(table, key, candidate.parameter(parameter));
                }
            }
        });
    }
    with_table(&mut file, "body", |body| {
        set(body, "mass_kg", vehicle.body.mass_kg);
        set(body, "centre_of_mass_m", row(vehicle.body.centre_of_mass_m.iter()));
        set(body, "inertia_kg_m2", rows(&vehicle.body.inertia_kg_m2));
    });
    with_table(&mut file, "moving_mass", |moving_mass| {
        set(moving_mass, "radius_m", vehicle.moving_mass.radius_m);
        set(moving_mass, "travel_m", row(vehicle.moving_mass.travel_m.iter()));
    });
    if let Some(flow) = &vehicle.crossflow {
        with_table(&mut file, "crossflow", |crossflow| {
            set(crossflow, "plan_area_m2", flow.plan_area_m2);
            set(crossflow, "side_area_m2", flow.side_area_m2);
        });
    }
    for section in ["added_mass", "hydrodynamics"] {
        file.remove(section);
    }
    if spec.anchoring == Anchoring::Anchored {
        with_table(&mut file, "added_mass", |added| {
            set(added, "mass_kg", rows(&vehicle.added_mass.mass_kg));
            set(added, "inertia_kg_m2", rows(&vehicle.added_mass.inertia_kg_m2));
            set(added, "coupling_kg_m", rows(&vehicle.added_mass.coupling_kg_m));
        });
        with_table(&mut file, "hydrodynamics", |section| hydrodynamics(section, vehicle));
    }
    Ok(file.to_string())
}

fn hydrodynamics(section: &mut Table, vehicle: &Vehicle) {
    let h = &vehicle.hydrodynamics;
    let frame = match h.moment_frame {
        MomentFrame::Body => "body",
        MomentFrame::Current => "current",
    };
    set(section, "moment_frame", frame);
    set(section, "area_m2", h.area_m2);
    set(section, "span_m", h.span_m);
    set(section, "chord_m", h.chord_m);
    set(section, "drag", inline(&[("zero", h.c_d_zero), ("induced", h.c_d_induced)]));
    set(section, "lift", inline(&[("zero", h.c_l_zero), ("alpha", h.c_l_alpha), ("q", h.c_l_q)]));
    set(section, "side", inline(&[("beta", h.c_y_beta), ("p", h.c_y_p), ("r", h.c_y_r)]));
    set(section, "roll", inline(&[("beta", h.c_roll_beta), ("p", h.c_roll_p), ("r", h.c_roll_r)]));
    set(section, "pitch", inline(&[("zero", h.c_m_zero), ("alpha", h.c_m_alpha), ("q", h.c_m_q)]));
    set(section, "yaw", inline(&[("beta", h.c_n_beta), ("p", h.c_n_p), ("r", h.c_n_r)]));
}

/// A table of the file, made anew if it is none; what its heading says of the old geometry goes.
fn with_table(file: &mut DocumentMut, name: &str, fill: impl FnOnce(&mut Table)) {
    let mut table = file.remove(name).and_then(|item| item.into_table().ok()).unwrap_or_default();
    table.decor_mut().set_suffix("");
    fill(&mut table);
    file.insert(name, Item::Table(table));
}

fn set(table: &mut Table, key: &str, new: impl Into<Value>) {
    let new: Value = new.into();
    table.insert(key, Item::Value(new.decorated(" ", " # found")));
}

fn row<'a>(numbers: impl Iterator<Item = &'a f64>) -> Array {
    numbers.copied().collect()
}

fn rows(matrix: &Matrix3<f64>) -> Array {
    matrix.row_iter().map(|line| row(line.iter())).collect()
}

fn inline(entries: &[(&str, f64)]) -> InlineTable {
    entries.iter().map(|(key, number)| (*key, *number)).collect()
}
