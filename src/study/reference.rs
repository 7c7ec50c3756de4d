//! The reference of all keys, printed from the table that the parser checks with.

use std::fmt::Write;

use crate::study::keys;
use crate::study::measured::{COLUMNS, FORMS, MeasuredKind, MeasuredQuantity};
use crate::study::schema::{Key, Presence, Section, quoted};

/// Every key of every input file with what is allowed, its default and its meaning, as Markdown.
pub fn key_reference() -> String {
    let mut text = String::new();
    for section in [
        &keys::STUDY,
        &keys::PUBLISHED,
        &keys::ELEMENT_STUDY,
        &keys::ELEMENTS_PUBLISHED,
        &keys::SITE,
        &keys::HEAD,
        &keys::ENTRY,
        &keys::FAMILY,
    ] {
        describe(section, &mut text, &mut Vec::new());
    }
    describe_measured(&mut text);
    text
}

/// The columns of measured.csv, and what may stand in them.
fn describe_measured(text: &mut String) {
    let _ = writeln!(
        text,
        "## `measured.csv`\n\nWhat was measured on specimens of the arms: a row per value, or a wide table (below).\n"
    );
    let _ = writeln!(text, "| column | must be there | in its cells |\n|---|---|---|");
    for column in COLUMNS {
        let must = if column.required { "yes" } else { "no" };
        let _ = writeln!(text, "| `{}` | {must} | {} |", column.name, column.doc);
    }
    let _ = writeln!(text, "\n{FORMS}");
    let _ =
        writeln!(text, "\nkind: one of {}.\n\n| quantity | units |\n|---|---|", quoted(&MeasuredKind::NAMES));
    for quantity in MeasuredQuantity::ALL {
        let _ = writeln!(text, "| `{}` | {} |", quantity.name(), quantity.dimension().units().join(", "));
    }
}

/// Describes a section and those below it, each once.
fn describe(section: &'static Section, text: &mut String, done: &mut Vec<&'static str>) {
    done.push(section.title);
    let _ = writeln!(text, "## `{}`\n\n{}\n", section.title, section.doc);
    let _ = writeln!(text, "| key | allowed | default | meaning |\n|---|---|---|---|");
    for key in section.all() {
        let _ = writeln!(
            text,
            "| `{}` | {} | {} | {} |",
            key.name,
            allowed(key),
            default(key),
            meaning(section, key)
        );
    }
    text.push('\n');
    for key in section.all() {
        if let Some(below) = key.kind.below()
            && !done.contains(&below.title)
        {
            describe(below, text, done);
        }
    }
}

fn allowed(key: &Key) -> String {
    match key.usual {
        Some(usual) => format!("{}; usual is {usual}", key.kind.allowed()),
        None => key.kind.allowed(),
    }
}

fn default(key: &Key) -> String {
    match key.presence {
        Presence::Required => "required".to_owned(),
        Presence::Optional => "none".to_owned(),
        Presence::Unless(other) => format!("required, unless {other} is there"),
        Presence::Default(text) => format!("`{text}`"),
    }
}

fn meaning(section: &Section, key: &Key) -> String {
    if key.only.is_empty() {
        return key.doc.to_owned();
    }
    format!(
        "{} Only where {} is {}.",
        key.doc,
        section.chooser.unwrap_or("the choice"),
        key.only.join(" or ")
    )
}
