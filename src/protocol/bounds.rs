//! Limit analysis beside a load path: what rigid blocks on the same joints can bear, and whether a solver's answer is
//! compatible with that.

use crate::model::{JointLaws, Outcome, Wall};
use crate::protocol::path::Growing;
use crate::protocol::pressure::back_loads;
use crate::protocol::rigid::{Rigid, level};
use crate::protocol::shear::push_on;
use crate::protocol::stage::Stage;
use crate::protocol::{Behind, Contacts, Protocol, Restraint, Retaining, highest};
use crate::solve::limit::{Analysis, Flow, Limit, Loads, Settings};

/// What limit analysis says of a wall under a protocol's loads: a tilt (rad), a factor on the protocol's load, or the push over
/// the vertical load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// With associative flow: an upper bound on what rigid blocks with Coulomb joints bear. `None` where the solver found no
    /// answer or the wall bears any load; see `stands`.
    pub associative: Option<f64>,
    /// The fixed point without dilatancy: neither a bound nor unique. `None` as above.
    pub non_associative: Option<f64>,
    /// Whether the wall stands under its own weight alone; `None` where the solver did not find out.
    pub stands: Option<bool>,
}

/// How a solver's answer and limit analysis go together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Agreement {
    /// The capacity, or the load borne, is not above the associative bound; or neither stands at all.
    WithinBound,
    /// The wall bore more than the associative bound: one of the two is wrong.
    AboveBound,
    /// One of the two says that the wall does not even stand under its own weight.
    OneStands,
    /// One of the two has no answer.
    NoAnswer,
}

impl Agreement {
    /// The name used in tables.
    pub fn name(&self) -> &'static str {
        match self {
            Agreement::WithinBound => "within_bound",
            Agreement::AboveBound => "above_bound",
            Agreement::OneStands => "one_stands",
            Agreement::NoAnswer => "no_answer",
        }
    }
}

impl Bounds {
    /// Asks limit analysis about a wall of stones as [`crate::protocol::run`] would load it. Joints are those of the wall as
    /// built; stiffnesses play no part, and ropes do not stretch. A wall on a base that shakes is tilted towards where that pushes: the
    /// load of the same direction that grows slowly.
    pub fn of(
        wall: &Wall,
        laws: &dyn JointLaws,
        protocol: &Protocol,
        restraint: &Restraint,
        contacts: impl Into<Contacts>,
    ) -> Bounds {
        let contacts = contacts.into();
        let asked = |flow| limit_of(wall, laws, (protocol, restraint, contacts), flow);
        let associative = asked(Flow::Associative);
        let stands = match associative.outcome {
            Outcome::UnstableAtRest => Some(false),
            Outcome::Equilibrium | Outcome::Collapsed { .. } | Outcome::Unbounded => Some(true),
            _ => None,
        };
        let non_associative = (stands == Some(true)).then(|| level(&asked(Flow::NonAssociative))).flatten();
        Bounds { associative: level(&associative), non_associative, stands }
    }

    /// Whether a solver's outcome is compatible with the bound; `borne` is the largest level at which the wall came to rest,
    /// and `tolerance` what its capacity is uncertain by (both in the unit of the bounds).
    pub fn agreement(&self, outcome: &Outcome, borne: Option<f64>, tolerance: f64) -> Agreement {
        let stood = match outcome {
            Outcome::UnstableAtRest => false,
            Outcome::Equilibrium | Outcome::Collapsed { .. } => true,
            _ => return Agreement::NoAnswer,
        };
        match (self.stands, stood) {
            (None, _) => Agreement::NoAnswer,
            (Some(false), false) => Agreement::WithinBound,
            (Some(true), true) => match (self.associative, borne) {
                (Some(bound), Some(borne)) if borne > bound + tolerance => Agreement::AboveBound,
                _ => Agreement::WithinBound,
            },
            _ => Agreement::OneStands,
        }
    }
}

/// Limit analysis of a wall of stones, with one flow, loaded as [`Bounds::of`] says.
pub fn limit_of(
    wall: &Wall,
    laws: &dyn JointLaws,
    (protocol, restraint, contacts): (&Protocol, &Restraint, Contacts),
    flow: Flow,
) -> Limit {
    let mut stage = Stage::new(wall, laws, protocol, restraint, contacts);
    let (growing, loads) = match protocol {
        Protocol::Tilting(_) | Protocol::BaseMotion(_) => (Growing::Tilt(stage.towards), Vec::new()),
        Protocol::Lateral(lateral) => (Growing::Factor, back_loads(wall, lateral)),
        // The jack is the load.
        Protocol::Shear(shear) => {
            let jack = stage.ties.remove(0);
            (Growing::Factor, vec![push_on(&jack, shear.vertical_load)])
        }
        Protocol::Retaining(retaining) => return retained(&stage, retaining, flow),
    };
    let rigid = Rigid {
        wall: &stage.assembly,
        laws: &stage.laws,
        contact: stage.contact,
        ties: &stage.ties,
        loads: &loads,
        growing,
    };
    rigid.ask(Settings { flow, ..Settings::default() }).0
}

/// The height of what is behind a wall that it bears; a wall without a back bears any.
fn retained(stage: &Stage<'_>, retaining: &Retaining, flow: Flow) -> Limit {
    let settings = Settings { flow, ..Settings::default() };
    let analysis =
        Analysis::new(&stage.assembly, &stage.laws, stage.contact, settings).with_ties(&stage.ties);
    match Behind::new(&stage.assembly, stage.towards, &retaining.retained) {
        Ok(behind) => highest(&analysis, &behind, retaining.lifts).limit,
        Err(_) => analysis.multiplier(&Loads::weight()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Level;

    #[test]
    fn each_way_to_disagree_is_named() {
        let bounds = |associative, stands| Bounds { associative, non_associative: None, stands };
        let fell = Outcome::Collapsed { at: Level::Tilt(0.3) };
        let of = |b: Bounds, outcome: &Outcome, borne| b.agreement(outcome, borne, 1e-3);
        let good = bounds(Some(0.3), Some(true));
        assert_eq!(of(good, &fell, Some(0.2)), Agreement::WithinBound);
        assert_eq!(of(good, &fell, Some(0.3005)), Agreement::WithinBound);
        assert_eq!(of(good, &fell, Some(0.302)), Agreement::AboveBound);
        assert_eq!(of(good, &Outcome::Equilibrium, Some(0.302)), Agreement::AboveBound);
        assert_eq!(of(good, &Outcome::UnstableAtRest, None), Agreement::OneStands);
        let stuck = Outcome::NotConverged { at: Level::Tilt(0.1), unbalanced_ratio: 1.0, why: String::new() };
        assert_eq!(of(good, &stuck, Some(0.1)), Agreement::NoAnswer);
        let falls = bounds(None, Some(false));
        assert_eq!(of(falls, &Outcome::UnstableAtRest, None), Agreement::WithinBound);
        assert_eq!(of(falls, &fell, Some(0.2)), Agreement::OneStands);
        assert_eq!(of(bounds(None, None), &fell, Some(0.2)), Agreement::NoAnswer);
        // A wall that limit analysis finds to bear anything bounds nothing.
        assert_eq!(of(bounds(None, Some(true)), &fell, Some(0.2)), Agreement::WithinBound);
    }
}
