//! Which walls a bank holds: for every cause, points in the priors of its parameters and of the joints.

use std::collections::{BTreeMap, BTreeSet};

use crate::critic::simulate::bank::test::stand_in;
use crate::ensemble::{Row, Task, evaluate};
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::study::{Acts, Described, Faults, Nuisance, Parameter, Study};

/// So many times as many points without any cause: all others are compared with them.
pub(super) const BASE: u64 = 2;

/// Steps of a wall that is sheared: its push grows in proportion over the first of them, and Newton's method fails in each that a
/// slipping wall takes.
const STEPS: u32 = 40;

/// Priors of the joints are widened by this factor: a prior that is off by two of its standard deviations is no effect to be
/// found.
pub const PRIOR_WIDENING: f64 = 1.5;

/// A wall of a bank: which family, which cause, where in the priors.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Index of the arm in the base study; where its walls [stand](super::stand_in) for those of others, of the first.
    pub family: usize,
    /// Index of the mechanism; none for the base model.
    pub cause: Option<usize>,
    /// Number of the point. The same point has the same stones and joints' scores under every cause.
    pub point: u64,
    /// Where the factors on the joints lie in their priors (standard normal scores), in the order of
    /// [`NUISANCES`](crate::study::NUISANCES); [`PRIOR_WIDENING`] times as far out as the priors say.
    pub joints: [f64; 3],
    /// The parameters of the cause, in its order, as quantiles of their priors.
    pub parameters: Vec<f64>,
}

/// A bank that has not been computed yet: an ordinary study, an arm for each wall.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The study; one wall per arm.
    pub study: Study,
    /// What stands for which arm, in its order.
    pub places: Vec<Place>,
}

impl Plan {
    /// For the families of a study that were measured; `points` for each mechanism that acts on walls, twice as many for the base
    /// model. What acts on readings alone needs no walls of its own. More points later leave the first ones as they are.
    ///
    /// # Errors
    /// The faults of parameters that their priors allow and their keys do not.
    pub fn new(
        study: &Study,
        mechanisms: &[Described],
        nuisances: &[Nuisance; 3],
        points: u64,
    ) -> Result<Plan, Faults> {
        Plan::of_families(study, &study.measured_arms(), mechanisms, nuisances, points)
    }

    /// The same for any families (their arms' indices, ascending). Walls of a family are the same whichever others there are.
    ///
    /// # Errors
    /// As of [`Plan::new`].
    pub fn of_families(
        study: &Study,
        families: &[usize],
        mechanisms: &[Described],
        nuisances: &[Nuisance; 3],
        points: u64,
    ) -> Result<Plan, Faults> {
        let base = study.clone().without_limit_analysis().with_remainders().with_steps_at_most(STEPS);
        let base = base.seeking_what_was_measured();
        let built: BTreeSet<usize> = families.iter().map(|&family| stand_in(study, family)).collect();
        let (mut arms, mut places) = (Vec::new(), Vec::new());
        for point in 0..BASE * points {
            let streams = Streams::new(study.seed, point);
            let acting = mechanisms.iter().enumerate().filter(|(_, m)| m.acts != Acts::Readings);
            let causes = std::iter::once(None).chain(acting.filter(|_| point < points).map(Some));
            for cause in causes {
                let mut quantiles = Vec::new();
                let (mut on, mut idle) = (None, BTreeMap::new());
                if let Some((_, mechanism)) = cause {
                    let quantile =
                        |p: &Parameter| streams.of(&format!("bank {}.{}", mechanism.name, p.key)).uniform();
                    quantiles = mechanism.parameters.iter().map(quantile).collect();
                    let at = mechanism.parameters.iter().zip(&quantiles);
                    let values: Vec<_> = at.map(|(p, &u)| (p.key, p.search.quantile(u))).collect();
                    let switched = base.with_mechanism(mechanism.name, &values)?;
                    (on, idle) = (Some(switched.study), switched.idle);
                }
                for &family in &built {
                    let arm = &on.as_ref().unwrap_or(&base).arms[family];
                    if idle.contains_key(&arm.name) {
                        continue;
                    }
                    let joints = [0, 1, 2].map(|k| {
                        let mut stream = streams.of(&format!("bank {} {}", arm.name, nuisances[k].name));
                        PRIOR_WIDENING * quantile(stream.uniform())
                    });
                    let factors = [0, 1, 2].map(|k| nuisances[k].prior.at_score(joints[k]));
                    let kn = arm.kn_points[arm.middle_point()];
                    let mut one = arm.with_joints(kn, factors);
                    one.members = 1;
                    one.name = format!("{}/{}/{point}", arm.name, cause.map_or("base", |(_, m)| m.name));
                    arms.push(one);
                    let (cause, parameters) = (cause.map(|(index, _)| index), quantiles.clone());
                    places.push(Place { family, cause, point, joints, parameters });
                }
            }
        }
        let priors =
            nuisances.iter().map(|n| (format!("bank.nuisance.{}", n.name), format!("{:?}", n.prior)));
        // Causes that have no walls here are no part of the design: a bank outlives those that act under other loads.
        let built_with: BTreeSet<usize> = places.iter().filter_map(|place| place.cause).collect();
        let parameters = built_with.iter().map(|&cause| &mechanisms[cause]).flat_map(|m| {
            m.parameters
                .iter()
                .map(|p| (format!("bank.mechanism.{}.{}", m.name, p.key), format!("{:?}", p.search)))
        });
        let mut decided: BTreeMap<String, String> = priors.chain(parameters).collect();
        decided.insert("bank.points".to_owned(), points.to_string());
        // The key is part of the hash of every bank that is kept.
        decided.insert("bank.doubt".to_owned(), PRIOR_WIDENING.to_string());
        let named: Vec<&str> = built.iter().map(|&family| study.arms[family].name.as_str()).collect();
        decided.insert("bank.families".to_owned(), named.join(", "));
        let name = format!("{}-bank", study.name);
        Ok(Plan { study: base.of_arms(name, arms, decided), places })
    }

