//! The walls of one arm at one joint stiffness, taken out of the rows.

use std::collections::BTreeMap;

use crate::ensemble::Row;
use crate::model::Outcome;
use crate::study::{Arm, Study};

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
    /// Displacement at the wall's top (m) by member, of the walls in equilibrium.
    pub values: BTreeMap<u64, f64>,
}

impl Population {
    /// Collects the rows of one arm at one kn, whatever their order.
    ///
    /// A row that is not in equilibrium is counted by its outcome and brings no value.
    pub fn collect<'a>(
        arm: &str,
        fixed: bool,
        kn: f64,
        planned: u64,
        rows: impl Iterator<Item = &'a Row>,
    ) -> Self {
        let mut population = Population {
            arm: arm.into(),
            fixed,
            kn,
            planned,
            outcomes: BTreeMap::new(),
            values: BTreeMap::new(),
        };
        for row in rows {
            *population.outcomes.entry(row.outcome.name().to_string()).or_insert(0) += 1;
            if row.outcome != Outcome::Equilibrium {
                continue;
            }
            if let Some(value) = row.top_displacement_m.filter(|value| value.is_finite()) {
                let earlier = population.values.insert(row.member, value);
                crate::check!(
                    earlier.is_none(),
                    "member {} of arm {arm} has two rows at kn {kn}",
                    row.member
                );
            }
        }
        population
    }

    /// The values in the order of the members.
    pub fn ordered(&self) -> Vec<f64> {
        self.values.values().copied().collect()
    }

    /// Walls that were planned and bring no value: failed or missing.
    pub fn lost(&self) -> u64 {
        self.planned.saturating_sub(self.values.len() as u64)
    }

    /// Says which walls are not in the mean; `None` when all are.
    pub fn note(&self) -> Option<String> {
        if self.lost() == 0 {
            return None;
        }
        let mut reasons: Vec<String> = self
            .outcomes
            .iter()
            .filter(|(name, _)| *name != Outcome::Equilibrium.name())
            .map(|(name, count)| format!("{count} {}", name.replace('_', " ")))
            .collect();
        let rows: u64 = self.outcomes.values().sum();
        if rows < self.planned {
            reasons.push(format!("{} without a result", self.planned - rows));
        }
        let standing = self.outcomes.get(Outcome::Equilibrium.name()).copied().unwrap_or(0);
        if standing > self.values.len() as u64 {
            reasons.push(format!("{} without a finite displacement", standing - self.values.len() as u64));
        }
        Some(format!(
            "over {} of {} walls; not in the numbers: {}",
            self.values.len(),
            self.planned,
            reasons.join(", ")
        ))
    }
}

/// Every population of a study, arm by arm in the order of the study, kn ascending.
pub fn populations(study: &Study, rows: &[Row]) -> Vec<Population> {
    let mut all = Vec::with_capacity(study.arms.len() * study.kn_points.len());
    for (arm_index, arm) in study.arms.iter().enumerate() {
        for (point, &kn) in study.kn_points.iter().enumerate() {
            let own =
                rows.iter().filter(|row| row.arm_index as usize == arm_index && row.point as usize == point);
            all.push(Population::collect(&arm.name, nothing_drawn(study, arm), kn, arm.members, own));
        }
    }
    all
}

/// True when neither the stones nor the joints of an arm are random.
fn nothing_drawn(study: &Study, arm: &Arm) -> bool {
    let joint = &study.joint;
    arm.layout.is_fixed()
        && [&joint.kn_factor, &joint.phi_deg, &joint.cohesion].iter().all(|family| family.sd() == 0.0)
}
