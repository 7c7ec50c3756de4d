//! The verdict on a base model: `verdict.json`, and what is printed.

use std::path::Path;

use anyhow::{Context, Result};

use crate::critic::{Contrast, Design, Diagnosis, Feature, SelfTest, Truth, Verdict};
use crate::ensemble::replace_file;
use crate::report::advice::Advice;
use crate::report::gain::GainSummary;
use crate::report::number::significant;
use crate::stats;
use crate::study::{Described, MeasuredQuantity, Study};

/// What is off by less than this many standard deviations is not worth a line.
const WORTH_SAYING: f64 = 2.0;
/// Quantiles of a parameter.
const INTERVAL: [f64; 2] = [0.05, 0.95];

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
    /// named, ambiguous, unexplained or nothing_found.
    pub verdict: &'static str,
    /// The causes that the verdict speaks of, then all others; probabilities when all are equally likely beforehand.
    pub causes: Vec<CauseEntry>,
    /// Probability of the base model among them.
    pub base_probability: f64,
    /// Share of campaigns without any effect in which something is as far off.
    pub p_value: f64,
    /// What is off, the furthest first.
    pub off: Vec<OffEntry>,
    /// Lines of the measurements that were not used.
    pub unused_lines: Vec<usize>,
    /// What looks odd about the measurements and was judged all the same.
    pub notes: Vec<String>,
    /// How reliable verdicts on such data are.
    pub self_test: Vec<SelfTestEntry>,
    /// What the data cannot tell, and what would.
    pub advice: Advice,
    /// What the extended model gains on readings that were not known; null where it was not asked or nothing was found.
    pub gain: Option<GainSummary>,
}

/// A cause.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct CauseEntry {
    /// Name of the mechanism.
    pub id: &'static str,
    /// Its probability.
    pub probability: f64,
    /// Its share of the evidence of the causes that were looked at closely and of the base model; null for the others.
    pub evidence: Option<f64>,
    /// Whether the verdict speaks of it.
    pub in_verdict: bool,
    /// Share of its own campaigns that fit the readings no better; null where the guard was not asked.
    pub guard_p_value: Option<f64>,
    /// Its parameters, as far as the data tell them; empty where it was not looked at closely.
    pub parameters: Vec<ParameterEntry>,
}

/// A parameter of a cause.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ParameterEntry {
    /// Its key.
    pub key: &'static str,
    /// Its unit.
    pub unit: &'static str,
    /// Median.
    pub median: f64,
    /// 5 and 95 % quantile.
    pub interval: [f64; 2],
}

/// Something that is off.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct OffEntry {
    /// What, in words.
    pub what: String,
    /// Measured less simulated, in standard deviations of campaigns without any effect.
    pub in_sd: f64,
}

/// A line of the self-test.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct SelfTestEntry {
    /// What was hidden; "nothing" where nothing was.
    pub hidden: &'static str,
    /// Campaigns.
    pub campaigns: u64,
    /// In which something was found.
    pub found: u64,
    /// In which it was named, before the guard.
    pub named: u64,
    /// In which something else was.
    pub misnamed: u64,
}

