//! What `joint_law.json` holds.

use serde::Serialize;

use crate::critic::{Bend, KnownLaw, LawGain, LearntLaw, Nearness};
use crate::math::degrees;
use crate::study::Study;

/// A law that was learnt.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LawSummary {
    /// The study.
    pub study: String,
    /// The families whose specimens it was learnt from.
    pub families: Vec<String>,
    /// Smallest and largest stress (Pa) that presses on their beds.
    pub seen_pa: [f64; 2],
    /// Numbers of the law that the readings know.
    pub resolved: f64,
    /// The exponent of the stress in the stiffness, over the stresses seen.
    pub exponent: KnownLaw,
    /// Probability that the stiffness grows with the stress.
    pub stiffening: f64,
    /// What is said of that.
    pub bend: Bend,
    /// The law.
    pub knots: Vec<LawKnot>,
    /// Laws with a name, the nearest first.
    pub named: Vec<NamedEntry>,
    /// A stress (Pa) beyond those seen.
    pub beyond_pa: f64,
    /// The closures (m) there since the same knot if the stiffness stays, and if it goes on as it has changed.
    pub beyond_closure_m: [f64; 2],
    /// The collapse angle that it predicts of one more wall.
    pub collapse: Vec<LawCollapse>,
    /// What it gains on specimens held out.
    pub gain: Option<LawGain>,
    /// Whether it is taken on.
    pub is_accepted: bool,
    /// The study that has it, below the folder of the diagnosis.
    pub extended: Option<String>,
}

/// A knot.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LawKnot {
    /// Stress (Pa).
    pub stress_pa: f64,
    /// Closure (m) since the first knot at which the beds are pressed.
    pub closure_m: KnownLaw,
    /// Stiffness (Pa/m).
    pub stiffness_pa_per_m: KnownLaw,
}

/// The collapse angle of one more wall of a family (deg); none where too few walls could be solved.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LawCollapse {
    /// The family.
    pub family: String,
    /// The angle: median and 90 % interval.
    pub collapse_deg: Option<KnownLaw>,
}

/// How near a law with a name comes.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedEntry {
    /// Its name.
    pub name: &'static str,
    /// What it loses of what the readings know (nats).
    pub lost_nats: f64,
    /// Its parameters at that.
    pub parameters: Vec<(&'static str, f64)>,
}

impl LawSummary {
    /// Of a law of a study.
    pub fn of(study: &Study, law: &LearntLaw) -> LawSummary {
        let knots = law.stresses.iter().zip(law.closures.iter().zip(&law.stiffness));
        let named = |own: &Nearness| NamedEntry {
            name: own.form.words(),
            lost_nats: own.lost_nats,
            parameters: own.parameters.clone(),
        };
        LawSummary {
            study: study.name.clone(),
            families: law.families.iter().map(|&family| study.arms[family].name.clone()).collect(),
            seen_pa: law.seen,
            resolved: law.resolved,
            exponent: law.exponent,
            stiffening: law.stiffening,
            bend: law.bend,
            knots: knots
                .map(|(stress, (closure, stiffness))| LawKnot {
                    stress_pa: *stress,
                    closure_m: *closure,
                    stiffness_pa_per_m: *stiffness,
                })
                .collect(),
            named: law.named.iter().map(named).collect(),
            beyond_pa: law.beyond.0,
            beyond_closure_m: law.beyond.1,
            collapse: law
                .families
                .iter()
                .zip(&law.collapse)
                .map(|(&family, own)| LawCollapse {
                    family: study.arms[family].name.clone(),
                    collapse_deg: own.map(|own| KnownLaw {
                        median: degrees(own.median),
                        interval: own.interval.map(degrees),
                    }),
                })
                .collect(),
            gain: law.gain.clone(),
            is_accepted: law.is_accepted(),
            extended: None,
        }
    }
}
