//! Templates and what is put into them. The engine escapes every value, unless the template marks it as markup of our own.

use anyhow::{Context, Result};
use minijinja::value::Serde;
use minijinja::{Environment, UndefinedBehavior};
use serde::Serialize;

use crate::render::document::read_off::{READER, READER_STYLE};
use crate::render::document::solid::VIEWER;

/// What pages share: their frame and the parts that they are made of.
const SHARED: [(&str, &str); 2] =
    [("parts.html", include_str!("parts.html")), ("frame.html", include_str!("frame.html"))];

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
pub fn filled(name: &'static str, text: &'static str, page: &impl Serialize) -> Result<String> {
    let mut engine = Environment::new();
    engine.set_undefined_behavior(UndefinedBehavior::SemiStrict);
    for (name, text) in SHARED.into_iter().chain([(name, text)]) {
        engine.add_template(name, text).with_context(|| format!("the template {name} is faulty"))?;
    }
    let framed = Framed {
        style: include_str!("style.css"),
        script: include_str!("open.js"),
        viewer: VIEWER,
        reader: READER,
        reader_style: READER_STYLE,
        page,
    };
    let template = engine.get_template(name)?;
    template.render(Serde(framed)).with_context(|| format!("the template {name} cannot be filled"))
}
