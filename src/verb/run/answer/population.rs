//! The walls of one arm at one joint stiffness, taken out of the rows.

use std::collections::BTreeMap;

use crate::ensemble::{Mechanism, Observed, Quantity, Row};
use crate::render::number::significant;
use crate::stats::{Sample, Trials};
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::bounded::Bounded;
use crate::verb::run::answer::by_member::ByMember;
use crate::verb::run::answer::undecided::{LeftOpen, OpenSoFar};

/// One arm at one kn: what was planned, how it ended, and the values of its walls. Of a wall it keeps the value, or what its value is
/// known to exceed, and counts all else.
#[derive(Clone, Debug, PartialEq)]
pub struct Population {
    /// Name of the arm.
    pub arm: String,
    /// True when nothing is drawn in this arm, so that its value has no sampling error.
    pub fixed: bool,
    /// Normal stiffness of the joints (Pa/m).
    pub kn: f64,
    /// Walls that the study asks for.
    pub planned: u64,
    /// Number of walls by the name of their outcome.
    pub outcomes: BTreeMap<String, u64>,
    /// What is observed.
    pub quantity: Quantity,
    /// Its value by member, of the walls that bring one.
    pub values: ByMember,
    /// What the value is known to exceed, of walls that stood to the end of the load path, in the order of the members.
    pub above: Vec<f64>,
    /// Walls that bring no value, by why.
    pub without: BTreeMap<String, Without>,
    /// Number of walls by the name of the mechanism by which they fell.
    pub modes: BTreeMap<String, u64>,
    /// How often the walls that fell did so as a published statement says, by its test.
    pub stated: Vec<(ClaimTest, Trials)>,
    /// What limit analysis says of them, where it was asked.
    pub bounded: Bounded,
    /// Randomisations of a design that its members share in turn; 1 where each is drawn by itself.
    pub randomisations: u64,
    /// Walls whose value rigid blocks leave open.
    open: OpenSoFar,
    /// The last member that was taken.
    last: Option<u64>,
}

/// Walls that bring no value for the same reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Without {
    /// How many.
    pub walls: u64,
    /// The member and the words of the first one.
    pub first: (u64, String),
}

impl Population {
    /// One without a wall. How its walls fall is counted for those of the claims that say something of it.
    pub fn new(
        (arm, fixed): (&str, bool),
        (kn, planned): (f64, u64),
        quantity: Quantity,
        randomisations: u64,
        claims: &[Claim],
    ) -> Population {
        let stated = claims.iter().map(|claim| &claim.test);
        let stated = stated.filter(|test| matches!(test, ClaimTest::Mechanism { arm: of, .. } if of == arm));
        Population {
            arm: arm.into(),
            fixed,
            kn,
            planned,
            outcomes: BTreeMap::new(),
            quantity,
            values: ByMember::default(),
            above: Vec::new(),
            without: BTreeMap::new(),
            modes: BTreeMap::new(),
            stated: stated.map(|test| (test.clone(), Trials::none(randomisations))).collect(),
            bounded: Bounded::default(),
            randomisations,
            open: OpenSoFar::default(),
            last: None,
        }
    }

    /// Takes the row of the next member.
    ///
    /// A row that did not end as the quantity needs it is counted by its outcome and brings no value.
    pub fn take(&mut self, row: &Row) {
        crate::check!(
            self.last.is_none_or(|last| last < row.member),
            "member {} of arm {} at kn {} has two rows, or comes too late",
            row.member,
            self.arm,
            self.kn
        );
        self.last = Some(row.member);
        count(&mut self.outcomes, row.outcome.name());
        row.limit.iter().for_each(|limit| self.bounded.take(limit));
        if let Some(mechanism) = &row.mechanism {
            count(&mut self.modes, mechanism.mode.name());
            for (test, trials) in &mut self.stated {
                trials.take(row.member, falls_so(test, mechanism));
            }
        }
        self.open.take(self.quantity, row);
        match self.quantity.observed(row) {
            Observed::Value(value) => self.values.push(row.member, value),
            Observed::Above(limit) => self.above.push(limit),
            Observed::Nothing => {
                let why = match self.quantity.counts(&row.outcome) {
                    true => "without a finite value".to_owned(),
                    false => row.outcome.name().replace('_', " "),
                };
                let first = || Without { walls: 0, first: (row.member, row.outcome.reason()) };
                self.without.entry(why).or_insert_with(first).walls += 1;
            }
        }
    }

