//! How a wall that was solved is drawn: its blocks where the fall takes them, its joints by what they did, and what is said below.

use clap::ValueEnum;

use crate::contact::find_patch;
use crate::math::Vec3;
use crate::model::{JointReading, Movement, Outcome, Wall};
use crate::protocol::{JointState, Run};
use crate::render::picture::{Seam, Stone};
use crate::{contact, protocol};

/// What joints are coloured by.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum Measure {
    #[default]
    /// How far they gape at their widest.
    Opening,
    /// How far they have slipped.
    Slip,
    /// How hard the blocks press on each other, over the whole area of the joint.
    Stress,
}

/// The blocks with their movement: the mechanism from the last state at rest, or where there is none all that they moved.
pub(crate) fn stones(wall: &Wall, run: &Run) -> Vec<Stone> {
    let at_rest = |id: usize| Movement { shift: run.displacements[id], turn: run.turns[id] };
    let fall = |failure: &protocol::Failure, id: usize| Movement {
        shift: failure.motion[id],
        turn: failure.turns[id],
    };
    // A wall that never came to rest is left where its fall took it.
    let rested = !run.joint_states.is_empty();
    let stone = |(id, shape)| match &run.failure {
        Some(failure) => {
            let before = if rested { at_rest(id) } else { Movement::NONE };
            Stone { shape, before, movement: fall(failure, id) }
        }
        None => Stone { shape, before: Movement::NONE, movement: at_rest(id) },
    };
    wall.blocks.iter().map(|block| block.shape.clone()).enumerate().map(stone).collect()
}

/// The joints of a wall, where they were built.
pub(crate) fn seams(
    wall: &Wall,
    settings: &contact::Settings,
    joints: &[JointState],
    measure: Measure,
) -> Vec<Seam> {
    let seam = |joint: &JointState| {
        let blocks = joint.blocks.map(|id| id as usize);
        let [first, second] = blocks.map(|id| wall.blocks.get(id));
        // The ground is the preferred reference.
        let patch = find_patch(&second?.shape, &first?.shape, settings)?;
        let polygon: Vec<Vec3> = patch.polygon.vertices.iter().map(|&st| patch.frame.lift(st)).collect();
        Some(Seam { blocks, polygon, value: measure.of(joint) })
    };
    joints.iter().filter_map(seam).collect()
}

impl Measure {
    /// The value of a joint (m, Pa).
    pub fn of(self, joint: &JointState) -> f64 {
        match self {
            Measure::Opening => joint.opening,
            // Elastic shear is no slip.
            Measure::Slip if joint.slipped > 0.0 => joint.slip,
            Measure::Slip => 0.0,
            Measure::Stress => joint.pressure.max(0.0),
        }
    }

    /// The same of a joint in a replay.
    pub fn read(self, joint: &JointReading) -> f64 {
        match self {
            Measure::Opening => joint.opening,
            Measure::Slip => joint.slip,
            Measure::Stress => joint.normal_stress.max(0.0),
        }
    }

    /// What it is in a replay, for the colour bar.
    pub fn in_words(self) -> &'static str {
        match self {
            Measure::Opening => "opening of joints at their widest",
            Measure::Slip => "movement of blocks along their joints, elastic shear in it",
            Measure::Stress => "pressure between blocks over the joint",
        }
    }

    /// What it is, for the colour bar.
    pub fn said(self) -> &'static str {
        match self {
            Measure::Opening => "opening of joints at their widest, at the last state at rest",
            Measure::Slip => "slip of joints up to the last state at rest",
            Measure::Stress => "pressure between blocks over the joint, at the last state at rest",
        }
    }

    /// The unit in which it is shown, and how many of it make one in SI units.
    pub fn unit(self) -> (&'static str, f64) {
        match self {
            Measure::Opening | Measure::Slip => ("mm", 1e3),
            Measure::Stress => ("kPa", 1e-3),
        }
    }

    /// What is said where no joint has any.
    pub fn none(self) -> &'static str {
        match self {
            Measure::Opening => "No joint opened.",
            Measure::Slip => "No joint slipped.",
            Measure::Stress => "No joint is pressed.",
        }
    }
}

/// How the wall ended.
pub(crate) fn ending(run: &Run) -> String {
    let fell = match &run.outcome {
        Outcome::Collapsed { at } => format!("Falls at {at}"),
        Outcome::Equilibrium => {
            let at = run.steps.last().map_or(String::new(), |step| format!(" at {}", step.level));
            return format!("Does not fall: at rest{at}, the end of the load path.");
        }
        Outcome::UnstableAtRest => "Does not stand under its own weight".to_owned(),
        other => return format!("No collapse was found: {}: {}.", other.name(), other.reason()),
    };
    run.failure.as_ref().map_or(format!("{fell}."), |failure| {
        format!(
            "{fell}: {}; {:.0} % of the weight moves, hinge {:.0} mm above the foot.",
            failure.mode.name(),
            100.0 * failure.weight_share,
            1e3 * failure.hinge_height
        )
    })
}

/// What is drawn, how large, and seen from where.
pub(crate) fn drawing(run: &Run, magnification: f64, from_front: bool) -> String {
    let what = match &run.failure {
        Some(_) => format!("The movement of the fall, as far as it was watched, times {magnification}"),
        None => format!("Drawn at rest, with displacements since it was built times {magnification}"),
    };
    let (side, end) = sides(from_front);
    format!("{what}; seen from the {side}, x = 0 on the {end}.")
}

/// The side that a picture is seen from, and at which end of it x = 0 is.
pub(crate) fn sides(from_front: bool) -> (&'static str, &'static str) {
    if from_front { ("front (+y)", "right") } else { ("back (-y)", "left") }
}

/// Why no joint is coloured, if none is.
pub(crate) fn uncoloured(run: &Run, seams: &[Seam], measure: Measure) -> Option<String> {
    if run.joint_states.is_empty() {
        return Some("The wall never came to rest: what its joints did was not read.".to_owned());
    }
    seams.iter().all(|seam| seam.value <= 0.0).then(|| measure.none().to_owned())
}
