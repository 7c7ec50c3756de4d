//! What was wanted of a diagnosis before it was measured, and what came out.

use std::fmt::Write as _;

use crate::printed::{head, interval};
use crate::table::Line;
use crate::truth::designs::Design;
use crate::truth::label::Group;

/// Between which two values a number should lie, in the paper's design and in the rich one; none where nothing is asked.
type Bounds = [Option<[f64; 2]>; 2];

const NONE: Bounds = [None, None];

const fn at_least(paper: f64, rich: f64) -> Bounds {
    [Some([paper, f64::INFINITY]), Some([rich, f64::INFINITY])]
}

const fn at_most(paper: f64, rich: f64) -> Bounds {
    [Some([f64::NEG_INFINITY, paper]), Some([f64::NEG_INFINITY, rich])]
}

const fn in_paper(low: f64) -> Bounds {
    [Some([low, f64::INFINITY]), None]
}

const fn in_rich(low: f64) -> Bounds {
    [None, Some([low, f64::INFINITY])]
}

/// What a row is called, the group of campaigns that it decides on, group and measure of the line that it shows, and what is wanted
/// of it, if anything.
const WANTED: &[(&str, Group, &str, &str, Bounds)] = &[
    ("nothing hidden: named", Group::Nothing, "nothing hidden", "named", at_most(0.01, 0.01)),
    ("nothing hidden: found", Group::Nothing, "nothing hidden", "found", at_most(0.06, 0.06)),
    ("prior of kn and phi wrong: named", Group::PriorWrong, "prior wrong", "named", at_most(0.01, 0.02)),
    ("prior of kn and phi wrong: found", Group::PriorWrong, "prior wrong", "found", at_most(0.10, 0.10)),
    (
        "a name given is right (mechanisms and nothing)",
        Group::Mechanism,
        "catalogue and nothing",
        "a name given is right",
        at_least(0.95, 0.96),
    ),
    (
        "strong effects with a shift of 3 or more: named",
        Group::Mechanism,
        "mechanism, strong",
        "named where the shift is 3 or more",
        at_least(0.75, 0.88),
    ),
    ("strong effects with such a shift", Group::Mechanism, "mechanism, strong", "shift of 3 or more", NONE),
    ("strong effects: named", Group::Mechanism, "mechanism, strong", "named", NONE),
    ("middle effects: named", Group::Mechanism, "mechanism, middle", "named", NONE),
    ("weak effects: named", Group::Mechanism, "mechanism, weak", "named", NONE),
    (
        "mechanism found: the 90 % set holds it",
        Group::Mechanism,
        "mechanism, found",
        "the set holds it",
        at_least(0.88, 0.88),
    ),
    (
        "mechanism found: mean size of the set",
        Group::Mechanism,
        "mechanism, found",
        "mean size of the set",
        NONE,
    ),
    (
        "ambiguous: the verdict holds the mechanism",
        Group::Mechanism,
        "mechanism, ambiguous",
        "the verdict holds it",
        NONE,
    ),
    ("mechanism found: unexplained", Group::Mechanism, "mechanism, found", "unexplained", NONE),
    (
        "within the physical prior: conflict flagged",
        Group::Mechanism,
        "mechanism, within its physical prior",
        "conflict flagged",
        [Some([0.03, 0.07]), Some([0.03, 0.07])],
    ),
    (
        "truth in another code: a name given is right",
        Group::OtherCode,
        "mechanism, other code",
        "a name given is right",
        at_least(0.90, 0.90),
    ),
    ("truth in another code: named", Group::OtherCode, "mechanism, other code", "named", NONE),
    (
        "2 spreads outside: the verdict holds it",
        Group::Outside,
        "outside its prior, 2 spreads",
        "the verdict holds it",
        NONE,
    ),
    (
        "3 spreads outside: the verdict holds it",
        Group::Outside,
        "outside its prior, 3 spreads",
        "the verdict holds it",
        in_paper(0.50),
    ),
    (
        "3 spreads outside: named, and said to lie outside",
        Group::Outside,
        "outside its prior, 3 spreads",
        "named, and said to lie outside",
        in_rich(0.85),
    ),
    (
        "4 spreads outside: named, and said to lie outside",
        Group::Outside,
        "outside its prior, 4 spreads",
        "named, and said to lie outside",
        NONE,
    ),
    (
        "outside the prior: wrong names",
        Group::Outside,
        "outside its prior",
        "another one named",
        at_most(0.03, 0.03),
    ),
    ("outside the prior: conflict flagged", Group::Outside, "outside its prior", "conflict flagged", NONE),
    (
        "laws of no catalogue: wrong names",
        Group::Law,
        "laws of no catalogue",
        "another one named",
        at_most(0.03, 0.06),
    ),
    ("laws of no catalogue: found", Group::Law, "laws of no catalogue", "found", NONE),
    (
        "learnt laws: the band holds the truth",
        Group::Law,
        "learnt laws",
        "its band holds the truth",
        in_rich(0.90),
    ),
    (
        "learnt laws: the collapse of one more wall",
        Group::Law,
        "learnt laws",
        "the collapse of one more wall lies within",
        in_rich(0.90),
    ),
    ("learnt laws: a sign given is right", Group::Law, "learnt laws", "a sign given is right", in_rich(0.85)),
    (
        "learnt laws: the sign is given and right",
        Group::Law,
        "learnt laws",
        "the sign is given and right",
        NONE,
    ),
    (
        "out of the catalogue: wrong names",
        Group::Unknown,
        "out of catalogue",
        "wrongly named",
        at_most(0.03, 0.06),
    ),
    ("out of the catalogue: found", Group::Unknown, "out of catalogue", "found", NONE),
    ("a gauge that saturates: found", Group::Unknown, "saturation", "found", NONE),
    ("pairs: one of the two named, or both", Group::Pair, "pairs", "one of the two named, or both", NONE),
    ("pairs: others named", Group::Pair, "pairs", "others named", at_most(0.10, 0.10)),
    ("decoys: named", Group::Decoy, "decoys", "named", at_most(0.05, 0.05)),
];

