//! What was wanted of a diagnosis before it was measured, and what came out.

use std::fmt::Write as _;

use crate::printed::{head, interval};
use crate::table::Line;
use crate::truth::designs::Design;

/// On which side of its bound a number should lie.
#[derive(Clone, Copy)]
enum Side {
    AtLeast,
    AtMost,
}

use Side::{AtLeast, AtMost};

/// Bounds in the paper's designs and in the rich ones.
#[derive(Clone, Copy)]
struct Bounds {
    on: Side,
    plain: [f64; 2],
    /// With tests on two stones.
    with_joints: [f64; 2],
}

/// The same with tests on two stones and without.
const fn alike(on: Side, paper: f64, rich: f64) -> Option<Bounds> {
    Some(Bounds { on, plain: [paper, rich], with_joints: [paper, rich] })
}

/// What a row is called, group and measure of the line that it shows, and what is wanted of it, if anything.
const WANTED: &[(&str, &str, &str, Option<Bounds>)] = &[
    (
        "a name given is right (catalogue and nothing)",
        "catalogue and nothing",
        "a name given is right",
        alike(AtLeast, 0.95, 0.97),
    ),
    ("the same in all groups, as large as they are", "all groups", "a name given is right", None),
    (
        "strong effects named",
        "mechanism, strong",
        "named",
        Some(Bounds { on: AtLeast, plain: [0.28, 0.55], with_joints: [0.50, 0.75] }),
    ),
    (
        "middle effects named",
        "mechanism, middle",
        "named",
        Some(Bounds { on: AtLeast, plain: [0.14, 0.43], with_joints: [0.27, 0.58] }),
    ),
    ("nothing hidden: named", "nothing hidden", "named", alike(AtMost, 0.005, 0.01)),
    ("nothing hidden: found", "nothing hidden", "found", alike(AtMost, 0.06, 0.06)),
    ("prior wrong: named", "prior wrong", "named", alike(AtMost, 0.01, 0.02)),
    ("prior wrong: found", "prior wrong", "found", alike(AtMost, 0.10, 0.10)),
    (
        "mechanism found: the 90 % set holds it",
        "mechanism, found",
        "the set holds it",
        alike(AtLeast, 0.90, 0.90),
    ),
    (
        "mechanism found: mean size of the set",
        "mechanism, found",
        "mean size of the set",
        alike(AtMost, 3.5, 2.0),
    ),
    (
        "mechanism found: calibration error",
        "mechanism, found",
        "calibration error of the likeliest",
        alike(AtMost, 0.05, 0.04),
    ),
    ("calibration error by chance alone", "mechanism, found", "calibration error by chance alone", None),
    ("truth in another code: named", "mechanism, other code", "named", None),
    (
        "truth in another code: a name given is right",
        "mechanism, other code",
        "a name given is right",
        alike(AtLeast, 0.90, 0.93),
    ),
    ("out of catalogue: named", "out of catalogue", "named", alike(AtMost, 0.10, 0.15)),
    (
        "out of catalogue: named, not in other words",
        "out of catalogue",
        "wrongly named",
        alike(AtMost, 0.02, 0.05),
    ),
    (
        "the same, of no form that the ranking learnt",
        "out of catalogue, of no form that was learnt",
        "wrongly named",
        None,
    ),
    (
        "mechanism out of the catalogue: wrongly named",
        "out of the catalogue in turn",
        "wrongly named",
        alike(AtMost, 0.05, 0.10),
    ),
    ("pairs: others named", "pairs", "others named", alike(AtMost, 0.10, 0.10)),
    ("decoys: named", "decoys", "named", alike(AtMost, 0.05, 0.05)),
    (
        "named: a gain on specimens held out",
        "mechanism, named",
        "a gain on specimens held out",
        alike(AtLeast, 0.85, 0.90),
    ),
    (
        "nothing hidden: a gain claimed",
        "nothing hidden",
        "a gain on specimens held out",
        alike(AtMost, 0.05, 0.05),
    ),
    ("ambiguous: the verdict holds the mechanism", "mechanism, ambiguous", "the verdict holds it", None),
    ("mechanism found: unexplained", "mechanism, found", "unexplained", None),
    ("unexplained: the mechanism is left open", "mechanism, unexplained", "it is left open", None),
    ("strong effects of our code with a shift of 3 or more", "mechanism, strong", "shift of 3 or more", None),
    (
        "strong effects with such a shift: named",
        "mechanism, strong",
        "named where the shift is 3 or more",
        None,
    ),
    ("correct", "catalogue and nothing", "correct", None),
    (
        "correct by one who never finds anything",
        "catalogue and nothing",
        "correct if nothing is ever found",
        None,
    ),
];

