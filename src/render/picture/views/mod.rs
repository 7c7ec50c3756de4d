//! A wall along its axes: its face, a section across it and its plan, to one scale, with dimensions, as SVG text.

mod pane;
mod seen;
#[cfg(test)]
mod tests;

use crate::math::Vec3;
use crate::render::number::range;
use crate::render::picture::colour;
use crate::render::picture::ink::{HEADLINE, LINE, MARGIN, WIDTH, bar, label, path, polygon, sheet};
use crate::render::picture::order::GRAZES;
use crate::render::picture::view::View;
use crate::render::picture::views::pane::{Pane, arrow, round_length, scale_bar, words};
use crate::render::picture::views::seen::{Seen, along, busiest, cut, section, shown};
use crate::shape::{Polygon, Polyhedron};

/// Fixed blocks are seen up to this share of the wall's height beyond it.
const BEYOND: f64 = 0.15;
/// Views of more blocks show the section alone, and an empty face and plan: the file would be too large for a page.
const MOST_BLOCKS: usize = 3000;
/// The views are together at most so high (pixels).
const TALLEST: f64 = 620.0;
/// Room on the left of a view for a dimension, and between two views (pixels).
const ASIDE: f64 = 60.0;
const BETWEEN: f64 = 100.0;
/// Room above a view for its name and the load, above the plan for its name alone, and below a view for a dimension (pixels).
const ABOVE: f64 = 76.0;
const ABOVE_PLAN: f64 = 44.0;
const BELOW: f64 = 60.0;
/// The names of views are at most so wide (pixels).
const NAME: f64 = 200.0;
/// How far a dimension line is from its view (pixels).
const DIMENSION: f64 = 38.0;
/// Longest bar of the scale (pixels).
const SCALE_BAR: f64 = 200.0;
/// A load lies in a view where its cosine to the line of sight is below this.
const IN_PLANE: f64 = 1e-6;
/// Fill of blocks that are seen, that are cut, and that are fixed.
const SEEN: &str = "#ffffff";
const CUT: &str = "#d4d4d4";
const FIXED: &str = "#8f8f8f";
const EDGE: &str = "#1a1a1a";

/// Drawings of a wall as it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct Views {
    /// Headline.
    pub title: String,
    /// The blocks (m).
    pub shapes: Vec<Polyhedron>,
    /// Which of them are fixed.
    pub fixed: Vec<bool>,
    /// The horizontal direction of the load, and what it is called.
    pub load: Option<(Vec3, String)>,
    /// What stones are coloured by. Such drawings have no plan.
    pub shade: Option<Shade>,
    /// Lines below the views.
    pub remarks: Vec<String>,
}

/// A value of each block, shown by colours.
#[derive(Clone, Debug, PartialEq)]
pub struct Shade {
    /// The values (SI units), by block; of 0 there is no colour.
    pub values: Vec<f64>,
    /// What they are.
    pub measure: String,
    /// The unit in which they are shown, and how many of it make one of theirs.
    pub unit: (&'static str, f64),
    /// Blocks that are labelled, with their labels.
    pub labels: Vec<(usize, String)>,
}

impl Views {
    /// Length, thickness and height (m) of all blocks that are not fixed together.
    pub fn size(&self) -> Vec3 {
        let [low, high] = self.wall();
        high - low
    }

    /// Where (m) the section lies: where it cuts most stones in the middle third, as near to the middle of the length as may be.
    pub fn section_at(&self) -> f64 {
        let free: Vec<&Polyhedron> = self.free().collect();
        let [low, high] = self.wall();
        busiest(&free, [low.x, high.x])
    }

