//! The page of a run; and an answer as its files, its page and its words.

use std::num::NonZero;
use std::path::Path;

use serde::Serialize;

use crate::ensemble::{Row, remove_file, replace_file};
use crate::render::document::Document;
use crate::study::{Loaded, Study};
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::locate;
use crate::verb::run::answer::files::write_document;
use crate::verb::run::answer::page::{
    DrawnWall, PageOrigin, RunPage, called, chosen_walls, document_page, run_page,
};
use crate::verb::run::origin::Origin;
use crate::verb::wall::drawn::{Measure, ending};
use crate::verb::wall::one_wall::OneWall;
use crate::verb::wall::picture;

/// Why the walls of a study that are shaken have no page.
pub(super) const SHAKEN: &str = "each record at each intensity takes a wall another way, and a page draws the one load path of a wall; run \
                                 writes the fragility of each arm without --report, and pirca analyse --load base-motion the page of one wall";

/// Name of the page in the output folder.
pub(crate) const PAGE: &str = "report.html";

/// Writes the page of a run of a study, as it was run and as its files state it.
pub(crate) fn write(
    page: &Path,
    (study, loaded): (&Study, &Loaded),
    rows: &[Row],
    origin: &Origin,
) -> Result<(), Failure> {
    locate::not_shaken(study, SHAKEN)?;
    let mut drawn = Vec::new();
    for (which, task) in chosen_walls(study, rows) {
        let kn = study.arms[task.arm as usize].kn_points[task.point as usize];
        let wall = OneWall::at(study.clone(), task, kn)?;
        let (run, replay) =
            doing(&format!("drawing the {}", called(which)), |doing| wall.replayed(&|level| doing.at(level)));
        let picture = picture::of_wall(&wall, &run, Measure::Opening, None);
        drawn.push(DrawnWall { which, task, picture, replay, ending: ending(&run) });
    }
    let text = run_page(&RunPage { study, loaded, rows, drawn: &drawn, origin: &origin.of_page() })
        .map_err(|error| Failure::Run(format!("{error:#}")))?;
    Ok(replace_file(page, text.as_bytes())?)
}

/// An answer to a question about a study: where it is written to, and what it is of.
pub(crate) struct Place<'a> {
    /// The output folder.
    pub out: &'a Path,
    /// File name of the answer, without ending.
    pub name: &'static str,
    /// The study as it was asked, and as its files state it.
    pub study: (&'a Study, &'a Loaded),
    /// Where the study lies.
    pub of: &'a Path,
    /// Worker threads.
    pub threads: Option<NonZero<usize>>,
    /// Whether a page is asked for.
    pub report: bool,
}

/// Writes an answer, which is an object and a document: JSON, tables, figures, and the page if it is asked for.
pub(crate) fn told(
    document: &Document<'_>,
    object: &impl Serialize,
    place: &Place<'_>,
) -> Result<Answer, Failure> {
    let out = place.out;
    let removed = if place.report { String::new() } else { without_page(out)? };
    let text = format!("{}\nwritten to {}\n{removed}", document.text(), out.display());
    let answer = Answer::of(text, object)?.in_place(out);
    write_document(document, (place.name, &answer.json), out)
        .map_err(|error| Failure::Run(format!("{error:#}")))?;
    if place.report {
        beside(out, (place.of, place.threads), |origin| document_page(document, place.study, origin))?;
    }
    Ok(answer)
}

/// Writes the page of an answer beside its files.
pub(crate) fn beside(
    out: &Path,
    (of, threads): (&Path, Option<NonZero<usize>>),
    page: impl FnOnce(&PageOrigin) -> anyhow::Result<String>,
) -> Result<(), Failure> {
    let origin = Origin::now(&locate::folder(of)?, threads).of_page();
    let text = page(&origin).map_err(|error| Failure::Run(format!("{error:#}")))?;
    Ok(replace_file(&out.join(PAGE), text.as_bytes())?)
}

/// Removes the page of an earlier answer, which would be taken for that of this one, and says so in a line; nothing where there is none.
pub(crate) fn without_page(out: &Path) -> Result<String, Failure> {
    let file = out.join(PAGE);
    Ok(match remove_file(&file)? {
        true => format!("{} was of an earlier answer and is removed; --report writes it\n", file.display()),
        false => String::new(),
    })
}
