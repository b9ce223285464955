//! The vehicle file: TOML, SI units in the names.
//!
//! `[hydrodynamics]` may leave out `area_m2`, `span_m` and `chord_m` (then the wing's), `moment_frame` (then `"body"`) and
//! the coefficients that symmetry makes small: `lift.zero`, `lift.q`, `pitch.zero`, `side.p`, `side.r`, `roll.r`, `yaw.p`
//! (then 0). Every other coefficient must be there. `[buoyancy]` may leave out `compressibility_per_pa`, `thermal_expansion_per_c`
//! (then 0), `reference_temperature_c` (then 15) and `acts_at_station` (then `false`). `[crossflow]` may leave out its areas
//! (then the geometry's). `[water]` may leave out `kinematic_viscosity_m2_s` (then 1e-6: fresh water at 20 °C; sea water at 5 °C has 1.6e-6).
//!
//! `[hydrodynamics]` and `[added_mass]` may be left out whole: they then come from the geometry ([`crate::model::coefficients`]), at the
//! nominal speed and the mean of dive and climb.
//!
//! `[energy]` may say what its motors may draw together, `peak_power_w` (then no limit); with it the controller runs
//! them in turn.
//!
//! `[buoyancy]` may say how its engine is built and `[moving_mass]` how it is driven: [`super::Engine`] and [`super::Drive`].
//! `[compass]` may say how the battery deflects it: [`super::Compass`].

use nalgebra::{Matrix3, Matrix6, Vector3};

use super::{
    AddedMass, Body, Buoyancy, Compass, Crossflow, Drive, Elasticity, Energy, Engine, Fin, Hull, Hydrodynamics, Limits,
    MomentFrame, MovingMass, Vehicle, Water, Wing, plan_area_m2, side_area_m2,
};
use crate::files::toml_file::{self, FileError, Rule, Section};
use crate::model::coefficients::{Coefficients, Parameter, Shape, Stream};

/// Vehicles that need no file: name, file it comes from, text.
const EMBEDDED: &[(&str, &str, &str)] = &[
    ("slocum-paper", "vehicles/slocum-paper.toml", include_str!("../../../vehicles/slocum-paper.toml")),
    ("from-geometry", "vehicles/from-geometry.toml", include_str!("../../../vehicles/from-geometry.toml")),
    ("slocum-deep", "vehicles/slocum-deep.toml", include_str!("../../../vehicles/slocum-deep.toml")),
    ("reversed-turn", "vehicles/reversed-turn.toml", include_str!("../../../vehicles/reversed-turn.toml")),
    ("seawing", "vehicles/seawing.toml", include_str!("../../../vehicles/seawing.toml")),
];

/// Longest name, in characters: it is carried in the trim table.
const NAME_CHARS: usize = 32;
/// Rounding that a symmetric or semi-definite matrix may show, relative to its largest entry.
const MATRIX_ROUNDING: f64 = 1e-9;

impl Vehicle {
    /// Reads a vehicle from the text of its file; `source_name` stands in the errors.
    ///
    /// # Errors
    /// The first mistake, with its place and what would be right.
    pub fn from_toml(text: &str, source_name: &str) -> Result<Self, FileError> {
        toml_file::read(text, source_name, vehicle)
    }

    /// Reads an embedded vehicle by its name, or else a file by its path.
    ///
    /// # Errors
    /// As [`Vehicle::from_toml`], or one line that lists the embedded names.
    pub fn load(name_or_path: &str) -> Result<Self, FileError> {
        let (text, file) = toml_file::load(name_or_path, EMBEDDED)?;
        Self::from_toml(&text, &file)
    }

    /// The text of the file that [`Vehicle::load`] reads.
    ///
    /// # Errors
    /// As [`Vehicle::load`], where there is no such file.
    pub fn text(name_or_path: &str) -> Result<String, FileError> {
        toml_file::load(name_or_path, EMBEDDED).map(|(text, _)| text.into_owned())
    }
}

