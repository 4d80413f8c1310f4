//! Slopes at the levels of a profile, from which cubics run between them.

/// Slopes of the twice continuously differentiable cubic spline through points at
/// ascending abscissae, whose first two pieces are one cubic, and its last two
/// (not-a-knot). Through three points it is a parabola, through two a line.
pub(super) fn spline_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secant: Vec<f64> =
        y.windows(2).zip(&h).map(|(pair, width)| (pair[1] - pair[0]) / width).collect();
    match last {
        1 => return vec![secant[0]; 2],
        2 => {
            let bend = (secant[1] - secant[0]) / (h[0] + h[1]);
            return vec![secant[0] - bend * h[0], secant[0] + bend * h[0], secant[1] + bend * h[1]];
        }
        _ => {}
    }
    // Rows of a tridiagonal system: lower, diagonal, upper, right-hand side.
    let mut rows = Vec::with_capacity(x.len());
    let end = |h0: f64, h1: f64, s0: f64, s1: f64| {
        ((h0 + 2.0 * (h0 + h1)) * h1 * s0 + h0 * h0 * s1) / (h0 + h1)
    };
    rows.push([0.0, h[1], h[0] + h[1], end(h[0], h[1], secant[0], secant[1])]);
    for i in 1..last {
        let right = 3.0 * (h[i] * secant[i - 1] + h[i - 1] * secant[i]);
        rows.push([h[i], 2.0 * (h[i - 1] + h[i]), h[i - 1], right]);
    }
    let (h0, h1) = (h[last - 1], h[last - 2]);
    rows.push([h0 + h1, h1, 0.0, end(h0, h1, secant[last - 1], secant[last - 2])]);

    for i in 1..=last {
        let factor = rows[i][0] / rows[i - 1][1];
        rows[i][1] -= factor * rows[i - 1][2];
        rows[i][3] -= factor * rows[i - 1][3];
    }
    let mut slopes = vec![rows[last][3] / rows[last][1]; x.len()];
    for i in (0..last).rev() {
        slopes[i] = (rows[i][3] - rows[i][2] * slopes[i + 1]) / rows[i][1];
    }
    slopes
}

/// Slopes of the piecewise cubic that is monotone wherever the points are: Fritsch &
/// Butland's weighted harmonic means of the neighbouring secants (1984,
/// doi:10.1137/0905021), and three-point slopes at the ends, limited likewise.
pub(super) fn monotone_slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let h: Vec<f64> = x.windows(2).map(|pair| pair[1] - pair[0]).collect();
    let secant: Vec<f64> =
        y.windows(2).zip(&h).map(|(pair, width)| (pair[1] - pair[0]) / width).collect();
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
    let inner = (1..last).map(|i| {
        let (s0, s1) = (secant[i - 1], secant[i]);
        if s0 * s1 <= 0.0 {
            return 0.0;
        }
        let (w0, w1) = (2.0 * h[i] + h[i - 1], h[i] + 2.0 * h[i - 1]);
        (w0 + w1) / (w0 / s0 + w1 / s1)
    });
    let mut slopes = vec![end(h[0], h[1], secant[0], secant[1])];
    slopes.extend(inner);
    slopes.push(end(h[last - 1], h[last - 2], secant[last - 1], secant[last - 2]));
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

    #[test]
    fn the_monotone_cubic_is_level_where_points_turn() {
        let slopes = monotone_slopes(&[0.0, 1.0, 2.0, 4.0], &[0.0, 1.0, 0.5, 0.4]);
        assert!(slopes[1].abs() < 1e-15);
        assert!(slopes[0] > 0.0 && slopes[2] < 0.0 && slopes[3] <= 0.0);
    }
}
