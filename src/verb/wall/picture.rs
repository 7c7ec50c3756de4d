//! One member, solved, and drawn as it falls.

use serde_json::json;

use crate::contact;
use crate::ensemble::replace_file;
use crate::math::compact;
use crate::model::{Movement, Replay};
use crate::protocol::{Direction, Protocol, Run};
use crate::render::picture::Picture;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::wall::ask::Wall as Arguments;
use crate::verb::wall::condition::{conditions, hinges};
use crate::verb::wall::drawn::{Measure, drawing, ending, seams, stones, uncoloured};
use crate::verb::wall::frames::Shown;
use crate::verb::wall::one_wall::OneWall;
use crate::verb::wall::{frames, replayed};

/// Solves the member and draws it.
pub(crate) fn picture(arguments: &Arguments) -> Result<Answer, Failure> {
    let chosen = OneWall::of(&arguments.which, &arguments.wall)?;
    let (run, replay) = chosen.replayed_if(arguments.frames.is_some() || arguments.series.is_some());
    let picture = of_wall(&chosen, &run, arguments.colour.unwrap_or_default(), arguments.magnify);
    let OneWall { study, task, kn, .. } = &chosen;
    let (arm, member) = (&study.arms[task.arm as usize], task.member);
    replace_file(&arguments.out, picture.svg().as_bytes())?;
    let states = replay.as_ref().map(|replay| replay.states.len());
    let written =
        replay.map_or(Ok(Vec::new()), |replay| films(arguments, &chosen, &run, (&picture, replay)))?;

    let out = arguments.out.display().to_string();
    let failure = run.failure.as_ref();
    let object = json!({
        "study": study.name, "variant": study.variant, "seed": study.seed,
        "arm": arm.name, "point": task.point, "kn_pa_per_m": kn, "member": member,
        "out": out, "outcome": run.outcome.name(), "magnification": picture.magnification,
        "mode": failure.map(|f| f.mode.name()), "hinge_height_m": failure.map(|f| f.hinge_height),
        "moving_weight_share": failure.map(|f| f.weight_share), "states": states,
    });
    let films: String = written.iter().map(|line| format!("{line}\n")).collect();
    let text = format!("{out}: {}: {}\n{films}", picture.title, ending(&run));
    Ok(Answer::of(text, &object)?.in_place(&arguments.out))
}

/// Writes the states from rest through the collapse as asked; a line for each folder.
fn films(
    arguments: &Arguments,
    chosen: &OneWall,
    run: &Run,
    (picture, mut replay): (&Picture, Replay),
) -> Result<Vec<String>, Failure> {
    let wall = &chosen.generated.wall;
    let states = replay.states.len();
    let mut written = Vec::new();
    if let Some(folder) = &arguments.frames {
        let shown = Shown {
            title: picture.title.clone(),
            wall,
            colour: arguments.colour.unwrap_or_default(),
            magnify: arguments.magnify,
            from_front: picture.from_front,
        };
        let frames = frames::write(folder, &shown, &replay)?;
        written.push(format!("{}: {frames} frames", folder.display()));
    }
    if let Some(folder) = &arguments.series {
        // The ground stays where it is; its id is the one that joints have for it.
        let grounded = wall.clone().with_base();
        let still = grounded.blocks.len() - wall.blocks.len();
        replay.states.iter_mut().for_each(|state| state.poses.extend(vec![Movement::NONE; still]));
        let stones = wall.before_base();
        let name = |id: usize| if id < stones { format!("stone {id}") } else { "ground".to_owned() };
        let moving = run.failure.as_ref().map(|failure| failure.moving.clone()).unwrap_or_default();
        let moves = |id: usize| moving.contains(&(id as u32));
        replayed::write(folder, &picture.title, (&grounded, &name, &moves), &replay)?;
        written.push(format!("{}: {states} states", folder.display()));
    }
    Ok(written)
}

/// The picture of a wall that was solved.
pub(crate) fn of_wall(chosen: &OneWall, run: &Run, colour: Measure, magnify: Option<f64>) -> Picture {
    let OneWall { study, task, kn, generated } = chosen;
    let (arm, member, wall) = (&study.arms[task.arm as usize], task.member, &generated.wall);
    let stones = stones(wall, run);
    let magnification = magnify.unwrap_or_else(|| Picture::fitting(&stones));
    // The ground has joints as well.
    let settings = contact::Settings { inset: 0.0, ..arm.contacts().of_wall(wall) };
    let grounded = wall.clone().with_base();
    let seams = seams(&grounded, &settings, &run.joint_states, colour);
    let falls = run.failure.is_some();
    let conditions = conditions((&grounded, &settings), &stones, &run.joint_states, falls);
    let from_front = !direction(&study.protocol).is_backwards();
    let variant = study.variant.as_ref().map_or(String::new(), |name| format!(", variant {name}"));
    let mut remarks = vec![ending(run), drawing(run, magnification, from_front)];
    remarks.extend(uncoloured(run, &seams, colour));
    Picture {
        stones,
        seams,
        hinges: hinges(&run.joint_states, &conditions, falls),
        thrusts: Vec::new(),
        measure: colour.said().to_owned(),
        unit: colour.unit(),
        from_front,
        magnification,
        title: format!(
            "{}{variant}: arm {}, member {member}, kn {} Pa/m",
            study.name,
            arm.name,
            compact(*kn)
        ),
        remarks,
    }
}

fn direction(protocol: &Protocol) -> Direction {
    match protocol {
        Protocol::Lateral(_) | Protocol::Retaining(_) => Direction::YPlus,
        Protocol::Tilting(tilting) => tilting.towards,
        Protocol::Shear(_) => Direction::XPlus,
        Protocol::BaseMotion(base) => base.towards,
    }
}
