//! The shape of a table of keys: one definition from which the parser checks, faults are worded and the
//! reference of keys is printed.

use std::fmt;

use crate::exchange::WALL_FILES;
use crate::study::angle::Angle;

/// A table of the input and its keys.
#[derive(Debug)]
pub struct Section {
    /// How the table is called in the reference, as `[wall]`.
    pub title: &'static str,
    /// What it is about.
    pub doc: &'static str,
    /// The key whose value decides which other keys apply.
    pub chooser: Option<&'static str>,
    /// Its keys, in groups that several sections may share.
    pub keys: &'static [&'static [Key]],
}

/// One key.
#[derive(Clone, Copy, Debug)]
pub struct Key {
    /// Name, with its unit at the end.
    pub name: &'static str,
    /// Kind of value and what is allowed.
    pub kind: Kind,
    /// Whether it must be there.
    pub presence: Presence,
    /// Values of the section's chooser for which the key is used; empty for all.
    pub only: &'static [&'static str],
    /// Where a value is usual; outside it a warning is given.
    pub usual: Option<Interval>,
    /// Which angle (deg) it is, of those that a warning asks about where they look like radians.
    pub angle: Option<Angle>,
    /// What it means, in one line.
    pub doc: &'static str,
}

/// Whether a key must be there.
#[derive(Clone, Copy, Debug)]
pub enum Presence {
    /// It must.
    Required,
    /// It may be left out, and then means nothing or what another table says.
    Optional,
    /// It must, unless this other key is there, which takes its place.
    Unless(&'static str),
    /// It may be left out, and then has this value, written in TOML.
    Default(&'static str),
}

/// Kind of a value and what is allowed. Units are SI or deg; "1" is a plain number.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// Prose: does not decide any result.
    Text,
    /// A name: lower-case letters, digits, `-` and `_`.
    Name,
    /// true or false.
    Flag,
    /// One of the names.
    Choice(&'static [&'static str]),
    /// A whole number.
    Whole {
        /// Smallest.
        low: u64,
        /// Largest.
        high: u64,
    },
    /// A whole number, or a table that says by which rule it comes about.
    WholeOr {
        /// Smallest.
        low: u64,
        /// Largest.
        high: u64,
        /// The table.
        rule: &'static Section,
    },
    /// The name of a statistic.
    Statistic,
    /// A number.
    Real {
        /// Unit.
        unit: &'static str,
        /// Allowed values.
        within: Interval,
    },
    /// A number, or a distribution: an inline table, or a reference to an entry below `distributions`.
    Quantity {
        /// Unit.
        unit: &'static str,
        /// Where the whole distribution must lie.
        within: Interval,
    },
    /// A distribution that is no single number, written as those of a quantity.
    Distribution {
        /// Unit.
        unit: &'static str,
        /// Where the whole distribution must lie.
        within: Interval,
    },
    /// A list of numbers.
    Reals {
        /// Unit.
        unit: &'static str,
        /// Allowed values.
        within: Interval,
        /// Largest number of entries.
        at_most: usize,
        /// Whether each must be above the one before.
        ascending: bool,
    },
    /// A list of numbers, or a column of a table beside the study.
    Values {
        /// Largest number of entries.
        at_most: usize,
    },
    /// Pairs of length and height (m): a table beside the study, or a list.
    Stones {
        /// Allowed values.
        within: Interval,
        /// Largest number of pairs.
        at_most: usize,
    },
    /// Two whole numbers.
    Pair {
        /// Smallest.
        low: u64,
        /// Largest.
        high: u64,
    },
    /// Two names.
    NamePair,
    /// A list of names, each once.
    Names,
    /// A list of files beside the study, each once.
    Files {
        /// Largest number of them.
        at_most: usize,
    },
    /// A file beside the study with the stones of a wall.
    WallFile,
    /// A table.
    Table(&'static Section),
    /// A list of tables, each with a `name` or a number.
    Tables(&'static Section),
    /// A table from paths of keys to values.
    Settings,
    /// A list of paths of keys.
    Paths,
}

/// An interval of the real line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// Lower bound.
    pub low: f64,
    /// Upper bound.
    pub high: f64,
    /// Whether the lower bound itself is outside.
    pub open_low: bool,
    /// Whether the upper bound itself is outside.
    pub open_high: bool,
}

impl Interval {
    /// `[low, high]`
    pub const fn closed(low: f64, high: f64) -> Interval {
        Interval { low, high, open_low: false, open_high: false }
    }