impl DiagnosisSummary {
    /// From a diagnosis.
    pub fn of(
        study: &Study,
        seed: u64,
        bank: &str,
        mechanisms: &[Described],
        design: &Design,
        diagnosis: &Diagnosis,
        self_test: &SelfTest,
    ) -> DiagnosisSummary {
        let (verdict, spoken): (&'static str, Vec<usize>) = match &diagnosis.verdict {
            Verdict::NothingFound => ("nothing_found", Vec::new()),
            Verdict::Named(cause) => ("named", vec![*cause]),
            Verdict::Ambiguous(causes) => ("ambiguous", causes.clone()),
            Verdict::Unexplained => ("unexplained", Vec::new()),
        };
        let ranked = &diagnosis.seeming.ranked;
        let mut causes: Vec<CauseEntry> = ranked
            .causes
            .iter()
            .filter_map(|&(cause, probability)| {
                let cause = cause?;
                let closely = diagnosis.looked_at(cause);
                Some(CauseEntry {
                    id: mechanisms[cause].name,
                    probability,
                    evidence: closely.map(|own| own.evidence),
                    in_verdict: spoken.contains(&cause),
                    guard_p_value: closely.and_then(|own| own.guard),
                    parameters: closely
                        .map_or_else(Vec::new, |own| parameters(&mechanisms[cause], &own.draws)),
                })
            })
            .collect();
        causes.sort_by_key(|cause| !cause.in_verdict);
        let mut off: Vec<OffEntry> = diagnosis
            .seeming
            .wrong
            .excess
            .iter()
            .filter_map(|(feature, excess)| {
                Some(OffEntry { what: words(study, *feature), in_sd: (*excess)? })
            })
            .collect();
        off.sort_by(|a, b| b.in_sd.abs().total_cmp(&a.in_sd.abs()));
        let base = ranked.causes.iter().find(|(cause, _)| cause.is_none());
        let tested = self_test.rows.iter().map(|row| SelfTestEntry {
            hidden: row.cause.map_or("nothing", |cause| mechanisms[cause].name),
            campaigns: row.campaigns,
            found: row.found,
            named: row.named,
            misnamed: row.misnamed,
        });
        DiagnosisSummary {
            study: study.name.clone(),
            variant: study.variant.clone(),
            seed,
            bank: bank.to_string(),
            verdict,
            causes,
            base_probability: base.map_or(0.0, |(_, probability)| *probability),
            p_value: diagnosis.seeming.p_value,
            off,
            unused_lines: design.unused.clone(),
            notes: Vec::new(),
            self_test: tested.collect(),
            advice: Advice::default(),
            gain: None,
        }
    }
}

/// What the posterior says of a cause's parameters.
fn parameters(mechanism: &Described, draws: &[Truth]) -> Vec<ParameterEntry> {
    let entry = |(k, parameter): (usize, &crate::study::Parameter)| {
        let values: Vec<f64> =
            draws.iter().map(|truth| parameter.prior.at_score(truth.parameters[k])).collect();
        let at = |p: f64| stats::quantile(&values, p);
        Some(ParameterEntry {
            key: parameter.key,
            unit: parameter.unit,
            median: at(0.5)?,
            interval: [at(INTERVAL[0])?, at(INTERVAL[1])?],
        })
    };
    mechanism.parameters.iter().enumerate().filter_map(entry).collect()
}

fn words(study: &Study, feature: Feature) -> String {
    let family = |arm: usize| &study.arms[arm].name;
    let of = |contrast| match contrast {
        Contrast::Collapse => "collapse angle",
        Contrast::Level => "displacements as a whole",
        Contrast::Growth => "growth of the displacements with the tilt",
        Contrast::Curvature => "curvature of the displacements over the tilt",
        Contrast::Bow => "centre against the ends",
        Contrast::Twist => "left against right",
        Contrast::Reached => "share of the readings that were reached",
    };
    match feature {
        Feature::Mean(arm, contrast) => format!("{}: {}", family(arm), of(contrast)),
        Feature::Scatter(arm, contrast) => {
            format!("{}: scatter of the {} between specimens", family(arm), of(contrast))
        }
        Feature::Order(contrast) => format!("{} over the order of the tests", of(contrast)),
        Feature::Joint(arm, MeasuredQuantity::JointKn) => {
            format!("{}: stiffness in the test on two stones", family(arm))
        }
        Feature::Joint(arm, _) => format!("{}: friction in the test on two stones", family(arm)),
    }
}

/// Writes `verdict.json` into an existing folder.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_diagnosis(summary: &DiagnosisSummary, dir: &Path) -> Result<()> {
    let json = serde_json::to_string_pretty(summary).context("the verdict cannot be written as JSON")? + "\n";
    Ok(replace_file(&dir.join("verdict.json"), json.as_bytes())?)
}

