//! A graph as the bytes of an ONNX file; field numbers are those of onnx.proto.

use super::graph::{Attribute, Dimension, Elements, Graph, Node, Value};
use crate::files::protobuf::Message;

/// IR version of 2022, which any runtime of the last years reads.
const IR_VERSION: i64 = 8;
const OPERATOR_SET: i64 = 17;

/// `TensorProto.DataType`.
const FLOAT: i64 = 1;
const INT64: i64 = 7;
/// `AttributeProto.AttributeType`.
const INT: i64 = 2;
const INTS: i64 = 7;

/// What a file says about itself besides its graph.
#[derive(Debug, Clone, Copy, Default)]
pub struct Notes<'a> {
    /// What the network is, in words.
    pub description: &'a str,
    /// Further facts by name, such as the command and seed of the training.
    pub properties: &'a [(&'a str, &'a str)],
}

impl Graph {
    /// The bytes of an ONNX file.
    pub fn encode(&self, notes: &Notes) -> Vec<u8> {
        let mut model = Message::default();
        model
            .int(1, IR_VERSION)
            .text(2, "sonarfleet")
            .text(3, env!("CARGO_PKG_VERSION"))
            .text(6, notes.description)
            .message(7, &self.message())
            .nested(8, |set| set.text(1, "").int(2, OPERATOR_SET));
        for (key, value) in notes.properties {
            model.nested(14, |property| property.text(1, key).text(2, value));
        }
        model.into_bytes()
    }

    fn message(&self) -> Message {
        let mut graph = Message::default();
        for node in &self.nodes {
            graph.message(1, &self.node_message(node));
        }
        graph.text(2, &self.name);
        for (value, elements) in &self.constants {
            graph.message(5, &self.tensor(*value, elements));
        }
        for &input in &self.inputs {
            graph.message(11, &self.value_info(input));
        }
        for &output in &self.outputs {
            graph.message(12, &self.value_info(output));
        }
        graph
    }

    fn node_message(&self, node: &Node) -> Message {
        let mut message = Message::default();
        for &input in &node.inputs {
            message.text(1, self.name_of(input));
        }
        for &output in &node.outputs {
            message.text(2, self.name_of(output));
        }
        message.text(4, node.operator);
        for (name, attribute) in &node.attributes {
            message.nested(5, |inner| {
                inner.text(1, name);
                match attribute {
                    Attribute::Int(number) => inner.int(3, *number).int(20, INT),
                    Attribute::Ints(numbers) => {
                        for &number in numbers {
                            inner.int(8, number);
                        }
                        inner.int(20, INTS)
                    }
                }
            });
        }
        message
    }

    /// The empty name stands for what is left out.
    fn name_of(&self, value: Option<Value>) -> &str {
        value.map_or("", |value| &self.values[value.0].name)
    }

    fn tensor(&self, value: Value, elements: &Elements) -> Message {
        let mut tensor = Message::default();
        for dimension in self.shape(value) {
            if let Dimension::Fixed(length) = dimension {
                tensor.int(1, *length as i64);
            }
        }
        let (kind, raw): (i64, Vec<u8>) = match elements {
            Elements::F32(numbers) => {
                (FLOAT, numbers.iter().flat_map(|x| x.to_le_bytes()).collect())
            }
            Elements::I64(numbers) => {
                (INT64, numbers.iter().flat_map(|x| x.to_le_bytes()).collect())
            }
        };
        tensor.int(2, kind).text(8, self.name_of(Some(value))).bytes(9, &raw);
        tensor
    }

    fn value_info(&self, value: Value) -> Message {
        let mut shape = Message::default();
        for dimension in self.shape(value) {
            shape.nested(1, |inner| match dimension {
                Dimension::Fixed(length) => inner.int(1, *length as i64),
                Dimension::Any(name) => inner.text(2, name),
            });
        }
        let mut info = Message::default();
        info.text(1, self.name_of(Some(value)))
            .nested(2, |kind| kind.nested(1, |tensor| tensor.int(1, FLOAT).message(2, &shape)));
        info
    }
}
