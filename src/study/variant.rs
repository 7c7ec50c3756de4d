//! Named variants: key paths set to other values in the raw tree, before anything is checked.

use std::sync::Arc;

use crate::study::fault::{Fault, Found, Place, Source};
use crate::study::keys;
use crate::study::raw::{self, Entry, Node, Table, Value};
use crate::study::reader::{Notes, Reader, table_name};
use crate::study::schema::{Kind, Section, suggestion};

/// What stands between the names of variants that are read together.
pub const TOGETHER: char = '+';

/// A variant as the file states it.
#[derive(Clone, Debug)]
pub struct Variant {
    /// Its name.
    pub name: String,
    /// Why somebody would read the study so.
    pub why: String,
    edits: Vec<Edit>,
}

/// One change of the raw tree; without an entry the key is taken away.
#[derive(Clone, Debug)]
struct Edit {
    path: Vec<String>,
    place: Place,
    entry: Option<Entry>,
}

/// Why an edit cannot be made.
struct NoSuchKey {
    allowed: String,
    fix: String,
}

/// What stands between the path of a key and the value that it is set to, where a variant is no name.
pub const SETS: char = '=';

/// A variant that is asked for by what it sets, as `joint.phi_deg=32`; text needs no quotes.
///
/// # Errors
/// What is wrong with the path or the value.
pub fn asked_for(setting: &str) -> Result<Variant, Box<Fault>> {
    let (path, value) = setting.split_once(SETS).unwrap_or((setting, ""));
    let (path, value) = (path.trim(), value.trim());
    let parsed = |value: &str| {
        let text = format!("{:?} = {value}", path);
        raw::parse(&Arc::new(Source { name: ASKED_FOR.to_owned(), rank: 0, text }))
    };
    // A word that is no value of TOML is a text.
    let is_word = !value.is_empty() && !value.contains(['"', '{', '[', '\\']);
    let node = parsed(value).or_else(|fault| match is_word {
        true => parsed(&format!("\"{value}\"")),
        false => Err(fault),
    })?;
    let Value::Table(table) = &node.value else { return Ok(Variant::of(setting, Vec::new())) };
    Ok(Variant::of(&format!("{path}{SETS}{value}"), edits(table)))
}

/// Whether a variant, by its name, says itself what it sets a key to.
pub fn says(variant: &str, key: &str) -> bool {
    let sets = |own: &str| own.strip_prefix(key).is_some_and(|rest| rest.starts_with(SETS));
    variant.split(TOGETHER).any(sets)
}

/// Name of the source of a setting that is asked for.
const ASKED_FOR: &str = "--variant";

/// A change for each path of a table.
fn edits(table: &Table) -> Vec<Edit> {
    let edit = |(path, entry): (&String, &Entry)| Edit {
        path: path.split('.').map(str::to_owned).collect(),
        place: entry.key_place.clone(),
        entry: Some(entry.clone()),
    };
    table.iter().map(edit).collect()
}

/// All variants of a study.
pub fn read(root: &Node, notes: &mut Notes) -> Vec<Variant> {
    let Value::Table(table) = &root.value else { return Vec::new() };
    let Some(entry) = table.get("variant") else { return Vec::new() };
    let only = Table::from([("variant".to_owned(), entry.clone())]);
    let mut scratch = Notes::default();
    let Some(mut reader) =
        Reader::open(&Node { value: Value::Table(only), ..root.clone() }, "", &keys::STUDY, &mut scratch)
    else {
        return Vec::new();
    };
    let tables = reader.tables("variant");
    notes.faults.append(&mut scratch.faults);
    let mut variants: Vec<Variant> = Vec::new();
    for (node, path) in tables {
        let Some(variant) = read_one(&node, &path, notes) else { continue };
        if variants.iter().any(|v| v.name == variant.name) {
            let found = Found::Words("is the name of two variants".to_owned());
            notes.faults.push(Fault::at(&node.place, &path, found, "every name once", "rename one of them"));
        } else {
            variants.push(variant);
        }
    }
    variants
}

