//! Slopes at the levels of a profile, from which cubics run between them.

/// Slopes of the twice continuously differentiable cubic spline through points at
/// ascending abscissae, whose first two pieces are one cubic, and its last two
/// (not-a-knot). Through three points it is a parabola, through two a line.
pub(super) fn spline_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let (h, secant) = pieces(x, y);
    let last = h.len();
    if last == 1 {
        return vec![secant[0]; 2];
    }
    if last == 2 {
        let bend = (secant[1] - secant[0]) / (h[0] + h[1]);
        let inner = secant[0] + bend * h[0];
        return vec![secant[0] - bend * h[0], inner, secant[1] + bend * h[1]];
    }
    let end = |h0: f64, h1: f64, s0: f64, s1: f64| {
        let right = ((h0 + 2.0 * (h0 + h1)) * h1 * s0 + h0 * h0 * s1) / (h0 + h1);
        (h1, h0 + h1, right)
    };
    let (diagonal, upper, right) = end(h[0], h[1], secant[0], secant[1]);
    let first = [0.0, diagonal, upper, right];
    let (diagonal, lower, right) =
        end(h[last - 1], h[last - 2], secant[last - 1], secant[last - 2]);
    spline(&h, &secant, first, [lower, diagonal, 0.0, right])
}

/// Slopes of a piecewise cubic that is monotone wherever the points are: those of the
/// spline with the three-point slopes at its ends, brought into the region in which a
/// cubic cannot overshoot (Fritsch & Carlson 1980, doi:10.1137/0717021): nil where the
/// points turn, and at most three times the secants on both sides.
pub(super) fn monotone_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let (h, secant) = pieces(x, y);
    let last = h.len();
    if last == 1 {
        return vec![secant[0]; 2];
    }
    let end = |h0: f64, h1: f64, s0: f64, s1: f64| {
        let slope = ((2.0 * h0 + h1) * s0 - h0 * s1) / (h0 + h1);
        if slope * s0 <= 0.0 {
            0.0
        } else if s0 * s1 <= 0.0 && slope.abs() > 3.0 * s0.abs() {
            3.0 * s0
        } else {
            slope
        }
    };
    let first = end(h[0], h[1], secant[0], secant[1]);
    let final_slope = end(h[last - 1], h[last - 2], secant[last - 1], secant[last - 2]);
    let mut slopes = spline(&h, &secant, [0.0, 1.0, 0.0, first], [0.0, 1.0, 0.0, final_slope]);
    for (slope, sides) in slopes[1..].iter_mut().zip(secant.windows(2)) {
        let most = 3.0 * sides[0].abs().min(sides[1].abs());
        let turns = sides[0] * sides[1] <= 0.0 || *slope * sides[0] <= 0.0;
        *slope = if turns { 0.0 } else { slope.clamp(-most, most) };
    }
    slopes
}

/// Widths of the pieces between points, and the slopes of their secants.
fn pieces(x: &[f64], y: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let widths: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secants =
        y.windows(2).zip(&widths).map(|(pair, width)| (pair[1] - pair[0]) / width).collect();
    (widths, secants)
}

/// Slopes of a spline from the equations of its ends: lower, diagonal and upper
/// coefficient, and right-hand side. Second derivatives are equal on both sides of the
/// points between.
fn spline(h: &[f64], secant: &[f64], first: [f64; 4], last: [f64; 4]) -> Vec<f64> {
    let mut rows = vec![first];
    for i in 1..h.len() {
        let right = 3.0 * (h[i] * secant[i - 1] + h[i - 1] * secant[i]);
        rows.push([h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1], right]);
    }
    rows.push(last);
    for i in 1..rows.len() {
        let factor = rows[i][0] / rows[i - 1][1];
        rows[i][1] -= factor * rows[i - 1][2];
        rows[i][3] -= factor * rows[i - 1][3];
    }
    let mut below = 0.0;
    let mut slopes: Vec<f64> = rows
        .iter()
        .rev()
        .map(|row| {
            below = (row[3] - row[2] * below) / row[1];
            below
        })
        .collect();
    slopes.reverse();
    slopes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_spline_reproduces_cubics() {
        let x = [0.0, 1.0, 2.5, 3.0, 5.0];
        let cubic = |t: f64| 2.0 - t + 0.5 * t * t - 0.1 * t * t * t;
        let slopes = spline_slopes(&x, &x.map(cubic));
        for (t, slope) in x.iter().zip(slopes) {
            assert!((slope - (-1.0 + t - 0.3 * t * t)).abs() < 1e-12, "{t}: {slope}");
        }
        let parabola = |t: f64| 1.0 + 3.0 * t - t * t;
        let slopes = spline_slopes(&x[..3], &[parabola(0.0), parabola(1.0), parabola(2.5)]);
        for (slope, exact) in slopes.iter().zip([3.0, 1.0, -2.0]) {
            assert!((slope - exact).abs() < 1e-12);
        }
    }

    /// The slopes that BELLHOP's rays show at the levels of a profile (option P), from
    /// differences along them.
    #[test]
    fn monotone_slopes_are_bellhops() {
        let depth = [0.0, 100.0, 250.0, 400.0, 700.0, 900.0, 1300.0, 1700.0, 2000.0];
        let speed = [1530.0, 1522.0, 1508.0, 1500.0, 1490.0, 1495.0, 1496.0, 1503.0, 1512.0];
        let bellhop = [
            -0.074_667, -0.090_387, -0.076_066, -0.045_350, 0.0, 0.0075, 0.002_293, 0.026_371,
            0.035_357,
        ];
        for (slope, bellhop) in monotone_slopes(&depth, &speed).iter().zip(bellhop) {
            assert!((slope - bellhop).abs() < 2e-6, "{slope} {bellhop}");
        }
    }

    #[test]
    fn the_monotone_cubic_is_level_where_points_turn() {
        let slopes = monotone_slopes(&[0.0, 1.0, 2.0, 4.0], &[0.0, 1.0, 0.5, 0.4]);
        assert!(slopes[1].abs() < 1e-15);
        assert!(slopes[0] > 0.0 && slopes[2] < 0.0 && slopes[3] <= 0.0);
    }
}
