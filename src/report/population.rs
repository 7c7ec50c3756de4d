//! The walls of one arm at one joint stiffness, taken out of the rows.

use std::collections::BTreeMap;

use crate::ensemble::{Mechanism, Observed, Quantity, Row, is_random};
use crate::report::number::significant;
use crate::stats::Sample;
use crate::study::Study;

/// One arm at one kn: what was planned, how it ended, and the values of the walls that stand.
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
    pub values: BTreeMap<u64, f64>,
    /// By member, what the value is known to exceed, of walls that stood to the end of the load path.
    pub above: BTreeMap<u64, f64>,
    /// Number of walls by the name of the mechanism by which they fell.
    pub modes: BTreeMap<String, u64>,
    /// The mechanisms of the walls that fell, by member.
    pub mechanisms: Vec<(u64, Mechanism)>,
    /// Randomisations of a design that its members share in turn; 1 where each is drawn by itself.
    pub randomisations: u64,
}

impl Population {
    /// Collects the rows of one arm at one kn, whatever their order.
    ///
    /// A row that did not end as the quantity needs it is counted by its outcome and brings no value.
    pub fn collect<'a>(
        arm: &str,
        fixed: bool,
        kn: f64,
        planned: u64,
        quantity: Quantity,
        rows: impl Iterator<Item = &'a Row>,
    ) -> Self {
        let mut population = Population {
            arm: arm.into(),
            fixed,
            kn,
            planned,
            outcomes: BTreeMap::new(),
            quantity,
            values: BTreeMap::new(),
            above: BTreeMap::new(),
            modes: BTreeMap::new(),
            mechanisms: Vec::new(),
            randomisations: 1,
        };
        for row in rows {
            *population.outcomes.entry(row.outcome.name().to_string()).or_insert(0) += 1;
            if let Some(mechanism) = &row.mechanism {
                *population.modes.entry(mechanism.mode.name().to_string()).or_insert(0) += 1;
                population.mechanisms.push((row.member, *mechanism));
            }
            let earlier = match quantity.observed(row) {
                Observed::Value(value) => population.values.insert(row.member, value),
                Observed::Above(limit) => population.above.insert(row.member, limit),
                Observed::Nothing => None,
            };
            crate::check!(earlier.is_none(), "member {} of arm {arm} has two rows at kn {kn}", row.member);
        }
        population
    }

    /// The values in the order of the members.
    pub fn ordered(&self) -> Vec<f64> {
        self.values.values().copied().collect()
    }

    /// The values of which moments can be taken: none where some wall stood to the end, as its value is not known.
    pub fn complete(&self) -> Vec<f64> {
        if self.above.is_empty() { self.ordered() } else { Vec::new() }
    }

    /// The values of which moments can be taken, with what their intervals rest on.
    pub fn sample(&self) -> Sample {
        let values = self.values.iter().map(|(member, value)| (*member, *value));
        Sample::of(values.filter(|_| self.above.is_empty()), self.randomisations)
    }

    /// What the values of walls that stood to the end are known to exceed, in the order of the members.
    pub fn limits(&self) -> Vec<f64> {
        self.above.values().copied().collect()
    }

    /// Walls that were planned and say nothing: failed or missing.
    pub fn lost(&self) -> u64 {
        self.planned.saturating_sub((self.values.len() + self.above.len()) as u64)
    }

    /// Says which walls are not in the numbers; `None` when all are.
    pub fn note(&self) -> Option<String> {
        let mut parts = Vec::new();
        if !self.above.is_empty() {
            let least = self.limits().into_iter().fold(f64::INFINITY, f64::min);
            parts.push(format!(
                "{} of {} walls stood to the end of the load path ({} {}): mean, sigma and COV are not defined",
                self.above.len(),
                self.planned,
                significant(self.quantity.shown(least), 3),
                self.quantity.shown_unit()
            ));
        }
        if self.lost() > 0 {
            let used = self.values.len() + self.above.len();
            let reasons = self.reasons().join(", ");
            parts.push(format!("over {used} of {} walls; not in the numbers: {reasons}", self.planned));
        }
        (!parts.is_empty()).then(|| parts.join("; "))
    }

    /// Why walls are not in the numbers, with their counts.
    fn reasons(&self) -> Vec<String> {
        self.failed().iter().map(|(why, count)| format!("{count} {why}")).collect()
    }

    /// Walls that bring no value, by why: the names of their outcomes first.
    pub fn failed(&self) -> Vec<(String, u64)> {
        let wanted = self.quantity.wanted_outcome();
        let stood = if self.above.is_empty() { "" } else { "equilibrium" };
        let mut reasons: Vec<(String, u64)> = self
            .outcomes
            .iter()
            .filter(|(name, _)| *name != wanted && *name != stood)
            .map(|(name, count)| (name.replace('_', " "), *count))
            .collect();
        let rows: u64 = self.outcomes.values().sum();
        if rows < self.planned {
            reasons.push(("without a result".to_owned(), self.planned - rows));
        }
        let ended = self.outcomes.get(wanted).copied().unwrap_or(0);
        if ended > self.values.len() as u64 {
            reasons.push(("without a finite value".to_owned(), ended - self.values.len() as u64));
        }
        reasons
    }
}

/// Every population of a study, arm by arm in the order of the study, kn ascending.
pub fn populations(study: &Study, rows: &[Row]) -> Vec<Population> {
    let quantity = Quantity::of(&study.protocol);
    let mut all = Vec::new();
    for (arm_index, arm) in study.arms.iter().enumerate() {
        for (point, &kn) in arm.kn_points.iter().enumerate() {
            let own =
                rows.iter().filter(|row| row.arm_index as usize == arm_index && row.point as usize == point);
            let fixed = !is_random(arm);
            let own = Population::collect(&arm.name, fixed, kn, arm.members, quantity, own);
            all.push(Population { randomisations: study.randomisations(), ..own });
        }
    }
    all
}
