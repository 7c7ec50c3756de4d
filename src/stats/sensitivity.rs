//! Where the scatter of a result comes from: the shares of its variance that groups of independent inputs are responsible for
//! (Sobol' 1993; Homma and Saltelli 1996).
//!
//! For a group g the first order share is V[E(f | g)] / V: what would go if g were known. The total share is E[V(f | all but g)] / V:
//! what would be left if all but g were known. They differ by the part of g in interactions. Both are estimated by pick-freeze: at a
//! base point two independent draws of all inputs are evaluated, the *own* and the *partner*, and for each group the own inputs with
//! those of the group taken from the partner, the *mixed* one. A nested estimate needs such pairs; no single sample holds it.

use super::Estimate;
use super::moments::{check_values, mean, sum};
use super::randomised::by_randomisations;

/// Values at one base point; `None` of those that failed.
#[derive(Clone, Debug, PartialEq)]
pub struct BasePoint {
    /// At the own inputs.
    pub own: Option<f64>,
    /// At the partner's inputs.
    pub partner: Option<f64>,
    /// At the own inputs with those of a group taken from the partner, group by group.
    pub mixed: Vec<Option<f64>>,
}

/// What a group is responsible for, as shares of the variance with 95 % intervals. By chance an estimate of a small share may lie below
/// 0, and of a large one above 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// First order: alone.
    pub first: Estimate,
    /// Total: with all its interactions.
    pub total: Estimate,
    /// Base points at which all three values are there.
    pub points: usize,
}

/// Mean, variance and the share of every group.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensitivity {
    /// Mean of the own and the partner's values.
    pub mean: Estimate,
    /// Their variance.
    pub variance: Estimate,
    /// In the order of the groups.
    pub shares: Vec<Share>,
}

/// Estimates of Jansen (1999): with own value a, partner's b and mixed m, first order `1 - mean (b - m)^2 / (2 V)` and total
/// `mean (a - m)^2 / (2 V)`; see Saltelli and others (2010), table 2, (c) and (f). V is the variance of the a and b of the same base
/// points. A base point without one of a, b and m is left out of the share of that group, and only of that.
///
/// Base point k belongs to the randomisation k mod `randomisations`, which are independent of each other: intervals rest on their
/// differences. Nothing is defined where the variance is 0.
pub fn sensitivity(points: &[BasePoint], randomisations: usize) -> Sensitivity {
    let groups = points.first().map_or(0, |point| point.mixed.len());
    let whole = |point: &BasePoint| Some([point.own?, point.partner?]);
    let pairs = shared(points, randomisations, whole);
    let flat = |pairs: &[[f64; 2]]| pairs.as_flattened().to_vec();
    let share = |group: usize| {
        let triples = shared(points, randomisations, |point| {
            Some([point.own?, point.partner?, point.mixed.get(group).copied()??])
        });
        let of = |side: usize, triples: &[[f64; 3]]| {
            let pairs: Vec<[f64; 2]> = triples.iter().map(|[a, b, _]| [*a, *b]).collect();
            let twice = 2.0 * variance(&flat(&pairs))?;
            let squares: Vec<f64> = triples.iter().map(|t| (t[side] - t[2]) * (t[side] - t[2])).collect();
            (twice > 0.0).then(|| sum(&squares) / squares.len() as f64 / twice)
        };
        Share {
            first: by_randomisations(&triples, |triples| of(1, triples).map(|rest| 1.0 - rest)),
            total: by_randomisations(&triples, |triples| of(0, triples)),
            points: triples.iter().map(Vec::len).sum(),
        }
    };
    Sensitivity {
        mean: by_randomisations(&pairs, |pairs| mean(&flat(pairs))),
        variance: by_randomisations(&pairs, |pairs| variance(&flat(pairs))),
        shares: (0..groups).map(share).collect(),
    }
}

/// The sum of the first order shares of some groups, at the base points where all their values are there: what they are responsible for
/// without their interactions. Its interval is that of the sum, which those of its parts are no substitute for.
pub fn share_alone(points: &[BasePoint], randomisations: usize, groups: &[usize]) -> Estimate {
    let values = |point: &BasePoint| {
        let pair = [point.own?, point.partner?];
        let mixed =
            groups.iter().map(|group| point.mixed.get(*group).copied()?).collect::<Option<Vec<f64>>>()?;
        check_values(&pair);
        check_values(&mixed);
        Some((pair, mixed))
    };
    let mut shared = vec![Vec::new(); randomisations.max(1)];
    for (k, own) in points.iter().enumerate().filter_map(|(k, point)| Some((k, values(point)?))) {
        shared[k % randomisations.max(1)].push(own);
    }
    by_randomisations(&shared, |all: &[([f64; 2], Vec<f64>)]| {
        let pairs: Vec<f64> = all.iter().flat_map(|(pair, _)| *pair).collect();
        let twice = 2.0 * variance(&pairs)?;
        let rest = |([_, partner], mixed): &([f64; 2], Vec<f64>)| {
            sum(&mixed.iter().map(|own| (partner - own) * (partner - own)).collect::<Vec<f64>>())
        };
        let rest = sum(&all.iter().map(rest).collect::<Vec<f64>>()) / all.len() as f64;
        (twice > 0.0).then(|| groups.len() as f64 - rest / twice)
    })
}

/// What there is at base points, by randomisation.
fn shared<const N: usize>(
    points: &[BasePoint],
    randomisations: usize,
    of: impl Fn(&BasePoint) -> Option<[f64; N]>,
) -> Vec<Vec<[f64; N]>> {
    let mut shared = vec![Vec::new(); randomisations.max(1)];
    for (k, values) in points.iter().enumerate().filter_map(|(k, point)| Some((k, of(point)?))) {
        check_values(&values);
        shared[k % randomisations.max(1)].push(values);
    }
    shared
}

/// Variance of a population (divisor n - 1); `None` below two values.
fn variance(values: &[f64]) -> Option<f64> {
    let centre = mean(values)?;
    let squares: Vec<f64> = values.iter().map(|x| (x - centre) * (x - centre)).collect();
    (values.len() > 1).then(|| sum(&squares) / (values.len() - 1) as f64)
}
