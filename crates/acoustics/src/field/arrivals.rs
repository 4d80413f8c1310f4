/// Sound that reaches a receiver along one path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arrival {
    /// Pressure over that at 1 m from the source, without absorption in the water.
    pub amplitude: f64,
    /// Phase from reflections and caustics, radians.
    pub phase_rad: f64,
    /// Travel time, s.
    pub delay_s: f64,
    /// Absorption in the water along the path, nepers of amplitude.
    pub absorption_nepers: f64,
    /// Angle at the source below the horizontal, degrees.
    pub launch_angle_deg: f64,
    /// Angle at the receiver below the horizontal, degrees.
    pub arrival_angle_deg: f64,
    /// Reflections off the surface.
    pub surface_bounces: u32,
    /// Reflections off the sea floor.
    pub bottom_bounces: u32,
}

/// What arrives at the receivers of a source.
#[derive(Debug, Clone, PartialEq)]
pub struct Arrivals {
    /// Ranges of the receivers, metres.
    pub range_m: Vec<f64>,
    /// Depths of the receivers, metres.
    pub depth_m: Vec<f64>,
    /// Arrivals at each receiver, [depth, range], or at each pair of receivers that are
    /// no grid, in the order of their delays.
    pub at: Vec<Vec<Arrival>>,
}
