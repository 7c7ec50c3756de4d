//! From the lines that a file draws to named outlines: what all kinds of drawings have in common.

use std::collections::BTreeMap;

use crate::exchange::drawing::Drawing;
use crate::exchange::drawing::frame::{Extent, frames};
use crate::exchange::drawing::layer::{Shown, shown};
use crate::exchange::drawing::points::{
    NEARLY_MEETING, apart, is_readable, meets, nearly_closed, readable, stays_open,
};
use crate::exchange::fault::{Fault, WallFaults};
use crate::face::{Outline, Part};

/// Most outlines of a file.
const MOST_OUTLINES: usize = 50_000;
/// Most points of a file.
pub(super) const MOST_POINTS: usize = 2_000_000;
/// Ends no farther apart meet, in parts of the drawing's size.
pub(super) const MEETING: f64 = 1e-6;
/// Names listed in a warning, and warnings of one kind.
const LISTED: usize = 8;

/// What cannot be read of a line.
#[derive(Clone, Debug)]
pub(super) struct Unread {
    pub line: usize,
    pub found: String,
    pub allowed: &'static str,
    pub fix: &'static str,
}

impl Unread {
    /// A number that is none, in a line of the file.
    pub fn number(line: usize, what: &str, text: &str) -> Unread {
        let found = format!("{what} is \"{}\"", cut(text.trim()));
        Unread { line, found, allowed: "a finite number", fix: "correct it, or remove the line" }
    }
}

/// A line that a file draws.
#[derive(Clone, Debug)]
pub(super) struct Drawn {
    /// Line of the file where it begins, from 1; 0 where lines do not matter.
    pub line: usize,
    /// The name that the file gives it, or nothing.
    pub own: String,
    /// The layer, the group or the property that says what it is.
    pub layer: String,
    /// Its points in order.
    pub points: Result<Vec<[f64; 2]>, Unread>,
    /// Whether it goes back to its first point.
    pub closed: bool,
}

/// A line that is known to be an outline, or the fault that it is none.
struct Settled {
    line: usize,
    own: String,
    part: Part,
    points: Result<Vec<[f64; 2]>, Unread>,
}

/// What has been read of a drawing so far.
pub(super) struct Gatherer {
    drawn: Vec<(Part, Drawn)>,
    points: usize,
    /// What is no line that could be an outline, and how often it is there.
    kinds: BTreeMap<String, usize>,
    /// Layers whose names say that they are no part of the wall, and what is in them.
    layers: BTreeMap<String, usize>,
    warnings: Vec<String>,
    faults: WallFaults,
}

impl Gatherer {
    /// Of a file named in messages as `file`.
    pub fn new(file: &str) -> Gatherer {
        Gatherer {
            drawn: Vec::new(),
            points: 0,
            kinds: BTreeMap::new(),
            layers: BTreeMap::new(),
            warnings: Vec::new(),
            faults: WallFaults::new(file),
        }
    }

    /// Adds a line; `false` when the file has too many of them and its rest is not worth reading.
    pub fn push(&mut self, drawn: Drawn) -> bool {
        let Shown::Part(part) = shown(&drawn.layer) else {
            self.pass_layer(&drawn.layer);
            return true;
        };
        let line = drawn.line;
        self.points += drawn.points.as_ref().map_or(1, Vec::len);
        self.drawn.push((part, drawn));
        let fits = self.drawn.len() <= MOST_OUTLINES && self.points <= MOST_POINTS;
        if !fits {
            self.fault(too_many(line));
        }
        fits
    }

    /// Counts what is no line of this kind: `HATCH`, `image`.
    pub fn pass(&mut self, kind: &str) {
        count(&mut self.kinds, kind, 1);
    }

    /// Counts something on a layer that is no part of the wall.
    pub fn pass_layer(&mut self, layer: &str) {
        count(&mut self.layers, layer, 1);
    }

    /// Adds a warning of the file.
    pub fn warn(&mut self, warning: String) {
        self.warnings.push(warning);
    }

    /// Adds a fault of the file.
    pub fn fault(&mut self, fault: Fault) {
        self.faults.push(fault);
    }

    /// The faults found, when nothing can be made of the file.
    pub fn into_faults(self) -> WallFaults {
        self.faults
    }

