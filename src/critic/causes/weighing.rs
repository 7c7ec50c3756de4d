//! The ranking and the evidence weighed together.

use crate::critic::causes::network::softmax;
use crate::critic::causes::ranking::Ranked;
use crate::math::ln;

/// Powers in which the ranking's probability and the rough evidence count: those that gave the causes of some 200 simulated
/// campaigns of the nine walls, as the paper read them (with tests on two stones as well) and richly, the most probability. Rough
/// evidence is too sure of itself by far: it leans on a normal law and on few particles.
const POWERS: [f64; 2] = [0.7, 0.2];
/// Power in which the evidence of those that are examined counts besides, found in the same way on 56 campaigns: it is far
/// more exact, and sure of itself by as much as its law is not that of the walls.
const POWER_EXAMINED: f64 = 0.2;

/// The causes with their probabilities, weighed by rough evidence. The ranking knows how campaigns of a cause look and has seen
/// thousands of them; the evidence knows every reading of this one. What is unmodelled has no evidence, and keeps its probability.
/// `logs` are the logarithms of the evidence, in the order of the causes.
pub fn weighed(ranked: &Ranked, logs: &[f64]) -> Ranked {
    let both =
        ranked.causes.iter().zip(logs).map(|((_, p), log)| POWERS[0] * ln(p.max(1e-12)) + POWERS[1] * log);
    let probabilities = softmax(&both.collect::<Vec<_>>(), 1.0);
    let causes = ranked.causes.iter().map(|(cause, _)| *cause);
    Ranked::new(causes.zip(probabilities).collect(), ranked.unmodelled, ranked.set.clone())
}

/// The causes with their probabilities, weighed by the evidence of those examined as well. `logs` are its logarithms, that of the
/// base model first. What these and the base model have together stays theirs.
pub fn reweighed(ranked: &Ranked, shortlist: &[usize], logs: &[f64]) -> Ranked {
    let models = std::iter::once(None).chain(shortlist.iter().copied().map(Some));
    let known: Vec<(Option<usize>, f64)> = models.zip(logs.iter().copied()).collect();
    let log = |cause: &Option<usize>| known.iter().find(|(own, _)| own == cause).map(|(_, log)| *log);
    let (examined, others): (Vec<_>, Vec<_>) =
        ranked.causes.iter().copied().partition(|(cause, _)| log(cause).is_some());
    let whole = examined.iter().fold(0.0, |sum, (_, p)| sum + p);
    let both = examined.iter().filter_map(|(cause, p)| Some(ln(p.max(1e-12)) + POWER_EXAMINED * log(cause)?));
    let shares = softmax(&both.collect::<Vec<_>>(), 1.0);
    let moved = examined.iter().zip(shares).map(|((cause, _), share)| (*cause, whole * share));
    let shares = moved.chain(others).map(|(cause, p)| (cause, p / (1.0 - ranked.unmodelled))).collect();
    Ranked::new(shares, ranked.unmodelled, ranked.set.clone())
}

/// The probability of something that is in no catalogue beside the base model and the causes that were examined, all as likely
/// beforehand; `logs` are the logarithms of their evidence and `outside` that of its own. Evidence counts here as it does among causes.
pub fn outside(logs: &[f64], outside: f64) -> f64 {
    let all = logs.iter().copied().chain([outside]).map(|log| (POWERS[1] + POWER_EXAMINED) * log);
    softmax(&all.collect::<Vec<_>>(), 1.0)[logs.len()]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::exp;

    #[test]
    fn what_has_no_name_is_as_likely_as_its_evidence_says_beside_that_of_the_others() {
        assert!((outside(&[-7.0, -7.0, -7.0], -7.0) - 0.25).abs() < 1e-12);
        // Ten nats more than the others, of which four count.
        let more = exp(4.0);
        assert!((outside(&[-20.0, -20.0], -10.0) - more / (2.0 + more)).abs() < 1e-12);
        assert!(outside(&[-20.0, 5.0], -10.0) < 0.003);
    }

    #[test]
    fn the_evidence_of_some_moves_what_they_have_together_and_nothing_else() {
        let ranked =
            Ranked::new(vec![(Some(3), 0.5), (Some(1), 0.3), (None, 0.1), (Some(2), 0.1)], 0.2, vec![1, 3]);
        let found = reweighed(&ranked, &[3, 1], &[-20.0, -10.0, 0.0]);
        let of = |cause: Option<usize>| {
            found.causes.iter().find(|(own, _)| *own == cause).map(|(_, p)| *p).expect("it is there")
        };
        // Powers of the evidence: e^-2 of the second, e^-4 of the base model.
        let (first, second, base) = (0.5 * exp(-2.0), 0.3, 0.1 * exp(-4.0));
        let sum = first + second + base;
        for (cause, p) in [(Some(3), first), (Some(1), second), (None, base)] {
            assert!((of(cause) - 0.8 * 0.9 * p / sum).abs() < 1e-12, "{cause:?}");
        }
        // What was not examined keeps its part, and so does what has no name.
        assert!((of(Some(2)) - 0.8 * 0.1).abs() < 1e-12);
        assert_eq!(found.unmodelled, 0.2);
        assert_eq!((found.causes[0].0, &found.set[..]), (Some(1), &[1, 3][..]));
        // What is surely unmodelled leaves causes little, and that is a number.
        let sure =
            reweighed(&Ranked::new(ranked.causes.clone(), 1.0, vec![1, 3]), &[3, 1], &[-20.0, -10.0, 0.0]);
        assert!(sure.causes.iter().all(|(_, p)| *p > 0.0 && *p < 1e-8), "{sure:?}");
    }
}
