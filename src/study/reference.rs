//! The reference of all keys, printed from the table that the parser checks with.

use std::fmt::Write;

use crate::study::keys;
use crate::study::schema::{Key, Kind, Presence, Section};

/// Every key of every input file with what is allowed, its default and its meaning, as Markdown.
pub fn key_reference() -> String {
    let mut text = String::new();
    for section in [
        &keys::STUDY,
        &keys::PUBLISHED,
        &keys::ELEMENT_STUDY,
        &keys::ELEMENTS_PUBLISHED,
        &keys::HEAD,
        &keys::ENTRY,
        &keys::FAMILY,
    ] {
        describe(section, &mut text, &mut Vec::new());
    }
    text
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
        if let Kind::Table(below) | Kind::Tables(below) = key.kind
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
