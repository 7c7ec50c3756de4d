//! Where the distributions of a study lie: one place decides it for references, priors and messages.

use std::path::{Path, PathBuf};

/// Name of the folder.
const FOLDER: &str = "distributions";

/// No folder of distributions lies above a study.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a folder `{FOLDER}` in {} or in a folder above it, and there is none",
    .0.display()
)]
pub struct NoDistributions(PathBuf);

/// The nearest folder `distributions` above the folder that holds a study's: `../../distributions` of the study first, then
/// further up, so that studies may lie in folders of their own.
///
/// # Errors
/// [`NoDistributions`]; where the study does not exist it is sought by the path as written.
pub fn distributions_above(study: &Path) -> Result<PathBuf, NoDistributions> {
    let study = study.canonicalize().unwrap_or_else(|_| study.to_path_buf());
    let found = study.ancestors().skip(2).map(|folder| folder.join(FOLDER)).find(|folder| folder.is_dir());
    found.ok_or_else(|| NoDistributions(study.ancestors().nth(2).unwrap_or(&study).to_path_buf()))
}
