//! What is asked in vain of a wall that holds something back, or is missing.

use crate::protocol::{NoFill, Retained, WATER};
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::{Analyse, Growing, LoadName};
use crate::verb::analyse::held::pressing::retained;

/// Before the wall is read.
pub(crate) fn refused(asked: &Analyse) -> Result<(), Failure> {
    let usage = |words: String| Err(Failure::Usage(words));
    let (load, behind) = (asked.load.name(), &asked.behind);
    if let Some((own, option, _)) = behind.given().into_iter().find(|(own, _, is)| *is && *own != load) {
        return usage(format!(
            "{option} is for --load {own}, and the load is {load}: ask for that load, or leave {option} out"
        ));
    }
    let missing = match asked.load {
        LoadName::Fill if behind.fill_density.is_none() => "--fill-density KG_PER_M3, as --fill-density 1800",
        LoadName::Fill if behind.fill_phi_deg.is_none() => "--fill-phi-deg DEG, as --fill-phi-deg 35",
        LoadName::Pressure if behind.pressure_pa.is_none() => "--pressure-pa PA, as --pressure-pa 1000",
        LoadName::Point if behind.crest_force.or(behind.crest_line).is_none() => {
            "--crest-force N or --crest-line N_PER_M, as --crest-line 1000"
        }
        _ => "",
    };
    if !missing.is_empty() {
        return usage(format!("--load {load} needs {missing}"));
    }
    if let Some(Retained::Fill(fill)) = retained(asked)
        && let Some(wrong) = fill.wrong()
    {
        let [slope, phi] = [behind.fill_slope_deg, behind.fill_phi_deg].map(Option::unwrap_or_default);
        return usage(match wrong {
            NoFill::TooSteep => format!(
                "--fill-slope-deg {slope} is above --fill-phi-deg {phi}: no soil without cohesion lies steeper than its friction angle; give at most {phi}"
            ),
            NoFill::TooLight => format!(
                "--fill-density {} with --undrained is that of soil full of water, which is heavier than water, {WATER} kg/m^3: give it so, or leave --undrained out",
                fill.density
            ),
        });
    }
    if !matches!(asked.growing(), Growing::Height | Growing::Factor) {
        return Ok(());
    }
    let in_vain = [
        (
            "--worst-direction",
            asked.worst_direction,
            "what pushes lies on one side: say with --direction where it pushes to",
        ),
        ("--settle", !asked.settlements.is_empty(), "it is for --load tilt and lateral"),
        ("--step-deg", asked.step_deg.is_some(), "it is for --load tilt and lateral"),
        ("--fclib", asked.fclib.is_some(), "it is for --load tilt and lateral"),
    ];
    match in_vain.into_iter().find(|(_, is_asked, _)| *is_asked) {
        Some((name, _, why)) => usage(format!("{name} is not for --load {load}: {why}; leave it out")),
        None => Ok(()),
    }
}
