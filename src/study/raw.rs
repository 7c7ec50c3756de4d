//! The raw tree of a TOML file: every value with its place in the file.

use std::collections::BTreeMap;
use std::sync::Arc;

use toml::de::{DeTable, DeValue};

use crate::study::fault::{Fault, Found, Place, Source};

/// What a file is meant to be.
pub const FORMAT: &str = "a text file in TOML";

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The value.
    pub value: Value,
    /// Where it stands.
    pub place: Place,
    /// The value as written, in one short line.
    pub shown: String,
}

/// A TOML value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A string.
    Text(String),
    /// An integer; wider than TOML's own, so that every 64-bit seed can be written.
    Whole(i128),
    /// A float, possibly not finite.
    Real(f64),
    /// true or false.
    Flag(bool),
    /// A date or a time: no key takes one.
    Date,
    /// An array.
    List(Vec<Node>),
    /// A table.
    Table(Table),
}

/// Keys of a table.
pub type Table = BTreeMap<String, Entry>;

/// A key with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// Where the key stands.
    pub key_place: Place,
    /// Its value.
    pub node: Node,
}

impl Value {
    /// The kind of value, in words.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::Text(_) => "a string",
            Value::Whole(_) => "a whole number",
            Value::Real(_) => "a number",
            Value::Flag(_) => "true or false",
            Value::Date => "a date",
            Value::List(_) => "a list",
            Value::Table(_) => "a table",
        }
    }
}

impl Node {
    /// An empty table at a place, for a table that the file does not have.
    pub fn empty_table(place: &Place) -> Node {
        Node { value: Value::Table(Table::new()), place: place.clone(), shown: "{}".to_owned() }
    }
}

/// Parses a whole file.
///
/// # Errors
/// The first fault of its syntax.
pub fn parse(source: &Arc<Source>) -> Result<Node, Box<Fault>> {
    let table = DeTable::parse(&source.text).map_err(|error| {
        let place = Place { source: source.clone(), span: error.span().unwrap_or(0..0) };
        let words = format!("cannot be read as TOML: {}", error.message().trim());
        Box::new(Fault::at(&place, "", Found::Words(words), "TOML 1.0", "mend the syntax at the mark"))
    })?;
    let place = Place { source: source.clone(), span: 0..0 };
    Ok(Node { value: Value::Table(table_from(table.get_ref(), source)), place, shown: String::new() })
}

/// Parses the default value of a key, written in TOML, as if it stood at `place`.
pub fn parse_default(text: &str, place: &Place) -> Node {
    let source = Arc::new(Source { name: "default".to_owned(), rank: 0, text: text.to_owned() });
    let parsed = DeValue::parse(text);
    crate::check!(parsed.is_ok(), "the default `{text}` is no TOML value");
    let mut node =
        parsed.map_or_else(|_| Node::empty_table(place), |v| node_from(v.get_ref(), v.span(), &source));
    node.place = place.clone();
    node
}

fn table_from(table: &DeTable<'_>, source: &Arc<Source>) -> Table {
    let entry = |(key, value): (&toml::Spanned<toml::de::DeString<'_>>, &toml::Spanned<DeValue<'_>>)| {
        let key_place = Place { source: source.clone(), span: key.span() };
        (
            key.get_ref().to_string(),
            Entry { key_place, node: node_from(value.get_ref(), value.span(), source) },
        )
    };
    table.iter().map(entry).collect()
}

fn node_from(value: &DeValue<'_>, span: std::ops::Range<usize>, source: &Arc<Source>) -> Node {
    let shown = short(source.text.get(span.clone()).unwrap_or(""));
    let value = match value {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(whole) => match i128::from_str_radix(whole.as_str(), whole.radix()) {
            Ok(whole) => Value::Whole(whole),
            Err(_) => Value::Real(f64::INFINITY),
        },
        DeValue::Float(real) => Value::Real(real.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(flag) => Value::Flag(*flag),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(list) => {
            Value::List(list.iter().map(|v| node_from(v.get_ref(), v.span(), source)).collect())
        }
        DeValue::Table(table) => Value::Table(table_from(table, source)),
    };
    Node { value, place: Place { source: source.clone(), span }, shown }
}

/// At most 60 characters of the first line.
fn short(text: &str) -> String {
    let line = text.lines().next().unwrap_or("");
    let cut: String = line.chars().take(60).collect();
    if cut.len() < text.len() { format!("{cut}...") } else { cut }
}
