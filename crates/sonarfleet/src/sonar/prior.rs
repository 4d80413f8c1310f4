//! Where targets are expected, `P_T`.
//!
//! `P_T` of a cell is the expected number of targets in it: for the rare targets
//! of the paper the probability that one is there. It is not a distribution over
//! the cells (the paper's sums to about 38), and it needs no ceiling of 1:
//! Eq. (6) is then the expected number of targets detected, which is additive
//! whether or not targets come together.

use super::SonarError;
use super::error::checked;
use crate::grid::{Position, SurveillanceGrid};
use serde::{Deserialize, Serialize};

/// A checked target prior: finite, nowhere negative, somewhere positive.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetPrior(Vec<f64>);

impl TargetPrior {
    /// A prior from plain values, one per cell, [row, column].
    ///
    /// # Errors
    /// Where a value is negative or not finite, or all are 0.
    pub fn new(values: Vec<f64>) -> Result<Self, SonarError> {
        if let Some(index) = values.iter().position(|p| !(p.is_finite() && *p >= 0.0)) {
            return Err(SonarError::ElementOutOfRange {
                name: "prior",
                index,
                found: values[index],
                expected: "a finite number of at least 0",
            });
        }
        if values.iter().any(|&p| p > 0.0) { Ok(Self(values)) } else { Err(SonarError::EmptyPrior) }
    }

    /// The corridor along a line of Fig. 3b.
    ///
    /// # Errors
    /// Where a width, the fraction or the total is not positive, or the line does
    /// not cross the region.
    pub fn line_corridor(
        corridor: &LineCorridor,
        grid: &SurveillanceGrid,
    ) -> Result<Self, SonarError> {
        corridor.prior(grid)
    }

    /// A sum of Gaussian blobs.
    ///
    /// # Errors
    /// Where a width is not positive, a weight is negative, a number is not
    /// finite, or all is 0.
    pub fn gaussian_blobs(
        blobs: &[GaussianBlob],
        grid: &SurveillanceGrid,
    ) -> Result<Self, SonarError> {
        let mut values = vec![0.0; grid.cell_count()];
        for blob in blobs {
            for (value, expected) in values.iter_mut().zip(blob.values(grid)?) {
                *value += expected;
            }
        }
        Self::new(values)
    }

    /// Expected number of targets per cell, [row, column].
    pub fn values(&self) -> &[f64] {
        &self.0
    }

    /// Expected number of targets in the region, Σ `P_T`.
    pub fn total(&self) -> f64 {
        self.0.iter().sum()
    }
}

/// A corridor along a straight line, Gaussian across and along it (Fig. 3b of the
/// paper). The region is seen as the square [0, 10] × [0, 10], x east and y north.
/// The defaults are the paper's, and ours where it is silent.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LineCorridor {
    /// Slope of the line y = slope · x + intercept.
    pub slope: f64,
    /// Intercept of the line.
    pub intercept: f64,
    /// Standard deviation across the line, in tenths of the region.
    pub width: f64,
    /// Standard deviation along the line as a fraction of half the line's chord
    /// inside the region; the kernel's centre is the chord's middle.
    pub length_fraction: f64,
    /// Expected number of targets in the region, Σ `P_T`.
    pub total: f64,
}

impl Default for LineCorridor {
    fn default() -> Self {
        Self { slope: -2.0, intercept: 13.0, width: 0.5, length_fraction: 0.5, total: 38.0 }
    }
}

