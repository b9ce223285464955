//! What a trim table shall cover, on the command line.

use crate::analysis::table::Envelope;

#[derive(Debug, clap::Args)]
pub(super) struct EnvelopeArgs {
    /// Flattest and steepest dive, degrees
    #[arg(long, num_args = 2, value_names = ["FLAT", "STEEP"], default_values_t = Envelope::default().dive_deg)]
    dive_deg: Vec<f64>,
    /// Flattest and steepest climb, degrees
    #[arg(long, num_args = 2, value_names = ["FLAT", "STEEP"], default_values_t = Envelope::default().climb_deg)]
    climb_deg: Vec<f64>,
    /// Least and most net mass, kg, of dives; climbs take the same with the other sign
    #[arg(long, num_args = 2, value_names = ["LEAST", "MOST"], default_values_t = Envelope::default().net_mass_kg)]
    net_mass_kg: Vec<f64>,
    /// Largest rotation of the moving mass, degrees
    #[arg(long, value_name = "DEG", default_value_t = Envelope::default().mu_deg)]
    mu_deg: f64,
}

impl EnvelopeArgs {
    /// The envelope; whether it can be flown is checked where it is used.
    pub(super) fn envelope(&self) -> Result<Envelope, String> {
        let pair =
            |values: &[f64]| <[f64; 2]>::try_from(values).map_err(|_| "an envelope takes two numbers".to_string());
        Ok(Envelope {
            dive_deg: pair(&self.dive_deg)?,
            climb_deg: pair(&self.climb_deg)?,
            net_mass_kg: pair(&self.net_mass_kg)?,
            mu_deg: self.mu_deg,
        })
    }
}
