//! The numbers of the figure. They read back to the same bits.

use crate::render::csv::cell;
use crate::verb::analyse::uncertainty::UncertaintySummary;

/// `uncertainty.csv`: one line per point of the design; the load is empty where none is known.
pub fn csv(summary: &UncertaintySummary) -> String {
    let names = summary.asked.iter().map(|own| own.unsure.name);
    let head: Vec<&str> =
        ["wall"].into_iter().chain(names).chain(["outcome", summary.answered.name]).collect();
    let mut text = head.join(",") + "\n";
    for (number, (values, ended)) in summary.points.iter().enumerate() {
        let values = values.iter().map(f64::to_string);
        let ended = [ended.outcome.to_owned(), cell(ended.value())];
        let cells: Vec<String> = [number.to_string()].into_iter().chain(values).chain(ended).collect();
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}
