//! The numbers of the figure. They read back to the same bits.

use crate::render::csv::Csv;
use crate::verb::analyse::uncertainty::UncertaintySummary;

/// `uncertainty.csv`: one line per point of the design; the load is empty where none is known.
pub fn csv(summary: &UncertaintySummary) -> Vec<u8> {
    let names: String = summary.asked.iter().map(|own| format!(",{}", own.unsure.name)).collect();
    let mut csv = Csv::new(format!("wall{names},outcome,{}", summary.answered.name));
    for (number, (values, ended)) in summary.points.iter().enumerate() {
        csv.line(&[&number, values, &ended.outcome, &ended.value()]);
    }
    csv.bytes()
}
