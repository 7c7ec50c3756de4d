//! Where the distributions of a study lie: one place decides it for references, priors and messages.

use std::fmt;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::study::built_in::distributions;
use crate::study::checked::InputFile;
use crate::study::fault::{Fault, Faults, Source};
use crate::study::files::{self, TextFile};
use crate::study::raw;

/// Name of the folder.
pub const FOLDER: &str = "distributions";
/// What stands before the name of a file that is built in.
const BUILT_IN: &str = "built-in:";

/// Folders and a file: as deep as `mechanism/creep/rate_per_deg`.
const DEEPEST: usize = 3;
/// Folders of the priors, which every diagnosis reads.
const PRIORS: [&str; 2] = ["mechanism/", "nuisance/"];

/// Where files of distributions are looked for: folders, the nearest first, then what is built in. Each file is taken where it is
/// found first, so that a study may bring some of its own.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Distributions {
    folders: Vec<PathBuf>,
    built_in: bool,
}

/// Where a file of distributions was found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Origin {
    /// In a file on the disk.
    File(PathBuf),
    /// In the program, with its text.
    BuiltIn(&'static str),
}

impl Distributions {
    /// Those of a study: of the folders `distributions` in the study's own folder, beside it and further up, nearest first; else
    /// built in. Where the study does not exist they are sought by the path as written.
    pub fn of_study(study: &Path) -> Distributions {
        let study = study.canonicalize().unwrap_or_else(|_| study.to_path_buf());
        let folders = study.ancestors().map(|folder| folder.join(FOLDER)).filter(|folder| folder.is_dir());
        Distributions { folders: folders.collect(), built_in: true }
    }

    /// Those that are built in.
    pub fn built_in() -> Distributions {
        Distributions { folders: Vec::new(), built_in: true }
    }

    /// Those in one folder and nowhere else.
    pub fn only_in(folder: &Path) -> Distributions {
        Distributions { folders: vec![folder.to_path_buf()], built_in: false }
    }

    /// Where the file of that name, as `block/size`, is found first.
    pub fn find(&self, file: &str) -> Option<Origin> {
        let on_disk = self.folders.iter().map(|folder| folder.join(format!("{file}.toml")));
        let built_in = || {
            let path = format!("{FOLDER}/{file}.toml");
            let own = distributions().find(|(name, _)| *name == path).filter(|_| self.built_in);
            own.map(|(_, text)| Origin::BuiltIn(text))
        };
        on_disk.into_iter().find(|path| stands_at(path)).map(Origin::File).or_else(built_in)
    }

    /// Names of all files, as `block/size`, sorted.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> = self.folders.iter().flat_map(|folder| names_below(folder)).collect();
        if self.built_in {
            let own = distributions().filter_map(|(path, _)| {
                path.strip_prefix(FOLDER)?.strip_prefix('/')?.strip_suffix(".toml").map(str::to_owned)
            });
            names.extend(own);
        }
        names.sort();
        names.dedup();
        names
    }

    /// The text of a file, shown as `distributions/block/size.toml`, or as `built-in:distributions/block/size.toml`; `None`
    /// where there is none of that name.
    ///
    /// # Errors
    /// A fault when it cannot be read.
    pub(super) fn read(&self, file: &str, rank: usize) -> Result<Option<(TextFile, Origin)>, Box<Fault>> {
        let Some(origin) = self.find(file) else { return Ok(None) };
        let name = origin.name(file);
        let read = match &origin {
            Origin::File(path) => files::read(path, &name, rank, raw::FORMAT)?,
            Origin::BuiltIn(text) => TextFile {
                sha256: files::sha256(text.as_bytes()),
                source: Arc::new(Source { name, rank, text: (*text).to_owned() }),
            },
        };
        Ok(Some((read, origin)))
    }
}

