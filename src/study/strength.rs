//! A mechanism switched on in a checked study, at a strength that its priors state.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::generate::{Arrangement, Layout};
use crate::law::Sampling;
use crate::protocol::{Ends, Protocol};
use crate::study::checked::{Arm, StatedLaw, Study};
use crate::study::fault::{Faults, Source};
use crate::study::inventory::Described;
use crate::study::keys;
use crate::study::mechanism::Mechanisms;
use crate::study::raw;
use crate::study::reader::{Notes, Reader};

/// Parameters whose mechanism is the stronger, the smaller they are; of every other it is the stronger, the larger they are.
/// Factors that go either way count as stronger where they weaken the wall.
const STRONGER_BELOW: [(&str, &str); 13] = [
    ("joint_closure", "initial_pa_per_m"),
    ("stress_stiffening", "at_1_mpa_pa_per_m"),
    ("stress_stiffening", "floor_pa_per_m"),
    ("contact_area", "share"),
    ("friction", "factor"),
    ("friction", "residual_share"),
    ("friction", "slip_distance_m"),
    ("base_compliance", "settlement_n_per_m"),
    ("base_compliance", "rotation_n_m_per_rad"),
    ("wedge_loss", "beyond_deg"),
    ("end_release", "friction_share"),
    ("end_release", "stiffness_share"),
    ("platform_friction", "phi_deg"),
];

/// Parameters that have no effect somewhere between the ends of their priors.
const EITHER_WAY: [(&str, &str); 6] = [
    ("friction", "factor"),
    ("lean", "angle_deg"),
    ("size_scatter", "factor"),
    ("density", "factor"),
    ("gauge_offset", "offset_m"),
    ("gauge_scale", "factor"),
];

/// Mechanisms that say the same of a joint, each in its own way: one of them at most can be on.
const ONE_OF: [&str; 2] = ["joint_closure", "stress_stiffening"];

/// Where a mechanism is the stronger.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stronger {
    /// At large values of a parameter.
    Above,
    /// At small ones.
    Below,
    /// At both, as it has no effect in between.
    EitherWay,
}

/// A study with a mechanism switched on.
#[derive(Clone, Debug, PartialEq)]
pub struct Switched {
    /// The study: the mechanism is on in every arm that it can act on.
    pub study: Study,
    /// The arms that it cannot act on, with the reason; they are as they were.
    pub idle: BTreeMap<String, &'static str>,
}

impl Described {
    /// Where it is the stronger, over a parameter.
    pub fn stronger(&self, key: &str) -> Stronger {
        let own = (self.name, key);
        match (EITHER_WAY.contains(&own), STRONGER_BELOW.contains(&own)) {
            (true, _) => Stronger::EitherWay,
            (false, true) => Stronger::Below,
            (false, false) => Stronger::Above,
        }
    }

    /// Whether it and another one can be on together.
    pub fn goes_with(&self, other: &str) -> bool {
        self.name != other && !(ONE_OF.contains(&self.name) && ONE_OF.contains(&other))
    }

