//! Loading a study: every file read, every variant checked, every fault reported at once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::solve::REVISION;
use crate::study::build::{self, Parts};
use crate::study::catalogue::{Catalogue, Used};
use crate::study::checked::{Arm, InputFile, Study, SweptArm, Until};
use crate::study::demands::unfit_for;
use crate::study::earthquakes::Earthquakes;
use crate::study::fault::{Fault, Faults, Source};
use crate::study::files::TextFile;
use crate::study::measured::Known;
use crate::study::raw::{self, Node};
use crate::study::reader::{Notes, Reader, table_name};
use crate::study::readings::reading_name;
use crate::study::schema::suggestion;
use crate::study::stated::Stated;
use crate::study::variant::{self, Variant};
use crate::study::{csv, files, keys, measured, published, sweep};

/// A study and what is to be said about it.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The checked study.
    pub study: Study,
    /// What is allowed and yet looks wrong, as a kn of an unusual magnitude.
    pub warnings: Vec<Fault>,
    /// The variants that the study offers.
    pub variants: Vec<VariantName>,
    /// The entries of `distributions` that it takes, with their provenance.
    pub used: Vec<Used>,
    /// What its files state, to be written as another study.
    pub stated: Stated,
    /// How its measurements are written, if there are any.
    pub written: Option<measured::Written>,
}

/// A variant that a study offers.
#[derive(Clone, Debug, PartialEq, Eq, serde::Serialize)]
pub struct VariantName {
    /// Name, for the command line.
    pub name: String,
    /// Why somebody would read the study so.
    pub why: String,
    /// The paths of the keys that it sets or takes away.
    pub keys: Vec<String>,
}

/// One reading of the study: the base or a variant.
pub(super) struct Reading {
    root: Node,
    parts: Option<Parts>,
    sweep: Vec<SweptArm>,
    notes: Notes,
    used: Vec<Used>,
}

/// Names of the records of a base that shakes; none where it does not.
fn names(earthquakes: Option<&Earthquakes>) -> Vec<String> {
    let records = earthquakes.iter().flat_map(|earthquakes| &earthquakes.records);
    records.map(|record| record.name().to_owned()).collect()
}

impl Loaded {
    /// The same study with the measurements of another file.
    ///
    /// # Errors
    /// All faults of the file.
    pub fn with_measured(mut self, path: &Path) -> Result<Loaded, Faults> {
        let name = path.display().to_string();
        let file = files::read(path, &name, 0, csv::FORMAT).map_err(|fault| Faults::sorted(vec![*fault]))?;
        // As beside the study: a variant that evaluates fewer arms reads the same files.
        let arms = self.stated.arms();
        let records = names(self.study.earthquakes.as_ref());
        let known = Known { arms: arms.as_deref(), records: Some(&records) };
        let read = measured::read(&file.source, known).map_err(Faults::sorted)?;
        (self.study.measured, self.written) = (read.rows, read.written);
        let of_the_studys_own = |warning: &Fault| warning.file == measured::FILE;
        self.warnings.retain(|warning| !of_the_studys_own(warning));
        self.warnings.extend(read.warnings);
        self.study.inputs.retain(|input| input.path != Path::new(measured::FILE));
        self.study.inputs.push(InputFile { path: path.to_path_buf(), sha256: file.sha256.clone() });
        self.stated.measured = Some(file);
        Ok(self)
    }
}

