//! Networks small enough to train on a laptop's processor. All weights of a network
//! lie in one flat slice, which is what optimisers, checkpoints and exports see.

mod adam;

pub use adam::{Adam, clip_gradient};
