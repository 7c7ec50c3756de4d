//! How long a unit of an SVG drawing is, by the size of its page.

use std::str::FromStr;

use roxmltree::Node;
use svgtypes::ViewBox;

use crate::exchange::drawing::gather::shown_number;

/// Units in a metre's terms; a pixel is a 96th of an inch.
const UNITS: [(&str, f64); 7] = [
    ("mm", 1e-3),
    ("cm", 1e-2),
    ("m", 1.0),
    ("in", 0.0254),
    ("pt", 0.0254 / 72.0),
    ("pc", 0.0254 / 6.0),
    ("q", 2.5e-4),
];
/// Metres in a pixel.
const PIXEL: f64 = 0.0254 / 96.0;
/// Widths up to this one (m) are those of sheets of paper.
const PAPER: f64 = 1.5;
/// How much the scales along and up may differ, in parts of either.
const SAME: f64 = 0.01;

/// A number and the unit behind it, in small letters: `210mm`, `5`.
fn length(text: &str) -> Option<(f64, String)> {
    let text = text.trim();
    let number = text.trim_end_matches(|c: char| c.is_ascii_alphabetic() || c == '%');
    let value = number.trim().parse().ok().filter(|value: &f64| value.is_finite())?;
    Some((value, text[number.len()..].to_ascii_lowercase()))
}

/// Metres in a unit of length; `None` of pixels and of parts of the page.
fn metres_of(unit: &str) -> Option<f64> {
    UNITS.iter().find(|(name, _)| *name == unit).map(|(_, metres)| *metres)
}

/// A length in the drawing's unit, which is a pixel; `None` of what is none, as of parts of the page.
pub(super) fn pixels(text: &str) -> Option<f64> {
    match length(text)? {
        (number, unit) if unit.is_empty() || unit == "px" => Some(number),
        (number, unit) => metres_of(&unit).map(|metres| number * metres / PIXEL),
    }
}

/// Metres in the drawing's unit, where width and height of the page say so, and what a reader should know of it.
pub(super) fn metres(root: Node<'_, '_>) -> (Option<f64>, Option<String>) {
    let side = |name: &str| {
        let (number, unit) = length(root.attribute(name)?)?;
        metres_of(&unit).map(|metres| number * metres).filter(|side| *side > 0.0)
    };
    let (width, height) = (side("width"), side("height"));
    let Some(longest) = width.or(height) else { return (None, None) };
    let view = root.attribute("viewBox").and_then(|text| ViewBox::from_str(text).ok());
    let Some(view) = view else { return (Some(PIXEL), None) };
    let scales = [width.map(|width| width / view.w), height.map(|height| height / view.h)];
    let least = scales.iter().flatten().copied().fold(f64::INFINITY, f64::min);
    let most = scales.iter().flatten().copied().fold(0.0, f64::max);
    let warning = if most > (1.0 + SAME) * least {
        Some("the page's width and height say different scales: the smaller one was taken".to_owned())
    } else if longest <= PAPER {
        let wide = shown_number(longest);
        Some(format!("the page is {wide} m wide, as paper is: if the drawing is to a scale, state the unit"))
    } else {
        None
    };
    (Some(least).filter(|metres| metres.is_normal()), warning)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn unit(head: &str) -> (Option<f64>, bool) {
        let text = format!("<svg {head}/>");
        let document = roxmltree::Document::parse(&text).unwrap();
        let (metres, warning) = metres(document.root_element());
        (metres, warning.is_some())
    }

    #[test]
    fn the_page_says_the_unit() {
        assert_eq!(unit("width='2500mm' height='1250mm' viewBox='0 0 2500 1250'"), (Some(1e-3), false));
        assert_eq!(unit("width='5m' viewBox='0 0 500 100'"), (Some(0.01), false));
        assert_eq!(unit("width='210mm' height='297mm' viewBox='0 0 210 297'"), (Some(1e-3), true));
        assert_eq!(unit("width='3m' height='1m' viewBox='0 0 1 1'"), (Some(1.0), true));
        for none in
            ["width='500px' viewBox='0 0 500 100'", "width='500'", "width='100%' height='1e999mm'", ""]
        {
            assert_eq!(unit(none), (None, false), "{none}");
        }
        assert_eq!(pixels("96px"), Some(96.0));
        assert!((pixels(" 2.54 cm").unwrap() - 96.0).abs() < 1e-9);
        assert_eq!(pixels("50%"), None);
    }
}
