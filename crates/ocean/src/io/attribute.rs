//! Attributes of files and variables.

use std::fmt;

/// A named attribute of a file or a variable.
#[derive(Debug, Clone, PartialEq)]
pub struct Attribute {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: AttributeValue,
}

/// The value of an attribute. Numbers keep their type, for `_FillValue` must have its
/// variable's.
#[derive(Debug, Clone, PartialEq)]
pub enum AttributeValue {
    /// Text.
    Text(String),
    /// 32-bit floats.
    F32(Vec<f32>),
    /// 64-bit floats; also what other numbers are read as.
    F64(Vec<f64>),
    /// 16-bit integers.
    I16(Vec<i16>),
    /// 32-bit integers.
    I32(Vec<i32>),
}

impl Attribute {
    /// An attribute that is text.
    pub fn text(name: &str, value: impl Into<String>) -> Self {
        Self { name: name.to_owned(), value: AttributeValue::Text(value.into()) }
    }

    /// An attribute that is one 64-bit number.
    pub fn number(name: &str, value: f64) -> Self {
        Self { name: name.to_owned(), value: AttributeValue::F64(vec![value]) }
    }
}

impl AttributeValue {
    /// The text, if it is one.
    pub fn as_text(&self) -> Option<&str> {
        match self {
            Self::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The first number, if it is one.
    pub fn as_number(&self) -> Option<f64> {
        match self {
            Self::Text(_) => None,
            Self::F32(values) => values.first().map(|&value| f64::from(value)),
            Self::F64(values) => values.first().copied(),
            Self::I16(values) => values.first().map(|&value| f64::from(value)),
            Self::I32(values) => values.first().map(|&value| f64::from(value)),
        }
    }
}

impl fmt::Display for AttributeValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fn join<T: fmt::Display>(f: &mut fmt::Formatter<'_>, values: &[T]) -> fmt::Result {
            for (i, value) in values.iter().enumerate() {
                write!(f, "{}{value}", if i > 0 { ", " } else { "" })?;
            }
            Ok(())
        }
        match self {
            Self::Text(text) => f.write_str(text),
            Self::F32(values) => join(f, values),
            Self::F64(values) => join(f, values),
            Self::I16(values) => join(f, values),
            Self::I32(values) => join(f, values),
        }
    }
}

/// The attribute of a name, in a list.
pub(crate) fn find<'a>(attributes: &'a [Attribute], name: &str) -> Option<&'a AttributeValue> {
    attributes.iter().find(|attribute| attribute.name == name).map(|attribute| &attribute.value)
}
