//! The extended study of a cause: an ordinary study in a folder of its own, at the medians, with draws as variants.

use std::fs;
use std::path::Path;

use anyhow::{Context, Result};

use crate::critic::{Extension, Known};
use crate::ensemble::replace_file;
use crate::render::number::with_interval;
use crate::study::{Described, Stated, Study};

/// Folder of the extended studies within that of a diagnosis.
pub const EXTENDED: &str = "extended";
/// The files of an extended study.
const FILES: [&str; 3] = ["study.toml", "measured.csv", "published.toml"];

/// What an extended study is made from.
#[derive(Clone, Copy, Debug)]
pub struct Origin<'a> {
    /// The study that was diagnosed.
    pub study: &'a Study,
    /// What its files state.
    pub stated: &'a Stated,
    /// Seed of the diagnosis.
    pub seed: u64,
    /// Hash of the bank's design.
    pub bank: &'a str,
}

/// Writes the study that a cause extends into a folder, with the measurements and the published statements of its origin.
///
/// # Errors
/// The faults of values that their keys do not allow; the file that could not be written, and why.
pub fn write_extended(origin: &Origin<'_>, extension: &Extension, dir: &Path) -> Result<()> {
    let Origin { study, stated, .. } = origin;
    let count = extension.draws.len();
    let draws = extension.draws.iter().enumerate().map(|(k, point)| {
        let why = format!("Draw {} of {count} from what the measurements leave open.", k + 1);
        (format!("draw-{:02}", k + 1), why, point.clone())
    });
    let extended = study.extended(stated, &extension.median, draws.collect())?;
    let text = header(origin, extension) + "\n" + &extended.to_toml();
    fs::create_dir_all(dir).with_context(|| format!("cannot create the folder {}", dir.display()))?;
    let contents = [Some(text.as_str()), stated.measured().map(|(text, _)| text), stated.published()];
    for (name, text) in FILES.iter().zip(contents) {
        match text {
            Some(text) => replace_file(&dir.join(name), text.as_bytes())?,
            None => drop(fs::remove_file(dir.join(name))),
        }
    }
    write_beside(stated, dir)
}

/// Writes the files of a study's walls and its records into the folder of another one, by the names that it gives them.
pub fn write_beside(stated: &Stated, dir: &Path) -> Result<()> {
    for (name, bytes) in stated.beside() {
        let path = dir.join(name);
        let folder = path.parent().unwrap_or(dir);
        fs::create_dir_all(folder)
            .with_context(|| format!("cannot create the folder {}", folder.display()))?;
        replace_file(&path, bytes)?;
    }
    Ok(())
}

/// Name of the folder of the study that mechanisms extend.
pub fn extended_name(mechanisms: &[&str]) -> String {
    mechanisms.join("-and-")
}

/// Takes away the extended studies of an earlier diagnosis in the same folder, whose verdict this is not any more; what else
/// lies there stays.
pub fn remove_extended(mechanisms: &[Described], dir: &Path) {
    let alone = mechanisms.iter().map(|mechanism| mechanism.name.to_string());
    let pairs = mechanisms
        .iter()
        .flat_map(|one| mechanisms.iter().map(|other| extended_name(&[one.name, other.name])));
    for folder in alone.chain(pairs).map(|name| dir.join(EXTENDED).join(name)) {
        // What is not there needs not be taken away.
        FILES.iter().for_each(|name| drop(fs::remove_file(folder.join(name))));
        let _ = fs::remove_dir(folder);
    }
    let _ = fs::remove_dir(dir.join(EXTENDED));
}

/// What it is, where it comes from, and what is known of its values, as comments.
fn header(origin: &Origin<'_>, extension: &Extension) -> String {
    let Origin { study, stated, seed, bank } = origin;
    let mut names: Vec<&str> = extension.median.acting.iter().map(|own| own.mechanism).collect();
    // One that acts on some arms in another way than on others is there once for each.
    names.dedup();
    let count = extension.draws.len();
    let variant = study.variant.as_ref().map(|variant| format!(", variant {variant}")).unwrap_or_default();
    let sha256 = stated.measured().map_or("none", |(_, sha256)| sha256);
    let mut lines = vec![
        format!("Made by `pirca diagnose` from the study {:?}{variant}, seed {seed}.", study.name),
        format!("SHA-256 of the measurements: {sha256}"),
        format!("Hash of the bank's design:   {bank}"),
        String::new(),
        format!(
            "The study with {} at the median of what the measurements leave open, and the joints of the families measured",
            names.join(" and ")
        ),
        format!(
            "at theirs. Variants draw-01 to draw-{count:02}: draws, of which all values belong together."
        ),
    ];
    for (name, has) in
        names.iter().map(|&name| (name, study.arms_with(name))).filter(|(_, has)| !has.is_empty())
    {
        let what = match name {
            "gauge_offset" | "gauge_scale" => {
                "what was found acts on what it shows, and both stand here as one"
            }
            _ => "it stays there as it is",
        };
        lines.push(format!("The study has {name} on already in {}: {what}.", has.join(", ")));
    }
    for name in names.iter().filter(|name| study.leaves_limit_analysis(name)) {
        lines.push(format!("Limit analysis beside the solver is left out: it cannot take {name}."));
    }
    lines.extend([String::new(), "Median and 90 % interval:".to_string()]);
    let width = extension.known.iter().map(|known| known.key.len()).max().unwrap_or(0);
    lines.extend(extension.known.iter().map(|Known { key, unit, median, interval }| {
        let unit = if *unit == "1" { String::new() } else { format!(" {unit}") };
        format!("  {key:<width$}  {}{unit}", with_interval(Some(*median), Some(*interval), 4))
    }));
    if !stated.written_out.is_empty() {
        lines.extend([String::new(), "Written out, as it stood in `distributions`:".to_string()]);
    }
    lines.extend(stated.written_out.iter().map(|used| {
        let source = used.source.split_whitespace().collect::<Vec<_>>().join(" ");
        format!("  {} = {}: {}, {source}", used.key, used.reference, used.status)
    }));
    lines.iter().map(|line| format!("# {line}").trim_end().to_string() + "\n").collect()
}
