//! Where the scatter of walls comes from, as a document.

use crate::render::csv::Csv;
use crate::render::document::{Captioned, Document, Part, Table};
use crate::verb::sensitivity::answer::SensitivitySummary;
use crate::verb::sensitivity::answer::plot::SharesPlot;
use crate::verb::sensitivity::answer::text::{ORDERS, SHARES, conclusion, known, shares};

/// The document of an answer, with the table of its evaluations (Parquet).
pub fn sensitivity_document(summary: &SensitivitySummary, evaluations: Vec<u8>) -> Document<'_> {
    let caption = "Shares of the variance: what would go if a source were known, and what would be left if all others were.";
    let mut parts: Vec<Part<'_>> = Part::sentences(conclusion(summary)).collect();
    parts.push(Part::Table(Table { caption: ORDERS.to_owned(), ..Table::headed(SHARES, shares(summary)) }));
    parts.extend(known(summary).map(Part::Sentence));
    parts.push(Part::Figure(Captioned::new("sensitivity", "Shares of the variance", caption, |scale| {
        SharesPlot::new(summary, scale)
    })));
    Document {
        title: format!("Where the walls of study {} scatter from", summary.study),
        question: "Which share of the scatter comes from the stones, and which from what nobody knows of the joints?".to_owned(),
        parts,
        files: vec![("sensitivity.csv", csv(summary)), ("sensitivity.parquet", evaluations)],
        limits: vec!["A share depends on how widely the study draws each source: a narrower one has less.".to_owned()],
        methods: "Shares of the variance are Sobol's first-order and total indices (Saltelli 2010; Jansen 1999), with intervals over \
                  independent randomisations of the design."
            .to_owned(),
    }
}

/// One line per source; empty where not defined.
fn csv(summary: &SensitivitySummary) -> Vec<u8> {
    let mut csv =
        Csv::new("source,is_in_layout,first,first_low,first_high,total,total_low,total_high,points");
    for group in &summary.groups {
        csv.line(&[&group.name, &group.is_in_layout, &group.first, &group.total, &group.points]);
    }
    csv.bytes()
}