impl Distributions {
    /// What a study would miss that takes the files of these names, as `block/size`, if it looked elsewhere instead: those, and
    /// priors, that are not there or say something else; name, as `distributions/block/size.toml`, and text.
    ///
    /// # Errors
    /// The fault of a file that cannot be read.
    pub fn missing_from(
        &self,
        elsewhere: &Distributions,
        mut names: Vec<String>,
    ) -> Result<Vec<(String, String)>, Faults> {
        let one = |fault: Box<Fault>| Faults::sorted(vec![*fault]);
        names.extend(self.names().into_iter().filter(|name| is_prior(name)));
        names.sort();
        names.dedup();
        let mut missing = Vec::new();
        for name in names {
            let Some((own, _)) = self.read(&name, 0).map_err(one)? else { continue };
            let found = elsewhere.read(&name, 0).map_err(one)?;
            if found.is_none_or(|(found, _)| found.sha256 != own.sha256) {
                missing.push((format!("{FOLDER}/{name}.toml"), own.source.text.clone()));
            }
        }
        Ok(missing)
    }
}

impl From<&Distributions> for Distributions {
    fn from(distributions: &Distributions) -> Self {
        distributions.clone()
    }
}

impl From<&PathBuf> for Distributions {
    fn from(folder: &PathBuf) -> Self {
        Distributions::only_in(folder)
    }
}

impl Origin {
    /// How the file `block/size` is called that lies there.
    pub fn name(&self, file: &str) -> String {
        match self {
            Origin::File(_) => format!("{FOLDER}/{file}.toml"),
            Origin::BuiltIn(_) => format!("{BUILT_IN}{FOLDER}/{file}.toml"),
        }
    }

    /// Where it lies: the path of its file, or the name of what is built in.
    pub fn place(&self, file: &str) -> String {
        match self {
            Origin::File(path) => path.display().to_string(),
            Origin::BuiltIn(_) => self.name(file),
        }
    }
}

impl fmt::Display for Distributions {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let folders: Vec<String> = self.folders.iter().map(|folder| folder.display().to_string()).collect();
        let built_in = self.built_in.then(|| "what is built in".to_owned());
        write!(f, "{}", folders.into_iter().chain(built_in).collect::<Vec<_>>().join(", "))
    }
}

/// Whether a file holds a prior.
pub(super) fn is_prior(file: &str) -> bool {
    PRIORS.iter().any(|folder| file.starts_with(folder))
}

/// The files of distributions, as `block/size`, among the inputs of a study.
pub fn distributions_among(inputs: &[InputFile]) -> Vec<String> {
    inputs.iter().filter_map(|input| file_of(&input.path)).collect()
}

fn file_of(input: &Path) -> Option<String> {
    let name = input.to_string_lossy();
    let name = name.strip_prefix(BUILT_IN).unwrap_or(&name);
    Some(name.strip_prefix(FOLDER)?.strip_prefix('/')?.strip_suffix(".toml")?.to_owned())
}

/// Whether something stands at a path, though it may be a folder or unreadable: a fault of that place, which is not passed by.
fn stands_at(path: &Path) -> bool {
    match path.symlink_metadata() {
        Ok(_) => true,
        Err(error) => !matches!(error.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory),
    }
}

/// Names of the files below a folder, as `block/size`.
fn names_below(folder: &Path) -> Vec<String> {
    let list = |folder: &Path, depth: usize| -> Vec<(PathBuf, usize)> {
        let entries = std::fs::read_dir(folder).map(|e| e.flatten().map(|e| (e.path(), depth)).collect());
        entries.unwrap_or_default()
    };
    let mut pending = list(folder, 1);
    let mut names = Vec::new();
    while let Some((path, depth)) = pending.pop() {
        if path.is_dir() {
            // A folder of that name further up may be anybody's, and hold anything.
            if depth < DEEPEST {
                pending.extend(list(&path, depth + 1));
            }
        } else if path.extension().is_some_and(|e| e == "toml")
            && let Ok(inner) = path.strip_prefix(folder)
        {
            let parts: Vec<_> =
                inner.with_extension("").iter().map(|p| p.to_string_lossy().into_owned()).collect();
            names.push(parts.join("/"));
        }
    }
    names
}
