//! `pirca sensitivity`: which mechanisms could the measured data see?

use crate::critic::{NoSensitivity, SensitivitySettings, sensitivity as map_of};
use crate::study::described;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::terminal::progress::Tenths;
use crate::verb::locate;
use crate::verb::sensitivity::answer::{SensitivitySummary, sensitivity_text, write_sensitivity};
use crate::verb::sensitivity::ask::Sensitivity;

/// Computes the map, writes it and prints it.
pub(crate) fn sensitivity(arguments: &Sensitivity) -> Result<Answer, Failure> {
    let study = locate::measurable(&arguments.which)?.study;
    locate::without_uncertain(&study)?;
    let distributions = locate::distributions(&arguments.which)?;
    let mechanisms = described(&distributions).map_err(Failure::Input)?;
    let settings = SensitivitySettings {
        members: arguments.members,
        quantile: arguments.quantile,
        threads: arguments.threads,
    };
    let progress = Tenths::of("sensitivity");
    let map = map_of(&study, &mechanisms, &settings, &progress).map_err(failure)?;
    let summary = SensitivitySummary::of(&study, &mechanisms, &settings, &map);
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, "sensitivity"));
    output::folder(&out)?;
    write_sensitivity(&summary, &out).map_err(|error| Failure::Run(format!("{error:#}")))?;
    let text = format!("{}\nwritten to {}\n", sensitivity_text(&summary), out.display());
    Ok(Answer::of(text, &summary)?.in_place(&out))
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
