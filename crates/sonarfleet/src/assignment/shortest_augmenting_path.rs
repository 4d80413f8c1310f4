//! The assignment of least sum by shortest augmenting paths.

use super::nearest_columns::NearestColumns;
use super::{CostMatrix, HallViolation};
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Rounds of augmenting row reduction before the shortest paths.
const REDUCTION_ROUNDS: usize = 2;

/// Most steps of a round, per row.
const REDUCTION_STEPS: usize = 3;

/// All rows matched, with the columns' dual prices.
pub(super) struct Matching {
    pub(super) column_of_row: Vec<usize>,
    /// v, at most 0, and 0 for unmatched columns.
    pub(super) prices: Vec<f64>,
}

/// Matches every row to a column of its own with the least sum of costs.
///
/// Jonker and Volgenant (1987, doi:10.1007/BF02278710): augmenting row reduction,
/// then for every row still free a shortest augmenting path by Dijkstra's method on
/// reduced costs c − u − v ≥ 0, after which the prices v are lowered. Both read only
/// the cheapest columns of a row; as v ≤ 0, a column that is not listed cannot have a
/// reduced cost below the list's bound − u, and when a search gets that far the list
/// is lengthened. So the result is exact. Where rows compete for the same columns the
/// lists grow too long to pay, and whole rows are read instead: O(rows² columns).
///
/// # Errors
/// A set of rows with too few allowed columns.
///
/// # Panics
/// If there are more rows than columns.
pub(super) fn least_sum(costs: &CostMatrix) -> Result<Matching, HallViolation> {
    assert!(costs.rows() <= costs.columns(), "every row needs a column");
    let mut solver = Solver::new(costs);
    let mut free: Vec<usize> = (0..costs.rows()).collect();
    for _ in 0..REDUCTION_ROUNDS {
        free = solver.reduce_rows(free);
    }
    for row in free {
        if solver.nearest.are_crowded() {
            solver.augment_through_all(row)?;
        } else {
            solver.augment(row)?;
        }
    }
    let matched = |column: Option<usize>| column.expect("augmenting has matched every row");
    Ok(Matching {
        column_of_row: solver.column_of_row.into_iter().map(matched).collect(),
        prices: solver.price,
    })
}

struct Solver<'a> {
    costs: &'a CostMatrix,
    nearest: NearestColumns<'a>,
    column_of_row: Vec<Option<usize>>,
    row_of_column: Vec<Option<usize>>,
    price: Vec<f64>,
    /// Least known distance of each column in the present search.
    distance: Vec<f64>,
    /// The row from which a column is reached.
    parent: Vec<usize>,
    settled: Vec<bool>,
}

/// What a search does next, at a distance.
#[derive(Clone, Copy)]
struct Event {
    distance: f64,
    what: What,
}

#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum What {
    /// Lengthen the list of a row that was reached at the distance of `from`.
    Grow { row: usize },
    /// Settle a column.
    Settle { column: usize },
}

impl PartialEq for Event {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}
impl Eq for Event {}
impl PartialOrd for Event {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for Event {
    /// The nearest event is the greatest, and lists grow before columns settle.
    fn cmp(&self, other: &Self) -> Ordering {
        other.distance.total_cmp(&self.distance).then(other.what.cmp(&self.what))
    }
}

impl<'a> Solver<'a> {
    fn new(costs: &'a CostMatrix) -> Self {
        let (rows, columns) = (costs.rows(), costs.columns());
        Self {
            costs,
            nearest: NearestColumns::new(costs),
            column_of_row: vec![None; rows],
            row_of_column: vec![None; columns],
            price: vec![0.0; columns],
            distance: vec![f64::INFINITY; columns],
            parent: vec![0; columns],
            settled: vec![false; columns],
        }
    }

