//! `pirca detectability`: which mechanisms could the measured data see?

use crate::critic::{DetectabilitySettings, NoDetectability, detectability as map_of};
use crate::study::described;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::terminal::progress::Tenths;
use crate::verb::detectability::answer::{DetectabilitySummary, detectability_document};
use crate::verb::detectability::ask::Detectability;
use crate::verb::locate;
use crate::verb::run::page::{Place, told};

/// What the folder and the files of the map are named by.
const DETECTABILITY: &str = "detectability";

/// Computes the map, writes it and prints it.
pub(crate) fn detectability(arguments: &Detectability) -> Result<Answer, Failure> {
    let loaded = locate::measurable(&arguments.which)?;
    let study = loaded.study.clone();
    locate::without_uncertain(&study)?;
    let distributions = locate::distributions(&arguments.which)?;
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let settings = DetectabilitySettings {
        members: arguments.members,
        quantile: arguments.quantile,
        threads: arguments.threads,
    };
    let progress = Tenths::of(DETECTABILITY);
    let map = map_of(&study, &mechanisms, &settings, &progress).map_err(failure)?;
    let summary = DetectabilitySummary::of(&study, &mechanisms, &settings, &map);
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, DETECTABILITY));
    output::folder(&out)?;
    let place = Place {
        out: &out,
        name: DETECTABILITY,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    told(&detectability_document(&summary), &summary, &place)
}

fn failure(error: NoDetectability) -> Failure {
    match error {
        NoDetectability::Threads(_) => Failure::Run(error.to_string()),
        _ => Failure::Input(error.to_string()),
    }
}

/// A quantile, above 0 and below 1.
pub(crate) fn quantile(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(u) if u > 0.0 && u < 1.0 => Ok(u),
        _ => Err("a number above 0 and below 1 is needed".to_string()),
    }
}
