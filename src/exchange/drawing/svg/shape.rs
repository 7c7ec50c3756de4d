//! The contours of single elements of an SVG drawing.

use std::f64::consts::{PI, TAU};

use roxmltree::Node;
use svgtypes::PointsParser;

use crate::exchange::drawing::gather::cut;
use crate::exchange::drawing::svg::page::pixels;
use crate::exchange::drawing::svg::path::{Contour, Step, contours, unit_arc};

/// The contours of an element, in its own axes; `None` of other elements than shapes. At most so many steps.
pub(super) fn shape(node: Node<'_, '_>, most: usize) -> Option<Result<Vec<Contour>, String>> {
    Some(match node.tag_name().name() {
        "path" => contours(node.attribute("d").unwrap_or(""), most),
        "polygon" => polygon(node, true, most),
        "polyline" => polygon(node, false, most),
        "rect" => rectangle(node),
        "circle" | "ellipse" => ellipse(node),
        _ => return None,
    })
}

/// A length that an element states; 0 where it states none.
pub(super) fn number(node: Node<'_, '_>, name: &str) -> Result<f64, String> {
    let Some(text) = node.attribute(name) else { return Ok(0.0) };
    pixels(text).ok_or_else(|| format!("its {name} is \"{}\"", cut(text)))
}

fn polygon(node: Node<'_, '_>, closed: bool, most: usize) -> Result<Vec<Contour>, String> {
    let text = node.attribute("points").unwrap_or("");
    let points: Vec<[f64; 2]> = PointsParser::from(text).take(most + 1).map(|(x, y)| [x, y]).collect();
    // The parser stops at what is no number without a word.
    let word = text.split(|c: char| c.is_whitespace() || c == ',').find(|word| {
        let letters = word.chars().any(|c| !c.is_ascii_digit() && !"+-.eE".contains(c));
        letters || word.parse().is_ok_and(|number: f64| !number.is_finite())
    });
    match word {
        Some(word) => Err(format!("\"{}\" is among its points", cut(word))),
        None => Ok(Contour::straight(&points, closed).into_iter().collect()),
    }
}

fn ellipse(node: Node<'_, '_>) -> Result<Vec<Contour>, String> {
    let [cx, cy] = [number(node, "cx")?, number(node, "cy")?];
    let [rx, ry] = match node.tag_name().name() {
        "circle" => [number(node, "r")?; 2],
        _ => [number(node, "rx")?, number(node, "ry")?],
    };
    let steps = unit_arc(0.0, TAU, |[x, y]| [cx + rx * x, cy + ry * y]);
    Ok(vec![Contour { start: [cx + rx, cy], steps, closed: true }])
}

fn rectangle(node: Node<'_, '_>) -> Result<Vec<Contour>, String> {
    let [x, y, width, height] =
        [number(node, "x")?, number(node, "y")?, number(node, "width")?, number(node, "height")?];
    let given =
        |name: &str| node.attribute(name).filter(|text| text.trim() != "auto").map(|_| number(node, name));
    let (rx, ry) = (given("rx").transpose()?, given("ry").transpose()?);
    let [rx, ry] = [rx.or(ry), ry.or(rx)].map(|radius| radius.unwrap_or(0.0).max(0.0));
    let [rx, ry] = [rx.min(0.5 * width), ry.min(0.5 * height)];
    if !(rx > 0.0 && ry > 0.0) {
        let corners = [[x, y], [x + width, y], [x + width, y + height], [x, y + height]];
        return Ok(Contour::straight(&corners, true).into_iter().collect());
    }
    // From the left end of the upper side, clockwise as one sees it.
    let (left, right, top, bottom) = (x + rx, x + width - rx, y + ry, y + height - ry);
    let mut steps = Vec::new();
    for (i, [cx, cy]) in [[right, top], [right, bottom], [left, bottom], [left, top]].into_iter().enumerate()
    {
        let place = |[ux, uy]: [f64; 2]| [cx + rx * ux, cy + ry * uy];
        let begin = [[0.0, -1.0], [1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]][i];
        steps.push(Step::Line(place(begin)));
        steps.extend(unit_arc(0.5 * PI * (i as f64 - 1.0), 0.5 * PI, place));
    }
    Ok(vec![Contour { start: [left, y], steps, closed: true }])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exchange::drawing::frame::Extent;

    fn read(element: &str) -> Option<Result<Vec<Contour>, String>> {
        shape(roxmltree::Document::parse(element).unwrap().root_element(), 100)
    }

    #[test]
    fn shapes_reach_as_far_as_they_say() {
        for (element, low, high) in [
            ("<rect x='1' y='2' width='3' height='4'/>", [1.0, 2.0], [4.0, 6.0]),
            ("<rect x='1' y='2' width='3' height='4' rx='9' ry='1'/>", [1.0, 2.0], [4.0, 6.0]),
            ("<circle cx='1' cy='2' r='3'/>", [-2.0, -1.0], [4.0, 5.0]),
            ("<ellipse cx='1' cy='2' rx='3' ry='1'/>", [-2.0, 1.0], [4.0, 3.0]),
            ("<polygon points='0,0 1,0 1 2'/>", [0.0, 0.0], [1.0, 2.0]),
        ] {
            let all = read(element).unwrap().unwrap();
            let extent = Extent::of(&all[0].points(1e-3));
            let near = |a: [f64; 2], b: [f64; 2]| (0..2).all(|k| (a[k] - b[k]).abs() < 1e-3);
            assert!(
                all[0].closed && near(extent.low, low) && near(extent.high, high),
                "{element}: {extent:?}"
            );
        }
        assert!(!read("<polyline points='0,0 1,0 1 2'/>").unwrap().unwrap()[0].closed);
    }

    #[test]
    fn numbers_that_are_none_are_told() {
        assert_eq!(read("<circle r='NaN'/>"), Some(Err("its r is \"NaN\"".to_owned())));
        assert_eq!(
            read("<polygon points='0,0 1,nan 1 2'/>"),
            Some(Err("\"nan\" is among its points".to_owned()))
        );
        assert_eq!(
            read("<polygon points='0,0 1e999,1 1 2'/>"),
            Some(Err("\"1e999\" is among its points".to_owned()))
        );
        assert_eq!(read("<text/>"), None);
    }
}
