//! Reads one table against its section of the key table: types, ranges, unknown, missing and unused keys.

use std::collections::BTreeMap;

use crate::stats::Statistic;
use crate::study::fault::{Fault, Found, Place};
use crate::study::raw::{self, Node, Table, Value};
use crate::study::schema::{Interval, Key, Kind, Presence, Section, Short, suggestion};
use crate::study::with_unit;

/// What came to light while reading.
#[derive(Debug, Default)]
pub struct Notes {
    /// What is wrong.
    pub faults: Vec<Fault>,
    /// What is allowed and yet looks wrong.
    pub warnings: Vec<Fault>,
    /// Every value that decides a result, defaults included, by the path of its key.
    pub effective: BTreeMap<String, String>,
}

/// A table being read. Every method that reads a key answers `None` when the key is optional and absent, or when it
/// was faulty; the fault is then in the notes.
pub struct Reader<'n> {
    table: Table,
    place: Place,
    /// Path of the table, empty at the top.
    pub path: String,
    section: &'static Section,
    chosen: Option<&'static str>,
    /// Where faults go.
    pub notes: &'n mut Notes,
}

impl<'n> Reader<'n> {
    /// Opens a table, and notes every key that it should not have.
    pub fn open(
        node: &Node,
        path: &str,
        section: &'static Section,
        notes: &'n mut Notes,
    ) -> Option<Reader<'n>> {
        let Value::Table(table) = &node.value else {
            let fix = format!("write {} instead of {}", section.title, node.value.kind());
            notes.faults.push(Fault::at(&node.place, path, Found::Value(node.shown.clone()), "a table", fix));
            return None;
        };
        let mut reader = Reader {
            table: table.clone(),
            place: node.place.clone(),
            path: path.to_owned(),
            section,
            chosen: None,
            notes,
        };
        if let Some(chooser) = section.chooser {
            reader.chosen = reader.choice_name(chooser);
        }
        reader.note_keys_out_of_place();
        Some(reader)
    }

    /// Keys that no section knows, and keys that mean nothing for the choice made.
    fn note_keys_out_of_place(&mut self) {
        let chosen = self.chosen;
        for (name, entry) in &self.table {
            if self.section.key(name, chosen).is_some() {
                continue;
            }
            let names = self.section.names(chosen);
            let allowed = format!("a key of {}: {}", self.section.title, names.join(", "));
            let (found, fix) = match self.section.key(name, None).zip(chosen) {
                Some((key, chosen)) => (
                    format!("means nothing where {} = \"{chosen}\"", self.section.chooser.unwrap_or("")),
                    format!("remove it; it belongs to {}", key.only.join(" and ")),
                ),
                None => match crate::study::schema::nearest(name, &names) {
                    // A path that was not put in quotes is a table of its own in TOML.
                    _ if names.iter().any(|known| known.starts_with(&format!("{name}."))) => (
                        "is a part of a path".to_owned(),
                        format!("write the whole path in quotes, as \"{name}.<key>\" = {{ family = ... }}"),
                    ),
                    Some(near) => ("is not a known key".to_owned(), format!("did you mean \"{near}\"?")),
                    None => ("is not a known key".to_owned(), "remove it".to_owned()),
                },
            };
            let path = join(&self.path, name);
            self.notes.faults.push(Fault::at(&entry.key_place, &path, Found::Words(found), allowed, fix));
        }
    }

    /// Value of the section's chooser, when it is a valid one.
    pub fn chosen(&self) -> Option<&'static str> {
        self.chosen
    }

    /// Whether the key is there.
    pub fn has(&self, name: &str) -> bool {
        self.table.contains_key(name)
    }

    /// Whether the key is there, and means something for the choice made.
    pub fn takes(&self, name: &str) -> bool {
        self.has(name) && self.section.key(name, self.chosen).is_some()
    }

    /// Whether a table stands there.
    pub fn is_table(&self, name: &str) -> bool {
        self.table.get(name).is_some_and(|entry| matches!(entry.node.value, Value::Table(_)))
    }

    /// Where a key's value stands; the table itself when the key is absent.
    pub fn place_of(&self, name: &str) -> &Place {
        self.table.get(name).map_or(&self.place, |entry| &entry.node.place)
    }

    /// The node of a key or of its default.
    pub fn given(&mut self, name: &str) -> Option<(Node, &'static Key)> {
        let key = self.section.key(name, self.chosen);
        crate::check!(key.is_some(), "{} has no key `{name}`", self.section.title);
        let key = key?;
        if let Some(entry) = self.table.get(name) {
            return Some((entry.node.clone(), key));
        }
        match key.presence {
            Presence::Default(text) => Some((raw::parse_default(text, &self.place), key)),
            Presence::Optional => None,
            Presence::Unless(other) if self.table.contains_key(other) => None,
            Presence::Required | Presence::Unless(_) => {
                let undecided =
                    self.section.chooser.is_some() && self.chosen.is_none() && !key.only.is_empty();
                if !undecided {
                    let fix = format!("add {name} to {}", self.section.title);
                    let path = join(&self.path, name);
                    let fault = Fault::at(&self.place, &path, Found::Missing, key.kind.allowed(), fix);
                    self.notes.faults.push(fault);
                }
                None
            }
        }
    }

    /// Notes a fault at a key.
    pub fn fault(&mut self, name: &str, allowed: impl Into<String>, fix: impl Into<String>) {
        let found = match self.table.get(name) {
            Some(entry) => Found::Value(entry.node.shown.clone()),
            None => Found::Words("has its default".to_owned()),
        };
        let fault = Fault::at(self.place_of(name), &join(&self.path, name), found, allowed, fix);
        self.notes.faults.push(fault);
    }

    /// Notes that a value is not what its key takes.
    pub fn refuse(&mut self, node: &Node, key: &Key, fix: impl Into<String>) {
        let found = Found::Value(node.shown.clone());
        let path = join(&self.path, key.name);
        self.notes.faults.push(Fault::at(&node.place, &path, found, key.kind.allowed(), fix));
    }

    fn refuse_kind(&mut self, node: &Node, key: &Key) {
        self.refuse(node, key, format!("{} cannot stand here", node.value.kind()));
    }

    /// Records a value that decides a result.
    pub fn record(&mut self, name: &str, value: impl std::fmt::Display) {
        self.notes.effective.insert(join(&self.path, name), value.to_string());
    }

    /// Prose; does not decide any result.
    pub fn text(&mut self, name: &str) -> Option<String> {
        let (node, key) = self.given(name)?;
        match &node.value {
            Value::Text(text) if !text.trim().is_empty() => Some(text.clone()),
            Value::Text(_) => {
                self.refuse(&node, key, "write something");
                None
            }
            _ => {
                self.refuse_kind(&node, key);
                None
            }
        }
    }

    /// A name.
    pub fn name(&mut self, name: &str) -> Option<String> {
        let (node, key) = self.given(name)?;
        let named = self.one_name(&node, key)?;
        self.record(name, &named);
        Some(named)
    }

    fn one_name(&mut self, node: &Node, key: &Key) -> Option<String> {
        match &node.value {
            Value::Text(text) if is_name(text) => Some(text.clone()),
            Value::Text(_) => {
                self.refuse(node, key, "it is used in file names and on the command line; rename it");
                None
            }
            _ => {
                self.refuse_kind(node, key);
                None
            }
        }
    }

    /// Two names.
    pub fn name_pair(&mut self, name: &str) -> Option<[String; 2]> {
        let (node, key) = self.given(name)?;
        let Value::List(list) = &node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        let names: Vec<Option<String>> = list.iter().map(|n| self.one_name(n, key)).collect();
        let names: Vec<String> = names.into_iter().collect::<Option<_>>()?;
        match <[String; 2]>::try_from(names) {
            Ok(pair) if pair[0] != pair[1] => Some(pair),
            _ => {
                self.refuse(&node, key, "give two different names");
                None
            }
        }
    }

    /// One or more names.
    pub fn names(&mut self, name: &str) -> Option<Vec<String>> {
        let (node, key) = self.given(name)?;
        let Value::List(list) = &node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        let names: Vec<Option<String>> = list.iter().map(|n| self.one_name(n, key)).collect();
        let names: Vec<String> = names.into_iter().collect::<Option<_>>()?;
        let repeated = names.iter().enumerate().any(|(i, name)| names[..i].contains(name));
        if names.is_empty() || repeated {
            self.refuse(&node, key, if repeated { "drop repeated names" } else { "give at least one" });
            return None;
        }
        self.record(name, names.join(", "));
        Some(names)
    }

    /// One of the names of a choice, as an enum whose serde names are those of the key table.
    pub fn choice<T: serde::de::DeserializeOwned>(&mut self, name: &str) -> Option<T> {
        let chosen = self.choice_name(name)?;
        let value = serde_json::from_value(serde_json::Value::String(chosen.to_owned()));
        crate::check!(value.is_ok(), "`{chosen}` of the key table has no value for `{name}`");
        value.ok()
    }

    /// One of the names of a choice.
    pub fn choice_name(&mut self, name: &str) -> Option<&'static str> {
        let (node, key) = self.given(name)?;
        let (Kind::Choice(names), Value::Text(text)) = (key.kind, &node.value) else {
            self.refuse_kind(&node, key);
            return None;
        };
        let Some(chosen) = names.iter().find(|n| *n == text) else {
            self.refuse(&node, key, suggestion(text, names));
            return None;
        };
        self.record(name, chosen);
        Some(chosen)
    }

    /// The name of a statistic.
    pub fn statistic(&mut self, name: &str) -> Option<Statistic> {
        let (node, key) = self.given(name)?;
        let Value::Text(text) = &node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        let Some(statistic) = Statistic::named(text) else {
            self.refuse(&node, key, "name one of these");
            return None;
        };
        self.record(name, statistic.name());
        Some(statistic)
    }

    /// true or false.
    pub fn flag(&mut self, name: &str) -> Option<bool> {
        let (node, key) = self.given(name)?;
        let Value::Flag(flag) = node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        self.record(name, flag);
        Some(flag)
    }

    /// A whole number.
    pub fn whole(&mut self, name: &str) -> Option<u64> {
        let (node, key) = self.given(name)?;
        let (Kind::Whole { low, high } | Kind::WholeOr { low, high, .. }) = key.kind else {
            crate::check!(false, "`{name}` is no whole number in the key table");
            return None;
        };
        let whole = self.one_whole(&node, key, low, high)?;
        self.record(name, whole);
        Some(whole)
    }

    /// A whole number that fits 32 bits by its range in the key table.
    pub fn whole32(&mut self, name: &str) -> Option<u32> {
        self.whole(name).and_then(|whole| u32::try_from(whole).ok())
    }

    /// Two whole numbers.
    pub fn pair(&mut self, name: &str) -> Option<[u32; 2]> {
        let (node, key) = self.given(name)?;
        let (Kind::Pair { low, high }, Value::List(list)) = (key.kind, &node.value) else {
            self.refuse_kind(&node, key);
            return None;
        };
        let wholes: Vec<Option<u64>> = list.iter().map(|n| self.one_whole(n, key, low, high)).collect();
        let wholes = wholes.into_iter().collect::<Option<Vec<u64>>>()?;
        let [first, second] = wholes[..] else {
            self.refuse(&node, key, "give exactly two");
            return None;
        };
        self.record(name, format_args!("[{first}, {second}]"));
        Some([u32::try_from(first).ok()?, u32::try_from(second).ok()?])
    }

    fn one_whole(&mut self, node: &Node, key: &Key, low: u64, high: u64) -> Option<u64> {
        let Value::Whole(whole) = node.value else {
            self.refuse_kind(node, key);
            return None;
        };
        if (i128::from(low)..=i128::from(high)).contains(&whole) {
            return u64::try_from(whole).ok();
        }
        let fix = if whole < i128::from(low) {
            format!("at least {low} is needed")
        } else {
            "reduce it".to_owned()
        };
        self.refuse(node, key, fix);
        None
    }

    /// A number.
    pub fn real(&mut self, name: &str) -> Option<f64> {
        let (node, key) = self.given(name)?;
        let Kind::Real { within, .. } = key.kind else {
            crate::check!(false, "`{name}` is no number in the key table");
            return None;
        };
        let x = self.one_real(&node, key, within)?;
        self.record(name, format_args!("{x:?}"));
        Some(x)
    }

    /// Several numbers; all are read before any is missed.
    pub fn reals<const N: usize>(&mut self, names: [&str; N]) -> Option<[f64; N]> {
        let read = names.map(|name| self.real(name));
        let mut values = [0.0; N];
        for (value, read) in values.iter_mut().zip(read) {
            *value = read?;
        }
        Some(values)
    }

    /// A file beside the study, with its node; whether there is one is not looked at.
    pub fn file(&mut self, name: &str) -> Option<(String, Node)> {
        let (node, key) = self.given(name)?;
        let Value::Text(file) = &node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        Some((file.clone(), node))
    }

    /// Files beside the study, each with its node; which of them there are is not looked at.
    pub fn files(&mut self, name: &str) -> Option<Vec<(String, Node)>> {
        let (node, key) = self.given(name)?;
        let (Kind::Files { at_most }, Value::List(list)) = (key.kind, &node.value) else {
            self.refuse_kind(&node, key);
            return None;
        };
        let mut files: Vec<(String, Node)> = Vec::new();
        for own in list {
            let Value::Text(file) = &own.value else {
                self.refuse_kind(own, key);
                return None;
            };
            if files.iter().any(|(known, _)| known == file) {
                self.refuse(own, key, "drop repeated files");
                return None;
            }
            files.push((file.clone(), own.clone()));
        }
        if files.is_empty() || files.len() > at_most {
            self.refuse(&node, key, format!("it has {} entries", files.len()));
            return None;
        }
        Some(files)
    }

    /// A list of numbers.
    pub fn list(&mut self, name: &str) -> Option<Vec<f64>> {
        let (node, key) = self.given(name)?;
        let (within, at_most, ascending) = match key.kind {
            Kind::Reals { within, at_most, ascending, .. } => (within, at_most, ascending),
            Kind::Values { at_most } => (Interval::any(), at_most, false),
            _ => {
                crate::check!(false, "`{name}` is no list of numbers in the key table");
                return None;
            }
        };
        let Value::List(list) = &node.value else {
            self.refuse_kind(&node, key);
            return None;
        };
        let values: Vec<Option<f64>> = list.iter().map(|n| self.one_real(n, key, within)).collect();
        let values = values.into_iter().collect::<Option<Vec<f64>>>()?;
        if values.is_empty() || values.len() > at_most {
            self.refuse(&node, key, format!("it has {} entries", values.len()));
            return None;
        }
        if ascending && let Some(i) = (1..values.len()).find(|&i| values[i] <= values[i - 1]) {
            let (one, next) = (Short(values[i - 1]), Short(values[i]));
            self.refuse(
                &list[i],
                key,
                format!("{next} follows {one}: sort the list and drop repeated values"),
            );
            return None;
        }
        self.record(name, format_args!("{values:?}"));
        Some(values)
    }

    /// A number inside an interval, with a warning where it is unusual.
    pub fn one_real(&mut self, node: &Node, key: &Key, within: Interval) -> Option<f64> {
        let x = match node.value {
            Value::Whole(whole) => whole as f64,
            Value::Real(real) => real,
            Value::Text(ref text) => match with_unit::read(text, key.kind.unit()) {
                Some(x) => x,
                None => {
                    let names = with_unit::names(key.kind.unit());
                    let fix = match names.is_empty() {
                        true => "write a plain number".to_owned(),
                        false => {
                            format!("write a number, or one with its unit in quotes: {}", names.join(", "))
                        }
                    };
                    self.refuse(node, key, fix);
                    return None;
                }
            },
            _ => {
                self.refuse_kind(node, key);
                return None;
            }
        };
        if !x.is_finite() {
            self.refuse(node, key, "a finite number is needed");
            return None;
        }
        if !within.contains(x) {
            self.refuse(node, key, if x > within.low { "reduce it" } else { "raise it" });
            return None;
        }
        self.warn_if_unusual(node, key, x);
        self.warn_if_in_radians(node, key, x);
        Some(x)
    }

    /// Warns when an angle in degrees looks like radians, or a friction angle like a coefficient.
    pub fn warn_if_in_radians(&mut self, node: &Node, key: &Key, x: f64) {
        let Some(doubt) = key.angle.and_then(|angle| angle.doubt(x)) else { return };
        let path = join(&self.path, key.name);
        let (found, allowed) = (Found::Value(node.shown.clone()), format!("this, but {doubt}"));
        self.notes.warnings.push(Fault::at(&node.place, &path, found, allowed, "state it in degrees"));
    }

    /// Warns when a value lies outside the usual interval of its key.
    pub fn warn_if_unusual(&mut self, node: &Node, key: &Key, x: f64) {
        if let Some(usual) = key.usual.filter(|usual| !usual.contains(x)) {
            let unit = key.kind.unit();
            let path = join(&self.path, key.name);
            let allowed = format!("this, but usual is {usual} ({unit})");
            let fix = "check its magnitude and unit";
            let fault = Fault::at(&node.place, &path, Found::Value(node.shown.clone()), allowed, fix);
            self.notes.warnings.push(fault);
        }
    }

    /// A table of its own section.
    pub fn table(&mut self, name: &str) -> Option<Reader<'_>> {
        let (node, key) = self.given(name)?;
        let (Kind::Table(section) | Kind::WholeOr { rule: section, .. }) = key.kind else {
            crate::check!(false, "`{name}` is no table in the key table");
            return None;
        };
        let path = join(&self.path, name);
        Reader::open(&node, &path, section, self.notes)
    }

    /// The tables of a list, each with its path: by its name where it has one, else by its number from 1.
    pub fn tables(&mut self, name: &str) -> Vec<(Node, String)> {
        let Some((node, key)) = self.given(name) else { return Vec::new() };
        let list = match node.value {
            Value::List(ref list) if !list.is_empty() => list,
            _ => {
                self.refuse(&node, key, format!("write [[{name}]] above each"));
                return Vec::new();
            }
        };
        let path_of = |(i, node): (usize, &Node)| {
            let path = match table_name(node) {
                Some(own) => format!("{}.{own}", join(&self.path, name)),
                None => format!("{}[{}]", join(&self.path, name), i + 1),
            };
            (node.clone(), path)
        };
        list.iter().enumerate().map(path_of).collect()
    }
}

/// The valid `name` of a table.
pub fn table_name(node: &Node) -> Option<&str> {
    let Value::Table(table) = &node.value else { return None };
    match &table.get("name")?.node.value {
        Value::Text(text) if is_name(text) => Some(text),
        _ => None,
    }
}

/// Whether a text is a name: lower-case letters, digits, `-` and `_`, at most 64 of them.
pub fn is_name(text: &str) -> bool {
    let allowed = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-' || c == '_';
    (1..=64).contains(&text.len()) && text.chars().all(allowed)
}

/// Path of a key below a path.
pub fn join(path: &str, name: &str) -> String {
    if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") }
}
