//! The files below `distributions`: one quantity each, named entries with their provenance.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::random::Family;
use crate::study::checked::InputFile;
use crate::study::distributions::{NoDistributions, distributions_above};
use crate::study::fault::{Fault, Faults, Found};
use crate::study::quantity::family;
use crate::study::raw::{self, Entry, Node, Table, Value};
use crate::study::reader::{Notes, Reader, is_name};
use crate::study::schema::suggestion;
use crate::study::{files, keys};

/// A file below `distributions`.
#[derive(Clone, Debug, PartialEq)]
pub struct DistributionFile {
    /// The quantity, in words.
    pub quantity: String,
    /// Its symbol.
    pub symbol: String,
    /// Its unit, as the key table names units: "1", m, deg, Pa, ...
    pub unit: String,
    /// The entries by name.
    pub entries: BTreeMap<String, Distribution>,
}

/// An entry: a distribution with its provenance.
#[derive(Clone, Debug, PartialEq)]
pub struct Distribution {
    /// The distribution, in the unit of its file.
    pub family: Family,
    /// measured, literature, calibrated or assumed.
    pub status: String,
    /// Paper and table, or who assumed it and why.
    pub source: String,
    /// Number of observations, where it has some.
    pub n: Option<u64>,
    /// What a user should know.
    pub note: Option<String>,
}

/// An entry that a study takes, for telling which of its inputs are only assumed.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct Used {
    /// Path of the study's key.
    pub key: String,
    /// The reference, as `block/dip:paper-interval`.
    pub reference: String,
    /// measured, literature, calibrated or assumed.
    pub status: String,
    /// Paper and table, or who assumed it and why.
    pub source: String,
}

/// Reads files below `distributions` when they are first referred to.
pub struct Catalogue {
    folder: Result<PathBuf, NoDistributions>,
    files: BTreeMap<String, Option<(DistributionFile, Vec<String>)>>,
    /// Faults of the files read.
    pub faults: Vec<Fault>,
    /// The files read, in that order.
    pub inputs: Vec<InputFile>,
    /// The entries taken, since this was last emptied.
    pub used: Vec<Used>,
}

impl Catalogue {
    /// The catalogue above the folder of a study.
    pub fn above(study: &Path) -> Catalogue {
        Catalogue::new(distributions_above(study))
    }

    fn new(folder: Result<PathBuf, NoDistributions>) -> Catalogue {
        Catalogue { folder, files: BTreeMap::new(), faults: Vec::new(), inputs: Vec::new(), used: Vec::new() }
    }

    /// The distribution that a reference names, in the unit wanted; `None` when its entry is faulty itself.
    ///
    /// # Errors
    /// A fault at the reference when it names nothing, or something in another unit.
    pub fn family(
        &mut self,
        reference: &str,
        unit: &str,
        node: &Node,
        path: &str,
    ) -> Result<Option<Family>, Box<Fault>> {
        let fault = |allowed: String, fix: String| {
            Box::new(Fault::at(&node.place, path, Found::Value(node.shown.clone()), allowed, fix))
        };
        let form = "a reference file:entry to `distributions`, as \"block/size:name\"";
        let Some((file, entry)) = reference.split_once(':') else {
            return Err(fault(form.to_owned(), "write a number, a table or a reference".to_owned()));
        };
        if !file.split('/').all(is_name) || !is_name(entry) {
            return Err(fault(form.to_owned(), "use lower-case letters, digits, - and _".to_owned()));
        }
        let folder = self.folder.clone().map_err(|none| {
            let fix = "put the folder `distributions` beside `studies`, or write the numbers here";
            fault(format!("a file of {none}"), fix.to_owned())
        })?;
        if !self.files.contains_key(file) && !path_of(&folder, file).exists() {
            let known = names_below(&folder);
            if known.is_empty() {
                let wanted = format!("a file of {}, which holds none", folder.display());
                return Err(fault(wanted, "put the file there, or write the numbers here".to_owned()));
            }
            return Err(fault(
                format!("a file of `distributions`: {}", known.join(", ")),
                suggestion(file, &known),
            ));
        }
        let Some((held, faulty)) = self.file(&folder, file) else { return Ok(None) };
        if faulty.iter().any(|f| f == entry) {
            return Ok(None);
        }
        let Some(found) = held.entries.get(entry).cloned() else {
            let names: Vec<&String> = held.entries.keys().collect();
            return Err(fault(format!("an entry of distributions/{file}.toml"), suggestion(entry, &names)));
        };
        if held.unit != unit {
            let has = held.unit.clone();
            return Err(fault(
                format!("a quantity in {unit}"),
                format!("distributions/{file}.toml is in {has}"),
            ));
        }
        let used = Used {
            key: path.to_owned(),
            reference: reference.to_owned(),
            status: found.status,
            source: found.source,
        };
        if !self.used.contains(&used) {
            self.used.push(used);
        }
        Ok(Some(found.family))
    }

