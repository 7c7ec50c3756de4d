//! What a study's files state, in the variant that was read: to be changed, and written as an ordinary study of its own.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use serde::{Serialize, Serializer};

use crate::random::Family;
use crate::study::catalogue::{Catalogue, Used};
use crate::study::distributions::Distributions;
use crate::study::fault::{Faults, Source};
use crate::study::files::TextFile;
use crate::study::raw::{self, Entry, Node, Value};
use crate::study::reader::{Notes, join, table_name};
use crate::study::schema::{Kind, Section};
use crate::study::survey::{Asked, Recorded};
use crate::study::{keys, load, variant};

/// Paths of keys with the values that they are set to, as a variant sets them.
pub type Settings = BTreeMap<String, toml::Value>;

/// A variant to be written.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct WrittenVariant {
    /// Its name.
    pub name: String,
    /// Why somebody would read the study so.
    pub why: String,
    /// What it sets.
    pub set: Settings,
}

/// The texts of a study, with the variant's changes made and every reference to `distributions` written out, so that they mean the
/// same in any folder.
#[derive(Clone, Debug, PartialEq)]
pub struct Stated {
    root: Node,
    /// The references that were written out, with where their numbers come from.
    pub written_out: Vec<Used>,
    /// published.toml.
    published: Option<Arc<Source>>,
    /// What was measured.
    pub(super) measured: Option<TextFile>,
    /// The files of walls, by the names that arms give them.
    walls: BTreeMap<String, Arc<[u8]>>,
    /// The records of ground motion, by the names that the load gives them.
    records: BTreeMap<String, Arc<Recorded>>,
}

impl Stated {
    /// From a sound study's tree in the variant that is read, and its other files.
    pub(super) fn of(
        mut root: Node,
        catalogue: &mut Catalogue,
        published: Option<Arc<Source>>,
        measured: Option<TextFile>,
    ) -> Stated {
        if let Value::Table(table) = &mut root.value {
            table.remove("variant");
        }
        catalogue.used.clear();
        write_out(&mut root, &keys::STUDY, "", catalogue);
        let written_out = std::mem::take(&mut catalogue.used);
        let walls = catalogue.walls.bytes.clone();
        let records = catalogue.surveys.records.clone();
        Stated { root, written_out, published, measured, walls, records }
    }

    /// The text of published.toml, if there is one.
    pub fn published(&self) -> Option<&str> {
        self.published.as_ref().map(|source| source.text.as_str())
    }

    /// The text of the measurements and its SHA-256 (hex), if there are any.
    pub fn measured(&self) -> Option<(&str, &str)> {
        self.measured.as_ref().map(|file| (file.source.text.as_str(), file.sha256.as_str()))
    }

    /// The files of walls and the records of ground motion, by the names that the study gives them: they go with it into any folder.
    pub fn beside(&self) -> impl Iterator<Item = (&str, &[u8])> {
        let walls = self.walls.iter().map(|(name, bytes)| (name.as_str(), &bytes[..]));
        walls.chain(self.records.iter().map(|(name, record)| (name.as_str(), &record.bytes[..])))
    }

    /// Whether the study's files state the key of that path; what they do not state has its default.
    pub fn states(&self, path: &str) -> bool {
        node_at(&self.root, path).is_some()
    }

    /// Names of all arms, evaluated or not.
    pub(super) fn arms(&self) -> Option<Vec<String>> {
        load::arm_names(&self.root)
    }

    /// The same with other values, and with variants in the place of its own.
    ///
    /// # Errors
    /// What the study or one of the variants then has of faults.
    pub(super) fn with(mut self, set: Settings, variants: Vec<WrittenVariant>) -> Result<Stated, Faults> {
        let own =
            WrittenVariant { name: "own".to_owned(), why: "what the study itself sets".to_owned(), set };
        let listed: Vec<WrittenVariant> = std::iter::once(own).chain(variants).collect();
        let text = toml::to_string(&BTreeMap::from([("variant", listed)])).unwrap_or_default();
        let source = Arc::new(Source { name: "values asked for".to_owned(), rank: 0, text });
        let mut asked = raw::parse(&source).map_err(|fault| Faults::sorted(vec![*fault]))?;
        let mut notes = Notes::default();
        let mut read = variant::read(&asked, &mut notes).into_iter();
        if let Some(own) = read.next() {
            self.root = own.apply(&self.root, &mut notes);
        }
        if let (Value::Table(to), Value::Table(from)) = (&mut self.root.value, &mut asked.value)
            && let Some(mut entry) = from.remove("variant")
            && let Value::List(list) = &mut entry.node.value
            && list.len() > 1
        {
            list.remove(0);
            to.insert("variant".to_owned(), entry);
        }
        let mut faults = notes.faults;
        let variants: Vec<_> = read.collect();
        // No reference is left that would be looked up.
        let mut catalogue = Catalogue::of(Distributions::of_study(Path::new("")));
        catalogue.walls.bytes.clone_from(&self.walls);
        catalogue.surveys.records.clone_from(&self.records);
        load::read_all(&self.root, &variants, &[], &mut catalogue, &mut faults);
        if faults.is_empty() { Ok(self) } else { Err(Faults::sorted(faults)) }
    }

