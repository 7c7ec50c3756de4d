//! `pirca sensitivity`: which mechanisms could the measured data see?

use crate::critic::{NoSensitivity, SensitivitySettings, sensitivity as map_of};
use crate::study::described;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::terminal::progress::Tenths;
use crate::verb::locate;
use crate::verb::run::page::{Place, told};
use crate::verb::sensitivity::answer::{SensitivitySummary, sensitivity_document};
use crate::verb::sensitivity::ask::Sensitivity;

/// What the folder and the files of the map are named by.
const SENSITIVITY: &str = "sensitivity";

/// Computes the map, writes it and prints it.
pub(crate) fn sensitivity(arguments: &Sensitivity) -> Result<Answer, Failure> {
    let loaded = locate::measurable(&arguments.which)?;
    let study = loaded.study.clone();
    locate::without_uncertain(&study)?;
    let distributions = locate::distributions(&arguments.which)?;
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let settings = SensitivitySettings {
        members: arguments.members,
        quantile: arguments.quantile,
        threads: arguments.threads,
    };
    let progress = Tenths::of(SENSITIVITY);
    let map = map_of(&study, &mechanisms, &settings, &progress).map_err(failure)?;
    let summary = SensitivitySummary::of(&study, &mechanisms, &settings, &map);
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, SENSITIVITY));
    output::folder(&out)?;
    let place = Place {
        out: &out,
        name: SENSITIVITY,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    told(&sensitivity_document(&summary), &summary, &place)
}

fn failure(error: NoSensitivity) -> Failure {
    match error {
        NoSensitivity::Threads(_) => Failure::Run(error.to_string()),
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
