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
