//! An answer as a document: sentences, lists, tables and figures in the order in which they are read. It is written as text for a
//! terminal ([`Document::text`]) and as a page ([`page`]); tables of numbers and figures are files beside it. JSON is what the answer itself
//! is written as.

mod captioned;
mod drawing;
mod page;
mod read_off;
mod solid;
mod table;
mod template;

pub use captioned::Captioned;
pub use drawing::Drawing;
pub use page::page;
pub use read_off::{ReadOff, Scale, Trace};
pub use solid::{Solid, SolidWall};
pub use table::{Layout, Line, Table};
pub use template::filled;

use crate::render::text::wrapped;

/// A part of a document.
pub enum Part<'a> {
    /// A paragraph; the first of a document answers the question.
    Sentence(String),
    /// A paragraph on what a reader might not expect.
    Warning(String),
    /// The head of what follows.
    Heading(String),
    /// Lines below a head, each with what stands before it.
    List { title: String, items: Vec<(String, String)> },
    /// A table, left out where it has no rows.
    Table(Table),
    /// A figure, which text leaves out.
    Figure(Captioned<'a>),
}

/// What an answer says and shows, in the order in which it is read.
pub struct Document<'a> {
    /// What it is about.
    pub title: String,
    /// The question that it answers.
    pub question: String,
    /// Its parts.
    pub parts: Vec<Part<'a>>,
    /// Files beside it, by name: tables of all numbers as CSV, records of evaluations.
    pub files: Vec<(&'static str, Vec<u8>)>,
    /// What the answer holds for, besides what holds of every study.
    pub limits: Vec<String>,
    /// How it was found, in sentences for a paper.
    pub methods: String,
}

impl<'a> Document<'a> {
    /// Its figures, in their order.
    pub fn figures(&self) -> impl Iterator<Item = &Captioned<'a>> {
        self.parts.iter().filter_map(|part| if let Part::Figure(figure) = part { Some(figure) } else { None })
    }

    /// Its text for a terminal.
    pub fn text(&self) -> String {
        self.parts.iter().map(Part::text).collect()
    }
}

impl Part<'_> {
    /// Sentences as parts.
    pub fn sentences<'s>(all: impl IntoIterator<Item = String>) -> impl Iterator<Item = Part<'s>> {
        all.into_iter().map(Part::Sentence)
    }

    fn text(&self) -> String {
        match self {
            Part::Sentence(text) => wrapped("", text),
            Part::Warning(text) => wrapped("! ", text),
            Part::Heading(text) => format!("\n{text}\n"),
            Part::List { title, items } => {
                let lines = items.iter().map(|(lead, text)| wrapped(lead, text));
                format!("\n{title}\n{}", lines.collect::<String>())
            }
            Part::Table(table) => table.text(),
            Part::Figure(_) => String::new(),
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn document(parts: Vec<Part<'_>>) -> Document<'_> {
        let (title, question) = ("Walls".to_owned(), "Which is best?".to_owned());
        Document { title, question, parts, files: Vec::new(), limits: Vec::new(), methods: String::new() }
    }

    fn parts<'a>() -> Vec<Part<'a>> {
        let rows = || vec![vec!["a rather long name".to_owned(), "1.5".to_owned()]];
        let table = |layout| Part::Table(Table { layout, ..Table::new("Means", &["arm", "deg"], rows()) });
        vec![
            Part::Sentence("The first is <best>.".to_owned()),
            Part::Warning("one wall failed".to_owned()),
            table(Layout::Titled),
            table(Layout::Bare),
            table(Layout::OnPage),
            Part::Table(Table::new("Nothing", &["arm"], Vec::new())),
            Part::List { title: "Arms".to_owned(), items: vec![("  1  ".to_owned(), "a".to_owned())] },
        ]
    }

    #[test]
    fn text_has_every_part_in_its_order_and_leaves_out_what_is_for_pages() {
        let table = "arm                 deg\n-----------------------\na rather long name  1.5\n";
        assert_eq!(
            document(parts()).text(),
            format!("The first is <best>.\n! one wall failed\n\nMeans\n{table}\n{table}\nArms\n  1  a\n")
        );
    }

    #[test]
    fn a_page_has_every_part_once_with_the_first_sentence_as_the_answer_and_nothing_as_markup() {
        let table = json!({"caption": "", "heads": [], "rows": []});
        let closing = json!({
            "given": {"about_wall": "A wall.", "about": "Its inputs.", "assumed": [], "tables": []},
            "limits": ["of stones"],
            "provenance": table,
            "methods": "none",
            "citation": {"words": "pirca", "bibtex": "@software"},
        });
        let page = page(&document(parts()), &closing).unwrap();
        assert!(page.contains("<p class=\"verdict\">The first is &lt;best&gt;.</p>"), "{page}");
        for (words, times) in
            [("<summary>Means (1)", 3), ("Nothing", 0), ("one wall failed", 1), ("<li>1 a</li>", 1)]
        {
            assert_eq!(page.matches(words).count(), times, "{words}");
        }
    }
}
