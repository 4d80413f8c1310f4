//! The ray engine: exact parabolas from cell to cell.
//!
//! In every cell of the section (an interval of depth levels × an interval of
//! range nodes) the gradient of 1/c² is taken constant. With the slowness
//! p = (cos α, sin α)/c, z down, and dσ = c ds, a ray is then
//!
//! x(σ) = x₀ + p₀σ + ½Gσ²,  p(σ) = p₀ + Gσ,  G = ½∇(1/c²),
//!
//! so that levels, range nodes and the straight pieces of the sea floor are met
//! at the roots of quadratics: there is no step size. What a ray carries to
//! measure the tube around it, δx = ∂x/∂α and δp = ∂p/∂α at constant σ, is
//! linear in σ and changes at interfaces and reflections (see `tracer`).

mod crossing;
mod lattice;
mod levels;
mod medium;
mod segment;
mod trace;
mod tracer;

pub(crate) use lattice::Lattice;
pub(crate) use medium::{Medium, MediumLimits};
pub(crate) use segment::{Pair, Segment, SegmentSink};
pub(crate) use trace::record;
pub use trace::{Ray, RayPoint, trace};
pub use tracer::RayEnd;
pub(crate) use tracer::{Launch, Tracer};