impl LineCorridor {
    fn prior(&self, grid: &SurveillanceGrid) -> Result<TargetPrior, SonarError> {
        let positive =
            |name, value| checked(name, value, "a positive number", |x| x.is_finite() && x > 0.0);
        checked("slope", self.slope, "a finite number", f64::is_finite)?;
        checked("intercept", self.intercept, "a finite number", f64::is_finite)?;
        let width = positive("width", self.width)?;
        let length_fraction = positive("length_fraction", self.length_fraction)?;
        let total = positive("total", self.total)?;
        let [west, east] = self.chord()?;

        let stretch = 1.0_f64.hypot(self.slope);
        let half_chord = 0.5 * (east - west) * stretch;
        let length = length_fraction * half_chord;
        let middle = 0.5 * (west + east);
        let kernel: Vec<f64> = scaled_centres(grid)
            .map(|(x, y)| {
                let (dx, dy) = (x - middle, y - (self.slope * middle + self.intercept));
                let along = (dx + self.slope * dy) / stretch;
                let across = (dy - self.slope * dx) / stretch;
                (-0.5 * ((across / width).powi(2) + (along / length).powi(2))).exp()
            })
            .collect();
        let sum: f64 = kernel.iter().sum();
        TargetPrior::new(kernel.iter().map(|k| k * total / sum).collect())
    }

    /// The x at which the line enters and leaves the square.
    fn chord(&self) -> Result<[f64; 2], SonarError> {
        const SIDE: f64 = 10.0;
        let crossings = if self.slope == 0.0 {
            if (0.0..=SIDE).contains(&self.intercept) { [0.0, SIDE] } else { [1.0, 0.0] }
        } else {
            let at = |y: f64| (y - self.intercept) / self.slope;
            let (first, second) = (at(0.0).min(at(SIDE)), at(0.0).max(at(SIDE)));
            [first.max(0.0), second.min(SIDE)]
        };
        if crossings[1] > crossings[0] {
            Ok(crossings)
        } else {
            Err(SonarError::LineOutsideRegion { slope: self.slope, intercept: self.intercept })
        }
    }
}

/// An area where targets are expected, Gaussian in both directions.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GaussianBlob {
    /// Its centre, metres east and north of the region's south-west corner.
    pub centre: Position,
    /// Its standard deviation eastward, metres.
    pub east_width_m: f64,
    /// Its standard deviation northward, metres.
    pub north_width_m: f64,
    /// Expected number of targets of this blob inside the region.
    pub total: f64,
}

impl GaussianBlob {
    fn values(&self, grid: &SurveillanceGrid) -> Result<Vec<f64>, SonarError> {
        let positive = |x: f64| x.is_finite() && x > 0.0;
        checked("centre.east_m", self.centre.east_m, "a finite number", f64::is_finite)?;
        checked("centre.north_m", self.centre.north_m, "a finite number", f64::is_finite)?;
        checked("east_width_m", self.east_width_m, "a positive number", positive)?;
        checked("north_width_m", self.north_width_m, "a positive number", positive)?;
        checked("total", self.total, "a finite number of at least 0", |x| {
            x.is_finite() && x >= 0.0
        })?;
        let exponents: Vec<f64> = grid
            .cells()
            .map(|cell| {
                let point = grid.centre(cell);
                let east = (point.east_m - self.centre.east_m) / self.east_width_m;
                let north = (point.north_m - self.centre.north_m) / self.north_width_m;
                -0.5 * (east * east + north * north)
            })
            .collect();
        // Relative to the nearest cell, a centre far outside cannot underflow to 0 / 0.
        let largest = exponents.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let kernel = exponents.iter().map(|exponent| (exponent - largest).exp());
        let sum: f64 = kernel.clone().sum();
        Ok(kernel.map(|k| k * self.total / sum).collect())
    }
}

