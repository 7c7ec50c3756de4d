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
    use super::*;

    #[test]
    fn the_words_of_kept_self_tests_stay() {
        let said = limits(&Limits::default());
        let kept = "Limits { found: 0.05, named: 0.8, sure: 0.01, guard: 0.05, conflict: 0.05, pair: PairLimits { named: 0.99, \
                    guard: 0.25, nameless: 0.05 } }";
        assert_eq!(said, kept);
    }
}
