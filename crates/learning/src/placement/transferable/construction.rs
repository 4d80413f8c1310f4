//! A layout while it is built, and what the policy observes of it.

use super::landscape::Landscape;
use super::observation::{CANDIDATES, FEATURES, Observation};
use super::spectrum::Spectrum;
use sonarfleet::grid::CellId;

/// Candidates taken by their gain; the others by what they do for the network.
const BY_GAIN: usize = 96;

/// What a candidate by gain needs in links to those placed, added up.
const LINKED: f32 = 0.25;

/// Weight of λ₃ beside λ₂ among candidates by connectivity.
const THIRD_WEIGHT: f32 = 0.3;

/// What is newly found at a target, relative to the largest prior, for the gains around
/// to be brought up to date.
const UNNOTICED: f32 = 1e-4;

/// Stations fewer than this have no two eigenvectors to look for.
const FEW: usize = 4;

/// Features are kept within this.
const LIMIT: f32 = 4.0;

/// A layout while it is built: fixed sensors first, then vehicle after vehicle.
///
/// - **State**: what the placed stations miss of the prior, marginal gains, links to
///   those placed, and the lowest eigenpairs of their network.
/// - **Action**: a free deployable cell, out of up to [`CANDIDATES`] candidates.
/// - **Mask**: cells that are taken, blocked, or no candidates.
/// - **End**: when all vehicles are placed.
#[derive(Debug, Clone)]
pub(super) struct Construction<'l> {
    landscape: &'l Landscape<'l>,
    /// τ′: the connectivity that the policy is to build for.
    threshold: f64,
    residual: Vec<f32>,
    gains: Vec<f32>,
    /// Links to those placed, [cell].
    degrees: Vec<f32>,
    free: Vec<bool>,
    placed: Vec<u32>,
    /// Stations in the 3 × 3 and 5 × 5 cells around one, [cell].
    around: Vec<[u8; 2]>,
    station_degrees: Vec<f64>,
    /// [station, station]
    weights: Vec<f64>,
    spectrum: Spectrum,
    utility: f32,
    sums: LinkSums,
}

/// Over the links w of every cell to those placed, with the eigenvectors v and u.
#[derive(Debug, Clone, Default)]
struct LinkSums {
    /// Σ w·v, Σ w·v², Σ w·u, Σ w·u², Σ w/(1 + degree), [cell].
    values: Vec<[f32; 5]>,
    /// Estimates of λ₂ and λ₃ with one more vehicle in the cell.
    raised: Vec<[f32; 2]>,
    /// |v̂| and |û|: where the vehicle would sit on the eigenvectors.
    positions: Vec<[f32; 2]>,
}

impl<'l> Construction<'l> {
    /// An empty layout, to be built for a connectivity τ′.
    pub(super) fn new(landscape: &'l Landscape<'l>, threshold: f64) -> Self {
        let cells = landscape.columns * landscape.rows;
        let mut free = vec![false; cells];
        for &cell in &landscape.deployable {
            free[cell as usize] = true;
        }
        let sums = LinkSums {
            values: vec![[0.0; 5]; cells],
            raised: vec![[0.0; 2]; cells],
            positions: vec![[0.0; 2]; cells],
        };
        let mut construction = Self {
            landscape,
            threshold,
            residual: landscape.residual.clone(),
            gains: landscape.first_gains.clone(),
            degrees: vec![0.0; cells],
            free,
            placed: Vec::with_capacity(landscape.stations()),
            around: vec![[0; 2]; cells],
            station_degrees: Vec::with_capacity(landscape.stations()),
            weights: Vec::new(),
            spectrum: Spectrum::default(),
            utility: 0.0,
            sums,
        };
        for &CellId(cell) in landscape.problem.fixed_sensors() {
            construction.connect(cell as u32);
        }
        construction
    }

