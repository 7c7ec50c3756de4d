//! What `analyse --out` writes of a wall: a page, a picture, files for ParaView, and tables of its blocks and joints.

use std::path::Path;

use serde_json::{Value, json};

use crate::ensemble::{remove_file, replace_file};
use crate::exchange::{Format, WallFile, write_wall_json};
use crate::math::Vec3;
use crate::model::{Block, Movement, Replay, Support, Wall};
use crate::protocol::JointState;
use crate::render::csv::Csv;
use crate::render::picture::{Picture, Stone};
use crate::render::vtk::write_vtu;
use crate::study::Fit;
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::Analyse;
use crate::verb::analyse::page::{Source, Told, page};
use crate::verb::analyse::state::State;
use crate::verb::analyse::views::AlongAxes;
use crate::verb::analyse::{closed, joints, mended};
use crate::verb::arguments::SolverName;
use crate::verb::wall::condition::hinges;
use crate::verb::wall::drawn::{Measure, seams, sides};
use crate::verb::wall::replayed;

/// The answer as an object.
pub(crate) const ANALYSIS: &str = "analysis.json";
/// Columns of `blocks.csv` and `joints.csv`.
const BLOCKS: &str = "block,name,fixed,moves,rest_x_m,rest_y_m,rest_z_m,rest_turn_x_rad,rest_turn_y_rad,rest_turn_z_rad,\
                      mechanism_x,mechanism_y,mechanism_z,mechanism_turn_x,mechanism_turn_y,mechanism_turn_z";
const JOINTS: &str = "block_a,block_b,state,x_m,y_m,z_m,area_m2,opening,slip,slipped_share,force_on_b_x_n,force_on_b_y_n,force_on_b_z_n,\
                      pressure_pa";

/// A wall that was solved, with all that is shown of it.
pub(crate) struct Seen<'a> {
    pub asked: &'a Analyse,
    pub file: &'a WallFile,
    pub fit: &'a Fit,
    pub answer: &'a Answer,
    pub state: &'a State,
    /// The states that it goes through.
    pub replay: &'a Replay,
}

/// Writes its page alone.
pub(crate) fn write_page(path: &Path, of: &Seen<'_>, told: &Told<'_>) -> Result<(), Failure> {
    let picture = picture(of.asked, (of.file, of.fit), of.answer, of.state);
    let source = Source::again(&of.asked.wall, of.file)?;
    let views = AlongAxes::of(of.asked, of.file, told.mended);
    let text =
        page(of.asked, (of.file, &source), (of.answer, of.state), (&picture, &views, of.replay), told)?;
    Ok(replace_file(path, text.as_bytes())?)
}

/// Files that not every answer has. `wall.json` is not among them: it may be the wall that is asked about.
const OF_SOME: [&str; 14] = [
    "mechanism.vtu",
    "mended.csv",
    "mended.svg",
    "closed-joints.csv",
    "read.svg",
    "rest.obj",
    "collapse.obj",
    "end.obj",
    "end.svg",
    "uncertainty.csv",
    "uncertainty.svg",
    "uncertainty.png",
    "verification.csv",
    "verification.svg",
];

/// Removes what an earlier answer left in a folder and this one may not have; never the wall itself.
pub(crate) fn forget(folder: &Path, wall: &Path) -> Result<(), Failure> {
    let wall = wall.canonicalize().ok();
    for file in OF_SOME.map(|name| folder.join(name)) {
        let is_wall = wall.is_some() && file.canonicalize().ok() == wall;
        // A folder without an answer of ours holds files of somebody else.
        if is_wall || !folder.join(ANALYSIS).is_file() {
            continue;
        }
        remove_file(&file)?;
    }
    Ok(())
}

/// Writes all files of a wall; `object` is what `--json` prints of it, `told` what is said of it otherwise.
pub(crate) fn write(folder: &Path, of: &Seen<'_>, object: &Value, told: &Told<'_>) -> Result<(), Failure> {
    let Seen { asked, file, fit, answer, state, replay } = *of;
    output::folder(folder)?;
    forget(folder, &asked.wall)?;
    let picture = picture(asked, (file, fit), answer, state);
    let rests: Vec<Movement> = state.stones.iter().map(|stone| at_rest(state, stone)).collect();
    let source = Source::again(&asked.wall, file)?;
    let views = AlongAxes::of(asked, file, told.mended);
    let mut files = vec![
        ("report.html", page(asked, (file, &source), (answer, state), (&picture, &views, replay), told)?),
        ("mechanism.svg", picture.svg()),
        ("views.svg", views.whole.svg()),
        ("rest.vtu", write_vtu(&file.wall, (asked.solver() != SolverName::Limit).then_some(&rests[..]))),
        ("blocks.csv", blocks_csv(file, answer, state)),
        ("joints.csv", joints_csv(file, state)),
        (ANALYSIS, format!("{:#}\n", with_tables(object, file, answer, state))),
    ];
    if state.falls {
        files.push(("mechanism.vtu", write_vtu(&drawn(&file.wall, state, picture.magnification), None)));
    }
    if let Some(done) = told.mended {
        files.push(("mended.csv", mended::csv(file, done)));
    }
    files.extend(closed::csv(file).map(|csv| ("closed-joints.csv", csv)));
    files.extend(views.moved.map(|views| ("mended.svg", views.svg())));
    // What was read of another format, mended or closed: an arm of a study takes it.
    if Format::of(&asked.title()) != Some(Format::Json) {
        files.push(("wall.json", write_wall_json(&file.wall)));
    }
    files.extend(source.read.map(|svg| ("read.svg", svg)));
    for (name, text) in files {
        replace_file(&folder.join(name), text.as_bytes())?;
    }
    let name = |at: usize| format!("{} {}", file.ids[at], file.names[at]).trim().to_owned();
    let moves = |at: usize| state.falls && answer.moving.contains(&at);
    replayed::write(folder, &asked.title(), (&file.wall, &name, &moves), replay)
}

