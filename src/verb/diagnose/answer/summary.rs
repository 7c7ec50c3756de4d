//! A diagnosis as `verdict.json` holds it.

use std::collections::BTreeMap;
use std::path::Path;

use crate::critic::{
    Contrast, Counted, Design, Diagnosis, Effort, Excluded, Feature, Residuals, SelfTest, Unused, Verdict,
    World,
};
use crate::study::{MeasuredQuantity, Study};
use crate::verb::diagnose::advice::Advice;
use crate::verb::diagnose::answer::components::ComponentEntry;
use crate::verb::diagnose::answer::parameter::{ParameterEntry, parameters};
use crate::verb::diagnose::answer::residual::{GroupEntry, ResidualEntry};
use crate::verb::diagnose::answer::scope::ScopeEntry;
use crate::verb::diagnose::gain::GainSummary;

/// A diagnosis in the units and words of files.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct DiagnosisSummary {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// Seed of all random streams.
    pub seed: u64,
    /// Hash of the design of the bank.
    pub bank: String,
    /// What was measured; null where it is part of the study in memory.
    pub measured: Option<DataEntry>,
    /// named, named_outside_prior, ambiguous, unexplained or nothing_found.
    pub verdict: &'static str,
    /// The causes that the verdict speaks of, then all others; probabilities when all are equally likely beforehand.
    pub causes: Vec<CauseEntry>,
    /// Pairs of causes that were examined because no one explains the discrepancy, that with most of the evidence first.
    pub pairs: Vec<PairEntry>,
    /// Probability of the base model among them.
    pub base_probability: f64,
    /// Probability of something that is in no catalogue, as likely beforehand as one of them.
    pub nameless_probability: f64,
    /// By how much the logarithm of its evidence, that of a smooth discrepancy, exceeds the largest of the base model's and of the causes
    /// examined; `None` where nothing was found.
    pub nameless_log_evidence: Option<f64>,
    /// Share of campaigns without any effect in which something is as far off.
    pub p_value: f64,
    /// How many such campaigns were simulated to tell.
    pub p_value_campaigns: u64,
    /// The same by each statistic alone.
    pub looks: LooksEntry,
    /// What is off, the furthest first.
    pub off: Vec<OffEntry>,
    /// Reading by reading, how far it lies from walls with joints as uncertain as their priors.
    pub residuals: Vec<ResidualEntry>,
    /// The same of the means over the specimens, by family, quantity and tilt.
    pub groups: Vec<GroupEntry>,
    /// Where the base model with fitted joints surely misses something that is smooth over the tilt or the drift.
    pub form: Vec<ComponentEntry>,
    /// What was not used of the measurements.
    pub unused: Vec<UnusedEntry>,
    /// What looks odd about the measurements and was judged all the same.
    pub notes: Vec<String>,
    /// How reliable verdicts on such data are.
    pub self_test: Vec<SelfTestEntry>,
    /// The same where something is off that is in no catalogue: any name is a wrong one.
    pub self_test_nameless: UnmodelledEntry,
    /// What the data cannot tell, and what would.
    pub advice: Advice,
    /// Folders of the extended studies, beside this file: one for each cause that the verdict speaks of, or for its pair.
    pub extended: Vec<String>,
    /// What the extended model gains on readings that were not known; null where it was not asked or nothing was found.
    pub gain: Option<GainSummary>,
}

/// A file of measurements.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct DataEntry {
    /// Its name, without its folder.
    pub file: String,
    /// Hash of its bytes.
    pub sha256: String,
}

impl DataEntry {
    /// Of a file's path and hash.
    pub fn of(path: &Path, sha256: &str) -> DataEntry {
        let file = path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned());
        DataEntry { file, sha256: sha256.to_owned() }
    }
}

/// Shares of campaigns without any effect that are as far off, by each statistic.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct LooksEntry {
    /// By the number that is furthest off.
    pub furthest: f64,
    /// By how far all numbers are off together.
    pub together: f64,
    /// By how much it looks like a cause, or like something that is in no catalogue.
    pub likeness: f64,
}

