use super::crossing::{contact, exit};
use super::medium::{Column, Medium, Roof};
use super::segment::{Burden, Pair, Segment, SegmentSink};
use crate::environment::{Bend, Boundary, Section};

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

/// Reflections in a row with less than [`CORNER_M`] between them that end a ray: it is
/// caught where surface and sea floor meet.
const CORNER_REFLECTIONS: u32 = 100;

/// Shorter ways than this between reflections are none, metres.
const CORNER_M: f64 = 1e-6;

/// Why a ray ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RayEnd {
    /// It left by the far, the near or the lower end of what is looked at.
    LeftDomain,
    /// Reflections made it weaker than the cut-off.
    Faded,
    /// It was caught in the corner between surface and sea floor.
    Cornered,
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
    Roof,
}

/// An interface where a ray meets it.
#[derive(Debug, Clone, Copy)]
struct Wall<'a> {
    /// Normal of the straight piece, out of the water.
    normal: Pair,
    /// How the interface turns there, if it is curvilinear.
    bend: Option<Bend>,
    boundary: &'a Boundary,
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
        let mut reflections = 0;
        let mut last_reflection_m = 0.0;
        for _ in 0..MOST_SEGMENTS {
            let (segment, meeting) = self.segment(&ray);
            sink.segment(&segment);
            self.advance(&mut ray, &segment, meeting);
            let (surface, bottom) = (ray.burden.surface_bounces, ray.burden.bottom_bounces);
            let inside = match meeting {
                Meeting::Node(side) => self.enter_column(&mut ray, side),
                Meeting::Level(side) => self.enter_layer(&mut ray, side),
                Meeting::Floor => self.reflect_off_floor(&mut ray),
                Meeting::Roof => self.reflect_off_surface(&mut ray),
            };
            if !inside {
                return RayEnd::LeftDomain;
            }
            if (surface, bottom) == (ray.burden.surface_bounces, ray.burden.bottom_bounces) {
                continue;
            }
            if ray.burden.amplitude < self.amplitude_cutoff.max(LEAST_REFLECTION) {
                return RayEnd::Faded;
            }
            let gone = ray.burden.path_m - last_reflection_m;
            reflections = if gone < CORNER_M { reflections + 1 } else { 0 };
            last_reflection_m = ray.burden.path_m;
            if reflections > CORNER_REFLECTIONS {
                return RayEnd::Cornered;
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
        let start = if self.medium.is_coarse { self.midway(ray) } else { ray.local };
        let mut gradient = cell.gradient_at(start);
        let (mut sigma, mut meeting) = self.next_meeting(ray, gradient);
        if !(self.medium.is_coarse || cell.is_uniform()) {
            // G is taken where the ray is on average.
            let mean = ray.slowness * (0.5 * sigma) + gradient * (sigma * sigma / 6.0);
            gradient = cell.gradient_at(ray.local + mean);
            (sigma, meeting) = self.next_meeting(ray, gradient);
        }
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

    /// About the middle of the coming segment, if it were straight.
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
                (sigma, meeting) = (floor, Meeting::Floor);
            }
        }
        if let Some(roof) = column.roof.filter(|roof| ray.layer <= roof.last_cut) {
            let gap = layer.middle + local.z - roof_at(&roof, local.x);
            let closing = roof.slope * slowness.x - slowness.z;
            let push = roof.slope * gradient.x - gradient.z;
            let contact = contact(closing, push, gap.max(0.0));
            if contact <= sigma {
                (sigma, meeting) = (contact, Meeting::Roof);
            }
        }
        (sigma, meeting)
    }

    /// Moves the ray to the end of its segment, exactly onto what it meets, and
    /// gives its slowness the modulus 1/c there (in a coarse medium by its vertical part,
    /// as in the batch kernel).
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
            Meeting::Roof => {
                if let Some(roof) = column.roof {
                    ray.local.z = roof_at(&roof, ray.local.x) - layer.middle;
                }
            }
        }
        let index_squared = cell.squared_slowness(ray.local);
        let least = LEAST_SLOPE * ray.slowness.x.abs();
        if self.medium.is_coarse {
            let vertical_squared = index_squared - ray.slowness.x * ray.slowness.x;
            ray.slowness.z = vertical_squared.max(0.0).sqrt();
        } else {
            let rescale = (index_squared / ray.slowness.dot(ray.slowness)).sqrt();
            ray.slowness = ray.slowness * rescale;
        }
        ray.slowness.z = ray.slowness.z.abs().max(least).copysign(downward);
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

    /// Passes to the neighbouring layer, or reflects off the surface; false at the lower
    /// end of the medium. Where the sea floor lies at that end, a ray that rounding
    /// brings there meets the floor.
    fn enter_layer(&self, ray: &mut State, side: isize) -> bool {
        let Some(next) = ray.layer.checked_add_signed(side) else {
            return self.reflect_off_surface(ray);
        };
        if next >= self.medium.layers.len() {
            let below = self.floor_below(ray);
            return below <= FLOOR_ROUNDING_M && self.reflect_off_floor(ray);
        }
        let before = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        ray.layer = next;
        ray.local.z = -self.medium.layers[next].half_height * side as f64;
        let after = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        // δp += (G₂ − G₁) δₙ/pₙ
        ray.offset_slowness.z += (after.z - before.z) * ray.offset.z / ray.slowness.z;
        true
    }

    /// How far the sea floor lies below a ray, metres.
    fn floor_below(&self, ray: &State) -> f64 {
        let (column, layer) = (&self.medium.columns[ray.column], self.medium.layers[ray.layer]);
        floor_at(column, ray.local.x) - (layer.middle + ray.local.z)
    }

    fn reflect_off_floor(&self, ray: &mut State) -> bool {
        let column = &self.medium.columns[ray.column];
        let normal = unit_normal(column.slope);
        self.reflect(ray, Wall { normal, bend: column.floor_bend, boundary: self.bottom });
        ray.burden.bottom_bounces += 1;
        true
    }

    fn reflect_off_surface(&self, ray: &mut State) -> bool {
        let roof = self.medium.columns[ray.column].roof;
        let normal = unit_normal(roof.map_or(0.0, |roof| roof.slope)) * -1.0;
        let bend = roof.and_then(|roof| roof.bend);
        self.reflect(ray, Wall { normal, bend, boundary: self.surface });
        ray.burden.surface_bounces += 1;
        true
    }

    /// Specular reflection.
    ///
    /// The neighbouring ray meets the wall δσ = −δₙ/pₙ later and δs = δₜ − pₜδₙ/pₙ
    /// farther along; at equal σ its slowness differs by
    /// δp ← Refl(δp + Gδσ) − Gδσ − 2κδs(pₜn + pₙt), where the normal turns by κ = dn/ds·t
    /// along the wall. A curvilinear wall is met on its straight pieces, but reflects by
    /// the normal n of its bend.
    fn reflect(&self, ray: &mut State, wall: Wall<'_>) {
        let side = wall.normal.z.signum();
        let normal = wall.bend.map_or(wall.normal, |bend| {
            let angle = bend.angle_rad + bend.turning_rad_m * ray.local.x;
            Pair::new(-angle.sin(), angle.cos()) * side
        });
        let mirror = |v: Pair| v + normal * (-2.0 * v.dot(normal));
        let least = LEAST_GRAZING * ray.slowness.dot(ray.slowness).sqrt();
        let across = ray.slowness.dot(normal).max(least);
        let along = ray.slowness.cross(normal);
        let gradient = self.medium.cell(ray.column, ray.layer).gradient_at(ray.local);
        let later = gradient * (-ray.offset.dot(normal) / across);
        let mut offset_slowness = mirror(ray.offset_slowness + later) + later * -1.0;
        if let Some(bend) = wall.bend {
            let tangent = Pair::new(normal.z, -normal.x);
            let slip = ray.offset.dot(tangent) - along * ray.offset.dot(normal) / across;
            let kick = 2.0 * bend.curvature_m * side * slip;
            offset_slowness = offset_slowness + (normal * along + tangent * across) * kick;
        }
        ray.offset_slowness = offset_slowness;
        ray.offset = mirror(ray.offset);
        ray.slowness = mirror(ray.slowness);
        let away = -ray.slowness.dot(wall.normal);
        if away < least {
            ray.slowness = ray.slowness + wall.normal * (away - least);
        }

        let coefficient = wall.boundary.reflection(along, across);
        ray.burden.amplitude *= coefficient.modulus();
        ray.burden.phase_rad += coefficient.phase_rad();
        ray.burden.parity = -ray.burden.parity;
    }
}

/// A medium that ends within this of the sea floor ends at it, metres.
const FLOOR_ROUNDING_M: f64 = 1e-6;

/// Normal of a slope, downward.
fn unit_normal(slope: f64) -> Pair {
    let secant = slope.mul_add(slope, 1.0).sqrt();
    Pair::new(-slope / secant, 1.0 / secant)
}

/// Depth of the surface at a distance from the middle of a column.
fn roof_at(roof: &Roof, from_middle: f64) -> f64 {
    roof.depth + roof.slope * from_middle
}

/// Depth of the sea floor at a distance from the middle of a column.
fn floor_at(column: &Column, from_middle: f64) -> f64 {
    column.floor + column.slope * from_middle
}