    /// Each free row takes its cheapest column and lowers the price until the second
    /// cheapest is as good; who held the column is free again. Returns the rows that
    /// end without a column.
    fn reduce_rows(&mut self, free: Vec<usize>) -> Vec<usize> {
        let mut still_free = Vec::new();
        // Rows that want the same columns would displace each other for long.
        let mut steps = REDUCTION_STEPS * self.costs.rows();
        for first in free {
            let mut next = Some(first);
            // A row that was displaced tries at once.
            while steps > 0 {
                let Some(row) = next.take() else { break };
                steps -= 1;
                let Some((best, least, second)) = self.two_cheapest(row) else {
                    still_free.push(row);
                    break;
                };
                let holder = self.row_of_column[best];
                let gain = second - least;
                if holder.is_some() && !(gain > 0.0 && gain.is_finite()) {
                    still_free.push(row);
                    break;
                }
                if gain.is_finite() {
                    self.price[best] -= gain;
                }
                self.row_of_column[best] = Some(row);
                self.column_of_row[row] = Some(best);
                if let Some(holder) = holder {
                    self.column_of_row[holder] = None;
                    next = Some(holder);
                }
            }
            still_free.extend(next);
        }
        still_free
    }

    /// The column of least reduced cost of a row, that cost and the second least.
    fn two_cheapest(&mut self, row: usize) -> Option<(usize, f64, f64)> {
        loop {
            let (mut best, mut least, mut second) = (None, f64::INFINITY, f64::INFINITY);
            for candidate in self.nearest.candidates(row) {
                let reduced = candidate.cost - self.price[candidate.column];
                if reduced < least {
                    (best, second, least) = (Some(candidate.column), least, reduced);
                } else if reduced < second {
                    second = reduced;
                }
            }
            let bound = self.nearest.bound(row);
            if second <= bound {
                return best.map(|best| (best, least, second));
            }
            self.nearest.grow(row);
        }
    }

    /// Matches a free row along the shortest augmenting path.
    fn augment(&mut self, start: usize) -> Result<(), HallViolation> {
        let mut search = Search {
            heap: BinaryHeap::new(),
            touched: Vec::new(),
            settled: Vec::new(),
            // c − v of a free row's cheapest column is its u: no more than an offset.
            reached: vec![(start, 0.0)],
            nearest_free: f64::INFINITY,
        };
        self.relax(start, 0.0, &mut search);
        let end = loop {
            let Some(Event { distance, what }) = search.heap.pop() else { break None };
            match what {
                What::Grow { row } => {
                    self.nearest.grow(row);
                    let reached = search.reached.iter().find(|&&(reached, _)| reached == row);
                    let offset = reached.expect("only reached rows grow").1;
                    self.relax(row, offset, &mut search);
                }
                What::Settle { column } => {
                    if self.settled[column] || distance > self.distance[column] {
                        continue;
                    }
                    let Some(row) = self.row_of_column[column] else {
                        break Some((column, distance));
                    };
                    self.settled[column] = true;
                    search.settled.push(column);
                    let potential = self.costs.cost(row, column) - self.price[column];
                    let offset = distance - potential;
                    search.reached.push((row, offset));
                    self.relax(row, offset, &mut search);
                }
            }
        };
        let outcome = match end {
            Some((free_column, length)) => {
                for &column in &search.settled {
                    self.price[column] += self.distance[column] - length;
                }
                self.flip(start, free_column);
                Ok(())
            }
            None => Err(HallViolation {
                rows: search.reached.iter().map(|&(row, _)| row).collect(),
                columns: search.settled.clone(),
                transposed: false,
            }),
        };
        for column in search.touched {
            self.distance[column] = f64::INFINITY;
            self.settled[column] = false;
        }
        outcome
    }

