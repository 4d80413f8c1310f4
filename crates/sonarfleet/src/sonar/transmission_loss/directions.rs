use super::table::TransmissionLossTable;
use serde::{Deserialize, Serialize};

/// In which directions sound is followed between two cells.
///
/// A loss is computed from a point, the middle of the source cell, to an average,
/// over the target cell. For a sonar that listens for a target somewhere in a cell
/// this is what is wanted (sound takes the same way back). Point and average are
/// not interchangeable: over a rough firm floor the two directions differ by
/// 0.6 dB in the median, and by 5 dB at the 99th percentile.
///
/// Links between vehicles need no such choice: the weight of a link is that of its
/// worse direction ([`Modem::link_weights`](crate::sonar::link::Modem::link_weights)),
/// so they use both rows of any table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Directions {
    /// From the source to the target.
    #[default]
    One,
    /// The mean of the intensities of both directions: a symmetric table.
    Both,
}

impl Directions {
    /// The name by which scenarios and files call it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::One => "one",
            Self::Both => "both",
        }
    }

    /// The table for these directions, from one in which each loss is of one.
    #[must_use]
    pub fn of(self, table: TransmissionLossTable) -> TransmissionLossTable {
        match self {
            Self::One => table,
            Self::Both => averaged(table),
        }
    }
}

/// Every pair of cells gets the mean of its two intensities. A source in the
/// ground, which is heard nowhere, counts as no intensity.
fn averaged(mut table: TransmissionLossTable) -> TransmissionLossTable {
    let cells = table.cell_count;
    for a in 0..cells {
        for b in 0..a {
            let mean = mean_loss_db(table.loss_db[a * cells + b], table.loss_db[b * cells + a]);
            table.loss_db[a * cells + b] = mean;
            table.loss_db[b * cells + a] = mean;
        }
    }
    table
}

/// The loss of the mean of two intensities; of equal ones exactly theirs.
fn mean_loss_db(a_db: f32, b_db: f32) -> f32 {
    if a_db.to_bits() == b_db.to_bits() {
        return a_db;
    }
    let intensity = |loss_db: f32| 10f64.powf(-0.1 * f64::from(loss_db));
    (-10.0 * (0.5 * (intensity(a_db) + intensity(b_db))).log10()) as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> TransmissionLossTable {
        TransmissionLossTable {
            cell_count: 3,
            loss_db: vec![50.0, 60.0, 70.0, 63.0, 51.0, 80.0, 70.0, 200.0, 52.0],
        }
    }

    #[test]
    fn one_direction_is_the_table_itself() {
        assert_eq!(Directions::One.of(table()), table());
    }

    #[test]
    fn both_directions_are_symmetric_and_the_mean_of_intensities() {
        let both = Directions::Both.of(table());
        let at = |a: usize, b: usize| both.loss_db[3 * a + b];
        for (a, b) in [(0, 1), (0, 2), (1, 2)] {
            assert_eq!(at(a, b).to_bits(), at(b, a).to_bits());
        }
        // (10⁻⁶ + 10⁻⁶·³)/2 is 10⁻⁶·¹²⁴⁵⁹…
        assert!((at(0, 1) - 61.2460).abs() < 1e-3, "{}", at(0, 1));
        assert_eq!(at(0, 2).to_bits(), 70f32.to_bits(), "equal losses stay as they are");
        // A direction that carries nothing halves the intensity.
        assert!((at(1, 2) - 83.0103).abs() < 1e-3);
        for n in 0..3 {
            assert_eq!(at(n, n).to_bits(), table().loss_db[4 * n].to_bits());
        }
        assert_eq!(Directions::Both.of(both.clone()), both, "once is enough");
    }
}