    /// A layout with some of its vehicles placed. The same as to place one after the
    /// other, but for the rounding and for where the eigenvectors come from.
    pub(super) fn begun(landscape: &'l Landscape<'l>, threshold: f64, cells: &[CellId]) -> Self {
        let mut construction = Self::new(landscape, threshold);
        if construction.placed.len() + cells.len() < FEW {
            for &CellId(cell) in cells {
                construction.place(cell as u32);
            }
            return construction;
        }
        for &CellId(cell) in cells {
            construction.free[cell] = false;
            for &(target, p_d) in landscape.hears.row(cell) {
                construction.residual[target as usize] *= 1.0 - p_d;
            }
            construction.link(cell as u32);
        }
        for target in 0..landscape.residual.len() {
            let found = landscape.residual[target] - construction.residual[target];
            construction.take(target, found);
        }
        construction.spectrum.find(&construction.weights, &construction.station_degrees);
        construction
    }

    /// The vehicles' cells, in the order of their placement.
    pub(super) fn layout(&self) -> Vec<CellId> {
        let fixed = self.landscape.problem.fixed_sensors().len();
        self.placed[fixed..].iter().map(|&cell| CellId(cell as usize)).collect()
    }

    /// Whether all vehicles are placed.
    pub(super) fn is_complete(&self) -> bool {
        self.placed.len() == self.landscape.stations()
    }

    /// Places a vehicle.
    pub(super) fn place(&mut self, cell: u32) {
        debug_assert!(self.free[cell as usize], "one vehicle per cell");
        self.free[cell as usize] = false;
        for &(target, p_d) in self.landscape.hears.row(cell as usize) {
            let found = self.residual[target as usize] * p_d;
            self.residual[target as usize] -= found;
            self.take(target as usize, found);
        }
        self.connect(cell);
    }

    /// What is newly found at a target can no longer be gained.
    fn take(&mut self, target: usize, found: f32) {
        self.utility += found;
        if found < UNNOTICED * self.landscape.largest_prior {
            return;
        }
        for &(sonar, p_d) in self.landscape.heard.row(target) {
            self.gains[sonar as usize] -= found * p_d;
        }
    }

    /// Makes a station part of the network.
    fn connect(&mut self, cell: u32) {
        self.link(cell);
        self.spectrum.follow(&self.weights, &self.station_degrees);
    }

    fn link(&mut self, cell: u32) {
        let n = self.placed.len();
        let mut weights = vec![0.0; (n + 1) * (n + 1)];
        for (i, row) in self.weights.chunks_exact(n.max(1)).enumerate() {
            weights[i * (n + 1)..i * (n + 1) + n].copy_from_slice(row);
        }
        let mut degree = 0.0;
        for (i, &station) in self.placed.iter().enumerate() {
            let link = self.landscape.problem.link(CellId(cell as usize), CellId(station as usize));
            weights[i * (n + 1) + n] = link;
            weights[n * (n + 1) + i] = link;
            self.station_degrees[i] += link;
            degree += link;
        }
        self.weights = weights;
        self.placed.push(cell);
        self.surround(cell);
        self.station_degrees.push(degree);
        for &(to, link) in self.landscape.links.row(cell as usize) {
            self.degrees[to as usize] += link;
        }
    }

    /// What the policy sees. A cell that is no candidate cannot be chosen.
    pub(super) fn observe(&mut self, observation: &mut Observation) {
        self.sum_links();
        self.estimate();
        let best_gain = self.best_gain();
        self.choose(&mut observation.cells);
        self.describe(best_gain, observation);
    }

    fn best_gain(&self) -> f32 {
        let free = self.landscape.deployable.iter().filter(|&&cell| self.free[cell as usize]);
        free.map(|&cell| self.gains[cell as usize]).fold(0.0, f32::max)
    }

    fn sum_links(&mut self) {
        self.sums.values.fill([0.0; 5]);
        let [second, third] = &self.spectrum.vectors;
        for (i, &station) in self.placed.iter().enumerate() {
            let (v, u) = (second[i] as f32, third[i] as f32);
            let help = 1.0 / (1.0 + self.station_degrees[i] as f32);
            let terms = [v, v * v, u, u * u, help];
            for &(cell, link) in self.landscape.links.row(station as usize) {
                for (sum, term) in self.sums.values[cell as usize].iter_mut().zip(terms) {
                    *sum += link * term;
                }
            }
        }
    }

