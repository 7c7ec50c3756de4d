//! A JSON value of a wall file, of limited size, as it stands there.

use std::cell::Cell;
use std::fmt;

use serde::de::{DeserializeSeed, Deserializer, Error, MapAccess, SeqAccess, Visitor};

/// Most values in one block, so that a block that goes wrong cannot fill the memory.
pub const MOST_VALUES: usize = 50_000;
/// Ids and vertex numbers are whole numbers that a double holds exactly.
const LARGEST_WHOLE: f64 = 9_007_199_254_740_991.0;

/// A JSON value as it stands in the file; keys may be repeated.
#[derive(Debug)]
pub enum Node {
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A list.
    List(Vec<Node>),
    /// An object.
    Object(Vec<(String, Node)>),
}

impl Node {
    /// What it is, for messages.
    pub fn told(&self) -> String {
        match self {
            Node::Null => "null".to_owned(),
            Node::Bool(b) => b.to_string(),
            Node::Number(x) => x.to_string(),
            Node::Text(text) => format!("{:?}", text.chars().take(40).collect::<String>()),
            Node::List(list) => format!("a list of {}", list.len()),
            Node::Object(_) => "an object".to_owned(),
        }
    }

    /// The whole number that it is, if it is one.
    pub fn whole(&self) -> Option<i64> {
        match *self {
            Node::Number(x) if x.abs() <= LARGEST_WHOLE && x.floor() == x => Some(x as i64),
            _ => None,
        }
    }
}

/// Reads a value; the cell holds how many values may still be read.
#[derive(Clone, Copy)]
pub struct NodeSeed<'a>(pub &'a Cell<usize>);

impl<'de> DeserializeSeed<'de> for NodeSeed<'_> {
    type Value = Node;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Node, D::Error> {
        let left = self.0.get();
        if left == 0 {
            return Err(D::Error::custom(format!("more than {MOST_VALUES} values in one block")));
        }
        self.0.set(left - 1);
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for NodeSeed<'_> {
    type Value = Node;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a JSON value")
    }

    fn visit_unit<E>(self) -> Result<Node, E> {
        Ok(Node::Null)
    }

    fn visit_bool<E>(self, value: bool) -> Result<Node, E> {
        Ok(Node::Bool(value))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Node, E> {
        Ok(Node::Number(value as f64))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Node, E> {
        Ok(Node::Number(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Node, E> {
        Ok(Node::Number(value))
    }

    fn visit_str<E>(self, value: &str) -> Result<Node, E> {
        Ok(Node::Text(value.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Node, A::Error> {
        let mut list = Vec::new();
        while let Some(item) = items.next_element_seed(self)? {
            list.push(item);
        }
        Ok(Node::List(list))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut entries: A) -> Result<Node, A::Error> {
        let mut object = Vec::new();
        while let Some(key) = entries.next_key::<String>()? {
            object.push((key, entries.next_value_seed(self)?));
        }
        Ok(Node::Object(object))
    }
}
