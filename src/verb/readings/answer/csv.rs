//! The numbers behind the readings.

use crate::render::csv::quoted;
use crate::verb::readings::answer::ReadingsSummary;

/// `readings.csv`: one line per reading and statement; a reading that was refused has one line, with the reason.
pub fn csv(summary: &ReadingsSummary) -> String {
    let mut text = "reading,variants,extent,statement,verdict,ours,theirs,why\n".to_string();
    for reading in &summary.readings {
        let head =
            [quoted(&reading.name()), reading.variants.len().to_string(), reading.extent.name().to_string()];
        for one in &reading.statements {
            let cells = [&one.claim, one.verdict.words(), &one.ours, &one.theirs, &one.why].map(quoted);
            text.push_str(&format!("{},{}\n", head.join(","), cells.join(",")));
        }
        if let Some(why) = &reading.why {
            text.push_str(&format!("{},,,,,{}\n", head.join(","), quoted(why)));
        }
    }
    text
}
