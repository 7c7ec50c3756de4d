//! How often diagnoses of a design find and name what is hidden, by simulation from the bank; which causes it cannot tell apart,
//! and how large an effect must be to be detected.

use std::collections::BTreeMap;
use std::iter::Sum;

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use crate::critic::advise::detection_limit::{DetectionLimit, detection_limits};
use crate::critic::simulate::{Campaign, Truth};
use crate::critic::verdict::{Diagnosis, Finding, Judge, Limits, Verdict};
use crate::random::Streams;
use crate::stats;
use crate::study::Described;

/// Two causes are confused where so large a share of the sets of either hold the other.
const CONFUSED: f64 = 0.5;
/// So many times as many campaigns without any effect, and with unmodelled ones, are judged by the whole diagnosis.
const MORE: u64 = 5;

/// How often diagnoses of a design find and name what is hidden, by simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelfTest {
    /// For the base model (first) and each cause.
    pub rows: Vec<SelfTestRow>,
    /// Campaigns of [unmodelled](crate::critic::World::unmodelled) effects, by the ranking alone, and some of them by the whole
    /// diagnosis: any name is a wrong one.
    #[serde(rename = "nameless")]
    pub unmodelled: [Counted; 2],
}

/// A line of the self-test.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelfTestRow {
    /// What was hidden; none where nothing was.
    pub cause: Option<usize>,
    /// Campaigns, by the ranking alone.
    pub all: Counted,
    /// The third of them in which the cause moves most of what is read; none where nothing was hidden.
    pub strong: Counted,
    /// Some of them by the whole diagnosis: with the evidence, the check and pairs.
    pub judged: Counted,
    /// Of these in which the cause is named, on other joints than it acts on.
    #[serde(default)]
    pub wrong_scope: u64,
    /// Of those found, whose set holds the cause.
    pub covered: u64,
    /// Mean number of causes in the sets of those found.
    pub set_size: f64,
    /// Of those found, in how many sets each cause is.
    pub with: BTreeMap<usize, u64>,
    /// From where on its first parameter that matters is detected, if it acts on all joints alike: upwards, downwards or both; empty
    /// where no strength within the prior is.
    #[serde(rename = "caught")]
    pub detection_limits: Vec<DetectionLimit>,
}

/// What was said of campaigns.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counted {
    /// How many there were.
    pub campaigns: u64,
    /// In which something was found.
    pub found: u64,
    /// In which the cause was named.
    pub named: u64,
    /// In which another one was.
    pub misnamed: u64,
}

/// A campaign of the self-test.
struct Tested {
    truth: Truth,
    campaign: Campaign,
    finding: Finding,
    /// How far the cause moved what is read: root of the sum of squares, in standard deviations of the base model's readings.
    moved: f64,
}

