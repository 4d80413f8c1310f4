//! What the policy sees before it places a vehicle.

/// Cells that the policy chooses among, at most.
pub const CANDIDATES: usize = 128;

/// Numbers that describe a candidate.
pub const FEATURES: usize = 36;

/// Candidates and their features, a structure of arrays.
#[derive(Debug, Clone)]
pub(super) struct Observation {
    /// The candidates' cells, ascending.
    pub(super) cells: Vec<u32>,
    /// [feature][candidate]; 0 beyond the last candidate.
    pub(super) features: Box<[[f32; CANDIDATES]; FEATURES]>,
}

impl Default for Observation {
    #[expect(clippy::large_stack_arrays, reason = "18 kilobytes on their way into a box")]
    fn default() -> Self {
        Self {
            cells: Vec::with_capacity(CANDIDATES),
            features: Box::new([[0.0; CANDIDATES]; FEATURES]),
        }
    }
}
