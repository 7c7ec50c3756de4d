//! The contours of SVG path data.

use std::f64::consts::{PI, TAU};

use svgtypes::{PathParser, PathSegment};

use crate::exchange::drawing::curve::cubic;
use crate::exchange::drawing::svg::place::Map;
use crate::math::{atan2, cos, radians, sin, tan};

/// One step along a contour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Step {
    Line([f64; 2]),
    /// Two corners and the end of a cubic Bézier curve.
    Cubic([[f64; 2]; 3]),
}

/// A line without a break.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Contour {
    pub start: [f64; 2],
    pub steps: Vec<Step>,
    pub closed: bool,
}

impl Contour {
    /// Straight from point to point; `None` without points.
    pub fn straight(points: &[[f64; 2]], closed: bool) -> Option<Contour> {
        let (start, rest) = points.split_first()?;
        Some(Contour { start: *start, steps: rest.iter().map(|p| Step::Line(*p)).collect(), closed })
    }

    /// Where a map takes it.
    pub fn mapped(mut self, map: &Map) -> Contour {
        self.start = map.point(self.start);
        for step in &mut self.steps {
            match step {
                Step::Line(end) => *end = map.point(*end),
                Step::Cubic(points) => *points = points.map(|p| map.point(p)),
            }
        }
        self
    }

    /// Its ends and the corners of its curves, around which it does not reach.
    pub fn hull(&self) -> impl Iterator<Item = &[f64; 2]> {
        let points = self.steps.iter().flat_map(|step| match step {
            Step::Line(end) => std::slice::from_ref(end),
            Step::Cubic(points) => points.as_slice(),
        });
        std::iter::once(&self.start).chain(points)
    }

    /// Points on it, between which it is nowhere farther than `tolerance` from straight.
    pub fn points(&self, tolerance: f64) -> Vec<[f64; 2]> {
        let (mut at, mut points) = (self.start, vec![self.start]);
        for step in &self.steps {
            match *step {
                Step::Line(end) => {
                    points.push(end);
                    at = end;
                }
                Step::Cubic([a, b, end]) => {
                    points.extend(cubic([at, a, b, end], tolerance));
                    at = end;
                }
            }
        }
        points
    }
}

/// The contours of path data, in its own axes; what cannot be read is told. At most so many steps.
pub(super) fn contours(data: &str, most: usize) -> Result<Vec<Contour>, String> {
    let mut pen = Pen::default();
    for segment in PathParser::from(data) {
        pen.draw(segment.map_err(|error| format!("its path cannot be read: {error}"))?);
        if pen.steps > most {
            return Err("its path is too long".to_owned());
        }
    }
    pen.lift();
    Ok(pen.all)
}

/// Where the drawing of a path has come to.
#[derive(Default)]
struct Pen {
    all: Vec<Contour>,
    open: Option<Contour>,
    at: [f64; 2],
    /// Where the contour began, to which closing it returns.
    start: [f64; 2],
    /// The last corner of the curve before, which a smooth one mirrors: of a cubic, of a quadratic.
    corners: [Option<[f64; 2]>; 2],
    steps: usize,
}