fn vehicle(file: &mut Section<'_>) -> Vehicle {
    let hull = file.section("hull", hull);
    let wing = file.section("wing", wing);
    let fin = file.section("fin", fin);
    let water = file.section("water", water);
    let nominal_speed_m_s = file.number("nominal_speed_m_s", Rule::Positive);
    let shape = Shape { hull: hull.clone(), wing: wing.clone(), fin: fin.clone() };
    let stream = Stream {
        speed_m_s: nominal_speed_m_s,
        kinematic_viscosity_m2_s: water.kinematic_viscosity_m2_s,
        lift_coefficient: 0.0,
    };
    let added_mass = file.optional_section("added_mass", added_mass);
    let hydrodynamics = file.optional_section("hydrodynamics", |section| hydrodynamics(section, &hull, &wing));
    let buoyancy = file.optional_section("buoyancy", buoyancy);
    let limits = file.optional_section("limits", limits);
    let strongest_w = match (&buoyancy, &limits) {
        (Some(buoyancy), Some(limits)) => buoyancy.most_pump_power_w(limits, &water).max(buoyancy.engine.bleed_power_w),
        (None, _) | (_, None) => 0.0,
    };
    Vehicle {
        name: file.text("name", NAME_CHARS),
        nominal_speed_m_s,
        body: file.section("body", body),
        moving_mass: file.section("moving_mass", moving_mass),
        added_mass: added_mass.unwrap_or_else(|| shape.added_mass(water.density_kg_m3).into()),
        hydrodynamics: hydrodynamics.unwrap_or_else(|| shape.coefficients(&stream).hydrodynamics(MomentFrame::Body)),
        crossflow: file.optional_section("crossflow", |section| crossflow(section, &hull, &wing, &fin)),
        energy: file.optional_section("energy", |section| energy(section, strongest_w)),
        buoyancy,
        limits,
        compass: file.optional_section("compass", Compass::read),
        water,
        hull,
        wing,
        fin,
    }
}

fn hull(hull: &mut Section<'_>) -> Hull {
    Hull {
        length_m: hull.number("length_m", Parameter::HullLength.rule()),
        fineness: hull.number("fineness", Parameter::HullFineness.rule()),
    }
}

fn wing(wing: &mut Section<'_>) -> Wing {
    Wing {
        aspect_ratio: wing.number("aspect_ratio", Parameter::WingAspectRatio.rule()),
        span_ratio: wing.number("span_ratio", Parameter::WingSpanRatio.rule()),
        thickness_ratio: wing.number("thickness_ratio", Parameter::WingThicknessRatio.rule()),
        position: wing.number("position", Parameter::WingPosition.rule()),
        sweep_deg: wing.number("sweep_deg", Parameter::WingSweep.rule()),
        dihedral_deg: wing.number("dihedral_deg", Parameter::WingDihedral.rule()),
        height_m: wing.number("height_m", Parameter::WingHeight.rule()),
    }
}

fn fin(fin: &mut Section<'_>) -> Fin {
    Fin {
        area_ratio: fin.number("area_ratio", Parameter::FinAreaRatio.rule()),
        position: fin.number("position", Parameter::FinPosition.rule()),
        aspect_ratio: fin.number("aspect_ratio", Parameter::FinAspectRatio.rule()),
        thickness_ratio: fin.number("thickness_ratio", Parameter::FinThicknessRatio.rule()),
        height_m: fin.number("height_m", Parameter::FinHeight.rule()),
    }
}

fn body(body: &mut Section<'_>) -> Body {
    let read = Body {
        mass_kg: body.number("mass_kg", Rule::Positive),
        ballast_kg: body.number("ballast_kg", Rule::NotNegative),
        centre_of_mass_m: Vector3::from(body.numbers("centre_of_mass_m", Rule::Finite)),
        inertia_kg_m2: body.matrix("inertia_kg_m2"),
    };
    body.refuse_if(is_asymmetric(&read.inertia_kg_m2), "inertia_kg_m2", "symmetric");
    let lever = read.centre_of_mass_m.cross_matrix();
    let about_centre_of_mass = read.inertia_kg_m2 + lever * lever * read.mass_kg;
    let right = "positive definite, also when taken about the centre of mass";
    body.refuse_if(least_eigenvalue_3(&about_centre_of_mass) <= 0.0, "inertia_kg_m2", right);
    read
}

fn moving_mass(mass: &mut Section<'_>) -> MovingMass {
    MovingMass {
        mass_kg: mass.number("mass_kg", Rule::Positive),
        radius_m: mass.number("radius_m", Rule::Positive),
        travel_m: mass.range("travel_m"),
        rate_m_s: mass.number("rate_m_s", Rule::Positive),
        roll_deg: mass.range("roll_deg"),
        roll_rate_deg_s: mass.number("roll_rate_deg_s", Rule::Positive),
        inertia_kg_m2: Vector3::from(mass.numbers_or("inertia_kg_m2", Rule::NotNegative, [0.0; 3])),
        drive: Drive::read(mass),
    }
}

