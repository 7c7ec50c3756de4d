//! The table that `run` prints: arms, ratios, published statements. At most 100 columns wide.

use crate::ensemble::Quantity;
use crate::render::number::{
    compact, or_dash, shortened, significant, stiffness, with_interval, with_interval_against,
};
use crate::render::text::{aligned, side_by_side, wrapped};
use crate::verb::run::answer::conclusion::conclusion;
use crate::verb::run::answer::demand::DemandSummary;
use crate::verb::run::answer::figure::LONGEST_NAME;
use crate::verb::run::answer::measured;
use crate::verb::run::answer::shaken::text as shaken_text;
use crate::verb::run::answer::summary::{ArmSummary, EnoughEntry, Summary};

/// What the table shows, in words.
pub(crate) fn explanation(quantity: Quantity) -> String {
    format!(
        "Each line is one arm (kind of wall) at one normal stiffness kn of the joints. The quantity is {}. Brackets hold \
         95 % intervals. A dash: not defined (one wall has no sigma). Failed walls ({}) are counted and are not in the \
         mean. sigma: standard deviation between walls; COV: sigma over mean.",
        quantity.words(),
        quantity.failed_words()
    )
}

/// The summary as text for a terminal: the conclusion, then what it rests on under headings.
pub fn terminal_table(summary: &Summary) -> String {
    if let Some(shaken) = &summary.shaken {
        return shaken_text(summary, shaken);
    }
    let mut text = summary
        .demand
        .as_ref()
        .and_then(DemandSummary::sentence)
        .map(|said| wrapped("", &said))
        .unwrap_or_default();
    text.push_str(&conclusion(summary));
    text.push_str(&format!("\nResults ({} solver, seed {})\n", summary.solver, summary.seed));
    if let Some(arm) = summary.arms.first() {
        text.push_str(&wrapped("", &explanation(arm.shown)));
        text.push('\n');
    }
    text.push_str(&arms(&summary.arms));
    text.push_str(&summary.demand.as_ref().map(DemandSummary::text).unwrap_or_default());
    text.push_str(&ratios(summary));
    text.push_str(&measured::text(summary.measured.as_ref()));
    text.push_str(&published(summary));
    text
}

/// Whether an arm had walls enough, and what of.
fn said_enough(arm: &ArmSummary, enough: &EnoughEntry) -> String {
    let shown = |x: f64| arm.shown.shown(x);
    let value = with_interval(enough.value.map(shown), enough.ci.map(|ci| ci.map(shown)), 3);
    let half = or_dash(enough.half_width.map(|half| 100.0 * half), 2);
    let below = significant(100.0 * enough.below, 2);
    let ending = match enough.reached {
        true => format!("{} walls are enough", arm.members),
        false => format!("{} walls, the most allowed, are not enough", arm.members),
    };
    format!(
        "{} at kn {}: {ending}: {} {value} {}, half width {half} % (asked: below {below} %)",
        arm.arm,
        stiffness(arm.kn_pa_per_m),
        enough.of,
        arm.shown.shown_unit()
    )
}

/// The heads, and a row per arm and kn.
pub(crate) fn arm_rows(arms: &[ArmSummary]) -> Vec<Vec<String>> {
    let unit = arms.first().map_or("", |arm| arm.shown.shown_unit());
    let in_unit = |name: &str| format!("{name} {unit}");
    let counts = ["arm", "kn Pa/m", "walls", "failed"].map(String::from);
    let header = counts.into_iter().chain([in_unit("mean"), in_unit("sigma"), "COV %".to_string()]);
    let mut rows = vec![header.collect()];
    for arm in arms {
        let shown = |x: f64| arm.shown.shown(x);
        let mean = match arm.random {
            true => with_interval(arm.mean.map(shown), arm.mean_ci.map(|ci| ci.map(shown)), 3),
            false => or_dash(arm.mean.map(shown), 3),
        };
        rows.push(vec![
            arm.arm.clone(),
            compact(arm.kn_pa_per_m),
            arm.computed().to_string(),
            arm.failed().to_string(),
            mean,
            with_interval(arm.sigma.map(shown), arm.sigma_ci.map(|ci| ci.map(shown)), 3),
            with_interval(arm.cov.map(|x| x * 1e2), arm.cov_ci.map(|ci| ci.map(|x| x * 1e2)), 3),
        ]);
    }
    rows
}

/// What is to be said of an arm at one kn: whether it had walls enough, what limit analysis says of them, and which are not in the numbers.
pub(crate) fn arm_notes(arm: &ArmSummary) -> [Option<String>; 3] {
    let of_arm = |note: String| format!("{} at kn {}: {note}", arm.arm, stiffness(arm.kn_pa_per_m));
    [
        arm.enough.as_ref().map(|enough| said_enough(arm, enough)),
        arm.limit_analysis.as_ref().map(|bounded| of_arm(bounded.words())),
        arm.note.clone().map(of_arm),
    ]
}

/// One line per arm and kn, and the notes below.
fn arms(arms: &[ArmSummary]) -> String {
    let mut text = aligned(arm_rows(arms));
    for [enough, bounded, note] in arms.iter().map(arm_notes) {
        text.extend([enough, bounded].into_iter().flatten().map(|said| wrapped("", &said)));
        text.extend(note.map(|note| wrapped("! ", &note)));
    }
    text
}

/// A line per kn and a column per pair of arms; as many tables as the width needs.
fn ratios(summary: &Summary) -> String {
    let mut columns: Vec<Vec<String>> = Vec::new();
    let mut pairs: Vec<(&str, &str)> = Vec::new();
    let mut kns: Vec<f64> = Vec::new();
    let mut has_exact = false;
    for comparison in &summary.comparisons {
        if !kns.contains(&comparison.kn_pa_per_m) {
            kns.push(comparison.kn_pa_per_m);
        }
        let pair = (comparison.arm.as_str(), comparison.over.as_str());
        let index = pairs.iter().position(|known| *known == pair).unwrap_or_else(|| {
            pairs.push(pair);
            columns.push(vec![format!(
                "{} / {}",
                shortened(pair.0, LONGEST_NAME),
                shortened(pair.1, LONGEST_NAME)
            )]);
            columns.len() - 1
        });
        let exact = comparison.ratio_ci.is_some_and(|[low, high]| low == high);
        has_exact |= exact;
        columns[index].push(match exact {
            true => or_dash(comparison.ratio, 3),
            false => with_interval_against(comparison.ratio, comparison.ratio_ci, 3, 1.0),
        });
    }
    if columns.is_empty() {
        return String::new();
    }
    let first: Vec<String> =
        std::iter::once("kn Pa/m".to_string()).chain(kns.iter().copied().map(compact)).collect();
    let note = if has_exact { " (without brackets: neither arm is random)" } else { "" };
    let mut text = format!("\nRatios of means{note}\n");
    text.push_str(&side_by_side(&first, &columns));
    text
}

fn published(summary: &Summary) -> String {
    if summary.published.is_empty() {
        return String::new();
    }
    let mut text = "\nPublished statements beside these numbers\n".to_string();
    for statement in &summary.published {
        let head = format!(
            "{}: {} ({})",
            statement.verdict.words().to_uppercase(),
            statement.claim,
            statement.source
        );
        text.push_str(&wrapped("  ", &head));
        for (name, words) in
            [("theirs", &statement.theirs), ("ours  ", &statement.ours), ("why   ", &statement.why)]
        {
            text.push_str(&wrapped(&format!("      {name}  "), words));
        }
    }
    text
}
