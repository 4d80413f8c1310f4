use super::deposit::Deposits;
use super::lanes::{LANES, Lane, Lanes, Meeting, larger, smaller};
use super::tables::{Column, REFERENCE_M_S, Tables};
use crate::environment::Boundary;

/// Smallest vertical slowness after a crossing.
const LEAST_SLOPE: f32 = 1e-7;

// What a ray meets, as numbers: indices of `MEETINGS`.
const NODE_BEHIND: u32 = 0;
const NODE_AHEAD: u32 = 1;
const LEVEL_ABOVE: u32 = 2;
const LEVEL_BELOW: u32 = 3;
const FLOOR: u32 = 4;

const MEETINGS: [Meeting; 5] = [
    Meeting::NodeBehind,
    Meeting::NodeAhead,
    Meeting::LevelAbove,
    Meeting::LevelBelow,
    Meeting::Floor,
];

/// What a step reads of the cells in which the rays are.
struct Surroundings {
    excess: Lane,
    gradient_x: Lane,
    gradient_z: Lane,
    /// G along the coming step.
    mean_gradient_x: Lane,
    mean_gradient_z: Lane,
    twist: Lane,
    half_width: Lane,
    half_height: Lane,
    /// Depth of the floor below the middle of the cell; beyond reach in cells
    /// that it does not cut.
    floor: Lane,
    slope: Lane,
}

fn gather(lanes: &Lanes, tables: &Tables) -> Surroundings {
    let zero = [0.0; LANES];
    let mut s = Surroundings {
        excess: zero,
        gradient_x: zero,
        gradient_z: zero,
        mean_gradient_x: zero,
        mean_gradient_z: zero,
        twist: zero,
        half_width: zero,
        half_height: zero,
        floor: zero,
        slope: zero,
    };
    for lane in 0..LANES {
        let column = tables.columns[lanes.column[lane] as usize];
        let layer = tables.layers[lanes.layer[lane] as usize];
        let cell = tables.cells[column.cell_base.wrapping_add(lanes.layer[lane]) as usize];
        s.excess[lane] = cell.excess;
        s.gradient_x[lane] = cell.gradient_x;
        s.gradient_z[lane] = cell.gradient_z;
        s.twist[lane] = cell.twist;
        s.half_width[lane] = column.half_width;
        s.half_height[lane] = layer.half_height;
        let cut = lanes.layer[lane] >= column.first_cut;
        s.floor[lane] = if cut { column.floor - layer.middle } else { 1e9 };
        s.slope[lane] = column.slope;
    }
    // G about the middle of the coming step, as if it were straight.
    for i in 0..LANES {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let (x, z) = (lanes.local_x[i], lanes.local_z[i]);
        let until_node =
            larger(s.half_width[i] - x.copysign(x * px), 0.0) / larger(px.abs(), 1e-12);
        let until_level =
            larger(s.half_height[i] - z.copysign(z * pz), 0.0) / larger(pz.abs(), 1e-12);
        let half = 0.5 * smaller(until_node, until_level);
        s.mean_gradient_x[i] = s.gradient_x[i] + s.twist[i] * (z + half * pz);
        s.mean_gradient_z[i] = s.gradient_z[i] + s.twist[i] * (x + half * px);
    }
    s
}

/// First σ at which each ray meets a level, a range node or the floor, and which.
fn solve(lanes: &Lanes, s: &Surroundings, sigma: &mut Lane, which: &mut [u32; LANES]) {
    for i in 0..LANES {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let (x, z) = (lanes.local_x[i], lanes.local_z[i]);
        let (gx, gz) = (s.mean_gradient_x[i], s.mean_gradient_z[i]);

        // Levels: the one ahead by 2d/(v + √(v² + 2ad)); else the one behind.
        let down = if pz >= 0.0 { 1.0f32 } else { -1.0 };
        let (speed, push) = (pz.abs(), gz * down);
        let ahead = larger(s.half_height[i] - z * down, 0.0);
        let behind = larger(s.half_height[i] + z * down, 0.0);
        let discriminant = speed * speed + 2.0 * push * ahead;
        let reaches = discriminant >= 0.0;
        let forth = 2.0 * ahead / larger(speed + larger(discriminant, 0.0).sqrt(), 1e-12);
        let under_root = larger(speed * speed - 2.0 * push * behind, 0.0);
        let back = (speed + under_root.sqrt()) / larger(-push, 1e-20);
        let along = if reaches { forth } else { back };
        let below = (down > 0.0) == reaches;

        // Range nodes: p_x never changes its sign within a cell.
        let onward = if px >= 0.0 { 1.0f32 } else { -1.0 };
        let width = larger(s.half_width[i] - x * onward, 0.0);
        let run = px * px + 2.0 * gx * onward * width;
        let across = 2.0 * width / larger(px.abs() + larger(run, 0.0).sqrt(), 1e-12);

        // The floor.
        let gap = larger(s.floor[i] + s.slope[i] * x - z, 0.0);
        let closing = pz - s.slope[i] * px;
        let pull = gz - s.slope[i] * gx;
        let root = closing * closing + 2.0 * pull * gap;
        let root_speed = larger(root, 0.0).sqrt();
        let falling = 2.0 * gap / larger(closing + root_speed, 1e-12);
        let rising = (root_speed - closing) / larger(pull, 1e-20);
        let never = if closing > 0.0 { root < 0.0 } else { pull <= 0.0 };
        let contact = if closing > 0.0 { falling } else { rising };
        let contact = if never { 1e30 } else { contact };

        let water = if along <= across { along } else { across };
        let level = if below { LEVEL_BELOW } else { LEVEL_ABOVE };
        let node = if onward > 0.0 { NODE_AHEAD } else { NODE_BEHIND };
        let by_water = if along <= across { level } else { node };
        sigma[i] = if contact <= water { contact } else { water };
        which[i] = if contact <= water { FLOOR } else { by_water };
    }
}

