//! The detection limit: how large an effect must be to be detected.

use serde::{Deserialize, Serialize};

use crate::random::Stream;
use crate::study::Stronger;

/// The power at the detection limit: an effect is detected where so large a share of its campaigns is found.
pub const DETECTION_POWER: f64 = 0.8;
/// That share is taken over so large a share of the campaigns, of neighbouring strengths, but over no fewer than so many. Of more
/// campaigns as few would have some chance anywhere to hold too few that are found.
const WINDOW: f64 = 0.15;
const FEWEST: usize = 15;
/// Resamples that tell an interval.
const REPLICATES: usize = 999;
/// Of these lie beyond either end of a 95 % interval.
const BEYOND: usize = 24;

/// The strength from which on an effect is found four times in five.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DetectionLimit {
    /// Index of the parameter.
    pub parameter: usize,
    /// Its score from where on; `None` where it is detected anywhere in its prior.
    pub score: Option<f64>,
    /// The 95 % interval of this score, ascending: percentiles over resampled campaigns. `None` at an end where these do not bound
    /// it: it may be detected at any weaker effect, or at none so strong as the prior holds.
    pub interval: [Option<f64>; 2],
    /// Whether smaller values are detected, not larger ones.
    pub below: bool,
}

/// From which scores of a parameter on effects are detected, towards where they are the stronger; once where they are anywhere.
/// Shown are the scores of campaigns and whether they were found.
pub fn detection_limits(
    parameter: usize,
    stronger: Stronger,
    shown: &[(f64, bool)],
    stream: &mut Stream,
) -> Vec<DetectionLimit> {
    let sides: &[bool] = match stronger {
        Stronger::Above => &[false],
        Stronger::Below => &[true],
        Stronger::EitherWay => &[false, true],
    };
    let mut side = |below: bool| {
        let sign = if below { -1.0 } else { 1.0 };
        let strengths: Vec<(f64, bool)> = shown.iter().map(|(score, found)| (sign * score, *found)).collect();
        let from = least(strengths.clone());
        if from == f64::INFINITY {
            return None;
        }
        let [weak, strong] = interval(&strengths, stream);
        let score = |strength: f64| strength.is_finite().then_some(sign * strength);
        let mut interval = [weak.min(from), strong.max(from)].map(score);
        if below {
            interval.reverse();
        }
        Some(DetectionLimit { parameter, score: score(from), interval, below })
    };
    let mut detection_limits: Vec<DetectionLimit> = sides.iter().filter_map(|below| side(*below)).collect();
    if detection_limits.iter().any(|own| own.score.is_none()) {
        detection_limits.truncate(1);
    }
    detection_limits
}

/// From which strength on campaigns are found; minus infinity where they are at any, plus infinity where at none.
fn least(mut order: Vec<(f64, bool)>) -> f64 {
    order.sort_by(|a, b| b.0.total_cmp(&a.0));
    let width = FEWEST.max((WINDOW * order.len() as f64).round() as usize);
    let enough = |window: &&[(f64, bool)]| {
        window.iter().filter(|(_, found)| *found).count() as f64 >= DETECTION_POWER * width as f64
    };
    // From the strongest on, as long as the neighbours in strength are found.
    match order.windows(width).take_while(enough).enumerate().last() {
        None => f64::INFINITY,
        Some((at, _)) if at + width == order.len() => f64::NEG_INFINITY,
        Some((_, window)) => window[width / 2].0,
    }
}

