//! Which vehicle takes which post: exact assignment with a certificate.
//!
//! ```
//! use sonarfleet::assignment::{AssignmentObjective, CostMatrix, assign};
//!
//! let forbidden = f64::INFINITY;
//! let hours = CostMatrix::new(2, 3, vec![1.0, 4.0, forbidden, 2.0, 9.0, 7.0])?;
//! let best = assign(&hours, AssignmentObjective::Sum)?;
//! assert_eq!(best.column_of_row, [Some(1), Some(0)]);
//! assert_eq!((best.total, best.certified), (6.0, true));
//! # Ok::<(), sonarfleet::assignment::AssignmentError>(())
//! ```

mod bottleneck;
mod cost_matrix;
mod error;
mod nearest_columns;
mod objective;
mod shortest_augmenting_path;

pub use cost_matrix::CostMatrix;
pub use error::{AssignmentError, HallViolation};
pub use objective::{Assignment, AssignmentObjective, assign};
