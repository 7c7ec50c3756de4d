//! The numbers of the figure. They read back to the same bits.

use crate::render::csv::{cell, quoted};
use crate::verb::influence::answer::InfluenceSummary;

/// `influence.csv`: one line per source; empty where not defined.
pub fn csv(summary: &InfluenceSummary) -> String {
    let mut text =
        "source,is_in_layout,first,first_low,first_high,total,total_low,total_high,points\n".to_owned();
    for group in &summary.groups {
        let shares = group.first.into_iter().chain(group.total).map(cell);
        let cells: Vec<String> = [quoted(&group.name), group.is_in_layout.to_string()]
            .into_iter()
            .chain(shares)
            .chain([group.points.to_string()])
            .collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}
