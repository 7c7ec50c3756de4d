//! What decides the results of a run: written beside them, and compared before a run goes on.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::ensemble::{RunError, replace_file};
use crate::study::Study;

/// Name of its file in the output folder.
pub(super) const MANIFEST: &str = "manifest.json";
/// How many changed values an error names.
const NAMED: usize = 8;

/// The identity of a run. Two runs with the same identity (see [`Manifest::differences`]) have the same results.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Manifest {
    /// Version of pirca.
    pub version: String,
    /// Name of the study.
    pub study: String,
    /// Named variant, if any.
    pub variant: Option<String>,
    /// Seed of all random streams.
    pub seed: u64,
    /// Number of members of every arm.
    pub members: BTreeMap<String, u64>,
    /// Name of the solver.
    pub solver: String,
    /// SHA-256 over everything that decides a result.
    pub study_hash: String,
    /// Everything that decides a result, by the path of its key.
    pub values: BTreeMap<String, String>,
    /// SHA-256 of every input file as it lies on the disk, comments included.
    pub inputs: BTreeMap<String, String>,
}

impl Manifest {
    /// The identity of a run of this study by this version of the program.
    pub fn of(study: &Study) -> Self {
        Manifest {
            version: env!("CARGO_PKG_VERSION").to_string(),
            study: study.name.clone(),
            variant: study.variant.clone(),
            seed: study.seed,
            members: study.arms.iter().map(|arm| (arm.name.clone(), arm.members)).collect(),
            solver: study.solver.name().to_string(),
            study_hash: study.hash.clone(),
            values: study.effective.clone(),
            inputs: study.inputs.iter().map(|f| (f.path.display().to_string(), f.sha256.clone())).collect(),
        }
    }

    /// Writes it into the output folder.
    ///
    /// # Errors
    /// [`RunError::File`].
    pub(super) fn write(&self, out: &Path) -> Result<(), RunError> {
        let json = serde_json::to_string_pretty(self).expect("a manifest has string keys only");
        replace_file(&out.join(MANIFEST), format!("{json}\n").as_bytes())
    }

    /// What makes `wanted` another run than the recorded `self`, one sentence each; empty when it is the same run.
    ///
    /// Input files whose bytes differ while the study's hash agrees (a comment, a published number to compare with)
    /// make no difference.
    pub fn differences(&self, wanted: &Manifest) -> Vec<String> {
        let mut found = Vec::new();
        let said = |what: &str, recorded: &str, asked: &str| {
            (recorded != asked).then(|| format!("{what}: {recorded} recorded, {asked} asked for"))
        };
        let or_none = |name: &Option<String>| name.clone().unwrap_or_else(|| "none".to_string());
        found.extend(said("version of pirca", &self.version, &wanted.version));
        found.extend(said("study", &self.study, &wanted.study));
        found.extend(said("variant", &or_none(&self.variant), &or_none(&wanted.variant)));
        found.extend(said("solver", &self.solver, &wanted.solver));
        let keys: BTreeSet<&String> = self.values.keys().chain(wanted.values.keys()).collect();
        let value = |values: &BTreeMap<String, String>, key| {
            values.get(key).cloned().unwrap_or_else(|| "nothing".to_string())
        };
        for key in keys {
            found.extend(said(key, &value(&self.values, key), &value(&wanted.values, key)));
        }
        if found.is_empty() {
            found.extend(said("hash of the study", &self.study_hash, &wanted.study_hash));
        }
        if found.len() > NAMED {
            let others = found.len() - NAMED;
            found.truncate(NAMED);
            found.push(format!("and {others} more"));
        }
        found
    }
}