impl Judge<'_> {
    /// Judges `count` campaigns of every cause and of the base model, drawn from the priors with another seed than the training's,
    /// by the ranking alone, and as many of unmodelled effects; of these `judged` of each cause, and five times as many of the
    /// base model and of unmodelled effects, by the whole diagnosis.
    pub fn self_test(&self, limits: &Limits, count: u64, judged: u64, seed: u64) -> SelfTest {
        let row = |cause: &Option<usize>| {
            let campaigns: Vec<Tested> =
                (0..count).into_par_iter().map(|k| self.tested(*cause, seed, k)).collect();
            let judged = if cause.is_none() { MORE * judged } else { judged };
            let whole = campaigns.par_iter().take(judged as usize);
            let verdict = |tested: &Tested| {
                let diagnosis = self.diagnosed(&tested.campaign, limits, judging(seed));
                let is_wrong_scope =
                    cause.is_some_and(|cause| has_wrong_scope(&diagnosis, cause, &tested.truth));
                (diagnosis.verdict, is_wrong_scope)
            };
            let verdicts: Vec<(Verdict, bool)> = whole.map(verdict).collect();
            let mechanism = cause.map(|cause| &self.world.mechanisms()[cause]);
            row(*cause, mechanism, &campaigns, &verdicts, limits, seed)
        };
        let rows = self.ranking.causes().par_iter().map(row).collect();
        SelfTest { rows, unmodelled: self.unmodelled_test(limits, count, MORE * judged, seed) }
    }

    /// What is said of campaigns of unmodelled effects, by the ranking alone and of some by the whole diagnosis.
    fn unmodelled_test(&self, limits: &Limits, count: u64, judged: u64, seed: u64) -> [Counted; 2] {
        let campaigns: Vec<Campaign> =
            (0..count).map(|k| self.world.unmodelled(&self.design, &Streams::new(seed, k))).collect();
        let by_ranking = |campaign: &Campaign| said(&self.compare(campaign), limits);
        let ranked: Vec<Option<Vec<usize>>> = campaigns.par_iter().map(by_ranking).collect();
        let whole = campaigns.par_iter().take(judged as usize);
        let judged: Vec<Option<Vec<usize>>> =
            whole.map(|campaign| named(&self.diagnosed(campaign, limits, judging(seed)).verdict)).collect();
        [ranked, judged].map(|said| Counted::of(None, said.into_iter()))
    }

    /// What is said of a campaign of a cause, by the whole diagnosis: a fingerprint of a judge.
    pub fn said_of(&self, cause: Option<usize>, limits: &Limits, seed: u64, number: u64) -> Diagnosis {
        let tested = self.tested(cause, seed, number);
        self.diagnosed(&tested.campaign, limits, judging(seed))
    }

    fn tested(&self, cause: Option<usize>, seed: u64, number: u64) -> Tested {
        let streams = Streams::new(seed, number);
        let truth = self.world.drawn(self.world.scoped(cause, &streams), &streams);
        let campaign = self.world.campaign(&self.design, &truth, &streams);
        let finding = self.compare(&campaign);
        let moved = cause.map_or(0.0, |_| self.moved(&truth, &campaign, &streams));
        Tested { truth, campaign, finding, moved }
    }

    /// How far what is read in a campaign of a truth is from that of the same stones, joints and errors without any cause.
    fn moved(&self, truth: &Truth, campaign: &Campaign, streams: &Streams) -> f64 {
        let still = self.world.campaign(&self.design, &truth.still(), streams);
        let read = |campaign: &Campaign| self.reference.scale.readings(&self.design, campaign);
        let both = read(campaign).into_iter().zip(read(&still));
        let squares = both.filter_map(|((_, own), (_, still))| Some((own? - still?) * (own? - still?)));
        squares.fold(0.0, |sum, square| sum + square).sqrt()
    }
}

/// Seed of the judging of campaigns that were drawn with another: the check simulates some of its own, and one of these would
/// otherwise be the very campaign that it checks.
fn judging(seed: u64) -> u64 {
    seed.wrapping_add(1)
}

impl Counted {
    /// Of campaigns of a cause: what was named in each, nothing found where that is none.
    fn of(cause: Option<usize>, said: impl Iterator<Item = Option<Vec<usize>>>) -> Counted {
        said.fold(Counted::default(), |sum, said| {
            let names = said.as_deref().unwrap_or_default();
            let named = cause.is_some_and(|cause| names.contains(&cause));
            Counted {
                campaigns: sum.campaigns + 1,
                found: sum.found + u64::from(said.is_some()),
                named: sum.named + u64::from(named),
                misnamed: sum.misnamed + u64::from(!named && !names.is_empty()),
            }
        })
    }
}

impl Sum for Counted {
    fn sum<I: Iterator<Item = Counted>>(all: I) -> Counted {
        all.fold(Counted::default(), |sum, own| Counted {
            campaigns: sum.campaigns + own.campaigns,
            found: sum.found + own.found,
            named: sum.named + own.named,
            misnamed: sum.misnamed + own.misnamed,
        })
    }
}

/// Whether a cause is named that acts on other joints in truth, or by parameters that kinds of joint share where they do not.
fn has_wrong_scope(diagnosis: &Diagnosis, cause: usize, truth: &Truth) -> bool {
    let explained = diagnosis.explained_by();
    let (true, Some((_, draws))) = (diagnosis.verdict.named().contains(&cause), explained.first()) else {
        return false;
    };
    let scope = |truth: &Truth| truth.causes.scoped().find(|(acting, _)| *acting == cause);
    draws.first().is_some_and(|draw| scope(draw) != scope(truth))
}

