//! The head of a PLY file: how its numbers are written, and which of them belong to what.

use crate::exchange::fault::Fault;
use crate::exchange::mesh::quoted;

const ALLOWED: &str = "the head of a PLY file: ply, format, element, property and end_header, a line each";
/// Most kinds of items, and most numbers of an item.
const MOST_NAMES: usize = 1000;
const FIX: &str = "export it again as PLY, ascii or binary";

/// How numbers are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Coding {
    /// As words, an item per line.
    Words,
    /// As bytes, the lowest first.
    Little,
    /// As bytes, the highest first.
    Big,
}

/// What a number is in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Number {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Number {
    fn named(name: &str) -> Option<Number> {
        Some(match name {
            "char" | "int8" => Number::I8,
            "uchar" | "uint8" => Number::U8,
            "short" | "int16" => Number::I16,
            "ushort" | "uint16" => Number::U16,
            "int" | "int32" => Number::I32,
            "uint" | "uint32" => Number::U32,
            "float" | "float32" => Number::F32,
            "double" | "float64" => Number::F64,
            _ => return None,
        })
    }

    /// Bytes of one.
    pub(super) fn size(self) -> usize {
        match self {
            Number::I8 | Number::U8 => 1,
            Number::I16 | Number::U16 => 2,
            Number::I32 | Number::U32 | Number::F32 => 4,
            Number::F64 => 8,
        }
    }
}

/// A number of an item, or a list of numbers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) number: Number,
    /// What the count of a list is written as; `None` of a single number.
    pub(super) count: Option<Number>,
}

/// Items of a kind: the vertices, the faces.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: usize,
    pub(super) properties: Vec<Property>,
}

/// The head of a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub(super) coding: Coding,
    /// In the order in which their items follow.
    pub(super) elements: Vec<Element>,
    /// Bytes of the head.
    pub(super) size: usize,
    /// Lines of the head.
    pub(super) lines: usize,
}

impl Header {
    /// The items of a name.
    pub(super) fn element(&self, name: &str) -> Option<&Element> {
        self.elements.iter().find(|element| element.name == name)
    }

    /// The head at the beginning of a file.
    pub(super) fn of(bytes: &[u8]) -> Result<Header, Box<Fault>> {
        let mut header = Header { coding: Coding::Words, elements: Vec::new(), size: 0, lines: 0 };
        let mut coding = None;
        for line in bytes.split_inclusive(|byte| *byte == b'\n') {
            header.size += line.len();
            header.lines += 1;
            // Comments may be in any alphabet.
            let text = String::from_utf8_lossy(line);
            let words: Vec<&str> = text.split_ascii_whitespace().collect();
            match words[..] {
                ["ply"] if header.lines == 1 => {}
                _ if header.lines == 1 => break,
                ["comment" | "obj_info", ..] | [] => {}
                ["end_header"] => {
                    header.coding = coding.ok_or_else(|| fault(line, header.lines))?;
                    return Ok(header);
                }
                ["format", name, _] if coding.is_none() => coding = Some(coded(name, line, header.lines)?),
                _ => header.declare(&words).ok_or_else(|| fault(line, header.lines))?,
            }
        }
        let found = if header.lines > 1 || bytes == b"ply\n" {
            "its head has no line \"end_header\""
        } else {
            "it does not begin with the line \"ply\""
        };
        Err(Box::new(Fault::of("", found, ALLOWED, FIX).at(header.lines, 0)))
    }

    /// Notes an element or a property; `None` of any other line, and of one that is there already.
    fn declare(&mut self, words: &[&str]) -> Option<()> {
        let (name, property) = match *words {
            ["element", name, count] => {
                let fresh = self.element(name).is_none() && self.elements.len() < MOST_NAMES;
                let (name, count) = (name.to_owned(), count.parse().ok()?);
                return fresh.then(|| self.elements.push(Element { name, count, properties: Vec::new() }));
            }
            ["property", "list", count, number, name] => {
                let count = Number::named(count).filter(|own| !matches!(own, Number::F32 | Number::F64));
                (name, (Number::named(number)?, Some(count?)))
            }
            ["property", number, name] => (name, (Number::named(number)?, None)),
            _ => return None,
        };
        let own = &mut self.elements.last_mut()?.properties;
        let fresh = own.len() < MOST_NAMES && own.iter().all(|other| other.name != name);
        let (number, count) = property;
        fresh.then(|| own.push(Property { name: name.to_owned(), number, count }))
    }
}

fn coded(name: &str, line: &[u8], lines: usize) -> Result<Coding, Box<Fault>> {
    Ok(match name {
        "ascii" => Coding::Words,
        "binary_little_endian" => Coding::Little,
        "binary_big_endian" => Coding::Big,
        _ => return Err(fault(line, lines)),
    })
}

fn fault(line: &[u8], lines: usize) -> Box<Fault> {
    let found = match quoted(line) {
        text if text == "end_header" => "its head has no line \"format\"".to_owned(),
        text => format!("\"{text}\" is no line of its head, or is there twice"),
    };
    Box::new(Fault::of("", found, ALLOWED, FIX).at(lines, 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_head_says_what_follows_and_where() {
        let text = b"ply\r\nformat binary_big_endian 1.0\r\ncomment M\xfcller\r\nelement vertex 7\r\nproperty double x\r\nelement face 2\r\nproperty list uchar int32 vertex_index\r\nend_header\r\n\0\0";
        let header = Header::of(text).expect("a head");
        assert_eq!((header.coding, header.size, header.lines), (Coding::Big, text.len() - 2, 8));
        assert_eq!(header.element("vertex").expect("vertices").count, 7);
        let face = &header.element("face").expect("faces").properties[0];
        assert_eq!((face.count, face.number), (Some(Number::U8), Number::I32));
    }

    #[test]
    fn what_is_wrong_is_named_with_its_line() {
        for (text, line, found) in [
            ("", 0, "does not begin"),
            ("solid a\n", 1, "does not begin"),
            ("ply\nformat ascii 1.0\n", 2, "no line \"end_header\""),
            ("ply\nend_header\n", 2, "no line \"format\""),
            ("ply\nformat text 1.0\n", 2, "format text"),
            ("ply\nformat ascii 1.0\nproperty float x\n", 3, "property float x"),
            ("ply\nformat ascii 1.0\nelement vertex -1\n", 3, "element vertex -1"),
            ("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int x\n", 4, "list float"),
            ("ply\nformat ascii 1.0\nelement vertex 1\nelement vertex 1\n", 4, "twice"),
            ("ply\nformat ascii 1.0\nelement a 1\nproperty int x\nproperty int x\n", 5, "twice"),
        ] {
            let fault = Header::of(text.as_bytes()).expect_err(text);
            assert!(fault.line == line && fault.found.contains(found), "{fault:?}");
        }
    }
}
