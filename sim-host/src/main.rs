//! The command `glider`.

fn main() {}
