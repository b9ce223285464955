//! Log lines: defmt on a board, nothing on a host, where defmt does not link.
//!
//! Only `{}` and `{:?}` are used, which both understand, so a host build still checks every line.

macro_rules! log {
    ($level:ident, $($argument:tt)*) => {{
        #[cfg(feature = "defmt")]
        defmt::$level!($($argument)*);
        #[cfg(not(feature = "defmt"))]
        let _ = format_args!($($argument)*);
    }};
}

pub(crate) use log;