    /// Looks from a row (at its distance less its potential) to its listed columns.
    fn relax(&mut self, row: usize, offset: f64, search: &mut Search) {
        for candidate in self.nearest.candidates(row) {
            let column = candidate.column;
            let distance = offset + candidate.cost - self.price[column];
            // Nothing beyond the nearest free column lies on the shortest path.
            if distance >= self.distance[column]
                || distance > search.nearest_free
                || self.settled[column]
            {
                continue;
            }
            if self.distance[column] == f64::INFINITY {
                search.touched.push(column);
            }
            self.distance[column] = distance;
            self.parent[column] = row;
            if self.row_of_column[column].is_none() {
                search.nearest_free = distance;
            }
            search.heap.push(Event { distance, what: What::Settle { column } });
        }
        let bound = offset + self.nearest.bound(row);
        if bound < search.nearest_free {
            search.heap.push(Event { distance: bound, what: What::Grow { row } });
        }
    }

    /// As [`Solver::augment`], but reads whole rows: three passes that vectorise for
    /// every row of the tree, and no heap.
    fn augment_through_all(&mut self, start: usize) -> Result<(), HallViolation> {
        // Settled columns have an open price of −∞ and so are never reached again.
        let mut open_price = self.price.clone();
        let mut key = vec![f64::INFINITY; self.price.len()];
        let mut settled: Vec<(usize, f64)> = Vec::new();
        let (mut row, mut offset) = (start, 0.0);
        let (free_column, length) = loop {
            let reached = key.iter_mut().zip(&mut self.parent);
            let prices = self.costs.row(row).iter().zip(&open_price);
            for ((key, parent), (&cost, &price)) in reached.zip(prices) {
                let distance = offset + (cost - price);
                let nearer = distance < *key;
                *key = if nearer { distance } else { *key };
                *parent = if nearer { row } else { *parent };
            }
            let least = least(&key);
            let nearest = || (0..key.len()).filter(|&column| key[column] <= least);
            if least == f64::INFINITY {
                let columns: Vec<usize> = settled.iter().map(|&(column, _)| column).collect();
                let holders = columns.iter().filter_map(|&column| self.row_of_column[column]);
                let rows = std::iter::once(start).chain(holders).collect();
                return Err(HallViolation { rows, columns, transposed: false });
            }
            if let Some(column) = nearest().find(|&column| self.row_of_column[column].is_none()) {
                break (column, least);
            }
            let column = nearest().next().expect("the least key is one of the keys");
            settled.push((column, least));
            key[column] = f64::INFINITY;
            open_price[column] = f64::NEG_INFINITY;
            row = self.row_of_column[column].expect("a free column ends the search");
            offset = least - (self.costs.cost(row, column) - self.price[column]);
        };
        for (column, distance) in settled {
            self.price[column] += distance - length;
        }
        self.flip(start, free_column);
        Ok(())
    }

    /// Exchanges matched and free edges from a free column back to the start.
    fn flip(&mut self, start: usize, free_column: usize) {
        let mut column = free_column;
        loop {
            let row = self.parent[column];
            self.row_of_column[column] = Some(row);
            let left = self.column_of_row[row].replace(column);
            match left {
                Some(left) if row != start => column = left,
                _ => break,
            }
        }
    }
}

/// A search from one free row.
struct Search {
    heap: BinaryHeap<Event>,
    /// Columns with a distance.
    touched: Vec<usize>,
    settled: Vec<usize>,
    /// Rows of the tree, with their distances less their potentials.
    reached: Vec<(usize, f64)>,
    nearest_free: f64,
}

/// The least of some numbers, none NaN.
fn least(numbers: &[f64]) -> f64 {
    const LANES: usize = 8;
    let mut least = [f64::INFINITY; LANES];
    let chunks = numbers.chunks_exact(LANES);
    for &number in chunks.remainder() {
        least[0] = if number < least[0] { number } else { least[0] };
    }
    for chunk in chunks {
        for (least, &number) in least.iter_mut().zip(chunk) {
            *least = if number < *least { number } else { *least };
        }
    }
    least.into_iter().fold(f64::INFINITY, f64::min)
}
