//! Reading drawings of a wall's face from SVG.

mod hole;
mod limits;
mod page;
mod path;
mod place;
mod shape;

use std::collections::HashMap;

use roxmltree::{Document, Node, ParsingOptions};

use crate::exchange::drawing::Drawing;
use crate::exchange::drawing::frame::Extent;
use crate::exchange::drawing::gather::{Drawn, Gatherer, MOST_POINTS, Unread, cut, short, too_many};
use crate::exchange::drawing::layer::{Shown, shown};
use crate::exchange::drawing::svg::hole::holes;
use crate::exchange::drawing::svg::limits::overgrown;
use crate::exchange::drawing::svg::page::metres;
use crate::exchange::drawing::svg::path::Contour;
use crate::exchange::drawing::svg::place::Map;
use crate::exchange::drawing::svg::shape::{number, shape};
use crate::exchange::fault::{Fault, WallFaults};
use crate::face::Part;

/// How deep groups may be in groups.
const DEEPEST: usize = 100;
/// Most elements, with those that are used again.
const MOST_ELEMENTS: u32 = 250_000;
/// How far a curve may be from its points, in parts of the drawing's size and of its own.
const TOLERANCE: [f64; 2] = [1.0 / 2000.0, 1.0 / 200.0];
/// Where Inkscape and links have their names.
const INKSCAPE: &str = "http://www.inkscape.org/namespaces/inkscape";
const XLINK: &str = "http://www.w3.org/1999/xlink";
/// Elements that hold what is used elsewhere, or what is told about the drawing.
const SILENT: [&str; 14] = [
    "defs",
    "symbol",
    "clipPath",
    "mask",
    "marker",
    "pattern",
    "style",
    "script",
    "title",
    "desc",
    "metadata",
    "namedview",
    "linearGradient",
    "radialGradient",
];

/// The closed shapes of a drawing, x to the right and z upwards; groups say what they surround. The unit is known where the page has a
/// size in millimetres or the like.
pub(in crate::exchange) fn read_svg(text: &str) -> Result<Drawing, WallFaults> {
    let mut gatherer = Gatherer::new("drawing.svg");
    let options =
        ParsingOptions { allow_dtd: true, nodes_limit: 4 * MOST_ELEMENTS, ..ParsingOptions::default() };
    let parsed = match overgrown(text) {
        Some(fault) => Err(Box::new(fault)),
        None => Document::parse_with_options(text, options).map_err(|error| {
            if matches!(error, roxmltree::Error::NodesLimitReached) {
                return too_many(0).into();
            }
            let at = error.pos();
            let fix = "write or copy the file again";
            Fault::of("", format!("not what is expected: {error}"), "an SVG drawing", fix)
                .at(at.row as usize, at.col as usize)
                .into()
        }),
    };
    let read = parsed.and_then(|document| {
        let root = document.root_element();
        if root.tag_name().name() != "svg" {
            let found = "its outermost element is not svg";
            return Err(Fault::of("", found, "an SVG drawing", "save the drawing as SVG").at(1, 0).into());
        }
        let (metres, warning) = metres(root);
        warning.into_iter().for_each(|warning| gatherer.warn(warning));
        let mut walk = Walk::through(&document, text, &mut gatherer);
        walk.children(root, &Group::outermost())?;
        let found = walk.found;
        add(found, &mut gatherer);
        Ok(metres)
    });
    match read {
        Ok(metres) => gatherer.finish(metres),
        Err(fault) => {
            gatherer.fault(*fault);
            Err(gatherer.into_faults())
        }
    }
}

/// What holds for the elements of a group.
#[derive(Clone)]
struct Group {
    map: Map,
    /// The name of the innermost group that says what its lines are.
    layer: String,
    filled: bool,
    depth: usize,
    /// The line and the name of the element that uses this one.
    user: Option<(usize, String)>,
}

impl Group {
    fn outermost() -> Group {
        Group { map: Map::UPRIGHT, layer: String::new(), filled: true, depth: 0, user: None }
    }
}

/// The contours of a shape.
struct Found {
    line: usize,
    own: String,
    layer: String,
    contours: Result<Vec<Contour>, String>,
    filled: bool,
}

struct Walk<'a, 'g> {
    gatherer: &'g mut Gatherer,
    by_id: HashMap<&'a str, Node<'a, 'a>>,
    /// Where the lines of the text begin.
    lines: Vec<usize>,
    found: Vec<Found>,
    elements: u32,
    steps: usize,
}

impl<'a, 'g> Walk<'a, 'g> {
    fn through(document: &'a Document<'a>, text: &str, gatherer: &'g mut Gatherer) -> Walk<'a, 'g> {
        let by_id = document.descendants().filter_map(|node| Some((node.attribute("id")?, node))).collect();
        let lines = text.match_indices('\n').map(|(at, _)| at + 1).collect();
        Walk { gatherer, by_id, lines, found: Vec::new(), elements: 0, steps: 0 }
    }

    fn children(&mut self, node: Node<'a, 'a>, group: &Group) -> Result<(), Box<Fault>> {
        node.children().filter(Node::is_element).try_for_each(|child| self.element(child, group))
    }

