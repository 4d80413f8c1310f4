//! Networks as ONNX files (onnx.ai), so that trained policies run wherever an ONNX
//! runtime does: operator set 17, IR version 8, written without the ONNX library.
//!
//! [`ActorCritic`], [`RecurrentPilot`] and [`PlacementNetwork`] are whole policies;
//! [`Graph`] builds any other network.

mod encode;
mod graph;
mod layers;
mod policies;

pub use encode::Notes;
pub use graph::{Attribute, Dimension, Graph, Value};
pub use layers::{Activation, Linear, Lstm};
pub use policies::{ActorCritic, PlacementNetwork, RecurrentPilot};
