//! The picture as SVG text, from the furthest block to the nearest.

use crate::math::Vec3;
use crate::render::number::{range, significant};
use crate::render::picture::colour;
use crate::render::picture::ink::{FORCE, HEADLINE, LINE, MARGIN, WIDTH, bar, label, path, polygon, sheet};
use crate::render::picture::order::{GRAZES, back_to_front};
use crate::render::picture::scene::{Picture, Seam, Stage, height};
use crate::render::picture::view::View;
use crate::shape::{Plane, Polyhedron};

/// The wall is drawn at most so high (pixels).
const TALLEST: f64 = 620.0;
/// The ground reaches so far beyond the wall, as a share of its height.
const GROUND: f64 = 0.25;
/// A joint is coloured from this share of the largest value on.
const LEAST: f64 = 0.02;
/// Two directions or points are the same to this (cosine; share of the wall's height).
const PARALLEL: f64 = 0.99;
const ON_FACE: f64 = 1e-3;
/// Radius of a dot (pixels).
const DOT: f64 = 5.0;
/// Cosine to the line of sight from which on an edge leads away from the viewer.
const LEADS_AWAY: f64 = 0.5;
/// The largest force is drawn as a line of this share of the wall's height, smaller ones as much shorter.
const LONGEST_THRUST: f64 = 0.2;

impl Picture {
    /// The picture as SVG; the same picture gives the same bytes.
    pub fn svg(&self) -> String {
        self.svg_on(&self.stage())
    }

    /// What it takes to show it.
    pub fn stage(&self) -> Stage {
        let view = View::on(self.from_front);
        let (shapes, ground) = (self.drawn(), self.ground());
        let places = || shapes.iter().flat_map(|s| &s.vertices).chain(&ground).map(|v| view.place(v));
        let extent = [0, 1].map(|k| range(places().map(|place| place[k])).unwrap_or([0.0, 1.0]));
        Stage { extent, largest: self.seams.iter().map(|seam| seam.value).fold(0.0, f64::max) }
    }

    /// [`Picture::svg`] on a stage that it shares with others.
    pub fn svg_on(&self, stage: &Stage) -> String {
        let view = View::on(self.from_front);
        let shapes = self.drawn();
        let ground = self.ground();
        let Stage { extent: [[left, right], [bottom, top]], largest } = *stage;
        let scale = ((WIDTH - 2.0 * MARGIN) / (right - left)).min(TALLEST / (top - bottom));
        let aside = 0.5 * (WIDTH - scale * (right - left));
        let canvas = Canvas { view, scale, left: left - aside / scale, top: top + HEADLINE / scale };
        let below = HEADLINE + scale * (top - bottom) + LINE;
        let coloured = largest > 0.0;
        let dots = self.hinges.iter().filter(|hinge| hinge.block < shapes.len()).collect::<Vec<_>>();
        let of_dots = if dots.is_empty() { 0.0 } else { LINE };
        let most = self.thrusts.iter().map(|own| own.force.norm()).fold(0.0, f64::max);
        let legend = of_dots + if most > 0.0 { LINE } else { 0.0 };
        let to_remarks = legend + if coloured { 3.0 * LINE } else { 0.0 };
        let tall = (below + to_remarks + LINE * (self.remarks.len() as f64 + 1.0)).ceil();
        let mut text = polygon(&canvas.path(&ground), "#f1ede4", "#c9c2b2", 1.0);
        for seam in self.seams.iter().filter(|seam| seam.blocks.iter().any(|b| *b >= shapes.len())) {
            text += &self.patch(seam, largest, &canvas, &seam.polygon);
        }
        let (low, high) = height(&self.stones);
        for block in back_to_front(&shapes, &view, GRAZES * (high - low)) {
            text += &self.block(block, &shapes[block], largest, &canvas);
        }
        for thrust in self.thrusts.iter().filter(|own| own.block < shapes.len() && most > 0.0) {
            let half = thrust.force * (0.5 * LONGEST_THRUST * (high - low) / most);
            let ends =
                self.stones[thrust.block].taking(&[thrust.at - half, thrust.at + half], self.magnification);
            text += &line(&canvas.path(&ends));
        }
        for hinge in &dots {
            let ends = self.stones[hinge.block].falling(&hinge.edge, self.magnification);
            text += &dot(&canvas.path(&[seen_of(&ends, &view)]));
        }
        if coloured {
            let least = format!("below {} % of the largest not coloured", 100.0 * LEAST);
            text += &bar(below + legend, largest, self.unit, &self.measure, &least);
        }
        if !dots.is_empty() {
            let (x, y) = (MARGIN + DOT, below + 4.0);
            let hinges = if dots.len() == 1 { "hinge" } else { "hinges" };
            let said = format!("{} {hinges}: joints open but for an edge that presses", dots.len());
            text += &dot(&format!("{x},{y}"));
            text += &label(x + 2.0 * DOT, y + DOT, 14, &said);
        }
        if most > 0.0 {
            let y = below + of_dots + 4.0;
            let said = format!(
                "thrust: force through each joint at its centre of pressure; longest line {} N",
                significant(most, 3)
            );
            text += &line(&format!("{MARGIN},{y} {},{y}", MARGIN + 4.0 * DOT));
            text += &label(MARGIN + 5.0 * DOT, y + DOT, 14, &said);
        }
        for (place, remark) in self.remarks.iter().enumerate() {
            text += &label(MARGIN, below + to_remarks + LINE * (place as f64 + 0.5), 15, remark);
        }
        sheet(tall, &self.title, &text)
    }