    /// Its parameters at one strength, by key and in the key's unit: each at that quantile of its prior, counted from the end
    /// at which the mechanism is weak. Several parameters go together: their mechanism is rarer than one of them.
    pub fn at_strength(&self, quantile: f64) -> Vec<(&'static str, f64)> {
        let value = |p: &crate::study::Parameter| {
            let falls = STRONGER_BELOW.contains(&(self.name, p.key));
            p.prior.quantile(if falls { 1.0 - quantile } else { quantile })
        };
        self.parameters.iter().map(|p| (p.key, value(p))).collect()
    }
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
    /// or that has it already, stays as it is.
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
        let read = Reader::open(&node, "mechanism", &keys::MECHANISM, &mut notes)
            .and_then(|mut t| Mechanisms::read(&mut t));
        let Some(own) = read.filter(|_| notes.faults.is_empty()) else {
            return Err(Faults::sorted(notes.faults));
        };
        let (mut study, mut values, mut idle) = (self.clone(), Vec::new(), BTreeMap::new());
        for arm in &mut study.arms {
            if self.arms_with(name).contains(&arm.name.as_str()) {
                idle.insert(arm.name.clone(), "the study has it on already");
                continue;
            }
            match own.idle_in(arm, &self.protocol) {
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

impl Mechanisms {
    /// These and others together; where both have one, these.
    fn beside(&self, other: &Mechanisms) -> Mechanisms {
        Mechanisms {
            contact_inset: self.contact_inset.or(other.contact_inset),
            joint_closure: self.joint_closure.or(other.joint_closure),
            stress_stiffening: self.stress_stiffening.or(other.stress_stiffening),
            contact_area: self.contact_area.or(other.contact_area),
            friction: self.friction.or(other.friction),
            cohesion: self.cohesion.or(other.cohesion),
            lean: self.lean.or(other.lean),
            base_compliance: self.base_compliance.or(other.base_compliance),
            wedge_loss: self.wedge_loss.or(other.wedge_loss),
            rope_slack: self.rope_slack.or(other.rope_slack),
            size_scatter: self.size_scatter.or(other.size_scatter),
            density: self.density.or(other.density),
            gauge_offset: self.gauge_offset.or(other.gauge_offset),
            gauge_scale: self.gauge_scale.or(other.gauge_scale),
            creep: self.creep.or(other.creep),
            specimen_scatter: self.specimen_scatter.or(other.specimen_scatter),
            end_release: self.end_release.or(other.end_release),
            platform_friction: self.platform_friction.or(other.platform_friction),
        }
    }

    /// Why these cannot act on an arm under a load; `None` where they can.
    fn idle_in(&self, arm: &Arm, protocol: &Protocol) -> Option<&'static str> {
        let tilts = matches!(protocol, Protocol::Tilting(_));
        let shears = matches!(protocol, Protocol::Shear(_));
        let roped = matches!(arm.restraint.ends, Ends::Ropes(_));
        let wedges = arm.layout.wedges.as_ref().is_some_and(|wedges| wedges.share > 0.0);
        let reasons = [
            (self.rope_slack.is_some() && !roped, "there are no ropes"),
            (self.wedge_loss.is_some() && !wedges, "there are no wedges"),
            ((self.wedge_loss.is_some() || self.creep.is_some()) && !tilts, "the platform does not tilt"),
            (
                shears && (self.gauge_scale.is_some() || self.gauge_offset.is_some()),
                "no displacement out of plane is read",
            ),
            (shears && self.lean.is_some(), "the beam on the wall is guided in its plane"),
            (
                shears && self.base_compliance.is_some(),
                "the platform settles and turns out of plane, and the push is in plane",
            ),
            (self.size_scatter.is_some() && !arm.layout.draws_sizes(), "the stones' sizes are not drawn"),
            (
                self.size_scatter.is_some_and(|factor| !stays_above_0(&arm.layout, factor)),
                "sizes that scatter so much would be below 0",
            ),
            (
                self.joint_closure.and(arm.mechanisms.stress_stiffening).is_some()
                    || self.stress_stiffening.and(arm.mechanisms.joint_closure).is_some(),
                "its joints close along another law",
            ),
            (
                matches!(arm.joint.normal_law, StatedLaw::Table(_))
                    && (self.joint_closure.is_some() || self.stress_stiffening.is_some()),
                "its joints close along a table",
            ),
            (
                self.contact_area.is_some() && arm.joint.sampling == Sampling::Vertices,
                "joints are sampled at their corners",
            ),
        ];
        reasons.into_iter().find(|(holds, _)| *holds).map(|(_, why)| why)
    }
}

/// Whether stones whose sizes deviate so many times as much still have sizes above 0.
fn stays_above_0(layout: &Layout, factor: f64) -> bool {
    match layout.clone().widened(factor).arrangement {
        Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. } => {
            sizes.least().iter().all(|least| *least >= 0.0)
        }
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::study::{INVENTORY, described};

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
                "lean",
                "rope_slack",
                "size_scatter",
                "wedge_loss"
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
        for mechanism in &all {
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
            assert_eq!(arm.restraint.base.compliance, arm.mechanisms.base_compliance);
            assert!(arm.mechanisms.base_compliance.is_some() && arm.mechanisms.density == Some(1.5));
            assert_eq!(arm.layout.density, before.layout.density.clone().scaled(1.5));
        }
    }

    #[test]
    fn a_parameter_that_is_out_of_range_is_a_fault() {
        let faults = shipped("tilting-table").with_mechanism("density", &[("factor", -1.0)]).unwrap_err();
        assert!(faults.to_string().contains("density.factor"), "{faults}");
    }

    #[test]
    fn a_parameter_that_works_either_way_has_no_effect_within_its_prior() {
        let distributions = Path::new(env!("CARGO_MANIFEST_DIR")).join("distributions");
        let all = described(&distributions).unwrap_or_else(|lacks| panic!("{lacks}"));
        let mut both = 0;
        for (mechanism, p) in all.iter().flat_map(|m| m.parameters.iter().map(move |p| (m, p))) {
            let none = if p.unit == "1" { 1.0 } else { 0.0 };
            let is_within = (0.02..0.98).contains(&p.prior.cdf(none));
            let either = mechanism.stronger(p.key) == Stronger::EitherWay;
            assert_eq!(either, is_within, "{}.{}", mechanism.name, p.key);
            both += usize::from(either);
        }
        assert_eq!(both, EITHER_WAY.len());
    }

    #[test]
    fn every_parameter_that_works_downwards_or_either_way_is_one_of_the_keys() {
        for (mechanism, key) in STRONGER_BELOW.into_iter().chain(EITHER_WAY) {
            let entry = INVENTORY.iter().find(|entry| entry.name == mechanism);
            let section = entry.and_then(|entry| entry.section()).unwrap_or_else(|| panic!("{mechanism}"));
            assert!(section.all().any(|k| k.name == key), "{mechanism}.{key}");
        }
    }
}