    /// The wall of a task: the member of the point, so that points differ in their stones as well.
    pub fn evaluate(&self, task: Task) -> Row {
        let member = self.places[task.arm as usize].point;
        Row { member: task.member, ..evaluate(&self.study, Task { member, ..task }) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::simulate::bank::tests::shipped;

    fn planned(points: u64) -> (Study, Vec<Described>, Plan) {
        let (study, mechanisms, nuisances) = shipped();
        let plan = Plan::new(&study, &mechanisms, &nuisances, points).unwrap_or_else(|f| panic!("{f}"));
        (study, mechanisms, plan)
    }

    #[test]
    fn every_cause_has_its_points_where_it_can_act_and_the_base_model_twice_as_many() {
        let (study, mechanisms, plan) = planned(3);
        assert_eq!(plan.study.arms.len(), plan.places.len());
        let count = |cause: Option<&str>, family: &str| {
            let of = |place: &&Place| {
                place.cause.map(|index| mechanisms[index].name) == cause
                    && study.arms[place.family].name == family
            };
            plan.places.iter().filter(of).count()
        };
        for family in ["cbl", "sbl", "sbr"] {
            assert_eq!(count(None, family), 6);
            assert_eq!(count(Some("joint_closure"), family), 3);
            // The base model's walls with another gauge: no walls of their own.
            assert_eq!(count(Some("gauge_offset"), family), 0);
        }
        assert_eq!((count(Some("rope_slack"), "sbl"), count(Some("rope_slack"), "sbr")), (0, 3));
        // Families that were not measured are not in it.
        assert!(plan.places.iter().all(|place| place.family < 3));
    }

    #[test]
    fn more_points_leave_the_first_ones_as_they_are() {
        let ((.., few), (.., more)) = (planned(2), planned(3));
        for (arm, place) in few.study.arms.iter().zip(&few.places) {
            let at = more.places.iter().position(|other| other == place).expect("it is still there");
            assert_eq!(&more.study.arms[at], arm);
        }
        assert_ne!(few.study.hash, more.study.hash);
    }

    #[test]
    fn joints_are_drawn_as_widely_as_diagnoses_take_them() {
        let (.., plan) = planned(40);
        let base = plan.places.iter().filter(|place| place.cause.is_none());
        let scores: Vec<f64> = base.flat_map(|place| place.joints).collect();
        let sigma = crate::stats::sigma(&scores).expect("many");
        // 720 scores tell a standard deviation to 2.6 %.
        assert!(
            scores.len() == 720 && (sigma / PRIOR_WIDENING - 1.0).abs() < 0.08,
            "{} {sigma}",
            scores.len()
        );
    }

    #[test]
    fn other_families_make_another_design() {
        let (study, mechanisms, plan) = planned(2);
        let nuisances = shipped().2;
        let mut fewer = study;
        fewer.measured.retain(|m| m.family != "cbl");
        let other = Plan::new(&fewer, &mechanisms, &nuisances, 2).unwrap_or_else(|f| panic!("{f}"));
        assert!(other.places.len() < plan.places.len());
        assert_ne!(other.study.hash, plan.study.hash);
    }

    #[test]
    fn a_point_has_the_same_joints_under_every_cause_and_other_stones_than_the_next() {
        let (study, _, plan) = planned(2);
        let sbl = study.arms.iter().position(|arm| arm.name == "sbl").expect("a family");
        let at = |point: u64| plan.places.iter().filter(move |p| p.family == sbl && p.point == point);
        let first: Vec<[f64; 3]> = at(0).map(|place| place.joints).collect();
        assert!(first.len() > 10 && first.iter().all(|joints| *joints == first[0]));
        assert!(at(1).all(|place| place.joints != first[0]));
        // kn, phi and kn/ks of the base model's first point are the study's by the factors of the quantiles.
        let index =
            plan.places.iter().position(|p| p.family == sbl && p.cause.is_none()).expect("it is there");
        let (arm, of) = (&plan.study.arms[index], &study.arms[sbl]);
        let priors = shipped().2;
        let factor = |k: usize| priors[k].prior.at_score(plan.places[index].joints[k]);
        assert_eq!(arm.kn_points, [of.kn_points[0] * factor(0)]);
        assert!((arm.joint.phi_deg.mean() / (of.joint.phi_deg.mean() * factor(1)) - 1.0).abs() < 1e-12);
        assert_eq!(arm.joint.kn_over_ks, of.joint.kn_over_ks * factor(2));
        // Walls of two points are of different stones, those of one point under two causes of the same.
        let stones = |task: usize| {
            let row = plan.evaluate(Task { arm: task as u32, point: 0, member: 0 });
            assert_eq!(row.member, 0);
            (row.built.stones, row.built.length_mean_m, row.built.dip_sd_deg)
        };
        let place = |point: u64, cause: Option<usize>| {
            plan.places
                .iter()
                .position(|p| p.family == sbl && p.point == point && p.cause == cause)
                .expect("there")
        };
        let density = plan.places.iter().find(|p| p.parameters.len() == 1).and_then(|p| p.cause);
        assert_ne!(stones(place(0, None)), stones(place(1, None)));
        assert_eq!(stones(place(0, None)), stones(place(0, density)));
    }
}