/// The 95 % interval of [`least`].
fn interval(strengths: &[(f64, bool)], stream: &mut Stream) -> [f64; 2] {
    let mut resample = || (0..strengths.len()).map(|_| strengths[stream.below(strengths.len())]).collect();
    let mut replicas: Vec<f64> = (0..REPLICATES).map(|_| least(resample())).collect();
    replicas.sort_by(f64::total_cmp);
    [replicas[BEYOND], replicas[REPLICATES - 1 - BEYOND]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Streams;
    use crate::random::standard_normal::{cdf, quantile};

    #[test]
    fn an_effect_is_detected_from_where_on_its_neighbours_are() {
        // Found above 1, for sure; below not at all.
        let shown = |found: &dyn Fn(f64) -> bool| -> Vec<(f64, bool)> {
            (0..400).map(|k| 0.01 * f64::from(k) - 2.0).map(|score| (score, found(score))).collect()
        };
        let of = |stronger, found: &dyn Fn(f64) -> bool| {
            detection_limits(3, stronger, &shown(found), &mut Streams::new(1, 0).of("caught"))
        };
        // Where a fifth of the window's 60 is no longer found the window's middle is 18 strengths above; resamples hold some of
        // them twice.
        let near = |own: &DetectionLimit, from: f64| {
            let DetectionLimit { score: Some(score), interval: [Some(low), Some(high)], .. } = *own else {
                return false;
            };
            let off = if own.below { from - score } else { score - from };
            (0.15..0.25).contains(&off) && low < score && score < high && high - low < 0.3
        };
        let up = of(Stronger::EitherWay, &|score| score > 1.0);
        assert!(matches!(&up[..], [own] if near(own, 1.0) && !own.below && own.parameter == 3), "{up:?}");
        let down = of(Stronger::EitherWay, &|score| score < -1.0);
        assert!(matches!(&down[..], [own] if near(own, -1.0) && own.below), "{down:?}");
        let both = of(Stronger::EitherWay, &|score| !(-1.3..=0.5).contains(&score));
        assert!(
            matches!(&both[..], [up, down] if near(up, 0.5) && !up.below && near(down, -1.3) && down.below),
            "{both:?}"
        );
        // Where an effect grows one way only, nothing is said of its weak end, chance as it may be that much is found there.
        let grows = |stronger| of(stronger, &|score| !(-1.3..=0.5).contains(&score));
        assert!(matches!(&grows(Stronger::Above)[..], [own] if near(own, 0.5) && !own.below));
        assert!(matches!(&grows(Stronger::Below)[..], [own] if near(own, -1.3) && own.below));
        assert_eq!(
            of(Stronger::EitherWay, &|_| true),
            [DetectionLimit { parameter: 3, score: None, interval: [None, None], below: false }]
        );
        assert_eq!(of(Stronger::EitherWay, &|_| false), []);
    }

    #[test]
    #[ignore = "slow: 20 s of processor time"]
    fn an_interval_holds_the_true_strength_nineteen_times_in_twenty() {
        // The probability to be found rises with the strength, more or less steeply, and is four in five there.
        let missed = |campaigns: usize, middle: f64, width: f64| {
            let from = middle + width * quantile(DETECTION_POWER);
            let misses = (0..150).filter(|&run| {
                let mut stream = Streams::new(9, run).of("campaigns");
                let shown: Vec<(f64, bool)> = (0..campaigns)
                    .map(|_| (quantile(stream.uniform()), stream.uniform()))
                    .map(|(score, chance)| (score, chance < cdf((score - middle) / width)))
                    .collect();
                let [low, high] = interval(&shown, &mut stream);
                !(low..=high).contains(&from)
            });
            misses.count()
        };
        for (campaigns, middle, width) in
            [(100, 0.0, 0.3), (100, -0.5, 0.6), (100, 0.8, 0.7), (400, -0.5, 0.6), (400, 0.0, 1.0)]
        {
            let missed = missed(campaigns, middle, width);
            println!("{campaigns} campaigns, {middle}, {width}: {missed} of 150");
            // Seven or eight are to be expected; 99.9 % of such counts are at most 17.
            assert!(missed <= 17, "{campaigns} campaigns, {middle}, {width}: {missed} of 150");
        }
    }

    #[test]
    fn what_campaigns_do_not_bound_has_an_open_end() {
        // Of 400 campaigns those above a score are found; a window is 60 wide, of which 48 must be.
        let of = |stronger, sign: f64, from: f64| {
            let scores = (0..400).map(|k| 0.01 * f64::from(k) - 2.0);
            let shown: Vec<(f64, bool)> = scores.map(|score| (sign * score, score > from)).collect();
            let all = detection_limits(0, stronger, &shown, &mut Streams::new(1, 0).of("caught"));
            assert_eq!(all.len(), 1);
            (all[0].score.is_some(), all[0].interval.map(|end| end.is_some()))
        };
        // 54 are found: many resamples hold fewer than 48 of them.
        assert_eq!(of(Stronger::Above, 1.0, 1.455), (true, [true, false]));
        assert_eq!(of(Stronger::Below, -1.0, 1.455), (true, [false, true]));
        // 15 are not: many resamples hold no more than 12 of them.
        assert_eq!(of(Stronger::Above, 1.0, -1.855), (true, [false, true]));
        assert_eq!(of(Stronger::Below, -1.0, -1.855), (true, [true, false]));
        // 8 are not: some resamples hold more than 12.
        assert_eq!(of(Stronger::Above, 1.0, -1.925), (false, [false, true]));
    }
}
