//! From what the user typed to a checked study.

use std::fs;
use std::path::{Path, PathBuf};

use crate::ensemble::Manifest;
use crate::exchange::Format;
use crate::math::edit_distance;
use crate::study::{Distributions, ElementStudy, Fault, Loaded, Study, built_in_studies};
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::arguments::{Ensemble, Which, quoted};

/// The study that the arguments name, for a verb that asks for one number of each wall: see [`any_study`].
pub(crate) fn study(which: &Which) -> Result<Loaded, Failure> {
    let loaded = any_study(which)?;
    if let Some(earthquakes) = &loaded.study.earthquakes {
        output::warning(&format!(
            "{}: the number of a wall is the lowest of {} intensities at which some record brings it down; it may fall between that and \
             the one below: state them closer where it matters",
            loaded.study.name,
            earthquakes.intensities.len()
        ));
    }
    Ok(loaded)
}

/// The same for a verb that sets measurements beside simulated walls: a wall that is shaken has none of their readings.
pub(crate) fn measurable(which: &Which) -> Result<Loaded, Failure> {
    let loaded = any_study(which)?;
    not_shaken(
        &loaded.study,
        "what is measured is read on walls at rest, at a tilt or under a push, and a wall that is shaken is at none; take a study with \
         another load",
    )?;
    Ok(loaded)
}

/// That a study does not shake its walls; `why` says what they lack then.
pub(crate) fn not_shaken(study: &Study, why: &str) -> Result<(), Failure> {
    match study.earthquakes {
        None => Ok(()),
        Some(_) => Err(Failure::Input(format!("{}: load.protocol is \"base_motion\": {why}", study.name))),
    }
}

/// Loads the study that the arguments name, in the variant asked for, and passes its warnings on to standard error.
pub(crate) fn any_study(which: &Which) -> Result<Loaded, Failure> {
    let folder = folder(&which.study)?;
    if ElementStudy::is_in(&folder) {
        let text = format!(
            "{} compares types of elements: each is shoved by one load and stands or falls, so that it has no capacity, no measured \
             reading and no wall to draw; pirca run, report and check take it",
            folder.display()
        );
        return Err(Failure::Input(text));
    }
    let loaded = Study::load(&folder, which.variant.as_deref())?;
    loaded.warnings.iter().for_each(warn);
    Ok(loaded)
}

/// Says what is allowed and yet looks wrong on standard error.
pub(crate) fn warn(warning: &Fault) {
    output::warning(&warning.to_string());
}

/// The study with another number of walls in every random arm, of which it must have one.
pub(crate) fn with_members(study: Study, members: u64) -> Result<Study, Failure> {
    if members > 1 && study.arms.iter().all(|arm| arm.members == 1) {
        return Err(Failure::Usage(format!(
            "--members {members}: every arm of {} has one wall; leave it out, or set members of a random arm in study.toml",
            study.name
        )));
    }
    study.takes_members(members).map_err(|allowed| {
        Failure::Usage(format!(
            "--members {members}: allowed for study.design of {} is {allowed}",
            study.name
        ))
    })?;
    Ok(study.with_members(members))
}

/// The study, in which nothing may be drawn in the place of what a diagnosis reckons with by priors of its own.
pub(crate) fn without_uncertain(study: &Study) -> Result<(), Failure> {
    match study.arms.iter().find(|arm| !arm.uncertain.is_empty()) {
        None => Ok(()),
        Some(arm) => Err(Failure::Input(format!(
            "{}: [uncertain] draws numbers of arm {}, which measurements are to tell of: the priors in distributions/nuisance and \
             distributions/mechanism say how badly they are known; take a variant without it",
            study.name, arm.name
        ))),
    }
}

/// The study with the seed and the number of walls that are asked for.
pub(crate) fn with_ensemble(study: Study, asked: &Ensemble) -> Result<Study, Failure> {
    let study = match asked.seed {
        Some(seed) => study.with_seed(seed),
        None => study,
    };
    match asked.members {
        Some(members) => with_members(study, members),
        None => Ok(study),
    }
}

/// The folder of a study, from the folder itself or from the study.toml in it.
pub(crate) fn folder(path: &Path) -> Result<PathBuf, Failure> {
    let parent = || path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let refused =
        |found: &str, fix: &str| Err(Failure::Input(format!("no study: {} {found}\n{fix}", path.display())));
    let found = match fs::metadata(path) {
        Err(error) => format!("{}: {error}", path.display()),
        Ok(_) if path.join("study.toml").is_file() => return Ok(path.to_path_buf()),
        Ok(m) if m.is_dir() => format!("{} is a folder without a study.toml", path.display()),
        Ok(_) if path.file_name().is_some_and(|name| name == "study.toml") => {
            return Ok(parent().to_path_buf());
        }
        Ok(_) if is_wall(path) => {
            let fix =
                format!("to analyse it: pirca analyse {} --phi-deg 35", quoted(&path.display().to_string()));
            return refused("is the file of one wall", &fix);
        }
        Ok(_) if parent().join("study.toml").is_file() => {
            let fix = format!("give the folder: {}", quoted(&parent().display().to_string()));
            return refused("is a file in the folder of a study", &fix);
        }
        Ok(_) => format!("{} is a file, but not a study.toml", path.display()),
    };
    Err(Failure::Input(format!("no study: {found}\n{}", known(path))))
}