    /// The outlines, named in the order in which the lines were added; `metres` are those in the file's unit.
    pub fn finish(mut self, metres: Option<f64>) -> Result<Drawing, WallFaults> {
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        let drawn = std::mem::take(&mut self.drawn);
        let known = drawn.iter().filter_map(|(_, drawn)| drawn.points.as_ref().ok()).flatten();
        let size = Extent::of(known.filter(|p| is_readable(p))).size();
        let (mut debris, mut nearly, mut grounds) = (0, 0, 0);
        let mut settled = Vec::with_capacity(drawn.len());
        for (part, Drawn { line, own, layer, points, closed }) in drawn {
            let mut points = points.and_then(|points| readable(points, line));
            if let Ok(open) = &mut points
                && !closed
                && Extent::of(&*open).size() > 0.0
                && !meets(open, MEETING * size)
            {
                match nearly_closed(open) {
                    Some(kept) => {
                        open.truncate(kept);
                        nearly += 1;
                    }
                    None if part == Part::Ground => {
                        let found = stays_open(open, &layer);
                        grounds += 1;
                        if grounds <= LISTED {
                            self.warnings.push(format!("the ground at line {line} was passed over: {found}"));
                        }
                        continue;
                    }
                    None => {
                        let fix = "close it, or put what is no stone on a layer named notes";
                        let (found, allowed) = (stays_open(open, &layer), "a closed line, whose ends meet");
                        points = Err(Unread { line, found, allowed, fix });
                    }
                }
            }
            let points = points.map(|points| apart(points, size));
            if points.as_ref().is_ok_and(|points| points.len() <= 1) {
                debris += 1;
                continue;
            }
            settled.push(Settled { line, own, part, points });
        }
        if grounds > LISTED {
            self.warnings
                .push(format!("{} more open lines of the ground were passed over", grounds - LISTED));
        }
        self.leave_out_frames(&mut settled);
        self.warn_of_rest(debris, nearly);
        let outlines = self.named(settled);
        if outlines.is_empty() && self.faults.is_empty() {
            let passed = self.warnings.join("; ");
            let found = if passed.is_empty() {
                "it has no closed line".to_owned()
            } else {
                format!("it has no closed line ({passed})")
            };
            self.faults.push(Fault::of(
                "",
                found,
                "a closed line around each stone",
                "draw them, and save again",
            ));
        }
        if !self.faults.is_empty() {
            return Err(self.faults);
        }
        Ok(Drawing { outlines, metres, warnings: self.warnings, picture: None })
    }

    /// Takes frames out, which have no number among the stones.
    fn leave_out_frames(&mut self, settled: &mut Vec<Settled>) {
        let closed: Vec<usize> = (0..settled.len()).filter(|i| settled[*i].points.is_ok()).collect();
        let line = |i: &usize| Some((settled[*i].part, settled[*i].points.as_deref().ok()?));
        let lines: Vec<(Part, &[[f64; 2]])> = closed.iter().filter_map(line).collect();
        let mut found: Vec<usize> = frames(&lines).into_iter().map(|i| closed[i]).collect();
        found.sort_unstable();
        for i in found.into_iter().rev() {
            let frame = settled.remove(i);
            let at = if frame.line > 0 { format!(" at line {}", frame.line) } else { String::new() };
            self.warnings.push(format!("a rectangle around everything{at} is a frame: it was passed over"));
        }
    }

    /// Tells what was passed over or changed.
    fn warn_of_rest(&mut self, debris: usize, nearly: usize) {
        if debris > 0 {
            self.warnings.push(format!("{debris} line(s) without length were passed over"));
        }
        if nearly > 0 {
            let part = 100.0 * NEARLY_MEETING;
            self.warnings.push(format!(
                "{nearly} open line(s) were closed: their ends come to their beginnings within {part} % of their size"
            ));
        }
        if !self.kinds.is_empty() {
            self.warnings.push(format!("passed over, being no outlines: {}", listed(&self.kinds)));
        }
        if !self.layers.is_empty() {
            self.warnings
                .push(format!("passed over for the names of their layers: {}", listed(&self.layers)));
        }
    }

    /// Gives names; those that are none become faults.
    fn named(&mut self, settled: Vec<Settled>) -> Vec<Outline> {
        let (mut numbers, mut outlines) = ([0; 3], Vec::with_capacity(settled.len()));
        for Settled { line, own, part, points } in settled {
            let (kind, number) = match part {
                Part::Stone | Part::Header => ("stone", &mut numbers[0]),
                Part::Ground => ("ground", &mut numbers[1]),
                Part::Opening => ("opening", &mut numbers[2]),
            };
            let in_brackets = if own.is_empty() { String::new() } else { format!(" ({})", cut(&own)) };
            let name = format!("{kind} {number}{in_brackets}");
            *number += 1;
            match points {
                Ok(points) if points.len() < 3 => {
                    let found = format!("it has {} different points", points.len());
                    let fix = "draw it again, or remove it";
                    self.faults.push(Fault::of(&name, found, "3 points or more", fix).at(line, 0));
                }
                Ok(points) => outlines.push(Outline { name, line, part, points }),
                Err(Unread { line, found, allowed, fix }) => {
                    self.faults.push(Fault::of(&name, found, allowed, fix).at(line, 0));
                }
            }
        }
        outlines
    }
}

/// The fault of a file with too many lines.
pub(super) fn too_many(line: usize) -> Fault {
    let found = "the drawing is too large";
    let allowed = format!("at most {MOST_OUTLINES} outlines and {MOST_POINTS} points");
    Fault::of("", found, allowed, "divide the wall, or simplify its outlines").at(line, 0)
}

