//! A view on the sheet: where it lies, its dimension lines, the marks of its section and of its load.

use crate::render::markup::escaped;
use crate::render::picture::ink::{FORCE, path};

/// Lines of dimensions and marks.
const THIN: &str = "#555555";
/// Half the length of the strokes at the ends of a dimension line (pixels).
const STROKE: f64 = 5.0;
/// Letters of dimensions (pixels).
const LETTERS: u32 = 14;
/// Length of an arrow, of its head, and half the head's width (pixels).
const ARROW: f64 = 60.0;
const HEAD: f64 = 12.0;
const HALF_HEAD: f64 = 5.0;

/// Where a view lies on the sheet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pane {
    /// Its upper left corner (pixels).
    pub corner: [f64; 2],
    /// Pixels per metre.
    pub scale: f64,
    /// Left, lower, right and upper rim of what is seen (m, on the plane of the view).
    pub frame: [f64; 4],
}

impl Pane {
    /// Where a point lies on the sheet (pixels).
    pub fn at(&self, [s, t]: [f64; 2]) -> [f64; 2] {
        [self.corner[0] + self.scale * (s - self.frame[0]), self.corner[1] + self.scale * (self.frame[3] - t)]
    }

    /// Its right and its lower rim (pixels).
    pub fn end(&self) -> [f64; 2] {
        self.at([self.frame[2], self.frame[1]])
    }

    /// A dimension line below it from one place to another (m), so far below it (pixels).
    pub fn across(&self, [from, to]: [f64; 2], below: f64) -> String {
        let bottom = self.end()[1];
        let [left, right] = [from, to].map(|s| self.at([s, self.frame[1]])[0]);
        let y = bottom + below;
        let mut text = line([left, bottom + 4.0], [left, y + STROKE], THIN);
        text += &line([right, bottom + 4.0], [right, y + STROKE], THIN);
        text += &dimension([left, y], [right, y]);
        text + &words([0.5 * (left + right), y - 4.0], "middle", None, &metres(to - from))
    }

    /// A dimension line on its left from one height to another (m), so far from it (pixels).
    pub fn upright(&self, [from, to]: [f64; 2], aside: f64) -> String {
        let left = self.corner[0];
        let [low, high] = [from, to].map(|t| self.at([self.frame[0], t])[1]);
        let x = left - aside;
        let mut text = line([x - STROKE, low], [left - 4.0, low], THIN);
        text += &line([x - STROKE, high], [left - 4.0, high], THIN);
        text += &dimension([x, low], [x, high]);
        text + &words([x - 5.0, 0.5 * (low + high)], "middle", Some(-90), &metres(to - from))
    }

    /// Where the section lies (m), with its letter at both ends.
    pub fn mark(&self, place: f64, letter: &str) -> String {
        let ([x, top], bottom) = (self.at([place, self.frame[3]]), self.end()[1]);
        let chain = format!(
            "<path d=\"M{} {}\" stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"12 3 2 3\"/>\n",
            path([[x, top - 4.0]]),
            path([[x, bottom + 4.0]])
        );
        let letters = [top - 7.0, bottom + 16.0].map(|y| words([x, y], "middle", None, letter));
        chain + &letters.concat()
    }
}

/// An arrow of the load about a point (pixels), in a direction on the plane of the view, with what it is below it.
pub(super) fn arrow([x, y]: [f64; 2], [s, t]: [f64; 2], said: &str) -> String {
    let on = |along: f64, aside: f64| [x + along * s + aside * t, y - along * t + aside * s];
    let (tip, neck) = (0.5 * ARROW, 0.5 * ARROW - HEAD);
    let head = path([on(tip, 0.0), on(neck, HALF_HEAD), on(neck, -HALF_HEAD)]);
    let shaft = path([on(-tip, 0.0), on(neck, 0.0)]);
    let below = y + tip * t.abs() + 18.0;
    format!(
        "<polyline points=\"{shaft}\" fill=\"none\" stroke=\"{FORCE}\" stroke-width=\"3\"/>\n<polygon points=\"{head}\" fill=\"{FORCE}\"/>\n"
    ) + &words([x, below], "middle", None, said)
}

/// A bar of a length (m) from a point (pixels), in two halves, with its ends.
pub(super) fn scale_bar([x, y]: [f64; 2], scale: f64, length: f64) -> String {
    let half = 0.5 * scale * length;
    let rect = |x: f64, fill: &str| {
        format!(
            "<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{half:.1}\" height=\"6\" fill=\"{fill}\" stroke=\"#000000\"/>\n"
        )
    };
    let ends = [(0.0, "0".to_owned()), (2.0 * half, format!("{length} m"))];
    let ends = ends.map(|(along, said)| words([x + along, y + 22.0], "middle", None, &said));
    rect(x, "#000000") + &rect(x + half, "#ffffff") + &ends.concat()
}

/// The longest of 1, 2 or 5 times a power of ten that is no longer than this (m).
pub(super) fn round_length(most: f64) -> f64 {
    let round = (-3..=2).flat_map(|power| [1.0, 2.0, 5.0].map(|digit| (digit, power)));
    let lengths = round.map(|(digit, power): (f64, i32)| match power {
        0.. => digit * f64::from(10_u32.pow(power.unsigned_abs())),
        _ => digit / f64::from(10_u32.pow(power.unsigned_abs())),
    });
    lengths.filter(|length| *length <= most).fold(1e-3, f64::max)
}

/// Words at a point (pixels), with a light rim so that they show on lines.
pub(super) fn words([x, y]: [f64; 2], anchor: &str, turned: Option<i32>, text: &str) -> String {
    let turned = turned.map_or_else(String::new, |by| format!(" transform=\"rotate({by} {x:.1} {y:.1})\""));
    format!(
        "<text x=\"{x:.1}\" y=\"{y:.1}\"{turned} font-size=\"{LETTERS}\" text-anchor=\"{anchor}\" stroke=\"#ffffff\" stroke-width=\"3\" \
         paint-order=\"stroke\">{}</text>\n",
        escaped(text)
    )
}

/// A length (m) to the millimetre.
pub(super) fn metres(length: f64) -> String {
    format!("{length:.3} m")
}

fn line(from: [f64; 2], to: [f64; 2], colour: &str) -> String {
    format!("<polyline points=\"{}\" stroke=\"{colour}\" stroke-width=\"0.8\"/>\n", path([from, to]))
}

/// The line of a dimension with a stroke across each end.
fn dimension(from: [f64; 2], to: [f64; 2]) -> String {
    let stroke = |[x, y]: [f64; 2]| line([x - STROKE, y + STROKE], [x + STROKE, y - STROKE], "#000000");
    line(from, to, "#000000") + &stroke(from) + &stroke(to)
}
