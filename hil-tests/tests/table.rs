//! The trim table that the firmware carries is the one that the plant gives.

use std::{fs, path::Path};

use sim_host::{
    analysis::table::{Envelope, generate},
    model::vehicle::Vehicle,
};

/// `glider table slocum-paper -o firmware/slocum-paper.table` writes it anew after a change of plant or vehicle.
#[test]
fn the_committed_table_is_the_generated_one() {
    let committed = fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("../firmware/slocum-paper.table")).unwrap();
    let generated = generate(&Vehicle::load("slocum-paper").unwrap(), &Envelope::default()).unwrap();
    assert!(committed == generated, "firmware/slocum-paper.table is out of date: write it with `glider table`");
}