fn added_mass(added: &mut Section<'_>) -> AddedMass {
    let read = AddedMass {
        mass_kg: added.matrix("mass_kg"),
        inertia_kg_m2: added.matrix("inertia_kg_m2"),
        coupling_kg_m: added.matrix("coupling_kg_m"),
    };
    for (matrix, key) in [(&read.mass_kg, "mass_kg"), (&read.inertia_kg_m2, "inertia_kg_m2")] {
        added.refuse_if(is_asymmetric(matrix), key, "symmetric");
        let right = "without a negative eigenvalue";
        added.refuse_if(least_eigenvalue_3(matrix) < -MATRIX_ROUNDING * matrix.amax(), key, right);
    }
    let mut whole = Matrix6::zeros();
    whole.fixed_view_mut::<3, 3>(0, 0).copy_from(&read.mass_kg);
    whole.fixed_view_mut::<3, 3>(3, 3).copy_from(&read.inertia_kg_m2);
    whole.fixed_view_mut::<3, 3>(3, 0).copy_from(&read.coupling_kg_m);
    whole.fixed_view_mut::<3, 3>(0, 3).copy_from(&read.coupling_kg_m.transpose());
    let least = if is_finite(whole.as_slice()) { whole.symmetric_eigenvalues().min() } else { 0.0 };
    let right = "small enough that the 6×6 added mass has no negative eigenvalue";
    added.refuse_if(least < -MATRIX_ROUNDING * whole.amax(), "coupling_kg_m", right);
    read
}

fn hydrodynamics(section: &mut Section<'_>, hull: &Hull, wing: &Wing) -> Hydrodynamics {
    use Rule::{Finite, NotNegative, NotPositive, Positive};
    let frames = [("body", MomentFrame::Body), ("current", MomentFrame::Current)];
    let area_m2 = section.number_or("area_m2", Positive, wing.area_m2(hull));
    let span_m = section.number_or("span_m", Positive, wing.span_m(hull));
    let chord_m = section.number_or("chord_m", Positive, wing.chord_m(hull));
    let moment_frame = section.choice_or_first("moment_frame", &frames).unwrap_or(MomentFrame::Body);
    let coefficients = Coefficients {
        area_m2,
        span_m,
        chord_m,
        drag: section.section("drag", |drag| [drag.number("zero", Positive), drag.number("induced", NotNegative)]),
        lift: section.section("lift", |lift| {
            [lift.number_or("zero", Finite, 0.0), lift.number("alpha", Positive), lift.number_or("q", Finite, 0.0)]
        }),
        side: section.section("side", |side| {
            [side.number("beta", NotPositive), side.number_or("p", Finite, 0.0), side.number_or("r", Finite, 0.0)]
        }),
        roll: section.section("roll", |roll| {
            [roll.number("beta", Finite), roll.number("p", NotPositive), roll.number_or("r", Finite, 0.0)]
        }),
        pitch: section.section("pitch", |pitch| {
            [pitch.number_or("zero", Finite, 0.0), pitch.number("alpha", Finite), pitch.number("q", NotPositive)]
        }),
        yaw: section.section("yaw", |yaw| {
            [yaw.number("beta", Finite), yaw.number_or("p", Finite, 0.0), yaw.number("r", NotPositive)]
        }),
    };
    coefficients.hydrodynamics(moment_frame)
}

fn buoyancy(buoyancy: &mut Section<'_>) -> Buoyancy {
    let volume_m3 = buoyancy.range("volume_m3");
    let read = Buoyancy {
        volume_m3,
        pump_rate_m3_s: buoyancy.number("pump_rate_m3_s", Rule::Positive),
        bleed_rate_m3_s: buoyancy.number("bleed_rate_m3_s", Rule::Positive),
        position_m: buoyancy.number("position_m", Rule::Finite),
        acts_at_station: buoyancy.flag_or("acts_at_station", false),
        efficiency: buoyancy.pairs("efficiency"),
        idle_power_w: buoyancy.number("idle_power_w", Rule::NotNegative),
        engine: Engine::read(buoyancy, volume_m3),
        elasticity: elasticity(buoyancy),
    };
    let rising = read.efficiency.is_sorted_by(|[below, _], [above, _]| below < above);
    let possible = read.efficiency.iter().all(|[_, efficiency]| *efficiency > 0.0 && *efficiency <= 1.0);
    let wrong = read.efficiency.is_empty() || !rising || !possible;
    buoyancy.refuse_if(wrong, "efficiency", "rows of [pressure in Pa, rising; efficiency above 0, at most 1]");
    read
}