    /// Second-order estimates of λ₂ and λ₃ with one more vehicle: the Rayleigh quotient
    /// of the old vector with its best value v̂ = Σwv/Σw at the new one.
    fn estimate(&mut self) {
        let k = self.placed.len();
        let root = (k as f32).sqrt();
        let shrink = 1.0 - 1.0 / (k as f32 + 1.0);
        let values = self.spectrum.values.map(|value| value as f32);
        for &cell in &self.landscape.deployable {
            let cell = cell as usize;
            let degree = self.degrees[cell];
            let (raised, positions) = (&mut self.sums.raised[cell], &mut self.sums.positions[cell]);
            if k < 2 || degree <= 0.0 {
                *raised = [2.0 * degree; 2];
                *positions = [0.0; 2];
                if k >= 2 {
                    *raised = [0.0; 2];
                }
                continue;
            }
            for which in 0..2 {
                let first = self.sums.values[cell][2 * which];
                let second = self.sums.values[cell][2 * which + 1];
                let place = first / degree;
                let numerator = values[which] + second - first * place;
                raised[which] = numerator / (1.0 + place * place * shrink);
                positions[which] = place.abs() * root;
            }
        }
    }

    /// What a vehicle in a cell would do for the network.
    fn network_gain(&self, cell: usize) -> f32 {
        let [second, third] = self.sums.raised[cell];
        let values = self.spectrum.values;
        let trust = self.degrees[cell].min(1.0);
        trust * ((second - values[0] as f32) + THIRD_WEIGHT * (third - values[1] as f32))
    }

    /// Up to [`CANDIDATES`] free cells: the best by gain among those with links, then
    /// the best by connectivity among the others.
    fn choose(&self, candidates: &mut Vec<u32>) {
        let anywhere = self.placed.is_empty();
        let is_free = |&cell: &u32| self.free[cell as usize];
        let free = || self.landscape.deployable.iter().copied().filter(is_free);
        let linked = |&cell: &u32| anywhere || self.degrees[cell as usize] > LINKED;
        let gain = |cell: u32| self.gains[cell as usize];
        candidates.clear();
        candidates.extend(free().filter(linked));
        if candidates.is_empty() {
            candidates.extend(free());
        }
        keep_largest(candidates, if anywhere { CANDIDATES } else { BY_GAIN }, gain);
        candidates.sort_unstable();
        if !anywhere {
            let mut chosen = candidates.iter().peekable();
            let mut others: Vec<u32> =
                free().filter(|cell| chosen.next_if_eq(&cell).is_none()).collect();
            let left = (CANDIDATES - candidates.len()).min(CANDIDATES - BY_GAIN);
            keep_largest(&mut others, left, |cell| self.network_gain(cell as usize));
            candidates.append(&mut others);
            candidates.sort_unstable();
        }
    }

