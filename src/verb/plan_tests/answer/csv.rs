//! The plan as a table for a spreadsheet.

use crate::render::csv::{cell, quoted};
use crate::verb::plan_tests::answer::TestPlan;

/// `plan-tests.csv`: one line per pair of arms and reading.
pub fn csv(plan: &TestPlan) -> String {
    let mut text = "arm,over,reading,unit,difference,sigma,correlation,specimens_to_see,pairs_to_see,specimens,power,smallest_seen\n".to_owned();
    for own in &plan.differences {
        let cells = [
            quoted(&own.arm),
            quoted(&own.over),
            quoted(&own.reading),
            own.unit.to_owned(),
            own.difference.to_string(),
            own.sigma.to_string(),
            cell(own.correlation),
            own.specimens.map_or_else(String::new, |n| n.to_string()),
            cell(own.pairs),
            plan.asked.specimens.to_string(),
            own.power.to_string(),
            cell(own.smallest_seen),
        ];
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}