    /// The drawings as SVG; the same wall gives the same bytes.
    pub fn svg(&self) -> String {
        let (paper, x) = (self.paper(), self.section_at());
        let [low, high] = self.wall();
        let depth = GRAZES * (high.z - low.z);
        let cut = if self.is_large() { cut(&self.shapes, x) } else { section(&self.shapes, x, depth) };
        let mut text = name(&paper.face, ABOVE, "Face (x, z)");
        text += &self.view(&paper.face, &View::FACE, || along(&self.shapes, &View::FACE, depth));
        text += &paper.face.mark(x, "A");
        text += &paper.face.across([low.x, high.x], DIMENSION);
        text += &paper.face.upright([low.z, high.z], DIMENSION);
        text += &name(&paper.end, ABOVE, &format!("A-A (y, z) at x = {x:.3} m"));
        text += &self.blocks(&paper.end, cut);
        text += &self.loaded(&paper.end, &View::END);
        text += &paper.end.across([low.y, high.y], DIMENSION);
        let mut below = paper.face.end()[1] + BELOW;
        if let Some(plan) = &paper.plan {
            text += &name(plan, ABOVE_PLAN, "From above (x, y)");
            text += &self.view(plan, &View::PLAN, || along(&self.shapes, &View::PLAN, depth));
            text += &plan.mark(x, "A");
            text += &plan.upright([low.y, high.y], DIMENSION);
            below = plan.end()[1] + BELOW;
        }
        text +=
            &scale_bar([MARGIN + 8.0, below], paper.face.scale, round_length(SCALE_BAR / paper.face.scale));
        below += 2.0 * LINE;
        text += &self.legend(below);
        below += LINE;
        if let Some((shade, largest)) = self.shaded() {
            text += &bar(below, largest, shade.unit, &shade.measure, "white: not changed");
            below += 3.0 * LINE;
        }
        let many = format!(
            "The wall has more than {MOST_BLOCKS} blocks: face and plan show its extent, the section what it cuts."
        );
        let remarks: Vec<&String> = self.remarks.iter().chain(self.is_large().then_some(&many)).collect();
        for (place, remark) in remarks.iter().enumerate() {
            text += &label(MARGIN, below + LINE * (place as f64 + 0.5), 15, remark);
        }
        sheet((below + LINE * (remarks.len() as f64 + 0.5)).ceil(), &self.title, &text)
    }

    fn free(&self) -> impl Iterator<Item = &Polyhedron> {
        // A wall that is fixed as a whole is drawn as a whole.
        let all = self.fixed.iter().all(|fixed| *fixed);
        self.shapes.iter().zip(&self.fixed).filter(move |(_, fixed)| all || !**fixed).map(|(shape, _)| shape)
    }

    /// Lowest and highest coordinates (m) of the wall without its fixed blocks.
    fn wall(&self) -> [Vec3; 2] {
        around(self.free())
    }

    fn is_large(&self) -> bool {
        self.shapes.len() > MOST_BLOCKS
    }

    /// The shade with its largest value, where something is shaded.
    fn shaded(&self) -> Option<(&Shade, f64)> {
        let shade = self.shade.as_ref()?;
        let largest = shade.values.iter().copied().fold(0.0, f64::max);
        (largest > 0.0).then_some((shade, largest))
    }

    /// Where the views lie.
    fn paper(&self) -> Paper {
        let ([low, high], [from, to]) = (self.wall(), around(self.shapes.iter()));
        let beyond = Vec3::repeat(BEYOND * (high.z - low.z));
        let (low, high) = ((low - beyond).sup(&from), (high + beyond).inf(&to));
        let size = high - low;
        let room = WIDTH - 2.0 * MARGIN - ASIDE - BETWEEN;
        let level = room / (size.x + size.y);
        // The name of a thin section is wider than the section.
        let level = if level * size.y < NAME { (room - NAME) / size.x } else { level };
        let has_plan = self.shade.is_none();
        let stacked = size.z + if has_plan { size.y } else { 0.0 };
        let scale = level.min(TALLEST / stacked);
        let [wide, deep] = [size.x, size.y].map(|own| (scale * own).max(NAME));
        let left = 0.5 * (WIDTH - wide - deep - BETWEEN - ASIDE) + ASIDE;
        let top = HEADLINE + ABOVE;
        let face = Pane { corner: [left, top], scale, frame: [low.x, low.z, high.x, high.z] };
        let end =
            Pane { corner: [left + wide + BETWEEN, top], frame: [low.y, low.z, high.y, high.z], ..face };
        let plan = Pane {
            corner: [left, face.end()[1] + BELOW + ABOVE_PLAN],
            frame: [low.x, low.y, high.x, high.y],
            ..face
        };
        Paper { face, end, plan: has_plan.then_some(plan) }
    }

