//! Probit regression of shares on one variable, by maximum likelihood or with Jeffreys' prior as a penalty.

use crate::math::{erfc, exp, ln, ln_1p};
use crate::random::standard_normal::quantile;
use std::f64::consts::{FRAC_1_SQRT_2, PI};

/// Trials at one place: `hits` of `trials`, both of which may be weighted sums.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Point {
    /// Place on the line that the share depends on.
    pub place: f64,
    /// How many trials.
    pub trials: f64,
    /// How many of them were hits.
    pub hits: f64,
}

/// P(hit) = Phi(level + slope (place - centre)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Probit {
    /// Mean place of the trials, so that level and slope hardly depend on each other.
    pub centre: f64,
    /// Value of the linear predictor at the centre.
    pub level: f64,
    /// Its slope.
    pub slope: f64,
    /// Log-likelihood of the trials as single ones: without binomial coefficients.
    pub log_likelihood: f64,
    /// Inverse of the information on level and slope, the observed one of a likelihood alone and the expected one with the penalty:
    /// variances, and their covariance between them.
    pub variances: [f64; 3],
}

/// What a probability and its logarithms are at a value of the linear predictor.
pub(super) struct At {
    /// ln Phi(eta), ln Phi(-eta).
    pub logs: [f64; 2],
    /// phi / Phi(eta), phi / Phi(-eta).
    pub ratios: [f64; 2],
}

/// Beyond it Phi(-eta) is nearly lost in f64, and the first two terms of its asymptotic series are exact to some 1e-6.
const FAR: f64 = 35.0;

impl At {
    pub fn new(eta: f64) -> At {
        let density = exp(-0.5 * eta * eta) / (2.0 * PI).sqrt();
        let side = |eta: f64| {
            if eta < -FAR {
                let log = ln_1p(-1.0 / (eta * eta)) - ln(-eta * (2.0 * PI).sqrt());
                return (log - 0.5 * eta * eta, -eta - 1.0 / eta);
            }
            let below = 0.5 * erfc(-eta * FRAC_1_SQRT_2);
            (ln(below), density / below)
        };
        let (lower, upper) = (side(eta), side(-eta));
        At { logs: [lower.0, upper.0], ratios: [lower.1, upper.1] }
    }

    /// phi^2 / (Phi (1 - Phi)): what one trial adds to the information on eta.
    pub fn weight(&self) -> f64 {
        self.ratios[0] * self.ratios[1]
    }
}

/// Steps of Newton's method; it takes 5 to 8, and some dozens with the penalty on separated data.
const MOST_STEPS: usize = 400;
/// Steps of level and slope below this, relative to their size, end the search: the error is then that of rounding.
const SMALL: f64 = 1e-11;

/// The curve of greatest likelihood. Both outcomes must occur and overlap, else there is none. `None` if the search fails.
pub(super) fn fitted(points: &[Point]) -> Option<Probit> {
    search(points, false)
}

/// The curve of greatest likelihood times Jeffreys' prior, the root of the determinant of Fisher's information (Firth 1993). It is finite
/// wherever trials lie at two places or more, whatever their outcomes (Kosmidis and Firth 2021). `None` if the search fails.
pub(super) fn penalised(points: &[Point]) -> Option<Probit> {
    search(points, true)
}

/// What is sought the top of, and how it changes, at a curve.
struct State {
    objective: f64,
    log_likelihood: f64,
    score: [f64; 2],
    /// What the score falls by along a step: the observed information, or the expected one with the penalty. Of the level, of both, of the
    /// slope.
    fall: [f64; 3],
}

fn state(points: &[Point], centre: f64, [level, slope]: [f64; 2], is_penalised: bool) -> State {
    let (mut log_likelihood, mut score) = (0.0, [0.0; 2]);
    let (mut information, mut observed) = ([0.0; 3], [0.0; 3]);
    let mut bends = Vec::new();
    for point in points {
        let z = point.place - centre;
        let eta = level + slope * z;
        let at = At::new(eta);
        let [hit, miss] = at.ratios;
        let (hits, misses) = (point.hits, point.trials - point.hits);
        // 0 ln 0 is 0: what did not happen says nothing.
        log_likelihood += if hits > 0.0 { hits * at.logs[0] } else { 0.0 };
        log_likelihood += if misses > 0.0 { misses * at.logs[1] } else { 0.0 };
        let slope_of_log = hits * hit - misses * miss;
        let weight = point.trials * at.weight();
        let bend = hits * hit * (eta + hit) + misses * miss * (miss - eta);
        for (own, factor) in [1.0, z].into_iter().enumerate() {
            score[own] += slope_of_log * factor;
        }
        for (own, factor) in [1.0, z, z * z].into_iter().enumerate() {
            information[own] += weight * factor;
            observed[own] += bend * factor;
        }
        if is_penalised {
            bends.push((z, weight, weight * (miss - hit - 2.0 * eta)));
        }
    }
    if !is_penalised {
        return State { objective: log_likelihood, log_likelihood, score, fall: observed };
    }
    let determinant = information[0] * information[2] - information[1] * information[1];
    for (z, _, change) in bends {
        // d/d eta of half the logarithm of the determinant: half the change of the weight times the leverage per weight.
        let leverage = (information[2] - 2.0 * information[1] * z + information[0] * z * z) / determinant;
        score[0] += 0.5 * change * leverage;
        score[1] += 0.5 * change * leverage * z;
    }
    let objective = log_likelihood + 0.5 * ln(determinant);
    State { objective, log_likelihood, score, fall: information }
}