/// A cause.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CauseEntry {
    /// Name of the mechanism.
    pub id: &'static str,
    /// Its name in plain words.
    pub title: &'static str,
    /// What would be true of the wall or of the test.
    pub means: &'static str,
    /// Its probability.
    pub probability: f64,
    /// Its share of the evidence of the causes that were examined and of the base model; null for the others.
    pub evidence: Option<f64>,
    /// By how much the logarithm of its evidence exceeds that of the base model; null for those that were not examined.
    pub log_evidence: Option<f64>,
    /// Standard error of the logarithm of its evidence: what differs by less than two of them is not ranked.
    pub log_evidence_spread: Option<f64>,
    /// Whether the verdict speaks of it.
    pub in_verdict: bool,
    /// What speaks against it: `readings` where it fits them worse than nearly all campaigns that it predicts, `looks` where nine in
    /// ten of its campaigns look more like it, `evidence` where that leaves it hardly any probability; null where nothing does.
    pub excluded_by: Option<&'static str>,
    /// Share of the campaigns that it predicts which fit the readings no better; null where it was not checked.
    pub guard_p_value: Option<f64>,
    /// Share of the campaigns that its physical prior predicts which are as far out, along what the data pin down; null where the
    /// verdict does not speak of it.
    pub conflict_p_value: Option<f64>,
    /// On which joints it acts, as the readings make likeliest; null where that is on all alike, or where it was not examined.
    pub scope: Option<ScopeEntry>,
    /// Its parameters with this scope, as far as the data tell them; empty where it was not examined.
    pub parameters: Vec<ParameterEntry>,
}

impl CauseEntry {
    /// What would be true, and of which joints, where that is not all.
    pub(crate) fn meaning(&self) -> String {
        let joints = self.scope.as_ref().map_or_else(String::new, |scope| format!(" ({})", scope.words));
        format!("{}{joints}", self.means)
    }
}

/// Lines of the measurements that were not used.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct UnusedEntry {
    /// The lines.
    pub lines: Vec<usize>,
    /// Why, in words.
    pub why: &'static str,
}

/// Two causes together.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct PairEntry {
    /// Names of the mechanisms.
    pub ids: [&'static str; 2],
    /// On which joints each acts, as the readings make likeliest; null where that is on all alike.
    pub scopes: [Option<ScopeEntry>; 2],
    /// Share of the evidence of all pairs, of the causes that were examined and of the base model.
    pub evidence: f64,
    /// Whether the verdict names the pair.
    pub in_verdict: bool,
    /// Share of the campaigns that it predicts which fit the readings no better; null where it was not checked.
    pub guard_p_value: Option<f64>,
    /// Share of the campaigns that the physical priors of both predict which are as far out; null where the verdict does not name it.
    pub conflict_p_value: Option<f64>,
}

/// Something that is off.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct OffEntry {
    /// What, in words.
    pub what: String,
    /// Measured less simulated, in standard deviations of campaigns without any effect.
    pub in_sd: f64,
}

/// What the self-test says of effects that are in no catalogue.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct UnmodelledEntry {
    /// Campaigns, by the ranking alone: before evidence and check.
    #[serde(flatten)]
    pub all: Counted,
    /// Some of them by the whole diagnosis.
    pub judged: Counted,
}

/// A line of the self-test.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SelfTestEntry {
    /// What was hidden; "nothing" where nothing was.
    pub hidden: &'static str,
    /// Campaigns, by the ranking alone: before evidence and check.
    #[serde(flatten)]
    pub all: Counted,
    /// The third of them that the cause moves most.
    pub strong: Counted,
    /// Some of them by the whole diagnosis.
    pub judged: Counted,
    /// Of these in which the cause is named, on other joints than it acts on.
    pub wrong_scope: u64,
}

