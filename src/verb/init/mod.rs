//! `pirca init`: a study to begin with, commented, or as a copy of another one; or an empty table of measurements.

mod measurements;

use std::fs;
use std::path::{Path, PathBuf};

use clap::Args;
use serde_json::json;

use crate::ensemble::replace_file;
use crate::math::edit_distance;
use crate::study::{
    BuiltInStudy, Distributions, ElementStudy, InputFile, MEASURED, Schema, Study, Template,
    built_in_studies, distributions_among,
};
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::arguments::{OUTPUT, STUDY, Which};
use crate::verb::locate;

/// Of `init`.
pub(crate) const HELP: &str = concat!(
    "\
Example: pirca init my-wall
         pirca run my-wall
         pirca init my-tests --from tilting-table
         pirca init my-tests.csv --measured studies/tilting-table --wide

Built in are arrangements, bearing, dry-shear-walls, earthquake, edge-restraint, element-types, homogenisation, joint-arrangement, retaining, \
sources-of-scatter, tilting-block and tilting-table. A folder that exists is left alone: choose another name. \
With --measured it writes an empty table for a spreadsheet, for measurements on the arms of a study; `pirca check --measured` reads it.

",
    codes!()
);

/// Heading of the options of a table of measurements.
const TABLE: &str = "Table of measurements";

/// Arguments of `init`.
#[derive(Args, Debug)]
pub(crate) struct Init {
    /// The new folder, or one that is empty: a name here, or a path. Its last part is the study's name. With --measured the new file.
    pub name: PathBuf,
    /// Copy this study: the folder of one, or one that is built in.
    #[arg(long, value_name = "STUDY", help_heading = STUDY)]
    pub from: Option<PathBuf>,
    /// Write an empty table of measurements for the arms, the specimens and the tilts of this study instead.
    #[arg(long, value_name = "STUDY", conflicts_with = "from", help_heading = TABLE)]
    pub measured: Option<PathBuf>,
    /// A row per specimen and tilt, with a column per quantity, instead of a row per value.
    #[arg(long, requires = "measured", help_heading = TABLE)]
    pub wide: bool,
    /// Specimens of each arm in the empty table [default: 3].
    #[arg(long, value_name = "N", requires = "measured", default_value_t = 3, hide_default_value = true, value_parser = clap::value_parser!(u32).range(1..=1000), help_heading = TABLE)]
    pub specimens: u32,
    /// The study as this variant of it.
    #[arg(long, value_name = "NAME", requires = "measured", help_heading = TABLE)]
    pub variant: Option<String>,
    /// Print one JSON object on standard output instead of text.
    #[arg(long, help_heading = OUTPUT)]
    pub json: bool,
}

/// The study that is written where no other one is named.
const TEMPLATE: &str = include_str!("template.toml");
/// What a study reads in its folder.
const FILES: [&str; 3] = ["study.toml", "published.toml", MEASURED];
/// How a line of a TOML file tells an editor of its schema.
const TELLS: &str = "#:schema";

/// What a new study is made from.
enum Origin {
    Template,
    BuiltIn(BuiltInStudy),
    Folder(PathBuf),
}

