//! `sonarfleet assign`: which vehicle takes which post, given the costs.

use super::Manner;
use crate::args::{AssignArgs, AssignmentMethod, ObjectiveName};
use anyhow::{Context, Result};
use serde_json::json;
use sonarfleet::assignment::{AssignmentObjective, CostMatrix, assign as solve};

pub(crate) fn assign(args: &AssignArgs, manner: Manner) -> Result<()> {
    let AssignmentMethod::JonkerVolgenant = args.method;
    let objective = match args.objective {
        ObjectiveName::Sum => AssignmentObjective::Sum,
        ObjectiveName::Bottleneck => AssignmentObjective::BottleneckThenSum,
        ObjectiveName::Power => AssignmentObjective::Power(args.exponent),
    };
    let costs = CostMatrix::read(&args.costs)?;
    let assignment =
        solve(&costs, objective).with_context(|| format!("{}", args.costs.display()))?;
    if manner.json {
        return super::print_json(&json!({
            "assignment": assignment.column_of_row,
            "total": assignment.total,
            "largest": assignment.largest,
            "certified": assignment.certified,
        }));
    }
    for (row, column) in assignment.column_of_row.iter().enumerate() {
        let taken = match column {
            Some(column) => format!("{row} → {column}  {}", costs.cost(row, *column)),
            None => format!("{row} → none"),
        };
        super::say(taken)?;
    }
    let proof = if assignment.certified { "proved optimal" } else { "not proved optimal" };
    super::say(format_args!(
        "total {}, largest {}, {proof}",
        assignment.total, assignment.largest
    ))?;
    Ok(())
}
