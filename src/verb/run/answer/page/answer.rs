//! The page of what was asked of a study: question, answer, figures, tables, what it rests on.

use anyhow::Result;
use serde::Serialize;

use crate::study::{Loaded, Study};
use crate::verb::run::answer::page::cite::{Citation, citation};
use crate::verb::run::answer::page::drawing::Drawing;
use crate::verb::run::answer::page::inputs::Given;
use crate::verb::run::answer::page::limits;
use crate::verb::run::answer::page::origin::PageOrigin;
use crate::verb::run::answer::page::table::Table;
use crate::verb::run::answer::page::template::filled;

/// A question to a study, and what came out.
pub struct Asked {
    /// What the page is about.
    pub title: String,
    /// The question.
    pub question: String,
    /// Sentences, the one that answers first.
    pub answer: Vec<String>,
    /// The numbers.
    pub tables: Vec<Table>,
    /// The figures.
    pub figures: Vec<Drawing>,
    /// What the answer holds for, besides what holds of every study.
    pub limits: Vec<String>,
    /// What was made of the walls, in sentences for a paper.
    pub methods: String,
}

/// What the template is filled with.
#[derive(Serialize)]
struct Filled<'a> {
    title: &'a str,
    question: &'a str,
    answer: &'a [String],
    tables: &'a [Table],
    charts: bool,
    figures: &'a [Drawing],
    given: Given,
    limits: Vec<String>,
    provenance: Table,
    methods: String,
    citation: Citation,
}

/// The page of a question to a study; `loaded` is the study as its files state it.
///
/// # Errors
/// A template that is faulty.
pub fn answer_page(asked: &Asked, (study, loaded): (&Study, &Loaded), origin: &PageOrigin) -> Result<String> {
    let mut limits = asked.limits.clone();
    limits.extend(limits::of_study(study, loaded));
    filled(
        "answer.html",
        &Filled {
            title: &asked.title,
            question: &asked.question,
            answer: &asked.answer,
            tables: &asked.tables,
            charts: asked.figures.iter().any(|drawing| drawing.chart.is_some()),
            figures: &asked.figures,
            given: Given::of(study, loaded),
            limits,
            provenance: origin.of_study(study),
            methods: limits::evaluated(study, &asked.methods),
            citation: citation(Some(study.seed)),
        },
    )
}
