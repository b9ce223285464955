//! The figures and tables of Fan & Woolsey (2013), drawn anew and compared with what was printed.

pub mod comparison;
pub mod loci;
pub mod performance;
pub mod tables;
pub mod turning;

use std::path::Path;

use crate::files::whole_file;
use crate::model::vehicle::Vehicle;
use crate::pages::{
    chart::Figure,
    document::{Block, Document},
};
use comparison::{Row, Trend};

/// The vehicle whose tables the paper prints.
pub const VEHICLE: &str = "slocum-paper";

/// What no table and no curve says.
const REMARKS: [&str; 6] = [
    "Table 2 was computed with φ̇ = p. Equation (2) says φ̇ = p + r tanθ; both are shown, and the second is what the other commands compute.",
    "The printed trim, γ = −35°, is called maximum horizontal speed. Of this polar that is exactly −35.66°; −35° is near its limit of −35.26° for small K·C_D0.",
    "52 kg do not follow from the printed geometry: a cylinder with l = 1.5 m and f = 7 displaces 54.1 kg, and the tables need 50 kg.",
    "At γ = −35° the turn reverses at C_lβ ≈ −0.73: the linear system is singular there, so a sweep from −0.8 crosses a pole. It is marked, not smoothed.",
    "The fin's and the wing's place and shape are not printed. They are chosen (see the vehicle file), and the starting points of Figs 11 to 14 depend on them.",
    "Curves can be compared with the paper's description only: the printed figures carry no numbers but the ones in the table above.",
];

/// Everything that was drawn and compared.
#[derive(Clone, Debug, Default)]
pub struct Reproduction {
    /// Figures by their file names.
    pub figures: Vec<(String, Figure)>,
    /// Printed values beside ours.
    pub rows: Vec<Row>,
    /// Stated trends, and what was found.
    pub trends: Vec<Trend>,
}

/// Draws and compares everything.
///
/// # Errors
/// One line that says which study the vehicle does not allow.
pub fn reproduce(vehicle: &Vehicle) -> Result<Reproduction, String> {
    let mut all = performance::reproduce(vehicle)?;
    let tables = Reproduction { rows: tables::compare(vehicle)?, ..Reproduction::default() };
    for part in [turning::reproduce(vehicle)?, loci::reproduce(vehicle)?, tables] {
        all.figures.extend(part.figures);
        all.rows.extend(part.rows);
        all.trends.extend(part.trends);
    }
    Ok(all)
}

impl Reproduction {
    /// Figures as SVG with their data as CSV, and the comparison as Markdown and as one page, into a folder.
    ///
    /// # Errors
    /// One line that names the file that could not be written.
    pub fn write(&self, folder: &Path) -> Result<(), String> {
        self.document().write(folder, "comparison")?;
        for (name, figure) in &self.figures {
            whole_file::write(&folder.join(format!("{name}.csv")), |file| figure.write_csv(file))?;
        }
        Ok(())
    }

    fn document(&self) -> Document {
        let figure = |(name, figure): &(String, Figure)| Block::Figure(name.clone(), Box::new(figure.clone()));
        let mut blocks = comparison::blocks(&self.rows, &self.trends);
        blocks.extend([
            Block::Heading("What the paper leaves open".into()),
            Block::List(REMARKS.map(str::to_owned).into()),
            Block::Heading("Figures".into()),
        ]);
        blocks.extend(self.figures.iter().map(figure));
        Document { title: "Fan & Woolsey (2013), side by side".into(), blocks }
    }
}
