//! A mechanism switched on in a checked study, at a strength that its priors state.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::protocol::Protocol;
use crate::study::cause::{Described, MECHANISM, Mechanisms};
use crate::study::checked::{Arm, Study};
use crate::study::fault::{Faults, Source};
use crate::study::raw;
use crate::study::reader::{Notes, Reader};

/// A study with a mechanism switched on.
#[derive(Clone, Debug, PartialEq)]
pub struct Switched {
    /// The study: the mechanism is on in every arm that it can act on.
    pub study: Study,
    /// The arms that it cannot act on, with the reason; they are as they were.
    pub idle: BTreeMap<String, &'static str>,
}

impl Study {
    /// The same study without limit analysis beside the solver.
    pub fn without_limit_analysis(mut self) -> Study {
        self.agreement = false;
        self.stating([("solver.agreement", "false".to_owned())])
    }

    /// The same study of a tilting table whose platform is let back to the level from every stop; of a service load as it was.
    pub fn with_remainders(mut self) -> Study {
        let Protocol::Tilting(tilting) = &mut self.protocol else { return self };
        tilting.remainders = true;
        self.stating([("load.remainders", "true".to_owned())])
    }

    /// The same study of walls that are sheared, in so many steps up to the widest drift or fewer; of others as it was.
    pub fn with_steps_at_most(mut self, count: u32) -> Study {
        let Protocol::Shear(shear) = &mut self.protocol else { return self };
        shear.step = shear.step.max(shear.history.widest() / f64::from(count));
        let step = (100.0 * shear.step).to_string();
        self.stating([("load.step_percent", step)])
    }

    /// Whether its platform is let back to the level from every stop.
    pub fn goes_back(&self) -> bool {
        matches!(&self.protocol, Protocol::Tilting(tilting) if tilting.remainders)
    }

    /// The same study with a mechanism on, its parameters by key and in the key's unit. An arm that the mechanism cannot act on,
    /// or that has it already, stays as it is, as all do where the solver refuses it.
    ///
    /// # Errors
    /// The faults of the parameters.
    pub fn with_mechanism(&self, name: &str, values: &[(&str, f64)]) -> Result<Switched, Faults> {
        let mut text = format!("[{name}]\n");
        for (key, value) in values {
            text.push_str(&format!("{key} = {value:?}\n"));
        }
        let mut notes = Notes::default();
        let source = Arc::new(Source { name: "mechanism asked for".to_owned(), rank: 0, text });
        let node = raw::parse(&source).map_err(|fault| Faults::sorted(vec![*fault]))?;
        let read = Reader::open(&node, "mechanism", &MECHANISM, &mut notes)
            .and_then(|mut t| Mechanisms::read(&mut t));
        let Some(own) = read.filter(|_| notes.faults.is_empty()) else {
            return Err(Faults::sorted(notes.faults));
        };
        let refused = own.demands().find_map(|(demand, _)| self.solver.refuses(demand));
        let (mut study, mut values, mut idle) = (self.clone(), Vec::new(), BTreeMap::new());
        for arm in &mut study.arms {
            if self.arms_with(name).contains(&arm.name.as_str()) {
                idle.insert(arm.name.clone(), "the study has it on already");
                continue;
            }
            match own.idle_in(arm, &self.protocol).or(refused) {
                Some(why) => {
                    idle.insert(arm.name.clone(), why);
                }
                None => {
                    *arm = arm.acted_on_by(&own);
                    let recorded = notes.effective.iter();
                    values.extend(
                        recorded.map(|(key, value)| (format!("arm.{}.{key}", arm.name), value.clone())),
                    );
                }
            }
        }
        Ok(Switched { study: study.stating(values), idle })
    }

    /// Why a mechanism can act on none of these arms (by index); `None` where it can on some.
    ///
    /// # Errors
    /// The faults of parameters in the middle of their priors.
    pub fn cannot_act(&self, mechanism: &Described, arms: &[usize]) -> Result<Option<&'static str>, Faults> {
        let idle = self.with_mechanism(mechanism.name, &mechanism.at_strength(0.5))?.idle;
        let reasons: Option<Vec<&'static str>> =
            arms.iter().map(|arm| idle.get(&self.arms[*arm].name).copied()).collect();
        Ok(reasons.and_then(|reasons| reasons.first().copied()))
    }
}