    /// `(low, high]`
    pub const fn above(low: f64, high: f64) -> Interval {
        Interval { low, high, open_low: true, open_high: false }
    }

    /// `[low, high)`
    pub const fn below(low: f64, high: f64) -> Interval {
        Interval { low, high, open_low: false, open_high: true }
    }

    /// `(low, high)`
    pub const fn open(low: f64, high: f64) -> Interval {
        Interval { low, high, open_low: true, open_high: true }
    }

    /// Every finite number.
    pub const fn any() -> Interval {
        Interval::open(f64::NEG_INFINITY, f64::INFINITY)
    }

    /// Whether `x` is inside; NaN never is.
    pub fn contains(&self, x: f64) -> bool {
        let above = if self.open_low { x > self.low } else { x >= self.low };
        let below = if self.open_high { x < self.high } else { x <= self.high };
        above && below
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (low, high) = (Short(self.low), Short(self.high));
        match (self.low.is_finite(), self.high.is_finite()) {
            (false, false) => write!(f, "finite"),
            (true, false) => write!(f, "{} {low}", if self.open_low { "above" } else { "at least" }),
            (false, true) => write!(f, "{} {high}", if self.open_high { "below" } else { "at most" }),
            (true, true) if !self.open_low && !self.open_high => write!(f, "within {low} to {high}"),
            (true, true) => write!(
                f,
                "{} {low} and {} {high}",
                if self.open_low { "above" } else { "at least" },
                if self.open_high { "below" } else { "at most" },
            ),
        }
    }
}

/// A number as people write it: `1e12` instead of `1000000000000`.
pub struct Short(pub f64);

impl fmt::Display for Short {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let x = self.0;
        if x != 0.0 && (x.abs() >= 1e5 || x.abs() < 1e-3) { write!(f, "{x:e}") } else { write!(f, "{x}") }
    }
}

impl Kind {
    /// What is allowed, in words.
    pub fn allowed(&self) -> String {
        match self {
            Kind::Text => "a text in quotes that is not empty".to_owned(),
            Kind::Name => "a name of lower-case letters, digits, - and _, at most 64 characters".to_owned(),
            Kind::Flag => "true or false".to_owned(),
            Kind::Choice(names) => format!("one of {}", quoted(names)),
            Kind::Whole { low, high } => format!("a whole number within {low} to {high}"),
            Kind::WholeOr { low, high, rule } => {
                format!("a whole number within {low} to {high}, or a table {}", rule.title)
            }
            Kind::Statistic => "\"mean\", \"sigma\" or \"quantile-P\" with P above 0 and below 1".to_owned(),
            Kind::Real { unit, within } => format!("a number {within}{}", in_unit(unit)),
            Kind::Quantity { unit, within } => {
                format!("a number or a distribution {within}{}", in_unit(unit))
            }
            Kind::Distribution { unit, within } => {
                format!("a distribution {within}{}", in_unit(unit))
            }
            Kind::Reals { unit, within, at_most, ascending } => {
                let order = if *ascending { "ascending " } else { "" };
                format!("a list of 1 to {at_most} {order}numbers, each {within}{}", in_unit(unit))
            }
            Kind::Values { at_most } => format!(
                "a list of 1 to {at_most} numbers; or a column of a table beside the study, as \"survey.csv:length_m\""
            ),
            Kind::Stones { within, at_most } => format!(
                "a table beside the study with columns length_m and height_m, as \"survey.csv\"; or a list of 1 to {at_most} \
                 pairs [length, height], each number {within} (m)"
            ),
            Kind::Pair { low, high } => format!("a list of two whole numbers within {low} to {high}"),
            Kind::NamePair => "a list of two different names".to_owned(),
            Kind::Names => "a list of names, each once".to_owned(),
            Kind::Files { at_most } => {
                format!("1 to {at_most} files in the study's folder, each once, as [\"records/one.at2\"]")
            }
            Kind::WallFile => {
                format!("a file in the study's folder ({WALL_FILES}), as \"walls/left.json\"")
            }
            Kind::Table(section) => format!("a table {}", section.title),
            Kind::Tables(section) => format!("one or more tables {}", section.title),
            Kind::Settings => {
                "a table from paths of keys to values, as \"joint.sampling\" = \"vertices\"".to_owned()
            }
            Kind::Paths => "a list of paths of keys, as \"arm.irregular.least_overlap\"".to_owned(),
        }
    }
}

fn in_unit(unit: &str) -> String {
    if unit == "1" || unit.is_empty() { String::new() } else { format!(" ({unit})") }
}

