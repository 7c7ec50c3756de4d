//! Which arms of a study are meant, and at which kn point.

use crate::ensemble;
use crate::math::edit_distance;
use crate::study::{Arm, Study};
use crate::terminal::failure::Failure;

/// The arms that are named after --arms, by their places in the study and each once; all without names.
pub(crate) fn named(study: &Study, names: &[String]) -> Result<Vec<u32>, Failure> {
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
pub(crate) fn names(study: &Study) -> String {
    study.arms.iter().map(|arm| arm.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// That an arm has a kn point of this number.
pub(crate) fn has_point(arm: &Arm, point: u32) -> Result<(), Failure> {
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

/// The arm of that name, or the first one that is random, or else the first one.
pub(crate) fn arm_index(study: &Study, name: Option<&str>) -> Result<usize, Failure> {
    let Some(name) = name else {
        let random = study.arms.iter().position(ensemble::is_random);
        return Ok(random.unwrap_or(0));
    };
    study.arms.iter().position(|arm| arm.name == name).ok_or_else(|| {
        let names: Vec<_> = study.arms.iter().map(|arm| arm.name.as_str()).collect();
        Failure::Usage(format!("--arm {name}: the study has no such arm; it has {}", names.join(", ")))
    })
}

/// The joint stiffness (Pa/m) of an arm's point.
pub(crate) fn kn(arm: &Arm, point: u32) -> Result<f64, Failure> {
    arm.kn_points.get(point as usize).copied().ok_or_else(|| {
        let points = numbered(arm.kn_points.len() as u64, "kn point");
        Failure::Usage(format!(
            "--point {point}: arm {} has {points}; choose one of them, or add to kn_pa_per_m in study.toml",
            arm.name
        ))
    })
}

/// So many things that are numbered from 0, in words.
pub(crate) fn numbered(count: u64, thing: &str) -> String {
    match count {
        1 => format!("one {thing}, number 0"),
        _ => format!("{count} {thing}s, numbers 0 to {}", count - 1),
    }
}