    fn element(&mut self, node: Node<'a, 'a>, outer: &Group) -> Result<(), Box<Fault>> {
        let kind = node.tag_name().name();
        let here = 1 + self.lines.partition_point(|begin| *begin <= node.range().start);
        let line = outer.user.as_ref().map_or(here, |user| user.0);
        self.elements += 1;
        if self.elements > MOST_ELEMENTS || outer.depth > DEEPEST {
            let found = "its groups hold one another, or too many elements";
            let allowed = format!("{DEEPEST} groups in one another and {MOST_ELEMENTS} elements");
            return Err(Fault::of("", found, allowed, "simplify the drawing").at(line, 0).into());
        }
        if SILENT.contains(&kind) && !(kind == "symbol" && outer.user.is_some()) {
            return Ok(());
        }
        if property(node, "display") == Some("none") || property(node, "visibility") == Some("hidden") {
            self.gatherer.pass(&format!("hidden {}", cut(kind)));
            return Ok(());
        }
        let own = Map::read(node.attribute("transform").unwrap_or(""));
        let group = Group {
            map: outer.map.after(&own.unwrap_or(Map::shift(0.0, 0.0))),
            layer: inner_layer(&outer.layer, label(node).or(node.attribute("id")).unwrap_or("")),
            filled: property(node, "fill")
                .map_or(outer.filled, |fill| !["none", "transparent"].contains(&fill)),
            depth: outer.depth + 1,
            user: outer.user.clone(),
        };
        let unplaced = own.is_none().then(|| "its transform cannot be read".to_owned());
        match kind {
            "g" | "a" | "switch" | "symbol" | "svg" | "use"
                if unplaced.is_some() || node.has_attribute("viewBox") =>
            {
                self.gatherer.pass(&format!("{kind} with a view or a transform of its own kind"));
            }
            "g" | "a" | "switch" | "symbol" => self.children(node, &group)?,
            "svg" | "use" => match (number(node, "x"), number(node, "y")) {
                (Ok(x), Ok(y)) => {
                    let group = Group { map: group.map.after(&Map::shift(x, y)), ..group };
                    self.inner(node, line, group)?;
                }
                _ => self.gatherer.pass(&format!("{kind} in parts of the page")),
            },
            _ => match shape(node, MOST_POINTS.saturating_sub(self.steps)) {
                None => self.gatherer.pass(short(kind)),
                Some(_) if shown(&group.layer) == Shown::Passed => self.gatherer.pass_layer(&group.layer),
                Some(contours) => {
                    let contours = unplaced.map_or(contours, Err);
                    let contours = contours.map(|all| {
                        all.into_iter().map(|own| own.mapped(&group.map)).collect::<Vec<Contour>>()
                    });
                    self.steps += contours.iter().flatten().map(|own| own.steps.len() + 1).sum::<usize>();
                    if self.steps > MOST_POINTS {
                        return Err(too_many(line).into());
                    }
                    let own = group.user.map_or_else(|| name(node), |user| user.1);
                    self.found.push(Found { line, own, layer: group.layer, contours, filled: group.filled });
                }
            },
        }
        Ok(())
    }

    /// What a drawing in the drawing holds, or what an element uses.
    fn inner(&mut self, node: Node<'a, 'a>, line: usize, group: Group) -> Result<(), Box<Fault>> {
        if node.tag_name().name() == "svg" {
            return self.children(node, &group);
        }
        let link = node.attribute("href").or(node.attribute((XLINK, "href"))).unwrap_or("");
        match link.strip_prefix('#').and_then(|id| self.by_id.get(id)) {
            Some(used) => {
                let user = group.user.clone().or_else(|| Some((line, name(node))));
                self.element(*used, &Group { user, ..group })
            }
            None => {
                self.gatherer.pass("use of nothing");
                Ok(())
            }
        }
    }
}

/// The name that says what lines are: the inner one, unless it says nothing and the outer one does.
fn inner_layer(outer: &str, inner: &str) -> String {
    let says_nothing = |name: &str| shown(name) == Shown::Part(Part::Stone);
    let name = if inner.is_empty() || (says_nothing(inner) && !says_nothing(outer)) { outer } else { inner };
    short(name).to_owned()
}

/// A property of an element by itself, from its style or else from an attribute.
fn property<'a>(node: Node<'a, 'a>, name: &str) -> Option<&'a str> {
    let style = node.attribute("style").unwrap_or("").split(';').rev();
    let styled = style.filter_map(|one| one.split_once(':')).find(|(key, _)| key.trim() == name);
    styled.map(|(_, value)| value.trim()).or(node.attribute(name).map(str::trim))
}

fn label<'a>(node: Node<'a, 'a>) -> Option<&'a str> {
    node.attribute((INKSCAPE, "label")).filter(|label| !label.is_empty())
}

/// What a shape is called: by its label, its title, or its id.
fn name(node: Node<'_, '_>) -> String {
    let title =
        node.children().find(|child| child.has_tag_name("title") || child.tag_name().name() == "title");
    let title = title.and_then(|title| title.text()).map(str::trim).filter(|title| !title.is_empty());
    label(node).or(title).or(node.attribute("id")).map(cut).unwrap_or_default()
}