/// Writes the study, whole or not at all.
pub(crate) fn init(arguments: &Init) -> Result<Answer, Failure> {
    let folder = &arguments.name;
    if let Some(study) = &arguments.measured {
        let which = Which { study: study.clone(), variant: arguments.variant.clone(), json: arguments.json };
        let wanted = Template { specimens: arguments.specimens, wide: arguments.wide };
        return measurements::begin(folder, &which, wanted);
    }
    // A folder that is there may be named by dots.
    let there = folder.canonicalize().unwrap_or_default();
    let name = match folder.file_name().or(there.file_name()) {
        Some(name) => name.to_string_lossy().into_owned(),
        None => {
            let text = "a name is needed for the new folder, as my-wall or studies/my-wall";
            return Err(Failure::Usage(format!("init {}: {text}", folder.display())));
        }
    };
    if !locate::is_free(folder) {
        let what = if folder.is_dir() { "is a folder with files in it" } else { "exists already" };
        return Err(Failure::Usage(format!(
            "init {0}: {0} {what}; choose another name, or remove it first",
            folder.display()
        )));
    }
    let was_there = folder.is_dir();
    let origin = Origin::named(arguments.from.as_deref())?;
    output::folder(folder)?;
    let written = origin.write(folder, &name).inspect_err(|_| {
        // It was not there before, or empty: nothing of anybody else's is in it.
        let _ = fs::remove_dir_all(folder);
        if was_there {
            let _ = fs::create_dir(folder);
        }
    })?;
    let text = format!(
        "{0}: a study from {1}: {2}\nnext: pirca run {0}\n",
        folder.display(),
        origin.words(),
        written.join(", ")
    );
    let object = json!({"study": name, "folder": folder, "from": origin.words(), "files": written});
    Ok(Answer::of(text, &object)?.in_place(folder))
}

impl Origin {
    /// The template, a study on the disk, or one that is built in; a study on the disk goes first.
    fn named(from: Option<&Path>) -> Result<Origin, Failure> {
        let Some(from) = from else { return Ok(Origin::Template) };
        let found = locate::folder(from);
        if let Ok(folder) = found {
            return Ok(Origin::Folder(folder));
        }
        let mut studies = built_in_studies();
        if let Some(at) = studies.iter().position(|study| Path::new(study.name) == from) {
            return Ok(Origin::BuiltIn(studies.swap_remove(at)));
        }
        let wanted = from.to_string_lossy();
        studies.sort_by_key(|study| edit_distance(&wanted, study.name));
        let names: Vec<&str> = studies.iter().map(|study| study.name).collect();
        let hint = names.first().filter(|name| 2 * edit_distance(&wanted, name) <= name.len());
        let hint = hint.map_or(String::new(), |name| format!("; did you mean \"{name}\"?"));
        Err(Failure::Usage(format!(
            "--from {wanted}: neither the folder of a study nor one that is built in{hint}\nbuilt in are: {}",
            names.join(", ")
        )))
    }

    /// What it is, in words.
    fn words(&self) -> String {
        match self {
            Origin::Template => "the template".to_owned(),
            Origin::BuiltIn(study) => format!("the built-in study {}", study.name),
            Origin::Folder(folder) => folder.display().to_string(),
        }
    }

    /// Where its distributions are found.
    fn distributions(&self) -> Distributions {
        match self {
            Origin::Template | Origin::BuiltIn(_) => Distributions::built_in(),
            Origin::Folder(folder) => Distributions::of_study(folder),
        }
    }

    /// The texts of the study's own files.
    fn files(&self) -> Result<Vec<(String, Vec<u8>)>, Failure> {
        match self {
            Origin::Template => Ok(vec![(FILES[0].to_owned(), TEMPLATE.into())]),
            Origin::BuiltIn(study) => {
                Ok(study.files.iter().map(|(name, text)| (name.to_string(), (*text).into())).collect())
            }
            Origin::Folder(folder) => {
                let own = FILES.into_iter().map(str::to_owned).filter(|name| folder.join(name).exists());
                let read = |name: String| {
                    let path = folder.join(&name);
                    let bytes = fs::read(&path).map_err(|error| {
                        Failure::Input(format!("cannot read {}: {error}", path.display()))
                    })?;
                    Ok((name, bytes))
                };
                own.chain(surveys(&inputs(folder)?)).map(read).collect()
            }
        }
    }