    /// Fills in the features: none depends on the grid's size or orientation.
    fn describe(&self, best_gain: f32, observation: &mut Observation) {
        let landscape = self.landscape;
        let k = self.placed.len() as f32;
        let n = landscape.stations() as f32;
        let threshold = self.threshold as f32;
        let per_gain = reciprocal(best_gain);
        let per_first = reciprocal(landscape.best_first_gain);
        let [second, third] = self.spectrum.values.map(|value| value as f32);
        let smallest = self.station_degrees.iter().copied().fold(f64::INFINITY, f64::min) as f32;
        let whole = n * reciprocal(k * threshold);
        let expected: f32 = landscape.residual.iter().sum();
        let shared = [
            k / n,
            second / threshold,
            second * whole,
            third * whole,
            self.utility * reciprocal(expected),
            best_gain * per_first,
            if k > 0.0 { smallest / threshold } else { 0.0 },
            (n / 40.0).ln(),
            n * landscape.best_first_gain * reciprocal(expected) / 4.0,
            landscape.best_reach.ln_1p() / 2.0,
        ];
        let centre = self.centre();
        for (lane, &cell) in observation.cells.iter().enumerate() {
            let at = cell as usize;
            let (gain, first_gain) = (self.gains[at], landscape.first_gains[at]);
            let degree = self.degrees[at];
            let per_step = n / ((k + 1.0) * threshold);
            let [raised, raised_third] = self.sums.raised[at];
            let [position, position_third] = self.sums.positions[at];
            let (near_mean, near_sum) = self.gains_nearby(at);
            let [around, around_wide] = self.around[at].map(f32::from);
            let (distance, relative) = centre.distance(cell, landscape.columns, n);
            let own = [
                gain * per_gain,
                gain * per_first,
                first_gain * per_first,
                gain * reciprocal(first_gain),
                degree.ln_1p(),
                (-degree).exp(),
                raised / threshold,
                raised * per_step,
                (-raised * per_step).min(0.0).exp(),
                k * (raised - second) / threshold,
                raised_third / threshold,
                raised_third * per_step,
                (-raised_third * per_step).min(0.0).exp(),
                k * (raised_third - third) / threshold,
                position,
                position_third,
                self.sums.values[at][4],
                distance,
                relative,
                near_mean * per_gain,
                (near_sum * per_gain).max(0.0).ln_1p() / 3.0,
                landscape.potential[at],
                landscape.reach[at],
                around / 8.0,
                around_wide / 24.0,
                self.residual[at] / landscape.largest_prior,
            ];
            for (row, value) in observation.features.iter_mut().zip(own.iter().chain(&shared)) {
                row[lane] = bounded(*value);
            }
        }
        let count = observation.cells.len();
        for row in observation.features.iter_mut() {
            row[count..].fill(0.0);
        }
        const { assert!(FEATURES == 36) };
    }

    /// Mean and sum of the gains of free cells, weighed by their links to a cell.
    fn gains_nearby(&self, cell: usize) -> (f32, f32) {
        let (mut sum, mut weight) = (0.0, 0.0);
        for &(to, link) in self.landscape.links.row(cell) {
            // Without a branch: which of them are free is hard to foretell.
            let link = if self.free[to as usize] { link } else { 0.0 };
            sum += link * self.gains[to as usize];
            weight += link;
        }
        (sum * reciprocal(weight), sum)
    }

    /// Counts a station for the cells around it.
    fn surround(&mut self, cell: u32) {
        let (columns, rows) = (self.landscape.columns, self.landscape.rows);
        let (column, row) = (cell as usize % columns, cell as usize / columns);
        for y in row.saturating_sub(2)..rows.min(row + 3) {
            for x in column.saturating_sub(2)..columns.min(column + 3) {
                let [near, wide] = &mut self.around[y * columns + x];
                *near += u8::from(x.abs_diff(column) < 2 && y.abs_diff(row) < 2);
                *wide += 1;
            }
        }
    }

    /// Middle and spread of those placed, in cells.
    fn centre(&self) -> Centre {
        let columns = self.landscape.columns;
        let k = self.placed.len().max(1) as f32;
        let point =
            |&cell: &u32| ((cell as usize % columns) as f32, (cell as usize / columns) as f32);
        let (mut x, mut y) = (0.0, 0.0);
        for (column, row) in self.placed.iter().map(point) {
            x += column / k;
            y += row / k;
        }
        let squares: f32 =
            self.placed.iter().map(point).map(|(cx, cy)| (cx - x).powi(2) + (cy - y).powi(2)).sum();
        Centre { x, y, spread: (squares / k).sqrt(), alone: self.placed.is_empty() }
    }
}

struct Centre {
    x: f32,
    y: f32,
    spread: f32,
    alone: bool,
}

impl Centre {
    /// Distance of a cell in units of √n cells, and of the spread.
    fn distance(&self, cell: u32, columns: usize, n: f32) -> (f32, f32) {
        if self.alone {
            return (0.0, 0.0);
        }
        let column = (cell as usize % columns) as f32;
        let row = (cell as usize / columns) as f32;
        let cells = (column - self.x).hypot(row - self.y);
        (cells / n.sqrt(), cells / (1.0 + self.spread))
    }
}

/// Within the limits; what is not a number, 0 divided by 0, is 0.
fn bounded(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value.clamp(-LIMIT, LIMIT) }
}

/// 1/x, or 0 where there is nothing to divide by.
fn reciprocal(value: f32) -> f32 {
    if value > 1e-12 { 1.0 / value } else { 0.0 }
}

