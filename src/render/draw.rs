//! Figures as SVG text and as PNG images. The same numbers give the same bytes; text is set in the bundled font.

use std::sync::OnceLock;

use anyhow::{Result, anyhow};
use image::codecs::png::PngEncoder;
use image::{ExtendedColorType, ImageEncoder};
use plotters::coord::Shift;
use plotters::prelude::*;

use crate::render::pen::{Drawn, FONT_NAME};

/// Bundled font: a subset of DejaVu Sans, licence beside it.
static FONT: &[u8] = include_bytes!("font/dejavu-sans-subset.ttf");
/// The image is drawn at this scale and then halved, which smooths its edges.
pub const IMAGE_SCALE: u32 = 4;

/// Something that can be drawn with any backend.
pub trait Figure {
    /// Width and height (pixels).
    fn size(&self) -> (u32, u32);

    /// Draws everything.
    ///
    /// # Errors
    /// Those of the backend.
    fn draw<DB: DrawingBackend>(&self, root: &DrawingArea<DB, Shift>) -> Drawn<DB>;
}

/// A figure at scale 1 as SVG text.
pub fn svg(plot: &impl Figure) -> Result<String> {
    register_font();
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, plot.size()).into_drawing_area();
        plot.draw(&root).map_err(|fault| anyhow!("{fault}"))?;
        root.present().map_err(|fault| anyhow!("{fault}"))?;
    }
    Ok(text)
}

/// A figure at [`IMAGE_SCALE`], halved, as the bytes of a PNG file.
///
/// # Errors
/// Those of the backend.
pub fn png(plot: &impl Figure) -> Result<Vec<u8>> {
    register_font();
    let (width, height) = plot.size();
    let mut pixels = vec![255; 3 * width as usize * height as usize];
    {
        let root = BitMapBackend::with_buffer(&mut pixels, (width, height)).into_drawing_area();
        plot.draw(&root).map_err(|fault| anyhow!("{fault}"))?;
        root.present().map_err(|fault| anyhow!("{fault}"))?;
    }
    let smooth = halved(&pixels, width as usize, height as usize);
    let mut bytes = Vec::new();
    PngEncoder::new(&mut bytes).write_image(&smooth, width / 2, height / 2, ExtendedColorType::Rgb8)?;
    Ok(bytes)
}

/// An RGB image of half the width and height: means of two by two pixels, rounded down.
fn halved(pixels: &[u8], width: usize, height: usize) -> Vec<u8> {
    let mut half = Vec::with_capacity(pixels.len() / 4);
    for y in (0..height).step_by(2) {
        for x in (0..width).step_by(2) {
            for channel in 0..3 {
                let at = |dx: usize, dy: usize| u32::from(pixels[3 * ((y + dy) * width + x + dx) + channel]);
                half.push(((at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1)) / 4) as u8);
            }
        }
    }
    half
}

fn register_font() {
    static ONCE: OnceLock<()> = OnceLock::new();
    ONCE.get_or_init(|| {
        let registered = plotters::style::register_font(FONT_NAME, FontStyle::Normal, FONT).is_ok();
        crate::check!(registered, "the bundled font cannot be read");
    });
}
