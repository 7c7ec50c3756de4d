//! Which arms of a study are meant, and at which kn point.

use crate::cli::failure::Failure;
use crate::math::edit_distance;
use crate::study::{Arm, Study};

/// The arms that are named after --arms, by their places in the study and each once; all without names.
pub(super) fn named(study: &Study, names: &[String]) -> Result<Vec<u32>, Failure> {
    if names.is_empty() {
        return Ok((0..study.arms.len() as u32).collect());
    }
    let mut chosen = Vec::new();
    for name in names {
        let Some(place) = study.arms.iter().position(|arm| arm.name == *name) else {
            let known = study.arms.iter().map(|arm| arm.name.as_str());
            let nearest = known.min_by_key(|own| edit_distance(name, own)).unwrap_or_default();
            return Err(Failure::Usage(format!(
                "--arms: {} has no arm `{name}`, the nearest is `{nearest}`; allowed are {}",
                study.name,
                self::names(study)
            )));
        };
        if chosen.contains(&(place as u32)) {
            return Err(Failure::Usage(format!("--arms: `{name}` is named twice; name every arm once")));
        }
        chosen.push(place as u32);
    }
    Ok(chosen)
}

/// The names of all arms.
pub(super) fn names(study: &Study) -> String {
    study.arms.iter().map(|arm| arm.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// That an arm has a kn point of this number.
pub(super) fn has_point(arm: &Arm, point: u32) -> Result<(), Failure> {
    if (point as usize) < arm.kn_points.len() {
        return Ok(());
    }
    Err(Failure::Usage(format!(
        "--point {point}: arm `{}` has {} kn points; allowed is 0 to {}",
        arm.name,
        arm.kn_points.len(),
        arm.kn_points.len() - 1
    )))
}