impl Pen {
    fn draw(&mut self, segment: PathSegment) {
        let [cubic, quadratic] = std::mem::take(&mut self.corners);
        let from = self.at;
        let place = |abs: bool, x: f64, y: f64| if abs { [x, y] } else { [from[0] + x, from[1] + y] };
        let mirrored =
            |corner: Option<[f64; 2]>| corner.map_or(from, |c| [0, 1].map(|k| 2.0 * from[k] - c[k]));
        match segment {
            PathSegment::MoveTo { abs, x, y } => {
                self.lift();
                self.at = place(abs, x, y);
                self.start = self.at;
            }
            PathSegment::LineTo { abs, x, y } => self.step(Step::Line(place(abs, x, y))),
            PathSegment::HorizontalLineTo { abs, x } => {
                self.step(Step::Line([place(abs, x, 0.0)[0], from[1]]))
            }
            PathSegment::VerticalLineTo { abs, y } => self.step(Step::Line([from[0], place(abs, 0.0, y)[1]])),
            PathSegment::CurveTo { abs, x1, y1, x2, y2, x, y } => {
                self.curve(place(abs, x1, y1), place(abs, x2, y2), place(abs, x, y));
            }
            PathSegment::SmoothCurveTo { abs, x2, y2, x, y } => {
                self.curve(mirrored(cubic), place(abs, x2, y2), place(abs, x, y));
            }
            PathSegment::Quadratic { abs, x1, y1, x, y } => {
                self.quadratic(place(abs, x1, y1), place(abs, x, y))
            }
            PathSegment::SmoothQuadratic { abs, x, y } => {
                self.quadratic(mirrored(quadratic), place(abs, x, y))
            }
            PathSegment::EllipticalArc { abs, rx, ry, x_axis_rotation, large_arc, sweep, x, y } => {
                let arc = Arc { from, to: place(abs, x, y), radii: [rx.abs(), ry.abs()], large_arc, sweep };
                arc.steps(radians(x_axis_rotation)).into_iter().for_each(|step| self.step(step));
            }
            PathSegment::ClosePath { .. } => {
                if let Some(open) = &mut self.open {
                    open.closed = true;
                }
                self.lift();
                self.at = self.start;
            }
        }
    }

    fn lift(&mut self) {
        self.all.extend(self.open.take());
    }

    fn step(&mut self, step: Step) {
        let start = self.at;
        let open = self.open.get_or_insert_with(|| Contour { start, steps: Vec::new(), closed: false });
        open.steps.push(step);
        self.steps += 1;
        self.at = match step {
            Step::Line(end) | Step::Cubic([_, _, end]) => end,
        };
    }

    fn curve(&mut self, a: [f64; 2], b: [f64; 2], end: [f64; 2]) {
        self.step(Step::Cubic([a, b, end]));
        self.corners[0] = Some(b);
    }

    fn quadratic(&mut self, corner: [f64; 2], end: [f64; 2]) {
        let toward = |p: [f64; 2]| [0, 1].map(|k| p[k] + 2.0 / 3.0 * (corner[k] - p[k]));
        self.step(Step::Cubic([toward(self.at), toward(end), end]));
        self.corners[1] = Some(corner);
    }
}

/// An arc of an ellipse between two points.
struct Arc {
    from: [f64; 2],
    to: [f64; 2],
    radii: [f64; 2],
    large_arc: bool,
    sweep: bool,
}

impl Arc {
    /// Its steps; the ellipse's first axis is turned by an angle (radians).
    fn steps(&self, turn: f64) -> Vec<Step> {
        let (s, c) = (sin(turn), cos(turn));
        let [rx, ry] = self.radii;
        // Half the chord in the ellipse's own axes, in its radii: on a unit circle.
        let half = [0, 1].map(|k| 0.5 * (self.from[k] - self.to[k]));
        let half = [(c * half[0] + s * half[1]) / rx, (c * half[1] - s * half[0]) / ry];
        let square = half[0] * half[0] + half[1] * half[1];
        if !(square > 0.0 && square.is_finite()) {
            return vec![Step::Line(self.to)];
        }
        // An ellipse too small to reach both points grows until it does.
        let grown = square.max(1.0).sqrt();
        let half = half.map(|x| x / grown);
        let beside = (grown * grown / square - 1.0).max(0.0).sqrt();
        let beside = if self.large_arc == self.sweep { -beside } else { beside };
        let centre = [beside * half[1], -beside * half[0]];
        let begin = atan2(half[1] - centre[1], half[0] - centre[0]);
        let end = atan2(-half[1] - centre[1], -half[0] - centre[0]);
        let angle = (end - begin).rem_euclid(TAU);
        let angle = if self.sweep { angle } else { angle - TAU };
        let middle = [0, 1].map(|k| 0.5 * (self.from[k] + self.to[k]));
        let place = |[x, y]: [f64; 2]| {
            let [x, y] = [grown * rx * (x + centre[0]), grown * ry * (y + centre[1])];
            [middle[0] + c * x - s * y, middle[1] + s * x + c * y]
        };
        let mut steps = unit_arc(begin, angle, place);
        if let Some(Step::Cubic([_, _, last])) = steps.last_mut() {
            *last = self.to;
        }
        steps
    }
}

