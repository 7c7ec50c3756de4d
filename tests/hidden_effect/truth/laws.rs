//! Laws of closure that no catalogue has: joints that are soft and then stiff, the other way round, or soft on both sides of a stiff
//! range.

use pirca::law::{ClosureTable, NormalLaw};
use pirca::study::{Arm, Study};

use super::effect::Effect;

/// A law of this kind.
pub struct Law {
    pub name: &'static str,
    /// Mechanisms of the catalogue that say the same in other words.
    pub aliases: &'static [&'static str],
    /// Whether the joint is stiff below the knee, between it and three times its stress, and above.
    stiff: [bool; 3],
}

/// All of them.
pub const LAWS: [Law; 3] = [
    Law { name: "bilinear", aliases: &["joint_closure", "stress_stiffening"], stiff: [false, true, true] },
    Law { name: "stiff_then_soft", aliases: &[], stiff: [true, false, false] },
    Law { name: "s_shaped", aliases: &[], stiff: [false, true, false] },
];

/// What is drawn of a law: its softer stiffness over its stiffer one, uniform between two values; its knee (Pa), log-uniform between
/// two stresses that beds of these walls come to.
pub const SOFT_SHARE: [f64; 2] = [0.15, 0.5];
pub const KNEE_PA: [f64; 2] = [3e3, 1.2e4];
/// The second knee over the first.
const SECOND: f64 = 3.0;
/// Knots over the knee.
const KNOTS: [f64; 8] = [0.5, 0.9, 1.2, 1.8, 2.7, 3.5, 5.0, 8.0];

impl Law {
    /// The law of joints whose stiffness (Pa/m) is this one in the geometric mean of the softer and the stiffer.
    fn through(&self, middle: f64, soft_share: f64, knee: f64) -> [Vec<f64>; 2] {
        let stiffness = self.stiff.map(|stiff| {
            let root = soft_share.sqrt();
            if stiff { middle / root } else { middle * root }
        });
        let ends = [knee, SECOND * knee, f64::INFINITY];
        let closure = |stress: f64| {
            let (mut from, mut closed) = (0.0, 0.0);
            for (end, stiffness) in ends.iter().zip(stiffness) {
                closed += (stress.min(*end) - from).max(0.0) / stiffness;
                from = *end;
            }
            closed
        };
        let stresses: Vec<f64> = KNOTS.iter().map(|over| over * knee).collect();
        [stresses.iter().map(|stress| closure(*stress)).collect(), stresses]
    }

    /// The arm with joints that follow it.
    pub fn on(&self, arm: &Arm, soft_share: f64, knee: f64) -> Arm {
        let [closures, stresses] = self.through(arm.kn_points[arm.middle_point()], soft_share, knee);
        arm.clone().closing_along(&closures, &stresses).expect("both ascend")
    }

    /// It, as the joints of an arm have it.
    pub fn of(&self, arm: &Arm, soft_share: f64, knee: f64) -> NormalLaw {
        let [closures, stresses] = self.through(arm.kn_points[arm.middle_point()], soft_share, knee);
        NormalLaw::Table(ClosureTable::through(&closures, &stresses).expect("both ascend"))
    }
}

/// A law as something hidden.
pub struct Hidden {
    pub law: &'static Law,
    pub soft_share: f64,
    pub knee: f64,
}

impl Effect for Hidden {
    fn study(&self, mut study: Study) -> Study {
        for arm in &mut study.arms {
            *arm = self.law.on(arm, self.soft_share, self.knee);
        }
        study
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::truth::roster::root;

    #[test]
    fn joints_are_soft_and_stiff_where_a_law_says_so() {
        let study = Study::load(&root("studies/hidden-effects/example"), None)
            .unwrap_or_else(|faults| panic!("{faults}"))
            .study;
        let (share, knee) = (0.25, 4e3);
        for law in &LAWS {
            let own = law.of(&study.arms[0], share, knee);
            // Around each stress, within its range.
            let stiffness =
                |stress: f64| 0.2 * stress / (own.closure(1.1 * stress) - own.closure(0.9 * stress));
            for (stress, stiff) in [1.2e3, 8e3, 2.5e4].into_iter().zip(law.stiff) {
                let middle = study.arms[0].kn_points[0];
                let expected = if stiff { 2.0 * middle } else { 0.5 * middle };
                let apart = stiffness(stress) / expected;
                assert!((0.75..1.33).contains(&apart), "{} at {stress} Pa: {apart}", law.name);
            }
        }
    }
}