    /// The file of that name and the names of its faulty entries, read once.
    fn file(&mut self, folder: &Path, file: &str) -> Option<&(DistributionFile, Vec<String>)> {
        if !self.files.contains_key(file) {
            let read = self.read(folder, file);
            self.files.insert(file.to_owned(), read);
        }
        self.files.get(file).and_then(Option::as_ref)
    }

    fn read(&mut self, folder: &Path, file: &str) -> Option<(DistributionFile, Vec<String>)> {
        let name = format!("distributions/{file}.toml");
        let parsed =
            files::read(&path_of(folder, file), &name, 3 + self.files.len(), raw::FORMAT).and_then(|text| {
                self.inputs.push(InputFile { path: PathBuf::from(&name), sha256: text.sha256.clone() });
                raw::parse(&text.source)
            });
        let root = match parsed {
            Ok(root) => root,
            Err(fault) => {
                self.faults.push(*fault);
                return None;
            }
        };
        let mut notes = Notes::default();
        let read = read_file(&root, &mut notes);
        self.faults.append(&mut notes.faults);
        read
    }
}

fn path_of(folder: &Path, file: &str) -> PathBuf {
    folder.join(format!("{file}.toml"))
}

/// Head and entries of a file, with the names of the faulty entries.
fn read_file(root: &Node, notes: &mut Notes) -> Option<(DistributionFile, Vec<String>)> {
    let Value::Table(table) = &root.value else { return None };
    let known_head = keys::HEAD.names(None);
    let is_entry = |(name, entry): &(&String, &Entry)| {
        matches!(entry.node.value, Value::Table(_)) && !known_head.contains(&name.as_str())
    };
    let head: Table = table.iter().filter(|e| !is_entry(e)).map(|(k, e)| (k.clone(), e.clone())).collect();
    let mut reader =
        Reader::open(&Node { value: Value::Table(head), ..root.clone() }, "", &keys::HEAD, notes)?;
    let (quantity, symbol, unit) =
        (reader.text("quantity"), reader.text("symbol"), reader.choice_name("unit"));
    if !table.iter().any(|e| is_entry(&e)) {
        let fix = "add a table such as [name] with family, status and source";
        let missing = Fault::at(&root.place, "entry", Found::Missing, "one or more tables", fix);
        notes.faults.push(missing);
    }
    let mut entries = BTreeMap::new();
    let mut faulty = Vec::new();
    for (name, entry) in table.iter().filter(is_entry) {
        match read_entry(name, &entry.node, notes) {
            Some(distribution) => {
                entries.insert(name.clone(), distribution);
            }
            None => faulty.push(name.clone()),
        }
    }
    Some((DistributionFile { quantity: quantity?, symbol: symbol?, unit: unit?.to_owned(), entries }, faulty))
}

fn read_entry(name: &str, node: &Node, notes: &mut Notes) -> Option<Distribution> {
    let before = notes.faults.len();
    let mut reader = Reader::open(node, name, &keys::ENTRY, notes)?;
    let family = family(&mut reader);
    let (status, source) = (reader.choice_name("status"), reader.text("source"));
    let (n, note) = (reader.whole("n"), reader.text("note"));
    let entry = Distribution { family: family?, status: status?.to_owned(), source: source?, n, note };
    (notes.faults.len() == before).then_some(entry)
}

/// Names of the files below a folder, as `block/size`, sorted.
fn names_below(folder: &Path) -> Vec<String> {
    let list = |folder: &Path| -> Vec<PathBuf> {
        std::fs::read_dir(folder).map(|e| e.flatten().map(|e| e.path()).collect()).unwrap_or_default()
    };
    let mut pending = list(folder);
    let mut names = Vec::new();
    while let Some(path) = pending.pop() {
        if path.is_dir() {
            pending.extend(list(&path));
        } else if path.extension().is_some_and(|e| e == "toml")
            && let Ok(inner) = path.strip_prefix(folder)
        {
            let parts: Vec<_> =
                inner.with_extension("").iter().map(|p| p.to_string_lossy().into_owned()).collect();
            names.push(parts.join("/"));
        }
    }
    names.sort();
    names
}

/// Reads and checks every file below a `distributions` folder, by name as `block/size`.
///
/// # Errors
/// All faults of all files.
pub fn load_distributions(folder: &Path) -> Result<BTreeMap<String, DistributionFile>, Faults> {
    let mut catalogue = Catalogue::new(Ok(folder.to_owned()));
    let mut read = BTreeMap::new();
    for name in names_below(folder) {
        if let Some((file, _)) = catalogue.file(folder, &name) {
            read.insert(name, file.clone());
        }
    }
    if catalogue.faults.is_empty() { Ok(read) } else { Err(Faults::sorted(catalogue.faults)) }
}
