//! How to cite the program, from CITATION.cff.

use serde::Serialize;

use crate::ensemble::Manifest;

const CITATION: &str = include_str!("../../../../../CITATION.cff");

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
    reference(&seed.map_or_else(String::new, |seed| format!(", seed {seed}")))
}

/// The reference to a run: with version, study and seed anybody gets the same walls, and the hash says whether it is the same study.
pub fn citation_of_run(run: &Manifest) -> Citation {
    let variant = run.variant.as_ref().map(|name| format!(", variant {name}")).unwrap_or_default();
    reference(&format!(", study {}{variant}, seed {}, study hash {}", run.study, run.seed, run.study_hash))
}

/// The reference to the program, and to what was made with it: `results` goes on behind the version.
fn reference(results: &str) -> Citation {
    let [author, title, version] = ["name", "title", "version"].map(field);
    Citation {
        words: format!("{author}: {title}. Version {version}{results}."),
        bibtex: format!(
            "@software{{pirca,\n  author = {{{{{author}}}}},\n  title = {{{title}}},\n  version = {{{version}}},\n  \
             note = {{Results with version {version}{}}}\n}}",
            tex(results)
        ),
    }
}

/// A text as TeX takes it for itself.
fn tex(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut written, c| {
        match c {
            '\\' => written.push_str("\\textbackslash{}"),
            '~' => written.push_str("\\textasciitilde{}"),
            '^' => written.push_str("\\textasciicircum{}"),
            '&' | '%' | '$' | '#' | '_' | '{' | '}' => written.extend(['\\', c]),
            _ => written.push(c),
        }
        written
    })
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

    #[test]
    fn names_of_a_study_mean_nothing_to_tex() {
        assert_eq!(
            tex("a_b 5 % {x} \\y^~"),
            "a\\_b 5 \\% \\{x\\} \\textbackslash{}y\\textasciicircum{}\\textasciitilde{}"
        );
        assert_eq!(tex("tilting-block, seed 7"), "tilting-block, seed 7");
    }
}
