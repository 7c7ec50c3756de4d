//! Warns of what scatters from joint to joint where it averages out over the joints of a wall.

use crate::generate::{Arrangement, Layout};
use crate::random::Family;
use crate::study::checked::{Arm, Joint};
use crate::study::fault::{Fault, Found};
use crate::study::raw::Node;
use crate::study::reader::{Notes, join};
use crate::study::schema::Short;
use crate::study::stated::node_at;

/// From so many joints on the mean of a wall has less than a fifth of the scatter of a joint.
const MANY: f64 = 25.0;

/// A property that is drawn once per joint.
struct PerJoint {
    key: &'static str,
    of: fn(&Joint) -> &Family,
    unit: &'static str,
    /// Keys of `[uncertain]` by which the same is drawn once per wall, the usual one first.
    per_wall: &'static [&'static str],
}

static PER_JOINT: [PerJoint; 3] = [
    PerJoint { key: "kn_factor", of: |joint| &joint.kn_factor, unit: "", per_wall: &["joint.kn_pa_per_m"] },
    PerJoint {
        key: "phi_deg",
        of: |joint| &joint.phi_deg,
        unit: " deg",
        per_wall: &["joint.phi_deg", "mechanism.friction.factor"],
    },
    PerJoint {
        key: "cohesion_pa",
        of: |joint| &joint.cohesion,
        unit: " Pa",
        per_wall: &["joint.cohesion_pa"],
    },
];

/// Warns once for each place where a study states such a property. `root` is the tree that the arms were read from.
pub fn warn(root: &Node, arms: &[Arm], notes: &mut Notes) {
    for own in &PER_JOINT {
        let mut seen: Vec<(String, &Arm)> = Vec::new();
        for arm in arms.iter().filter(|arm| own.averages_out(arm)) {
            let key = join("joint", own.key);
            let its_own = format!("arm.{}.{key}", arm.name);
            let path = if node_at(root, &its_own).is_some() { its_own } else { key };
            match seen.iter_mut().find(|(known, _)| *known == path) {
                Some((_, most)) if joints(&most.layout) >= joints(&arm.layout) => {}
                Some((_, most)) => *most = arm,
                None => seen.push((path, arm)),
            }
        }
        for (path, arm) in seen {
            let Some(node) = node_at(root, &path) else { continue };
            notes.warnings.push(own.warning(&path, node, arm));
        }
    }
}

impl PerJoint {
    /// Whether it scatters from joint to joint alone, in a wall of many joints.
    fn averages_out(&self, arm: &Arm) -> bool {
        let scatters = |key: &str| arm.mechanisms.value("specimen_scatter", key).is_some_and(|cov| cov > 0.0);
        let drawn_per_wall = arm.uncertain.iter().any(|drawn| self.per_wall.contains(&drawn.key))
            || match self.key {
                "kn_factor" => scatters("kn_cov"),
                "phi_deg" => scatters("friction_cov"),
                _ => false,
            };
        (self.of)(&arm.joint).sd() > 0.0 && !drawn_per_wall && joints(&arm.layout) >= MANY
    }

    fn warning(&self, path: &str, node: &Node, arm: &Arm) -> Fault {
        let (sd, joints) = ((self.of)(&arm.joint).sd(), rounded(joints(&arm.layout)));
        let [of_one, of_mean] = [sd, sd / joints.sqrt()].map(|x| Short(rounded(x)));
        let unit = self.unit;
        let allowed = format!(
            "this, but it is drawn for each joint and averages out: a wall of arm {} has about {joints} joints, and a standard \
             deviation of {of_one}{unit} in each is one of {of_one} / sqrt({joints}) = {of_mean}{unit} in their mean",
            arm.name
        );
        let fix = format!(
            "if it is one number of a wall that is not known, write a number here, and its distribution as \"{}\" in [uncertain]; leave \
             it, if joints of one wall differ so much",
            self.per_wall[0]
        );
        Fault::at(&node.place, path, Found::Value(node.shown.clone()), allowed, fix)
    }
}

/// A number with two significant digits.
fn rounded(x: f64) -> f64 {
    format!("{x:.1e}").parse().unwrap_or(x)
}

/// About how many joints a wall has, as a file says, or as it is drawn: each stone lies on two stones, in a stack bond on one, and has a neighbour along the wall and
/// across it; those of the lowest course lie on the ground, and those at an end have no neighbour there.
fn joints(layout: &Layout) -> f64 {
    let ([length, height], beds) = match &layout.arrangement {
        Arrangement::File { joints, .. } => return *joints as f64,
        Arrangement::Continuous { length, height } => ([*length, *height], 1.0),
        Arrangement::Discontinuous { length, height, .. } => ([*length, *height], 2.0),
        Arrangement::Coursed { sizes, .. } | Arrangement::Cut { sizes, .. } => (sizes.means(), 2.0),
    };
    let (in_a_course, courses) = (layout.outline.length / length, layout.outline.height / height);
    let places = in_a_course * courses;
    let wythes = f64::from(layout.wythes.count);
    let (lying, upright) = (beds * places - (beds - 1.0) * in_a_course, places - courses);
    (lying + upright) * wythes + places * (wythes - 1.0)
}