/// Moves the tubes around the rays to the end of the step.
fn move_tubes(lanes: &mut Lanes, s: &Surroundings, sigma: &Lane) {
    for (i, &t) in sigma.iter().enumerate() {
        let end_x = lanes.offset_x[i] + t * lanes.offset_slowness_x[i];
        let end_z = lanes.offset_z[i] + t * lanes.offset_slowness_z[i];
        let mean_x = 0.5 * (lanes.offset_x[i] + end_x);
        let mean_z = 0.5 * (lanes.offset_z[i] + end_z);
        let (change_x, change_z) = (s.twist[i] * mean_z * t, s.twist[i] * mean_x * t);
        lanes.offset_slowness_x[i] += change_x;
        lanes.offset_slowness_z[i] += change_z;
        lanes.offset_x[i] = end_x + 0.5 * t * change_x;
        lanes.offset_z[i] = end_z + 0.5 * t * change_z;
    }
}

/// Moves the rays to the end of the step, but for rounding onto what they meet.
fn move_rays(lanes: &mut Lanes, s: &Surroundings, sigma: &Lane) {
    for (i, &t) in sigma.iter().enumerate() {
        let (px, pz) = (lanes.slowness_x[i], lanes.slowness_z[i]);
        let (gx, gz) = (s.mean_gradient_x[i], s.mean_gradient_z[i]);
        // ∫|p|dσ with |p| ≈ (1 + |p|²)/2, and |p|² in the middle of the step.
        let middle = px * px + pz * pz + t * (px * gx + pz * gz);
        lanes.path[i] += 0.5 * t * (1.0 + middle);

        let x = lanes.local_x[i] + t * (px + 0.5 * t * gx);
        let z = lanes.local_z[i] + t * (pz + 0.5 * t * gz);
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
        lanes.slowness_z[i] = if pz + t * gz >= 0.0 { vertical } else { -vertical };
    }
}

/// Moves all rays to what they meet next and deposits what they bring.
pub(super) fn advance(lanes: &mut Lanes, tables: &Tables, deposits: &mut Deposits) {
    let s = gather(lanes, tables);
    let mut sigma = [0.0; LANES];
    let mut which = [0; LANES];
    solve(lanes, &s, &mut sigma, &mut which);
    deposits.take_step(lanes, tables, &s.mean_gradient_x, &s.mean_gradient_z, &sigma);

    move_tubes(lanes, &s, &sigma);
    move_rays(lanes, &s, &sigma);
    for i in 0..LANES {
        if lanes.met[i] != Meeting::Idle {
            lanes.met[i] = MEETINGS[which[i] as usize];
        }
    }
}

