//! The layers that policies are made of.

use super::graph::{Attribute, Dimension, Graph, Node, Value};

/// Added to the logits of masked actions, as in training: their probability is 0.
const MASKED_LOGIT: f32 = -1e6;

/// A fully connected layer, y = W·x + b.
#[derive(Debug, Clone, Copy)]
pub struct Linear<'a> {
    /// Length of x.
    pub inputs: usize,
    /// Length of y.
    pub outputs: usize,
    /// W, [output, input].
    pub weights: &'a [f32],
    /// b, one per output; none is zero.
    pub bias: Option<&'a [f32]>,
}

/// A layer of long short-term memory (Hochreiter & Schmidhuber 1997,
/// doi:10.1162/neco.1997.9.8.1735), with the gates in PyTorch's order: input, forget,
/// candidate, output.
#[derive(Debug, Clone, Copy)]
pub struct Lstm<'a> {
    /// Length of the input.
    pub inputs: usize,
    /// Length of the state.
    pub hidden: usize,
    /// Weights of the input, [4 gates · hidden, input].
    pub input_weights: &'a [f32],
    /// Weights of the state, [4 gates · hidden, hidden].
    pub hidden_weights: &'a [f32],
    /// Bias, [4 gates · hidden]; the sum where a framework keeps two.
    pub bias: &'a [f32],
}

/// What bends a hidden layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Activation {
    /// max(x, 0).
    Relu,
    /// tanh x.
    Tanh,
}

impl Graph {
    /// A fully connected layer over the last dimension.
    ///
    /// # Panics
    /// Where a slice or the value is not as long as the layer's sizes say.
    pub fn linear(&mut self, x: Value, layer: &Linear) -> Value {
        let Linear { inputs, outputs, weights, bias } = *layer;
        assert_eq!(weights.len(), outputs * inputs, "weights are [output, input]");
        assert!(bias.is_none_or(|bias| bias.len() == outputs), "the bias is [output]");
        let mut shape = self.shape(x).to_vec();
        let last = shape.last_mut().expect("a layer needs a dimension to work on");
        assert_eq!(*last, Dimension::Fixed(inputs), "the layer must fit what goes in");
        *last = Dimension::Fixed(outputs);
        let bias = bias.map(|bias| self.constant(&[outputs], bias.to_vec()));
        if shape.len() == 2 {
            let weights = self.constant(&[outputs, inputs], weights.to_vec());
            let operands: Vec<Value> = [x, weights].into_iter().chain(bias).collect();
            return self.node("Gemm", &operands, vec![("transB", Attribute::Int(1))], shape);
        }
        // Gemm knows matrices only; MatMul wants [input, output].
        let transposed = (0..inputs)
            .flat_map(|input| (0..outputs).map(move |output| weights[output * inputs + input]))
            .collect();
        let weights = self.constant(&[inputs, outputs], transposed);
        let product = self.node("MatMul", &[x, weights], vec![], shape);
        bias.map_or(product, |bias| self.add(product, bias))
    }

    /// Bends every element.
    pub fn activation(&mut self, x: Value, activation: Activation) -> Value {
        let operator = match activation {
            Activation::Relu => "Relu",
            Activation::Tanh => "Tanh",
        };
        let shape = self.shape(x).to_vec();
        self.node(operator, &[x], vec![], shape)
    }

    /// The sum; where a dimension of one has the length 1 (or is missing in front), it
    /// is repeated along the other's.
    ///
    /// # Panics
    /// Where the shapes do not fit.
    pub fn add(&mut self, x: Value, y: Value) -> Value {
        let shape = broadcast(self.shape(x), self.shape(y));
        self.node("Add", &[x, y], vec![], shape)
    }

    /// The mean along an axis, which keeps the length 1.
    ///
    /// # Panics
    /// Where there is no such axis.
    pub fn mean(&mut self, x: Value, axis: usize) -> Value {
        let mut shape = self.shape(x).to_vec();
        shape[axis] = Dimension::Fixed(1);
        let attributes =
            vec![("axes", Attribute::Ints(vec![axis as i64])), ("keepdims", Attribute::Int(1))];
        self.node("ReduceMean", &[x], attributes, shape)
    }

    /// Values one after the other along their last dimension.
    ///
    /// # Panics
    /// Where there are none, or a last dimension is not of a fixed length.
    pub fn concat(&mut self, values: &[Value]) -> Value {
        let length = |value: &Value| match self.shape(*value).last() {
            Some(Dimension::Fixed(length)) => *length,
            other => panic!("concatenation wants fixed lengths, not {other:?}"),
        };
        let together = values.iter().map(length).sum();
        let mut shape = self.shape(values[0]).to_vec();
        let axis = shape.len() - 1;
        shape[axis] = Dimension::Fixed(together);
        self.node("Concat", values, vec![("axis", Attribute::Int(axis as i64))], shape)
    }