/// Adds the contours as lines; holes are told and left out.
fn add(found: Vec<Found>, gatherer: &mut Gatherer) {
    let hull = found.iter().filter_map(|own| own.contours.as_ref().ok()).flatten().flat_map(Contour::hull);
    let size = Extent::of(hull.filter(|p| p.iter().all(|x| x.is_finite()))).size();
    let (mut in_stones, mut implied) = (0, 0);
    for Found { line, own, layer, contours, filled } in found {
        let drawn = |points, closed| Drawn { line, own: own.clone(), layer: layer.clone(), points, closed };
        let contours = match contours {
            Ok(contours) => contours,
            Err(found) => {
                let (allowed, fix) = ("lengths and path data of SVG", "draw it again, or remove it");
                gatherer.push(drawn(Err(Unread { line, found, allowed, fix }), true));
                continue;
            }
        };
        let flat = |contour: &Contour| {
            let own = Extent::of(contour.hull()).size();
            contour.points((TOLERANCE[0] * size).min(TOLERANCE[1] * own))
        };
        let lines: Vec<Vec<[f64; 2]>> = contours.iter().map(flat).collect();
        for ((points, contour), is_hole) in lines.iter().zip(&contours).zip(holes(&lines)) {
            if is_hole {
                in_stones += 1;
                continue;
            }
            // What is filled is closed, whether its line is or not.
            implied += usize::from(filled && !contour.closed && points.first() != points.last());
            if !gatherer.push(drawn(Ok(points.clone()), contour.closed || filled)) {
                return;
            }
        }
    }
    if in_stones > 0 {
        gatherer.warn(format!("{in_stones} hole(s) in stones were passed over"));
    }
    if implied > 0 {
        gatherer.warn(format!("{implied} filled path(s) are open: each was closed by a straight line"));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(inner: &str) -> Result<Drawing, WallFaults> {
        let spaces =
            "xmlns=\"http://www.w3.org/2000/svg\" xmlns:i=\"http://www.inkscape.org/namespaces/inkscape\"";
        read_svg(&format!("<svg {spaces} width=\"4m\" viewBox=\"0 0 400 200\">\n{inner}</svg>"))
    }

    #[test]
    fn groups_place_and_name_what_they_hold() {
        let drawing = read(concat!(
            "<rect width='400' height='200' fill='none'/>\n",
            "<g i:label='Ground' transform='translate(0 50)'><g id='g7'><path d='M9 9h30v-9z'/></g></g>\n",
            "<defs><rect id='r' width='4' height='2'/></defs><use href='#r' x='50' y='60' id='K3'/>\n",
            "<path i:label='K4' d='M100 50h20v20h-20zM105 55h5v5h-5zM130 50l9 0l0 9'/>\n",
            "<g id='notes'><circle r='9'/></g><image/><path display='none' d='M0 0h1v1z'/>\n",
        ))
        .unwrap();
        let names: Vec<(&str, usize)> =
            drawing.outlines.iter().map(|own| (own.name.as_str(), own.line)).collect();
        assert_eq!(names, [("ground 0", 3), ("stone 0 (K3)", 4), ("stone 1 (K4)", 5), ("stone 2 (K4)", 5)]);
        assert_eq!(drawing.outlines[0].points, [[9.0, -59.0], [39.0, -59.0], [39.0, -50.0]]);
        assert_eq!(drawing.outlines[1].points[2], [54.0, -62.0]);
        assert_eq!((drawing.metres, drawing.warnings.len()), (Some(0.01), 5), "{:?}", drawing.warnings);
    }

    #[test]
    fn curves_are_as_near_as_the_drawing_needs() {
        let drawing = read("<circle cx='100' cy='100' r='50'/><circle cx='300' cy='100' r='1'/>").unwrap();
        let corners: Vec<usize> = drawing.outlines.iter().map(|own| own.points.len()).collect();
        assert!(corners[0] > 24 && (12..=24).contains(&corners[1]), "{corners:?}");
    }

    #[test]
    fn what_is_wrong_is_told_with_its_name_and_line() {
        let said = |inner: &str| read(inner).unwrap_err().to_string();
        let open = said("<path id='a' fill='none' d='M0 0h9v9'/>");
        assert!(open.contains("drawing.svg:2: stone 0 (a): a line of layer \"a\" is open"), "{open}");
        let odd = said("\n<path d='M0 0 h9 v9 z'/>\n<path d='M0 0 hx'/>");
        assert!(odd.contains("drawing.svg:4: stone 1: its path cannot be read"), "{odd}");
        let turned = said("<circle r='9' transform='turn(5)'/>");
        assert!(turned.contains("stone 0: its transform cannot be read"), "{turned}");
        assert!(said("<g>").contains("not what is expected"));
        assert!(read_svg("<html/>").unwrap_err().to_string().contains("outermost element is not svg"));
        assert!(said("<g id='a'><use href='#a'/></g>").contains("groups in one another"));
    }
}