impl Study {
    /// Loads and checks the study in `folder` (study.toml, published.toml and measured.csv if there are any, and the files of its
    /// [`Distributions`](crate::study::Distributions) and the surveys that it refers to), as the variant of that name reads it; as several do together, if their names are
    /// joined by a plus.
    ///
    /// All variants are checked, whichever is asked for.
    ///
    /// # Errors
    /// All faults of all files.
    pub fn load(folder: &Path, variant: Option<&str>) -> Result<Loaded, Faults> {
        let folder = existing(folder).map_err(|fault| Faults::sorted(vec![*fault]))?;
        let mut faults = Vec::new();
        let mut inputs = Vec::new();
        let root = parsed(&folder, "study.toml", 0, &mut inputs, &mut faults);
        let published_root = if folder.join("published.toml").exists() {
            parsed(&folder, "published.toml", 1, &mut inputs, &mut faults)
        } else {
            None
        };
        let published_text = published_root.as_ref().map(|root| root.place.source.clone());
        let mut catalogue = Catalogue::of_study(&folder);
        let mut notes = Notes::default();
        let variants = root.as_ref().map_or_else(Vec::new, |root| variant::read(root, &mut notes));
        let chosen = choose(variant, &variants, root.as_ref(), &mut notes);
        let reading =
            root.as_ref().map(|root| read_all(root, &variants, &chosen, &mut catalogue, &mut notes.faults));
        let arms = root.as_ref().and_then(arm_names);
        let claims = published_root
            .map(|root| published::read(&root, arms.as_deref(), &mut notes))
            .unwrap_or_default();
        let measured_file = measurements(&folder, &mut inputs, &mut faults);
        let parts = reading.as_ref().and_then(|reading| reading.parts.as_ref());
        let records = parts.map(|parts| names(parts.earthquakes.as_ref()));
        let measured = measured_file.as_ref().and_then(|file| {
            let known = Known { arms: arms.as_deref(), records: records.as_deref() };
            let read = measured::read(&file.source, known);
            read.map_err(|mut found| faults.append(&mut found)).ok()
        });
        faults.append(&mut notes.faults);
        catalogue.hand_over(&mut faults, &mut inputs);
        match reading {
            Some(Reading { parts: Some(parts), root, sweep, notes: found, used }) if faults.is_empty() => {
                let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                let mut effective = found.effective;
                record_revision(&mut effective);
                let hash = hash_of(&effective);
                let read = measured.unwrap_or_default();
                let study = Study {
                    name,
                    question: parts.question,
                    seed: parts.seed,
                    moves: Arc::default(),
                    shift: Arc::default(),
                    design: parts.design,
                    taken: None,
                    variant: joined(&chosen),
                    arms: parts.arms,
                    sweep,
                    protocol: parts.protocol,
                    earthquakes: parts.earthquakes,
                    solver: parts.solver,
                    agreement: parts.agreement,
                    published: claims,
                    demand: None,
                    measured: read.rows,
                    inputs,
                    effective,
                    hash,
                };
                let name_of =
                    |v: &Variant| VariantName { name: v.name.clone(), why: v.why.clone(), keys: v.keys() };
                let warnings =
                    Faults::sorted([notes.warnings, found.warnings, read.warnings].concat()).faults;
                let variants = variants.iter().map(name_of).collect();
                let stated = Stated::of(root, &mut catalogue, published_text, measured_file);
                Ok(Loaded { study, warnings, variants, used, stated, written: read.written })
            }
            _ => {
                crate::check!(!faults.is_empty(), "the study was refused without a fault");
                Err(Faults::sorted(faults))
            }
        }
    }

    /// The same study with another seed.
    pub fn with_seed(mut self, seed: u64) -> Study {
        self.seed = seed;
        self.earthquakes = self.earthquakes.map(|own| own.seeded(seed));
        self.stating([("study.seed", seed.to_string())])
    }

    /// The same study with the solver of that name, `explicit`, `implicit`, `nonsmooth` or `limit`: with the study's own settings if it is the
    /// study's own solver, else with that solver's defaults.
    ///
    /// # Errors
    /// The fault, where no solver has that name, or where that solver does not go with what the study asks for.
    pub fn with_solver(mut self, name: &str) -> Result<Study, Faults> {
        if self.effective.get("solver.name").is_some_and(|own| own == name) {
            return Ok(self);
        }
        let mut notes = Notes::default();
        let text = format!("name = \"{name}\"");
        let source = Arc::new(Source { name: "solver asked for".to_owned(), rank: 0, text });
        let node = raw::parse(&source).map_err(|fault| Faults::sorted(vec![*fault]))?;
        let solver =
            Reader::open(&node, "solver", &keys::SOLVER, &mut notes).and_then(|mut t| build::solver(&mut t));
        let Some(solver) = solver else { return Err(Faults::sorted(notes.faults)) };
        let unfit = unfit_for(&solver, &self.arms, &self.protocol, self.agreement);
        let faults: Vec<Fault> =
            unfit.into_iter().map(|unfit| build::beyond(&node.place, &solver, unfit)).collect();
        if !faults.is_empty() {
            return Err(Faults::sorted(faults));
        }
        self.solver = solver;
        self.effective.retain(|key, _| !key.starts_with("solver.") || key == "solver.agreement");
        Ok(self.stating(notes.effective))
    }

    /// The same study with values that decide its results, by the paths of their keys, and the hash that follows from all of them.
    pub(super) fn stating<K: Into<String>>(mut self, values: impl IntoIterator<Item = (K, String)>) -> Study {
        self.effective.extend(values.into_iter().map(|(key, value)| (key.into(), value)));
        self.hash = hash_of(&self.effective);
        self
    }