/// Water itself gives way by 5e-10 /Pa and 4e-4 /°C at most: the bounds keep out a slip of units.
fn elasticity(buoyancy: &mut Section<'_>) -> Elasticity {
    Elasticity {
        compressibility_per_pa: buoyancy.number_or("compressibility_per_pa", Rule::Within(0.0, 1e-8), 0.0),
        thermal_expansion_per_c: buoyancy.number_or("thermal_expansion_per_c", Rule::Within(0.0, 1e-2), 0.0),
        reference_temperature_c: buoyancy.number_or("reference_temperature_c", Rule::Within(-10.0, 50.0), 15.0),
    }
}

/// The strongest motor besides those of the section runs alone, but run it must: the limit may not be below what it
/// takes, W.
fn energy(energy: &mut Section<'_>, strongest_w: f64) -> Energy {
    let read = Energy {
        battery_j: energy.number("battery_j", Rule::Positive),
        battery_v: energy.number("battery_v", Rule::Positive),
        hotel_w: energy.number("hotel_w", Rule::NotNegative),
        pitch_motor_w: energy.number("pitch_motor_w", Rule::NotNegative),
        roll_motor_w: energy.number("roll_motor_w", Rule::NotNegative),
        peak_power_w: energy.optional_number("peak_power_w", Rule::Positive),
    };
    let strongest_w = strongest_w.max(read.pitch_motor_w).max(read.roll_motor_w);
    let right = format!("at least {strongest_w:.1}: what the strongest motor draws alone, a pump at the crush depth");
    energy.refuse_if(read.peak_power_w.is_some_and(|peak_w| peak_w < strongest_w), "peak_power_w", &right);
    read
}

/// Areas default to the geometry's: the hull's side view with the wing outside it, or with the fin.
fn crossflow(crossflow: &mut Section<'_>, hull: &Hull, wing: &Wing, fin: &Fin) -> Crossflow {
    let stall_deg = crossflow.number("stall_deg", Rule::Within(1.0, 89.0));
    let least = if stall_deg.is_finite() { stall_deg } else { 1.0 };
    Crossflow {
        drag_coefficient: crossflow.number("drag_coefficient", Rule::Positive),
        plan_area_m2: crossflow.number_or("plan_area_m2", Rule::Positive, plan_area_m2(hull, wing)),
        side_area_m2: crossflow.number_or("side_area_m2", Rule::Positive, side_area_m2(hull, fin)),
        stall_deg,
        separated_deg: crossflow.number("separated_deg", Rule::Within(least, 90.0)),
    }
}

fn limits(limits: &mut Section<'_>) -> Limits {
    let working_depth_m = limits.number("working_depth_m", Rule::Positive);
    let least = if working_depth_m.is_finite() { working_depth_m } else { 0.0 };
    Limits { working_depth_m, crush_depth_m: limits.number("crush_depth_m", Rule::Above(least)) }
}

fn water(water: &mut Section<'_>) -> Water {
    Water {
        density_kg_m3: water.number("density_kg_m3", Rule::Positive),
        gravity_m_s2: water.number("gravity_m_s2", Rule::Positive),
        // Water between −2 and 100 °C has 0.3e-6 to 2e-6: the bounds keep out a slip of units.
        kinematic_viscosity_m2_s: water.number_or("kinematic_viscosity_m2_s", Rule::Within(1e-7, 1e-5), 1e-6),
    }
}

/// Whether a matrix is asymmetric; not one that could not be read.
fn is_asymmetric(matrix: &Matrix3<f64>) -> bool {
    (matrix - matrix.transpose()).amax() > MATRIX_ROUNDING * matrix.amax()
}

/// Least eigenvalue of a symmetric matrix; infinity for one that could not be read.
fn least_eigenvalue_3(matrix: &Matrix3<f64>) -> f64 {
    if is_finite(matrix.as_slice()) { matrix.symmetric_eigenvalues().min() } else { f64::INFINITY }
}

fn is_finite(entries: &[f64]) -> bool {
    entries.iter().all(|entry| entry.is_finite())
}
