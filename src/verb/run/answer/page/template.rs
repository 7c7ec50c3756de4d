//! Templates and what is put into them. The engine escapes every value, unless the template marks it as markup of our own.

use anyhow::{Context, Result};
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior};
use serde::Serialize;

use crate::verb::run::answer::page::STYLE;
use crate::verb::run::answer::page::chart::{READER, READER_STYLE};
use crate::verb::run::answer::page::solid::VIEWER;

/// The templates by name; the pages share their frame and the parts that they are made of.
const TEMPLATES: [(&str, &str); 6] = [
    ("parts.html", include_str!("parts.html")),
    ("frame.html", include_str!("frame.html")),
    ("run.html", include_str!("run.html")),
    ("wall.html", include_str!("wall.html")),
    ("diagnosis.html", include_str!("diagnosis.html")),
    ("answer.html", include_str!("answer.html")),
];

/// A page: its own values, and those of the frame.
#[derive(Serialize)]
struct Framed<'p, P> {
    style: &'static str,
    script: &'static str,
    viewer: &'static str,
    reader: &'static str,
    reader_style: &'static str,
    #[serde(flatten)]
    page: &'p P,
}

/// The page that a template makes of some values.
///
/// # Errors
/// A template that asks for what is not there: a fault of ours.
pub fn filled(name: &str, page: &impl Serialize) -> Result<String> {
    let mut engine = Environment::new();
    engine.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    for (name, text) in TEMPLATES {
        engine.add_template(name, text).with_context(|| format!("the template {name} is faulty"))?;
    }
    let framed = Framed {
        style: STYLE,
        script: include_str!("open.js"),
        viewer: VIEWER,
        reader: READER,
        reader_style: READER_STYLE,
        page,
    };
    let template = engine.get_template(name)?;
    template.render(Serde(framed)).with_context(|| format!("the template {name} cannot be filled"))
}