    /// As a study.toml.
    pub fn to_toml(&self) -> String {
        let written = toml::to_string(&Written { node: &self.root, section: Some(&keys::STUDY) });
        crate::check!(written.is_ok(), "a study that was read cannot be written: {written:?}");
        written.unwrap_or_default()
    }
}

/// What a key below a node states; `None` where it is not there. A key of `[uncertain]` has dots of its own.
pub(super) fn node_at<'n>(node: &'n Node, path: &str) -> Option<&'n Node> {
    let below = |name: &str, node: &'n Node| {
        let rest = path.strip_prefix(name)?;
        match rest.strip_prefix('.') {
            Some(rest) => node_at(node, rest),
            None => rest.is_empty().then_some(node),
        }
    };
    match &node.value {
        Value::Table(table) => table.iter().find_map(|(name, entry)| below(name, &entry.node)),
        Value::List(list) => list.iter().find_map(|node| below(table_name(node)?, node)),
        _ => None,
    }
}

/// A distribution as a study states it: a constant is a number.
pub(super) fn family_value(family: &Family) -> toml::Value {
    match family {
        Family::Constant { value } => toml::Value::Float(*value),
        _ => {
            let value = toml::Value::try_from(family);
            crate::check!(value.is_ok(), "a distribution cannot be written: {value:?}");
            value.unwrap_or(toml::Value::Boolean(false))
        }
    }
}

/// Puts distributions in the place of the references to them.
fn write_out(node: &mut Node, section: &'static Section, path: &str, catalogue: &mut Catalogue) {
    let Value::Table(table) = &mut node.value else { return };
    for (name, Entry { node, .. }) in table {
        let Some(key) = section.key(name, None) else { continue };
        let path = join(path, name);
        match (key.kind, &mut node.value) {
            (Kind::Table(below), _) => write_out(node, below, &path, catalogue),
            (Kind::Tables(below), Value::List(list)) => {
                for node in list {
                    let path = table_name(node).map_or_else(|| path.clone(), |own| join(&path, own));
                    write_out(node, below, &path, catalogue);
                }
            }
            (Kind::Quantity { unit, .. } | Kind::Distribution { unit, .. }, Value::Text(reference)) => {
                let reference = reference.clone();
                if let Ok(Some(family)) = catalogue.family(&reference, unit, node, &path) {
                    *node = raw::parse_default(&family_value(&family).to_string(), &node.place);
                }
            }
            (Kind::Quantity { unit, within } | Kind::Distribution { unit, within }, Value::Table(family)) => {
                let Some(Entry { node, .. }) = family.get_mut("values") else { continue };
                let Value::Text(reference) = &node.value else { continue };
                let asked = Asked { node, path: &path, unit, within };
                if let Ok(Some(values)) = catalogue.column(reference, asked) {
                    *node = raw::parse_default(&format!("{values:?}"), &node.place);
                }
            }
            (Kind::Stones { within, .. }, Value::Text(file)) => {
                let file = file.clone();
                let asked = Asked { node, path: &path, unit: "m", within };
                if let Ok(Some(stones)) = catalogue.stones(&file, asked, [None; 2]) {
                    *node = raw::parse_default(&format!("{stones:?}"), &node.place);
                }
            }
            _ => {}
        }
    }
}

/// A value with the table of keys that it is written by: keys come in the order of the reference of keys.
struct Written<'n> {
    node: &'n Node,
    section: Option<&'static Section>,
}

impl Serialize for Written<'_> {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match &self.node.value {
            Value::Text(text) => to.serialize_str(text),
            Value::Whole(whole) => to.serialize_i128(*whole),
            Value::Real(real) => to.serialize_f64(*real),
            Value::Flag(flag) => to.serialize_bool(*flag),
            // No key takes one, so that no sound study has one.
            Value::Date => to.serialize_str(&self.node.shown),
            Value::List(list) => {
                to.collect_seq(list.iter().map(|node| Written { node, section: self.section }))
            }
            Value::Table(table) => {
                let place = |name: &str| self.section?.all().position(|key| key.name == name);
                let mut entries: Vec<_> = table.iter().collect();
                entries.sort_by_key(|(name, _)| place(name).unwrap_or(usize::MAX));
                to.collect_map(entries.into_iter().map(|(name, entry)| {
                    let key = self.section.and_then(|section| section.key(name, None));
                    let section = match key.map(|key| key.kind) {
                        Some(Kind::Quantity { .. } | Kind::Distribution { .. }) => Some(&keys::FAMILY),
                        Some(kind) => kind.below(),
                        None => None,
                    };
                    (name, Written { node: &entry.node, section })
                }))
            }
        }
    }
}