/// Whether all that is wanted of a group is decided: the intervals lie on one side of every bound.
pub fn is_decided(lines: &[Line], group: Group) -> bool {
    let own = WANTED.iter().filter(|(_, of, ..)| *of == group);
    own.flat_map(|row| Design::ALL.map(|design| (row, design))).all(
        |((.., group, measure, bounds), design)| {
            let Some([low, high]) = bounds[design as usize] else { return true };
            let line = line(lines, design, group, measure);
            line.and_then(interval)
                .is_some_and(|[from, to]| to < low || from > high || (low <= from && to <= high))
        },
    )
}

fn line<'l>(lines: &'l [Line], design: Design, group: &str, measure: &str) -> Option<&'l Line> {
    let asked = (design.name(), group, measure);
    lines.iter().find(|line| (line.design, &line.group[..], line.measure) == asked)
}

/// A line, if there is one, and its bounds, if there are any.
pub type Asked<'l> = (Option<&'l Line>, Option<[f64; 2]>);

/// The rows of which something is wanted, each with its line and its bounds in every design.
pub fn asked(lines: &[Line]) -> Vec<(&'static str, [Asked<'_>; Design::ALL.len()])> {
    let rows = WANTED.iter().filter(|(.., bounds)| bounds.iter().any(Option::is_some));
    rows.map(|(what, _, group, measure, bounds)| {
        (*what, Design::ALL.map(|design| (line(lines, design, group, measure), bounds[design as usize])))
    })
    .collect()
}

