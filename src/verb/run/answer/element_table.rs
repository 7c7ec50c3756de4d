//! The answer of a study of element types: ours beside what others report.

use std::path::Path;

use anyhow::{Context, Result};
use serde_json::{Value, json};

use crate::ensemble::{ElementRow, Timed, replace_file};
use crate::protocol::Stand;
use crate::render::document::{Document, Layout, Part, Table};
use crate::render::number::{or_dash, significant};
use crate::study::{ElementStudy, Reported};
use crate::verb::run::answer::files::SUMMARY_JSON;
use crate::verb::run::answer::published::Verdict;

/// Writes `summary.json`, which holds nothing that depends on the machine, and gives it.
///
/// # Errors
/// The file that could not be written, and why.
pub fn write_elements(study: &ElementStudy, rows: &[Timed], dir: &Path) -> Result<Value> {
    let verdicts: Vec<Value> = study.published.iter().map(|theirs| compared(theirs, rows)).collect();
    let summary = json!({
        "study": study.name,
        "question": study.question,
        "seed": study.seed,
        "study_hash": study.hash,
        "inputs": study.inputs.iter().map(|i| json!({"path": i.path, "sha256": i.sha256})).collect::<Vec<_>>(),
        "elements": rows.iter().map(|timed| &timed.row).collect::<Vec<_>>(),
        "published": verdicts,
    });
    let text =
        serde_json::to_string_pretty(&summary).context("the summary cannot be written as JSON")? + "\n";
    replace_file(&dir.join(SUMMARY_JSON), text.as_bytes())?;
    Ok(summary)
}

/// A published row beside ours: whether the assembly ends alike.
fn compared(theirs: &Reported, rows: &[Timed]) -> Value {
    let ours: Vec<&str> = of_arm(rows, &theirs.name).map(ElementRow::ending).collect();
    json!({
        "claim": format!("{}: {}", theirs.name, theirs.ends.replace('_', " ")),
        "source": theirs.source,
        "verdict": verdict(theirs, &ours),
        "ours": ours,
        "theirs": theirs,
    })
}

fn of_arm<'r>(rows: &'r [Timed], name: &'r str) -> impl Iterator<Item = &'r ElementRow> {
    rows.iter().map(|timed| &timed.row).filter(move |row| row.arm == name)
}

/// Reproduced where every assembly ends as theirs did; what was not said, or did not come out, cannot be judged.
fn verdict(theirs: &Reported, ours: &[&str]) -> Verdict {
    match theirs.ends.as_str() {
        "not_said" => Verdict::CannotJudge,
        _ if ours.is_empty() || ours.contains(&"no_room") => Verdict::CannotJudge,
        ends if ours.iter().all(|own| *own == ends) => Verdict::Reproduced,
        _ => Verdict::NotReproduced,
    }
}

/// The answer as a document: one line per type of element, the first assembly of each, with the number that ends as it does; below each the
/// line that others report.
pub fn element_document(study: &ElementStudy, rows: &[Timed]) -> Document<'static> {
    let heads = [
        "element",
        "elements",
        "time step",
        "cycles/s",
        "cycles",
        "to coarse",
        "to fine",
        "time",
        "ends",
        "",
    ];
    let mut lines = Vec::new();
    for arm in &study.arms {
        let Some(first) = rows.iter().find(|timed| timed.row.arm == arm.name) else { continue };
        lines.push(own_line(first, rows).to_vec());
        for theirs in study.published.iter().filter(|p| p.name == arm.name) {
            let ours: Vec<&str> = of_arm(rows, &arm.name).map(ElementRow::ending).collect();
            lines.push(their_line(theirs, verdict(theirs, &ours)).to_vec());
        }
    }
    let table = Table {
        caption: "Each line is the first assembly of a type, and how many of its assemblies end as it does. Below it is what others report. \
                  Coarse and fine are the two unbalanced force ratios of the study, first under gravity, then under the horizontal \
                  acceleration. Times are of this machine."
            .to_owned(),
        layout: Layout::Whole,
        ..Table::new("Types of elements", &heads, lines)
    };
    Document {
        title: format!("Types of elements in study {}", study.name),
        question: study.question.clone(),
        parts: Part::sentences(endings(study, rows)).chain([Part::Table(table)]).collect(),
        files: Vec::new(),
        limits: vec![
            "An assembly is shoved, and stands or falls: its answer is no load, and says nothing of walls of such elements.".to_owned(),
            "Times and cycles per second are of one machine; all else is the same on each.".to_owned(),
        ],
        methods: "Elements fill a cube and lie free under gravity and then a small horizontal acceleration. Spheres and clumps move by the \
                  explicit solver of grains, polyhedra by that of blocks, both with local damping."
            .to_owned(),
    }
}

/// Which types stand, and which do not: a type stands where all its assemblies do.
fn endings(study: &ElementStudy, rows: &[Timed]) -> Vec<String> {
    let stands = |name: &str| of_arm(rows, name).all(|row| row.stand == Some(Stand::Stands));
    let (up, down): (Vec<&str>, Vec<&str>) =
        study.arms.iter().map(|arm| arm.name.as_str()).partition(|name| stands(name));
    let sentence = |names: &[&str], verb: &str| {
        (!names.is_empty())
            .then(|| format!("{} of {} types {verb}: {}.", names.len(), study.arms.len(), names.join(", ")))
    };
    [sentence(&up, "stand"), sentence(&down, "do not stand")].into_iter().flatten().collect()
}

fn own_line(Timed { row, seconds, .. }: &Timed, rows: &[Timed]) -> [String; 10] {
    let all: Vec<&str> = of_arm(rows, &row.arm).map(ElementRow::ending).collect();
    let alike = all.iter().filter(|end| **end == row.ending()).count();
    let reached =
        |cycles: [Option<u64>; 2]| cycles.map(|n| n.map_or("-".to_owned(), |n| n.to_string())).join(" + ");
    [
        row.arm.clone(),
        row.elements.to_string(),
        format!("{} s", or_dash(row.time_step_s, 3)),
        significant(row.cycles as f64 / seconds, 3),
        row.cycles.to_string(),
        reached(row.to_coarse()),
        reached(row.to_fine()),
        format!("{} s", significant(*seconds, 3)),
        format!("{} ({alike} of {})", row.ending().replace('_', " "), all.len()),
        row.no_room.clone().unwrap_or_default(),
    ]
}

fn their_line(theirs: &Reported, verdict: Verdict) -> [String; 10] {
    [
        "  published".to_owned(),
        theirs.elements.to_string(),
        format!("{:e} s", theirs.time_step_s),
        significant(theirs.cycles_per_s, 3),
        significant(theirs.cycles, 8),
        String::new(),
        String::new(),
        format!("{} s", significant(theirs.time_s, 5)),
        theirs.ends.replace('_', " "),
        verdict.words().to_owned(),
    ]
}