impl DiagnosisSummary {
    /// From a diagnosis.
    pub fn of(
        world: &World<'_>,
        seed: u64,
        bank: &str,
        design: &Design,
        diagnosis: &Diagnosis,
        self_test: &SelfTest,
    ) -> DiagnosisSummary {
        let (study, mechanisms) = (world.study(), world.mechanisms());
        let (verdict, spoken): (&'static str, Vec<usize>) = match &diagnosis.verdict {
            Verdict::NothingFound => ("nothing_found", Vec::new()),
            Verdict::Named(cause) => ("named", vec![*cause]),
            Verdict::NamedOutsidePrior(cause) => ("named_outside_prior", vec![*cause]),
            Verdict::NamedPair(causes) => ("named", causes.to_vec()),
            Verdict::Ambiguous(causes) => ("ambiguous", causes.clone()),
            Verdict::Unexplained => ("unexplained", Vec::new()),
        };
        let explained = diagnosis.explained_by();
        let drawn = |cause: usize| {
            let spoken = explained.iter().find(|(causes, _)| causes.contains(&cause));
            let examined = || diagnosis.examined(cause).map(|own| &own.draws[..]);
            spoken.map(|(_, draws)| *draws).or_else(examined).unwrap_or_default()
        };
        let pairs = diagnosis.pairs.iter().map(|own| PairEntry {
            ids: own.cause.map(|cause| mechanisms[cause].name),
            scopes: own.cause.map(|cause| ScopeEntry::of(world, cause, own.acting, own.scope_share)),
            evidence: own.evidence,
            in_verdict: diagnosis.verdict == Verdict::NamedPair(own.cause),
            guard_p_value: own.check,
            conflict_p_value: own.conflict,
        });
        let ranked = &diagnosis.finding.ranked;
        let mut causes: Vec<CauseEntry> = ranked
            .causes
            .iter()
            .filter_map(|&(cause, probability)| {
                let cause = cause?;
                let (examined, draws) = (diagnosis.examined(cause), drawn(cause));
                let share = examined.map_or(1.0, |own| own.scope_share);
                Some(CauseEntry {
                    id: mechanisms[cause].name,
                    title: mechanisms[cause].title,
                    means: mechanisms[cause].means,
                    probability,
                    evidence: examined.map(|own| own.evidence),
                    log_evidence: examined.map(|own| own.log),
                    log_evidence_spread: examined.map(|own| own.spread),
                    in_verdict: spoken.contains(&cause),
                    excluded_by: diagnosis.excluded(cause).map(|by| match by {
                        Excluded::ByCheck => "readings",
                        Excluded::ByRanking => "looks",
                        Excluded::ByEvidence => "evidence",
                    }),
                    guard_p_value: examined.and_then(|own| own.check),
                    conflict_p_value: examined.and_then(|own| own.conflict),
                    scope: draws.first().and_then(|truth| ScopeEntry::of(world, cause, truth.causes, share)),
                    parameters: parameters(world, cause, draws),
                })
            })
            .collect();
        causes.sort_by_key(|cause| !cause.in_verdict);
        let mut off: Vec<OffEntry> = diagnosis
            .finding
            .discrepancy
            .excess
            .iter()
            .filter_map(|(feature, excess)| {
                Some(OffEntry { what: words(study, *feature), in_sd: (*excess)? })
            })
            .collect();
        off.sort_by(|a, b| b.in_sd.abs().total_cmp(&a.in_sd.abs()));
        let base = ranked.causes.iter().find(|(cause, _)| cause.is_none());
        let [furthest, together, likeness] = diagnosis.finding.p_by_statistic;
        let tested = self_test.rows.iter().map(|row| SelfTestEntry {
            hidden: row.cause.map_or("nothing", |cause| mechanisms[cause].name),
            all: row.all,
            strong: row.strong,
            judged: row.judged,
            wrong_scope: row.wrong_scope,
        });
        DiagnosisSummary {
            study: study.name.clone(),
            variant: study.variant.clone(),
            seed,
            bank: bank.to_string(),
            measured: None,
            verdict,
            causes,
            pairs: pairs.collect(),
            base_probability: base.map_or(0.0, |(_, probability)| *probability),
            nameless_probability: ranked.unmodelled,
            nameless_log_evidence: diagnosis.outside,
            p_value: diagnosis.finding.p_value,
            p_value_campaigns: Effort::default().reference,
            looks: LooksEntry { furthest, together, likeness },
            off,
            residuals: Vec::new(),
            groups: Vec::new(),
            form: diagnosis.components.iter().filter_map(|own| ComponentEntry::of(study, own)).collect(),
            unused: unused(design),
            notes: Vec::new(),
            self_test: tested.collect(),
            self_test_nameless: UnmodelledEntry {
                all: self_test.unmodelled[0],
                judged: self_test.unmodelled[1],
            },
            advice: Advice::default(),
            extended: Vec::new(),
            gain: None,
        }
    }

