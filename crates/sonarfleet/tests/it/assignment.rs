//! The assignment against brute force, and its certificate on larger problems.

use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use rand::Rng;
use sonarfleet::assignment::{AssignmentError, AssignmentObjective, CostMatrix, assign};
use sonarfleet::random::stream;

const OBJECTIVES: [AssignmentObjective; 3] = [
    AssignmentObjective::Sum,
    AssignmentObjective::BottleneckThenSum,
    AssignmentObjective::Power(1.5),
];

/// The value of an objective: compared first to last.
fn value(objective: AssignmentObjective, chosen: &[f64]) -> [f64; 2] {
    let sum: f64 = chosen.iter().sum();
    match objective {
        AssignmentObjective::Sum => [sum, 0.0],
        AssignmentObjective::BottleneckThenSum => {
            [chosen.iter().copied().fold(f64::NEG_INFINITY, f64::max), sum]
        }
        AssignmentObjective::Power(power) => {
            [chosen.iter().map(|cost| cost.powf(power)).sum(), 0.0]
        }
    }
}

/// All complete assignments, by trying them.
fn brute_force(costs: &CostMatrix, objective: AssignmentObjective) -> Option<[f64; 2]> {
    let pairs = costs.rows().min(costs.columns());
    let mut best: Option<[f64; 2]> = None;
    let mut chosen = Vec::new();
    fn extend(
        costs: &CostMatrix,
        pairs: usize,
        used: &mut Vec<bool>,
        index: usize,
        chosen: &mut Vec<f64>,
        visit: &mut dyn FnMut(&[f64]),
    ) {
        if chosen.len() == pairs {
            visit(chosen);
            return;
        }
        let wide = costs.rows() <= costs.columns();
        for other in 0..used.len() {
            let cost = if wide { costs.cost(index, other) } else { costs.cost(other, index) };
            if !used[other] && cost.is_finite() {
                used[other] = true;
                chosen.push(cost);
                extend(costs, pairs, used, index + 1, chosen, visit);
                chosen.pop();
                used[other] = false;
            }
        }
    }
    let mut used = vec![false; costs.rows().max(costs.columns())];
    extend(costs, pairs, &mut used, 0, &mut chosen, &mut |chosen| {
        let found = value(objective, chosen);
        if best.is_none_or(|best| found < best) {
            best = Some(found);
        }
    });
    best
}

/// Small integers make ties; every fourth pair is forbidden.
fn matrices() -> impl Strategy<Value = CostMatrix> {
    (1_usize..=7, 1_usize..=7).prop_flat_map(|(rows, columns)| {
        let cost = prop_oneof![
            1 => Just(f64::INFINITY),
            2 => (0_u8..6).prop_map(f64::from),
            1 => 0.0..20.0_f64,
        ];
        proptest::collection::vec(cost, rows * columns)
            .prop_map(move |values| CostMatrix::new(rows, columns, values).unwrap())
    })
}

proptest! {
    #![proptest_config(ProptestConfig {
        cases: 256,
        failure_persistence: None,
        rng_seed: RngSeed::Fixed(1),
        ..ProptestConfig::default()
    })]

    #[test]
    fn equals_brute_force(costs in matrices()) {
        for objective in OBJECTIVES {
            let best = brute_force(&costs, objective);
            match assign(&costs, objective) {
                Ok(found) => {
                    let pairs: Vec<(usize, usize)> = found
                        .column_of_row
                        .iter()
                        .enumerate()
                        .filter_map(|(row, column)| column.map(|column| (row, column)))
                        .collect();
                    let chosen: Vec<f64> =
                        pairs.iter().map(|&(row, column)| costs.cost(row, column)).collect();
                    let (best, ours) = (best.unwrap(), value(objective, &chosen));
                    prop_assert!((best[0] - ours[0]).abs() < 1e-9 && (best[1] - ours[1]).abs() < 1e-9,
                        "{objective:?}: {ours:?} instead of {best:?}");
                    prop_assert!(found.certified);
                    prop_assert!((found.total - chosen.iter().sum::<f64>()).abs() < 1e-9);
                    prop_assert_eq!(pairs.len(), costs.rows().min(costs.columns()));
                }
                Err(AssignmentError::Infeasible(violation)) => {
                    prop_assert!(best.is_none());
                    prop_assert!(violation.columns.len() < violation.rows.len());
                    for &row in &violation.rows {
                        let others = if violation.transposed { costs.rows() } else { costs.columns() };
                        for column in (0..others).filter(|column| !violation.columns.contains(column)) {
                            let cost = if violation.transposed {
                                costs.cost(column, row)
                            } else {
                                costs.cost(row, column)
                            };
                            prop_assert!(cost.is_infinite());
                        }
                    }
                }
                Err(other) => prop_assert!(false, "{other}"),
            }
        }
    }
}

/// Distances between random points; all starts on one line if `contested`.
fn distances(seed: u64, rows: usize, columns: usize, contested: bool) -> CostMatrix {
    let mut random = stream(seed, "test/assignment", 0);
    let mut point = |line: bool| [if line { 0.0 } else { random.random::<f64>() }, random.random()];
    let starts: Vec<[f64; 2]> = (0..rows).map(|_| point(contested)).collect();
    let goals: Vec<[f64; 2]> = (0..columns).map(|_| point(false)).collect();
    let distance = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let values = starts.iter().flat_map(|a| goals.iter().map(move |b| distance(a, b))).collect();
    CostMatrix::new(rows, columns, values).unwrap()
}

#[test]
fn larger_problems_are_certified() {
    for (rows, columns) in [(40, 40), (300, 300), (150, 260), (260, 150)] {
        for contested in [false, true] {
            let costs = distances(1, rows, columns, contested);
            for objective in OBJECTIVES {
                let found = assign(&costs, objective).unwrap();
                assert!(
                    found.certified,
                    "{rows} × {columns}, contested {contested}, {objective:?}"
                );
            }
        }
    }
}

#[test]
fn objectives_trade_the_sum_for_the_worst() {
    let costs = distances(3, 60, 60, false);
    let [sum, bottleneck, power] = OBJECTIVES.map(|objective| assign(&costs, objective).unwrap());
    assert!(sum.total <= power.total && power.total <= bottleneck.total);
    assert!(bottleneck.largest <= power.largest && power.largest <= sum.largest);
    assert!(bottleneck.largest < sum.largest);
}

#[test]
fn errors_carry_evidence() {
    let inf = f64::INFINITY;
    let costs = CostMatrix::new(3, 3, vec![1.0, inf, inf, 2.0, inf, inf, 1.0, 1.0, 1.0]).unwrap();
    for objective in OBJECTIVES {
        let message = assign(&costs, objective).unwrap_err().to_string();
        assert!(message.contains("2 rows") && message.contains("only 1 columns"), "{message}");
    }
    let negative = CostMatrix::new(1, 2, vec![1.0, -2.0]).unwrap();
    assert!((assign(&negative, AssignmentObjective::Sum).unwrap().total + 2.0).abs() < 1e-12);
    let message = assign(&negative, AssignmentObjective::Power(2.0)).unwrap_err().to_string();
    assert!(message.contains("row 0, column 1"), "{message}");
    let power = assign(&costs, AssignmentObjective::Power(f64::NAN));
    assert!(matches!(power, Err(AssignmentError::InvalidPower { .. })));
}
