//! What estimated shares of a variance can be: the nearest ones that hold to what is known of all shares exactly.
//!
//! Of independent groups that together are all inputs, with first order shares S and total shares T (Sobol' 1993; Homma and Saltelli
//! 1996): 0 <= S <= T <= 1 of each; the S sum to 1 at most and the T to 1 at least; T of one and the S of all others sum to 1 at most, and
//! of two groups to 1 exactly, as what one is not responsible for alone is the other one's total. A single group has S = T = 1. Parts
//! of a group have no larger shares than it, and their S sum to no more than its own.

use super::{Estimate, Share};

/// So many rounds, at most, until no share moves by more than this any more.
const ROUNDS: usize = 10_000;
const STILL: f64 = 1e-12;
/// The least variance of an estimate: one without an interval is known to this.
const LEAST: f64 = 1e-12;

/// A bound on a sum of shares: coefficients by their places, and the most that the sum can be.
struct Bound {
    of: Vec<(usize, f64)>,
    most: f64,
}

/// The possible shares nearest to the estimated ones, in the order of the groups. Distances are counted in standard errors. An
/// interval is the estimated one as far as shares can be there, and holds the value. `part_of` says of each group which one it is a
/// part of; those that are no part are all inputs together. Where a share is not defined, nothing is changed.
pub fn possible_shares(shares: &[Share], part_of: &[Option<usize>]) -> Vec<Share> {
    crate::check!(shares.len() == part_of.len(), "{} shares of {} groups", shares.len(), part_of.len());
    let estimates: Vec<Estimate> = shares.iter().flat_map(|share| [share.first, share.total]).collect();
    let Some(values) = estimates.iter().map(|own| own.value).collect::<Option<Vec<f64>>>() else {
        return shares.to_vec();
    };
    let variance = |own: &Estimate| {
        let half = own.interval.map_or(0.0, |[low, high]| 0.5 * (high - low));
        (half * half).max(LEAST)
    };
    let variances: Vec<f64> = estimates.iter().map(variance).collect();
    let nearest = nearest(values, &variances, &bounds(part_of));
    let is_whole = part_of.iter().filter(|own| own.is_none()).count() == 1;
    let of = |place: usize, estimate: Estimate| {
        let value = nearest[place].clamp(0.0, 1.0);
        if is_whole && part_of[place / 2].is_none() {
            return Estimate { value: Some(1.0), interval: Some([1.0; 2]) };
        }
        let interval = estimate.interval.map(|ends| {
            let [low, high] = ends.map(|end| end.clamp(0.0, 1.0));
            [low.min(value), high.max(value)]
        });
        Estimate { value: Some(value), interval }
    };
    let share = |(k, share): (usize, &Share)| Share {
        first: of(2 * k, share.first),
        total: of(2 * k + 1, share.total),
        points: share.points,
    };
    shares.iter().enumerate().map(share).collect()
}

/// What is known of all shares: first order at 2 k, total at 2 k + 1.
fn bounds(part_of: &[Option<usize>]) -> Vec<Bound> {
    let (first, total) = (|k: usize| 2 * k, |k: usize| 2 * k + 1);
    let mut all = Vec::new();
    let mut add = |of: Vec<(usize, f64)>, most: f64| all.push(Bound { of, most });
    for (k, whole) in part_of.iter().enumerate() {
        add(vec![(first(k), -1.0)], 0.0);
        add(vec![(first(k), 1.0), (total(k), -1.0)], 0.0);
        add(vec![(total(k), 1.0)], 1.0);
        if let Some(whole) = whole {
            add(vec![(total(k), 1.0), (total(*whole), -1.0)], 0.0);
        }
    }
    let groups: Vec<usize> = (0..part_of.len()).filter(|k| part_of[*k].is_none()).collect();
    for &one in &groups {
        let others = groups.iter().filter(|other| **other != one);
        let sum: Vec<(usize, f64)> =
            others.map(|other| (first(*other), 1.0)).chain([(total(one), 1.0)]).collect();
        if groups.len() <= 2 {
            add(sum.iter().map(|(place, by)| (*place, -by)).collect(), -1.0);
        }
        add(sum, 1.0);
        let parts: Vec<usize> = (0..part_of.len()).filter(|k| part_of[*k] == Some(one)).collect();
        if !parts.is_empty() {
            let parts = parts.iter().map(|part| (first(*part), 1.0));
            add(parts.chain([(first(one), -1.0)]).collect(), 0.0);
        }
    }
    add(groups.iter().map(|k| (first(*k), 1.0)).collect(), 1.0);
    add(groups.iter().map(|k| (total(*k), -1.0)).collect(), -1.0);
    all
}

