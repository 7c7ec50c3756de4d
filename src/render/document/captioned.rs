//! A figure of a document: its file, its words, and how it is drawn.

use std::rc::Rc;

use anyhow::Result;

use crate::render::chart::Chart;
use crate::render::document::{Drawing, ReadOff};
use crate::render::draw::{Figure, IMAGE_SCALE, png, svg};

type Svg<'a> = Box<dyn Fn() -> Result<String> + 'a>;
type Png<'a> = Box<dyn Fn() -> Result<Vec<u8>> + 'a>;

/// A figure with its words.
pub struct Captioned<'a> {
    /// Its file name without ending; on a page it is `figure-` and this.
    pub file: String,
    /// Its name.
    title: String,
    /// What it shows, also for those who do not see it.
    caption: String,
    /// The numbers that can be read off it on a page.
    read_off: Option<ReadOff>,
    svg: Svg<'a>,
    png: Png<'a>,
}

impl<'a> Captioned<'a> {
    /// A figure that can be drawn at a scale.
    pub fn new<F: Figure>(
        file: impl Into<String>,
        title: &str,
        caption: impl Into<String>,
        at: impl Fn(u32) -> F + Clone + 'a,
    ) -> Captioned<'a> {
        let large = at.clone();
        Captioned {
            file: file.into(),
            title: title.to_owned(),
            caption: caption.into(),
            read_off: None,
            svg: Box::new(move || svg(&at(1))),
            png: Box::new(move || png(&large(IMAGE_SCALE))),
        }
    }

    /// A chart.
    pub(crate) fn chart(
        file: impl Into<String>,
        title: &str,
        caption: impl Into<String>,
        chart: Chart,
    ) -> Captioned<'a> {
        let chart = Rc::new(chart);
        Captioned::new(file, title, caption, move |scale| chart.clone().at(scale))
    }

    /// With numbers that can be read off, if there are any.
    pub fn with_read_off(self, read_off: Option<ReadOff>) -> Captioned<'a> {
        Captioned { read_off, ..self }
    }

    /// As SVG text.
    ///
    /// # Errors
    /// A figure that cannot be drawn.
    pub fn svg(&self) -> Result<String> {
        (self.svg)()
    }

    /// As the bytes of a PNG file.
    ///
    /// # Errors
    /// A figure that cannot be drawn.
    pub fn png(&self) -> Result<Vec<u8>> {
        (self.png)()
    }

    /// As a page has it.
    ///
    /// # Errors
    /// A figure that cannot be drawn.
    pub fn drawing(&self) -> Result<Drawing> {
        let drawing =
            Drawing::picture(&format!("figure-{}", self.file), &self.title, &self.caption, &self.svg()?);
        Ok(drawing.with_numbers(self.read_off.as_ref()))
    }
}
