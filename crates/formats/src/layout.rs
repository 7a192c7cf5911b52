//! Layout of the JSON in Shagreen files: one line per object that a person looks for, and long arrays of numbers on one
//! line. A text diff of two versions then shows what changed.

use std::io;

use serde::Serialize;
use serde_json::ser::{Formatter, Serializer};

/// Serializes `value` as JSON with a final line feed. Objects and arrays nested deeper than `open_depth` stay on one
/// line.
pub(crate) fn to_bytes(value: &impl Serialize, open_depth: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    let written =
        value.serialize(&mut Serializer::with_formatter(&mut bytes, Layout { depth: 0, open_depth }));
    // Writing to memory cannot fail, keys are strings, and non-finite numbers become null.
    assert!(written.is_ok(), "cannot serialize to JSON: {written:?}");
    bytes.push(b'\n');
    bytes
}

struct Layout {
    depth: usize,
    open_depth: usize,
}

impl Layout {
    fn is_open(&self) -> bool {
        self.depth <= self.open_depth
    }

    fn new_line<W: ?Sized + io::Write>(&self, writer: &mut W) -> io::Result<()> {
        writer.write_all(b"\n")?;
        (0..self.depth).try_for_each(|_| writer.write_all(b" "))
    }

    fn begin<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        self.depth += 1;
        writer.write_all(bracket)
    }

    fn end<W: ?Sized + io::Write>(&mut self, writer: &mut W, bracket: &[u8]) -> io::Result<()> {
        let was_open = self.is_open();
        self.depth -= 1;
        if was_open {
            self.new_line(writer)?;
        }
        writer.write_all(bracket)
    }

    fn item<W: ?Sized + io::Write>(&self, writer: &mut W, first: bool) -> io::Result<()> {
        if !first {
            writer.write_all(b",")?;
        }
        if self.is_open() { self.new_line(writer) } else { Ok(()) }
    }
}

impl Formatter for Layout {
    fn begin_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"[")
    }

    fn end_array<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"]")
    }

    fn begin_array_value<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first)
    }

    fn begin_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.begin(writer, b"{")
    }

    fn end_object<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        self.end(writer, b"}")
    }

    fn begin_object_key<W: ?Sized + io::Write>(&mut self, writer: &mut W, first: bool) -> io::Result<()> {
        self.item(writer, first)
    }

    fn begin_object_value<W: ?Sized + io::Write>(&mut self, writer: &mut W) -> io::Result<()> {
        writer.write_all(if self.is_open() { b": " } else { b":" })
    }
}

#[cfg(test)]
mod tests {
    use super::to_bytes;
    use serde_json::json;

    #[test]
    fn deep_values_stand_on_one_line() {
        let value = json!({"a": [{"b": [{"c": [1.5, 2], "d": 3}], "e": "x"}], "f": {}});
        let expected = "{\n \"a\": [\n  {\n   \"b\": [\n    {\"c\":[1.5,2],\"d\":3}\n   ],\n   \"e\": \"x\"\n  }\n ],\n \"f\": {\n }\n}\n";
        assert_eq!(String::from_utf8(to_bytes(&value, 4)).unwrap(), expected);
        assert_eq!(serde_json::from_slice::<serde_json::Value>(&to_bytes(&value, 4)).unwrap(), value);
    }
}
