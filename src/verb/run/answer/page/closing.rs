//! What an answer to a question about a study rests on, at the end of its page.

use anyhow::Result;
use serde::Serialize;

use crate::render::document::{Document, Table, page};
use crate::study::{ElementStudy, Loaded, Study};
use crate::verb::run::answer::page::cite::{Citation, citation};
use crate::verb::run::answer::page::inputs::Given;
use crate::verb::run::answer::page::limits;
use crate::verb::run::answer::page::origin::PageOrigin;

/// What the template is filled with.
#[derive(Serialize)]
struct Closing {
    given: Given,
    limits: Vec<String>,
    provenance: Table,
    methods: String,
    citation: Citation,
}

/// The page of a document about a study; `loaded` is the study as its files state it.
///
/// # Errors
/// A figure that cannot be drawn, or a template that is faulty.
pub fn document_page(
    document: &Document<'_>,
    (study, loaded): (&Study, &Loaded),
    origin: &PageOrigin,
) -> Result<String> {
    let mut limits = document.limits.clone();
    limits.extend(limits::of_study(study, loaded));
    let closing = Closing {
        given: Given::of(study, loaded),
        limits,
        provenance: origin.of_study(study),
        methods: limits::evaluated(study, &document.methods),
        citation: citation(Some(study.seed)),
    };
    page(document, &closing)
}

/// The page of a document about a study of element types.
///
/// # Errors
/// As of [`document_page`].
pub fn element_page(document: &Document<'_>, study: &ElementStudy, origin: &PageOrigin) -> Result<String> {
    let closing = Closing {
        given: Given::of_elements(study),
        limits: document.limits.clone(),
        provenance: origin.of_elements(study),
        methods: document.methods.clone(),
        citation: citation(Some(study.seed)),
    };
    page(document, &closing)
}