/// The verdict as people read it.
pub fn diagnosis_text(summary: &DiagnosisSummary) -> String {
    let mut text = format!("Study {}, seed {}\n\n", summary.study, summary.seed);
    let p = significant(summary.p_value, 2);
    let verdict = match summary.verdict {
        "nothing_found" => format!(
            "NOTHING FOUND: what is off is no more than errors, scatter and joints within their priors make of it (p {p})."
        ),
        "named" => "NAMED: something is wrong, and one cause explains it.".to_string(),
        "ambiguous" => {
            "AMBIGUOUS: something is wrong, and the data cannot tell between these causes.".to_string()
        }
        _ => "UNEXPLAINED: something is wrong, and no one cause of the catalogue explains it.".to_string(),
    };
    text.push_str(&verdict);
    text.push('\n');
    if summary.verdict != "nothing_found" {
        text.push_str(&format!("Campaigns without any effect are as far off in a share of {p} of cases.\n"));
    }
    text.push_str(
        "\nWhat is off (measured less simulated, in standard deviations of campaigns without any effect)\n",
    );
    let worth: Vec<&OffEntry> = summary.off.iter().filter(|off| off.in_sd.abs() >= WORTH_SAYING).collect();
    for off in &worth {
        text.push_str(&format!("  {:+6.1}  {}\n", off.in_sd, off.what));
    }
    if worth.is_empty() {
        text.push_str("  nothing by two or more\n");
    }
    text.push_str("\nCauses (probability if all were equally likely before; share of the evidence; guard: share of the cause's own campaigns that\nfit worse)\n");
    for cause in summary.causes.iter().take(6) {
        let mark = if cause.in_verdict { "*" } else { " " };
        let or_dash = |p: Option<f64>| p.map_or("-".to_string(), |p| significant(p, 2));
        let (evidence, guard) = (or_dash(cause.evidence), or_dash(cause.guard_p_value));
        text.push_str(&format!(
            "{mark} {:<18} {:>6.3}   evidence {evidence}   guard {guard}\n",
            cause.id, cause.probability
        ));
        for parameter in cause.parameters.iter().filter(|_| cause.in_verdict) {
            let [low, high] = parameter.interval.map(|x| significant(x, 3));
            let median = significant(parameter.median, 3);
            text.push_str(&format!("      {} {median} [{low}, {high}] {}\n", parameter.key, parameter.unit));
        }
    }
    text.push_str(&format!("  {:<18} {:>6.3}\n", "none of them", summary.base_probability));
    text.push_str(&summary.gain.as_ref().map_or_else(String::new, GainSummary::text));
    text.push_str(&summary.advice.text());
    text.push_str(&reliability(summary));
    if !summary.unused_lines.is_empty() {
        let lines: Vec<String> = summary.unused_lines.iter().map(ToString::to_string).collect();
        text.push_str(&format!(
            "\nNot used: lines {} of the measurements (weights, readings after unloading, arms that are not evaluated)\n",
            lines.join(", ")
        ));
    }
    text
}

/// What the self-test says.
fn reliability(summary: &DiagnosisSummary) -> String {
    let (nothing, hidden): (Vec<_>, Vec<_>) =
        summary.self_test.iter().partition(|row| row.hidden == "nothing");
    let sum =
        |rows: &[&SelfTestEntry], of: fn(&SelfTestEntry) -> u64| rows.iter().map(|row| of(row)).sum::<u64>();
    let share = |part: u64, whole: u64| if whole == 0 { 0.0 } else { 100.0 * part as f64 / whole as f64 };
    let campaigns = sum(&hidden, |row| row.campaigns);
    let given = sum(&hidden, |row| row.named + row.misnamed);
    format!(
        "\nWith data like these, by simulation from the bank: an effect drawn from its prior is found in {:.0} % of campaigns\n\
         and named in {:.0} %; a name is wrong in {:.0} % of cases; where nothing is hidden, something is found in {:.0} % and named\n\
         in {:.1} % (before the guard).\n",
        share(sum(&hidden, |row| row.found), campaigns),
        share(sum(&hidden, |row| row.named), campaigns),
        share(sum(&hidden, |row| row.misnamed), given),
        share(sum(&nothing, |row| row.found), sum(&nothing, |row| row.campaigns)),
        share(sum(&nothing, |row| row.misnamed), sum(&nothing, |row| row.campaigns)),
    )
}
