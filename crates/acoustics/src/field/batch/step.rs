use super::deposit::Deposits;
use super::lanes::{FLOOR, Indices, LANES, LEVEL_ABOVE, Lane, Lanes, NODE_BEHIND, Rows, larger};
use super::tables::{Cell, FIRST_EVENT, Link, Way};

/// Smallest vertical slowness after a crossing.
const LEAST_SLOPE: f32 = 1e-7;

/// Slownesses and their changes are not divided by less.
const LEAST_SPEED: f32 = 1e-12;

/// A number that is not divided yet; the lower part is positive.
#[derive(Clone, Copy)]
struct Fraction(f32, f32);

impl Fraction {
    #[inline(always)]
    fn at_most(self, other: Self) -> bool {
        self.0 * other.1 <= other.0 * self.1
    }
}

/// 1/x of a positive number to 0.3 %, without a division: subtracting the bits
/// negates the logarithm, and one step of Newton's rule follows.
#[inline(always)]
fn about_reciprocal(x: f32) -> f32 {
    let guess = f32::from_bits(0x7ef3_11c7_u32.wrapping_sub(x.to_bits()));
    guess * (2.0 - x * guess)
}

/// From where rays are to what they meet next.
pub(super) struct Step {
    pub sigma: Lane,
    /// What is met: negative for nodes, positive for levels, 0 for the floor.
    pub axis: Lane,
    /// On which side it lies, behind and above (−1) or ahead and below (+1).
    pub side: Lane,
    /// G half-way along the step.
    pub gradient_x: Lane,
    pub gradient_z: Lane,
}

/// Rays whose step does not end at a neighbour.
pub(super) struct Events {
    /// The first `count` are filled.
    lanes: [u8; LANES],
    links: [Link; LANES],
    count: usize,
}

impl Events {
    /// Lanes, and what happens to their rays.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, Way)> {
        let filled = self.lanes[..self.count].iter().zip(&self.links);
        filled.map(|(&lane, link)| (usize::from(lane) % LANES, link.way()))
    }
}

/// Moves all rays to what they meet next, deposits what they bring, and takes them
/// into the neighbouring cells. What else they meet is left to be dealt with.
#[inline(always)]
pub(super) fn advance(lanes: &mut Lanes, cells: &[Cell], deposits: &mut Deposits) -> Events {
    let step = solve(lanes);
    deposits.take_step(lanes, &step);
    move_tubes(lanes, &step.sigma);
    move_rays(lanes, &step);
    cross(lanes, &step, cells)
}

/// First σ at which each ray meets a level, a range node or the floor, and which.
#[inline(always)]
fn solve(lanes: &Lanes) -> Step {
    let zero = [0.0; LANES];
    let mut step = Step { sigma: zero, axis: zero, side: zero, gradient_x: zero, gradient_z: zero };
    let s = &lanes.here;
    for i in 0..LANES {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let (x, z) = (lanes.local_x[i], lanes.local_z[i]);
        let (onward, down) = (1.0f32.copysign(px), 1.0f32.copysign(pz));
        let (run, fall) = (px.abs(), pz.abs());
        let width = larger(s.half_width[i] - x * onward, 0.0);
        let height = larger(s.half_height[i] - z * down, 0.0);

        // G half-way to the node or level ahead, as if the ray were straight.
        let node_first = width * fall <= height * run;
        let half = 0.5
            * if node_first { width } else { height }
            * about_reciprocal(larger(if node_first { run } else { fall }, 1e-12));
        let gx = s.gradient_x[i] + s.twist[i] * (z + half * pz);
        let gz = s.gradient_z[i] + s.twist[i] * (x + half * px);
        (step.gradient_x[i], step.gradient_z[i]) = (gx, gz);

        // Levels: the one ahead at 2d/(v + √(v² + 2ad)); else the one behind. Every σ
        // is kept as a fraction, so that only that of what is met first is divided.
        let push = gz * down;
        let behind = larger(s.half_height[i] + z * down, 0.0);
        let reaches = fall * fall + 2.0 * push * height >= 0.0;
        let square = fall * fall + 2.0 * push * if reaches { height } else { -behind };
        let speed = larger(fall + square.sqrt(), LEAST_SPEED);
        let level = if reaches { Fraction(2.0 * height, speed) } else { Fraction(speed, -push) };
        let level_side = if reaches { down } else { -down };

        // Range nodes: p_x never changes its sign within a cell.
        let square = px * px + 2.0 * gx * onward * width;
        let speed = larger(run + larger(square, 0.0).sqrt(), LEAST_SPEED);
        let node = Fraction(2.0 * width, speed);

        // The floor, or the line over it, below which it is met at once.
        let gap = s.floor[i] + s.slope[i] * x - z;
        let inside = gap < s.least_gap[i];
        let gap = larger(gap, 0.0);
        let closing = pz - s.slope[i] * px;
        let pull = gz - s.slope[i] * gx;
        let square = closing * closing + 2.0 * pull * gap;
        let root = larger(square, 0.0).sqrt();
        let falls = closing > 0.0;
        let meets = inside | if falls { square >= 0.0 } else { pull > 0.0 };
        let contact = if falls {
            Fraction(2.0 * gap, larger(closing + root, LEAST_SPEED))
        } else {
            Fraction(root - closing, larger(pull, LEAST_SPEED))
        };
        let contact = Fraction(if inside { 0.0 } else { contact.0 }, contact.1);

        let level_first = level.at_most(node);
        let water = if level_first { level } else { node };
        let floor_first = meets & contact.at_most(water);
        let first = if floor_first { contact } else { water };
        step.sigma[i] = first.0 / first.1;
        step.side[i] = if level_first { level_side } else { onward };
        let axis = if level_first { 1.0 } else { -1.0 };
        step.axis[i] = if floor_first { 0.0 } else { axis };
    }
    step
}