/// What would be named by the ranking alone; none where nothing is found.
fn said(finding: &Finding, limits: &Limits) -> Option<Vec<usize>> {
    (finding.p_value < limits.found).then(|| finding.named(limits).into_iter().collect())
}

/// What a verdict names; none where nothing was found.
fn named(verdict: &Verdict) -> Option<Vec<usize>> {
    match verdict {
        Verdict::NothingFound => None,
        Verdict::Named(_) | Verdict::NamedOutsidePrior(_) | Verdict::NamedPair(_) => {
            Some(verdict.causes().to_vec())
        }
        Verdict::Ambiguous(_) | Verdict::Unexplained => Some(Vec::new()),
    }
}

fn row(
    cause: Option<usize>,
    mechanism: Option<&Described>,
    campaigns: &[Tested],
    verdicts: &[(Verdict, bool)],
    limits: &Limits,
    seed: u64,
) -> SelfTestRow {
    let is_found = |tested: &&Tested| tested.finding.p_value < limits.found;
    let found: Vec<&Tested> = campaigns.iter().filter(is_found).collect();
    let by_ranking = |tested: &&Tested| said(&tested.finding, limits);
    let mut by_size: Vec<&Tested> = campaigns.iter().collect();
    by_size.sort_by(|a, b| b.moved.total_cmp(&a.moved));
    let strong = &by_size[..if cause.is_some() { campaigns.len() / 3 } else { 0 }];
    let sizes: Vec<f64> = found.iter().map(|tested| tested.finding.ranked.set.len() as f64).collect();
    let mut with: BTreeMap<usize, u64> = BTreeMap::new();
    found
        .iter()
        .flat_map(|tested| &tested.finding.ranked.set)
        .for_each(|cause| *with.entry(*cause).or_default() += 1);
    let shown = |parameter: usize| -> Vec<(f64, bool)> {
        // A strength is one number where the cause acts on all joints alike.
        let alike = campaigns.iter().filter(|tested| tested.truth.causes == cause.into());
        alike.map(|tested| (tested.truth.parameters[parameter], is_found(&tested))).collect()
    };
    let parameters = mechanism.iter().flat_map(|own| own.parameters.iter().map(|p| own.stronger(p.key)));
    // The name of the stream is part of every draw.
    let mut stream = Streams::new(seed, 0).of(&format!("caught {cause:?}"));
    let mut detection_limits = parameters
        .enumerate()
        .map(|(parameter, stronger)| detection_limits(parameter, stronger, &shown(parameter), &mut stream));
    SelfTestRow {
        cause,
        all: Counted::of(cause, by_size.iter().map(by_ranking)),
        strong: Counted::of(cause, strong.iter().map(by_ranking)),
        judged: Counted::of(cause, verdicts.iter().map(|(verdict, _)| named(verdict))),
        wrong_scope: verdicts.iter().filter(|(_, is_wrong_scope)| *is_wrong_scope).count() as u64,
        covered: cause.map_or(0, |cause| with.get(&cause).copied().unwrap_or(0)),
        set_size: stats::mean(&sizes).unwrap_or(0.0),
        with,
        detection_limits: detection_limits.find(|own| !own.is_empty()).unwrap_or_default(),
    }
}

impl SelfTest {
    /// Whether its counts can be counts: of a file that was changed they may be anything.
    pub fn is_sound(&self) -> bool {
        let rows = self.rows.iter().flat_map(|row| [row.all, row.strong, row.judged]);
        let scopes = self.rows.iter().all(|row| row.wrong_scope <= row.judged.named);
        scopes
            && rows.chain(self.unmodelled).all(|own| own.found.max(own.named + own.misnamed) <= own.campaigns)
    }

