//! What is kept of a layout that the policy revises: some of its vehicles are taken off
//! and placed again, as in ruin and recreate (Schrimpf et al. 2000,
//! doi:10.1006/jcph.1999.6413), with the policy to recreate (Hottung & Tierney 2020,
//! arXiv:1911.09539). What was placed early is decided again with the rest in view.

use super::decoding::Sample;
use rand::Rng;
use rand::seq::SliceRandom;
use sonarfleet::grid::CellId;
use sonarfleet::random::Stream;

/// Layouts that revisions start from.
const PARENTS: usize = 4;

/// Share of the vehicles that is taken off, at least and at most.
const TAKEN: [f64; 2] = [0.1, 0.4];

/// The best of all layouts, no two alike.
pub(super) fn parents(samples: &[Sample]) -> Vec<&Sample> {
    let mut parents: Vec<&Sample> = samples.iter().collect();
    parents.sort_by(|a, b| b.evaluation.compare(&a.evaluation));
    parents.dedup_by(|a, b| a.evaluation == b.evaluation);
    parents.truncate(PARENTS);
    parents
}

/// The vehicles that stay: those taken off are neighbours as often as scattered ones.
pub(super) fn kept(layout: &[CellId], columns: usize, random: &mut Stream) -> Vec<CellId> {
    let share = random.random_range(TAKEN[0]..TAKEN[1]);
    let taken = ((layout.len() as f64 * share) as usize).max(1);
    let mut kept = layout.to_vec();
    if random.random() {
        let CellId(centre) = kept[random.random_range(0..kept.len())];
        kept.sort_by_key(|&CellId(cell)| {
            let dx = (cell % columns).abs_diff(centre % columns);
            let dy = (cell / columns).abs_diff(centre / columns);
            std::cmp::Reverse(dx * dx + dy * dy)
        });
    } else {
        kept.shuffle(random);
    }
    kept.truncate(layout.len() - taken);
    kept
}

#[cfg(test)]
mod tests {
    use super::*;
    use sonarfleet::placement::Evaluation;
    use sonarfleet::random::stream;

    #[test]
    fn the_best_layouts_are_revised_each_once() {
        let sample = |detection_utility: f64, feasible: bool| Sample {
            layout: Vec::new(),
            evaluation: Evaluation { detection_utility, algebraic_connectivity: 1.0, feasible },
            aim: 1.0,
        };
        let utilities = [3.0, 9.0, 5.0, 5.0, 4.0, 7.0, 1.0];
        let samples: Vec<Sample> =
            utilities.iter().map(|&utility| sample(utility, utility < 8.0)).collect();
        let chosen: Vec<f64> =
            parents(&samples).iter().map(|parent| parent.evaluation.detection_utility).collect();
        assert_eq!(chosen, [7.0, 5.0, 4.0, 3.0], "the best is infeasible");
    }

    #[test]
    fn a_tenth_to_two_fifths_are_taken_off_near_each_other_or_anywhere() {
        let layout: Vec<CellId> = (0..40).map(|k| CellId(k * 7)).collect();
        let mut counts = Vec::new();
        let mut compact = 0;
        for seed in 0..200 {
            let kept = kept(&layout, 30, &mut stream(seed, "test/revision", 0));
            assert!(kept.iter().all(|cell| layout.contains(cell)));
            let taken: Vec<CellId> =
                layout.iter().copied().filter(|cell| !kept.contains(cell)).collect();
            assert_eq!(kept.len() + taken.len(), layout.len());
            counts.push(taken.len());
            // Rows apart: neighbours lie within few.
            let rows = taken.iter().map(|cell| cell.0 / 30);
            compact += usize::from(rows.clone().max().unwrap() - rows.min().unwrap() <= 6);
        }
        assert!(counts.iter().all(|count| (4..16).contains(count)));
        assert!((60..160).contains(&compact), "{compact} of 200 compact");
        for size in 1..4 {
            let kept = kept(&layout[..size], 30, &mut stream(1, "test/revision", 0));
            assert_eq!(kept.len(), size - 1, "one at least is taken off");
        }
    }
}
