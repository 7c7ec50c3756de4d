//! Published statements judged one by one against our numbers.

use crate::math::{radians, sin};
use crate::render::number::{significant, stiffness};
use crate::stats::Estimate;
use crate::study::{Claim, ClaimTest};
use crate::verb::run::answer::comparison::{arm_names, at, of_arm, ratio};
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::standing::{Number, Standing, spread};

/// What our numbers say about a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds at every kn, and every number it rests on has an interval.
    Reproduced,
    /// At one kn at least our 95 % interval lies wholly against it.
    NotReproduced,
    /// Neither: a number or an interval is missing, or a value lies against it while its interval does not.
    CannotJudge,
}

impl Verdict {
    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Verdict::Reproduced => "reproduced",
            Verdict::NotReproduced => "not reproduced",
            Verdict::CannotJudge => "cannot be judged",
        }
    }
}

/// A published statement beside our numbers.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Published {
    /// The statement.
    pub claim: String,
    /// Where it stands.
    pub source: String,
    /// What our numbers say about it.
    pub verdict: Verdict,
    /// Our numbers: their range over kn and what their intervals span.
    pub ours: String,
    /// The value stated and what counts as reproduced.
    pub theirs: String,
    /// Why this verdict.
    pub why: String,
    /// Why the tolerance is what it is.
    pub tolerance: String,
}

/// Judges every claim about arms of this reading, in the order of the file.
pub fn judge_all(claims: &[Claim], populations: &[Population]) -> Vec<Published> {
    let arms = arm_names(populations);
    let here = |claim: &&Claim| claim.test.arms().into_iter().all(|arm| arms.iter().any(|a| a == arm));
    claims.iter().filter(here).map(|claim| judge(claim, populations)).collect()
}

/// Judges one claim.
pub fn judge(claim: &Claim, populations: &[Population]) -> Published {
    let evidence = match &claim.test {
        ClaimTest::RatioOfMeans { arm, over, stated, low, high } => {
            let numbers = ratios(populations, arm, over);
            let theirs = format!("{} (accepted: {})", significant(*stated, 3), accepted(*low, *high));
            Evidence::within(&numbers, *low, *high, theirs, &[arm, over])
        }
        ClaimTest::Cov { arm, stated, low, high } => {
            let numbers = covs(populations, arm);
            let theirs = format!("{stated} (accepted: {})", accepted(*low, *high));
            Evidence::within(&numbers, *low, *high, theirs, &[arm])
        }
        ClaimTest::RatioOfSines { arm, over, at_kn, stated, low, high } => {
            let numbers = ratios_of_sines(populations, arm, over, *at_kn);
            let theirs = format!("{} (accepted: {})", significant(*stated, 3), accepted(*low, *high));
            Evidence::within(&numbers, *low, *high, theirs, &[arm, over])
        }
        ClaimTest::Mean { arm, at_kn, stated, low, high } => {
            let numbers = means(populations, arm, *at_kn);
            let theirs = format!("{} (accepted: {})", significant(*stated, 3), accepted(*low, *high));
            Evidence::within(&numbers, *low, *high, theirs, &[arm])
        }
        ClaimTest::Mechanism { arm, stated, least_share, .. } => {
            let numbers = failing_so(populations, arm, &claim.test);
            let theirs = format!("{stated} (accepted: a share of the walls of {least_share} or more)");
            Evidence::within(&numbers, *least_share, 1.0, theirs, &[arm])
        }
        ClaimTest::Between { arm, of } => between(populations, arm, of),
        ClaimTest::FallsWithKn => along_kn(populations, Trend::Falls),
        ClaimTest::RisesWithKn => along_kn(populations, Trend::Rises),
    };
    let (verdict, mut why) = weigh(&evidence.standings);
    if let Some(remark) = lost_walls(populations, &evidence.arms) {
        why = format!("{why}; {remark}");
    }
    Published {
        claim: claim.claim.clone(),
        source: claim.source.clone(),
        verdict,
        ours: evidence.ours,
        theirs: evidence.theirs,
        why,
        tolerance: claim.why.clone(),
    }
}

