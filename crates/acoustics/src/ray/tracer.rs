use super::crossing::{contact, exit};
use super::medium::{Column, Medium};
use super::segment::{Burden, Pair, Segment, SegmentSink};
use crate::environment::{Boundary, Section};

/// Rays leave a boundary at this grazing angle at least, radians: one that water
/// refracts back to it would otherwise touch it without end. In a gradient of
/// 0.1 s⁻¹ it makes skips of 3 m.
const LEAST_GRAZING: f64 = 1e-4;

/// Smallest vertical slowness after a crossing, as a fraction of the horizontal: a ray that turns
/// exactly at a level must not stall on it.
const LEAST_SLOPE: f64 = 1e-7;

/// Reflections leave no ray whose coefficient is smaller (matched half-spaces).
const LEAST_REFLECTION: f64 = 1e-5;

/// More segments than any sensible ray has; ends one that bounces without loss
/// between cells that are far too small.
const MOST_SEGMENTS: usize = 1_000_000;

/// Why a ray ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RayEnd {
    /// It left by the far or the near end of the section.
    LeftDomain,
    /// Reflections made it weaker than the cut-off.
    Faded,
    /// It went through more cells than a ray may (a million).
    TooLong,
}

/// Where and how a ray starts, at range 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Launch {
    pub depth_m: f64,
    /// Below the horizontal.
    pub angle_rad: f64,
}

/// Carries rays through a medium between two boundaries.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tracer<'a> {
    medium: &'a Medium,
    surface: &'a Boundary,
    bottom: &'a Boundary,
    /// Product of reflection coefficients under which a ray ends.
    amplitude_cutoff: f64,
}

impl<'a> Tracer<'a> {
    /// A tracer between the boundaries of a section, through the medium made of it.
    pub(crate) fn new(section: &'a Section, medium: &'a Medium, amplitude_cutoff: f64) -> Self {
        Self { medium, surface: &section.surface, bottom: &section.bottom, amplitude_cutoff }
    }
}

/// What a ray meets at the end of a segment.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Meeting {
    /// A range node: the column behind (−1) or ahead (+1) comes next.
    Node(isize),
    /// A level: the layer above (−1) or below (+1) comes next.
    Level(isize),
    Floor,
}

struct State {
    column: usize,
    layer: usize,
    /// From the middle of the cell, metres.
    local: Pair,
    slowness: Pair,
    offset: Pair,
    offset_slowness: Pair,
    burden: Burden,
}

