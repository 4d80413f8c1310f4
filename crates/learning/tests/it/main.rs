//! The tests of the crate as a whole.

mod ocean;
mod onnx;
mod paper;
mod ppo;
mod transferable;
