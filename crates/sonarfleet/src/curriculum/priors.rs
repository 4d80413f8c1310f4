//! Where targets may be expected, by chance.

use super::chance::{between, direction_rad, happens, log_between, weighted};
use crate::grid::SurveillanceGrid;
use crate::random::Stream;
use rand::Rng;

/// Expected number of targets in the region, fewest and most.
const TOTAL: [f64; 2] = [20.0, 60.0];

/// A kernel in the square [0, 10] × [0, 10], as which the region is seen; x east, y north.
#[derive(Debug, Clone, Copy)]
enum Kernel {
    /// Gaussian along two axes: a corridor, or a blob.
    Ridge { middle: [f64; 2], along_rad: f64, length: f64, width: f64 },
    /// Gaussian across a circle.
    Ring { middle: [f64; 2], radius: f64, width: f64 },
}

#[derive(Debug, Clone, Copy)]
enum Kind {
    Corridor,
    Crossing,
    Blobs,
    Ring,
    Uniform,
    Mixed,
}

/// A prior, [row, column]: corridors, blobs, rings, uniform, and mixtures.
pub(super) fn prior(random: &mut Stream, grid: &SurveillanceGrid) -> Vec<f64> {
    let kind = weighted(
        random,
        &[
            (0.32, Kind::Corridor),
            (0.18, Kind::Crossing),
            (0.22, Kind::Blobs),
            (0.06, Kind::Ring),
            (0.04, Kind::Uniform),
            (0.18, Kind::Mixed),
        ],
    );
    let mut kernels = Vec::new();
    let mut add = |random: &mut Stream, kernel: fn(&mut Stream) -> Kernel, count: usize| {
        for _ in 0..count {
            kernels.push((between(random, 0.4, 1.0), kernel(random)));
        }
    };
    match kind {
        Kind::Corridor => add(random, corridor, 1),
        Kind::Crossing => add(random, corridor, 2),
        Kind::Blobs => {
            let count = random.random_range(1..=6);
            add(random, blob, count);
        }
        Kind::Ring => add(random, ring, 1),
        Kind::Uniform => {}
        Kind::Mixed => {
            add(random, corridor, 1);
            let count = random.random_range(1..=3);
            add(random, blob, count);
        }
    }
    let background = match kind {
        Kind::Uniform => 1.0,
        Kind::Mixed => between(random, 0.0, 0.15),
        _ if happens(random, 0.25) => between(random, 0.01, 0.15),
        _ => 0.0,
    };
    let values: Vec<f64> = grid
        .cells()
        .map(|cell| {
            let (column, row) = grid.column_row(cell);
            let x = 10.0 * (column as f64 + 0.5) / grid.columns as f64;
            let y = 10.0 * (row as f64 + 0.5) / grid.rows as f64;
            let kernels = kernels.iter().map(|(height, kernel)| height * kernel.at(x, y));
            background + kernels.sum::<f64>()
        })
        .collect();
    let total = if happens(random, 0.3) { 38.0 } else { between(random, TOTAL[0], TOTAL[1]) };
    let sum: f64 = values.iter().sum();
    values.into_iter().map(|value| value * total / sum).collect()
}

fn point(random: &mut Stream, margin: f64) -> [f64; 2] {
    [0, 1].map(|_| between(random, margin, 10.0 - margin))
}

/// The paper's corridor is 0.5 wide and about 2.8 long.
fn corridor(random: &mut Stream) -> Kernel {
    Kernel::Ridge {
        middle: point(random, 2.5),
        along_rad: direction_rad(random),
        length: log_between(random, 1.8, 8.0),
        width: log_between(random, 0.3, 1.2),
    }
}

fn blob(random: &mut Stream) -> Kernel {
    let width = log_between(random, 0.4, 1.8);
    Kernel::Ridge {
        middle: point(random, 1.0),
        along_rad: direction_rad(random),
        length: width * between(random, 1.0, 2.0),
        width,
    }
}

fn ring(random: &mut Stream) -> Kernel {
    Kernel::Ring {
        middle: point(random, 3.5),
        radius: between(random, 1.5, 4.0),
        width: between(random, 0.3, 0.8),
    }
}

impl Kernel {
    fn at(self, x: f64, y: f64) -> f64 {
        match self {
            Self::Ridge { middle, along_rad, length, width } => {
                let (dx, dy) = (x - middle[0], y - middle[1]);
                let (sine, cosine) = along_rad.sin_cos();
                let (along, across) = (dx * cosine + dy * sine, dy * cosine - dx * sine);
                (-0.5 * ((along / length).powi(2) + (across / width).powi(2))).exp()
            }
            Self::Ring { middle, radius, width } => {
                let off = (x - middle[0]).hypot(y - middle[1]) - radius;
                (-0.5 * (off / width).powi(2)).exp()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::stream;

    #[test]
    fn totals_are_in_range_and_priors_differ() {
        let grid =
            SurveillanceGrid { columns: 24, rows: 30, cell_width_m: 1.0, cell_height_m: 1.0 };
        let draw = |index| prior(&mut stream(6, "test/prior", index), &grid);
        let priors: Vec<Vec<f64>> = (0..200).map(draw).collect();
        for (index, values) in priors.iter().enumerate() {
            let total: f64 = values.iter().sum();
            assert!((TOTAL[0] - 1e-9..=TOTAL[1] + 1e-9).contains(&total), "{index}: {total}");
            assert!(values.iter().all(|&p| p >= 0.0));
        }
        // Uniform ones of the same total are alike.
        let again = (0..200).filter(|&index| priors[..index].contains(&priors[index])).count();
        assert!(again < 10, "{again} of 200 priors were drawn before");
        assert_eq!(priors[17], draw(17));
    }

    #[test]
    fn a_corridor_lies_along_its_line() {
        let ridge = Kernel::Ridge {
            middle: [4.0, 5.0],
            along_rad: std::f64::consts::FRAC_PI_4,
            length: 3.0,
            width: 0.5,
        };
        let step = std::f64::consts::FRAC_1_SQRT_2;
        assert!((ridge.at(4.0 + 3.0 * step, 5.0 + 3.0 * step) - (-0.5_f64).exp()).abs() < 1e-12);
        assert!((ridge.at(4.0 + 0.5 * step, 5.0 - 0.5 * step) - (-0.5_f64).exp()).abs() < 1e-12);
    }
}
