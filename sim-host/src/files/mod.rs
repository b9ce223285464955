//! How files are read and written.
//!
//! TOML with units in its keys, where a mistake is told with file, line, column and the nearest valid key; and whole files,
//! which stand there complete or not at all. This wing knows nothing of gliders, and uses no other.

pub mod toml_file;
pub mod whole_file;
