//! The tests of the crate as a whole.

mod ocean;
mod paper;
mod ppo;