    /// Corners of the ground around the wall.
    fn ground(&self) -> Vec<Vec3> {
        let (low, high) = height(&self.stones);
        let beyond = GROUND * (high - low);
        let across = |k: usize| {
            let built = self.stones.iter().map(|stone| stone.shape.bounds());
            range(built.flat_map(|(from, to)| [from[k], to[k]])).unwrap_or([0.0, 1.0])
        };
        let [[x0, x1], [y0, y1]] = [across(0), across(1)].map(|[from, to]| [from - beyond, to + beyond]);
        [[x0, y0], [x1, y0], [x1, y1], [x0, y1]].map(|[x, y]| Vec3::new(x, y, low)).to_vec()
    }

    /// The faces of a block that are seen, with what its joints did: a joint's polygon as a patch where it lies on a face that is
    /// seen, and as lines where its edges do.
    fn block(&self, block: usize, shape: &Polyhedron, largest: f64, canvas: &Canvas) -> String {
        let view = &canvas.view;
        let planes: Vec<Plane> = (0..shape.faces.len()).map(|face| shape.face_plane(face)).collect();
        let seen: Vec<usize> = (0..planes.len()).filter(|&face| view.sees(&planes[face].normal)).collect();
        let mut text = String::new();
        for &face in &seen {
            let corners: Vec<Vec3> = shape.face_vertices(face).collect();
            let fill = colour::stone(view.brightness(&planes[face].normal));
            text += &polygon(&canvas.path(&corners), &fill, "#5f6468", 0.7);
        }
        let (low, high) = height(&self.stones);
        let tolerance = ON_FACE * (high - low);
        let own = self.seams.iter().filter(|s| s.blocks.contains(&block) && s.value >= LEAST * largest);
        for seam in own.filter(|seam| seam.value > 0.0) {
            let points = self.stones[block].taking(&seam.polygon, self.magnification);
            let Some(normal) = normal(&points) else { continue };
            let (flat, across): (Vec<usize>, Vec<usize>) =
                seen.iter().partition(|&&face| planes[face].normal.dot(&normal).abs() > PARALLEL);
            let on = |face: usize, point: &Vec3| planes[face].distance(point).abs() < tolerance;
            if flat.iter().any(|&face| points.iter().all(|point| on(face, point))) {
                text += &self.patch(seam, largest, canvas, &points);
            }
            for (k, from) in points.iter().enumerate() {
                let to = &points[(k + 1) % points.len()];
                if across.iter().any(|&face| on(face, from) && on(face, to)) {
                    let stroke = colour::of_share(seam.value / largest);
                    let path = canvas.path(&[*from, *to]);
                    text += &format!(
                        "<path d=\"M{path}\" stroke=\"{stroke}\" stroke-width=\"3.2\" stroke-linecap=\"round\"/>\n"
                    );
                }
            }
        }
        text
    }

    /// A joint's polygon in its colour, if it did enough to be coloured.
    fn patch(&self, seam: &Seam, largest: f64, canvas: &Canvas, points: &[Vec3]) -> String {
        if seam.value <= 0.0 || seam.value < LEAST * largest {
            return String::new();
        }
        let fill = colour::of_share(seam.value / largest);
        polygon(&canvas.path(points), &fill, &fill, 0.7)
    }
}

/// Where the view lies on the paper.
struct Canvas {
    view: View,
    /// Pixels per metre.
    scale: f64,
    /// What lies at the left and the upper edge of the paper (m).
    left: f64,
    top: f64,
}

impl Canvas {
    /// Points as SVG writes them.
    fn path(&self, points: &[Vec3]) -> String {
        path(points.iter().map(|point| {
            let [x, y] = self.view.place(point);
            [self.scale * (x - self.left), self.scale * (self.top - y)]
        }))
    }
}

/// The point of an edge at which it is marked: the end that comes nearer to the viewer where it leads away, else its middle.
fn seen_of(ends: &[Vec3], view: &View) -> Vec3 {
    let (from, to) = (ends[0], ends[ends.len() - 1]);
    let away = view.nearness(&to) - view.nearness(&from);
    if away.abs() < LEADS_AWAY * (to - from).norm() || away == 0.0 {
        return (from + to) * 0.5;
    }
    if away > 0.0 { to } else { from }
}

/// A line of thrust through points as SVG writes them.
fn line(points: &str) -> String {
    let drawn = |colour: &str, width: f64| {
        format!(
            "<polyline points=\"{points}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"{width}\" stroke-linecap=\"round\"/>\n"
        )
    };
    // With a light rim, so that it shows on dark joints.
    drawn("#ffffff", 4.5) + &drawn(FORCE, 2.5)
}

/// A dot at a point as SVG writes it.
fn dot(place: &str) -> String {
    let (x, y) = place.split_once(',').unwrap_or((place, place));
    format!(
        "<circle cx=\"{x}\" cy=\"{y}\" r=\"{DOT}\" fill=\"#14213d\" stroke=\"#ffffff\" stroke-width=\"1.5\"/>\n"
    )
}

/// Unit normal of a polygon; `None` where it has no area.
fn normal(points: &[Vec3]) -> Option<Vec3> {
    let first = *points.first()?;
    let area = points[1..]
        .windows(2)
        .fold(Vec3::zeros(), |sum, pair| sum + (pair[0] - first).cross(&(pair[1] - first)));
    area.try_normalize(0.0)
}
