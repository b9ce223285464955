//! The figures and tables of Fan & Woolsey (2013), drawn anew and compared with what was printed.

pub mod comparison;
pub mod tables;
