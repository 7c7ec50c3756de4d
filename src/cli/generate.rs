//! `pirca generate`: the wall of one member, as a file that other programs read.

use std::path::Path;

use serde_json::json;

use crate::cli::arguments::Generate;
use crate::cli::failure::Failure;
use crate::cli::{locate, output};
use crate::ensemble::{self, Task, replace_file};
use crate::model::Wall;
use crate::protocol::Run;
use crate::study::{Arm, Study};
use crate::{exchange, report};

/// The formats that a wall is written in, by the ending of the file.
#[derive(Clone, Copy, PartialEq)]
enum Format {
    Vtu,
    Obj,
    Json,
}

/// Builds the wall and writes it.
pub(crate) fn generate(arguments: &Generate) -> Result<(), Failure> {
    let format = format_of(&arguments.out)?;
    if arguments.solved && format != Format::Vtu {
        return Err(Failure::Usage(
            "--solved: only a .vtu file holds displacements; give --out FILE.vtu".to_owned(),
        ));
    }
    let mut study = locate::study(&arguments.which)?.study;
    if let Some(seed) = arguments.seed {
        study = study.with_seed(seed);
    }
    let index = arm_index(&study, arguments.arm.as_deref())?;
    let (arm, member) = (study.arms[index].name.as_str(), arguments.member);
    let kn = kn(&study.arms[index], arguments.point)?;
    let generated = ensemble::build(&study, index as u32, member)
        .map_err(|e| Failure::Run(format!("arm {arm}, member {member}: invalid geometry: {e}")))?;
    let solved = arguments.solved.then(|| {
        ensemble::solve(&study, Task { arm: index as u32, point: arguments.point, member }, &generated.wall)
    });
    let wall = if arguments.with_base { generated.wall.with_base() } else { generated.wall };
    replace_file(&arguments.out, encoded(format, &wall, solved.as_ref()).as_bytes())?;

    let (out, stones) = (arguments.out.display().to_string(), wall.stones().count());
    let (wedges, headers) = (generated.realised.wedges, generated.realised.headers);
    if arguments.which.json {
        return output::print_json(&json!({
            "study": study.name, "variant": study.variant, "seed": study.seed,
            "arm": arm, "point": arguments.point, "kn_pa_per_m": kn, "member": member,
            "out": out, "stones": stones, "wedges": wedges, "headers": headers,
            "attempts": generated.attempts, "redraws": generated.redraws, "merges": generated.merges,
            "volume_m3": generated.realised.volume, "outcome": solved.map(|run| run.outcome.name()),
        }));
    }
    let ending = solved.map_or(String::new(), |run| format!("; {}", run.outcome.name()));
    output::print(&format!(
        "{out}: arm {arm}, member {member}, kn {kn:e} Pa/m: {stones} stones, of them {wedges} wedges and {headers} headers; {:.4} m3{ending}\n",
        generated.realised.volume
    ))
}

fn encoded(format: Format, wall: &Wall, solved: Option<&Run>) -> String {
    match format {
        Format::Vtu => report::write_vtu(wall, solved.map(|run| run.displacements.as_slice())),
        Format::Obj => exchange::write_obj(wall),
        Format::Json => exchange::write_wall_json(wall),
    }
}

fn format_of(path: &Path) -> Result<Format, Failure> {
    match path.extension().and_then(|ending| ending.to_str()) {
        Some("vtu") => Ok(Format::Vtu),
        Some("obj") => Ok(Format::Obj),
        Some("json") => Ok(Format::Json),
        _ => Err(Failure::Usage(format!(
            "--out {}: the ending of the file says the format and must be .vtu, .obj or .json",
            path.display()
        ))),
    }
}

/// The arm of that name, or the first one that is random, or else the first one.
pub(super) fn arm_index(study: &Study, name: Option<&str>) -> Result<usize, Failure> {
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
pub(super) fn kn(arm: &Arm, point: u32) -> Result<f64, Failure> {
    arm.kn_points.get(point as usize).copied().ok_or_else(|| {
        let last = arm.kn_points.len() - 1;
        Failure::Usage(format!("--point {point}: arm {} has points 0 to {last}", arm.name))
    })
}
