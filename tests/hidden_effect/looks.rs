//! When a group of campaigns is large enough: it is looked at after a third, two thirds and all of its full size, and stops where the
//! intervals of all that is wanted of it lie on one side of their bounds.
//!
//! Three looks are three chances to err: each interval is taken at 98.3 %, so that all three hold together in 95 % of cases (Bonferroni).

use std::collections::BTreeMap;

use crate::table::Line;
use crate::truth::label::Group;
use crate::wanted;

/// Shares of the full size at which a group is looked at.
pub const LOOKS: [f64; 3] = [1.0 / 3.0, 2.0 / 3.0, 1.0];
/// Level of all intervals.
pub const LEVEL: f64 = 1.0 - 0.05 / LOOKS.len() as f64;

/// Groups that have stopped, with the look that stopped them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Stopped(BTreeMap<Group, usize>);

impl Stopped {
    /// The last look at a group, which other groups are at.
    pub fn look(&self, group: Group, now: usize) -> usize {
        self.0.get(&group).copied().unwrap_or(now)
    }

    /// Stops the groups that are decided by the lines of a look.
    pub fn decide(&mut self, lines: &[Line], now: usize) {
        for group in Group::ALL {
            if wanted::is_decided(lines, group) {
                self.0.entry(group).or_insert(now);
            }
        }
    }

    /// Whether all have.
    pub fn all(&self) -> bool {
        self.0.len() == Group::ALL.len()
    }

    /// In words: the groups that stopped before the last look, with the share of their full size.
    pub fn words(&self) -> String {
        let early = self.0.iter().filter(|(_, look)| **look + 1 < LOOKS.len());
        let early: Vec<String> =
            early.map(|(group, look)| format!("{} after {} of 3", group.name(), look + 1)).collect();
        if early.is_empty() { "none".to_owned() } else { early.join(", ") }
    }
}
