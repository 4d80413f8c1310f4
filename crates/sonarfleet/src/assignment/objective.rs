//! What is made small, and the assignment that does.

use super::bottleneck::{Bottleneck, bottleneck};
use super::shortest_augmenting_path::{Matching, least_sum};
use super::{AssignmentError, CostMatrix, HallViolation};

/// Rounding allowed in the certificate, relative to the greatest cost.
const ROUNDING: f64 = 1e-9;

/// What an assignment makes small.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AssignmentObjective {
    /// The sum of the costs, Eq. (1).
    Sum,
    /// The greatest cost, and among these assignments the sum.
    BottleneckThenSum,
    /// The sum of the costs raised to a power: over 1 it spares the worst pairs.
    Power(f64),
}

/// A complete assignment: every row has a column, or every column a row where there
/// are fewer columns.
#[derive(Debug, Clone, PartialEq)]
pub struct Assignment {
    /// The column of each row; none where there are more rows than columns.
    pub column_of_row: Vec<Option<usize>>,
    /// Sum of its costs (not raised to a power).
    pub total: f64,
    /// Its greatest cost.
    pub largest: f64,
    /// Whether it was proved optimal: by feasible dual prices of the same value, and
    /// for the bottleneck by rows that have too few columns for less.
    pub certified: bool,
}

/// The best assignment of rows to columns (vehicles to posts).
///
/// # Errors
/// Forbidden pairs that leave no complete assignment; with a power, negative costs or
/// an exponent that is not positive.
pub fn assign(
    costs: &CostMatrix,
    objective: AssignmentObjective,
) -> Result<Assignment, AssignmentError> {
    let transposed = costs.rows() > costs.columns();
    let flipped;
    let wide = if transposed {
        flipped = costs.transposed();
        &flipped
    } else {
        costs
    };
    let infeasible = |violation: HallViolation| {
        AssignmentError::Infeasible(HallViolation { transposed, ..violation })
    };

    let (matching, certified) = match objective {
        AssignmentObjective::Sum => {
            let matching = least_sum(wide).map_err(infeasible)?;
            let certified = is_optimal(wide, &matching);
            (matching, certified)
        }
        AssignmentObjective::Power(power) => {
            if !(power.is_finite() && power > 0.0) {
                return Err(AssignmentError::InvalidPower { found: power });
            }
            let raise = |cost: f64| if cost < 0.0 { f64::NAN } else { cost.powf(power) };
            // From the matrix as given, so that an error names its row and column.
            let raised = costs.map(raise, "not negative, and finite when raised to the power")?;
            let raised = if transposed { raised.transposed() } else { raised };
            let matching = least_sum(&raised).map_err(infeasible)?;
            let certified = is_optimal(&raised, &matching);
            (matching, certified)
        }
        AssignmentObjective::BottleneckThenSum => {
            let proof: Bottleneck = bottleneck(wide).map_err(infeasible)?;
            let limited = wide.at_most(proof.cost);
            let matching = least_sum(&limited).map_err(infeasible)?;
            let certified = proof.holds(wide) && is_optimal(&limited, &matching);
            (matching, certified)
        }
    };

    let pairs = || matching.column_of_row.iter().enumerate();
    let mut column_of_row = vec![None; costs.rows()];
    for (row, &column) in pairs() {
        let (row, column) = if transposed { (column, row) } else { (row, column) };
        column_of_row[row] = Some(column);
    }
    let chosen = || pairs().map(|(row, &column)| wide.cost(row, column));
    Ok(Assignment {
        column_of_row,
        total: chosen().sum(),
        largest: chosen().fold(f64::NEG_INFINITY, f64::max),
        certified,
    })
}

/// Whether a matching of all rows is proved to have the least sum: with
/// u = min over columns of c − v, every matched pair has c = u + v; v ≤ 0, and v = 0
/// for unmatched columns (linear-programming duality).
fn is_optimal(costs: &CostMatrix, matching: &Matching) -> bool {
    let pairs = || matching.column_of_row.iter().enumerate();
    let greatest = pairs().map(|(row, &column)| costs.cost(row, column).abs()).fold(0.0, f64::max);
    let lowest_price = matching.prices.iter().copied().fold(0.0, f64::min);
    let tolerance = ROUNDING * (greatest - lowest_price).max(f64::MIN_POSITIVE);

    let mut matched = vec![false; costs.columns()];
    for (_, &column) in pairs() {
        if std::mem::replace(&mut matched[column], true) {
            return false;
        }
    }
    let prices_allowed = matching.prices.iter().zip(&matched).all(|(&price, &matched)| {
        if matched { price <= tolerance } else { price.abs() <= tolerance }
    });
    let tight = |(row, &column): (usize, &usize)| {
        let reduced = costs.row(row).iter().zip(&matching.prices);
        let potential = reduced
            .map(|(cost, price)| cost - price)
            .fold(f64::INFINITY, |a, b| if b < a { b } else { a });
        costs.cost(row, column) - matching.prices[column] <= potential + tolerance
    };
    prices_allowed && pairs().all(tight)
}