    /// A study of other arms that follow from this one and from what is stated, by key; nothing measured or published is said
    /// of them.
    pub fn of_arms(mut self, name: String, arms: Vec<Arm>, decided_by: BTreeMap<String, String>) -> Study {
        self.name = name;
        self.arms = arms;
        self.measured.clear();
        self.published.clear();
        self.stating(decided_by)
    }

    /// Whether its design can share out so many walls.
    ///
    /// # Errors
    /// What is allowed, in words.
    pub fn takes_members(&self, members: u64) -> Result<(), String> {
        build::members_fit(self.design, &self.clone().with_members(members).arms)
    }

    /// The same study with another number of walls in every arm that has more than one, whatever it says of enough; at least one.
    pub fn with_members(mut self, members: u64) -> Study {
        let mut values = Vec::new();
        for arm in self.arms.iter_mut().filter(|arm| arm.members > 1) {
            (arm.members, arm.until) = (members.max(1), None);
            let path = format!("arm.{}.members", arm.name);
            self.effective.retain(|key, _| !key.starts_with(&format!("{path}.")));
            values.push((path, arm.members.to_string()));
        }
        self.stating(values)
    }
}

impl Study {
    /// The same study with walls added to every random arm until there are enough, in the place of what it says of their number.
    pub fn with_until(mut self, until: Until) -> Study {
        let mut values = Vec::new();
        for arm in self.arms.iter_mut().filter(|arm| arm.is_random()) {
            (arm.members, arm.until) = (until.at_most, Some(until));
            let path = format!("arm.{}.members", arm.name);
            self.effective.remove(&path);
            values.extend([
                (format!("{path}.until"), "half_width".to_owned()),
                (format!("{path}.of"), until.of.name()),
                (format!("{path}.below"), format!("{:?}", until.below)),
                (format!("{path}.at_most"), until.at_most.to_string()),
            ]);
        }
        self.stating(values)
    }
}

/// Puts the state of laws and solvers among the values that decide a result.
pub(super) fn record_revision(effective: &mut BTreeMap<String, String>) {
    effective.insert("revision of laws and solvers".to_owned(), REVISION.to_string());
}

/// SHA-256 (hex) over the effective values in the order of their keys, one line each.
pub(super) fn hash_of(effective: &BTreeMap<String, String>) -> String {
    let lines: String = effective.iter().map(|(key, value)| format!("{key} = {value}\n")).collect();
    files::sha256(lines.as_bytes())
}

/// The study's folder, which must exist.
pub(super) fn existing(folder: &Path) -> Result<PathBuf, Box<Fault>> {
    let shown = folder.display().to_string();
    let fault = |found: &str, fix: String| {
        Err(Box::new(Fault::of_file(&shown, 0, found, "the folder of a study", fix)))
    };
    if folder.is_file() {
        return fault("is a file", "give the folder that holds it".to_owned());
    }
    match folder.canonicalize() {
        Ok(folder) => Ok(folder),
        Err(_) => fault("does not exist", files::similar(folder)),
    }
}

pub(super) fn parsed(
    folder: &Path,
    name: &str,
    rank: usize,
    inputs: &mut Vec<InputFile>,
    faults: &mut Vec<Fault>,
) -> Option<Node> {
    let read = files::read(&folder.join(name), name, rank, raw::FORMAT).and_then(|file| {
        inputs.push(InputFile { path: PathBuf::from(name), sha256: file.sha256 });
        raw::parse(&file.source)
    });
    read.map_err(|fault| faults.push(*fault)).ok()
}

/// measured.csv; `None` where there is none.
fn measurements(folder: &Path, inputs: &mut Vec<InputFile>, faults: &mut Vec<Fault>) -> Option<TextFile> {
    let path = folder.join(measured::FILE);
    if !path.exists() {
        return None;
    }
    let file = files::read(&path, measured::FILE, 2, csv::FORMAT);
    let file = file.map_err(|fault| faults.push(*fault)).ok()?;
    inputs.push(InputFile { path: PathBuf::from(measured::FILE), sha256: file.sha256.clone() });
    Some(file)
}

