//! The files below `distributions`: one quantity each, named entries with their provenance.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use crate::math::compact;
use crate::motion::Motion;
use crate::random::Family;
use crate::study::checked::InputFile;
use crate::study::distributions::{Distributions, Origin, is_prior};
use crate::study::fault::{Fault, Faults, Found, Place};
use crate::study::keys;
use crate::study::quantity::family;
use crate::study::raw::{self, Entry, Node, Table, Value};
use crate::study::reader::{Notes, Reader, is_name, join};
use crate::study::schema::suggestion;
use crate::study::survey::{Asked, Surveys};
use crate::study::wall_file::WallFiles;

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

impl Distribution {
    /// Its values in words: `25 to 28`, `mean 0.2, standard deviation 0.05, from 0.1 to 0.4`.
    pub fn words(&self) -> String {
        let shown =
            |x: f64| if x != 0.0 && !(1e-3..1e5).contains(&x.abs()) { compact(x) } else { x.to_string() };
        match &self.family {
            Family::Constant { value } => shown(*value),
            Family::Uniform { low, high } => format!("{} to {}", shown(*low), shown(*high)),
            Family::Empirical { values } => {
                format!("one of {}", values.iter().map(|value| shown(*value)).collect::<Vec<_>>().join(", "))
            }
            other => {
                let (low, high) = other.support();
                let ends = if high.is_finite() {
                    format!(", from {} to {}", shown(low), shown(high))
                } else {
                    String::new()
                };
                format!("mean {}, standard deviation {}{ends}", shown(other.mean()), shown(other.sd()))
            }
        }
    }
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
    /// Where its file lies: a path, or `built-in:distributions/block/dip.toml`.
    pub from: String,
}

/// Reads files below `distributions` when they are first referred to.
pub struct Catalogue {
    distributions: Distributions,
    files: BTreeMap<String, Option<Held>>,
    /// The tables beside the study.
    pub(in crate::study) surveys: Surveys,
    /// The walls beside it.
    pub walls: WallFiles,
    /// Faults of the files read.
    pub faults: Vec<Fault>,
    /// The files read, in that order.
    pub inputs: Vec<InputFile>,
    /// The entries taken, since this was last emptied.
    pub used: Vec<Used>,
}

/// A file that was read.
struct Held {
    file: DistributionFile,
    /// Names of its faulty entries.
    faulty: Vec<String>,
    origin: Origin,
}

impl Catalogue {
    /// The catalogue of what is found there.
    pub fn of(distributions: Distributions) -> Catalogue {
        Catalogue {
            distributions,
            files: BTreeMap::new(),
            surveys: Surveys::beside(None),
            walls: WallFiles::default(),
            faults: Vec::new(),
            inputs: Vec::new(),
            used: Vec::new(),
        }
    }

    /// The catalogue of a study, with the tables in its folder.
    pub fn of_study(folder: &Path) -> Catalogue {
        let surveys = Surveys::beside(Some(folder.to_path_buf()));
        Catalogue { surveys, ..Catalogue::of(Distributions::of_study(folder)) }
    }

    /// Hands over the faults of the files read, and their names.
    pub fn hand_over(&mut self, faults: &mut Vec<Fault>, inputs: &mut Vec<InputFile>) {
        faults.append(&mut self.faults);
        faults.append(&mut self.surveys.faults);
        inputs.append(&mut self.inputs);
        inputs.append(&mut self.surveys.inputs);
        inputs.append(&mut self.walls.inputs);
    }

    /// The values of a column of a table beside the study; `None` where they are faulty themselves.
    ///
    /// # Errors
    /// A fault at the reference when it names none.
    pub fn column(&mut self, reference: &str, asked: Asked) -> Result<Option<Vec<f64>>, Box<Fault>> {
        let values = self.surveys.column(reference, asked)?;
        let key = asked.path.strip_suffix(".values").unwrap_or(asked.path);
        self.note_survey(reference, key, values.as_ref().map(Vec::len));
        Ok(values)
    }

    /// Lengths and heights (m) of the stones in a table beside the study; `None` where they are faulty themselves.
    ///
    /// # Errors
    /// A fault at the reference when it names none.
    pub fn stones(
        &mut self,
        file: &str,
        asked: Asked,
        wall: [Option<f64>; 2],
    ) -> Result<Option<Vec<[f64; 2]>>, Box<Fault>> {
        let stones = self.surveys.pairs(file, ["length_m", "height_m"], asked, wall)?;
        self.note_survey(file, asked.path, stones.as_ref().map(Vec::len));
        Ok(stones)
    }

    /// The records that `files` of a table lists, each with where it is named; `None` where one of them is faulty.
    pub fn records(&mut self, t: &mut Reader<'_>) -> Option<Vec<(Motion, Place)>> {
        let files = t.files("files")?;
        let path = join(&t.path, "files");
        let (mut read, mut known) = (Vec::new(), Vec::new());
        for (file, node) in &files {
            let fault = |allowed: String, fix: &str| {
                let found = Found::Value(node.shown.clone());
                Box::new(Fault::at(&node.place, &path, found, allowed, fix))
            };
            match self.surveys.record(file, &fault) {
                Ok((motion, sha256)) => {
                    known.push(format!("{file} {sha256}"));
                    read.push((motion, node.place.clone()));
                }
                Err(fault) => t.notes.faults.push(*fault),
            }
        }
        t.record("files", known.join(", "));
        (read.len() == files.len()).then_some(read)
    }

