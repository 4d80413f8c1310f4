//! The cheapest columns of each row, as many as were needed so far.

use super::CostMatrix;

/// Columns listed at first, and the factor by which a list grows.
const FIRST: usize = 24;
const GROWTH: usize = 4;

/// Lists are crowded from this part (one over) of the matrix.
const CROWDED: usize = 8;

/// A column and its cost for a row.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) cost: f64,
    pub(super) column: usize,
}

/// For each row its cheapest allowed columns. In the plane most rows end near their
/// cheapest columns, so that a search over these lists, lengthened where they do not
/// suffice, reads a small part of the matrix.
pub(super) struct NearestColumns<'a> {
    costs: &'a CostMatrix,
    lists: Vec<List>,
    listed: usize,
}

struct List {
    candidates: Vec<Candidate>,
    /// No column that is not listed costs less; infinite if all are listed.
    bound: f64,
}

impl<'a> NearestColumns<'a> {
    pub(super) fn new(costs: &'a CostMatrix) -> Self {
        // A short row is listed whole: choosing from it costs more than reading it.
        let length = if costs.columns() <= GROWTH * FIRST { costs.columns() } else { FIRST };
        let list = |row| List::of_row(costs.row(row), length);
        let lists: Vec<List> = (0..costs.rows()).map(list).collect();
        let listed = lists.iter().map(|list| list.candidates.len()).sum();
        Self { costs, lists, listed }
    }

    pub(super) fn candidates(&self, row: usize) -> &[Candidate] {
        &self.lists[row].candidates
    }

    /// A cost that no column outside the row's list undercuts.
    pub(super) fn bound(&self, row: usize) -> f64 {
        self.lists[row].bound
    }

    /// Whether so much of the matrix is listed that reading all of it is faster.
    pub(super) fn are_crowded(&self) -> bool {
        self.listed * CROWDED > self.costs.rows() * self.costs.columns()
    }

    /// Lengthens the list of a row.
    pub(super) fn grow(&mut self, row: usize) {
        let length = self.lists[row].candidates.len();
        self.lists[row] = List::of_row(self.costs.row(row), length.max(1) * GROWTH);
        self.listed += self.lists[row].candidates.len() - length;
    }
}

impl List {
    fn of_row(row: &[f64], length: usize) -> Self {
        let allowed = row.iter().enumerate().filter(|(_, cost)| cost.is_finite());
        let mut candidates: Vec<Candidate> =
            allowed.map(|(column, &cost)| Candidate { cost, column }).collect();
        if candidates.len() <= length {
            return Self { candidates, bound: f64::INFINITY };
        }
        let order =
            |a: &Candidate, b: &Candidate| a.cost.total_cmp(&b.cost).then(a.column.cmp(&b.column));
        let (_, next, _) = candidates.select_nth_unstable_by(length, order);
        let bound = next.cost;
        candidates.truncate(length);
        candidates.shrink_to_fit();
        candidates.sort_unstable_by_key(|candidate| candidate.column);
        Self { candidates, bound }
    }
}