/// The variants asked for: those with names in the order of the file, then those that say what they set. Where two of them change the
/// same key their order decides which one holds: then it is the order asked for, and a warning says so.
fn choose(
    wanted: Option<&str>,
    variants: &[Variant],
    root: Option<&Node>,
    notes: &mut Notes,
) -> Vec<Variant> {
    let Some(wanted) = wanted.filter(|_| root.is_some()) else { return Vec::new() };
    let names: Vec<&str> = variants.iter().map(|v| v.name.as_str()).collect();
    // By the places that they have in the file, and behind them.
    let mut asked: Vec<(usize, Variant)> = Vec::new();
    for own in wanted.split(variant::TOGETHER) {
        if own.contains(variant::SETS) {
            match variant::asked_for(own) {
                Ok(set) => asked.push((variants.len(), set)),
                Err(fault) => notes.faults.push(*fault),
            }
        } else if let Some(place) = names.iter().position(|name| *name == own) {
            if asked.iter().all(|(other, _)| *other != place) {
                asked.push((place, variants[place].clone()));
            }
        } else {
            let words = format!("has no variant \"{own}\"");
            let allowed = match names.is_empty() {
                true => "no variant at all".to_owned(),
                false => format!("one of {}", names.join(", ")),
            };
            notes.faults.push(Fault::of_file("study.toml", 0, &words, &allowed, suggestion(own, &names)));
        }
    }
    let mut overlaid = Vec::new();
    for (index, (_, later)) in asked.iter().enumerate() {
        for (_, earlier) in &asked[..index] {
            if let Some(key) = variant::shared_key(&later.keys(), &earlier.keys()) {
                let words = format!("is changed by {} and by {}", earlier.name, later.name);
                let allowed = format!("this, and the later one holds, {}", later.name);
                let fix = "leave one of them out if that is not what you mean";
                overlaid.push(Fault::of_file("study.toml", 0, &words, &allowed, fix).of_key(key));
            }
        }
    }
    if overlaid.is_empty() {
        asked.sort_by_key(|(place, _)| *place);
    }
    notes.warnings.append(&mut overlaid);
    asked.into_iter().map(|(_, variant)| variant).collect()
}

/// The name of variants that are read together; `None` of the base.
fn joined(chosen: &[Variant]) -> Option<String> {
    let names: Vec<String> = chosen.iter().map(|variant| variant.name.clone()).collect();
    reading_name(&names)
}

/// Reads the base and every variant, and answers with the reading asked for.
pub(super) fn read_all(
    root: &Node,
    variants: &[Variant],
    chosen: &[Variant],
    catalogue: &mut Catalogue,
    faults: &mut Vec<Fault>,
) -> Reading {
    let mut answer = read_one(root, catalogue);
    faults.append(&mut answer.notes.faults.clone());
    for variant in variants {
        let reading = read_changed(root, std::slice::from_ref(variant), catalogue, faults);
        if let [alone] = chosen
            && alone.name == variant.name
        {
            answer = reading;
        }
    }
    // Variants that are sound alone may still not go together, and one that says what it sets has not been read yet.
    let is_named = |own: &Variant| variants.iter().any(|variant| variant.name == own.name);
    if (chosen.len() > 1 || !chosen.iter().all(is_named)) && faults.is_empty() {
        answer = read_changed(root, chosen, catalogue, faults);
    }
    answer
}

/// The reading of variants together; faults that are not there yet are put to the others.
fn read_changed(
    root: &Node,
    variants: &[Variant],
    catalogue: &mut Catalogue,
    faults: &mut Vec<Fault>,
) -> Reading {
    let mut notes = Notes::default();
    let changed = variants.iter().fold(root.clone(), |root, variant| variant.apply(&root, &mut notes));
    faults.append(&mut notes.faults);
    let mut reading = read_one(&changed, catalogue);
    let name = joined(variants).unwrap_or_default();
    for fault in reading.notes.faults.drain(..) {
        if !faults.iter().any(|f| f.repeats(&fault)) {
            faults.push(fault.in_variant(&name));
        }
    }
    reading
}

fn read_one(root: &Node, catalogue: &mut Catalogue) -> Reading {
    let mut notes = Notes::default();
    catalogue.used.clear();
    let (arms, sweep) = sweep::expanded(root, &mut notes);
    let parts = build::parts(&arms, &mut notes, catalogue);
    Reading { root: root.clone(), parts, sweep, notes, used: std::mem::take(&mut catalogue.used) }
}

/// Names of the arms, as far as they are valid names.
pub(super) fn arm_names(root: &Node) -> Option<Vec<String>> {
    let raw::Value::Table(table) = &root.value else { return None };
    let raw::Value::List(list) = &table.get("arm")?.node.value else { return None };
    Some(list.iter().filter_map(|node| table_name(node).map(str::to_owned)).collect())
}