/// Whether a file is a wall that `analyse` reads. Tables, lists of commands and other JSON may be anything.
fn is_wall(path: &Path) -> bool {
    match Format::of(&path.display().to_string()) {
        Some(Format::Json) => fs::read_to_string(path).is_ok_and(|text| text.contains("\"blocks\"")),
        Some(Format::Csv | Format::Xlsx | Format::ThreeDec) | None => false,
        Some(_) => true,
    }
}

/// Whether there is nothing at a path, or an empty folder: a study may be begun there.
pub(crate) fn is_free(path: &Path) -> bool {
    match fs::symlink_metadata(path) {
        Err(_) => true,
        Ok(_) => path.is_dir() && fs::read_dir(path).is_ok_and(|mut entries| entries.next().is_none()),
    }
}

/// Where the study of results in a folder lies: where it is named, or where it was run from, or else among the studies.
pub(crate) fn again(
    named: Option<&Path>,
    before: &Path,
    manifest: &Manifest,
    results: &Path,
) -> Result<PathBuf, Failure> {
    if let Some(study) = named {
        return folder(study);
    }
    let usual = Path::new("studies").join(&manifest.study);
    let known = [before.to_path_buf(), usual];
    known.into_iter().find(|folder| folder.join("study.toml").is_file()).ok_or_else(|| {
        Failure::Input(format!(
            "{}: the study {} of the run is neither where it was run from nor in studies/; name its folder with --study",
            results.display(),
            manifest.study
        ))
    })
}

/// The study in a folder, as its files state it, and with the seed, the walls and the solver of a run, which may have been asked for in the
/// place of its own. Where its folder was renamed since and nothing else has changed, it keeps the name of the run.
pub(crate) fn as_run(place: &Path, manifest: &Manifest) -> Result<(Loaded, Study), Failure> {
    let loaded = Study::load(place, manifest.variant.as_deref())?;
    let mut study = loaded.study.clone().with_seed(manifest.seed);
    if study.solver.name() != manifest.solver {
        study = study.with_solver(&manifest.solver)?;
    }
    if let Some(&members) = manifest.members.values().max()
        && Manifest::of(&study).members != manifest.members
    {
        study = study.with_members(members);
    }
    keep_name(&mut study, manifest);
    Ok((loaded, study))
}

/// The name of a run for its study, whose folder may have been renamed: no result depends on it.
pub(crate) fn keep_name(study: &mut Study, manifest: &Manifest) {
    if study.hash == manifest.study_hash {
        study.name.clone_from(&manifest.study);
    }
}

/// Where the study that the arguments name takes its distributions from.
pub(crate) fn distributions(which: &Which) -> Result<Distributions, Failure> {
    Ok(Distributions::of_study(&folder(&which.study)?))
}

/// The studies in `studies/`, beside the path and in it, nearest names first.
fn known(path: &Path) -> String {
    let wanted = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let beside = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut found: Vec<(usize, PathBuf)> = [Path::new("studies"), beside, path]
        .into_iter()
        .filter_map(|folder| fs::read_dir(folder).ok())
        .flat_map(|entries| entries.flatten().map(|entry| entry.path()))
        .filter(|study| study.join("study.toml").is_file())
        .map(|study| {
            let name = study.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            (edit_distance(&wanted, &name), study)
        })
        .collect();
    found.sort();
    found.dedup();
    let begin = begin(path, &wanted);
    match found.first() {
        None => format!(
            "a study is a folder with a study.toml; there is none in studies/ nor beside that path\n{begin}"
        ),
        Some(_) => {
            let names: Vec<_> =
                found.iter().take(5).map(|(_, study)| format!("  {}", study.display())).collect();
            format!("studies found, nearest name first:\n{}\n{begin}", names.join("\n"))
        }
    }
}

/// How a study comes to lie at that path.
fn begin(path: &Path, wanted: &str) -> String {
    let built_in = built_in_studies();
    let names: Vec<&str> = built_in.iter().map(|study| study.name).collect();
    let from = names.iter().find(|name| **name == wanted);
    let from = from.map_or_else(|| "STUDY".to_owned(), ToString::to_string);
    // What is there is not written over: a study begins in a folder of its own.
    let place = if is_free(path) || !path.is_dir() { path.to_path_buf() } else { path.join("my-wall") };
    format!("to begin one: pirca init {} --from {from} (built in: {})", place.display(), names.join(", "))
}