/// Names in quotes, separated by commas.
pub fn quoted<S: AsRef<str>>(names: &[S]) -> String {
    names.iter().map(|n| format!("\"{}\"", n.as_ref())).collect::<Vec<_>>().join(", ")
}

impl Key {
    /// A key that is used whatever the section's chooser says.
    pub const fn new(name: &'static str, kind: Kind, presence: Presence, doc: &'static str) -> Key {
        Key { name, kind, presence, only: &[], usual: None, angle: None, doc }
    }

    /// The same key, used for some values of the chooser only.
    pub const fn only(self, only: &'static [&'static str]) -> Key {
        Key { only, ..self }
    }

    /// The same key, with a warning outside an interval.
    pub const fn usual(self, usual: Interval) -> Key {
        Key { usual: Some(usual), ..self }
    }

    /// The same key, with a warning where its angle looks like radians.
    pub const fn angle(self, angle: Angle) -> Key {
        Key { angle: Some(angle), ..self }
    }

    /// Whether the key is used when the chooser says `chosen`; everything is when that is not known.
    pub fn applies(&self, chosen: Option<&str>) -> bool {
        self.only.is_empty() || chosen.is_none_or(|c| self.only.contains(&c))
    }
}

impl Kind {
    /// The unit of its numbers; empty where it has none.
    pub fn unit(&self) -> &'static str {
        match self {
            Kind::Real { unit, .. }
            | Kind::Quantity { unit, .. }
            | Kind::Distribution { unit, .. }
            | Kind::Reals { unit, .. } => unit,
            _ => "",
        }
    }

    /// The keys of a table that may stand here.
    pub fn below(&self) -> Option<&'static Section> {
        match self {
            Kind::Table(section) | Kind::Tables(section) | Kind::WholeOr { rule: section, .. } => {
                Some(section)
            }
            _ => None,
        }
    }
}

impl Section {
    /// All keys.
    pub fn all(&self) -> impl Iterator<Item = &'static Key> {
        self.keys.iter().copied().flatten()
    }

    /// The key of that name that is used when the chooser says `chosen`.
    pub fn key(&self, name: &str, chosen: Option<&str>) -> Option<&'static Key> {
        self.all().find(|k| k.name == name && k.applies(chosen))
    }

    /// Names of the keys that are used when the chooser says `chosen`.
    pub fn names(&self, chosen: Option<&str>) -> Vec<&'static str> {
        let mut names: Vec<_> = self.all().filter(|k| k.applies(chosen)).map(|k| k.name).collect();
        names.dedup();
        names
    }
}

/// The candidate closest to a word, when it is close enough to be a slip of the pen, or the only one that the word begins.
pub fn nearest<'a, S: AsRef<str>>(word: &str, candidates: &'a [S]) -> Option<&'a str> {
    let best = candidates.iter().map(|c| (distance(word, c.as_ref()), c.as_ref())).min_by_key(|(d, _)| *d)?;
    if best.0 <= (word.chars().count() / 2).max(2) {
        return Some(best.1);
    }
    let mut begun = candidates.iter().map(AsRef::as_ref).filter(|c| is_begun(word, c));
    begun.next().filter(|_| begun.next().is_none())
}

/// Whether a word is the beginning of another one, of so many letters that it is no accident.
fn is_begun(word: &str, whole: &str) -> bool {
    word.chars().count() >= 3 && whole.to_lowercase().starts_with(&word.to_lowercase())
}

/// Number of single-character edits, a swap of neighbours counting as one (optimal string alignment).
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    let mut rows: Vec<Vec<usize>> = vec![(0..=b.len()).collect()];
    for i in 1..=a.len() {
        let mut row = vec![i];
        for j in 1..=b.len() {
            let change = usize::from(a[i - 1] != b[j - 1]);
            let mut best = (rows[i - 1][j] + 1).min(row[j - 1] + 1).min(rows[i - 1][j - 1] + change);
            if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                best = best.min(rows[i - 2][j - 2] + 1);
            }
            row.push(best);
        }
        rows.push(row);
    }
    rows[a.len()][b.len()]
}

/// How to mend a name that does not exist: the nearest one, or the list.
pub fn suggestion<S: AsRef<str>>(word: &str, candidates: &[S]) -> String {
    match nearest(word, candidates) {
        Some(name) => format!("did you mean \"{name}\"?"),
        None if candidates.is_empty() => "there is none to choose from".to_owned(),
        None => format!("choose from {}", quoted(candidates)),
    }
}
