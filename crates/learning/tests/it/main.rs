//! The tests of the crate as a whole.

mod onnx;
