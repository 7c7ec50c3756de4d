//! What a run comes to, in at most five lines: the question, the walls, their quantity, the ratio of arms, and what was said before.

use std::collections::BTreeMap;

use crate::ensemble::Quantity;
use crate::render::number::{or_dash, shortened, stiffness, with_interval, with_interval_against};
use crate::render::text::{LONGEST_NAME, WIDTH, wrapped};
use crate::verb::run::answer::published::Verdict;
use crate::verb::run::answer::summary::{ArmSummary, Summary};

/// The sentences of the conclusion, without the question.
pub(crate) fn sentences(summary: &Summary) -> Vec<String> {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let counted = format!("{}{variant}: {}", summary.study, walls(summary));
    [Some(counted), shown(summary), ratios(summary), beside(summary)].into_iter().flatten().collect()
}

/// The conclusion, a line or two per sentence.
pub(crate) fn conclusion(summary: &Summary) -> String {
    let mut text: String = sentences(summary).iter().map(|line| wrapped("", line)).collect();
    if text.lines().count() < MOST_LINES && !summary.question.is_empty() {
        let question = wrapped("", &summary.question);
        if text.lines().count() + question.lines().count() <= MOST_LINES {
            text.insert_str(0, &question);
        }
    }
    text
}

/// So many lines say what came out.
pub(crate) const MOST_LINES: usize = 5;

/// How many walls were solved, and how many brought no value.
fn walls(summary: &Summary) -> String {
    let sum = |of: fn(&ArmSummary) -> u64| summary.arms.iter().map(of).sum::<u64>();
    let (all, stood) = (sum(ArmSummary::computed), sum(|arm| arm.stood_to_the_end));
    // The same walls are solved at every stiffness.
    let mut walls: BTreeMap<&str, u64> = BTreeMap::new();
    summary.arms.iter().for_each(|arm| {
        let most = walls.entry(&arm.arm).or_default();
        *most = arm.computed().max(*most);
    });
    let walls: u64 = walls.values().sum();
    let solved = match walls == all {
        true => counted(walls),
        false => format!("{} in {all} evaluations", counted(walls)),
    };
    let missing = match sum(|arm| arm.missing) {
        0 => String::new(),
        some => format!(", {some} of {} not computed yet", sum(|arm| arm.members)),
    };
    let failed = match sum(ArmSummary::failed) {
        0 => "none failed".to_string(),
        some => format!("{some} failed (not in the means)"),
    };
    let stood = match stood {
        0 => String::new(),
        some => format!(", {some} stood to the end of the load path"),
    };
    let open = match sum(|arm| arm.left_open.map_or(0, |open| open.walls)) {
        0 => String::new(),
        some => format!("; rigid blocks leave the value of {some} open"),
    };
    format!("{solved}{missing}, {failed}{stood}{}{open}.", bears(summary))
}

/// How many walls bear the full load, where they are asked for the load that they bear.
fn bears(summary: &Summary) -> String {
    let own = || summary.arms.iter().filter(|arm| arm.shown == Quantity::LoadFactor);
    let bear = |arm: &ArmSummary| {
        ["equilibrium", "unbounded"].iter().filter_map(|name| arm.outcomes.get(*name)).sum::<u64>()
    };
    match own().next() {
        None => String::new(),
        Some(_) => format!(
            ", {} of {} bear the full load",
            own().map(bear).sum::<u64>(),
            own().map(ArmSummary::computed).sum::<u64>()
        ),
    }
}

/// A number of walls, in words.
fn counted(walls: u64) -> String {
    if walls == 1 { "1 wall".to_owned() } else { format!("{walls} walls") }
}

/// The mean of every arm at the first stiffness, as many as a line or two hold, and the COV of the random ones.
fn shown(summary: &Summary) -> Option<String> {
    let first = summary.arms.first()?;
    let quantity = first.shown;
    let here: Vec<&ArmSummary> =
        summary.arms.iter().filter(|arm| arm.kn_pa_per_m == first.kn_pa_per_m).collect();
    let one = |arm: &&ArmSummary| {
        let (name, mean) = (shortened(&arm.arm, LONGEST_NAME), arm.mean.map(|x| quantity.shown(x)));
        let interval = arm.mean_ci.map(|ci| ci.map(|x| quantity.shown(x)));
        match arm.random {
            true => {
                let cov = or_dash(arm.cov.map(|cov| 100.0 * cov), 2);
                format!("{name} {} (COV {cov} %)", with_interval(mean, interval, 3))
            }
            false => format!("{name} {}", or_dash(mean, 3)),
        }
    };
    let what = match quantity.unit() {
        "deg" => "Mean collapse angle",
        "N" => "Mean of the largest push",
        "1" => "Mean load at collapse",
        "m" if quantity == Quantity::RetainedHeight => "Mean height behind the wall at its fall",
        _ => "Mean displacement at the top",
    };
    let head = format!("{what} in {} at kn {}: ", quantity.shown_unit(), stiffness(first.kn_pa_per_m));
    // The random arms are what a study is about: they go first where not all fit.
    let mut ordered = here.clone();
    ordered.sort_by_key(|arm| !arm.random);
    let mut parts: Vec<String> = Vec::new();
    for part in ordered.iter().map(one) {
        let used: usize = head.len() + parts.iter().map(|p| p.len() + 2).sum::<usize>();
        if !parts.is_empty() && used + part.len() > 2 * WIDTH - 10 {
            parts.push("others below".to_string());
            break;
        }
        parts.push(part);
    }
    Some(format!("{head}{}.", parts.join("; ")))
}

/// The first ratio of a random arm, and what its interval says.
fn ratios(summary: &Summary) -> Option<String> {
    let random = |name: &str| summary.arms.iter().any(|arm| arm.arm == name && arm.random);
    let all = || summary.comparisons.iter().filter(|one| one.ratio.is_some());
    let one = all().find(|one| random(&one.arm)).or_else(|| all().next())?;
    let exact = one.ratio_ci.is_none_or(|[low, high]| low == high);
    let (ratio, says) = match one.ratio_ci.filter(|_| !exact) {
        None => (or_dash(one.ratio, 3), ""),
        Some([low, high]) => (
            with_interval_against(one.ratio, one.ratio_ci, 3, 1.0),
            match (low > 1.0, high < 1.0) {
                (true, _) => ": larger",
                (_, true) => ": smaller",
                _ => ": no difference shown",
            },
        ),
    };
    let [arm, over] = [&one.arm, &one.over].map(|name| shortened(name, LONGEST_NAME));
    Some(format!("{arm} over {over}: {ratio}{says}."))
}

/// How many published statements come out.
fn beside(summary: &Summary) -> Option<String> {
    if summary.published.is_empty() {
        return None;
    }
    let count =
        |verdict: Verdict| summary.published.iter().filter(|statement| statement.verdict == verdict).count();
    let said = [Verdict::Reproduced, Verdict::NotReproduced, Verdict::CannotJudge]
        .map(|verdict| format!("{} {}", count(verdict), verdict.words()));
    Some(format!("Published statements: {}.", said.join(", ")))
}
