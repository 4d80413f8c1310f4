//! Networks small enough to train on a laptop's processor. All weights of a network
//! lie in one flat slice, which is what optimisers, checkpoints and exports see.

mod actor_critic;
mod adam;
mod categorical;
mod heads;
mod linear;
mod matrix;
mod mlp;
mod orthogonal;
mod sparse;
pub(crate) mod vector;

pub use actor_critic::{ActorCritic, Batch, Output, Sequence};
pub use adam::{Adam, clip_gradient};
pub(crate) use categorical::apply_mask;
pub use categorical::{Categorical, MASKED_LOGIT};
pub use linear::Linear;
pub use mlp::{Mlp, MlpActivations};
pub use orthogonal::orthogonal;