/// Keeps the cells with the largest values, ties to the lower index.
fn keep_largest(cells: &mut Vec<u32>, count: usize, value: impl Fn(u32) -> f32) {
    if cells.len() <= count {
        return;
    }
    // The order of `f32::total_cmp` as that of unsigned numbers, then the cell: integers
    // are much faster to select among.
    let key = |cell: u32| {
        let bits = value(cell).to_bits();
        let ordered = if bits >> 31 == 0 { bits | 1 << 31 } else { !bits };
        u64::from(!ordered) << 32 | u64::from(cell)
    };
    let mut keyed: Vec<u64> = cells.iter().map(|&cell| key(cell)).collect();
    if count > 0 {
        keyed.select_nth_unstable(count - 1);
    }
    cells.clear();
    cells.extend(keyed[..count].iter().map(|&key| key as u32));
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::Rng;
    use sonarfleet::grid::SurveillanceGrid;
    use sonarfleet::placement::{PlacementInput, PlacementProblem};
    use sonarfleet::random::stream;
    use sonarfleet::sonar::detection::{DetectionModel, FalseAlarmProbability, PassiveSonar};
    use sonarfleet::sonar::link::{LinkModel, Modem};
    use sonarfleet::sonar::noise::NoiseLevel;
    use sonarfleet::sonar::prior::TargetPrior;

    const SIDE: usize = 12;
    const CELLS: usize = SIDE * SIDE;

    /// Single precision, in another order.
    const ROUNDING: f32 = 2e-3;

    /// Probabilities that are left out of the sparse tables are smaller.
    const LEFT_OUT: f64 = 0.01;

    /// The feature that is 0 for cells without a link: which of those are candidates is
    /// arbitrary.
    const LINKS: usize = 4;

    /// The same problem, its grid mirrored at the diagonal if asked for.
    fn problem(mirrored: bool) -> PlacementProblem {
        let seen = |cell: usize| if mirrored { mirror(cell) } else { cell };
        let mut random = stream(11, "test/ocean", 0);
        let roughness: Vec<f64> = (0..CELLS * CELLS).map(|_| random.random()).collect();
        let prior: Vec<f64> = (0..CELLS).map(|_| random.random()).collect();
        let loss = |p: usize, q: usize| {
            let apart = |a: usize, b: usize| (a as f64 - b as f64).powi(2);
            let cells = (apart(p % SIDE, q % SIDE) + apart(p / SIDE, q / SIDE)).sqrt();
            (55.0 + 5.0 * cells + 3.0 * roughness[p * CELLS + q]) as f32
        };
        let losses_db =
            (0..CELLS * CELLS).map(|k| loss(seen(k / CELLS), seen(k % CELLS))).collect();
        PlacementProblem::new(&PlacementInput {
            grid: SurveillanceGrid {
                columns: SIDE,
                rows: SIDE,
                cell_width_m: 1000.0,
                cell_height_m: 1000.0,
            },
            prior: TargetPrior::new((0..CELLS).map(|cell| prior[seen(cell)]).collect()).unwrap(),
            detection_loss_db: losses_db,
            communication_loss_db: None,
            sonar: PassiveSonar {
                source_level_db: 130.0,
                noise_level_db: NoiseLevel::Uniform(65.0),
                directivity_index_db: 0.0,
                detection_threshold_db: 0.0,
                model: DetectionModel::MeanShift(FalseAlarmProbability::new(1e-3).unwrap()),
            },
            modem: Modem {
                source_level_db: 138.0,
                noise_level_db: NoiseLevel::Uniform(65.0),
                model: LinkModel::CoherentBpsk { packet_bits: 256 },
            },
            vehicles: 10,
            connectivity_threshold: 0.9,
            deployable: None,
            fixed_sensors: vec![CellId(seen(40))],
        })
        .unwrap()
    }

    fn mirror(cell: usize) -> usize {
        (cell % SIDE) * SIDE + cell / SIDE
    }

    /// Columns of features by cell, after each vehicle of a layout.
    fn observed(mirrored: bool, layout: &[usize]) -> Vec<Vec<(usize, Vec<f32>)>> {
        let problem = problem(mirrored);
        let landscape = Landscape::new(&problem);
        let mut construction = Construction::new(&landscape, 0.9);
        let mut observation = Observation::default();
        layout
            .iter()
            .map(|&cell| {
                let seen = |cell: usize| if mirrored { mirror(cell) } else { cell };
                construction.observe(&mut observation);
                let of = |lane: usize| observation.features.iter().map(|row| row[lane]).collect();
                let mut found: Vec<(usize, Vec<f32>)> = (0..observation.cells.len())
                    .map(|lane| (seen(observation.cells[lane] as usize), of(lane)))
                    .collect();
                found.retain(|(_, features)| features[LINKS] > 0.0);
                found.sort_by_key(|(cell, _)| *cell);
                construction.place(seen(cell) as u32);
                found
            })
            .collect()
    }

    /// Gains, what is found and links are those of placing one vehicle after the other;
    /// λ₂ and λ₃ are as near as inverse iteration brings them.
    #[test]
    fn a_begun_layout_is_one_that_was_placed() {
        const FOLLOWED: f64 = 0.05;
        let problem = problem(false);
        let landscape = Landscape::new(&problem);
        for count in [0, 1, 2, 3, 4, 9] {
            let cells: Vec<CellId> =
                [17, 30, 52, 53, 66, 78, 79, 90, 101].map(CellId)[..count].to_vec();
            let begun = Construction::begun(&landscape, 0.9, &cells);
            let mut placed = Construction::new(&landscape, 0.9);
            for &CellId(cell) in &cells {
                placed.place(cell as u32);
            }
            assert_eq!(begun.layout(), cells);
            assert_eq!(begun.free, placed.free);
            assert_eq!(begun.around, placed.around);
            assert_eq!(begun.weights, placed.weights);
            assert!((begun.utility - placed.utility).abs() < ROUNDING * placed.utility.max(1.0));
            let close = |a: &[f32], b: &[f32]| {
                a.iter().zip(b).all(|(a, b)| (a - b).abs() < ROUNDING * landscape.best_first_gain)
            };
            assert!(close(&begun.gains, &placed.gains) && close(&begun.residual, &placed.residual));
            for (found, followed) in begun.spectrum.values.iter().zip(placed.spectrum.values) {
                let error = (found - followed).abs();
                assert!(error <= FOLLOWED * followed, "{count}: {found}, followed {followed}");
            }
        }
    }

    #[test]
    fn features_do_not_depend_on_the_orientation() {
        let layout = [53, 66, 54, 80, 41, 67, 92, 29, 79, 55];
        for (plain, mirrored) in observed(false, &layout).iter().zip(observed(true, &layout)) {
            assert_eq!(plain.len(), mirrored.len());
            for ((cell, features), (same, others)) in plain.iter().zip(&mirrored) {
                assert_eq!(cell, same);
                for (at, (a, b)) in features.iter().zip(others).enumerate() {
                    assert!((a - b).abs() < ROUNDING, "cell {cell}, feature {at}: {a} {b}");
                }
            }
        }
    }

    #[test]
    fn gains_and_connectivity_are_nearly_those_of_full_evaluations() {
        let problem = problem(false);
        let landscape = Landscape::new(&problem);
        let mut construction = Construction::new(&landscape, 0.9);
        let mut layout = Vec::new();
        for cell in [53, 66, 54, 80, 41, 67] {
            construction.observe(&mut Observation::default());
            let before = problem.evaluate(&layout);
            layout.push(CellId(cell));
            let after = problem.evaluate(&layout);
            let gain = after.detection_utility - before.detection_utility;
            let found = f64::from(construction.gains[cell]);
            let most = LEFT_OUT * problem.prior().total();
            assert!(gain - found > -1e-4 && gain - found < most, "{cell}: {found} {gain}");
            let raised = f64::from(construction.sums.raised[cell][0]);
            if layout.len() > 2 {
                // The estimate is a Rayleigh quotient: never much below λ₂.
                assert!(raised > after.algebraic_connectivity - 0.02, "{cell}: {raised}");
            }
            construction.place(cell as u32);
        }
        assert_eq!(construction.layout(), layout);
    }
}