/// Moves the tubes around the rays to the end of the step.
#[inline(always)]
fn move_tubes(lanes: &mut Lanes, sigma: &Lane) {
    for (i, &t) in sigma.iter().enumerate() {
        let end_x = lanes.offset_x[i] + t * lanes.offset_slowness_x[i];
        let end_z = lanes.offset_z[i] + t * lanes.offset_slowness_z[i];
        let mean_x = 0.5 * (lanes.offset_x[i] + end_x);
        let mean_z = 0.5 * (lanes.offset_z[i] + end_z);
        let turn = lanes.here.twist[i] * t;
        let (change_x, change_z) = (turn * mean_z, turn * mean_x);
        lanes.offset_slowness_x[i] += change_x;
        lanes.offset_slowness_z[i] += change_z;
        lanes.offset_x[i] = end_x + 0.5 * t * change_x;
        lanes.offset_z[i] = end_z + 0.5 * t * change_z;
    }
}

/// Moves the rays to the end of the step, but for rounding onto what they meet.
#[inline(always)]
fn move_rays(lanes: &mut Lanes, step: &Step) {
    let s = &lanes.here;
    for (i, &t) in step.sigma.iter().enumerate() {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let (gx, gz) = (step.gradient_x[i], step.gradient_z[i]);
        // ∫|p|dσ with |p| ≈ (1 + |p|²)/2, and |p|² in the middle of the step.
        let middle = px * px + pz * pz + t * (px * gx + pz * gz);
        lanes.path[i] += 0.5 * t * (1.0 + middle);

        let x = lanes.local_x[i] + t * (px + 0.5 * t * gx);
        let down = t * (pz + 0.5 * t * gz);
        let z = lanes.local_z[i] + down;
        lanes.above_receivers[i] -= down;
        lanes.local_x[i] = x;
        lanes.local_z[i] = z;

        let turn = t * gx;
        let defect = lanes.defect[i] - turn * (2.0 * px + turn);
        lanes.defect[i] = defect;
        lanes.slowness_x[i] = px + turn;
        // |p| = 1/c: p_z² = (1/c² − 1) + (1 − p_x²).
        let slant = s.gradient_x[i] * x + s.gradient_z[i] * z + s.twist[i] * x * z;
        let excess = s.excess[i] + 2.0 * slant;
        let least = LEAST_SLOPE * LEAST_SLOPE;
        let vertical = larger(excess + defect, least).sqrt();
        lanes.slowness_z[i] = vertical.copysign(pz + t * gz);
    }
}

/// Takes the rays exactly onto what they have met, and through it if there is a
/// neighbour behind it.
#[inline(always)]
fn cross(lanes: &mut Lanes, step: &Step, cells: &[Cell]) -> Events {
    // G and the middle of the cells that are left.
    let (mut gradient_x, mut gradient_z) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        gradient_x[i] = lanes.here.gradient_x[i] + lanes.here.twist[i] * lanes.local_z[i];
        gradient_z[i] = lanes.here.gradient_z[i] + lanes.here.twist[i] * lanes.local_x[i];
    }
    let middle = lanes.here.middle;

    let mut events = Events { lanes: [0; LANES], links: [Link::NONE; LANES], count: 0 };
    let (mut crosses, mut count) = ([0.0f32; LANES], 0);
    let mut rows = Rows::NOWHERE;
    let mut met: Indices = [0; LANES];
    for (i, met) in met.iter_mut().enumerate() {
        let side = u32::from(step.side[i] > 0.0);
        let face = if step.axis[i] > 0.0 { LEVEL_ABOVE } else { NODE_BEHIND };
        *met = if step.axis[i].abs() > 0.0 { face + side } else { FLOOR };
    }
    for lane in 0..LANES {
        let before = lanes.cell[lane];
        let link = cells[before as usize].links[met[lane] as usize];
        let neighbour = link.number() < FIRST_EVENT;
        let cell = if neighbour { link.number() } else { before };
        crosses[lane] = if neighbour { 1.0 } else { 0.0 };
        lanes.cell[lane] = cell;
        rows.read(lane, &cells[cell as usize]);
        (events.lanes[count], events.links[count]) = (lane as u8, link);
        count += usize::from(!neighbour);
    }
    events.count = count;
    lanes.here.read_all(&rows);

    let s = &lanes.here;
    for i in 0..LANES {
        let (by_node, by_level) = (step.axis[i] < 0.0, step.axis[i] > 0.0);
        let (x, z) = (lanes.local_x[i], lanes.local_z[i]);
        let along_x = x + (middle[i] - s.middle[i]);
        // δp += (G₂ − G₁) δₙ/pₙ, nothing where the cell is the same.
        let jump_x = s.gradient_x[i] + s.twist[i] * z - gradient_x[i];
        let jump_z = s.gradient_z[i] + s.twist[i] * along_x - gradient_z[i];
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let pz = if by_level { pz.abs().copysign(step.side[i]) } else { pz };
        let kick = if by_node { jump_x * lanes.offset_x[i] } else { jump_z * lanes.offset_z[i] }
            / if by_node { px } else { pz };
        lanes.offset_slowness_x[i] += if by_node { kick } else { 0.0 };
        lanes.offset_slowness_z[i] += if by_node { 0.0 } else { kick };
        lanes.slowness_z[i] = pz;

        let entered_x = if by_node { -step.side[i] * s.half_width[i] } else { along_x };
        let entered_z = if by_node { z } else { -step.side[i] * s.half_height[i] };
        lanes.local_x[i] = if crosses[i] > 0.0 { entered_x } else { x };
        lanes.local_z[i] = if crosses[i] > 0.0 { entered_z } else { z };
    }
    events
}