impl Tracer<'_> {
    /// Traces one ray, giving each of its segments to `sink`.
    pub(crate) fn run(&self, launch: Launch, sink: &mut impl SegmentSink) -> RayEnd {
        let mut ray = self.launch(launch);
        for _ in 0..MOST_SEGMENTS {
            let (segment, meeting) = self.segment(&ray);
            sink.segment(&segment);
            self.advance(&mut ray, &segment, meeting);
            match meeting {
                Meeting::Node(side) => {
                    if !self.enter_column(&mut ray, side) {
                        return RayEnd::LeftDomain;
                    }
                }
                Meeting::Level(side) => self.enter_layer(&mut ray, side),
                Meeting::Floor => self.reflect_off_floor(&mut ray),
            }
            if ray.burden.amplitude < self.amplitude_cutoff.max(LEAST_REFLECTION) {
                return RayEnd::Faded;
            }
        }
        RayEnd::TooLong
    }

    fn launch(&self, launch: Launch) -> State {
        let source = Pair::new(0.0, launch.depth_m);
        let (column, layer) = self.medium.locate(source);
        let local = self.medium.local(column, layer, source);
        let index = self.medium.cell(column, layer).squared_slowness(local).sqrt();
        let (sine, cosine) = launch.angle_rad.sin_cos();
        let burden = Burden {
            time_s: 0.0,
            path_m: 0.0,
            amplitude: 1.0,
            phase_rad: 0.0,
            parity: 1.0,
            surface_bounces: 0,
            bottom_bounces: 0,
        };
        State {
            column,
            layer,
            local,
            slowness: Pair::new(cosine, sine) * index,
            offset: Pair::default(),
            offset_slowness: Pair::new(-sine, cosine) * index,
            burden,
        }
    }

    /// The segment from where the ray is to what it meets next.
    #[expect(clippy::inline_always, reason = "a third of a ray's time goes into moving segments")]
    #[inline(always)]
    fn segment(&self, ray: &State) -> (Segment, Meeting) {
        let cell = self.medium.cell(ray.column, ray.layer);
        let layer = self.medium.layers[ray.layer];
        let gradient = cell.gradient_at(self.midway(ray));
        let (sigma, meeting) = self.next_meeting(ray, gradient);
        let middle = Pair::new(self.medium.columns[ray.column].middle, layer.middle);
        let segment = Segment {
            start: middle + ray.local,
            slowness: ray.slowness,
            gradient,
            offset: ray.offset,
            offset_slowness: ray.offset_slowness,
            sigma,
            burden: ray.burden,
        };
        (segment, meeting)
    }

    /// About the middle of the coming segment, if it were straight: where sound
    /// speed depends on range, G is taken there.
    fn midway(&self, ray: &State) -> Pair {
        let (column, layer) = (self.medium.columns[ray.column], self.medium.layers[ray.layer]);
        let until = |half: f64, place: f64, speed: f64| {
            (half - place.copysign(place * speed)).max(0.0) / speed.abs().max(1e-30)
        };
        let sigma = until(column.half_width, ray.local.x, ray.slowness.x).min(until(
            layer.half_height,
            ray.local.z,
            ray.slowness.z,
        ));
        ray.local + ray.slowness * (0.5 * sigma)
    }

    #[expect(clippy::inline_always, reason = "a third of a ray's time goes into moving segments")]
    #[inline(always)]
    fn next_meeting(&self, ray: &State, gradient: Pair) -> (f64, Meeting) {
        let (column, layer) = (self.medium.columns[ray.column], self.medium.layers[ray.layer]);
        let (local, slowness) = (ray.local, ray.slowness);
        let (width, height) = (column.half_width, layer.half_height);
        let along =
            exit(slowness.z, gradient.z, (height + local.z).max(0.0), (height - local.z).max(0.0));
        let side = |by_upper: bool| if by_upper { 1 } else { -1 };
        let (mut sigma, mut meeting) = (along.sigma, Meeting::Level(side(along.by_upper)));
        // A range node is met only if the level lies beyond it.
        let end = local.x + sigma * (slowness.x + 0.5 * sigma * gradient.x);
        if !(-width..=width).contains(&end) {
            let (behind, ahead) = ((width + local.x).max(0.0), (width - local.x).max(0.0));
            let across = exit(slowness.x, gradient.x, behind, ahead);
            if across.sigma < sigma {
                (sigma, meeting) = (across.sigma, Meeting::Node(side(across.by_upper)));
            }
        }
        if ray.layer >= column.first_cut {
            let gap = floor_at(&column, local.x) - (layer.middle + local.z);
            let closing = slowness.z - column.slope * slowness.x;
            let push = gradient.z - column.slope * gradient.x;
            let floor = contact(closing, push, gap.max(0.0));
            if floor <= sigma {
                return (floor, Meeting::Floor);
            }
        }
        (sigma, meeting)
    }

    /// Moves the ray to the end of its segment, exactly onto what it meets, and
    /// gives the vertical slowness the value that |p| = 1/c demands there.
    #[expect(clippy::inline_always, reason = "a third of a ray's time goes into moving segments")]
    #[inline(always)]
    fn advance(&self, ray: &mut State, segment: &Segment, meeting: Meeting) {
        let (column, layer) = (self.medium.columns[ray.column], self.medium.layers[ray.layer]);
        let cell = self.medium.cell(ray.column, ray.layer);
        let sigma = segment.sigma;

        let end = segment.offset_at(sigma);
        let change = cell.gradient_change((segment.offset + end) * 0.5) * sigma;
        ray.offset_slowness = segment.offset_slowness + change;
        ray.offset = end + change * (0.5 * sigma);
        ray.burden.time_s = segment.time_s(sigma);
        ray.burden.path_m = segment.path_m(sigma);
        ray.local = ray.local + ray.slowness * sigma + segment.gradient * (0.5 * sigma * sigma);
        ray.slowness = segment.slowness_at(sigma);

        let mut downward = ray.slowness.z;
        match meeting {
            Meeting::Node(side) => ray.local.x = column.half_width * side as f64,
            Meeting::Level(side) => {
                ray.local.z = layer.half_height * side as f64;
                downward = side as f64;
            }
            Meeting::Floor => ray.local.z = floor_at(&column, ray.local.x) - layer.middle,
        }
        let least = (LEAST_SLOPE * ray.slowness.x).powi(2);
        let vertical_squared = cell.squared_slowness(ray.local) - ray.slowness.x * ray.slowness.x;
        ray.slowness.z = vertical_squared.max(least).sqrt().copysign(downward);
    }

    /// Passes to the neighbouring column; false at the ends of the medium.
    fn enter_column(&self, ray: &mut State, side: isize) -> bool {
        let Some(next) = ray.column.checked_add_signed(side) else { return false };
        if next >= self.medium.columns.len() {
            return false;
        }
        let before = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        ray.column = next;
        ray.local.x = -self.medium.columns[next].half_width * side as f64;
        let after = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        // δp += (G₂ − G₁) δₙ/pₙ
        ray.offset_slowness.x += (after.x - before.x) * ray.offset.x / ray.slowness.x;
        true
    }

    /// Passes to the neighbouring layer, or reflects off the surface. Below the
    /// last layer there is no water: a ray that rounding brings there meets the
    /// floor.
    fn enter_layer(&self, ray: &mut State, side: isize) {
        let Some(next) = ray.layer.checked_add_signed(side) else {
            self.reflect(ray, Pair::new(0.0, -1.0), self.surface);
            ray.burden.surface_bounces += 1;
            return;
        };
        if next >= self.medium.layers.len() {
            self.reflect_off_floor(ray);
            return;
        }
        let before = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        ray.layer = next;
        ray.local.z = -self.medium.layers[next].half_height * side as f64;
        let after = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        // δp += (G₂ − G₁) δₙ/pₙ
        ray.offset_slowness.z += (after.z - before.z) * ray.offset.z / ray.slowness.z;
    }

    fn reflect_off_floor(&self, ray: &mut State) {
        let slope = self.medium.columns[ray.column].slope;
        let secant = slope.mul_add(slope, 1.0).sqrt();
        self.reflect(ray, Pair::new(-slope / secant, 1.0 / secant), self.bottom);
        ray.burden.bottom_bounces += 1;
    }

    /// Specular reflection at a plane with this outward normal.
    ///
    /// The neighbouring ray meets the plane δσ = −δₙ/pₙ later; at equal σ its
    /// slowness differs by δp ← Refl(δp + Gδσ) − Gδσ.
    fn reflect(&self, ray: &mut State, normal: Pair, boundary: &Boundary) {
        let mirror = |v: Pair| v + normal * (-2.0 * v.dot(normal));
        let least = LEAST_GRAZING * ray.slowness.dot(ray.slowness).sqrt();
        let across = ray.slowness.dot(normal).max(least);
        let along = ray.slowness.cross(normal);
        let gradient = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        let later = gradient * (-ray.offset.dot(normal) / across);
        ray.offset_slowness = mirror(ray.offset_slowness + later) + later * -1.0;
        ray.offset = mirror(ray.offset);
        ray.slowness = mirror(ray.slowness);
        let away = -ray.slowness.dot(normal);
        if away < least {
            ray.slowness = ray.slowness + normal * (away - least);
        }

        let coefficient = boundary.reflection(along, across);
        ray.burden.amplitude *= coefficient.modulus();
        ray.burden.phase_rad += coefficient.phase_rad();
        ray.burden.parity = -ray.burden.parity;
    }
}

/// Depth of the sea floor at a distance from the middle of a column.
fn floor_at(column: &Column, from_middle: f64) -> f64 {
    column.floor + column.slope * from_middle
}
