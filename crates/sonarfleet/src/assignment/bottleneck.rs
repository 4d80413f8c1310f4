//! The least possible greatest cost of a complete assignment.

use super::{CostMatrix, HallViolation};

/// The bottleneck of a matrix with at most as many rows as columns: the least
/// greatest cost, and the proof that it cannot be less.
///
/// Rows are matched one after the other along the path whose greatest cost is least
/// (Derigs and Zimmermann 1978, doi:10.1007/BF02253181). The greatest cost is raised
/// only when a set of rows has too few columns below it; the last such set is the
/// proof. O(rows² columns).
///
/// # Errors
/// A set of rows with too few allowed columns.
pub(super) fn bottleneck(costs: &CostMatrix) -> Result<Bottleneck, HallViolation> {
    let columns = costs.columns();
    let mut row_of_column: Vec<Option<usize>> = vec![None; columns];
    let mut found = Bottleneck { cost: f64::NEG_INFINITY, rows: Vec::new(), columns: Vec::new() };
    for start in 0..costs.rows() {
        let mut key = vec![f64::INFINITY; columns];
        let mut parent_column: Vec<Option<usize>> = vec![None; columns];
        let mut visited = vec![false; columns];
        let (mut tree_rows, mut tree_columns) = (vec![start], Vec::new());
        let (mut row, mut from) = (start, None);
        let end = loop {
            for (column, &cost) in costs.row(row).iter().enumerate() {
                if !visited[column] && cost < key[column] {
                    key[column] = cost;
                    parent_column[column] = from;
                }
            }
            let open = (0..columns).filter(|&column| !visited[column] && key[column].is_finite());
            let Some(column) = open.min_by(|&a, &b| key[a].total_cmp(&key[b])) else {
                return Err(HallViolation {
                    rows: tree_rows,
                    columns: tree_columns,
                    transposed: false,
                });
            };
            if key[column] > found.cost {
                found = Bottleneck {
                    cost: key[column],
                    rows: tree_rows.clone(),
                    columns: tree_columns.clone(),
                };
            }
            let Some(holder) = row_of_column[column] else { break column };
            visited[column] = true;
            tree_columns.push(column);
            tree_rows.push(holder);
            (row, from) = (holder, Some(column));
        };
        let mut column = end;
        while let Some(previous) = parent_column[column] {
            row_of_column[column] = row_of_column[previous];
            column = previous;
        }
        row_of_column[column] = Some(start);
    }
    Ok(found)
}

/// A greatest cost and why it cannot be less: all columns that `rows` may take for
/// less are `columns`, and they are fewer.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Bottleneck {
    pub(super) cost: f64,
    rows: Vec<usize>,
    columns: Vec<usize>,
}

impl Bottleneck {
    /// Checks the proof against the costs.
    pub(super) fn holds(&self, costs: &CostMatrix) -> bool {
        let mut listed = vec![false; costs.columns()];
        for &column in &self.columns {
            listed[column] = true;
        }
        let within = |row: &usize| {
            let row = costs.row(*row).iter().zip(&listed);
            row.into_iter().all(|(&cost, &listed)| listed || cost >= self.cost)
        };
        self.columns.len() < self.rows.len() && self.rows.iter().all(within)
    }
}
