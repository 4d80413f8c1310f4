use super::{LossFileError, LossRows};
use crate::grid::CellId;
use std::path::{Path, PathBuf};

impl LossRows {
    /// Puts shards together, in any order.
    ///
    /// # Errors
    /// If they were computed for different things, overlap, or leave gaps.
    ///
    /// # Panics
    /// If there are no parts.
    pub fn merge(parts: &[(PathBuf, Self)]) -> Result<Self, LossFileError> {
        let ((first_path, first), others) = parts.split_first().expect("at least one part");
        for (path, part) in others {
            let difference = part.description.difference(&first.description);
            if let Some((what, found, expected)) = difference.or_else(|| part.elsewhere(first)) {
                let (first, path) = (first_path.clone(), path.clone());
                return Err(LossFileError::OtherTable { first, path, what, found, expected });
            }
        }
        let cells = first.cell_degrees.len();
        let mut loss_db = vec![f32::NAN; cells * cells];
        let mut holders: Vec<Option<&Path>> = vec![None; cells];
        for (path, part) in parts {
            for (&cell, row) in part.sources.iter().zip(part.loss_db.chunks_exact(cells)) {
                if let Some(holder) = holders[cell.0].replace(path) {
                    let (first, second) = (holder.to_owned(), path.clone());
                    return Err(LossFileError::Overlap { first, second, cell });
                }
                loss_db[cell.0 * cells..][..cells].copy_from_slice(row);
            }
        }
        let mut gaps = (0..cells).filter(|&n| holders[n].is_none());
        if let Some(n) = gaps.next() {
            let (cell, missing) = (CellId(n), 1 + gaps.count());
            return Err(LossFileError::Gap { missing, cells, cell });
        }
        let sources = (0..cells).map(CellId).collect();
        Ok(Self::new(first.description.clone(), first.cell_degrees.clone(), sources, loss_db))
    }
    /// Where a cell lies that is elsewhere in another table.
    fn elsewhere(&self, other: &Self) -> Option<(&'static str, String, String)> {
        let place = |(longitude, latitude): &(f64, f64)| format!("{longitude}° E, {latitude}° N");
        let mut pairs = self.cell_degrees.iter().zip(&other.cell_degrees);
        pairs
            .find(|(mine, theirs)| mine != theirs)
            .map(|(mine, theirs)| ("the place of a cell", place(mine), place(theirs)))
    }
}
