//! A document as a page: one HTML file that needs no network and no other file, for any browser, for the keyboard and for print.

use anyhow::Result;
use serde::Serialize;

use crate::render::document::{Document, Drawing, Part, Table, filled};

/// What the template is filled with.
#[derive(Serialize)]
struct Filled<'a, C> {
    title: &'a str,
    question: &'a str,
    parts: Vec<OnPage<'a>>,
    charts: bool,
    #[serde(flatten)]
    closing: &'a C,
}

/// A part, as the template takes it.
#[derive(Serialize)]
#[serde(rename_all = "snake_case")]
enum OnPage<'a> {
    Sentence(&'a str),
    Warning(&'a str),
    Heading(&'a str),
    List { title: &'a str, items: &'a [(String, String)] },
    Table(&'a Table),
    Figure(Drawing),
}

/// The page of a document. `closing` is what the answer rests on: `given` (wall and inputs), `limits`, `provenance`, `methods`,
/// `citation`.
///
/// # Errors
/// A figure that cannot be drawn, or a template that is faulty.
pub fn page(document: &Document<'_>, closing: &impl Serialize) -> Result<String> {
    let mut parts = Vec::with_capacity(document.parts.len());
    for part in &document.parts {
        parts.push(match part {
            Part::Sentence(text) => OnPage::Sentence(text),
            Part::Warning(text) => OnPage::Warning(text),
            Part::Heading(text) => OnPage::Heading(text),
            Part::List { title, items } => OnPage::List { title, items },
            Part::Table(table) if table.rows.is_empty() => continue,
            Part::Table(table) => OnPage::Table(table),
            Part::Figure(figure) => OnPage::Figure(figure.drawing()?),
        });
    }
    let is_charted = |part: &OnPage| matches!(part, OnPage::Figure(drawing) if drawing.chart.is_some());
    let (title, question) = (&document.title, &document.question);
    let charts = parts.iter().any(is_charted);
    filled(
        "document.html",
        include_str!("document.html"),
        &Filled { title, question, parts, charts, closing },
    )
}
