use super::levels::{levels, squared_slowness};
use super::medium::MediumLimits;
use crate::environment::Section;

/// The water of a section without its boundaries: 1/c² at range nodes and depth levels,
/// between which it may be taken as bilinear.
#[derive(Debug, Clone, Default)]
pub(crate) struct Lattice {
    pub node_m: Vec<f64>,
    pub level_m: Vec<f64>,
    /// [node, level], s²/m².
    pub squared_slowness: Vec<f64>,
}

impl Lattice {
    /// Nodes at the section's columns of sound speed, its ends, and what divides the
    /// intervals into parts no wider than [`MediumLimits::column_m`].
    pub(crate) fn new(section: &Section, limits: &MediumLimits) -> Self {
        let field = section.sound_speed();
        let levels = levels(field, limits.speed_tolerance_m_s, limits.deepest_m);
        let depends_on_range = field.range_m().len() > 1;
        let inside = |range: &&f64| (limits.near_m..limits.far_m).contains(*range);
        let mut ends = vec![limits.near_m];
        if depends_on_range {
            ends.extend(field.range_m().iter().filter(inside));
        }
        ends.push(limits.far_m);
        // Nodes closer than a metre are one.
        ends.dedup_by(|b, a| *b - *a < 1.0);
        let mut node_m = vec![ends[0]];
        for pair in ends.windows(2) {
            let parts = ((pair[1] - pair[0]) / limits.column_m).ceil().max(1.0) as usize;
            let step = (pair[1] - pair[0]) / parts as f64;
            node_m.extend((1..parts).map(|k| pair[0] + k as f64 * step));
            node_m.push(pair[1]);
        }
        let mut squared = Vec::with_capacity(node_m.len() * levels.len());
        for (index, &range_m) in node_m.iter().enumerate() {
            if index > 0 && !depends_on_range {
                squared.extend_from_within(..levels.len());
            } else {
                squared.extend(squared_slowness(field, &levels, range_m));
            }
        }
        let level_m = levels.iter().map(|level| level.depth).collect();
        Self { node_m, level_m, squared_slowness: squared }
    }
}
