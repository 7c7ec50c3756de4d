//! A study with one or two more mechanisms and with other joints: at one point of what may be, and at others as its variants.

use crate::study::cause::{Cause, InLimitAnalysis};
use crate::study::checked::{Arm, StatedLaw, Study};
use crate::study::fault::Faults;
use crate::study::stated::{Settings, Stated, WrittenVariant, family_value};

/// What changes readings alone: first the factor, then what is added.
const GAUGES: [&str; 2] = ["gauge_scale", "gauge_offset"];

/// A mechanism at one strength.
#[derive(Clone, Debug, PartialEq)]
pub struct Acting {
    /// Its name.
    pub mechanism: &'static str,
    /// Its parameters by key, in the key's unit.
    pub parameters: Vec<(&'static str, f64)>,
    /// Indices of the arms that it acts on; none where that is every one that it can act on.
    pub arms: Option<Vec<usize>>,
}

/// Mechanisms at one strength each, and joints.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// The mechanisms; one that acts on some arms in another way than on others stands here once for each.
    pub acting: Vec<Acting>,
    /// Arms with other joints: the index of each, and factors on the middle of its points in kn, on its friction angle and on
    /// kn over ks, in the order of [`NUISANCES`](crate::study::NUISANCES).
    pub joints: Vec<(usize, [f64; 3])>,
}

impl Study {
    /// What its files state with the mechanisms on and with other joints: the study itself at one point, a variant for each
    /// of the others. A mechanism stands in `[mechanism]`, or in the arms that it acts on where that is not all, or where an arm refuses it. An
    /// arm that has it already keeps its own; but a gauge is read by the gauge found.
    ///
    /// # Errors
    /// The faults of values that their keys do not allow.
    pub fn extended(
        &self,
        stated: &Stated,
        own: &Point,
        others: Vec<(String, String, Point)>,
    ) -> Result<Stated, Faults> {
        let with = |everywhere: bool| {
            let settings = |point: &Point| self.settings(point, everywhere);
            let variants = others.iter().map(|(name, why, point)| {
                Ok(WrittenVariant { name: name.clone(), why: why.clone(), set: settings(point)? })
            });
            let variants = variants.collect::<Result<Vec<WrittenVariant>, Faults>>()?;
            let mut set = settings(own)?;
            if own.acting.iter().any(|own| self.leaves_limit_analysis(own.mechanism)) {
                set.insert("solver.agreement".to_owned(), false.into());
            }
            stated.clone().with(set, variants)
        };
        with(!own.acting.iter().any(|own| self.reads_by_gauges(own))).or_else(|_| with(false))
    }

    /// Whether limit analysis beside the solver has to go for a mechanism.
    pub fn leaves_limit_analysis(&self, mechanism: &str) -> bool {
        let cause = Cause::named(mechanism);
        self.agreement && cause.is_some_and(|cause| cause.limit() == InLimitAnalysis::Refused)
    }

    /// The arms that have a mechanism on.
    pub fn arms_with(&self, mechanism: &str) -> Vec<&str> {
        let has = |arm: &&Arm| {
            let shared = format!("mechanism.{mechanism}.");
            let own = format!("arm.{}.{shared}", arm.name);
            self.effective.keys().any(|key| key.starts_with(&shared) || key.starts_with(&own))
        };
        self.arms.iter().filter(has).map(|arm| arm.name.as_str()).collect()
    }

    /// Whether a gauge that is found reads what another gauge shows.
    fn reads_by_gauges(&self, found: &Acting) -> bool {
        GAUGES.contains(&found.mechanism) && GAUGES.iter().any(|gauge| !self.arms_with(gauge).is_empty())
    }

    /// The keys that a point sets.
    fn settings(&self, point: &Point, everywhere: bool) -> Result<Settings, Faults> {
        let mut set = Settings::new();
        let mut put = |below: &str, (mechanism, key, value): (&str, &str, f64)| {
            set.insert(format!("{below}mechanism.{mechanism}.{key}"), value.into());
        };
        for own in &point.acting {
            let Acting { mechanism, parameters, arms } = own;
            if everywhere && arms.is_none() {
                parameters.iter().for_each(|(key, value)| put("", (mechanism, key, *value)));
            } else if self.reads_by_gauges(own) {
                for arm in &self.arms {
                    let found = arm.read_by(point);
                    found.into_iter().for_each(|own| put(&format!("arm.{}.", arm.name), own));
                }
            } else {
                let idle = self.with_mechanism(mechanism, parameters)?.idle;
                let acts = |k: &usize| {
                    arms.as_ref().is_none_or(|arms| arms.contains(k))
                        && !idle.contains_key(&self.arms[*k].name)
                };
                for arm in (0..self.arms.len()).filter(acts).map(|k| &self.arms[k]) {
                    let below = format!("arm.{}.", arm.name);
                    parameters.iter().for_each(|(key, value)| put(&below, (mechanism, key, *value)));
                }
            }
        }
        for (arm, factors) in &point.joints {
            let arm = &self.arms[*arm];
            let with = arm.with_joints(arm.kn_points[arm.middle_point()], *factors);
            let mut joint = |key: &str, value: toml::Value| {
                set.insert(format!("arm.{}.joint.{key}", arm.name), value);
            };
            joint("kn_pa_per_m", with.kn_points.clone().into());
            joint("phi_deg", family_value(&with.joint.phi_deg));
            joint("kn_over_ks", with.joint.kn_over_ks.into());
            if let StatedLaw::Table(table) = &with.joint.normal_law {
                let [_, stresses] = table.knots();
                joint("table_stress_pa", stresses.to_vec().into());
            }
        }
        Ok(set)
    }
}

impl Arm {
    /// Keys of one gauge that shows what the gauges that are found make of the arm's own: the own reading times a factor, and
    /// moved.
    fn read_by(&self, found: &Point) -> Vec<(&'static str, &'static str, f64)> {
        let of = |gauge: &str| {
            let own = found.acting.iter().find(|own| own.mechanism == gauge)?;
            own.parameters.first().map(|(_, value)| *value)
        };
        let [factor, further] = GAUGES.map(of);
        let mechanisms = &self.mechanisms;
        let scale = mechanisms.value("gauge_scale", "factor");
        let offset = mechanisms.value("gauge_offset", "offset_m");
        let scaled = factor.map(|factor| scale.unwrap_or(1.0) * factor);
        let moved = match (offset, further) {
            (None, None) => None,
            (own, further) => Some(own.unwrap_or(0.0) * factor.unwrap_or(1.0) + further.unwrap_or(0.0)),
        };
        let scaled = scaled.map(|scale| (GAUGES[0], "factor", scale));
        scaled.into_iter().chain(moved.map(|offset| (GAUGES[1], "offset_m", offset))).collect()
    }
}
