/// How sound is spread across a beam (COA section 3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamShape {
    /// A triangle that reaches to the neighbouring beams: exact where rays are.
    Hat,
    /// A Gaussian of the same width, but not narrower than a few wavelengths:
    /// smooth, and finite at caustics.
    Gaussian,
}

/// Along what lines a beam is spread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BeamCoordinates {
    /// Down the column of receivers at a range.
    Cartesian,
    /// Across the ray.
    RayCentred,
}

/// What a beam looks like.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct BeamKind {
    /// Across itself.
    pub shape: BeamShape,
    /// How it meets receivers.
    pub coordinates: BeamCoordinates,
}

/// What is added up at a receiver.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coherence {
    /// Pressures, with their phases.
    Coherent,
    /// Intensities, with the surface image's interference kept at the source.
    SemiCoherent,
    /// Intensities.
    Incoherent,
}