    /// Where the file of a wall lies; of one whose bytes are known it does not matter.
    ///
    /// # Errors
    /// A fault, from what is allowed and how to mend it, where no such file lies in the study's folder.
    pub fn place_of_wall(
        &self,
        file: &str,
        fault: &dyn Fn(String, &str) -> Box<Fault>,
    ) -> Result<PathBuf, Box<Fault>> {
        if self.walls.bytes.contains_key(file) {
            return Ok(PathBuf::from(file));
        }
        self.surveys.beside_study(file, "a wall", "walls/left.json", fault)
    }

    fn note_survey(&mut self, reference: &str, path: &str, rows: Option<usize>) {
        let Some(rows) = rows else { return };
        let file = reference.split(':').next().unwrap_or(reference);
        self.note(Used {
            key: path.to_owned(),
            reference: reference.to_owned(),
            status: "measured".to_owned(),
            source: format!("{rows} rows of {file}"),
            from: self.surveys.place(file),
        });
    }

    fn note(&mut self, used: Used) {
        if !self.used.contains(&used) {
            self.used.push(used);
        }
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
        if file.contains('.') {
            let fix = format!(
                "for a column of a table write {{ family = \"empirical\", values = \"{reference}\" }}"
            );
            return Err(fault(form.to_owned(), fix));
        }
        if !file.split('/').all(is_name) || !is_name(entry) {
            return Err(fault(form.to_owned(), "use lower-case letters, digits, - and _".to_owned()));
        }
        if self.distributions.find(file).is_none() {
            let known = self.distributions.names();
            let listed: Vec<&str> = known.iter().map(String::as_str).filter(|name| !is_prior(name)).collect();
            return Err(fault(
                format!("a file of `distributions`: {}; or a prior", listed.join(", ")),
                suggestion(file, &known),
            ));
        }
        let Some(Held { file: held, faulty, origin }) = self.file(file) else { return Ok(None) };
        if faulty.iter().any(|f| f == entry) {
            return Ok(None);
        }
        let name = origin.name(file);
        let Some(found) = held.entries.get(entry).cloned() else {
            let names: Vec<&String> = held.entries.keys().collect();
            return Err(fault(format!("an entry of {name}"), suggestion(entry, &names)));
        };
        if held.unit != unit {
            return Err(fault(format!("a quantity in {unit}"), format!("{name} is in {}", held.unit)));
        }
        let used = Used {
            key: path.to_owned(),
            reference: reference.to_owned(),
            status: found.status,
            source: found.source,
            from: origin.place(file),
        };
        self.note(used);
        Ok(Some(found.family))
    }

    /// The file of that name, read once; `None` where there is none or it is faulty.
    fn file(&mut self, file: &str) -> Option<&Held> {
        if !self.files.contains_key(file) {
            let read = self.read(file);
            self.files.insert(file.to_owned(), read);
        }
        self.files.get(file).and_then(Option::as_ref)
    }

    fn read(&mut self, file: &str) -> Option<Held> {
        let read = self.distributions.read(file, 3 + self.files.len());
        let parsed = read.and_then(|found| {
            let Some((text, origin)) = found else { return Ok(None) };
            let path = PathBuf::from(&text.source.name);
            self.inputs.push(InputFile { path, sha256: text.sha256.clone() });
            Ok(Some((raw::parse(&text.source)?, origin)))
        });
        let (root, origin) = match parsed {
            Ok(found) => found?,
            Err(fault) => {
                self.faults.push(*fault);
                return None;
            }
        };
        let mut notes = Notes::default();
        let read = read_file(&root, &mut notes);
        self.faults.append(&mut notes.faults);
        read.map(|(file, faulty)| Held { file, faulty, origin })
    }
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
    let family = family(&mut reader, &mut |_, asked| Err(asked.without_a_table()));
    let (status, source) = (reader.choice_name("status"), reader.text("source"));
    let (n, note) = (reader.whole("n"), reader.text("note"));
    let entry = Distribution { family: family?, status: status?.to_owned(), source: source?, n, note };
    (notes.faults.len() == before).then_some(entry)
}

/// Reads and checks the files of these names, as `block/size`, as far as there are such files.
///
/// # Errors
/// All faults of all files.
pub fn read_distributions<S: AsRef<str>>(
    distributions: &Distributions,
    names: &[S],
) -> Result<BTreeMap<String, DistributionFile>, Faults> {
    let mut catalogue = Catalogue::of(distributions.clone());
    let mut read = BTreeMap::new();
    for name in names.iter().map(AsRef::as_ref) {
        if let Some(held) = catalogue.file(name) {
            read.insert(name.to_owned(), held.file.clone());
        }
    }
    if catalogue.faults.is_empty() { Ok(read) } else { Err(Faults::sorted(catalogue.faults)) }
}

/// Reads and checks every file below a `distributions` folder, by name as `block/size`.
///
/// # Errors
/// All faults of all files.
pub fn load_distributions(folder: &Path) -> Result<BTreeMap<String, DistributionFile>, Faults> {
    let distributions = Distributions::only_in(folder);
    read_distributions(&distributions, &distributions.names())
}