impl Arm {
    /// The arm with these mechanisms beside those that it has; none of them may be among the arm's own.
    fn acted_on_by(&self, own: &Mechanisms) -> Arm {
        Arm {
            layout: own.layout(self.layout.clone()),
            restraint: own.restraint(self.restraint),
            mechanisms: own.beside(&self.mechanisms),
            ..self.clone()
        }
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::protocol::Compliance;
    use crate::study::described;

    fn shipped(name: &str) -> Study {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("studies").join(name);
        Study::load(&folder, None).unwrap_or_else(|faults| panic!("{faults}")).study
    }

    #[test]
    fn what_cannot_act_on_a_sheared_wall_is_named_with_its_reason() {
        let study = shipped("dry-shear-walls");
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let idle = all.iter().filter_map(|mechanism| {
            let why = study.cannot_act(mechanism, &[0, 2]).unwrap_or_else(|faults| panic!("{faults}"));
            Some((mechanism.name, why?))
        });
        let idle: BTreeMap<&str, &str> = idle.collect();
        assert_eq!(
            idle.keys().copied().collect::<Vec<_>>(),
            [
                "base_compliance",
                "creep",
                "gauge_offset",
                "gauge_scale",
                "heading",
                "lean",
                "motion_scale",
                "restitution",
                "rope_slack",
                "size_scatter",
                "wedge_loss",
                "worn_bearing"
            ]
        );
        assert_eq!(idle["gauge_scale"], "no displacement out of plane is read");
        let tilted = shipped("tilting-table");
        let ropes = all.iter().find(|mechanism| mechanism.name == "rope_slack").expect("in the catalogue");
        // One of its arms has ropes.
        let why = |arms: &[usize]| tilted.cannot_act(ropes, arms).unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!((why(&[0]), why(&[0, 2])), (Some("there are no ropes"), None));
    }

    #[test]
    fn each_mechanism_changes_the_hash_and_the_arms_that_it_acts_on() {
        let study = shipped("tilting-table");
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        // The base of these walls does not move.
        let of_motions = ["worn_bearing", "heading", "motion_scale", "restitution"];
        for mechanism in all.iter().filter(|mechanism| !of_motions.contains(&mechanism.name)) {
            let values = mechanism.at_strength(0.84);
            let on =
                study.with_mechanism(mechanism.name, &values).unwrap_or_else(|faults| panic!("{faults}"));
            assert_ne!(on.study.hash, study.hash, "{}", mechanism.name);
            for (arm, before) in on.study.arms.iter().zip(&study.arms) {
                assert_eq!(arm == before, on.idle.contains_key(&arm.name), "{} {}", mechanism.name, arm.name);
            }
            let idle: Vec<&str> = on.idle.keys().map(String::as_str).collect();
            let expected: &[&str] = match mechanism.name {
                "rope_slack" => &["cbl", "sbl"],
                "wedge_loss" | "size_scatter" => &["cbl"],
                _ => &[],
            };
            assert_eq!(idle, expected, "{}", mechanism.name);
            // On top of itself it changes nothing.
            let again = on.study.with_mechanism(mechanism.name, &values).unwrap_or_else(|f| panic!("{f}"));
            assert_eq!(again.study.hash, on.study.hash, "{}", mechanism.name);
        }
    }

    #[test]
    fn mechanisms_that_are_switched_on_one_after_the_other_go_together() {
        let study = shipped("tilting-table");
        let both = [("base_compliance", [("settlement_n_per_m", 1e6), ("rotation_n_m_per_rad", 1e4)])];
        let mut on = study.clone();
        for (name, values) in &both {
            on = on.with_mechanism(name, values).unwrap_or_else(|faults| panic!("{faults}")).study;
        }
        on = on
            .with_mechanism("density", &[("factor", 1.5)])
            .unwrap_or_else(|faults| panic!("{faults}"))
            .study;
        for (arm, before) in on.arms.iter().zip(&study.arms) {
            assert_eq!(arm.restraint.base.compliance, Some(Compliance { settlement: 1e6, rotation: 1e4 }));
            assert!(arm.mechanisms.has("base_compliance"));
            assert_eq!(arm.mechanisms.value("density", "factor"), Some(1.5));
            assert_eq!(arm.layout.density, before.layout.density.clone().scaled(1.5));
        }
    }

    #[test]
    fn a_parameter_that_is_out_of_range_is_a_fault() {
        let faults = shipped("tilting-table").with_mechanism("density", &[("factor", -1.0)]).unwrap_err();
        assert!(faults.to_string().contains("density.factor"), "{faults}");
    }
}
