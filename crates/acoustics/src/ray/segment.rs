use std::ops::{Add, Mul};

/// A pair of components along range (x) and depth (z).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Pair {
    pub x: f64,
    pub z: f64,
}

impl Pair {
    pub(crate) const fn new(x: f64, z: f64) -> Self {
        Self { x, z }
    }

    pub(crate) fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.z * other.z
    }

    /// The component of the vector product out of the section, x₁z₂ − z₁x₂.
    pub(crate) fn cross(self, other: Self) -> f64 {
        self.x * other.z - self.z * other.x
    }
}

impl Add for Pair {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.z + other.z)
    }
}

impl Mul<f64> for Pair {
    type Output = Self;
    fn mul(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.z * factor)
    }
}

/// What a ray carries besides its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Burden {
    /// Travel time from the source, s.
    pub time_s: f64,
    /// Path length from the source, m.
    pub path_m: f64,
    /// Product of the moduli of the reflection coefficients met.
    pub amplitude: f64,
    /// Sum of the phases of the reflection coefficients met, radians.
    pub phase_rad: f64,
    /// +1 or −1: a reflection mirrors the tube, and this undoes it.
    pub parity: f64,
    pub surface_bounces: u32,
    pub bottom_bounces: u32,
}

/// The piece of a ray within one cell, from σ = 0 to `sigma`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Segment {
    /// Where it begins, metres.
    pub start: Pair,
    /// Slowness p₀ at its beginning, s/m.
    pub slowness: Pair,
    /// G = ½∇(1/c²), constant along it.
    pub gradient: Pair,
    /// δx = ∂x/∂α at its beginning, m/rad.
    pub offset: Pair,
    /// δp = ∂p/∂α, constant along it.
    pub offset_slowness: Pair,
    /// Its length in σ.
    pub sigma: f64,
    /// What the ray carries at its beginning.
    pub burden: Burden,
}

impl Segment {
    #[inline]
    pub(crate) fn position(&self, sigma: f64) -> Pair {
        self.start + self.slowness * sigma + self.gradient * (0.5 * sigma * sigma)
    }

    pub(crate) fn slowness_at(&self, sigma: f64) -> Pair {
        self.slowness + self.gradient * sigma
    }

    pub(crate) fn offset_at(&self, sigma: f64) -> Pair {
        self.offset + self.offset_slowness * sigma
    }

    /// The σ at which it has gone `distance` in range, given that it does.
    pub(crate) fn sigma_at_distance(&self, distance: f64) -> f64 {
        let p = self.slowness.x;
        let root = (p * p + 2.0 * self.gradient.x * distance).max(0.0).sqrt();
        (2.0 * distance / (p + root.copysign(p))).clamp(0.0, self.sigma)
    }

    /// The width of the tube per radian of launch angle, signed: the component
    /// of δx across the ray. The same side of the ray is positive from the
    /// source to the end, so that it changes sign at caustics only. This is
    /// q/c₀ of the dynamic-ray equations.
    pub(crate) fn width(&self, sigma: f64) -> f64 {
        let slowness = self.slowness_at(sigma);
        let cross = slowness.cross(self.offset_at(sigma));
        self.burden.parity * cross / slowness.dot(slowness).sqrt()
    }

    /// Travel time from the source at σ, s: ∫|p|²dσ.
    pub(crate) fn time_s(&self, sigma: f64) -> f64 {
        let (p, g) = (self.slowness, self.gradient);
        let along = p.dot(p) + sigma * (p.dot(g) + sigma * g.dot(g) / 3.0);
        self.burden.time_s + sigma * along
    }

    /// Path length from the source at σ, m: ∫|p|dσ by the midpoint's |p|, which
    /// is exact to (Δc/c)²/24.
    pub(crate) fn path_m(&self, sigma: f64) -> f64 {
        let middle = self.slowness_at(0.5 * sigma);
        self.burden.path_m + sigma * middle.dot(middle).sqrt()
    }
}

/// What is done with the segments of rays: recording them, or depositing what
/// they carry on receivers.
pub(crate) trait SegmentSink {
    /// A segment, in the order of travel.
    fn segment(&mut self, segment: &Segment);
}