/// Takes one ray exactly onto what it has met and through it; true if the ray has
/// ended.
pub(super) fn meet(
    lanes: &mut Lanes,
    i: usize,
    tables: &Tables,
    boundaries: [&Boundary; 2],
) -> bool {
    let bounds = lanes.bounds[i];
    let (column, layer) = (lanes.column[i], lanes.layer[i]);
    match lanes.met[i] {
        Meeting::Idle => return false,
        Meeting::NodeBehind if column == bounds.first_column => return true,
        Meeting::NodeAhead if column == bounds.last_column => return true,
        Meeting::NodeBehind => enter_column(lanes, i, tables, column - 1, 1.0),
        Meeting::NodeAhead => enter_column(lanes, i, tables, column + 1, -1.0),
        Meeting::LevelAbove if layer == bounds.first_layer => {
            lanes.local_z[i] = -tables.layers[layer as usize].half_height;
            lanes.slowness_z[i] = -lanes.slowness_z[i].abs();
            reflect(lanes, i, tables, [0.0, -1.0], boundaries[0]);
        }
        Meeting::LevelAbove => enter_layer(lanes, i, tables, layer - 1, 1.0),
        Meeting::LevelBelow if layer < bounds.last_layer => {
            enter_layer(lanes, i, tables, layer + 1, -1.0);
        }
        Meeting::LevelBelow | Meeting::Floor => {
            let Column { floor, slope, .. } = tables.columns[column as usize];
            let middle = tables.layers[layer as usize].middle;
            lanes.local_z[i] = floor - middle + slope * lanes.local_x[i];
            let secant = (1.0 + slope * slope).sqrt();
            reflect(lanes, i, tables, [-slope / secant, 1.0 / secant], boundaries[1]);
        }
    }
    lanes.energy[i] < lanes.least_energy[i]
}

/// δp += (G₂ − G₁) δₙ/pₙ at a range node.
fn enter_column(lanes: &mut Lanes, i: usize, tables: &Tables, next: u32, side: f32) {
    let before = tables.cell(lanes.column[i], lanes.layer[i]);
    let after = tables.cell(next, lanes.layer[i]);
    let z = lanes.local_z[i];
    let jump = after.gradient_x - before.gradient_x + (after.twist - before.twist) * z;
    lanes.offset_slowness_x[i] += jump * lanes.offset_x[i] / lanes.slowness_x[i];
    lanes.column[i] = next;
    lanes.local_x[i] = side * tables.columns[next as usize].half_width;
}

/// δp += (G₂ − G₁) δₙ/pₙ at a level.
fn enter_layer(lanes: &mut Lanes, i: usize, tables: &Tables, next: u32, side: f32) {
    let before = tables.cell(lanes.column[i], lanes.layer[i]);
    let after = tables.cell(lanes.column[i], next);
    let x = lanes.local_x[i];
    let jump = after.gradient_z - before.gradient_z + (after.twist - before.twist) * x;
    lanes.slowness_z[i] = lanes.slowness_z[i].abs().copysign(-side);
    lanes.offset_slowness_z[i] += jump * lanes.offset_z[i] / lanes.slowness_z[i];
    lanes.layer[i] = next;
    lanes.local_z[i] = side * tables.layers[next as usize].half_height;
}

/// As the scalar tracer's reflection.
fn reflect(lanes: &mut Lanes, i: usize, tables: &Tables, n: [f32; 2], boundary: &Boundary) {
    let mirror = |v: [f32; 2]| {
        let across = 2.0 * (v[0] * n[0] + v[1] * n[1]);
        [v[0] - across * n[0], v[1] - across * n[1]]
    };
    let slowness = [lanes.slowness_x[i], lanes.slowness_z[i]];
    let offset = [lanes.offset_x[i], lanes.offset_z[i]];
    let across = slowness[0] * n[0] + slowness[1] * n[1];
    let along = slowness[0] * n[1] - slowness[1] * n[0];
    let cell = tables.cell(lanes.column[i], lanes.layer[i]);
    let gradient = [
        cell.gradient_x + cell.twist * lanes.local_z[i],
        cell.gradient_z + cell.twist * lanes.local_x[i],
    ];
    let delay = -(offset[0] * n[0] + offset[1] * n[1]) / across;
    let later = [gradient[0] * delay, gradient[1] * delay];
    let turned =
        mirror([lanes.offset_slowness_x[i] + later[0], lanes.offset_slowness_z[i] + later[1]]);
    [lanes.offset_slowness_x[i], lanes.offset_slowness_z[i]] =
        [turned[0] - later[0], turned[1] - later[1]];
    [lanes.offset_x[i], lanes.offset_z[i]] = mirror(offset);
    let [px, pz] = mirror(slowness);
    // p_x' − p_x = −2 pₙ nₓ, so that 1 − p_x² loses nothing to rounding.
    let turn = -2.0 * across * n[0];
    lanes.defect[i] -= turn * (2.0 * slowness[0] + turn);
    (lanes.slowness_x[i], lanes.slowness_z[i]) = (px, pz);
    let coefficient =
        boundary.reflection(f64::from(along) / REFERENCE_M_S, f64::from(across) / REFERENCE_M_S);
    lanes.energy[i] *= coefficient.squared_modulus() as f32;
}
