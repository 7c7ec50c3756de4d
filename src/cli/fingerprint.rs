//! What a judge says, as a text that a kept self-test is recognised by.
//!
//! The words are those of the first self-tests that were kept. They are part of the file: other words would make every kept
//! self-test one of another judge. So they are written out here, whatever the types and their fields are called.

use crate::critic::{ComponentEstimate, Diagnosis, Examined, Finding, Limits, Ranked};

/// The limits of a verdict.
pub(super) fn limits(of: &Limits) -> String {
    let pair = format!(
        "PairLimits {{ named: {:?}, guard: {:?}, nameless: {:?} }}",
        of.pair.named, of.pair.check, of.pair.unmodelled
    );
    format!(
        "Limits {{ found: {:?}, named: {:?}, sure: {:?}, guard: {:?}, conflict: {:?}, pair: {pair} }}",
        of.found, of.named, of.sure, of.check, of.conflict
    )
}

/// What was said of several campaigns.
pub(super) fn diagnoses(all: &[Diagnosis]) -> String {
    listed(all, diagnosis)
}

fn diagnosis(of: &Diagnosis) -> String {
    format!(
        "Diagnosis {{ seeming: {}, looked_at: {}, pairs: {}, form: {}, verdict: {:?} }}",
        finding(&of.finding),
        listed(&of.examined, examined),
        listed(&of.pairs, examined),
        listed(&of.components, estimate),
        of.verdict
    )
}

fn finding(of: &Finding) -> String {
    let discrepancy = format!(
        "Wrong {{ excess: {:?}, joints: {:?}, distance: {:?} }}",
        of.discrepancy.excess, of.discrepancy.joints, of.discrepancy.distance
    );
    let Ranked { causes, unmodelled, set } = &of.ranked;
    let ranked = format!("Ranked {{ causes: {causes:?}, nameless: {unmodelled:?}, set: {set:?} }}");
    format!(
        "Seeming {{ wrong: {discrepancy}, ranked: {ranked}, p_value: {:?}, looks: {:?} }}",
        of.p_value, of.p_by_statistic
    )
}

fn examined<C: std::fmt::Debug>(of: &Examined<C>) -> String {
    format!(
        "LookedAt {{ cause: {:?}, guard: {:?}, conflict: {:?}, evidence: {:?}, draws: {:?} }}",
        of.cause, of.check, of.conflict, of.evidence, of.draws
    )
}

fn estimate(of: &ComponentEstimate) -> String {
    format!(
        "Bent {{ part: {:?}, family: {:?}, quantity: {:?}, tilt: {:?}, value: {:?}, sd: {:?} }}",
        of.part, of.family, of.quantity, of.tilt, of.value, of.sd
    )
}

fn listed<T>(all: &[T], one: impl Fn(&T) -> String) -> String {
    format!("[{}]", all.iter().map(one).collect::<Vec<_>>().join(", "))
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use crate::critic::{Component, Contrast, Discrepancy, Examined, Feature, Finding, Truth, Verdict};
    use crate::study::MeasuredQuantity;

    #[test]
    fn the_words_of_kept_self_tests_stay() {
        let kept = "Limits { found: 0.05, named: 0.8, sure: 0.01, guard: 0.05, conflict: 0.05, pair: PairLimits { named: 0.99, \
                    guard: 0.25, nameless: 0.05 } }";
        assert_eq!(limits(&Limits::default()), kept);
        let draws = vec![Truth { causes: Some(3).into(), parameters: vec![0.5], joints: vec![[0.0; 3]] }];
        let finding = Finding {
            discrepancy: Discrepancy {
                excess: BTreeMap::from([(Feature::Mean(1, Contrast::Level), Some(4.2))]),
                joints: vec![[0.0; 3]],
                distance: 30.0,
            },
            ranked: Ranked { causes: vec![(Some(3), 0.8), (None, 0.2)], unmodelled: 0.25, set: vec![3] },
            p_value: 0.001,
            p_by_statistic: [0.004, 0.001, 0.02],
        };
        let component = ComponentEstimate {
            part: Component::Level,
            family: 1,
            quantity: MeasuredQuantity::DisplacementMean,
            tilt: None,
            value: 0.002,
            sd: 0.001,
        };
        let own = Examined { cause: 3, check: Some(0.4), conflict: None, evidence: 0.45, draws };
        let said = Diagnosis {
            finding,
            examined: vec![own],
            pairs: Vec::new(),
            components: vec![component],
            verdict: Verdict::Named(3),
        };
        let kept = "[Diagnosis { seeming: Seeming { wrong: Wrong { excess: {Mean(1, Level): Some(4.2)}, joints: [[0.0, 0.0, 0.0]], \
                    distance: 30.0 }, ranked: Ranked { causes: [(Some(3), 0.8), (None, 0.2)], nameless: 0.25, set: [3] }, \
                    p_value: 0.001, looks: [0.004, 0.001, 0.02] }, looked_at: [LookedAt { cause: 3, guard: Some(0.4), \
                    conflict: None, evidence: 0.45, draws: [Truth { causes: Causes([Some(3), None]), parameters: [0.5], \
                    joints: [[0.0, 0.0, 0.0]] }] }], pairs: [], form: [Bent { part: Level, family: 1, quantity: \
                    DisplacementMean, tilt: None, value: 0.002, sd: 0.001 }], verdict: Named(3) }]";
        assert_eq!(diagnoses(&[said]), kept);
    }
}