    /// Writes everything into a folder, and gives the names of the files.
    fn write(&self, folder: &Path, name: &str) -> Result<Vec<String>, Failure> {
        let mut written = Vec::new();
        let mut put = |name: String, bytes: &[u8]| -> Result<(), Failure> {
            let path = folder.join(&name);
            if let Some(parent) = path.parent() {
                output::folder(parent)?;
            }
            replace_file(&path, bytes)?;
            written.push(name);
            Ok(())
        };
        let files = self.files()?;
        for (name, bytes) in &files {
            if name != FILES[0] {
                put(name.clone(), bytes)?;
                continue;
            }
            let schema = schema_of(bytes);
            put(name.clone(), &with_schema(bytes, schema))?;
            put(schema.file().to_owned(), schema.text().as_bytes())?;
        }
        // What the copy would read otherwise, or not find at all, goes with it; it may not load without.
        let distributions = self.distributions();
        let names = match self {
            Origin::Folder(own) => distributions_among(&inputs(own)?),
            Origin::Template | Origin::BuiltIn(_) => distributions.names(),
        };
        let missing = distributions.missing_from(&Distributions::of_study(folder), names)?;
        // A study that is built in may bring distributions of its own.
        for (name, text) in missing.into_iter().filter(|(name, _)| files.iter().all(|(own, _)| own != name)) {
            put(name, text.as_bytes())?;
        }
        put("README.md".to_owned(), self.readme(folder, name).as_bytes())?;
        inputs(folder)?;
        Ok(written)
    }

    /// What to do with it, and what to change.
    fn readme(&self, folder: &Path, name: &str) -> String {
        let (from, change) = match self {
            Origin::Template => (
                "How far a dry stone wall can be tilted before it falls: a study to begin with.".to_owned(),
                "the size of the wall (`[wall]`), its stones (`length_m`, `height_m`, `dip_deg` of the arm \
                 irregular), friction and stiffness of its joints (`[joint]`), and the number of walls (`members`)",
            ),
            _ => (
                format!(
                    "Begun as a copy of {}. Comments that name a README.md mean that study's own.",
                    self.words()
                ),
                "the question and the seed (`[study]`), then the wall (`[wall]`), its joints (`[joint]`) and the kinds of \
                 wall that are compared (`[[arm]]`)",
            ),
        };
        let shown = folder.display();
        format!(
            "# {name}\n\n{from}\n\n    pirca check {shown}\n    pirca run {shown}\n\nChange in `study.toml`, first of all: {change}. \
             `pirca reference keys` lists every key.\n"
        )
    }
}

/// The schema that a study.toml is written by.
fn schema_of(study: &[u8]) -> Schema {
    let keys: Option<toml::Table> = toml::from_str(&String::from_utf8_lossy(study)).ok();
    match keys.is_some_and(|keys| keys.contains_key("element")) {
        true => Schema::ElementStudy,
        false => Schema::Study,
    }
}

/// A study.toml that tells editors of the schema beside it, in its first line; one that tells of a schema on the net keeps it.
fn with_schema(study: &[u8], schema: Schema) -> Vec<u8> {
    let told = study.starts_with(TELLS.as_bytes());
    let first = study.iter().position(|byte| *byte == b'\n').map_or(study.len(), |at| at + 1);
    let own = if told { &study[..first] } else { &[] };
    if own.windows(3).any(|three| three == b"://") {
        return study.to_vec();
    }
    let line = format!("{TELLS} ./{}\n", schema.file());
    [line.as_bytes(), &study[own.len()..]].concat()
}

/// The tables beside a study that it takes distributions from.
fn surveys(inputs: &[InputFile]) -> Vec<String> {
    let is_other = |input: &&InputFile| {
        FILES.iter().all(|name| input.path != Path::new(name))
            && distributions_among(std::slice::from_ref(*input)).is_empty()
    };
    inputs.iter().filter(is_other).map(|input| input.path.display().to_string()).collect()
}

/// What the study in a folder reads, which is sound.
fn inputs(folder: &Path) -> Result<Vec<InputFile>, Failure> {
    if ElementStudy::is_in(folder) {
        return Ok(ElementStudy::load(folder)?.inputs);
    }
    Ok(Study::load(folder, None)?.study.inputs)
}