/// What a verdict rests on.
struct Evidence {
    standings: Vec<Standing>,
    ours: String,
    theirs: String,
    arms: Vec<String>,
}

impl Evidence {
    fn within(numbers: &[Number], low: f64, high: f64, theirs: String, arms: &[&String]) -> Self {
        Evidence {
            standings: numbers.iter().map(|number| number.within(low, high)).collect(),
            ours: spread(numbers),
            theirs,
            arms: arms.iter().map(|arm| arm.to_string()).collect(),
        }
    }
}

fn accepted(low: f64, high: f64) -> String {
    format!("{} to {}", significant(low, 3), significant(high, 3))
}

/// The verdict that follows from how every number stands, with its reason: one refuted is enough against, one open
/// is enough to leave it open, and a statement about nothing cannot be judged.
fn weigh(standings: &[Standing]) -> (Verdict, String) {
    let refuted: Vec<&String> = standings
        .iter()
        .filter_map(|s| if let Standing::Refuted(why) = s { Some(why) } else { None })
        .collect();
    let open: Vec<&String> =
        standings.iter().filter_map(|s| if let Standing::Open(why) = s { Some(why) } else { None }).collect();
    let total = standings.len();
    if let Some(first) = refuted.first() {
        (
            Verdict::NotReproduced,
            format!("{first} (against the statement in {} of {total} comparisons)", refuted.len()),
        )
    } else if let Some(first) = open.first() {
        (Verdict::CannotJudge, format!("{first} (undecided in {} of {total} comparisons)", open.len()))
    } else if total == 0 {
        (Verdict::CannotJudge, "there is nothing in this study to compare it with".to_string())
    } else {
        (Verdict::Reproduced, format!("it holds in all of {total} comparisons"))
    }
}

/// Names the arms whose means leave walls out.
fn lost_walls(populations: &[Population], arms: &[String]) -> Option<String> {
    let parts: Vec<String> = arms
        .iter()
        .filter_map(|arm| {
            let own = of_arm(populations, arm);
            let lost: u64 = own.iter().map(|population| population.lost()).sum();
            let planned: u64 = own.iter().map(|population| population.planned).sum();
            (lost > 0).then(|| {
                format!("{lost} of {planned} analyses of arm {arm} failed and are not in these numbers")
            })
        })
        .collect();
    (!parts.is_empty()).then(|| parts.join("; "))
}

fn ratios(populations: &[Population], arm: &str, over: &str) -> Vec<Number> {
    of_arm(populations, arm)
        .into_iter()
        .filter_map(|above| {
            let ratio = ratio(above, at(populations, over, above.kn)?);
            Some(Number::at(above.kn, ratio.value, ratio.interval))
        })
        .collect()
}

/// The means of an arm with their intervals; the value itself where nothing is random.
fn means(populations: &[Population], arm: &str, at_kn: Option<f64>) -> Vec<Number> {
    let meant = of_arm(populations, arm).into_iter().filter(|p| at_kn.is_none_or(|kn| p.kn == kn));
    meant
        .map(|population| {
            let mean = population.sample().summary().mean;
            let exact = mean.value.filter(|_| population.fixed).map(|value| [value, value]);
            Number::at(population.kn, mean.value, exact.or(mean.interval))
        })
        .collect()
}

/// Sine of the one mean angle over sine of the other; its interval spans the ends of both means' intervals, which errs on the
/// wide side.
fn ratios_of_sines(populations: &[Population], arm: &str, over: &str, at_kn: Option<f64>) -> Vec<Number> {
    let sine = |angle_deg: f64| sin(radians(angle_deg));
    let below = means(populations, over, at_kn);
    means(populations, arm, at_kn)
        .into_iter()
        .filter_map(|above| {
            let below = below.iter().find(|number| number.place == above.place)?;
            let value = above.value.zip(below.value).map(|(a, b)| sine(a) / sine(b));
            let interval = above.interval.zip(below.interval);
            let interval = interval.map(|([a, b], [c, d])| [sine(a) / sine(d), sine(b) / sine(c)]);
            Some(Number { place: above.place, value, interval })
        })
        .collect()
}

