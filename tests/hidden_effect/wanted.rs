//! What was wanted of a diagnosis before it was measured, and what came out.

use std::fmt::Write as _;

use crate::printed::{head, interval};
use crate::table::Line;
use crate::truth::designs::Design;

/// On which side of a bound a number should lie.
#[derive(Clone, Copy)]
enum Bound {
    AtLeast,
    AtMost,
}

use Bound::{AtLeast, AtMost};

/// A line of the table with what is wanted of it, if anything: in the paper's designs and in the rich ones, without tests on two stones
/// and with them. Shares are in percent.
struct Wanted {
    what: &'static str,
    group: &'static str,
    measure: &'static str,
    bound: Option<(Bound, [[f64; 2]; 2])>,
}

/// Wanted alike with two stones and without.
const fn alike(bound: Bound, paper: f64, rich: f64) -> Option<(Bound, [[f64; 2]; 2])> {
    Some((bound, [[paper, rich]; 2]))
}

/// A line of the table.
const fn line(
    what: &'static str,
    group: &'static str,
    measure: &'static str,
    bound: Option<(Bound, [[f64; 2]; 2])>,
) -> Wanted {
    Wanted { what, group, measure, bound }
}

const MECHANISM_FOUND: &str = "mechanism, found";
const OTHER_CODE: &str = "mechanism, other code";

const WANTED: [Wanted; 27] = [
    line(
        "a name given is right (catalogue and nothing)",
        "catalogue and nothing",
        "a name given is right",
        alike(AtLeast, 95.0, 97.0),
    ),
    line("strong effects named", "mechanism, strong", "named", Some((AtLeast, [[28.0, 55.0], [50.0, 75.0]]))),
    line("middle effects named", "mechanism, middle", "named", Some((AtLeast, [[14.0, 43.0], [27.0, 58.0]]))),
    line("nothing hidden: named", "nothing hidden", "named", alike(AtMost, 0.5, 1.0)),
    line("nothing hidden: found", "nothing hidden", "found", alike(AtMost, 6.0, 6.0)),
    line("prior wrong: named", "prior wrong", "named", alike(AtMost, 1.0, 2.0)),
    line("prior wrong: found", "prior wrong", "found", alike(AtMost, 10.0, 10.0)),
    line("the 90 % set holds it", MECHANISM_FOUND, "the set holds it", alike(AtLeast, 90.0, 90.0)),
    line("its mean size", MECHANISM_FOUND, "mean size of the set", alike(AtMost, 3.5, 2.0)),
    line(
        "calibration error",
        MECHANISM_FOUND,
        "calibration error of the likeliest",
        alike(AtMost, 0.05, 0.04),
    ),
    line(
        "that of one who is calibrated, by chance",
        MECHANISM_FOUND,
        "calibration error by chance alone",
        None,
    ),
    line("truth in another code: named", OTHER_CODE, "named", None),
    line(
        "truth in another code: a name given is right",
        OTHER_CODE,
        "a name given is right",
        alike(AtLeast, 90.0, 93.0),
    ),
    line("out of catalogue: named", "out of catalogue", "named", alike(AtMost, 10.0, 15.0)),
    line(
        "the same without other words for the same thing",
        "out of catalogue",
        "wrongly named",
        alike(AtMost, 2.0, 5.0),
    ),
    line(
        "mechanism out of the catalogue: wrongly named",
        "out of the catalogue in turn",
        "wrongly named",
        alike(AtMost, 5.0, 10.0),
    ),
    line("pairs: another one named", "pairs", "another one named", alike(AtMost, 10.0, 10.0)),
    line("decoys named", "decoys", "named", alike(AtMost, 5.0, 5.0)),
    line(
        "named: a gain on specimens held out",
        "mechanism, named",
        "a gain on specimens held out",
        alike(AtLeast, 85.0, 90.0),
    ),
    line(
        "nothing hidden: a gain claimed",
        "nothing hidden",
        "a gain on specimens held out",
        alike(AtMost, 5.0, 5.0),
    ),
    line("an ambiguous verdict holds it", "mechanism, ambiguous", "the verdict holds it", None),
    line("found, but unexplained", MECHANISM_FOUND, "unexplained", None),
    line("there it is left open", "mechanism, unexplained", "it is left open", None),
    line("strong effects of our code that move it by 3", "mechanism, strong", "shift of 3 or more", None),
    line("of these named", "mechanism, strong", "named where the shift is 3 or more", None),
    line("correct", "catalogue and nothing", "correct", None),
    line(
        "correct by one who never finds anything",
        "catalogue and nothing",
        "correct if nothing is ever found",
        None,
    ),
];

