//! Where the results of a page come from.

use crate::ensemble::Manifest;
use crate::render::document::Table;
use crate::study::{ElementStudy, Study};

/// How and where results were made; no result depends on it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct PageOrigin {
    /// The command, as it was given.
    pub command: String,
    /// When it ended, in UTC.
    pub date: String,
    /// System, processor and threads.
    pub platform: String,
}

impl PageOrigin {
    /// A table of it and of the study that was evaluated.
    pub fn of_study(&self, study: &Study) -> Table {
        let manifest = Manifest::of(study);
        let walls: Vec<String> =
            manifest.members.iter().map(|(arm, walls)| format!("{arm} {walls}")).collect();
        let own = [
            ("pirca", manifest.version.clone()),
            ("study", study.name.clone()),
            ("variant", study.variant.clone().unwrap_or_else(|| "none".to_owned())),
            ("solver", manifest.solver.clone()),
            ("seed", manifest.seed.to_string()),
            ("walls", walls.join(", ")),
            ("SHA-256 of all values", manifest.study_hash.clone()),
        ];
        let files = manifest.inputs.iter().map(|(path, hash)| (path.as_str(), format!("SHA-256 {hash}")));
        self.table(own.into_iter().chain(files))
    }

    /// A table of it and of a study of element types.
    pub fn of_elements(&self, study: &ElementStudy) -> Table {
        let assemblies: Vec<String> =
            study.arms.iter().map(|arm| format!("{} {}", arm.name, arm.members)).collect();
        let facts = [
            ("pirca", env!("CARGO_PKG_VERSION").to_owned()),
            ("study", study.name.clone()),
            ("seed", study.seed.to_string()),
            ("assemblies", assemblies.join(", ")),
            ("SHA-256 of all values", study.hash.clone()),
        ];
        let files: Vec<(String, String)> = study
            .inputs
            .iter()
            .map(|input| (input.path.display().to_string(), format!("SHA-256 {}", input.sha256)))
            .collect();
        let files = files.iter().map(|(path, hash)| (path.as_str(), hash.clone()));
        self.table(facts.into_iter().chain(files))
    }

    /// A table of it, after what else tells the origin.
    pub fn table<'p>(&self, before: impl IntoIterator<Item = (&'p str, String)>) -> Table {
        let or_not = |text: &str| if text.is_empty() { "not recorded".to_owned() } else { text.to_owned() };
        let own = [
            ("command", or_not(&self.command)),
            ("date", or_not(&self.date)),
            ("platform", or_not(&self.platform)),
        ];
        Table::of_pairs(before.into_iter().chain(own))
    }
}