fn read_one(node: &Node, path: &str, notes: &mut Notes) -> Option<Variant> {
    let mut reader = Reader::open(node, path, &keys::VARIANT, notes)?;
    let (name, why) = (reader.name("name"), reader.text("why"));
    let mut edits = unsets(&mut reader);
    if let Some((node, key)) = reader.given("set") {
        match &node.value {
            Value::Table(table) if !table.is_empty() => edits.extend(self::edits(table)),
            Value::Table(_) => reader.refuse(&node, key, "set at least one key"),
            _ => reader.refuse(&node, key, "write [variant.set] above the settings"),
        }
    }
    Some(Variant { name: name?, why: why?, edits })
}

fn unsets(reader: &mut Reader<'_>) -> Vec<Edit> {
    let Some((node, key)) = reader.given("unset") else { return Vec::new() };
    let Value::List(list) = &node.value else {
        reader.refuse(&node, key, "write a list in brackets");
        return Vec::new();
    };
    let mut edits = Vec::new();
    for item in list {
        match &item.value {
            Value::Text(path) => edits.push(Edit {
                path: path.split('.').map(str::to_owned).collect(),
                place: item.place.clone(),
                entry: None,
            }),
            _ => reader.refuse(item, key, "write each path in quotes"),
        }
    }
    edits
}

impl Variant {
    /// One that is asked for, with its changes.
    fn of(name: &str, edits: Vec<Edit>) -> Variant {
        Variant { name: name.to_owned(), why: "asked for".to_owned(), edits }
    }

    /// The paths of the keys that it sets or takes away.
    pub fn keys(&self) -> Vec<String> {
        self.edits.iter().map(|edit| edit.path.join(".")).collect()
    }

    /// The study's raw tree with the variant's changes made; what cannot be made is noted.
    pub fn apply(&self, root: &Node, notes: &mut Notes) -> Node {
        let mut changed = root.clone();
        for edit in &self.edits {
            let path: Vec<&str> = edit.path.iter().map(String::as_str).collect();
            if let Err(no) = change(&mut changed, &keys::STUDY, &path, edit) {
                let key = match edit.place.source.name == ASKED_FOR {
                    true => edit.path.join("."),
                    false => format!("variant.{}: \"{}\"", self.name, edit.path.join(".")),
                };
                let words = if edit.entry.is_some() {
                    "sets what does not exist"
                } else {
                    "takes away what is not there"
                };
                notes.faults.push(Fault::at(
                    &edit.place,
                    &key,
                    Found::Words(words.to_owned()),
                    no.allowed,
                    no.fix,
                ));
            }
        }
        changed
    }
}

/// The first key of one variant that a second one changes as well, itself or as a part or the whole of it: read together, which
/// of them holds would depend on their order.
pub fn shared_key<'k>(one: &'k [String], other: &[String]) -> Option<&'k str> {
    let below =
        |a: &str, b: &str| a.strip_prefix(b).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'));
    one.iter().find(|a| other.iter().any(|b| below(a, b) || below(b, a))).map(String::as_str)
}

/// Sets the key at a path below a table.
///
/// # Errors
/// What is allowed there, and how to mend the path.
pub(super) fn set(
    node: &mut Node,
    section: &'static Section,
    path: &str,
    entry: Entry,
) -> Result<(), (String, String)> {
    let path: Vec<&str> = path.split('.').collect();
    let edit = Edit { path: Vec::new(), place: entry.key_place.clone(), entry: Some(entry) };
    change(node, section, &path, &edit).map_err(|no| (no.allowed, no.fix))
}

