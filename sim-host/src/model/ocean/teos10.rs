//! Density of seawater from what a CTD measures, by TEOS-10.
//!
//! IOC, SCOR and IAPSO, "The international thermodynamic equation of seawater – 2010", Manuals and Guides 56. The polynomials
//! come from the crate `gsw`. Absolute Salinity needs the composition of the salt: the reference composition leaves out
//! the anomaly of the open ocean, at most 0.03 g/kg (0.02 kg/m³, in the deep North Pacific); in the Baltic river salt adds
//! `0.087 (1 − SP/35)` g/kg (Feistel et al. 2010, Ocean Science 6, 3–24).

use gsw::{conversions, volume};

/// Zero of the Celsius scale, K.
const ZERO_C_K: f64 = 273.15;
/// c_p⁰ of Conservative Temperature, J/(kg K).
const CP0: f64 = 3_991.867_957_119_63;
/// Salinity of standard seawater.
const STANDARD_SALINITY: f64 = 35.0;
/// Absolute Salinity of the Baltic's rivers, g/kg.
const BALTIC_RIVERS_G_KG: f64 = 0.087;
/// Pascals per decibar.
const PA_PER_DBAR: f64 = 1e4;

/// Which salt the sea holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Composition {
    /// The reference composition of standard seawater.
    Standard,
    /// Standard seawater thinned by the Baltic's rivers.
    Baltic,
}

/// Absolute Salinity S_A, g/kg, of a Practical Salinity.
#[must_use]
pub fn absolute_salinity(salinity: f64, composition: Composition) -> f64 {
    let reference = conversions::sr_from_sp(salinity);
    match composition {
        Composition::Standard => reference,
        Composition::Baltic => reference + BALTIC_RIVERS_G_KG * (1.0 - salinity / STANDARD_SALINITY),
    }
}

/// Conservative Temperature Θ, °C, from Absolute Salinity, in-situ temperature (ITS-90, °C) and sea pressure (Pa).
///
/// Solves `(T₀ + t)/(T₀ + θ) = ∂h/∂Θ / c_p⁰` for the potential temperature θ (appendix A.11 of the manual): both sides are
/// the ratio of temperatures at which the same entropy is exchanged in situ and at the surface.
///
/// # Errors
/// What the library refuses: a negative salinity.
pub fn conservative_temperature(s_a: f64, temperature_c: f64, pressure_pa: f64) -> Result<f64, gsw::Error> {
    let mut potential_c = temperature_c;
    // Warming by pressure depends weakly on temperature: each round leaves 1e-3 of the error, four leave rounding.
    for _ in 0..4 {
        let conservative_c = conversions::ct_from_pt(s_a, potential_c)?;
        let (_, by_temperature) = volume::enthalpy_first_derivatives(s_a, conservative_c, pressure_pa / PA_PER_DBAR)?;
        potential_c = (ZERO_C_K + temperature_c) * CP0 / by_temperature - ZERO_C_K;
    }
    conversions::ct_from_pt(s_a, potential_c)
}

/// In-situ density, kg/m³, from Practical Salinity, in-situ temperature (ITS-90, °C) and sea pressure (Pa).
///
/// # Errors
/// As [`conservative_temperature`].
pub fn density_kg_m3(
    salinity: f64,
    temperature_c: f64,
    pressure_pa: f64,
    composition: Composition,
) -> Result<f64, gsw::Error> {
    let s_a = absolute_salinity(salinity, composition);
    let conservative_c = conservative_temperature(s_a, temperature_c, pressure_pa)?;
    volume::rho(s_a, conservative_c, pressure_pa / PA_PER_DBAR)
}

/// Speed of sound, m/s, of the same water.
///
/// # Errors
/// As [`conservative_temperature`].
pub(super) fn sound_speed_m_s(
    salinity: f64,
    temperature_c: f64,
    pressure_pa: f64,
    composition: Composition,
) -> Result<f64, gsw::Error> {
    let s_a = absolute_salinity(salinity, composition);
    let conservative_c = conservative_temperature(s_a, temperature_c, pressure_pa)?;
    volume::sound_speed(s_a, conservative_c, pressure_pa / PA_PER_DBAR)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of gsw_CT_from_t and gsw_rho on teos-10.org: S_A, in-situ temperature, pressure in dbar; Θ; density of
    /// Θ rounded to 1e-4 °C.
    const CHECK: [[f64; 5]; 6] = [
        [34.7118, 28.7856, 10.0, 28.809_919_826, 1_021.839_935_738_108],
        [34.8915, 28.4329, 50.0, 28.439_227_816, 1_022.262_457_966_867],
        [35.0256, 22.8103, 125.0, 22.786_176_893, 1_024.427_195_413_316],
        [34.8472, 10.2600, 250.0, 10.226_189_266, 1_027.790_152_759_127],
        [34.7366, 6.8863, 600.0, 6.827_213_633, 1_029.837_779_000_189],
        [34.7324, 4.4036, 1000.0, 4.323_575_748, 1_032.002_453_224_572],
    ];

    #[test]
    fn the_published_check_values_come_out() {
        for [s_a, temperature_c, dbar, theta_c, density] in CHECK {
            let ours_c = conservative_temperature(s_a, temperature_c, dbar * 1e4).unwrap();
            // The polynomial is a fit to the full equation of state; here its temperatures are good to 1.5e-5 °C.
            assert!((ours_c - theta_c).abs() < 2e-5, "{dbar} dbar: {ours_c}");
            let rounded_c = (theta_c * 1e4).round() / 1e4;
            // 16 digits, less the rounding of another order of summation.
            assert!((volume::rho(s_a, rounded_c, dbar).unwrap() - density).abs() < 1e-9, "{dbar} dbar");
            // 2e-5 °C and the rounding of Θ make 7e-5 °C, and 2e-5 kg/m³.
            let salinity = s_a / 35.165_04 * 35.0;
            let ours = density_kg_m3(salinity, temperature_c, dbar * 1e4, Composition::Standard).unwrap();
            assert!((ours - density).abs() < 3e-5, "{dbar} dbar: {ours}");
        }
    }

    #[test]
    fn salinity_of_the_baltic_is_more_than_it_conducts() {
        assert!((absolute_salinity(35.0, Composition::Standard) - 35.165_04).abs() < 1e-12);
        assert!((absolute_salinity(35.0, Composition::Baltic) - 35.165_04).abs() < 1e-12);
        // gsw_SA_from_SP_Baltic of the toolbox's documentation, at 20° E, 59° N.
        assert!((absolute_salinity(6.5683, Composition::Baltic) - 6.669_945_432_342_856).abs() < 1e-12);
    }
}
