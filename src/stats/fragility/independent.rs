//! Intervals of a lognormal curve whose trials are independent: a record of its own for each. Where records are shared they are far too
//! short: [`lognormal`](super::lognormal()) is for those.

use super::campaign::Stripe;
use super::lognormal::{Lognormal, fitted};
use super::probit::{self, Point};
use crate::math::{exp, ln};
use crate::random::{Stream, standard_normal};
use crate::stats::order::quantile_of_sorted;
use crate::stats::reference::TAIL;

/// 95 % intervals of theta and beta by Wald: from the observed information at the curve, ln theta and beta taken for normal. `None` where the
/// trials tell no curve.
pub fn wald(stripes: &[Stripe]) -> Option<[[f64; 2]; 2]> {
    let Lognormal { theta, beta } = fitted(stripes).curve?;
    let points: Vec<Point> = stripes.iter().map(|own| own.point(ln(own.intensity))).collect();
    let curve = probit::fitted(&points)?;
    let [of_level, of_both, of_slope] = curve.variances;
    // ln theta = centre - level / slope, so that it moves by -beta and by level beta^2 (delta method); beta = 1 / slope by -beta^2.
    let by = [-beta, curve.level * beta * beta];
    let of_theta = by[0] * by[0] * of_level + 2.0 * by[0] * by[1] * of_both + by[1] * by[1] * of_slope;
    let z = standard_normal::quantile(1.0 - TAIL);
    let (half, half_beta) = (z * of_theta.sqrt(), z * beta * beta * of_slope.sqrt());
    Some([[theta * exp(-half), theta * exp(half)], [beta - half_beta, beta + half_beta]])
}

/// 95 % intervals of theta and beta by the parametric bootstrap: percentiles of the curves of trials drawn from the curve. Draws that
/// tell no curve are left out; `None` if more than a fortieth do, as they are the ends. Trials must be whole numbers.
pub fn parametric_bootstrap(
    stripes: &[Stripe],
    replicates: usize,
    stream: &mut Stream,
) -> Option<[[f64; 2]; 2]> {
    let curve = fitted(stripes).curve?;
    let mut replicas = [Vec::new(), Vec::new()];
    for _ in 0..replicates {
        let drawn: Vec<Stripe> = stripes
            .iter()
            .map(|own| {
                let probability = curve.probability(own.intensity);
                let collapsed = (0..own.trials as usize).filter(|_| stream.uniform() < probability).count();
                Stripe { collapsed: collapsed as f64, ..*own }
            })
            .collect();
        if let Some(Lognormal { theta, beta }) = fitted(&drawn).curve {
            replicas[0].push(theta);
            replicas[1].push(beta);
        }
    }
    if replicas[0].len() as f64 <= (1.0 - TAIL) * replicates as f64 {
        return None;
    }
    for own in &mut replicas {
        own.sort_by(f64::total_cmp);
    }
    let [theta, beta] =
        replicas.map(|own| [quantile_of_sorted(&own, TAIL), quantile_of_sorted(&own, 1.0 - TAIL)]);
    Some([[theta[0]?, theta[1]?], [beta[0]?, beta[1]?]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;

    /// Counts of forty records at eight stripes (after an example of Baker 2015, from memory), and what another program made of them.
    const COUNTS: [(f64, f64); 8] =
        [(0.2, 0.0), (0.3, 0.0), (0.4, 0.0), (0.6, 4.0), (0.7, 6.0), (0.8, 13.0), (0.9, 12.0), (1.0, 16.0)];

    fn near(found: [f64; 2], known: [f64; 2], within: f64) {
        assert!(found.iter().zip(known).all(|(a, b)| (a - b).abs() < within), "{found:?} against {known:?}");
    }

    #[test]
    fn forty_records_at_eight_stripes_have_their_known_curve_and_intervals() {
        let stripes = COUNTS.map(|(intensity, collapsed)| Stripe { intensity, trials: 40.0, collapsed });
        let fit = fitted(&stripes);
        let curve = fit.curve.unwrap();
        // Printed to six decimals.
        near([curve.theta, curve.beta], [1.076116, 0.429237], 6e-7);
        assert!((fit.log_likelihood.unwrap() + 10.797705).abs() < 6e-7, "{fit:?}");
        // Printed to three decimals.
        near(wald(&stripes).unwrap()[0], [0.935, 1.238], 6e-4);
        let [theta, beta] =
            parametric_bootstrap(&stripes, 4000, &mut Streams::new(1, 0).of("fragility")).unwrap();
        // Known from some thousand draws, as these: an end has a standard error of 0.37 standard deviations of the value over the root of
        // 0.025 times 4000, three of which are 0.01, twice that as the tail upwards is longer.
        near(theta, [0.973, 1.274], 0.02);
        near(beta, [0.287, 0.605], 0.02);
    }

    #[test]
    fn too_few_curves_are_no_interval() {
        let stripes = [(0.5, 0.0), (1.0, 1.0), (2.0, 2.0)].map(|(intensity, collapsed)| Stripe {
            intensity,
            trials: 2.0,
            collapsed,
        });
        assert_eq!(wald(&stripes), None);
        let mixed = [(0.5, 1.0), (1.0, 0.0), (2.0, 2.0)].map(|(intensity, collapsed)| Stripe {
            intensity,
            trials: 2.0,
            collapsed,
        });
        assert!(wald(&mixed).is_some());
        assert_eq!(parametric_bootstrap(&mixed, 200, &mut Streams::new(1, 0).of("fragility")), None);
    }
}