/// The wall as it falls, its joints coloured as asked.
fn picture(asked: &Analyse, (file, fit): (&WallFile, &Fit), answer: &Answer, state: &State) -> Picture {
    let magnification = Picture::fitting(&state.stones);
    let from_front = !asked.direction.is_backwards();
    let seams = seams(&file.wall, &fit.contact, &state.joints, asked.colour);
    let (side, end) = sides(from_front);
    let what = if state.falls {
        format!("The mechanism, times {magnification}: its furthest block moves by a tenth of the height.")
    } else {
        format!("Drawn at rest, with displacements since it was built times {magnification}.")
    };
    let none = seams.iter().all(|seam| seam.value <= 0.0);
    let seen = format!("Seen from the {side}, x = 0 on the {end}.");
    let mut remarks = vec![answer.headline(asked), what, seen];
    remarks.extend(none.then(|| asked.colour.none().to_owned()));
    Picture {
        stones: state.stones.clone(),
        seams,
        hinges: hinges(&state.joints, &state.conditions, state.falls),
        thrusts: state.thrusts.clone(),
        measure: said(asked.colour, asked.solver()).to_owned(),
        unit: asked.colour.unit(),
        from_front,
        magnification,
        title: format!(
            "{}: {} solver, phi {} deg",
            asked.title(),
            asked.solver().name(),
            asked.phi_deg.middle()
        ),
        remarks,
    }
}

/// What joints are coloured by: a mechanism of limit analysis has no size of its own.
fn said(colour: Measure, solver: SolverName) -> &'static str {
    match (solver, colour) {
        (SolverName::Limit, Measure::Opening) => "opening of joints where the fastest corner moves by 1 m",
        (SolverName::Limit, Measure::Slip) => "slip of joints where the fastest corner moves by 1 m",
        (SolverName::Limit, Measure::Stress) => "pressure between blocks over the joint, at collapse",
        (_, colour) => colour.said(),
    }
}

/// How a block came to where it rests.
fn at_rest(state: &State, stone: &Stone) -> Movement {
    if state.falls { stone.before } else { stone.movement }
}

/// The wall as the picture shows it.
fn drawn(wall: &Wall, state: &State, magnification: f64) -> Wall {
    let mut drawn = wall.clone();
    for (block, stone) in drawn.blocks.iter_mut().zip(&state.stones) {
        block.shape = stone.drawn(magnification);
    }
    drawn
}

/// A block with how it moves: where it rests, and how it falls.
struct Moved<'a> {
    id: u64,
    name: &'a str,
    block: &'a Block,
    moves: bool,
    rest: Movement,
    mechanism: Movement,
}

fn moved<'a>(file: &'a WallFile, answer: &'a Answer, state: &'a State) -> impl Iterator<Item = Moved<'a>> {
    state.stones.iter().enumerate().map(|(at, stone)| Moved {
        id: file.ids[at],
        name: &file.names[at],
        block: &file.wall.blocks[at],
        moves: answer.moving.contains(&at),
        rest: at_rest(state, stone),
        mechanism: if state.falls { stone.movement } else { Movement::NONE },
    })
}

fn blocks_csv(file: &WallFile, answer: &Answer, state: &State) -> String {
    let mut csv = Csv::new(BLOCKS);
    for of in moved(file, answer, state) {
        let vectors = [of.rest.shift, of.rest.turn, of.mechanism.shift, of.mechanism.turn];
        csv.line(&[&of.id, &of.name, &(of.block.support == Support::Fixed), &of.moves, &vectors]);
    }
    csv.text()
}

fn joints_csv(file: &WallFile, state: &State) -> String {
    let mut csv = Csv::new(JOINTS);
    for (joint, condition) in state.joints.iter().zip(&state.conditions) {
        let JointState { place, area, opening, slip, slipped, force, pressure, .. } = joint;
        let blocks = joint.blocks.map(|at| file.ids[at as usize]);
        csv.line(&[&blocks, &condition.name(), place, area, opening, slip, slipped, force, pressure]);
    }
    csv.text()
}

/// The object with its blocks and joints.
fn with_tables(object: &Value, file: &WallFile, answer: &Answer, state: &State) -> Value {
    let list = |v: &Vec3| json!([v.x, v.y, v.z]);
    let block = |of: Moved| {
        json!({
            "block": of.id, "name": of.name, "fixed": of.block.support == Support::Fixed, "moves": of.moves,
            "rest_m": list(&of.rest.shift), "rest_turn_rad": list(&of.rest.turn),
            "mechanism": list(&of.mechanism.shift), "mechanism_turn": list(&of.mechanism.turn),
        })
    };
    let mut whole = object.clone();
    whole["block_states"] = moved(file, answer, state).map(block).collect();
    whole["joint_states"] = joints::objects(file, &state.joints, &state.conditions);
    whole
}