/// A text of the file for a message, cut after 60 letters.
pub(super) fn cut(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(60).collect()
}

/// The beginning of a name: enough to tell what it says.
pub(super) fn short(name: &str) -> &str {
    &name[..name.floor_char_boundary(200)]
}

fn count(all: &mut BTreeMap<String, usize>, name: &str, more: usize) {
    match all.get_mut(name) {
        Some(number) => *number += more,
        None => _ = all.insert(name.to_owned(), more),
    }
}

/// `3 of "HATCH", 1 of "TEXT"`, the first few of them.
fn listed(all: &BTreeMap<String, usize>) -> String {
    let mut parts: Vec<String> =
        all.iter().take(LISTED).map(|(name, n)| format!("{n} of \"{}\"", cut(name))).collect();
    let rest: usize = all.values().skip(LISTED).sum();
    if rest > 0 {
        parts.push(format!("{rest} of others"));
    }
    parts.join(", ")
}

/// A number for a message.
pub(super) fn shown_number(number: f64) -> f64 {
    let rounded = (number * 1e4).round() / 1e4;
    if rounded == 0.0 { 0.0 } else { rounded }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(own: &str, layer: &str, points: &[[f64; 2]], closed: bool) -> Drawn {
        Drawn { line: 7, own: own.to_owned(), layer: layer.to_owned(), points: Ok(points.to_vec()), closed }
    }

    const TRIANGLE: [[f64; 2]; 5] = [[0.0, 0.0], [1.0, 0.0], [1.0, 0.0], [0.0, 1.0], [0.0, 0.0]];

    #[test]
    fn outlines_are_numbered_by_part_and_repeated_points_are_dropped() {
        let mut all = Gatherer::new("wall.svg");
        for (own, layer) in [("K3", "stones"), ("", "ground"), ("", "notes"), ("", "stones")] {
            assert!(all.push(line(own, layer, &TRIANGLE, true)));
        }
        all.push(line("", "", &[[2.0, 2.0]; 3], true));
        let drawing = all.finish(None).unwrap();
        let names: Vec<&str> = drawing.outlines.iter().map(|outline| outline.name.as_str()).collect();
        assert_eq!(names, ["stone 0 (K3)", "ground 0", "stone 1"]);
        assert_eq!(drawing.outlines[0].points, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
        assert_eq!(
            drawing.warnings,
            [
                "1 line(s) without length were passed over",
                "passed over for the names of their layers: 1 of \"notes\""
            ]
        );
    }

    #[test]
    fn open_lines_close_where_their_ends_nearly_meet_and_are_faults_elsewhere() {
        let mut all = Gatherer::new("wall.svg");
        all.push(line("", "", &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.01]], false));
        all.push(line("", "ground", &[[0.0, 0.0], [9.0, 0.0], [9.0, 0.5]], false));
        // One that ends where it begins, and one that runs along its first side again.
        all.push(line("", "", &TRIANGLE, false));
        all.push(line(
            "",
            "",
            &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.0, 0.0], [1.0, 0.0]],
            false,
        ));
        let drawing = all.finish(Some(1.0)).unwrap();
        let corners: Vec<usize> = drawing.outlines.iter().map(|own| own.points.len()).collect();
        assert_eq!((corners, drawing.warnings.len()), (vec![4, 3, 4], 2), "{:?}", drawing.warnings);
        assert!(drawing.warnings[1].starts_with("2 open line(s) were closed"), "{:?}", drawing.warnings);
        let mut all = Gatherer::new("wall.svg");
        all.push(line("", "", &[[0.0, 0.0], [1.0, 0.0]], true));
        all.push(line("", "", &[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], false));
        all.push(line("", "", &[[0.0, f64::NAN], [1.0, 0.0], [1.0, 1.0]], true));
        let said = all.finish(None).unwrap_err().to_string();
        assert!(said.contains("wall.svg:7: stone 0: it has 2 different points; allowed is 3"), "{said}");
        assert!(
            said.contains("stone 1: a line of layer \"\" is open from (0, 0) to (1, 1), 1.4142 apart"),
            "{said}"
        );
        assert!(said.contains("stone 2: a point lies at (0, NaN); allowed is finite"), "{said}");
    }

    #[test]
    fn a_drawing_of_too_much_or_of_nothing_is_a_fault() {
        let mut all = Gatherer::new("wall.svg");
        let fits = (0..=MOST_OUTLINES).map(|_| all.push(line("", "", &TRIANGLE, true))).filter(|fits| *fits);
        assert_eq!(fits.count(), MOST_OUTLINES);
        assert!(all.finish(None).unwrap_err().to_string().contains("at most 50000 outlines"));
        let mut none = Gatherer::new("wall.svg");
        none.pass("image");
        let said = none.finish(None).unwrap_err().to_string();
        assert!(said.contains("no closed line (passed over, being no outlines: 1 of \"image\")"), "{said}");
    }
}
