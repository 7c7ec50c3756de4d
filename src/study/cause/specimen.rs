//! Joints that differ from specimen to specimen.

use crate::random::Family;
use crate::study::cause::entry::{Acts, Cause, table};
use crate::study::joints::JointSite;
use crate::study::keys::real;
use crate::study::schema::Presence::Required;
use crate::study::schema::{Interval, Key};

/// Lognormal factors of mean 1, drawn once per wall: on the joints of the base model, which other causes then change. `[uncertain]`
/// draws the same from the same streams, so that a wall is the same, whichever way its stiffness is stated to scatter.
pub static SPECIMEN_SCATTER: Cause = Cause {
    name: "specimen_scatter",
    title: "joints that differ from specimen to specimen",
    means: "joints differ from specimen to specimen",
    acts: Acts::Joints,
    confounded: &["size_scatter", "contact_area", "bearing_points"],
    section: table(
        "[mechanism.specimen_scatter]",
        "Joint properties that vary from specimen to specimen: lognormal factors of mean 1, drawn once per wall.",
        &[&[
            Key::new(
                "kn_cov",
                real("1", Interval::closed(0.0, 10.0)),
                Required,
                "COV of a factor on kn and ks.",
            ),
            Key::new(
                "friction_cov",
                real("1", Interval::closed(0.0, 10.0)),
                Required,
                "COV of a factor on tan(phi) of the stones' joints.",
            ),
        ]],
    ),
    priors: priors!("specimen_scatter": "kn_cov", "friction_cov"),
    sketch: include_str!("sketch/specimen_scatter.svg"),
    shows: "Three walls of the same stones, numbered 1 to 3, have smooth, wavy and rough bed joints.",
    draws: true,
    first: true,
    law: |[kn_cov, friction_cov, ..], law, site| {
        let [stiffness, tan_phi] = [factor(kn_cov, "kn", site), factor(friction_cov, "tan_phi", site)];
        (law.ks, law.tan_phi) = (law.ks * stiffness, law.tan_phi * tan_phi);
        law.normal = law.normal.scaled(stiffness);
    },
    ..Cause::NOTHING
};

fn factor(cov: f64, quantity: &str, site: &JointSite<'_>) -> f64 {
    match cov {
        0.0 => 1.0,
        _ => Family::Lognormal { mean: 1.0, sd: cov }
            .sample(&mut site.streams.of(&format!("specimen {quantity}"))),
    }
}
