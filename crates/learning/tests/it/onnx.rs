//! ONNX files read back with a walker of the wire format that shares nothing with
//! the writer; field numbers are those of onnx.proto.

use sonarfleet_learning::files::onnx::{
    Activation, ActorCritic, Linear, Lstm, Notes, PlacementNetwork, RecurrentPilot,
};
use std::collections::BTreeSet;

/// A message as its fields, in order.
struct Message<'a>(Vec<(u64, Field<'a>)>);

#[derive(Clone, Copy)]
enum Field<'a> {
    Number(u64),
    Bytes(&'a [u8]),
}

fn varint(bytes: &mut &[u8]) -> u64 {
    let mut value = 0;
    for shift in (0..64).step_by(7) {
        let (&byte, rest) = bytes.split_first().expect("a varint ends");
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            return value;
        }
    }
    panic!("a varint has at most ten bytes");
}

impl<'a> Message<'a> {
    fn read(mut bytes: &'a [u8]) -> Self {
        let mut fields = Vec::new();
        while !bytes.is_empty() {
            let key = varint(&mut bytes);
            let field = match key & 7 {
                0 => Field::Number(varint(&mut bytes)),
                2 => {
                    let length = varint(&mut bytes) as usize;
                    let (value, rest) = bytes.split_at(length);
                    bytes = rest;
                    Field::Bytes(value)
                }
                other => panic!("wire type {other} has no place in our files"),
            };
            fields.push((key >> 3, field));
        }
        Self(fields)
    }

    fn all(&self, number: u64) -> impl Iterator<Item = Field<'a>> {
        self.0.iter().filter(move |(field, _)| *field == number).map(|&(_, field)| field)
    }

    fn messages(&self, number: u64) -> Vec<Self> {
        self.bytes(number).into_iter().map(Self::read).collect()
    }

    fn bytes(&self, number: u64) -> Vec<&'a [u8]> {
        let bytes = |field| match field {
            Field::Bytes(bytes) => bytes,
            Field::Number(value) => panic!("field {number} is the number {value}"),
        };
        self.all(number).map(bytes).collect()
    }

    fn texts(&self, number: u64) -> Vec<&'a str> {
        self.bytes(number).into_iter().map(|text| std::str::from_utf8(text).unwrap()).collect()
    }

    fn text(&self, number: u64) -> &'a str {
        let texts = self.texts(number);
        assert_eq!(texts.len(), 1, "field {number} stands once");
        texts[0]
    }

    fn numbers(&self, number: u64) -> Vec<u64> {
        let value = |field| match field {
            Field::Number(value) => value,
            Field::Bytes(bytes) => panic!("field {number} is {} bytes", bytes.len()),
        };
        self.all(number).map(value).collect()
    }

    /// Of a `ValueInfoProto` of floats: its name and shape, such as `x[batch,3]`.
    fn described(&self) -> String {
        let tensor = &self.messages(2)[0].messages(1)[0];
        assert_eq!(tensor.numbers(1), [1], "FLOAT");
        let lengths: Vec<String> = tensor.messages(2)[0]
            .messages(1)
            .iter()
            .map(|dimension| match dimension.numbers(1)[..] {
                [length] => length.to_string(),
                _ => dimension.text(2).to_owned(),
            })
            .collect();
        format!("{}[{}]", self.text(1), lengths.join(","))
    }
}

/// Checks what holds for every file, and gives the graph and its operators.
fn graph(bytes: &[u8]) -> (Message<'_>, Vec<&str>) {
    let model = Message::read(bytes);
    assert_eq!(model.numbers(1), [8], "IR version");
    assert_eq!(model.text(2), "sonarfleet");
    let set = &model.messages(8)[0];
    assert_eq!((set.text(1), set.numbers(2)), ("", vec![17]), "operator set");
    let graph = model.messages(7).pop().unwrap();
    let mut known: BTreeSet<&str> = BTreeSet::new();
    for tensor in graph.messages(5) {
        let elements: u64 = tensor.numbers(1).iter().product();
        let size = if tensor.numbers(2) == [1] { 4 } else { 8 };
        assert_eq!(tensor.bytes(9)[0].len() as u64, elements * size, "{}", tensor.text(8));
        assert!(known.insert(tensor.text(8)));
    }
    for input in graph.messages(11) {
        assert!(known.insert(input.text(1)));
    }
    let mut operators = Vec::new();
    for node in graph.messages(1) {
        for input in node.texts(1) {
            assert!(input.is_empty() || known.contains(input), "`{input}` comes before its use");
        }
        for output in node.texts(2) {
            assert!(output.is_empty() || known.insert(output), "`{output}` is computed once");
        }
        operators.push(node.text(4));
    }
    for output in graph.messages(12) {
        assert!(known.contains(output.text(1)));
    }
    (graph, operators)
}

fn described(graph: &Message, field: u64) -> Vec<String> {
    graph.messages(field).iter().map(Message::described).collect()
}

fn floats(tensor: &Message) -> Vec<f32> {
    tensor.bytes(9)[0].as_chunks().0.iter().map(|&bytes| f32::from_le_bytes(bytes)).collect()
}

fn ramp(count: usize) -> Vec<f32> {
    (0..count).map(|index| index as f32 - 2.5).collect()
}

