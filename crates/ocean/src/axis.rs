//! Finding a coordinate between the nodes of an axis.

/// How far beyond the first or last node, in degrees or metres, a coordinate still
/// counts as on the axis: files hold coordinates as `f32`, whose rounding at 360° is
/// 3·10⁻⁵.
pub(crate) const TOLERANCE: f64 = 1e-4;

/// The two nodes around a coordinate, and the weight of the upper one, in [0, 1].
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Bracket {
    pub(crate) lower: usize,
    pub(crate) upper: usize,
    pub(crate) upper_weight: f64,
}

impl Bracket {
    /// Both nodes with their weights.
    pub(crate) fn nodes(self) -> [(usize, f64); 2] {
        [(self.lower, 1.0 - self.upper_weight), (self.upper, self.upper_weight)]
    }
}

/// The nodes of an ascending axis around `value`; `None` beyond its ends.
pub(crate) fn locate(axis: &[f64], value: f64) -> Option<Bracket> {
    let (&first, &last) = (axis.first()?, axis.last()?);
    if !(value >= first - TOLERANCE && value <= last + TOLERANCE) {
        return None;
    }
    Some(clamped(axis, value))
}

/// The nodes of an ascending, non-empty axis around `value`, or its first or last node
/// beyond its ends.
pub(crate) fn clamped(axis: &[f64], value: f64) -> Bracket {
    let upper = axis.partition_point(|&node| node <= value).min(axis.len() - 1);
    let lower = upper.saturating_sub(1);
    if upper == lower {
        return Bracket { lower, upper, upper_weight: 0.0 };
    }
    let weight = (value - axis[lower]) / (axis[upper] - axis[lower]);
    Bracket { lower, upper, upper_weight: weight.clamp(0.0, 1.0) }
}

/// The nodes of an ascending axis of longitudes around `longitude_deg`, whatever
/// multiple of 360° either is counted from. Between the last and the first node of an
/// axis that goes round the globe the last interval is closed.
pub(crate) fn locate_longitude(axis: &[f64], longitude_deg: f64) -> Option<Bracket> {
    let (&first, &last) = (axis.first()?, axis.last()?);
    let from = first - TOLERANCE;
    let value = from + (longitude_deg - from).rem_euclid(360.0);
    if let Some(bracket) = locate(axis, value) {
        return Some(bracket);
    }
    let gap = first + 360.0 - last;
    let spacing = (last - first) / (axis.len() - 1).max(1) as f64;
    if value.is_finite() && gap > 0.0 && gap < 1.5 * spacing {
        let upper_weight = ((value - last) / gap).clamp(0.0, 1.0);
        return Some(Bracket { lower: axis.len() - 1, upper: 0, upper_weight });
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value_at(axis: &[f64], values: &[f64], bracket: Bracket) -> f64 {
        assert_eq!(axis.len(), values.len());
        bracket.nodes().iter().map(|&(node, weight)| weight * values[node]).sum()
    }

    #[test]
    fn linear_functions_come_back_exactly() {
        let axis = [0.0, 1.0, 3.0, 10.0];
        for value in [0.0, 0.5, 1.0, 2.9, 3.0, 9.0, 10.0] {
            let bracket = locate(&axis, value).unwrap();
            assert!((value_at(&axis, &axis, bracket) - value).abs() < 1e-12);
        }
        assert_eq!(locate(&axis, 10.1), None);
        assert_eq!(locate(&axis, -0.1), None);
        assert_eq!(locate(&axis, f64::NAN), None);
        assert_eq!(locate(&[], 1.0), None);
    }

    #[test]
    fn a_single_node_is_found_only_where_it_is() {
        assert_eq!(locate(&[5.0], 5.0).unwrap().nodes(), [(0, 1.0), (0, 0.0)]);
        assert_eq!(locate(&[5.0], 5.1), None);
    }

    #[test]
    fn longitudes_wrap() {
        let pacific = [170.0, 180.0, 190.0];
        let bracket = locate_longitude(&pacific, -175.0).unwrap();
        assert!((value_at(&pacific, &pacific, bracket) - 185.0).abs() < 1e-12);
        assert_eq!(locate_longitude(&pacific, 0.0), None);

        let globe: Vec<f64> = (0..36).map(|i| f64::from(i) * 10.0).collect();
        let bracket = locate_longitude(&globe, -2.5).unwrap();
        assert_eq!((bracket.lower, bracket.upper), (35, 0));
        assert!((bracket.upper_weight - 0.75).abs() < 1e-12);
    }
}
