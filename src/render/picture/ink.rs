//! What pictures and drawings are put on paper with: the sheet, polygons, words, and the colour bar.

use crate::render::markup::escaped;
use crate::render::number::significant;
use crate::render::pen::FONT_NAME;
use crate::render::picture::colour;

/// Width of a sheet and of its margins (pixels).
pub(super) const WIDTH: f64 = 960.0;
pub(super) const MARGIN: f64 = 24.0;
/// Height of a line of text, and room for the headline (pixels).
pub(super) const LINE: f64 = 22.0;
pub(super) const HEADLINE: f64 = 50.0;
/// Forces and loads.
pub(super) const FORCE: &str = "#003d7a";
/// Steps of the colour bar.
const STEPS: usize = 40;

/// A sheet of a height with what is on it.
pub(super) fn sheet(tall: f64, title: &str, content: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{tall}\" viewBox=\"0 0 {WIDTH} {tall}\" \
         font-family=\"{FONT_NAME}\" stroke-linejoin=\"round\">\n<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n{}{content}</svg>\n",
        label(MARGIN, 32.0, 20, title)
    )
}

/// Points in pixels as SVG writes them.
pub(super) fn path(points: impl IntoIterator<Item = [f64; 2]>) -> String {
    // Adding zero turns a rounded -0.0 into 0.0.
    let rounded = |pixel: f64| (10.0 * pixel).round() / 10.0 + 0.0;
    let words: Vec<String> =
        points.into_iter().map(|[x, y]| format!("{},{}", rounded(x), rounded(y))).collect();
    words.join(" ")
}

pub(super) fn polygon(points: &str, fill: &str, stroke: &str, width: f64) -> String {
    format!("<polygon points=\"{points}\" fill=\"{fill}\" stroke=\"{stroke}\" stroke-width=\"{width}\"/>\n")
}

pub(super) fn label(x: f64, y: f64, size: u32, text: &str) -> String {
    let text = escaped(text);
    format!("<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" fill=\"#000000\">{text}</text>\n")
}

/// The colour bar from 0 to the largest value, with what it shows in a unit, and a remark.
pub(super) fn bar(top: f64, largest: f64, (unit, times): (&str, f64), measure: &str, remark: &str) -> String {
    let (width, tall) = (360.0, 14.0);
    let step = width / STEPS as f64;
    let mut text = String::new();
    for k in 0..STEPS {
        let fill = colour::of_share((k as f64 + 0.5) / STEPS as f64);
        let x = MARGIN + step * k as f64;
        // A little wider than a step, so that no gap shows between two.
        text += &format!(
            "<rect x=\"{x:.1}\" y=\"{top:.1}\" width=\"{:.1}\" height=\"{tall}\" fill=\"{fill}\"/>\n",
            step + 0.5
        );
    }
    for share in [0.0, 0.5, 1.0] {
        let value = significant(times * share * largest, 2);
        let value = if share == 0.0 { "0".to_string() } else { value };
        text += &label(MARGIN + share * width, top + tall + 17.0, 14, &value);
    }
    let beside = MARGIN + width + 40.0;
    text += &label(beside, top + tall - 2.0, 14, &format!("{unit}: {measure}"));
    text + &label(beside, top + tall + 17.0, 14, remark)
}
