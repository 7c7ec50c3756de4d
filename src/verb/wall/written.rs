//! The wall of one member, as a file that other programs read.

use serde_json::json;

use crate::ensemble::replace_file;
use crate::exchange;
use crate::math::compact;
use crate::model::{Movement, Wall};
use crate::protocol::Run;
use crate::render::vtk::write_vtu;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::verb::wall::ask::Wall as Arguments;
use crate::verb::wall::one_wall::OneWall;

/// The formats that a wall is written in, by the ending of the file.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Format {
    Vtu,
    Obj,
    Json,
}

impl Format {
    /// The one of an ending.
    pub fn named(ending: &str) -> Option<Format> {
        match ending {
            "vtu" => Some(Format::Vtu),
            "obj" => Some(Format::Obj),
            "json" => Some(Format::Json),
            _ => None,
        }
    }
}

/// Builds the wall and writes it.
pub(super) fn write(arguments: &Arguments, format: Format) -> Result<Answer, Failure> {
    if arguments.solved && format != Format::Vtu {
        return Err(Failure::Usage(
            "--solved: only a .vtu file holds displacements; give --out FILE.vtu".to_owned(),
        ));
    }
    let chosen = OneWall::of(&arguments.which, &arguments.wall)?;
    let solved = arguments.solved.then(|| chosen.solved());
    let OneWall { study, task, kn, generated } = chosen;
    let (arm, member) = (study.arms[task.arm as usize].name.as_str(), task.member);
    let wall = if arguments.with_base { generated.wall.with_base() } else { generated.wall };
    replace_file(&arguments.out, encoded(format, &wall, solved.as_ref()).as_bytes())?;

    let (out, stones) = (arguments.out.display().to_string(), wall.stones().count());
    let (wedges, headers) = (generated.realised.wedges, generated.realised.headers);
    let object = json!({
        "study": study.name, "variant": study.variant, "seed": study.seed,
        "arm": arm, "point": task.point, "kn_pa_per_m": kn, "member": member,
        "out": out, "stones": stones, "wedges": wedges, "headers": headers,
        "attempts": generated.attempts, "redraws": generated.redraws, "merges": generated.merges,
        "volume_m3": generated.realised.volume, "outcome": solved.as_ref().map(|run| run.outcome.name()),
    });
    let ending = solved.map_or(String::new(), |run| format!("; {}", run.outcome.name()));
    let text = format!(
        "{out}: arm {arm}, member {member}, kn {} Pa/m: {stones} stones, of them {wedges} wedges and {headers} headers; {:.4} m3{ending}\n",
        compact(kn),
        generated.realised.volume
    );
    Ok(Answer::of(text, &object)?.in_place(&arguments.out))
}

fn encoded(format: Format, wall: &Wall, solved: Option<&Run>) -> String {
    match format {
        Format::Vtu => write_vtu(wall, solved.map(moved).as_deref()),
        Format::Obj => exchange::write_obj(wall),
        Format::Json => exchange::write_wall_json(wall),
    }
}

/// How every block has moved at the last state at rest.
fn moved(run: &Run) -> Vec<Movement> {
    let both = run.displacements.iter().zip(&run.turns);
    both.map(|(&shift, &turn)| Movement { shift, turn }).collect()
}