/// A table with a column for each design; what is as wanted is in bold.
pub fn markdown(lines: &[Line]) -> String {
    let mut text = head(&["", "wanted, paper and rich"]);
    for (what, _, group, measure, bounds) in WANTED {
        let cells = Design::ALL.map(|design| {
            let own = line(lines, design, group, measure);
            own.map_or_else(String::new, |own| cell(own, bounds[design as usize]))
        });
        if cells.iter().any(|cell| !cell.is_empty()) {
            writeln!(text, "| {what} | {} | {} |", stated(*bounds), cells.join(" | "))
                .expect("text can grow");
        }
    }
    text
}

/// What came out; empty where nothing was measured.
fn cell(line: &Line, bounds: Option<[f64; 2]>) -> String {
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
    match bounds.is_some_and(|[low, high]| (low..=high).contains(&value)) {
        true => format!("**{number}**{between}"),
        false => number + &between,
    }
}

/// Bounds on shares in words.
fn stated(bounds: Bounds) -> String {
    // Shares are stated in tenths of a percent.
    let number = |x: f64| format!("{}", (1000.0 * x).round() / 10.0);
    let one = |[low, high]: [f64; 2]| match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{} to {} %", number(low), number(high)),
        (true, false) => format!(">= {} %", number(low)),
        _ => format!("<= {} %", number(high)),
    };
    match bounds {
        [Some(paper), Some(rich)] if paper == rich => one(paper),
        [Some(paper), Some(rich)] => format!("{}, {}", one(paper), one(rich)),
        [Some(paper), None] => format!("{} in paper", one(paper)),
        [None, Some(rich)] => format!("{} in rich", one(rich)),
        [None, None] => String::new(),
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
        for (what, _, group, measure, bounds) in WANTED {
            for design in Design::ALL {
                let there = line(&lines, design, group, measure).is_some();
                // Laws are learnt from rich readings alone.
                assert!(there || (design == Design::Paper && bounds[0].is_none()), "{what}");
            }
        }
        // Without campaigns there is a line for everything, and no row.
        assert_eq!(markdown(&lines).lines().count(), 2);
        let mut set = |design: &str, group: &str, measure: &str, counts: Option<[usize; 2]>, value: f64| {
            let own =
                |line: &&mut Line| (line.design, &line.group[..], line.measure) == (design, group, measure);
            let line = lines.iter_mut().find(own).expect("it is there");
            (line.counts, line.value) = (counts, Some(value));
        };
        set("paper", "catalogue and nothing", "a name given is right", Some([94, 100]), 0.94);
        set("rich", "catalogue and nothing", "a name given is right", Some([97, 100]), 0.97);
        set("paper", "decoys", "named", Some([0, 20]), 0.0);
        set("rich", "decoys", "named", Some([3, 20]), 0.15);
        set("rich", "mechanism, found", "mean size of the set", None, 2.04);
        let text = markdown(&lines);
        let rows: Vec<&str> = text.lines().skip(2).collect();
        assert_eq!(
            rows,
            [
                "| a name given is right (mechanisms and nothing) | >= 95 %, >= 96 % | 94 of 100, 94 % [86, 98] | **97 of 100, 97 %** [90, 100] |",
                "| mechanism found: mean size of the set |  |  | 2.04 |",
                "| decoys: named | <= 5 % | **0 of 20** [0, 21] | 3 of 20, 15 % [2, 43] |",
            ]
        );
    }

    #[test]
    fn a_group_is_decided_when_all_its_intervals_lie_on_one_side() {
        let mut lines = table::of(&[], &[]);
        let mut set = |design: &str, hits: usize, trials: usize| {
            let own = |line: &&mut Line| {
                (line.design, &line.group[..], line.measure) == (design, "decoys", "named")
            };
            lines.iter_mut().find(own).expect("it is there").counts = Some([hits, trials]);
            is_decided(&lines, Group::Decoy)
        };
        // The other design is not decided yet; 0 of 20 may still be 0.2, and 0 of 200 no more than 0.024.
        assert!(!set("paper", 0, 200) && !set("rich", 0, 20) && set("rich", 0, 200) && set("rich", 60, 200));
        assert!(!set("rich", 10, 200));
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
