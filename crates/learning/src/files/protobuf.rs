//! The protocol-buffer wire format (protobuf.dev/programming-guides/encoding), as far
//! as ONNX and TensorBoard need it: messages are written field by field.

/// A message in the making. Fields keep the order in which they are written.
#[derive(Debug, Clone, Default)]
pub(crate) struct Message {
    bytes: Vec<u8>,
}

/// How a field is stored.
#[derive(Clone, Copy)]
enum WireType {
    Varint = 0,
    Fixed64 = 1,
    LengthDelimited = 2,
    Fixed32 = 5,
}

impl Message {
    /// A field of type `int64`, `int32` or of an enumeration.
    pub(crate) fn int(&mut self, field: u32, value: i64) -> &mut Self {
        self.key(field, WireType::Varint);
        self.varint(value as u64); // two's complement: negative numbers take ten bytes
        self
    }

    /// A field of type `float`.
    pub(crate) fn float(&mut self, field: u32, value: f32) -> &mut Self {
        self.key(field, WireType::Fixed32);
        self.bytes.extend(value.to_le_bytes());
        self
    }

    /// A field of type `double`.
    pub(crate) fn double(&mut self, field: u32, value: f64) -> &mut Self {
        self.key(field, WireType::Fixed64);
        self.bytes.extend(value.to_le_bytes());
        self
    }

    /// A field of type `bytes`.
    pub(crate) fn bytes(&mut self, field: u32, value: &[u8]) -> &mut Self {
        self.key(field, WireType::LengthDelimited);
        self.varint(value.len() as u64);
        self.bytes.extend(value);
        self
    }

    /// A field of type `string`.
    pub(crate) fn text(&mut self, field: u32, value: &str) -> &mut Self {
        self.bytes(field, value.as_bytes())
    }

    /// A field that is itself a message.
    pub(crate) fn message(&mut self, field: u32, value: &Self) -> &mut Self {
        self.bytes(field, &value.bytes)
    }

    /// A field that is a message made on the spot.
    pub(crate) fn nested(
        &mut self,
        field: u32,
        write: impl FnOnce(&mut Self) -> &mut Self,
    ) -> &mut Self {
        let mut inner = Self::default();
        write(&mut inner);
        self.message(field, &inner)
    }

    /// The bytes of the message.
    pub(crate) fn into_bytes(self) -> Vec<u8> {
        self.bytes
    }

    fn key(&mut self, field: u32, wire_type: WireType) {
        self.varint(u64::from(field) << 3 | wire_type as u64);
    }

    /// Seven bits a byte, lowest first; the top bit says that more follow.
    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.bytes.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.bytes.push(value as u8);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The examples of the encoding guide, and the edges of a varint.
    #[test]
    fn fields_have_the_published_bytes() {
        let int = |value| Message::default().int(1, value).bytes.clone();
        assert_eq!(int(150), [0x08, 0x96, 0x01]);
        assert_eq!(int(0), [0x08, 0x00]);
        assert_eq!(int(127), [0x08, 0x7f]);
        assert_eq!(int(128), [0x08, 0x80, 0x01]);
        assert_eq!(int(16_384), [0x08, 0x80, 0x80, 0x01]);
        let minus_two = [0x08, 0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01];
        assert_eq!(int(-2), minus_two);
        let testing = [0x12, 0x07, 0x74, 0x65, 0x73, 0x74, 0x69, 0x6e, 0x67];
        assert_eq!(Message::default().text(2, "testing").bytes, testing);
        let nested = [0x1a, 0x03, 0x08, 0x96, 0x01];
        assert_eq!(Message::default().nested(3, |inner| inner.int(1, 150)).bytes, nested);
        // Field 16 is the first whose key takes two bytes.
        assert_eq!(Message::default().int(16, 1).bytes, [0x80, 0x01, 0x01]);
    }

    #[test]
    fn numbers_are_little_endian() {
        assert_eq!(Message::default().float(2, 1.0).bytes, [0x15, 0, 0, 0x80, 0x3f]);
        let minus_two = [0x09, 0, 0, 0, 0, 0, 0, 0, 0xc0];
        assert_eq!(Message::default().double(1, -2.0).bytes, minus_two);
    }
}
