//! What was found, as text for a vehicle file.

use toml_edit::DocumentMut;

use super::Swing;

/// The section `[compass]`, ready to paste; `origin` says how it was found.
#[must_use]
pub fn section(swing: &Swing, origin: &str) -> String {
    let compass = &swing.compass;
    let rows = compass.battery_ut.iter().zip(&swing.positions).map(|([r_px_m, ahead, right, below], residual)| {
        format!(
            "    [{r_px_m}, {ahead}, {right}, {below}], # {:.2}° rms off, {:.2}° corrected\n",
            residual.before_rms_deg, residual.after_rms_deg
        )
    });
    format!(
        "[compass] # {origin}: {} readings on the pier; what depth does to a compass does not show there\n\
         offset_deg = {}\n\
         earth_ut = {} # the Earth's horizontal field where it was swung: change it with the place\n\
         battery_ut = [ # r_px in m; field ahead, right, below\n{}]\n\
         turning_ut = [{}, {}] # right, below with the mass hanging down\n",
        swing.readings,
        compass.offset_deg,
        compass.earth_ut,
        rows.collect::<String>(),
        compass.turning_ut[0],
        compass.turning_ut[1]
    )
}

/// The text of a vehicle file with a new section `[compass]`.
///
/// # Errors
/// One line, if the text is no TOML.
pub fn vehicle_file(text: &str, section: &str) -> Result<String, String> {
    let mut file: DocumentMut = text.parse().map_err(|error: toml_edit::TomlError| error.to_string())?;
    file.remove("compass");
    Ok(format!("{}\n\n{section}", file.to_string().trim_end()))
}