    /// With how far readings and groups lie from the base model.
    pub fn beside(mut self, study: &Study, residuals: &Residuals) -> DiagnosisSummary {
        self.residuals = residuals.readings.iter().map(|r| ResidualEntry::of(study, r)).collect();
        self.groups = residuals.groups.iter().map(|group| GroupEntry::of(study, group)).collect();
        self
    }
}

/// What was not used, reason by reason.
fn unused(design: &Design) -> Vec<UnusedEntry> {
    let mut by_reason: BTreeMap<Unused, Vec<usize>> = BTreeMap::new();
    design.unused.iter().for_each(|(why, line)| by_reason.entry(*why).or_default().push(*line));
    let entry = |(why, lines): (Unused, Vec<usize>)| UnusedEntry {
        lines,
        why: match why {
            Unused::NotEvaluated => "an arm that the study does not evaluate here",
            Unused::BlockWeight => "the weight of a single block",
            Unused::AtLevel => "a displacement at 0 deg, from where displacements count",
            Unused::Again => "read at a tilt that the wall had come to before",
            Unused::OtherTest => "read in another kind of test than the study's, or on the way along x-",
        },
    };
    by_reason.into_iter().map(entry).collect()
}

fn words(study: &Study, feature: Feature) -> String {
    let family = |arm: usize| &study.arms[arm].name;
    let is_sheared = !study.drifts().is_empty();
    let is_shaken = study.earthquakes.is_some();
    let of = |contrast| match contrast {
        Contrast::Collapse if is_shaken => "motions that were withstood",
        Contrast::Level if is_shaken => "displacements under motions",
        Contrast::Growth if is_shaken => "change from the first motion to the last",
        Contrast::Left if is_shaken => "what is left of displacements after motions",
        Contrast::Level if is_sheared => "push as a whole",
        Contrast::Growth if is_sheared => "growth of the push with the drift",
        Contrast::Curvature if is_sheared => "curvature of the push over the drift",
        Contrast::Jump if is_sheared => "largest jump of the push from one drift to the next",
        Contrast::Collapse => "collapse angle",
        Contrast::Level => "displacements as a whole",
        Contrast::Growth => "growth of the displacements with the tilt",
        Contrast::Curvature => "curvature of the displacements over the tilt",
        Contrast::Bow => "centre against the ends",
        Contrast::Twist => "left against right",
        Contrast::Left => "what is left after going back",
        Contrast::LeftBow => "centre against the ends after going back",
        Contrast::Jump => "largest jump of the displacements from one tilt to the next",
        Contrast::Slowing => "slowing down",
        Contrast::Reached => "share of the readings that were reached",
    };
    match feature {
        Feature::Mean(arm, contrast) => format!("{}: {}", family(arm), of(contrast)),
        Feature::Scatter(arm, contrast) => {
            format!("{}: scatter of the {} between specimens", family(arm), of(contrast))
        }
        Feature::Order(contrast) => format!("{} over the order of the tests", of(contrast)),
        Feature::Restraint(contrast) => format!("ends held against ends free: {}", of(contrast)),
        Feature::StoneSize(contrast) => format!("large stones against small ones: {}", of(contrast)),
        Feature::Apart(arm, MeasuredQuantity::JointKn) => {
            format!("{}: stiffness in the test on two stones", family(arm))
        }
        Feature::Apart(arm, MeasuredQuantity::SpecimenWeight) => format!("{}: weight", family(arm)),
        Feature::Apart(_, MeasuredQuantity::FixedTarget) => "the target that does not move".to_owned(),
        Feature::Apart(arm, _) => format!("{}: friction in the test on two stones", family(arm)),
    }
}
