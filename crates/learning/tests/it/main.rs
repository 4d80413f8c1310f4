//! The tests of the crate as a whole.

mod onnx;
mod ocean;
mod paper;
mod ppo;
mod transferable;
