//! `[sweep]`: values of keys, each of which is an arm of its own. Arms are multiplied in the raw tree, before anything is checked, so that
//! whatever takes an arm takes one of a sweep; walls of the same number have the same random numbers in all of them.

use crate::study::checked::{SweptArm, SweptValue};
use crate::study::fault::{Fault, Found, Place};
use crate::study::keys;
use crate::study::raw::{Entry, Node, Table, Value};
use crate::study::reader::{Notes, is_name, join, table_name};
use crate::study::setting::LAID_OVER;
use crate::study::variant;

/// The table's name.
const SWEEP: &str = "sweep";
/// Keys that one study may cross.
const MOST_KEYS: usize = 3;
/// Arms that may come of one.
const MOST_ARMS: usize = 1000;
/// What takes a list of values by itself: its points share their walls.
const KN: &str = "joint.kn_pa_per_m";

/// A key with its values.
struct Key {
    /// Path as the study writes it.
    path: String,
    /// The arm that it is of; of all where none is named.
    arm: Option<String>,
    /// Path below the arm.
    below: String,
    place: Place,
    values: Vec<Node>,
}

/// A study's tree with the arms of its sweep in the place of those that they are made from, and what these arms are. What is wrong with
/// the sweep is noted.
pub fn expanded(root: &Node, notes: &mut Notes) -> (Node, Vec<SweptArm>) {
    let mut changed = root.clone();
    let Value::Table(table) = &mut changed.value else { return (changed, Vec::new()) };
    let Some(entry) = table.get(SWEEP).cloned() else { return (changed, Vec::new()) };
    let before = notes.faults.len();
    let mut keys = Vec::new();
    match &entry.node.value {
        Value::Table(values) => read(values, "", &mut keys, notes),
        _ => notes.faults.push(fault(&entry.node, SWEEP, "write [sweep] above keys with lists of values")),
    }
    if keys.len() > MOST_KEYS {
        let found = Found::Words(format!("has {} keys", keys.len()));
        let allowed = format!("at most {MOST_KEYS}, which are crossed");
        notes.faults.push(Fault::at(&entry.key_place, SWEEP, found, allowed, "make it two studies"));
    }
    if notes.faults.len() > before {
        return (changed, Vec::new());
    }
    keys.retain(|key| key.path != KN || !set_points(table, key));
    let swept = multiply(table, &keys, notes);
    if swept.len() > MOST_ARMS {
        let found = Found::Words(format!("makes {} arms", swept.len()));
        let allowed = format!("at most {MOST_ARMS}");
        notes.faults.push(Fault::at(&entry.key_place, SWEEP, found, allowed, "take fewer values"));
    }
    if notes.faults.len() > before {
        return (root.clone(), Vec::new());
    }
    (changed, swept)
}

/// Reads the keys of a table of the sweep; a path without quotes is a table in a table.
fn read(table: &Table, above: &str, keys: &mut Vec<Key>, notes: &mut Notes) {
    for (name, entry) in table {
        let path = join(above, name);
        match &entry.node.value {
            Value::Table(below) => read(below, &path, keys, notes),
            Value::List(values) if !values.is_empty() => match key(&path, entry, values) {
                Ok(key) => keys.push(key),
                Err(fault) => notes.faults.push(*fault),
            },
            _ => notes.faults.push(fault(&entry.node, &shown(&path), "write the values in brackets")),
        }
    }
}

/// A key that may be swept: of a table that arms lay their keys over, or of one arm.
fn key(path: &str, entry: &Entry, values: &[Node]) -> Result<Key, Box<Fault>> {
    let repeated =
        (1..values.len()).find(|at| values[..*at].iter().any(|own| own.value == values[*at].value));
    if let Some(at) = repeated {
        let found = Found::Words(format!("has {} twice", values[at].shown));
        let fault =
            Fault::at(&values[at].place, &shown(path), found, "every value once", "remove one of them");
        return Err(Box::new(fault));
    }
    let (arm, below) = match path.split('.').collect::<Vec<_>>()[..] {
        ["arm", arm, ref below @ ..] if !below.is_empty() => (Some(arm.to_owned()), below.join(".")),
        [table, _, ..] if LAID_OVER.contains(&table) => (None, path.to_owned()),
        _ => {
            let found = Found::Words("cannot differ from arm to arm".to_owned());
            let tables = LAID_OVER.join("], [");
            let allowed = format!("a key of [{tables}], or arm.<name>.<key>");
            let fix = "change the path, or make a variant for each value";
            return Err(Box::new(Fault::at(&entry.key_place, &shown(path), found, allowed, fix)));
        }
    };
    Ok(Key { path: path.to_owned(), arm, below, place: entry.key_place.clone(), values: values.to_vec() })
}

