//! A law of the joints that was learnt: `joint_law.json`, its figure, the study that has it, and what is printed.

mod entry;
mod plot;
mod text;

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

pub use entry::LawSummary;
pub use text::law_text;

use crate::critic::LearntLaw;
use crate::ensemble::replace_file;
use crate::verb::diagnose::extended::{EXTENDED, Origin, write_beside};
use crate::verb::diagnose::joint_law::plot::LawPlot;
use crate::verb::run::answer::files::write_figure;

/// File name, without ending, of what is written, and name of the extended study.
const LAW: &str = "joint_law";

/// Writes the law as JSON, SVG and PNG into an existing folder, and where it is taken on the study that has it below `extended`. The same
/// law gives the same bytes.
///
/// # Errors
/// The faults of values that their keys do not allow; the file that could not be written, and why.
pub fn write_law(origin: &Origin<'_>, law: &LearntLaw, dir: &Path) -> Result<LawSummary> {
    let Origin { study, stated, .. } = origin;
    let mut summary = LawSummary::of(study, law);
    if law.is_accepted() {
        let arms: Vec<_> = law.families.iter().copied().zip(&law.arms).collect();
        let folder = dir.join(EXTENDED).join(LAW);
        fs::create_dir_all(&folder)
            .with_context(|| format!("cannot create the folder {}", folder.display()))?;
        let own = study.closing(stated, &arms)?;
        replace_file(&folder.join("study.toml"), (header(&summary) + "\n" + &own.to_toml()).as_bytes())?;
        for (name, text) in [
            ("measured.csv", stated.measured().map(|(text, _)| text)),
            ("published.toml", stated.published()),
        ] {
            text.map_or(Ok(()), |text| replace_file(&folder.join(name), text.as_bytes()))?;
        }
        write_beside(stated, &folder)?;
        summary.extended = Some(format!("{EXTENDED}/{LAW}"));
    }
    let json = serde_json::to_string_pretty(&summary).context("the law cannot be written as JSON")? + "\n";
    replace_file(&dir.join(format!("{LAW}.json")), json.as_bytes())?;
    write_figure(dir, LAW, |scale| LawPlot::new(&summary, scale))?;
    Ok(summary)
}

/// Takes away what an earlier diagnosis in the same folder learnt.
pub fn remove_law(dir: &Path) {
    // What is not there needs not be taken away.
    let below = dir.join(EXTENDED).join(LAW);
    ["study.toml", "measured.csv", "published.toml"]
        .iter()
        .for_each(|name| drop(fs::remove_file(below.join(name))));
    let _ = fs::remove_dir(below);
    ["json", "svg", "png"]
        .iter()
        .for_each(|ending| drop(fs::remove_file(dir.join(format!("{LAW}.{ending}")))));
}

fn header(summary: &LawSummary) -> String {
    let lines = law_text(summary);
    let own = lines.lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n");
    format!(
        "# Made by `pirca diagnose` from the study {:?}: its joints close along the law that was learnt.\n",
        summary.study
    ) + &own.collect::<String>()
}