    /// Causes that the design cannot tell apart, in classes of two or more; `found` is the least share of campaigns in which a
    /// cause must be found to be in one.
    pub fn classes(&self, found: f64) -> Vec<Vec<usize>> {
        let seen: Vec<&SelfTestRow> = self
            .rows
            .iter()
            .filter(|row| {
                row.cause.is_some()
                    && row.all.found as f64 >= found * row.all.campaigns as f64
                    && row.all.found > 0
            })
            .collect();
        let holds = |row: &SelfTestRow, other: &SelfTestRow| {
            let both = other.cause.and_then(|other| row.with.get(&other)).copied().unwrap_or(0);
            both as f64 / row.all.found as f64
        };
        let mut classes: Vec<Vec<&SelfTestRow>> = Vec::new();
        for row in seen {
            let confused = |class: &Vec<&SelfTestRow>| {
                class.iter().any(|other| holds(row, other) >= CONFUSED && holds(other, row) >= CONFUSED)
            };
            let (mut joined, apart): (Vec<_>, Vec<_>) = classes.into_iter().partition(confused);
            let mut class = joined.drain(..).flatten().collect::<Vec<_>>();
            class.push(row);
            classes = apart;
            classes.push(class);
        }
        let mut classes: Vec<Vec<usize>> =
            classes.into_iter().map(|class| class.iter().filter_map(|row| row.cause).collect()).collect();
        classes.retain(|class: &Vec<usize>| class.len() > 1);
        classes.iter_mut().for_each(|class| class.sort_unstable());
        classes.sort();
        classes
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::causes::Ranked;
    use crate::critic::discrepancy::Discrepancy;
    use crate::critic::simulate::{Causes, Scope};
    use crate::critic::verdict::Examined;

    #[test]
    fn a_name_on_other_joints_than_the_cause_acts_on_has_the_wrong_scope() {
        let truth = |scope: Scope| Truth {
            causes: Causes::one(3, scope),
            parameters: Vec::new(),
            joints: Vec::new(),
            scatter: 0.0,
        };
        let discrepancy = Discrepancy { excess: BTreeMap::new(), joints: Vec::new(), distance: 0.0 };
        let ranked = Ranked::new(vec![(Some(3), 1.0)], 0.0, vec![3]);
        let own = Examined {
            cause: 3,
            acting: Causes::one(3, Scope::Kind(1)),
            scope_share: 1.0,
            log: 0.0,
            spread: 0.0,
            check: None,
            conflict: None,
            evidence: 1.0,
            draws: vec![truth(Scope::Kind(1))],
        };
        let mut diagnosis = Diagnosis {
            finding: Finding { discrepancy, ranked, p_value: 0.001, p_by_statistic: [0.001; 3] },
            examined: vec![own],
            pairs: Vec::new(),
            outside: None,
            components: Vec::new(),
            verdict: Verdict::Named(3),
        };
        let is_wrong = |diagnosis: &Diagnosis, scope: Scope| has_wrong_scope(diagnosis, 3, &truth(scope));
        assert!(!is_wrong(&diagnosis, Scope::Kind(1)));
        assert!([Scope::All, Scope::Each, Scope::Kind(0)].iter().all(|scope| is_wrong(&diagnosis, *scope)));
        diagnosis.verdict = Verdict::Ambiguous(vec![3]);
        assert!(!is_wrong(&diagnosis, Scope::All));
    }

    #[test]
    fn causes_in_each_others_sets_make_a_class() {
        let row = |cause: usize, found: u64, with: &[(usize, u64)]| SelfTestRow {
            cause: Some(cause),
            all: Counted { campaigns: 100, found, named: 0, misnamed: 0 },
            strong: Counted::default(),
            judged: Counted::default(),
            wrong_scope: 0,
            covered: 0,
            set_size: 0.0,
            with: with.iter().copied().collect(),
            detection_limits: Vec::new(),
        };
        // 1 and 2 look like each other, 3 like nothing; 4 looks like 1, but is never found.
        let test = SelfTest {
            unmodelled: [Counted::default(); 2],
            rows: vec![
                row(1, 80, &[(1, 80), (2, 60)]),
                row(2, 50, &[(1, 30), (2, 50)]),
                row(3, 90, &[(3, 90), (1, 20)]),
                row(4, 5, &[(1, 5)]),
            ],
        };
        assert_eq!(test.classes(0.2), [[1, 2]]);
    }
}
