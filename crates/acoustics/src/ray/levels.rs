use crate::environment::{Profile, ProfileLaw, SoundSpeedField};

/// A level of a medium: its depth, and where it lies between two levels of the
/// section's profile.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Level {
    pub depth: f64,
    pub above: usize,
    pub fraction: f64,
}

impl Level {
    /// Half-way to the next level.
    pub(super) fn halfway(self, next: Self) -> Self {
        let (above, start) =
            if next.above == self.above { (self.above, self.fraction) } else { (next.above, 0.0) };
        let fraction = f64::midpoint(start, next.fraction);
        Self { depth: f64::midpoint(self.depth, next.depth), above, fraction }
    }
}

/// More layers between two levels than any profile needs.
const MOST_PARTS: usize = 4096;

/// The levels of a field down to a depth, and what divides layers in which linear
/// 1/c² would depart from the field's law by more than a tolerance in m/s.
pub(super) fn levels(field: &SoundSpeedField, tolerance: f64, deepest_m: f64) -> Vec<Level> {
    let depth = field.depth_m();
    let mut levels = vec![Level { depth: depth[0], above: 0, fraction: 0.0 }];
    for above in 0..depth.len() - 1 {
        let (top, bottom) = (depth[above], depth[above + 1]);
        if above > 0 && top >= deepest_m {
            break;
        }
        let parts =
            field.columns().map(|profile| parts(field.law(), profile, above, tolerance)).max();
        let parts = parts.unwrap_or(1);
        for part in 1..=parts {
            let fraction = part as f64 / parts as f64;
            let depth = top + fraction * (bottom - top);
            if depth > deepest_m && deepest_m > top {
                let fraction = (deepest_m - top) / (bottom - top);
                let last = Level { depth: deepest_m, above, fraction };
                if last.depth > levels[levels.len() - 1].depth {
                    levels.push(last);
                }
                break;
            }
            levels.push(Level { depth, above, fraction });
        }
    }
    levels
}

/// 1/c² at levels at one range.
pub(super) fn squared_slowness(
    field: &SoundSpeedField,
    levels: &[Level],
    range_m: f64,
) -> Vec<f64> {
    let profile = field.profile_at(range_m);
    levels.iter().map(|level| profile.between_m_s(level.above, level.fraction).powi(-2)).collect()
}

/// Into how many layers the interval below a level must be cut.
fn parts(law: ProfileLaw, profile: Profile<'_>, above: usize, tolerance: f64) -> usize {
    match law {
        ProfileLaw::LinearSquaredIndex => 1,
        // The sagitta is 3(Δc)²/8c.
        ProfileLaw::LinearSpeed => {
            let (upper, lower) = (profile.speed_m_s(above), profile.speed_m_s(above + 1));
            let largest_step = (8.0 / 3.0 * tolerance * upper).sqrt();
            ((lower - upper).abs() / largest_step).ceil().max(1.0) as usize
        }
        ProfileLaw::CubicSpline | ProfileLaw::MonotoneCubic => {
            let mut parts = 1;
            while parts < MOST_PARTS && departure(profile, above, parts) > tolerance {
                parts *= 2;
            }
            parts
        }
    }
}

/// How far linear 1/c² in each of some equal parts departs from the profile in their
/// middles, m/s.
fn departure(profile: Profile<'_>, above: usize, parts: usize) -> f64 {
    let speed = |halves: usize| profile.between_m_s(above, halves as f64 / (2 * parts) as f64);
    (0..parts)
        .map(|part| {
            let (upper, lower) = (speed(2 * part).powi(-2), speed(2 * part + 2).powi(-2));
            (f64::midpoint(upper, lower).powf(-0.5) - speed(2 * part + 1)).abs()
        })
        .fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_follow_a_spline_and_end_at_the_depth_asked_for() {
        let depth: Vec<f64> = vec![0.0, 100.0, 400.0, 1000.0];
        let speed = vec![1530.0, 1525.0, 1490.0, 1500.0];
        let law = ProfileLaw::CubicSpline;
        let field = SoundSpeedField::new(vec![0.0], depth, speed, law).unwrap();
        let levels = levels(&field, 1e-3, 700.0);
        assert!((levels[levels.len() - 1].depth - 700.0).abs() < 1e-12);
        assert!(levels.windows(2).all(|pair| pair[1].depth > pair[0].depth));
        for pair in levels.windows(2) {
            let [c0, c1] = [pair[0], pair[1]].map(|level| field.speed_at_m_s(0.0, level.depth));
            let linear = f64::midpoint(c0.powi(-2), c1.powi(-2)).powf(-0.5);
            let exact = field.speed_at_m_s(0.0, f64::midpoint(pair[0].depth, pair[1].depth));
            assert!((linear - exact).abs() < 1.1e-3);
        }
    }
}
