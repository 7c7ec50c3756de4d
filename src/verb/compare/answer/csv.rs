//! The numbers behind the figures of a comparison.

use crate::render::csv::{cell, ends, quoted};
use crate::verb::compare::answer::SelectionSummary;

/// `compare.csv`: one line per pair of arms.
pub fn differences(summary: &SelectionSummary) -> String {
    let mut text = "arm,over,shown,pairs,lost_pairs,better_by,low,high,low_whatever_failed,high_whatever_failed,next_wall,\
                    next_wall_low,next_wall_high,on_average\n"
        .to_owned();
    for own in &summary.differences {
        let [low, high] = ends(own.interval);
        let [least, most] = ends(own.interval_whatever_failed);
        let [next_low, next_high] = ends(own.next_wall.interval);
        let shown = serde_json::to_value(own.shown).ok().and_then(|name| name.as_str().map(str::to_owned));
        let cells = [
            quoted(&own.arm),
            quoted(&own.over),
            shown.unwrap_or_default(),
            own.pairs.to_string(),
            own.lost_pairs.to_string(),
            cell(own.better_by),
            low,
            high,
            least,
            most,
            cell(own.next_wall.probability),
            next_low,
            next_high,
            cell(own.on_average),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

/// `distributions.csv`: one line per arm and step of its empirical distribution.
pub fn distributions(summary: &SelectionSummary) -> String {
    let mut text = format!("arm,walls,{}_{},share_below,low,high\n", summary.quantity, summary.unit);
    for arm in &summary.arms {
        for step in &arm.steps {
            let [low, high] = step.pointwise;
            let name = quoted(&arm.name);
            text.push_str(&format!(
                "{name},{},{},{},{low},{high}\n",
                arm.walls, step.value, step.probability
            ));
        }
    }
    text
}
