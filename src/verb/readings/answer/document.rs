//! The readings as a document: which of them explain what was published, and by which numbers.

use crate::render::csv::Csv;
use crate::render::document::{Captioned, Document, Layout, Part, Table};
use crate::verb::readings::answer::entry::{Extent, ReadingEntry, ReadingsSummary};
use crate::verb::readings::answer::plot::Grid;
use crate::verb::run::answer::published::{Published, Verdict};

/// So many readings are listed at most; files hold all.
const MOST_LISTED: usize = 12;
/// So many of the best are shown with their numbers.
const MOST_SHOWN: usize = 2;

/// The document of a search.
pub fn readings_document(summary: &ReadingsSummary) -> Document<'_> {
    let caption = "A row per reading, the best ones first, and the main one; a column per statement: blue where it comes out, orange \
                   where it does not, grey where it cannot be judged.";
    let figure = Captioned::new("readings", "Which reading explains what was published", caption, |scale| {
        Grid::new(summary, scale)
    });
    let numbered = |lines: Vec<String>| {
        lines.into_iter().enumerate().map(|(number, line)| (format!("  {}  ", number + 1), line)).collect()
    };
    let mut parts: Vec<Part<'_>> = Part::sentences(conclusion(summary)).collect();
    parts.push(Part::Table(table(summary)));
    parts.push(Part::List { title: "Statements".to_owned(), items: numbered(summary.statements.clone()) });
    parts.extend(summary.explaining().take(MOST_SHOWN).map(|one| {
        let words = |own: &Published| format!("{}; stated {}; {}", own.ours, own.theirs, own.verdict.words());
        Part::List { title: one.name(), items: numbered(one.statements.iter().map(words).collect()) }
    }));
    parts.push(Part::Figure(figure));
    Document {
        title: format!("Readings of study {}", summary.study),
        question: "Which variants of the study, alone or together, explain what was published?".to_owned(),
        parts,
        files: vec![("readings.csv", csv(summary))],
        limits: vec![
            "A reading that explains what was published need not be how it came about: others that were not tried may explain it as well."
                .to_owned(),
        ],
        methods: format!(
            "Readings of up to {} variants were judged by the published statements; those that refuted two of them with the first {} \
             walls of each arm at the ends of kn were dropped.",
            summary.departures, summary.first_walls
        ),
    }
}

/// The best readings with the verdict on each statement.
fn table(summary: &ReadingsSummary) -> Table {
    let numbers = (1..=summary.statements.len()).map(|number| number.to_string());
    let heads: Vec<String> = std::iter::once("reading".to_owned()).chain(numbers).collect();
    let row = |one: &ReadingEntry| {
        let marks = one.statements.iter().map(|own| mark(own.verdict).to_owned());
        std::iter::once(one.name()).chain(marks).collect()
    };
    let rows: Vec<Vec<String>> = summary.in_full().take(MOST_LISTED).map(row).collect();
    let left = summary.in_full().count() - rows.len();
    let title = "Readings, the best ones first (y: reproduced, n: not reproduced, ?: cannot be judged)";
    Table {
        heads,
        layout: Layout::Whole,
        caption: if left > 0 { format!("({left} more in readings.csv)") } else { String::new() },
        ..Table::new(title, &[], rows)
    }
}

/// One line per reading and statement; a reading that was refused has one line, with the reason.
fn csv(summary: &ReadingsSummary) -> Vec<u8> {
    let mut csv = Csv::new("reading,variants,extent,statement,verdict,ours,theirs,why");
    for reading in &summary.readings {
        let (name, variants, extent) = (reading.name(), reading.variants.len(), reading.extent.name());
        for one in &reading.statements {
            let verdict = one.verdict.words();
            csv.line(&[&name, &variants, &extent, &one.claim, &verdict, &one.ours, &one.theirs, &one.why]);
        }
        if let Some(why) = &reading.why {
            csv.line(&[&name, &variants, &extent, &[""; 4], why]);
        }
    }
    csv.bytes()
}

/// The sign of a verdict.
fn mark(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Reproduced => "y",
        Verdict::NotReproduced => "n",
        Verdict::CannotJudge => "?",
    }
}

/// Which readings explain most, and how many were tried.
fn conclusion(summary: &ReadingsSummary) -> [String; 3] {
    let all = summary.statements.len();
    let with = |n: usize| -> Vec<&ReadingEntry> {
        summary.in_full().filter(|one| one.reproduced == Some(n)).collect()
    };
    let most = summary.in_full().filter_map(|one| one.reproduced).max().unwrap_or(0);
    let best = with(most);
    let fewest = best.first().map_or(0, |one| one.variants.len());
    let names: Vec<String> =
        best.iter().take_while(|one| one.variants.len() == fewest).map(|one| one.name()).collect();
    let base =
        summary.in_full().find(|one| one.variants.is_empty()).and_then(|one| one.reproduced).unwrap_or(0);
    let of = |extent| summary.readings.iter().filter(|one| one.extent == extent).count();
    let refused = match of(Extent::Refused) {
        0 => String::new(),
        some => format!(", {some} do not go together"),
    };
    [
        format!(
            "{}: at most {most} of {all} statements come out together; {base} in the main reading.",
            summary.study
        ),
        format!("With the fewest departures ({fewest}) by: {}.", names.join(", ")),
        format!(
            "{} readings of up to {} variants: {} evaluated in full, {} dropped after {} walls of each arm at the ends of \
             kn{refused}.",
            summary.readings.len(),
            summary.departures,
            of(Extent::Full),
            of(Extent::FirstWalls),
            summary.first_walls
        ),
    ]
}
