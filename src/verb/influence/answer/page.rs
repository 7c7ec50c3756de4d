//! Where the scatter of walls comes from, as a page.

use anyhow::Result;

use crate::render::draw::svg;
use crate::study::{Loaded, Study};
use crate::verb::influence::answer::InfluenceSummary;
use crate::verb::influence::answer::plot::SharesPlot;
use crate::verb::influence::answer::text::{ORDERS, SHARES, conclusion, known, shares};
use crate::verb::run::answer::page::{Asked, Drawing, PageOrigin, Table, answer_page};

/// The page of an answer; `loaded` is the study as its files state it.
///
/// # Errors
/// A figure that cannot be drawn, or a template that is faulty.
pub fn influence_page(
    summary: &InfluenceSummary,
    (study, loaded): (&Study, &Loaded),
    origin: &PageOrigin,
) -> Result<String> {
    let caption = "Shares of the variance: what would go if a source were known, and what would be left if all others were.";
    let asked = Asked {
        title: format!("Where the walls of study {} scatter from", summary.study),
        question: "Which share of the scatter comes from the stones, and which from what nobody knows of the joints?".to_owned(),
        answer: conclusion(summary).into_iter().chain(known(summary)).collect(),
        tables: vec![Table { caption: ORDERS.to_owned(), ..Table::headed(SHARES, shares(summary)) }],
        figures: vec![Drawing::picture("figure-influence", "Shares of the variance", caption, &svg(&SharesPlot::new(summary, 1))?)],
        limits: vec!["A share depends on how widely the study draws each source: a narrower one has less.".to_owned()],
        methods: "Shares of the variance are Sobol's first-order and total indices (Saltelli 2010; Jansen 1999), with intervals over \
                  independent randomisations of the design."
            .to_owned(),
    };
    answer_page(&asked, (study, loaded), origin)
}