/// The share of an arm's fallen walls whose mechanism is as stated, with its interval.
fn failing_so(populations: &[Population], arm: &str, test: &ClaimTest) -> Vec<Number> {
    let share = |population: &Population| {
        let own = population.stated.iter().find(|(own, _)| own == test);
        crate::check!(own.is_some(), "the walls of arm {arm} were not watched for a statement about them");
        let Estimate { value, interval } = own.map_or(Estimate::UNDEFINED, |(_, trials)| trials.share());
        let interval = if population.fixed { value.map(|value| [value, value]) } else { interval };
        Number::at(population.kn, value, interval)
    };
    of_arm(populations, arm).into_iter().map(share).collect()
}

fn covs(populations: &[Population], arm: &str) -> Vec<Number> {
    of_arm(populations, arm)
        .into_iter()
        .map(|population| {
            let cov = population.sample().summary().cov;
            Number::at(population.kn, cov.value, cov.interval)
        })
        .collect()
}

/// The mean of an arm lies between two others where the interval of its ratio to the one lies below one and that to
/// the other above. Refuted where both intervals lie on the same side of one; open where one of them reaches over it.
fn between(populations: &[Population], arm: &str, of: &[String; 2]) -> Evidence {
    let first = ratios(populations, arm, &of[0]);
    let second = ratios(populations, arm, &of[1]);
    let standings = first.iter().zip(&second).map(|(p, q)| between_at(p, q, of)).collect();
    Evidence {
        standings,
        ours: format!(
            "mean over that of {}: {}; over that of {}: {}",
            of[0],
            spread(&first),
            of[1],
            spread(&second)
        ),
        theirs: format!("mean between those of {} and {}", of[0], of[1]),
        arms: vec![arm.to_string(), of[0].clone(), of[1].clone()],
    }
}

fn between_at(p: &Number, q: &Number, of: &[String; 2]) -> Standing {
    let (Some(x), Some(y)) = (p.value, q.value) else {
        return Standing::Open(if p.value.is_none() { p.missing() } else { q.missing() });
    };
    let (Some([p_low, p_high]), Some([q_low, q_high])) = (p.interval, q.interval) else {
        return Standing::Open(if p.interval.is_none() { p.missing() } else { q.missing() });
    };
    let words = format!(
        "at {} ours is {} times that of {} and {} times that of {}",
        p.place,
        significant(x, 3),
        of[0],
        significant(y, 3),
        of[1]
    );
    if (p_high < 1.0 && q_low > 1.0) || (p_low > 1.0 && q_high < 1.0) {
        Standing::Holds
    } else if (p_low >= 1.0 && q_low >= 1.0) || (p_high <= 1.0 && q_high <= 1.0) {
        Standing::Refuted(format!("{words}, both on one side beyond their intervals"))
    } else {
        Standing::Open(format!("{words}, and an interval reaches over 1"))
    }
}

/// Where a mean goes as kn grows.
#[derive(Clone, Copy)]
enum Trend {
    Falls,
    Rises,
}

/// The mean of every arm falls (rises) from each kn to the next: the ratio of neighbouring means, wall by wall and smaller
/// over larger as stated, is below one.
fn along_kn(populations: &[Population], trend: Trend) -> Evidence {
    let mut numbers = Vec::new();
    let arms = arm_names(populations);
    for arm in &arms {
        for pair in of_arm(populations, arm).windows(2) {
            let ratio = match trend {
                Trend::Falls => ratio(pair[1], pair[0]),
                Trend::Rises => ratio(pair[0], pair[1]),
            };
            let place = format!("kn = {} to {} in arm {arm}", stiffness(pair[0].kn), stiffness(pair[1].kn));
            numbers.push(Number { place, value: ratio.value, interval: ratio.interval });
        }
    }
    let (ours, theirs) = match trend {
        Trend::Falls => ("lower", "falls"),
        Trend::Rises => ("higher", "rises"),
    };
    Evidence {
        standings: numbers.iter().map(Number::below_one).collect(),
        ours: format!("mean over the mean at the next {ours} kn: {}", spread(&numbers)),
        theirs: format!("the mean of every arm {theirs} as kn grows (every ratio below 1)"),
        arms,
    }
}