/// A table with a column for each design; what is as wanted is in bold.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = head(&["", "wanted, paper and rich"]);
    for wanted in &WANTED {
        let own = |design: Design| {
            let own = |line: &&Line| {
                (line.design, line.group.as_str(), line.measure)
                    == (design.name(), wanted.group, wanted.measure)
            };
            lines.iter().find(own).unwrap_or_else(|| panic!("{}: {}", wanted.group, wanted.measure))
        };
        let cells = Design::ALL.map(|design| wanted.cell(design, own(design)));
        if cells.iter().any(|cell| !cell.is_empty()) {
            let is_share = own(Design::Paper).counts.is_some();
            writeln!(text, "| {} | {} | {} |", wanted.what, wanted.stated(is_share), cells.join(" | "))
                .expect("text can grow");
        }
    }
    text
}

impl Wanted {
    /// What is wanted, in words.
    fn stated(&self, is_share: bool) -> String {
        let Some((bound, [plain, joints])) = &self.bound else { return String::new() };
        let sign = match bound {
            AtLeast => ">=",
            AtMost => "<=",
        };
        let unit = if is_share { " %" } else { "" };
        let both = |[paper, rich]: &[f64; 2]| match paper == rich {
            true => format!("{paper}{unit}"),
            false => format!("{paper}, {rich}{unit}"),
        };
        match plain == joints {
            true => format!("{sign} {}", both(plain)),
            false => format!("{sign} {}; with two stones {}", both(plain), both(joints)),
        }
    }

    /// What came out; empty where nothing was measured.
    fn cell(&self, design: Design, line: &Line) -> String {
        let Some(value) = line.value else { return String::new() };
        let counted = line.counts.zip(interval(line));
        let number = match counted {
            Some(([hits, trials], _)) if hits == 0 || hits == trials => format!("{hits} of {trials}"),
            Some(([hits, trials], _)) => format!("{hits} of {trials}, {:.0} %", 100.0 * value),
            None if value < 1.0 => format!("{value:.2}"),
            None => format!("{value:.1}"),
        };
        let between = counted.map_or_else(String::new, |(_, [low, high])| {
            format!(" [{:.0}, {:.0}]", 100.0 * low, 100.0 * high)
        });
        let [with_joints, rich] = match design {
            Design::Paper | Design::PaperCoarse => [false, false],
            Design::PaperJoints => [true, false],
            Design::Rich => [false, true],
            Design::RichJoints => [true, true],
        };
        let value = if line.counts.is_some() { 100.0 * value } else { value };
        let as_wanted = self.bound.is_some_and(|(bound, wanted)| {
            let wanted = wanted[usize::from(with_joints)][usize::from(rich)];
            match bound {
                AtLeast => value >= wanted,
                AtMost => value <= wanted,
            }
        });
        if as_wanted { format!("**{number}**{between}") } else { format!("{number}{between}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::table;

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
        set("rich", "mechanism, strong", "named", Some([56, 100]), 0.56);
        set("rich_joints", "mechanism, strong", "named", Some([56, 100]), 0.56);
        set("paper", "decoys", "named", Some([0, 20]), 0.0);
        set("rich", MECHANISM_FOUND, "mean size of the set", None, 2.04);
        let text = markdown(&lines);
        let rows: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(
            rows,
            [
                "| strong effects named | >= 28, 55 %; with two stones 50, 75 % |  |  |  | **56 of 100, 56 %** [46, 66] | 56 of 100, 56 % [46, 66] |",
                "| its mean size | <= 3.5, 2 |  |  |  | 2.0 |  |",
                "| decoys named | <= 5 % | **0 of 20** [0, 17] |  |  |  |  |",
            ]
        );
    }
}