#[test]
fn an_actor_critic_is_written_whole() {
    let (w1, b1, w2, w3) = (ramp(15), ramp(3), ramp(15), ramp(3));
    let linear = |inputs, outputs, weights| Linear { inputs, outputs, weights, bias: None };
    let network = ActorCritic {
        hidden: &[Linear { bias: Some(&b1), ..linear(5, 3, &w1) }],
        activation: Activation::Relu,
        actor: linear(3, 5, &w2),
        critic: linear(3, 1, &w3),
    };
    let properties = [("command", "sonarfleet train"), ("seed", "7")];
    let bytes = network.to_onnx(&Notes { description: "τ 0.95", properties: &properties });
    let model = Message::read(&bytes);
    assert_eq!(model.text(6), "τ 0.95");
    let facts = model.messages(14);
    assert_eq!((facts[1].text(1), facts[1].text(2)), ("seed", "7"));

    let (graph, operators) = graph(&bytes);
    assert_eq!(operators, ["Gemm", "Relu", "Gemm", "Greater", "Where", "Gemm", "Squeeze"]);
    assert_eq!(described(&graph, 11), ["occupancy[batch,5]", "mask[batch,5]"]);
    assert_eq!(described(&graph, 12), ["logits[batch,5]", "value[batch]"]);
    let gemm = &graph.messages(1)[0];
    let attribute = &gemm.messages(5)[0];
    let held = (attribute.text(1), attribute.numbers(3), attribute.numbers(20));
    assert_eq!(held, ("transB", vec![1], vec![2]), "an INT");
    let by_name = |name| {
        let held = graph.messages(5).into_iter().find(|tensor| tensor.text(8) == name).unwrap();
        (held.numbers(1), floats(&held))
    };
    assert_eq!(by_name(gemm.texts(1)[1]), (vec![3, 5], w1.clone()));
    assert_eq!(by_name(gemm.texts(1)[2]), (vec![3], b1.clone()));
}

#[test]
fn gates_of_the_memory_stand_in_the_order_of_onnx() {
    let (w, r, b) = (ramp(12), ramp(16), ramp(8)); // 3 inputs, 2 units
    let lstm = Lstm {
        inputs: 3,
        hidden: 2,
        input_weights: &[&w[..], &w].concat(),
        hidden_weights: &r,
        bias: &b,
    };
    let heads = ramp(2);
    let pilot = RecurrentPilot {
        hidden: &[],
        activation: Activation::Tanh,
        lstm,
        actor: Linear { inputs: 2, outputs: 1, weights: &heads, bias: None },
        critic: Linear { inputs: 2, outputs: 1, weights: &heads, bias: None },
    };
    let bytes = pilot.to_onnx(&Notes::default());
    let (graph, operators) = graph(&bytes);
    assert_eq!(operators[..4], ["Unsqueeze", "Unsqueeze", "Unsqueeze", "LSTM"]);
    assert_eq!(described(&graph, 11), ["observation[batch,3]", "hidden[batch,2]", "cell[batch,2]"]);
    assert_eq!(
        described(&graph, 12),
        ["logits[batch,1]", "value[batch]", "hidden_out[batch,2]", "cell_out[batch,2]"]
    );
    let node = &graph.messages(1)[3];
    assert_eq!(node.texts(1)[4], "", "no sequence lengths");
    assert_eq!(node.texts(2)[0], "", "only the last state");
    let name = node.texts(1)[3];
    let biases = graph.messages(5).into_iter().find(|tensor| tensor.text(8) == name).unwrap();
    assert_eq!(biases.numbers(1), [1, 16]);
    // Input, output, forget, candidate; then no second bias.
    let expected = [&b[0..2], &b[6..8], &b[2..4], &b[4..6], &[0.0; 8]].concat();
    assert_eq!(floats(&biases), expected);
}

#[test]
fn a_layer_over_candidates_is_a_transposed_product() {
    let (w1, w2, w3, b) = (ramp(6), ramp(12), ramp(4), ramp(1));
    let linear = |inputs, outputs, weights| Linear { inputs, outputs, weights, bias: None };
    let network = PlacementNetwork {
        first: linear(2, 3, &w1),
        second: linear(3, 4, &w2),
        context: linear(3, 4, &w2),
        last: Linear { bias: Some(&b), ..linear(4, 1, &w3) },
    };
    let bytes = network.to_onnx(&Notes::default());
    let (graph, operators) = graph(&bytes);
    assert_eq!(
        operators,
        [
            "MatMul",
            "Relu",
            "ReduceMean",
            "MatMul",
            "MatMul",
            "Add",
            "Relu",
            "MatMul",
            "Add",
            "Squeeze"
        ]
    );
    assert_eq!(described(&graph, 11), ["features[batch,candidates,2]"]);
    assert_eq!(described(&graph, 12), ["logits[batch,candidates]"]);
    let first = &graph.messages(5)[0];
    assert_eq!(first.numbers(1), [2, 3]);
    assert_eq!(floats(first), [w1[0], w1[2], w1[4], w1[1], w1[3], w1[5]]);
    let axes = &graph.messages(1)[2].messages(5)[0];
    assert_eq!((axes.text(1), axes.numbers(8), axes.numbers(20)), ("axes", vec![1], vec![7]));
}

#[test]
#[should_panic(expected = "weights are [output, input]")]
fn weights_must_be_as_many_as_the_sizes_say() {
    let weights = ramp(5);
    let layer = Linear { inputs: 2, outputs: 3, weights: &weights, bias: None };
    let network = PlacementNetwork { first: layer, second: layer, context: layer, last: layer };
    network.to_onnx(&Notes::default());
}
