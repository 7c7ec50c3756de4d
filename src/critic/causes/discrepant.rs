//! The likelihood of a campaign in which something is off that no cause of the catalogue makes: anything smooth.

use std::f64::consts::PI;

use nalgebra::{DMatrix, DVector};

use crate::critic::causes::likelihood::{Errors, Likelihood};
use crate::critic::discrepancy::Lies;
use crate::critic::simulate::{Campaign, Design, Seen, Truth};
use crate::interrupt;
use crate::math::ln;

/// How a normal discrepancy hangs together at the readings of a campaign.
pub struct Discrepant {
    /// Covariances at the readings with a value, family by family and specimen by specimen.
    covariance: DMatrix<f64>,
    /// Variances at those of which only a bound's side is known.
    bounds: Vec<f64>,
}

impl Discrepant {
    /// A [smooth](Lies) one, in these units by specimen and reading.
    pub fn smooth(design: &Design, campaign: &Campaign, units: &[Vec<f64>]) -> Discrepant {
        let mut all: Vec<((usize, usize), Lies<'_>)> = Lies::all(design).collect();
        all.sort_by_key(|((specimen, _), _)| design.specimens[*specimen].family);
        let seen = |is: fn(&Seen) -> bool| -> Vec<(f64, &Lies<'_>)> {
            let those = all.iter().filter(|((s, r), _)| is(&campaign.specimens[*s][*r]));
            those.map(|((s, r), lies)| (units[*s][*r], lies)).collect()
        };
        let values = seen(|seen| matches!(seen, Seen::Value(_)));
        let covariance = DMatrix::from_fn(values.len(), values.len(), |one, other| {
            let ((unit, one), (another, other)) = (&values[one], &values[other]);
            unit * another * one.together(other)
        });
        let bounds = seen(|seen| matches!(seen, Seen::Beyond | Seen::Fell | Seen::Stood));
        Discrepant {
            covariance,
            bounds: bounds.iter().map(|(unit, lies)| unit * unit * lies.together(lies)).collect(),
        }
    }
}

impl Likelihood<'_> {
    /// The logarithm of the likelihood where a normal discrepancy is added to what the specimens show, of a [`Discrepant`] campaign and
    /// so many times its covariance. The paths' law is that of the readings less the discrepancy's mean (Laplace), and without a
    /// discrepancy the likelihood is [`Self::log`].
    pub fn log_beside(&self, truth: &Truth, common: &[f64], beside: &Discrepant, times: f64) -> f64 {
        interrupt::look();
        let errors = Errors { of: self, scores: common };
        let mut log = self.apart_log(truth, &errors);
        let mut whole = &beside.covariance * times;
        let (mut off, mut densities, mut bounds) = (Vec::new(), Vec::new(), beside.bounds.iter());
        for family in &self.families {
            let Some((paths, walls)) = self.walls(family, truth, &errors) else { return f64::NEG_INFINITY };
            for (wall, density) in walls {
                let (first, shown) = (off.len(), wall.off(&paths, &errors));
                for one in 0..shown.len() {
                    for other in 0..shown.len() {
                        whole[(first + one, first + other)] += density.covariance(one, other);
                    }
                }
                off.extend(shown);
                densities.push((first..off.len(), density));
                log += wall.bounds_log(&paths, &errors, || times * bounds.next().copied().unwrap_or(0.0));
            }
        }
        let Some(factored) = whole.cholesky() else { return f64::NEG_INFINITY };
        let off = DVector::from_vec(off);
        let weights = factored.solve(&off);
        let lower = factored.l_dirty();
        let half =
            (0..off.len()).fold(0.5 * off.len() as f64 * ln(2.0 * PI), |sum, k| sum + ln(lower[(k, k)]));
        log -= 0.5 * off.dot(&weights) + half;
        let left = off - &beside.covariance * weights * times;
        let laws = densities.iter().map(|(own, density)| {
            let left = &left.as_slice()[own.clone()];
            density.log(left) - density.normal_log(left)
        });
        log + laws.sum::<f64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::judged;
    use crate::random::Streams;

    #[test]
    fn a_discrepancy_takes_up_what_is_smooth_and_without_one_the_likelihood_is_the_plain_one() {
        let (_, judge) = judged();
        let (world, design) = (judge.world, &judge.design);
        let (truth, units) = (world.drawn(None, &Streams::new(51, 1)), judge.reference.scale.units());
        let shown = world.campaign(design, &truth, &Streams::new(51, 1));
        let logs = |campaign: &Campaign| {
            let likelihood = Likelihood::new(world, design, campaign);
            let (common, beside) =
                (vec![0.0; likelihood.common_errors()], Discrepant::smooth(design, campaign, &units));
            let of = |times: f64| likelihood.log_beside(&truth, &common, &beside, times);
            [likelihood.log(&truth, &common), of(0.0), of(9.0)]
        };
        let [plain, none, beside] = logs(&shown);
        assert!((plain - none).abs() < 1e-6 * plain.abs(), "{plain} {none}");
        // What is not needed costs evidence.
        assert!(beside < plain - 2.0, "{plain} {beside}");
        // Every reading is off by three of the base model's standard deviations: all up, or up and down in turn.
        let off = |is_smooth: bool| {
            let mut campaign = shown.clone();
            let (mut way, all) = (1.0, campaign.specimens.iter_mut().flatten());
            for (seen, unit) in all.zip(units.iter().flatten()) {
                if let Seen::Value(value) = seen {
                    *value += 3.0 * way * unit;
                    way = if is_smooth { 1.0 } else { -way };
                }
            }
            logs(&campaign)
        };
        let ([plain, _, beside], [rough_plain, _, rough]) = (off(true), off(false));
        println!("{plain} {beside}; {rough_plain} {rough}");
        assert!(beside > plain + 10.0 && beside > rough + 10.0, "{plain} {beside} {rough_plain} {rough}");
    }
}