    /// The values of which moments can be taken, in the order of the members: none where some wall stood to the end, as its value is
    /// not known.
    pub fn complete(&self) -> &[f64] {
        if self.above.is_empty() { self.values.values() } else { &[] }
    }

    /// The same, with what their intervals rest on.
    pub fn sample(&self) -> Sample<'_> {
        match self.randomisations {
            ..2 => Sample::Independent(self.complete().into()),
            more => Sample::of(self.values.iter().filter(|_| self.above.is_empty()), more),
        }
    }

    /// Walls that were computed and bring no value.
    pub fn lost(&self) -> u64 {
        self.without.values().map(|without| without.walls).sum()
    }

    /// Walls that were planned and have not been computed.
    pub fn missing(&self) -> u64 {
        self.planned.saturating_sub(self.outcomes.values().sum())
    }

    /// Walls whose value rigid blocks leave open; `None` where there are none.
    pub fn left_open(&self) -> Option<LeftOpen> {
        self.open.among(self.complete())
    }

    /// Says which walls are not in the numbers and why, and whose number is an upper end; `None` when there is nothing to say.
    pub fn note(&self) -> Option<String> {
        let mut parts = Vec::new();
        parts.extend(self.left_open().map(|open| open.said(self.quantity, self.planned)));
        if !self.above.is_empty() {
            let least = self.above.iter().copied().fold(f64::INFINITY, f64::min);
            parts.push(format!(
                "{} of {} walls stood to the end of the load path ({} {}): mean, sigma and COV are not defined",
                self.above.len(),
                self.planned,
                significant(self.quantity.shown(least), 3),
                self.quantity.shown_unit()
            ));
        }
        if self.lost() + self.missing() > 0 {
            let used = self.values.len() + self.above.len();
            let reasons = self.reasons().join(", ");
            parts.push(format!("over {used} of {} walls; not in the numbers: {reasons}", self.planned));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// Why walls are not in the numbers, with their counts, and of each reason the words of the first wall.
    fn reasons(&self) -> Vec<String> {
        let of = |(why, Without { walls, first: (member, words) }): (&String, &Without)| match &words[..] {
            "" => format!("{walls} {why}"),
            _ => format!("{walls} {why} (wall {member}: {words})"),
        };
        let missing = match self.missing() {
            0 => None,
            some => Some(format!("{some} not computed")),
        };
        self.without.iter().map(of).chain(missing).collect()
    }

    /// Walls that were computed and bring no value, by why: the names of their outcomes.
    pub fn failed(&self) -> Vec<(String, u64)> {
        self.without.iter().map(|(why, without)| (why.clone(), without.walls)).collect()
    }
}

/// Counts one more of a name.
fn count(counts: &mut BTreeMap<String, u64>, name: &str) {
    match counts.get_mut(name) {
        Some(count) => *count += 1,
        None => drop(counts.insert(name.to_owned(), 1)),
    }
}

/// Whether a wall falls as it is stated of its arm.
fn falls_so(test: &ClaimTest, mechanism: &Mechanism) -> bool {
    let ClaimTest::Mechanism { mode, weight_share, length_share, place, .. } = test else { return false };
    let holds = |x: f64, [low, high]: &[f64; 2]| *low <= x && x <= *high;
    mode.is_none_or(|mode| mechanism.mode == mode)
        && holds(mechanism.weight_share, weight_share)
        && holds(mechanism.length_share, length_share)
        && holds(mechanism.place, place)
}
