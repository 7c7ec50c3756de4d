//! `pirca picture`: one member, solved, and drawn as it falls.

use std::path::Path;

use serde_json::json;

use crate::cli::arguments::{Measure, Picture as Arguments};
use crate::cli::failure::Failure;
use crate::cli::one_wall::OneWall;
use crate::cli::output;
use crate::contact::{self, find_patch};
use crate::ensemble::replace_file;
use crate::math::Vec3;
use crate::model::{Outcome, Wall};
use crate::protocol::{self, Direction, JointState, Protocol, Run, typical_size};
use crate::report::{Movement, Picture, Seam, Stone};
use crate::study::Arm;

/// Solves the member and draws it.
pub(crate) fn picture(arguments: &Arguments) -> Result<(), Failure> {
    if !is_svg(&arguments.out) {
        return Err(Failure::Usage(format!(
            "--out {}: the picture is an SVG file, so its name must end in .svg",
            arguments.out.display()
        )));
    }
    let chosen = OneWall::of(&arguments.which, &arguments.wall)?;
    let run = chosen.solved();
    let OneWall { study, task, kn, generated } = &chosen;
    let (arm, member, wall) = (&study.arms[task.arm as usize], task.member, &generated.wall);

    let stones = stones(wall, &run);
    let magnification = arguments.magnify.unwrap_or_else(|| Picture::fitting(&stones));
    let seams = seams(wall, arm, &run.joint_states, arguments.colour);
    let from_front = !direction(&study.protocol).is_backwards();
    let variant = study.variant.as_ref().map_or(String::new(), |name| format!(", variant {name}"));
    let ending = ending(&run);
    let mut remarks = vec![ending.clone(), drawing(&run, magnification, from_front)];
    remarks.extend(uncoloured(&run, &seams, arguments.colour));
    let picture = Picture {
        stones,
        seams,
        measure: arguments.colour.said().to_owned(),
        from_front,
        magnification,
        title: format!("{}{variant}: arm {}, member {member}, kn {kn:e} Pa/m", study.name, arm.name),
        remarks,
    };
    replace_file(&arguments.out, picture.svg().as_bytes())?;

    let out = arguments.out.display().to_string();
    if arguments.which.json {
        let failure = run.failure.as_ref();
        return output::print_json(&json!({
            "study": study.name, "variant": study.variant, "seed": study.seed,
            "arm": arm.name, "point": task.point, "kn_pa_per_m": kn, "member": member,
            "out": out, "outcome": run.outcome.name(), "magnification": magnification,
            "mode": failure.map(|f| f.mode.name()), "hinge_height_m": failure.map(|f| f.hinge_height),
            "moving_weight_share": failure.map(|f| f.weight_share),
        }));
    }
    output::print(&format!("{out}: {}: {ending}\n", picture.title))
}

fn is_svg(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == "svg")
}

fn direction(protocol: &Protocol) -> Direction {
    match protocol {
        Protocol::Lateral(_) => Direction::YPlus,
        Protocol::Tilting(tilting) => tilting.towards,
        Protocol::Shear(_) => Direction::XPlus,
    }
}

/// The blocks with their movement: the mechanism from the last state at rest, or where there is none all that they moved.
fn stones(wall: &Wall, run: &Run) -> Vec<Stone> {
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

/// The joints between stones, and between them and the ground, where they were built.
fn seams(wall: &Wall, arm: &Arm, joints: &[JointState], measure: Measure) -> Vec<Seam> {
    let grounded = wall.clone().with_base();
    let settings = contact::Settings::for_size(typical_size(wall), arm.sub_contacts);
    let seam = |joint: &JointState| {
        let blocks = joint.blocks.map(|id| id as usize);
        let [first, second] = blocks.map(|id| grounded.blocks.get(id));
        // The ground is the preferred reference.
        let patch = find_patch(&second?.shape, &first?.shape, &settings)?;
        let polygon: Vec<Vec3> = patch.polygon.vertices.iter().map(|&st| patch.frame.lift(st)).collect();
        Some(Seam { blocks, polygon, value: measure.of(joint) })
    };
    joints.iter().filter_map(seam).collect()
}

impl Measure {
    /// The value of a joint (m).
    fn of(self, joint: &JointState) -> f64 {
        match self {
            Measure::Opening => joint.opening,
            // Elastic shear is no slip.
            Measure::Slip if joint.slipped > 0.0 => joint.slip,
            Measure::Slip => 0.0,
        }
    }

    /// What it is, for the colour bar.
    fn said(self) -> &'static str {
        match self {
            Measure::Opening => "opening of joints at their widest, at the last state at rest",
            Measure::Slip => "slip of joints up to the last state at rest",
        }
    }

    fn verb(self) -> &'static str {
        match self {
            Measure::Opening => "opened",
            Measure::Slip => "slipped",
        }
    }
}

/// How the wall ended.
fn ending(run: &Run) -> String {
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
fn drawing(run: &Run, magnification: f64, from_front: bool) -> String {
    let what = match &run.failure {
        Some(_) => format!("The movement of the fall, as far as it was watched, times {magnification}"),
        None => format!("Drawn at rest, with displacements since it was built times {magnification}"),
    };
    let (side, end) = if from_front { ("front (+y)", "right") } else { ("back (-y)", "left") };
    format!("{what}; seen from the {side}, x = 0 on the {end}.")
}

/// Why no joint is coloured, if none is.
fn uncoloured(run: &Run, seams: &[Seam], measure: Measure) -> Option<String> {
    if run.joint_states.is_empty() {
        return Some("The wall never came to rest: what its joints did was not read.".to_owned());
    }
    seams.iter().all(|seam| seam.value <= 0.0).then(|| format!("No joint {}.", measure.verb()))
}
