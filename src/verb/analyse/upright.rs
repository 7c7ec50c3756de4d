//! A wall that does not even stand at rest may lie on its back: another axis of its file points up.

use crate::law::Coulomb;
use crate::math::Vec3;
use crate::model::Wall;
use crate::solve::{STANDARD_GRAVITY, limit};
use crate::study::Fit;
use crate::verb::analyse::ask::UpName;

/// Asks whether another axis of the file points up, where a wall that is unstable at rest would stand so.
pub(crate) fn question(wall: &Wall, law: &Coulomb, fit: &Fit, up: UpName, is_turned: bool) -> Option<String> {
    // The axes of the file in those of the wall.
    let axes = match up {
        UpName::X => [("y", Vec3::x()), ("z", Vec3::y())],
        UpName::Z => [("x", Vec3::x()), ("y", Vec3::y())],
        UpName::Y => [("x", Vec3::x()), ("z", -Vec3::y())],
    };
    let analysis = limit::Analysis::new(wall, law, fit.contact, limit::Settings::default());
    let stands = |axis: &Vec3| {
        let loads = limit::Loads { dead: -axis * STANDARD_GRAVITY, ..limit::Loads::default() };
        analysis.stands(&loads).stands == Some(true)
    };
    // Springs that are too soft, and not the axis, bring down what stands as rigid blocks.
    if stands(&Vec3::z()) {
        return None;
    }
    let (name, _) = axes.into_iter().find(|(_, axis)| stands(axis))?;
    let how = match (is_turned, name) {
        (true, _) => format!("ask with --up {name}"),
        _ => "turn it so that z points up".to_owned(),
    };
    Some(format!(
        "with {} up it does not stand under its own weight; it would with {name} up: does the {name} axis of the file point up? Then {how}",
        up.name()
    ))
}