/// A table with a column for each design; what is as wanted is in bold.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = head(&["", "wanted, paper and rich"]);
    for (what, group, measure, bounds) in WANTED {
        let of = |design: Design| {
            let asked = (design.name(), *group, *measure);
            let own = lines.iter().find(|line| (line.design, &line.group[..], line.measure) == asked);
            own.unwrap_or_else(|| panic!("{group}: {measure}"))
        };
        let cells = Design::ALL.map(|design| cell(of(design), bounds.map(|bounds| (design, bounds))));
        if cells.iter().any(|cell| !cell.is_empty()) {
            let is_share = of(Design::Paper).counts.is_some();
            let stated = bounds.map_or_else(String::new, |bounds| bounds.stated(is_share));
            writeln!(text, "| {what} | {stated} | {} |", cells.join(" | ")).expect("text can grow");
        }
    }
    text
}

/// What came out; empty where nothing was measured.
fn cell(line: &Line, bounds: Option<(Design, Bounds)>) -> String {
    let Some(value) = line.value else { return String::new() };
    let (number, between) = match line.counts.zip(interval(line)) {
        Some(([hits, trials], [low, high])) => {
            let share = format!("{hits} of {trials}, {:.0} %", 100.0 * value);
            let number = if hits == 0 || hits == trials { format!("{hits} of {trials}") } else { share };
            (number, format!(" [{:.0}, {:.0}]", 100.0 * low, 100.0 * high))
        }
        None => {
            let between = line.between.map(|[low, high]| format!(" [{low:.2}, {high:.2}]"));
            (format!("{value:.2}"), between.unwrap_or_default())
        }
    };
    match bounds.is_some_and(|(design, bounds)| bounds.hold(design, value)) {
        true => format!("**{number}**{between}"),
        false => number + &between,
    }
}

impl Bounds {
    /// In words.
    fn stated(&self, is_share: bool) -> String {
        let sign = match self.on {
            AtLeast => ">=",
            AtMost => "<=",
        };
        let both = |[paper, rich]: [f64; 2]| {
            // Shares are stated in tenths of a percent.
            let number = |x: f64| if is_share { (1000.0 * x).round() / 10.0 } else { x };
            let unit = if is_share { " %" } else { "" };
            match paper == rich {
                true => format!("{}{unit}", number(paper)),
                false => format!("{}, {}{unit}", number(paper), number(rich)),
            }
        };
        match self.plain == self.with_joints {
            true => format!("{sign} {}", both(self.plain)),
            false => format!("{sign} {}; with two stones {}", both(self.plain), both(self.with_joints)),
        }
    }

    fn hold(&self, design: Design, value: f64) -> bool {
        let [paper, rich] = if design.has_joints() { self.with_joints } else { self.plain };
        let bound = if design.is_rich() { rich } else { paper };
        match self.on {
            AtLeast => value >= bound,
            AtMost => value <= bound,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table;
    use crate::truth::roster::root;

    #[test]
    fn every_line_that_is_wanted_is_in_the_table_and_bold_where_it_is_reached() {
        let mut lines = table::of(&[], &[]);
        // Without campaigns there is a line for everything, and no row.
        assert_eq!(markdown(&lines).lines().count(), 2);
        let mut set = |design: &str, group: &str, measure: &str, counts: Option<[usize; 2]>, value: f64| {
            let own =
                |line: &&mut Line| (line.design, &line.group[..], line.measure) == (design, group, measure);
            let line = lines.iter_mut().find(own).expect("it is there");
            (line.counts, line.value) = (counts, Some(value));
        };
        for (design, hits) in [("paper", 14), ("paper_joints", 26), ("rich", 58), ("rich_joints", 58)] {
            set(design, "mechanism, middle", "named", Some([hits, 100]), hits as f64 / 100.0);
        }
        set("paper", "decoys", "named", Some([0, 20]), 0.0);
        set("rich", "decoys", "named", Some([3, 20]), 0.15);
        set("rich", "mechanism, found", "mean size of the set", None, 2.04);
        let text = markdown(&lines);
        let rows: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(
            rows,
            [
                "| middle effects named | >= 14, 43 %; with two stones 27, 58 % | **14 of 100, 14 %** [8, 22] |  | 26 of 100, 26 % [18, 36] | **58 of 100, 58 %** [48, 68] | **58 of 100, 58 %** [48, 68] |",
                "| mechanism found: mean size of the set | <= 3.5, 2 |  |  |  | 2.04 |  |",
                "| decoys: named | <= 5 % | **0 of 20** [0, 17] |  |  | 3 of 20, 15 % [3, 38] |  |",
            ]
        );
    }

    #[test]
    fn the_readme_shows_the_table_that_was_published() {
        let folder = root("studies/hidden-effects");
        let [table, readme] = ["table.md", "README.md"]
            .map(|name| std::fs::read_to_string(folder.join(name)).expect("it is in the repository"));
        let start =
            table.find(&head(&["", "wanted, paper and rich"])).expect("it begins with what was wanted");
        let wanted = table[start..].split("\n\n").next().expect("a table");
        assert!(wanted.lines().count() > 20 && readme.contains(wanted), "{wanted}");
    }
}