/// Walks down `path` by the key table and changes what stands at its end.
fn change(node: &mut Node, section: &'static Section, path: &[&str], edit: &Edit) -> Result<(), NoSuchKey> {
    let place = node.place.clone();
    let Value::Table(table) = &mut node.value else { return Ok(()) };
    // The keys of [uncertain] are paths themselves.
    let whole = path.join(".");
    let path = if section.key(&whole, None).is_some() { &[whole.as_str()][..] } else { path };
    let [name, rest @ ..] = path else { return Err(no_such("", section)) };
    let key =
        section.key(name, None).filter(|k| k.name != "variant").ok_or_else(|| no_such(name, section))?;
    match key.kind {
        Kind::Table(below) if !rest.is_empty() => {
            if edit.entry.is_none() && !table.contains_key(*name) {
                return Err(not_there(name));
            }
            let new = || Entry { key_place: edit.place.clone(), node: Node::empty_table(&place) };
            change(&mut table.entry((*name).to_owned()).or_insert_with(new).node, below, rest, edit)
        }
        Kind::Table(below) => match &edit.entry {
            Some(Entry { node: Node { value: Value::Table(inner), .. }, .. }) => {
                each(node, section, path, inner, Some(below))
            }
            _ => put(table, name, edit),
        },
        Kind::Tables(below) => change_named(table, name, below, rest, edit),
        _ if rest.is_empty() => put(table, name, edit),
        _ => Err(NoSuchKey {
            allowed: format!("a path that ends at {name}, which has a value and no keys"),
            fix: format!("set {name} as a whole"),
        }),
    }
}

/// Changes below one table of a list, addressed by its name.
fn change_named(
    table: &mut Table,
    list: &str,
    below: &'static Section,
    rest: &[&str],
    edit: &Edit,
) -> Result<(), NoSuchKey> {
    let Some(Entry { node: Node { value: Value::List(items), .. }, .. }) = table.get_mut(list) else {
        return Ok(());
    };
    let names: Vec<String> = items.iter().filter_map(|n| table_name(n).map(str::to_owned)).collect();
    if let ([], Some(Entry { node: Node { value: Value::Table(inner), .. }, .. })) = (rest, &edit.entry) {
        for (name, entry) in inner {
            change_named(table, list, below, &[name], &Edit { entry: Some(entry.clone()), ..edit.clone() })?;
        }
        return Ok(());
    }
    let [wanted, rest @ ..] = rest else {
        return Err(NoSuchKey {
            allowed: format!("{list}.<name>.<key>"),
            fix: format!("name the {list} and its key"),
        });
    };
    let Some(item) = items.iter_mut().find(|n| table_name(n) == Some(wanted)) else {
        return Err(NoSuchKey { allowed: format!("the name of an {list}"), fix: suggestion(wanted, &names) });
    };
    match (rest, &edit.entry) {
        ([], Some(Entry { node: Node { value: Value::Table(inner), .. }, .. })) => {
            let inner = inner.clone();
            each(item, below, &[], &inner, None)
        }
        ([], _) => {
            Err(NoSuchKey { allowed: format!("{list}.{wanted}.<key>"), fix: "add the key".to_owned() })
        }
        (["name"], _) => Err(NoSuchKey {
            allowed: "any key but the name, by which others refer to it".to_owned(),
            fix: "remove it".to_owned(),
        }),
        _ => change(item, below, rest, edit),
    }
}

/// Makes a table of changes one by one, so that keys which it does not name stay as they are.
fn each(
    node: &mut Node,
    section: &'static Section,
    path: &[&str],
    inner: &Table,
    below: Option<&'static Section>,
) -> Result<(), NoSuchKey> {
    for (name, entry) in inner {
        if let Some(below) = below.filter(|b| b.key(name, None).is_none()) {
            return Err(no_such(name, below));
        }
        let path: Vec<&str> = path.iter().copied().chain([name.as_str()]).collect();
        change(
            node,
            section,
            &path,
            &Edit { path: Vec::new(), place: entry.key_place.clone(), entry: Some(entry.clone()) },
        )?;
    }
    Ok(())
}

fn put(table: &mut Table, name: &str, edit: &Edit) -> Result<(), NoSuchKey> {
    match &edit.entry {
        Some(entry) => {
            table.insert(name.to_owned(), entry.clone());
            Ok(())
        }
        None => table.remove(name).map(|_| ()).ok_or_else(|| not_there(name)),
    }
}

fn not_there(name: &str) -> NoSuchKey {
    NoSuchKey {
        allowed: "a key that the study sets".to_owned(),
        fix: format!("{name} is not there; remove the path"),
    }
}

fn no_such(name: &str, section: &'static Section) -> NoSuchKey {
    let names: Vec<&str> = section.names(None).into_iter().filter(|n| *n != "variant").collect();
    NoSuchKey { allowed: format!("a key of {}", section.title), fix: suggestion(name, &names) }
}
