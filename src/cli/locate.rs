//! From what the user typed to a checked study.

use std::fs;
use std::path::{Path, PathBuf};

use crate::cli::arguments::Which;
use crate::cli::failure::Failure;
use crate::cli::output;
use crate::math::edit_distance;
use crate::study::{ElementStudy, Fault, Loaded, Study, distributions_above};

/// Loads the study that the arguments name, in the variant asked for, and passes its warnings on to standard error.
pub(crate) fn study(which: &Which) -> Result<Loaded, Failure> {
    let folder = folder(&which.study)?;
    if ElementStudy::is_in(&folder) {
        let text =
            format!("{} compares types of elements, not walls: only run and check take it", folder.display());
        return Err(Failure::Input(text));
    }
    let loaded = Study::load(&folder, which.variant.as_deref())?;
    loaded.warnings.iter().for_each(warn);
    Ok(loaded)
}

/// Says what is allowed and yet looks wrong on standard error.
pub(crate) fn warn(warning: &Fault) {
    output::note(&format!("warning: {warning}"));
}

/// The folder of a study, from the folder itself or from the study.toml in it.
pub(crate) fn folder(path: &Path) -> Result<PathBuf, Failure> {
    let found = match fs::metadata(path) {
        Err(error) => format!("{}: {error}", path.display()),
        Ok(_) if path.join("study.toml").is_file() => return Ok(path.to_path_buf()),
        Ok(m) if m.is_dir() => format!("{} is a folder without a study.toml", path.display()),
        Ok(_) if path.file_name().is_some_and(|name| name == "study.toml") => {
            let parent = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
            return Ok(parent.to_path_buf());
        }
        Ok(_) => format!("{} is a file, but not a study.toml", path.display()),
    };
    Err(Failure::Input(format!("no study: {found}\n{}", known(path))))
}

/// The folder of distributions that the study takes its own from.
pub(crate) fn distributions(which: &Which) -> Result<PathBuf, Failure> {
    let folder = folder(&which.study)?;
    distributions_above(&folder).map_err(|none| {
        let fix = "put the folder `distributions` beside `studies`: the priors are in it";
        Failure::Input(format!("{}: wanted is {none}; {fix}", folder.display()))
    })
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
    match found.first() {
        None => "a study is a folder with a study.toml; there is none in studies/ nor beside that path"
            .to_string(),
        Some(_) => {
            let names: Vec<_> =
                found.iter().take(5).map(|(_, study)| format!("  {}", study.display())).collect();
            format!("studies found, nearest name first:\n{}", names.join("\n"))
        }
    }
}