/// The nearest point within all bounds, in the metric of these variances: by Hildreth's method (1957), which gives back what a bound
/// moved a point by before it is asked again.
fn nearest(mut x: Vec<f64>, variances: &[f64], bounds: &[Bound]) -> Vec<f64> {
    let mut moved = vec![0.0; bounds.len()];
    for _ in 0..ROUNDS {
        let mut most = 0.0_f64;
        for (bound, before) in bounds.iter().zip(&mut moved) {
            let sum = bound.of.iter().fold(0.0, |sum, (place, by)| sum + by * x[*place]);
            let square = bound.of.iter().fold(0.0, |sum, (place, by)| sum + by * by * variances[*place]);
            let now = (*before + (sum - bound.most) / square).max(0.0);
            for (place, by) in &bound.of {
                let step = (now - *before) * by * variances[*place];
                x[*place] -= step;
                most = most.max(step.abs());
            }
            *before = now;
        }
        if most < STILL {
            break;
        }
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    fn share([first, total]: [f64; 2], half: f64) -> Share {
        let of = |value: f64| Estimate { value: Some(value), interval: Some([value - half, value + half]) };
        Share { first: of(first), total: of(total), points: 64 }
    }

    fn values(shares: &[Share], part_of: &[Option<usize>]) -> Vec<[f64; 2]> {
        let found = possible_shares(shares, part_of);
        found.iter().map(|own| [own.first, own.total].map(|own| own.value.unwrap())).collect()
    }

    #[test]
    fn a_single_group_is_responsible_for_everything() {
        let found = possible_shares(&[share([1.0, 0.79], 0.37)], &[None]);
        let all = Estimate { value: Some(1.0), interval: Some([1.0; 2]) };
        assert_eq!((found[0].first, found[0].total), (all, all));
        // Its parts are not known by that.
        let found = values(&[share([0.9, 0.8], 0.3), share([0.4, 0.6], 0.1)], &[None, Some(0)]);
        assert_eq!(found[0], [1.0, 1.0]);
        assert!((found[1][0] - 0.4).abs() < 1e-9 && (found[1][1] - 0.6).abs() < 1e-9, "{found:?}");
    }

    #[test]
    fn what_can_be_stays_and_what_cannot_moves_to_the_nearest_that_can() {
        // Ishigami's function, to the last digit possible.
        let exact = [[0.3139, 0.5576], [0.4424, 0.4424], [0.0, 0.2437]];
        let found = values(&exact.map(|own| share(own, 0.05)), &[None; 3]);
        for (found, exact) in found.iter().flatten().zip(exact.as_flattened()) {
            assert!((found - exact).abs() < 1e-4, "{found} {exact}");
        }
        // First order 163 % in all, and a total below it.
        let off = [share([0.95, 0.7], 0.4), share([0.68, 0.5], 0.4), share([-0.1, 0.3], 0.4)];
        let found = values(&off, &[None; 3]);
        let sum = |order: usize| found.iter().map(|own| own[order]).sum::<f64>();
        assert!(sum(0) <= 1.0 + 1e-6 && sum(1) >= 1.0 - 1e-6, "{found:?}");
        for (k, [first, total]) in found.iter().enumerate() {
            assert!(-1e-9 <= *first && *first <= total + 1e-6 && *total <= 1.0, "{found:?}");
            assert!(total + sum(0) - first <= 1.0 + 1e-6, "{k}: {found:?}");
        }
        // Two groups share out the whole.
        let found = values(&[share([0.5, 0.7], 0.1), share([0.4, 0.4], 0.2)], &[None; 2]);
        assert!(
            (found[0][1] + found[1][0] - 1.0).abs() < 1e-6 && (found[1][1] + found[0][0] - 1.0).abs() < 1e-6
        );
    }

    #[test]
    fn an_interval_ends_where_shares_do_and_holds_the_value() {
        let found = possible_shares(&[share([0.9, 1.2], 0.3), share([-0.3, 0.05], 0.2)], &[None; 2]);
        for own in found.iter().flat_map(|share| [share.first, share.total]) {
            let (value, [low, high]) = own.value.zip(own.interval).unwrap();
            assert!(0.0 <= low && low <= value && value <= high && high <= 1.0, "{own:?}");
        }
        // What is not defined stays as it is.
        let none = Share { first: Estimate::UNDEFINED, total: Estimate::UNDEFINED, points: 0 };
        assert_eq!(possible_shares(&[none], &[None]), [none]);
    }
}