    /// Probabilities from logits, along the last dimension.
    pub fn softmax(&mut self, logits: Value) -> Value {
        let shape = self.shape(logits).to_vec();
        self.node("Softmax", &[logits], vec![("axis", Attribute::Int(-1))], shape)
    }

    /// Logits that allow only the actions whose mask is 1: all others are −10⁶.
    ///
    /// # Panics
    /// Where mask and logits have other shapes.
    pub fn masked(&mut self, logits: Value, mask: Value) -> Value {
        let shape = self.shape(logits).to_vec();
        assert_eq!(shape, self.shape(mask), "a mask says something of every action");
        let half = self.constant(&[], vec![0.5]);
        let allowed = self.node("Greater", &[mask, half], vec![], shape.clone());
        let never = self.constant(&[], vec![MASKED_LOGIT]);
        self.node("Where", &[allowed, logits, never], vec![], shape)
    }

    /// Drops an axis of length 1.
    ///
    /// # Panics
    /// Where the axis has another length.
    pub fn squeeze(&mut self, x: Value, axis: usize) -> Value {
        let mut shape = self.shape(x).to_vec();
        assert_eq!(shape.remove(axis), Dimension::Fixed(1), "only a length of 1 can be dropped");
        let axes = self.integers(vec![axis as i64]);
        self.node("Squeeze", &[x, axes], vec![], shape)
    }

    /// Adds an axis of length 1.
    ///
    /// # Panics
    /// Where the value has too few dimensions for it.
    pub fn unsqueeze(&mut self, x: Value, axis: usize) -> Value {
        let mut shape = self.shape(x).to_vec();
        shape.insert(axis, Dimension::Fixed(1));
        let axes = self.integers(vec![axis as i64]);
        self.node("Unsqueeze", &[x, axes], vec![], shape)
    }

    /// One step of an LSTM: from the input [batch, inputs] and the state before it to
    /// the state after it, (hidden, cell), all [batch, hidden].
    ///
    /// # Panics
    /// Where a slice or a value is not as long as the layer's sizes say.
    pub fn lstm(&mut self, x: Value, hidden: Value, cell: Value, layer: &Lstm) -> (Value, Value) {
        let Lstm { inputs, hidden: width, input_weights, hidden_weights, bias } = *layer;
        assert_eq!(input_weights.len(), 4 * width * inputs, "weights are [gate, input]");
        assert_eq!(hidden_weights.len(), 4 * width * width, "weights are [gate, hidden]");
        assert_eq!(bias.len(), 4 * width, "the bias is [gate]");
        let state = self.shape(hidden).to_vec();
        assert_eq!(state[1..], [Dimension::Fixed(width)], "the state is [batch, hidden]");
        assert_eq!(state, self.shape(cell), "cell and hidden state have one shape");
        assert_eq!(self.shape(x)[1..], [Dimension::Fixed(inputs)], "the input is [batch, inputs]");
        let w = self.constant(&[1, 4 * width, inputs], onnx_gates(input_weights));
        let r = self.constant(&[1, 4 * width, width], onnx_gates(hidden_weights));
        let mut biases = onnx_gates(bias); // of the input, then of the state
        biases.resize(8 * width, 0.0);
        let b = self.constant(&[1, 8 * width], biases);
        // A sequence of one step, in one direction.
        let [x, hidden, cell] = [x, hidden, cell].map(|value| self.unsqueeze(value, 0));
        let number = self.nodes.len();
        let shape = self.shape(hidden).to_vec();
        let hidden_out = self.value(format!("lstm_{number}_hidden"), shape.clone());
        let cell_out = self.value(format!("lstm_{number}_cell"), shape);
        self.nodes.push(Node {
            operator: "LSTM",
            inputs: vec![Some(x), Some(w), Some(r), Some(b), None, Some(hidden), Some(cell)],
            outputs: vec![None, Some(hidden_out), Some(cell_out)],
            attributes: vec![("hidden_size", Attribute::Int(width as i64))],
        });
        (self.squeeze(hidden_out, 0), self.squeeze(cell_out, 0))
    }
}

/// Rows of the gates input, forget, candidate, output in ONNX's order: input, output,
/// forget, candidate.
fn onnx_gates(rows: &[f32]) -> Vec<f32> {
    let gate = |number: usize| &rows[rows.len() / 4 * number..rows.len() / 4 * (number + 1)];
    [0, 3, 1, 2].map(gate).concat()
}

fn broadcast(x: &[Dimension], y: &[Dimension]) -> Vec<Dimension> {
    const ONE: Dimension = Dimension::Fixed(1);
    let rank = x.len().max(y.len());
    let at = |shape: &[Dimension], axis: usize| {
        (axis + shape.len()).checked_sub(rank).map_or(ONE, |axis| shape[axis])
    };
    (0..rank)
        .map(|axis| match (at(x, axis), at(y, axis)) {
            (ONE, other) | (other, ONE) => other,
            (one, other) => {
                assert_eq!(one, other, "shapes must fit");
                one
            }
        })
        .collect()
}
