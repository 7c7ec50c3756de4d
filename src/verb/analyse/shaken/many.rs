//! What is told of a wall under several records, or at several scales: a table.

use std::path::Path;

use serde_json::{Value, json};

use crate::ensemble::replace_file;
use crate::protocol::Verdict;
use crate::render::csv::Csv;
use crate::render::number::significant;
use crate::render::text::aligned;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::analyse::shaken::{Common, Ran, files, one};

/// Digits of the numbers in the table.
const DIGITS: usize = 3;
/// Columns of `runs.csv`.
const RUNS: &str = "record,scale,pga_m_per_s2,pgv_m_per_s,outcome,twin_outcome,blocks_fallen,first_stone_s,tenth_weight_s,half_weight_s,\
                    largest_displacement_m,largest_rotation_rad,largest_slip_m,residual_m,residual_rad";
/// The verdicts, in the order in which they are counted.
const VERDICTS: [Verdict; 6] = [
    Verdict::Collapsed,
    Verdict::Damaged,
    Verdict::Stands,
    Verdict::Undecided,
    Verdict::UnstableAtRest,
    Verdict::NotSolved,
];

/// How often each verdict came, of those that did.
fn counts(runs: &[Ran]) -> Vec<(Verdict, usize)> {
    let of = |own: Verdict| (own, runs.iter().filter(|run| run.seen.verdict == own).count());
    VERDICTS.map(of).into_iter().filter(|(_, count)| *count > 0).collect()
}

pub(crate) fn text(of: &Common<'_>, runs: &[Ran], seconds: f64) -> String {
    let said: Vec<String> =
        counts(runs).into_iter().map(|(own, count)| format!("{count} {}", one::words(own))).collect();
    let mut text = format!("Of {} runs: {}.\n", runs.len(), said.join(", "));
    text += &format!(
        "  {} solver, towards {} deg from x+\n",
        of.asked.solver().name(),
        of.asked.direction.angle_deg()
    );
    text += &one::ground(of.asked);
    let heads = ["record", "scale", "PGA m/s2", "PGV m/s", "outcome", "fallen", "first s", "residual mm"];
    let mut rows = vec![heads.map(String::from).to_vec()];
    rows.extend(runs.iter().map(|run| {
        let seen = &run.seen;
        let or_dash = |value: Option<f64>| value.map_or("-".to_owned(), |x| significant(x, DIGITS));
        vec![
            run.motion.name.clone(),
            run.scale.to_string(),
            significant(run.motion.pga(), DIGITS),
            significant(run.motion.pgv(), DIGITS),
            one::words(seen.verdict).to_owned(),
            seen.fallen.len().to_string(),
            or_dash(seen.first_stone_s),
            or_dash(seen.residual_m.map(|m| 1e3 * m)),
        ]
    }));
    text += &aligned(rows);
    text + &format!("  {} blocks, {} joints; {seconds:.1} s\n", of.file.wall.blocks.len(), of.fit.joints)
}

pub(crate) fn object(of: &Common<'_>, runs: &[Ran], warnings: &[String], seconds: f64) -> Value {
    let outcomes: serde_json::Map<String, Value> = counts(runs)
        .into_iter()
        .map(|(own, count)| (json!(own).as_str().unwrap_or_default().to_owned(), json!(count)))
        .collect();
    let each = |run: &Ran| {
        let mut own = one::object(of, run, &[], 0.0);
        if let Some(own) = own.as_object_mut() {
            // Those of all runs together.
            own.retain(|key, _| key != "warnings" && key != "seconds");
        }
        own
    };
    json!({
        "outcomes": outcomes,
        "runs": runs.iter().map(each).collect::<Vec<Value>>(),
        "solver": of.asked.solver().name(),
        "load": of.asked.load.name(),
        "blocks": of.file.wall.blocks.len(),
        "joints": of.fit.joints,
        "seconds": seconds,
        "warnings": warnings,
    })
}

/// Writes the table, the object, and a folder for each run.
pub(crate) fn write(
    folder: &Path,
    of: &Common<'_>,
    runs: &[Ran],
    (object, seconds): (&Value, f64),
    warnings: &[String],
) -> Result<(), Failure> {
    output::folder(folder)?;
    replace_file(&folder.join("runs.csv"), &csv(runs))?;
    replace_file(&folder.join("analysis.json"), format!("{object:#}\n").as_bytes())?;
    for (number, run) in runs.iter().enumerate() {
        let (text, own) = (one::text(of, run, seconds), one::object(of, run, warnings, seconds));
        files::write(&folder.join(name(number)), of, run, (&own, &text), warnings)?;
    }
    Ok(())
}

/// The folder of a run: its line in `runs.csv`.
fn name(number: usize) -> String {
    format!("run-{:03}", number + 1)
}

fn csv(runs: &[Ran]) -> Vec<u8> {
    let verdict = |own: Verdict| json!(own).as_str().unwrap_or_default().to_owned();
    let mut csv = Csv::new(RUNS);
    for run in runs {
        let seen = &run.seen;
        csv.line(&[
            &run.motion.name,
            &run.scale,
            &run.motion.pga(),
            &run.motion.pgv(),
            &verdict(seen.verdict),
            &run.twin.as_ref().map(|twin| verdict(twin.verdict)),
            &seen.fallen.len(),
            &seen.first_stone_s,
            &seen.part_s,
            &seen.most_s,
            &seen.displacement.value,
            &seen.rotation.value,
            &seen.slip.value,
            &seen.residual_m,
            &seen.residual_rad,
        ]);
    }
    csv.bytes()
}
