//! Costs of all pairs, checked.

use super::AssignmentError;
use crate::npz::Archive;
use std::path::Path;

/// Costs [row, column]: of a vehicle (row) on a post (column). An infinite cost
/// forbids the pair; all others are finite.
#[derive(Debug, Clone, PartialEq)]
pub struct CostMatrix {
    rows: usize,
    columns: usize,
    values: Vec<f64>,
}

impl CostMatrix {
    /// A matrix from its values, [row, column]; infinite where the pair is forbidden.
    ///
    /// # Errors
    /// No rows or columns, a wrong number of values, NaN or −∞ (with its place).
    pub fn new(rows: usize, columns: usize, values: Vec<f64>) -> Result<Self, AssignmentError> {
        if rows == 0 || columns == 0 {
            return Err(AssignmentError::Empty { rows, columns });
        }
        if rows.checked_mul(columns) != Some(values.len()) {
            return Err(AssignmentError::WrongLength { rows, columns, found: values.len() });
        }
        if let Some(index) =
            values.iter().position(|&cost| cost.is_nan() || cost == f64::NEG_INFINITY)
        {
            return Err(AssignmentError::InvalidCost {
                row: index / columns,
                column: index % columns,
                expected: "a number, or inf where forbidden",
                found: values[index],
            });
        }
        Ok(Self { rows, columns, values })
    }

    /// Reads the array `cost` of an `.npz` archive, or a `.csv` file with one row per
    /// line and no header. Empty fields and `inf` are forbidden pairs.
    ///
    /// # Errors
    /// A file that cannot be read, or a field that is no cost (with its place).
    pub fn read(path: impl AsRef<Path>) -> Result<Self, AssignmentError> {
        let path = path.as_ref();
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("npz") => Self::read_npz(path),
            Some("csv") => Self::read_csv(path),
            _ => Err(AssignmentError::UnknownFormat { path: path.to_path_buf() }),
        }
    }

    fn read_npz(path: &Path) -> Result<Self, AssignmentError> {
        const KEY: &str = "cost";
        let archive = Archive::open(path)?;
        let array = archive.f64s(KEY)?;
        match array.shape[..] {
            [rows, columns] => Self::new(rows, columns, array.values),
            _ => Err(archive.wrong_shape(KEY, array.shape, "[rows, columns]".to_owned()).into()),
        }
    }

    fn read_csv(path: &Path) -> Result<Self, AssignmentError> {
        let text = std::fs::read_to_string(path)
            .map_err(|source| AssignmentError::Read { path: path.to_path_buf(), source })?;
        let (mut rows, mut columns, mut values) = (0, 0, Vec::new());
        let text = text.trim_start_matches('\u{feff}');
        for line in text.lines().filter(|line| !line.trim().is_empty()) {
            let before = values.len();
            for (column, field) in line.split(',').map(str::trim).enumerate() {
                let cost = if field.is_empty() { Ok(f64::INFINITY) } else { field.parse() };
                values.push(cost.map_err(|_| AssignmentError::CsvField {
                    path: path.to_path_buf(),
                    row: rows,
                    column,
                    found: field.to_owned(),
                })?);
            }
            let found = values.len() - before;
            if rows > 0 && found != columns {
                let (path, row, expected) = (path.to_path_buf(), rows, columns);
                return Err(AssignmentError::CsvRow { path, row, expected, found });
            }
            columns = found;
            rows += 1;
        }
        Self::new(rows, columns, values)
    }

    /// Number of rows.
    pub const fn rows(&self) -> usize {
        self.rows
    }

    /// Number of columns.
    pub const fn columns(&self) -> usize {
        self.columns
    }

    /// One cost.
    ///
    /// # Panics
    /// If there is no such pair.
    pub fn cost(&self, row: usize, column: usize) -> f64 {
        self.row(row)[column]
    }

    /// The costs of a row.
    pub(super) fn row(&self, row: usize) -> &[f64] {
        &self.values[row * self.columns..][..self.columns]
    }

    /// The same costs with rows and columns exchanged.
    pub(super) fn transposed(&self) -> Self {
        let entry = |index: usize| {
            let (column, row) = (index / self.rows, index % self.rows);
            self.values[row * self.columns + column]
        };
        let values = (0..self.values.len()).map(entry).collect();
        Self { rows: self.columns, columns: self.rows, values }
    }

    /// The same matrix with every cost replaced; infinite costs stay so.
    pub(super) fn map(
        &self,
        change: impl Fn(f64) -> f64,
        expected: &'static str,
    ) -> Result<Self, AssignmentError> {
        let mut values = self.values.clone();
        for (index, cost) in values.iter_mut().enumerate().filter(|(_, cost)| cost.is_finite()) {
            let changed = change(*cost);
            if !changed.is_finite() {
                let (row, column) = (index / self.columns, index % self.columns);
                return Err(AssignmentError::InvalidCost { row, column, expected, found: *cost });
            }
            *cost = changed;
        }
        Ok(Self { values, ..*self })
    }

    /// The same matrix in which pairs over a cost are forbidden.
    pub(super) fn at_most(&self, limit: f64) -> Self {
        let keep = |&cost: &f64| if cost <= limit { cost } else { f64::INFINITY };
        Self { values: self.values.iter().map(keep).collect(), ..*self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reads_csv_and_says_where_it_is_wrong() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("costs.csv");
        let read = |text: &str| {
            std::fs::write(&path, text).unwrap();
            CostMatrix::read(&path)
        };
        let costs = read("1, 2.5,\ninf,4,5e1\n\n").unwrap();
        assert_eq!((costs.rows(), costs.columns()), (2, 3));
        assert_eq!(costs.row(0), [1.0, 2.5, f64::INFINITY]);
        assert_eq!(costs.row(1), [f64::INFINITY, 4.0, 50.0]);
        let message = |text: &str| read(text).unwrap_err().to_string();
        assert!(message("1,2\n3,x\n").contains("row 1, column 1 (from 0) must be a cost"));
        assert!(message("1,2\n3\n").contains("row 1 (from 0) has 1 columns"));
        assert!(message("1,nan\n").contains("row 0, column 1"));
        assert!(message("").contains("empty"));
        let other = CostMatrix::read(folder.path().join("costs.txt"));
        assert!(matches!(other, Err(AssignmentError::UnknownFormat { .. })));
        let absent = CostMatrix::read(folder.path().join("absent.csv"));
        assert!(matches!(absent, Err(AssignmentError::Read { .. })));
    }

    #[test]
    fn reads_npz() {
        use crate::npz::{NamedArray, Values, write};
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("costs.npz");
        let values = [1.0, f64::INFINITY];
        let array = |shape| NamedArray { key: "cost", shape, values: Values::F64(&values) };
        write(&path, &[array(&[1, 2])]).unwrap();
        assert_eq!(CostMatrix::read(&path).unwrap(), CostMatrix::new(1, 2, values.into()).unwrap());
        write(&path, &[array(&[2])]).unwrap();
        assert!(CostMatrix::read(&path).unwrap_err().to_string().contains("[rows, columns]"));
    }
}