/// Puts values of kn where a study has them by itself; false where it has no such table.
fn set_points(table: &mut Table, key: &Key) -> bool {
    let Some(Entry { node: Node { value: Value::Table(joint), .. }, .. }) = table.get_mut("joint") else {
        return false;
    };
    let list =
        Node { value: Value::List(key.values.clone()), place: key.place.clone(), shown: KN.to_owned() };
    joint.insert("kn_pa_per_m".to_owned(), Entry { key_place: key.place.clone(), node: list });
    true
}

/// Puts the arms of every combination of values in the place of those that they are made from, there and in `study.arms`.
fn multiply(table: &mut Table, keys: &[Key], notes: &mut Notes) -> Vec<SweptArm> {
    let mut swept = Vec::new();
    let Some(Entry { node: Node { value: Value::List(arms), .. }, .. }) = table.get_mut("arm") else {
        return swept;
    };
    let names: Vec<String> = arms.iter().filter_map(|arm| table_name(arm).map(str::to_owned)).collect();
    for key in keys {
        if let Some(arm) = key.arm.as_ref().filter(|arm| !names.contains(arm)) {
            let found = Found::Words(format!("is of the arm {arm}, which the study does not have"));
            let allowed = format!("one of {}", names.join(", "));
            notes.faults.push(Fault::at(&key.place, &shown(&key.path), found, allowed, "mend the name"));
        }
    }
    for arm in std::mem::take(arms) {
        let name = table_name(&arm).unwrap_or_default().to_owned();
        let own: Vec<&Key> =
            keys.iter().filter(|key| key.arm.as_ref().is_none_or(|of| *of == name)).collect();
        if own.is_empty() {
            arms.push(arm);
            continue;
        }
        // One more than are allowed are enough to refuse them.
        let count = own.iter().map(|key| key.values.len()).product::<usize>().min(MOST_ARMS + 1);
        for number in 0..count {
            let (node, one) = combined(&arm, &name, &own, number, notes);
            arms.push(node);
            swept.push(one);
        }
    }
    evaluate(table, &swept);
    swept
}

/// The arm of one combination of values; that of the last key changes fastest.
fn combined(arm: &Node, name: &str, keys: &[&Key], mut number: usize, notes: &mut Notes) -> (Node, SweptArm) {
    let mut node = arm.clone();
    let mut settings = Vec::new();
    let index = number;
    for key in keys.iter().rev() {
        let value = &key.values[number % key.values.len()];
        number /= key.values.len();
        let entry = Entry { key_place: key.place.clone(), node: value.clone() };
        if let Err((allowed, fix)) = variant::set(&mut node, &keys::ARM, &key.below, entry) {
            let found = Found::Words("sets what does not exist".to_owned());
            notes.faults.push(Fault::at(&key.place, &shown(&key.path), found, allowed, fix));
        }
        let number = match value.value {
            Value::Whole(whole) => Some(whole as f64),
            Value::Real(real) => Some(real),
            _ => None,
        };
        settings.push(SweptValue { key: key.path.clone(), value: value.shown.clone(), number });
    }
    settings.reverse();
    let arm = named(name, &settings, index);
    if let Value::Table(table) = &mut node.value
        && let Some(entry) = table.get_mut("name")
    {
        entry.node.value = Value::Text(arm.clone());
    }
    (node, SweptArm { arm, of: name.to_owned(), settings })
}

/// The arm's name with what was set, as far as both make a name; else with its number from 1.
fn named(arm: &str, settings: &[SweptValue], index: usize) -> String {
    let word = |text: &str| -> String {
        let text = text.trim_matches(['"', '\'']).to_lowercase().replace('.', "_").replace('+', "");
        if text.starts_with('-') { text.replacen('-', "minus_", 1) } else { text }
    };
    let set = settings.iter().map(|own| {
        let key = own.key.rsplit('.').next().unwrap_or_default();
        format!("-{key}-{}", word(&own.value))
    });
    let name = format!("{arm}{}", set.collect::<String>());
    if is_name(&name) { name } else { format!("{arm}-{}", index + 1) }
}

/// Has the arms of a sweep evaluated where those were that they are made from.
fn evaluate(table: &mut Table, swept: &[SweptArm]) {
    let Some(Entry { node: Node { value: Value::Table(study), .. }, .. }) = table.get_mut("study") else {
        return;
    };
    let Some(Entry { node: Node { value: Value::List(arms), .. }, .. }) = study.get_mut("arms") else {
        return;
    };
    let of = |node: &Node| match &node.value {
        Value::Text(name) => swept.iter().filter(|own| own.of == *name).collect(),
        _ => Vec::new(),
    };
    let names = arms.iter().flat_map(|node| match of(node) {
        made if made.is_empty() => vec![node.clone()],
        made => made.iter().map(|own| Node { value: Value::Text(own.arm.clone()), ..node.clone() }).collect(),
    });
    *arms = names.collect();
}

fn shown(path: &str) -> String {
    format!("{SWEEP}.\"{path}\"")
}

fn fault(node: &Node, key: &str, fix: &str) -> Fault {
    Fault::at(&node.place, key, Found::Value(node.shown.clone()), "a list of values for each key", fix)
}
