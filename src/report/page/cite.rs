//! How to cite the program, from CITATION.cff.

use serde::Serialize;

const CITATION: &str = include_str!("../../../CITATION.cff");

/// A reference to the program.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Citation {
    /// In words.
    pub words: String,
    /// For BibTeX.
    pub bibtex: String,
}

/// The reference, with the seed of a study where there is one: with both anybody gets the same walls.
pub fn citation(seed: Option<u64>) -> Citation {
    let [author, title, version] = ["name", "title", "version"].map(field);
    let seed = seed.map_or_else(String::new, |seed| format!(", seed {seed}"));
    Citation {
        words: format!("{author}: {title}. Version {version}{seed}."),
        bibtex: format!(
            "@software{{pirca,\n  author = {{{{{author}}}}},\n  title = {{{title}}},\n  version = {{{version}}},\n  \
             note = {{Results with version {version}{seed}}}\n}}"
        ),
    }
}

/// A field of the file, which has each on a line of its own.
fn field(key: &str) -> &'static str {
    let value =
        |line: &'static str| line.trim_start_matches([' ', '-']).strip_prefix(key)?.strip_prefix(": ");
    CITATION.lines().find_map(value).unwrap_or_default().trim_matches('"')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reference_is_that_of_the_file() {
        let citation = citation(Some(7));
        let own = env!("CARGO_PKG_VERSION");
        assert_eq!(
            citation.words,
            format!(
                "The pirca developers: pirca: a stochastic generator and analyser of dry stone walls. Version {own}, seed 7."
            )
        );
        assert!(citation.bibtex.contains("author = {{The pirca developers}}"), "{}", citation.bibtex);
    }
}
