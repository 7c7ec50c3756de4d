//! The map as a document: tables, and a sentence per mechanism.

use crate::critic::Sight;
use crate::render::csv::Csv;
use crate::render::document::{Captioned, Document, Layout, Part, Table};
use crate::render::number::capital;
use crate::verb::detectability::answer::DetectabilitySummary;
use crate::verb::detectability::answer::entry::{MechanismEntry, ObservableEntry};
use crate::verb::detectability::answer::plot::HeatMap;

/// How the signs of the table are read.
const SIGNS: &str = "~: the interval includes 0; falls: collapsed before the reading; fallen: also without the \
    mechanism; stands: reaches the reading only with it; end: stood to the end of the load path; n/a: not applicable; lost: \
    not solved; -: no error is known";

/// The document of a map.
pub fn detectability_document(summary: &DetectabilitySummary) -> Document<'_> {
    let caption = "A row per mechanism, a column per measured quantity: the change that the mechanism makes, in errors of the data. Blue: \
                   less, orange: more, grey: no change is known.";
    let figure = Captioned::new("detectability", "Change per mechanism", caption, |scale| {
        HeatMap::new(summary, scale)
    });
    let mut parts: Vec<Part<'_>> = Part::sentences(conclusion(summary)).collect();
    parts.push(Part::Heading("Change of every measured quantity, in units of its error".to_owned()));
    parts.push(Part::Sentence(format!("{}. {SIGNS}.", capital(summary.definition))));
    parts.extend(families(summary).into_iter().map(|family| Part::Table(table(summary, family))));
    let was = |row: &MechanismEntry| ("  ".to_owned(), format!("{}: {}", row.mechanism, row.strength()));
    let items = summary.mechanisms.iter().map(was).collect();
    parts.push(Part::List { title: "What each mechanism was".to_owned(), items });
    parts.push(Part::Figure(figure));
    Document {
        title: format!("What the measurements of study {} could show", summary.study),
        question: "Which mechanisms could the measured data see?".to_owned(),
        parts,
        files: vec![("detectability.csv", csv(summary))],
        limits: vec![
            "Each mechanism is looked at alone, at one strength. What two of them do together is not seen here.".to_owned(),
        ],
        methods: format!(
            "Each mechanism was set to the {} quantile of its priors; changes are means of paired differences over {} walls per arm \
             with Student's interval.",
            summary.quantile, summary.members
        ),
    }
}

/// One line per mechanism and observable; empty where not defined.
fn csv(summary: &DetectabilitySummary) -> Vec<u8> {
    let mut csv = Csv::new(
        "mechanism,parameters,family,quantity,tilt_deg,unit,outcome,note,without,change,change_low,change_high,measurement_error,\
         scatter,error,bounds_only,in_measurement_errors,in_errors,in_errors_low,in_errors_high,pairs,fell_before",
    );
    for row in &summary.mechanisms {
        let parameters: Vec<String> =
            row.parameters.iter().map(|p| format!("{} = {:?}", p.key, p.value)).collect();
        for (one, observable) in row.cells.iter().zip(&summary.observables) {
            csv.line(&[
                &row.mechanism,
                &parameters.join("; "),
                &observable.family,
                &observable.quantity,
                &observable.tilt_deg,
                &observable.unit,
                &one.outcome,
                &one.note,
                &observable.without,
                &one.change,
                &one.change_ci,
                &[observable.measurement_error, observable.scatter, observable.error],
                &observable.bounds_only,
                &one.in_measurement_errors,
                &one.in_errors,
                &one.in_errors_ci,
                &one.pairs,
                &one.fell_before,
            ]);
        }
    }
    csv.bytes()
}

/// Which mechanisms the data could see, which perhaps, which not.
fn conclusion(summary: &DetectabilitySummary) -> [String; 4] {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let sees = |row: &&MechanismEntry, sight: Sight| row.cells.iter().any(|cell| cell.sight == sight);
    let rows = || summary.mechanisms.iter();
    let seen: Vec<&MechanismEntry> = rows().filter(|row| sees(row, Sight::Seen)).collect();
    let perhaps: Vec<&MechanismEntry> =
        rows().filter(|row| !sees(row, Sight::Seen) && sees(row, Sight::Perhaps)).collect();
    let unseen: Vec<&MechanismEntry> =
        rows().filter(|row| !sees(row, Sight::Seen) && !sees(row, Sight::Perhaps)).collect();
    let list = |found: &[&MechanismEntry]| match found {
        [] => "none".to_string(),
        some => some.iter().map(|row| named(row)).collect::<Vec<_>>().join(", "),
    };
    let head = format!(
        "{}{variant}: data like these could see {} of {} mechanisms, each at the {} quantile of its priors ({} walls per family, \
         seed {}).",
        summary.study,
        seen.len(),
        summary.mechanisms.len(),
        summary.quantile,
        summary.members,
        summary.seed
    );
    [
        head,
        format!("Seen: {}.", list(&seen)),
        format!("Perhaps: {}.", list(&perhaps)),
        format!("Not seen: {}.", list(&unseen)),
    ]
}

/// A mechanism with the largest change it makes, in errors.
fn named(row: &MechanismEntry) -> String {
    largest(row).map_or_else(|| row.mechanism.to_string(), |most| format!("{} ({most:.1})", row.mechanism))
}

fn families(summary: &DetectabilitySummary) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for observable in &summary.observables {
        if !names.contains(&observable.family.as_str()) {
            names.push(&observable.family);
        }
    }
    names
}

/// A line per mechanism and a column per observable of a family.
fn table(summary: &DetectabilitySummary, family: &str) -> Table {
    let own = || (0..summary.observables.len()).filter(|&k| summary.observables[k].family == family);
    let heads = own().map(|k| heading(&summary.observables[k]).join(" "));
    let row = |row: &MechanismEntry| {
        std::iter::once(row.mechanism.to_owned()).chain(own().map(|k| row.cells[k].shown())).collect()
    };
    Table {
        heads: std::iter::once(family.to_owned()).chain(heads).collect(),
        layout: Layout::Split,
        ..Table::new(&format!("Family {family}"), &[], summary.mechanisms.iter().map(row).collect())
    }
}

/// The head of a column, in two lines.
pub(crate) fn heading(observable: &ObservableEntry) -> [String; 2] {
    let bound = if observable.bounds_only { " *" } else { "" };
    let tilt = observable.tilt_deg.map(|tilt| format!("{tilt} deg")).unwrap_or_default();
    [observable.short().to_string(), format!("{tilt}{bound}")]
}

/// The largest change in errors, either way.
fn largest(row: &MechanismEntry) -> Option<f64> {
    row.cells.iter().filter_map(|cell| cell.in_errors).map(f64::abs).reduce(f64::max)
}
