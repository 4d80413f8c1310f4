//! A graph in the making: values, the nodes that compute them, and constants.

/// Length of one dimension of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dimension {
    /// So many elements.
    Fixed(usize),
    /// As many as the caller brings; the same name means the same number.
    Any(&'static str),
}

/// A value of a graph: an input, a constant or what a node computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Value(pub(super) usize);

/// An attribute of a node.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// A whole number.
    Int(i64),
    /// Whole numbers.
    Ints(Vec<i64>),
}

/// A network under construction. All values are f32, but for the constants of
/// [`Graph::integers`] and what is compared.
///
/// ```
/// use sonarfleet_learning::files::onnx::{Dimension, Graph, Linear, Notes};
///
/// let mut graph = Graph::new("double");
/// let x = graph.input("x", &[Dimension::Any("batch"), Dimension::Fixed(1)]);
/// let layer = Linear { inputs: 1, outputs: 1, weights: &[2.0], bias: None };
/// let y = graph.linear(x, &layer);
/// graph.output(y, "y");
/// let bytes = graph.encode(&Notes::default());
/// # assert!(!bytes.is_empty());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    pub(super) name: String,
    pub(super) values: Vec<ValueInfo>,
    pub(super) inputs: Vec<Value>,
    pub(super) outputs: Vec<Value>,
    pub(super) constants: Vec<(Value, Elements)>,
    pub(super) nodes: Vec<Node>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct ValueInfo {
    pub(super) name: String,
    pub(super) shape: Vec<Dimension>,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Elements {
    F32(Vec<f32>),
    I64(Vec<i64>),
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) operator: &'static str,
    /// None where an optional input is left out.
    pub(super) inputs: Vec<Option<Value>>,
    /// None where an output is not wanted.
    pub(super) outputs: Vec<Option<Value>>,
    pub(super) attributes: Vec<(&'static str, Attribute)>,
}

impl Graph {
    /// An empty graph.
    pub fn new(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            values: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            constants: Vec::new(),
            nodes: Vec::new(),
        }
    }

    /// A named input.
    pub fn input(&mut self, name: &str, shape: &[Dimension]) -> Value {
        let input = self.value(name.to_owned(), shape.to_vec());
        self.inputs.push(input);
        input
    }

    /// A constant, last dimension fastest.
    ///
    /// # Panics
    /// Where the shape is not that of the elements.
    pub fn constant(&mut self, shape: &[usize], elements: Vec<f32>) -> Value {
        assert_eq!(
            shape.iter().product::<usize>(),
            elements.len(),
            "a shape must be its elements'"
        );
        self.any_constant(shape, Elements::F32(elements))
    }

    /// A constant vector of whole numbers, as operators want for axes and shapes.
    pub fn integers(&mut self, elements: Vec<i64>) -> Value {
        self.any_constant(&[elements.len()], Elements::I64(elements))
    }

    /// What an operator computes from inputs, with the shape that it has.
    pub fn node(
        &mut self,
        operator: &'static str,
        inputs: &[Value],
        attributes: Vec<(&'static str, Attribute)>,
        shape: Vec<Dimension>,
    ) -> Value {
        let name = format!("{}_{}", operator.to_lowercase(), self.nodes.len());
        let output = self.value(name, shape);
        let inputs = inputs.iter().copied().map(Some).collect();
        self.nodes.push(Node { operator, inputs, outputs: vec![Some(output)], attributes });
        output
    }

    /// Makes a computed value an output of the network, under this name.
    ///
    /// # Panics
    /// Where the value is not what a node computes, or is an output already.
    pub fn output(&mut self, value: Value, name: &str) {
        let computed = self.nodes.iter().any(|node| node.outputs.contains(&Some(value)));
        assert!(computed, "`{name}` must be what a node computes");
        assert!(!self.outputs.contains(&value), "`{name}` is an output already");
        name.clone_into(&mut self.values[value.0].name);
        self.outputs.push(value);
    }

    /// The shape of a value.
    pub fn shape(&self, value: Value) -> &[Dimension] {
        &self.values[value.0].shape
    }

    pub(super) fn value(&mut self, name: String, shape: Vec<Dimension>) -> Value {
        self.values.push(ValueInfo { name, shape });
        Value(self.values.len() - 1)
    }

    fn any_constant(&mut self, shape: &[usize], elements: Elements) -> Value {
        let shape = shape.iter().copied().map(Dimension::Fixed).collect();
        let value = self.value(format!("constant_{}", self.constants.len()), shape);
        self.constants.push((value, elements));
        value
    }
}
