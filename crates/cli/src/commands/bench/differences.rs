use serde::Serialize;

/// Losses above this are left out, dB: what is fainter is not heard.
const COMPARED_LOSS_DB: f64 = 90.0;

/// How far losses are from others, dB.
#[derive(Debug, Clone, Copy, Serialize)]
#[expect(clippy::struct_field_names, reason = "units stand in names")]
pub(super) struct Differences {
    pub(super) median_db: f64,
    pub(super) p90_db: f64,
    pub(super) p99_db: f64,
}

impl Differences {
    /// Over the pairs of which the second is under 90 dB.
    pub(super) fn between(pairs: impl Iterator<Item = (f64, f64)>) -> Self {
        let mut all: Vec<f64> = pairs
            .filter(|(_, reference)| *reference < COMPARED_LOSS_DB)
            .map(|(loss, reference)| (loss - reference).abs())
            .collect();
        all.sort_by(f64::total_cmp);
        let quantile = |q: f64| match all.len() {
            0 => f64::NAN,
            count => all[((count - 1) as f64 * q).round() as usize],
        };
        Self { median_db: quantile(0.5), p90_db: quantile(0.9), p99_db: quantile(0.99) }
    }
}

impl std::fmt::Display for Differences {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:.2}/{:.2}/{:.2}", self.median_db, self.p90_db, self.p99_db)
    }
}
