//! Contour lines of gridded values (marching squares), for drawing only.

/// Line segments where a field on a regular grid of points crosses `level`.
///
/// `value(column, row)` gives the field; squares with a value that is not finite
/// have no contour. Points are returned in columns and rows, with fractions.
pub(crate) fn contour(
    columns: usize,
    rows: usize,
    value: impl Fn(usize, usize) -> f64,
    level: f64,
) -> Vec<[[f64; 2]; 2]> {
    let mut segments = Vec::new();
    for row in 0..rows.saturating_sub(1) {
        for column in 0..columns.saturating_sub(1) {
            // Counter-clockwise from the south-west corner.
            let corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
            let values = corners.map(|[dx, dy]| value(column + dx, row + dy) - level);
            if values.iter().any(|v| !v.is_finite()) {
                continue;
            }
            let mut crossings = Vec::with_capacity(4);
            for edge in 0..4 {
                let next = (edge + 1) % 4;
                let (from, to) = (values[edge], values[next]);
                if (from < 0.0) != (to < 0.0) {
                    let fraction = from / (from - to);
                    let point = |axis: usize| {
                        let (a, b) = (corners[edge][axis] as f64, corners[next][axis] as f64);
                        a + fraction * (b - a)
                    };
                    crossings.push([column as f64 + point(0), row as f64 + point(1)]);
                }
            }
            if crossings.len() == 4 {
                // A saddle: the mean decides which corners belong together.
                let joined_with_first = (values.iter().sum::<f64>() < 0.0) == (values[0] < 0.0);
                if !joined_with_first {
                    crossings.rotate_right(1);
                }
            }
            segments.extend(crossings.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
        }
    }
    segments
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_is_cut_along_a_straight_line() {
        let segments = contour(4, 3, |column, _| column as f64, 1.5);
        assert_eq!(segments.len(), 2);
        assert!(segments.iter().flatten().all(|point| (point[0] - 1.5).abs() < 1e-12));
    }

    #[test]
    fn a_saddle_has_two_lines_that_do_not_cross() {
        let corners = [[1.0, -1.0], [-1.0, 2.0]];
        let segments = contour(2, 2, |column, row| corners[row][column], 0.0);
        assert_eq!(segments.len(), 2);
        // The mean is above the level, so the corners above it are joined and
        // each line cuts off one of the other two.
        for segment in segments {
            let mean = [0, 1].map(|axis| f64::midpoint(segment[0][axis], segment[1][axis]));
            assert!((mean[0] - mean[1]).abs() > 0.5, "{mean:?}");
        }
    }

    #[test]
    fn missing_values_have_no_contour() {
        assert!(contour(3, 3, |_, _| f64::NAN, 0.0).is_empty());
        assert!(contour(0, 0, |_, _| 0.0, 0.0).is_empty());
    }
}