/// Solution of a symmetric system of two equations; `None` where it has none.
fn solved([a, b, c]: [f64; 3], [x, y]: [f64; 2]) -> Option<[f64; 2]> {
    let determinant = a * c - b * b;
    let solution = [(c * x - b * y) / determinant, (a * y - b * x) / determinant];
    (determinant > 0.0 && solution.iter().all(|v| v.is_finite())).then_some(solution)
}

fn search(points: &[Point], is_penalised: bool) -> Option<Probit> {
    let all: f64 = points.iter().map(|point| point.trials).sum();
    let hits: f64 = points.iter().map(|point| point.hits).sum();
    let centre = points.iter().map(|point| point.trials * point.place).sum::<f64>() / all;
    // A flat curve at the share of all trials, drawn in by half a trial on either side.
    let mut curve = [quantile((hits + 0.5) / (all + 1.0)), 0.0];
    let mut now = state(points, centre, curve, is_penalised);
    for _ in 0..MOST_STEPS {
        let step = solved(now.fall, now.score)?;
        let mut share = 1.0;
        let next = loop {
            let tried = [curve[0] + share * step[0], curve[1] + share * step[1]];
            let next = state(points, centre, tried, is_penalised);
            // A last step may lose what rounding makes of the logarithms.
            if next.objective >= now.objective - 1e-13 * now.objective.abs() {
                curve = tried;
                break next;
            }
            share *= 0.5;
            if share < 1e-9 {
                return None;
            }
        };
        now = next;
        if (0..2).all(|own| (share * step[own]).abs() < SMALL * (1.0 + curve[own].abs())) {
            let [a, b, c] = now.fall;
            let determinant = a * c - b * b;
            return Some(Probit {
                centre,
                level: curve[0],
                slope: curve[1],
                log_likelihood: now.log_likelihood,
                variances: [c / determinant, -b / determinant, a / determinant],
            });
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(shares: &[(f64, f64, f64)]) -> Vec<Point> {
        shares
            .iter()
            .map(|(place, hits, trials)| Point { place: *place, trials: *trials, hits: *hits })
            .collect()
    }

    const SHARES: [(f64, f64, f64); 4] =
        [(-1.0, 1.0, 20.0), (-0.2, 3.5, 15.0), (0.3, 11.0, 25.0), (1.4, 18.0, 20.0)];

    /// Of the objective at a curve and where it is moved by 1e-4: the differences are of second order.
    fn is_top(points: &[Point], curve: &Probit, is_penalised: bool) {
        let at = |level: f64, slope: f64| {
            state(points, curve.centre, [curve.level + level, curve.slope + slope], is_penalised).objective
        };
        let top = at(0.0, 0.0);
        for [level, slope] in [[1.0, 0.0], [0.0, 1.0], [0.7, 0.7], [0.7, -0.7]] {
            let sides = [1e-4, -1e-4].map(|by| at(by * level, by * slope) - top);
            // What curvature takes is some 1e-7; rounding of the logarithms is 1e-14.
            assert!(sides.iter().all(|side| *side < 0.0), "{sides:?}");
            assert!((sides[0] - sides[1]).abs() < 1e-3 * sides[0].abs(), "{sides:?}");
        }
    }

    #[test]
    fn both_searches_end_at_the_top_of_what_they_seek() {
        let points = points(&SHARES);
        let [plain, drawn_in] = [fitted(&points).unwrap(), penalised(&points).unwrap()];
        is_top(&points, &plain, false);
        is_top(&points, &drawn_in, true);
        assert!(drawn_in.slope < plain.slope && drawn_in.slope > 0.9 * plain.slope);
    }

    #[test]
    fn the_penalty_keeps_separated_shares_finite() {
        for shares in [
            vec![(-1.0, 0.0, 10.0), (0.0, 0.0, 10.0), (0.5, 10.0, 10.0)],
            vec![(-1.0, 0.0, 3.0), (0.0, 2.0, 4.0), (2.0, 5.0, 5.0)],
            vec![(-1.0, 0.0, 1000.0), (1.0, 1000.0, 1000.0)],
        ] {
            let points = points(&shares);
            let curve = penalised(&points).unwrap();
            assert!(curve.slope > 0.0 && curve.slope < 20.0, "{curve:?}");
            is_top(&points, &curve, true);
        }
    }

    #[test]
    fn the_tails_join_and_stay_finite() {
        for eta in [-FAR, FAR] {
            let [inner, outer] = [At::new(eta * (1.0 - 1e-12)), At::new(eta * (1.0 + 1e-12))];
            for side in 0..2 {
                // The next term of the series is 3 / 35^4.
                assert!((inner.logs[side] - outer.logs[side]).abs() < 3e-6);
                assert!((inner.ratios[side] - outer.ratios[side]).abs() < 1e-4);
            }
        }
        let far = At::new(-1e8);
        assert!(far.logs[0] < -1e15 && far.logs[1] == 0.0 && far.weight() == 0.0);
    }
}