/// Steps along a unit circle, each a quarter of it at most, with every point taken elsewhere; angles in radians.
pub(super) fn unit_arc(from: f64, sweep: f64, place: impl Fn([f64; 2]) -> [f64; 2]) -> Vec<Step> {
    let count = (sweep.abs() / (0.5 * PI) - 1e-9).ceil().clamp(1.0, 4.0);
    let angle = sweep / count;
    let reach = 4.0 / 3.0 * tan(0.25 * angle);
    let steps = (0..count as usize).map(|i| {
        let (a, b) = (from + angle * i as f64, from + angle * (i + 1) as f64);
        let (sa, ca, sb, cb) = (sin(a), cos(a), sin(b), cos(b));
        Step::Cubic(
            [[ca - reach * sa, sa + reach * ca], [cb + reach * sb, sb - reach * cb], [cb, sb]].map(&place),
        )
    });
    steps.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_of_all_kinds_go_where_they_say() {
        let all = contours("M1 1h2v2H1z m4 0 l1 0 0 1zM0 0L1 0", 100).unwrap();
        assert_eq!(all.len(), 3);
        assert_eq!(all[0].points(1.0), [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
        assert_eq!(all[1].points(1.0), [[5.0, 1.0], [6.0, 1.0], [6.0, 2.0]]);
        assert!(all[1].closed && !all[2].closed);
        let smooth = contours("M0 0 C0 1 1 1 1 0 S2 -1 2 0 Q3 1 4 0 T6 0", 100).unwrap();
        assert_eq!(smooth[0].steps[1], Step::Cubic([[1.0, -1.0], [2.0, -1.0], [2.0, 0.0]]));
        assert_eq!(smooth[0].steps.len(), 4);
        let Step::Cubic([mirrored, ..]) = smooth[0].steps[3] else { panic!("{smooth:?}") };
        assert!((mirrored[0] - 14.0 / 3.0).abs() < 1e-12 && (mirrored[1] + 2.0 / 3.0).abs() < 1e-12);
    }

    #[test]
    fn arcs_lie_on_their_ellipse() {
        for (flags, lowest, highest) in [("0 1", -1.0, 0.0), ("0 0", 0.0, 1.0)] {
            let points = contours(&format!("M0 0 A2 1 0 {flags} 4 0"), 9).unwrap()[0].points(1e-3);
            let on =
                |p: &[f64; 2]| (((p[0] - 2.0) / 2.0) * ((p[0] - 2.0) / 2.0) + p[1] * p[1] - 1.0).abs() < 1e-3;
            assert!(points.iter().all(on), "{points:?}");
            assert!(points.iter().all(|p| (lowest - 1e-3..=highest + 1e-3).contains(&p[1])), "{points:?}");
        }
        // Most of a circle, and one too small.
        let large = contours("M1 0 A1 1 0 1 1 0 -1", 9).unwrap()[0].points(1e-3);
        assert!(large.iter().all(|p| (p[0] * p[0] + p[1] * p[1] - 1.0).abs() < 1e-3), "{large:?}");
        assert!(large.iter().any(|p| p[0] < -0.9) && large.iter().any(|p| p[1] > 0.9));
        let grown = contours("M0 0 A1 1 0 0 1 8 0", 9).unwrap()[0].points(1e-3);
        assert!(grown.iter().any(|p| (p[1] + 4.0).abs() < 0.01), "{grown:?}");
    }

    #[test]
    fn what_is_no_path_is_told() {
        assert!(contours("M0 0 L x", 9).unwrap_err().contains("cannot be read"));
        assert!(contours("M0 0 L1 1 2 2 3 3", 2).is_err());
        assert_eq!(contours("", 9), Ok(Vec::new()));
    }
}