/// Centres of the cells in the square [0, 10] × [0, 10].
fn scaled_centres(grid: &SurveillanceGrid) -> impl Iterator<Item = (f64, f64)> {
    grid.cells().map(|cell| {
        let (column, row) = grid.column_row(cell);
        let x = 10.0 * (column as f64 + 0.5) / grid.columns as f64;
        let y = 10.0 * (row as f64 + 0.5) / grid.rows as f64;
        (x, y)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GRID: SurveillanceGrid =
        SurveillanceGrid { columns: 30, rows: 30, cell_width_m: 1030.0, cell_height_m: 1030.0 };

    #[test]
    fn the_papers_corridor_has_its_total_and_its_crest() {
        let prior = TargetPrior::line_corridor(&LineCorridor::default(), &GRID).unwrap();
        assert!((prior.total() - 38.0).abs() < 1e-12);
        // The chord runs from (1.5, 10) to (6.5, 0); its middle is (4, 5), on the
        // corner of cells (11, 14), (12, 14), (11, 15) and (12, 15).
        let value = |column: usize, row: usize| prior.values()[row * 30 + column];
        let largest = prior.values().iter().copied().fold(0.0, f64::max);
        assert!((value(11, 15) - largest).abs() < 1e-15);
        // Symmetric about the middle of the chord.
        assert!((value(10, 20) - value(13, 9)).abs() < 1e-12);
        // Across: √5/3 … between neighbours east–west, against the formula itself.
        let across = |x: f64, y: f64| ((y + 2.0 * x - 13.0) / 5.0_f64.sqrt() / 0.5).powi(2);
        let along = |x: f64, y: f64| {
            ((x - 4.0 - 2.0 * (y - 5.0)) / 5.0_f64.sqrt() / (0.25 * 125.0_f64.sqrt())).powi(2)
        };
        let exponent = |x: f64, y: f64| -0.5 * (across(x, y) + along(x, y));
        let (a, b) = ((11.5 / 3.0, 15.5 / 3.0), (14.5 / 3.0, 18.5 / 3.0));
        let ratio = (exponent(b.0, b.1) - exponent(a.0, a.1)).exp();
        assert!((value(14, 18) / value(11, 15) - ratio).abs() < 1e-12);
    }

    #[test]
    fn flat_and_steep_lines_are_corridors_too() {
        let flat = LineCorridor { slope: 0.0, intercept: 5.0, ..LineCorridor::default() };
        let prior = TargetPrior::line_corridor(&flat, &GRID).unwrap();
        assert!((prior.total() - 38.0).abs() < 1e-12);
        let steep = LineCorridor { slope: 1e6, intercept: -5e6, ..LineCorridor::default() };
        let turned = TargetPrior::line_corridor(&steep, &GRID).unwrap();
        for cell in GRID.cells() {
            let (column, row) = GRID.column_row(cell);
            let mirrored = turned.values()[column * 30 + row];
            assert!((prior.values()[cell.0] - mirrored).abs() < 1e-4);
        }
    }

    #[test]
    fn bad_corridors_are_refused() {
        let refused = |corridor| TargetPrior::line_corridor(&corridor, &GRID).unwrap_err();
        let paper = LineCorridor::default();
        assert_eq!(
            refused(LineCorridor { intercept: -3.0, ..paper }).to_string(),
            "the line y = -2 x + -3 does not cross the region [0, 10] × [0, 10]"
        );
        assert!(refused(LineCorridor { width: 0.0, ..paper }).to_string().contains("`width`"));
        assert!(refused(LineCorridor { total: f64::NAN, ..paper }).to_string().contains("`total`"));
    }

    #[test]
    fn blobs_add_up() {
        let blob = |east_m, total| GaussianBlob {
            centre: Position::new(east_m, 15_450.0),
            east_width_m: 2000.0,
            north_width_m: 3000.0,
            total,
        };
        let blobs = [blob(5000.0, 10.0), blob(-2e6, 3.0)];
        let prior = TargetPrior::gaussian_blobs(&blobs, &GRID).unwrap();
        assert!((prior.total() - 13.0).abs() < 1e-12);
        assert_eq!(TargetPrior::gaussian_blobs(&[], &GRID), Err(SonarError::EmptyPrior));
        let flat = GaussianBlob { north_width_m: 0.0, ..blobs[0] };
        assert!(TargetPrior::gaussian_blobs(&[flat], &GRID).is_err());
    }

    #[test]
    fn plain_values_are_checked() {
        assert!(TargetPrior::new(vec![0.0, 1.5]).is_ok(), "two targets can share a cell");
        assert_eq!(
            TargetPrior::new(vec![0.2, -0.1]).unwrap_err().to_string(),
            "`prior`: value 1 is -0.1, expected a finite number of at least 0"
        );
        assert_eq!(TargetPrior::new(vec![0.0; 4]), Err(SonarError::EmptyPrior));
    }
}