    /// A view of the whole wall: its blocks, or of a large wall its extent.
    fn view(&self, pane: &Pane, view: &View, all: impl Fn() -> Vec<Seen>) -> String {
        let blocks = if self.is_large() {
            let corners = self.wall().map(|corner| view.place(&corner));
            let extent = rectangle([corners[0][0], corners[0][1], corners[1][0], corners[1][1]]);
            polygon(&path(extent.vertices.into_iter().map(|v| pane.at(v))), "none", EDGE, 0.8)
        } else {
            self.blocks(pane, all())
        };
        blocks + &self.loaded(pane, view)
    }

    /// Blocks as far as they are within a view and seen, those that are labelled with their labels.
    fn blocks(&self, pane: &Pane, all: Vec<Seen>) -> String {
        let seen = shown(all, &rectangle(pane.frame));
        let mut text = String::new();
        for own in &seen {
            let fill = match (self.fixed[own.block], self.shaded()) {
                (true, _) => FIXED.to_owned(),
                (false, Some((shade, largest))) if shade.values[own.block] > 0.0 => {
                    colour::of_share(shade.values[own.block] / largest)
                }
                (false, Some(_)) => SEEN.to_owned(),
                (false, None) => if own.is_cut { CUT } else { SEEN }.to_owned(),
            };
            let width = if own.is_cut { 1.4 } else { 0.8 };
            let points = path(own.outline.vertices.iter().map(|v| pane.at(*v)));
            text += &polygon(&points, &fill, EDGE, width);
        }
        let labels = self.shade.iter().flat_map(|shade| &shade.labels);
        for (block, said) in labels {
            if let Some(own) = seen.iter().find(|own| own.block == *block) {
                let [x, y] = pane.at(own.outline.moments().centroid());
                text += &words([x, y + 5.0], "middle", None, said);
            }
        }
        text
    }

    /// The arrow of the load, in a view in which it lies: above the view, beside the plan.
    fn loaded(&self, pane: &Pane, view: &View) -> String {
        let Some((towards, said)) = &self.load else { return String::new() };
        if towards.dot(&view.viewer).abs() > IN_PLANE {
            return String::new();
        }
        let [left, top] = pane.corner;
        let [right, bottom] = pane.end();
        let at = match *view == View::PLAN {
            true => [right + 0.75 * BETWEEN, 0.5 * (top + bottom)],
            false => [0.5 * (left + right).max(left + NAME), top - ABOVE + 34.0],
        };
        arrow(at, view.place(towards), said)
    }

    /// What the fills are.
    fn legend(&self, top: f64) -> String {
        let mut fills = vec![(SEEN, "seen"), (CUT, "cut")];
        if self.shaded().is_some() {
            fills.clear();
        }
        fills.extend(self.fixed.contains(&true).then_some((FIXED, "fixed")));
        let each = fills.iter().enumerate().map(|(place, (fill, said))| {
            let x = MARGIN + 100.0 * place as f64;
            let swatch = rectangle([x, top - 11.0, x + 22.0, top + 1.0]);
            polygon(&path(swatch.vertices), fill, EDGE, 0.8) + &label(x + 28.0, top, 14, said)
        });
        each.collect()
    }
}

/// The name of a view in the room above it.
fn name(pane: &Pane, above: f64, name: &str) -> String {
    let [x, top] = pane.corner;
    label(x, top - above + 18.0, 16, name)
}

/// The views on their sheet.
struct Paper {
    face: Pane,
    end: Pane,
    plan: Option<Pane>,
}

/// Lowest and highest coordinates (m) of shapes together.
fn around<'s>(shapes: impl Iterator<Item = &'s Polyhedron>) -> [Vec3; 2] {
    let ends: Vec<(Vec3, Vec3)> = shapes.map(Polyhedron::bounds).collect();
    let of = |k: usize| range(ends.iter().flat_map(|(low, high)| [low[k], high[k]])).unwrap_or([0.0, 1.0]);
    let [x, y, z] = [0, 1, 2].map(of);
    [Vec3::new(x[0], y[0], z[0]), Vec3::new(x[1], y[1], z[1])]
}

/// The polygon between a left, a lower, a right and an upper rim.
fn rectangle([left, low, right, high]: [f64; 4]) -> Polygon {
    Polygon { vertices: vec![[left, low], [right, low], [right, high], [left, high]] }
}
