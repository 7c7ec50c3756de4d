//! A verdict as a page: one file of plain HTML with its figures in it, for any browser and for print.

use crate::report::diagnosis::conclusion::conclusion;
use crate::report::diagnosis::summary::{CauseEntry, DataEntry, DiagnosisSummary};
use crate::report::diagnosis::text::{
    CAUSE, CAUSES, FORM, NO_FORM, OFF, beside_prior, by_chance, excluded, not_used, or_dash, others, pairs,
    reliability, worth_saying,
};
use crate::report::diagnosis::words::{lines, reading};
use crate::report::gain::GainSummary;
use crate::report::markup::escaped;
use crate::report::page::{Drawing, STYLE};

/// The page.
pub fn page(summary: &DiagnosisSummary, drawings: &[Drawing]) -> String {
    let variant = summary.variant.as_ref().map_or_else(String::new, |variant| format!(", variant {variant}"));
    let title = format!("Diagnosis of study {}{variant}", summary.study);
    let mut body = format!("<h1>{}</h1>\n", escaped(&title));
    for (place, sentence) in conclusion(summary).iter().enumerate() {
        body.push_str(&match place {
            0 => format!("<p class=\"verdict\">{}</p>\n", escaped(sentence)),
            _ => paragraph(sentence),
        });
    }
    summary.notes.iter().for_each(|note| body.push_str(&paragraph(&format!("Note: {note}."))));
    if !summary.extended.is_empty() {
        let folders = summary.extended.join(", ");
        body.push_str(&paragraph(&format!("Extended study, beside this page, for pirca run: {folders}.")));
    }
    body.push_str("<h2>Measured beside simulated</h2>\n");
    body.push_str(&paragraph(&reading(&summary.groups)));
    let cells = lines(&summary.groups).into_iter();
    let rows = cells.map(|line| vec![line.what, line.measured, line.simulated, line.finding]).collect();
    body.push_str(&table(&["what", "measured", "simulated", "finding"], rows));
    for Drawing { id, caption, svg } in drawings {
        body.push_str(&format!(
            "<figure id=\"{id}\">\n{svg}<figcaption>{}</figcaption>\n</figure>\n",
            escaped(caption)
        ));
    }
    body.push_str("<h2>What is off once joints are fitted</h2>\n");
    body.push_str(&paragraph(&format!("{OFF}.")));
    body.push_str(&by_chance(summary).map_or_else(String::new, |words| paragraph(&words)));
    let off = worth_saying(summary).into_iter();
    let rows: Vec<_> = off.map(|off| vec![off.what.clone(), format!("{:+.1}", off.in_sd)]).collect();
    body.push_str(&match rows.is_empty() {
        true => paragraph("Nothing by two or more."),
        false => table(&["what", "sd"], rows),
    });
    body.push_str(&format!("<h2>Causes</h2>\n{}", paragraph(&format!("{CAUSE}."))));
    let mut rows: Vec<Vec<String>> = summary.causes.iter().take(CAUSES).map(cause).collect();
    for (what, probability) in others(summary) {
        rows.push([what, &format!("{probability:.3}"), "", "", ""].map(String::from).to_vec());
    }
    body.push_str(&table(
        &["cause", "probability", "evidence", "predictive p", "parameters: median and 90 % interval"],
        rows,
    ));
    for cause in summary.causes.iter().filter(|cause| cause.in_verdict) {
        beside_prior(cause).iter().for_each(|words| body.push_str(&paragraph(words)));
    }
    body.push_str(&pairs(summary).map_or_else(String::new, |words| paragraph(&words)));
    if summary.verdict == "unexplained" {
        let mut sentences: Vec<Vec<String>> = summary.form.iter().map(|own| vec![own.sentence()]).collect();
        if sentences.is_empty() {
            sentences.push(vec![NO_FORM.to_owned()]);
        }
        body.push_str(&format!("<h2>What is not explained</h2>\n{}", table(&[FORM], sentences)));
    }
    excluded(summary).iter().for_each(|words| body.push_str(&paragraph(words)));
    let gain = summary.gain.as_ref().map_or_else(String::new, GainSummary::text);
    for (title, text) in [
        ("Gain on held-out readings", gain),
        ("What such data can see, and what to measure next", summary.advice.text()),
    ] {
        if !text.is_empty() {
            body.push_str(&format!("<h2>{title}</h2>\n<pre>{}</pre>\n", escaped(text.trim())));
        }
    }
    body.push_str("<h2>How often such verdicts are right</h2>\n");
    reliability(summary).iter().for_each(|sentence| body.push_str(&paragraph(sentence)));
    body.push_str(&not_used(summary).map_or_else(String::new, |words| paragraph(&format!("{words}."))));
    if let Some(DataEntry { file, sha256 }) = &summary.measured {
        body.push_str(&paragraph(&format!("Measured: {file}, SHA-256 {sha256}.")));
    }
    body.push_str(&paragraph(&format!("Seed {}, bank {}.", summary.seed, summary.bank)));
    format!(
        "<!DOCTYPE html>\n<html lang=\"en-GB\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n<style>\n{STYLE}</style>\n\
         </head>\n<body>\n{body}</body>\n</html>\n",
        escaped(&title)
    )
}

fn cause(cause: &CauseEntry) -> Vec<String> {
    let name = if cause.in_verdict { format!("{} (in the verdict)", cause.id) } else { cause.id.to_string() };
    let [evidence, check] = [cause.evidence, cause.guard_p_value].map(or_dash);
    let parameters: Vec<String> = cause.parameters.iter().map(|parameter| parameter.words()).collect();
    vec![name, format!("{:.3}", cause.probability), evidence, check, parameters.join("; ")]
}

fn paragraph(words: &str) -> String {
    format!("<p>{}</p>\n", escaped(words))
}

fn table(heads: &[&str], rows: Vec<Vec<String>>) -> String {
    let row = |cells: &mut dyn Iterator<Item = &str>, tag: &str| {
        let cells: String = cells.map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let head = row(&mut heads.iter().copied(), "th");
    let rows: String = rows.iter().map(|cells| row(&mut cells.iter().map(String::as_str), "td")).collect();
    format!("<div class=\"wide\"><table>\n{head}{rows}</table></div>\n")
}
