//! The noise that a receiver hears.

use super::SonarError;
use crate::grid::CellId;

/// Noise level at the receivers, dB re 1 µPa in the receiver's band.
#[derive(Debug, Clone, PartialEq)]
pub enum NoiseLevel {
    /// The same everywhere.
    Uniform(f64),
    /// One value per cell, [row, column].
    PerCell(Vec<f64>),
}

impl NoiseLevel {
    /// The level at a cell, dB.
    ///
    /// # Panics
    /// Where the cell is not one of the grid for which the level was checked.
    pub fn at_db(&self, cell: CellId) -> f64 {
        match self {
            Self::Uniform(level_db) => *level_db,
            Self::PerCell(levels_db) => levels_db[cell.0],
        }
    }

    /// Checks that every cell of a grid of `cells` cells has a finite level.
    ///
    /// # Errors
    /// Where it has not.
    pub fn check(&self, cells: usize) -> Result<(), SonarError> {
        let (name, expected) = ("noise_level_db", "a finite number");
        match self {
            Self::Uniform(level_db) => {
                super::error::checked(name, *level_db, expected, f64::is_finite).map(drop)
            }
            Self::PerCell(levels_db) if levels_db.len() != cells => Err(SonarError::WrongLength {
                name,
                found: levels_db.len(),
                expected: format!("one per cell ({cells})"),
            }),
            Self::PerCell(levels_db) => match levels_db.iter().position(|db| !db.is_finite()) {
                Some(index) => Err(SonarError::ElementOutOfRange {
                    name,
                    index,
                    found: levels_db[index],
                    expected,
                }),
                None => Ok(()),
            },
        }
    }
}
