//! Round numbers for axes, and numbers as text.

/// Round positions between `low` and `high`, about `count` of them.
pub(crate) fn ticks(low: f64, high: f64, count: usize) -> Vec<f64> {
    if !(low.is_finite() && high.is_finite() && low < high) {
        return Vec::new();
    }
    let step = round_step((high - low) / count.max(1) as f64);
    let slack = step * 1e-6;
    let first = ((low - slack) / step).ceil() as i64;
    let last = ((high + slack) / step).floor() as i64;
    (first..=last).map(|k| k as f64 * step).collect()
}

/// The smallest of 1, 2, 2.5, 5, 10 times a power of ten that is not below `step`.
pub(crate) fn round_step(step: f64) -> f64 {
    let power = 10_f64.powf(step.log10().floor());
    let mantissa = step / power;
    let round = [1.0, 2.0, 2.5, 5.0].into_iter().find(|&m| mantissa <= m * 1.000_001);
    round.unwrap_or(10.0) * power
}

/// Labels of ticks, all with the decimals that their step needs.
pub(crate) fn labels(ticks: &[f64]) -> Vec<String> {
    let step = ticks.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    let decimals = (0..6).find(|&d| {
        let scaled = step * 10_f64.powi(d);
        step.is_infinite() || (scaled - scaled.round()).abs() < 1e-6 * scaled.max(1.0)
    });
    let decimals = decimals.unwrap_or(6) as usize;
    ticks.iter().map(|&tick| number(tick, decimals)).collect()
}

/// A number with a true minus sign; a dash where there is none.
pub(crate) fn number(value: f64, decimals: usize) -> String {
    if !value.is_finite() {
        return "–".to_owned();
    }
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.to_owned(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// The smallest and largest finite value; none if there is none.
pub(crate) fn range(values: impl IntoIterator<Item = f64>) -> Option<(f64, f64)> {
    values.into_iter().filter(|value| value.is_finite()).fold(None, |range, value| match range {
        None => Some((value, value)),
        Some((low, high)) => Some((low.min(value), high.max(value))),
    })
}

/// A range widened to round numbers that `count` ticks divide; `fallback` where
/// there are no values, and a little room where there is only one.
pub(crate) fn round_range(
    range: Option<(f64, f64)>,
    count: usize,
    fallback: (f64, f64),
) -> (f64, f64) {
    let Some((low, high)) = range else { return fallback };
    let (low, high) = if high - low > 1e-9 * high.abs().max(1e-9) {
        (low, high)
    } else {
        (low - 0.5 * low.abs().max(1.0), high + 0.5 * high.abs().max(1.0))
    };
    let step = round_step((high - low) / count as f64);
    (((low / step) + 1e-6).floor() * step, ((high / step) - 1e-6).ceil() * step)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_inside() {
        assert_eq!(ticks(0.0, 30.9, 4), [0.0, 10.0, 20.0, 30.0]);
        assert_eq!(ticks(-0.5, 0.5, 2), [-0.5, 0.0, 0.5]);
        assert!(ticks(1.0, 1.0, 4).is_empty());
        assert!(ticks(f64::NAN, 1.0, 4).is_empty());
    }

    #[test]
    fn labels_carry_the_decimals_of_their_step() {
        assert_eq!(labels(&[0.0, 0.25, 0.5]), ["0.00", "0.25", "0.50"]);
        assert_eq!(labels(&[-10.0, 0.0, 10.0]), ["−10", "0", "10"]);
    }

    #[test]
    fn numbers_have_a_true_minus_and_no_negative_zero() {
        assert_eq!(number(-1.25, 1), "−1.2");
        assert_eq!(number(-0.01, 1), "0.0");
        assert_eq!(number(f64::INFINITY, 1), "–");
    }

    #[test]
    fn ranges_of_nothing_and_of_one_value_have_an_extent() {
        assert_eq!(round_range(range([f64::NAN]), 4, (0.0, 1.0)), (0.0, 1.0));
        let (low, high) = round_range(range([7.0]), 4, (0.0, 1.0));
        assert!(low < 7.0 && 7.0 < high);
    }
}
