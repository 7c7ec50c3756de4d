//! What `analyse --out` writes of a wall on ground that moves: a page, a picture of its end, its replay, and tables.

use std::path::Path;

use serde_json::{Value, json};

use crate::ensemble::replace_file;
use crate::math::{Vec3, degrees};
use crate::model::{BuiltJoint, JointReading, Movement, ReplayState, Support};
use crate::render::csv::Csv;
use crate::render::number::significant;
use crate::render::picture::{Picture, Seam, Stone};
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::analyse::files::{ANALYSIS, forget};
use crate::verb::analyse::page::{Source, inputs};
use crate::verb::analyse::shaken::{Common, Ran, one};
use crate::verb::analyse::views::views;
use crate::verb::run::answer::page::{WallPage, WallTable, wall_page};
use crate::verb::run::origin::Origin;
use crate::verb::wall::drawn::sides;
use crate::verb::wall::replayed;

const BLOCKS: &[&str] = &["block", "name", "role", "falls at s", "displacement mm", "turn deg"];
const JOINTS: &[&str] = &["between", "and", "opening mm", "slip mm"];
/// Columns of `blocks.csv`.
const BLOCKS_CSV: &str =
    "block,name,fixed,fallen_at_s,end_x_m,end_y_m,end_z_m,end_turn_x_rad,end_turn_y_rad,end_turn_z_rad";
/// Digits of the numbers in the tables of the page.
const DIGITS: usize = 3;

/// Writes all files of a run; `object` is what `--json` prints of it, `text` what is said of it otherwise.
pub(crate) fn write(
    folder: &Path,
    of: &Common<'_>,
    run: &Ran,
    (object, text): (&Value, &str),
    warnings: &[String],
) -> Result<(), Failure> {
    output::folder(folder)?;
    forget(folder, &of.asked.wall)?;
    let picture = picture(of, run);
    let mut whole = object.clone();
    whole["block_states"] = blocks(of, run).map(|own| own.object()).collect();
    let files = [
        ("report.html", page(of, run, (&picture, text), warnings)?),
        ("end.svg", picture.svg()),
        ("views.svg", views(of.asked, of.file).svg()),
        ("blocks.csv", blocks_csv(of, run)),
        (ANALYSIS, format!("{whole:#}\n")),
    ];
    for (name, text) in files {
        replace_file(&folder.join(name), text.as_bytes())?;
    }
    let name = |at: usize| format!("{} {}", of.file.ids[at], of.file.names[at]).trim().to_owned();
    let leads = of.file.wall.leads();
    let falls = |at: usize| run.seen.fallen.iter().any(|(block, _)| *block == leads[at]);
    replayed::write(folder, &of.asked.title(), (&of.file.wall, &name, &falls), &run.replay)
}

/// Writes the page of a run alone.
pub(crate) fn write_page(
    path: &Path,
    of: &Common<'_>,
    run: &Ran,
    text: &str,
    warnings: &[String],
) -> Result<(), Failure> {
    let text = page(of, run, (&picture(of, run), text), warnings)?;
    Ok(replace_file(path, text.as_bytes())?)
}

/// A block at the end.
struct Block<'b> {
    id: u64,
    name: &'b str,
    fixed: bool,
    /// When it fell, if it did (s).
    fell: Option<f64>,
    end: Movement,
}

fn blocks<'b>(of: &'b Common<'_>, run: &'b Ran) -> impl Iterator<Item = Block<'b>> {
    let (leads, last) = (of.file.wall.leads(), run.replay.states.last());
    of.file.wall.blocks.iter().enumerate().map(move |(at, block)| Block {
        id: of.file.ids[at],
        name: &of.file.names[at],
        fixed: block.support == Support::Fixed,
        fell: run.seen.fallen.iter().find(|(block, _)| *block == leads[at]).map(|(_, time)| *time),
        end: end(last, at),
    })
}

/// How a block has moved at the end; not at all of a wall that never came to rest.
fn end(last: Option<&ReplayState>, block: usize) -> Movement {
    last.map_or(Movement::NONE, |state| state.poses[block])
}

fn blocks_csv(of: &Common<'_>, run: &Ran) -> String {
    let mut csv = Csv::new(BLOCKS_CSV);
    for own in blocks(of, run) {
        csv.line(&[&own.id, &own.name, &own.fixed, &own.fell, &own.end.shift, &own.end.turn]);
    }
    csv.text()
}

impl Block<'_> {
    fn object(&self) -> Value {
        let list = |v: &Vec3| json!([v.x, v.y, v.z]);
        json!({
            "block": self.id, "name": self.name, "fixed": self.fixed, "fallen_at_s": self.fell,
            "end_m": list(&self.end.shift), "end_turn_rad": list(&self.end.turn),
        })
    }

    fn row(&self) -> Vec<String> {
        let role = match (self.fixed, self.fell) {
            (true, _) => "fixed",
            (false, Some(_)) => "falls",
            (false, None) => "stands",
        };
        let fell = self.fell.map_or_else(|| "-".to_owned(), |at| significant(at, DIGITS));
        let [moved, turned] = [1e3 * self.end.shift.norm(), degrees(self.end.turn.norm())];
        let numbers = [moved, turned].map(|x| significant(x, DIGITS));
        let names = [self.id.to_string(), self.name.to_owned(), role.to_owned(), fell];
        names.into_iter().chain(numbers).collect()
    }
}

/// The wall at the end, in its true size, with its joints as far as they open.
fn picture(of: &Common<'_>, run: &Ran) -> Picture {
    let Common { asked, file, .. } = of;
    let from_front = !asked.direction.is_backwards();
    let last = run.replay.states.last();
    let stone = |(at, shape)| Stone::moved(shape, end(last, at));
    let readings = last.map_or(&[][..], |state| &state.joints);
    let seam = |(joint, reading): (&BuiltJoint, &JointReading)| Seam {
        blocks: joint.blocks.map(|id| id as usize),
        polygon: joint.polygon.clone(),
        value: asked.colour.read(reading),
    };
    let (side, edge) = sides(from_front);
    let when = last.map_or(0.0, |state| state.level.value());
    Picture {
        stones: file.wall.blocks.iter().map(|block| block.shape.clone()).enumerate().map(stone).collect(),
        seams: run.replay.joints.iter().zip(readings).map(seam).collect(),
        hinges: Vec::new(),
        thrusts: Vec::new(),
        measure: asked.colour.in_words().to_owned(),
        unit: asked.colour.unit(),
        from_front,
        magnification: 1.0,
        title: format!(
            "{}: {} solver, {} times {}",
            asked.title(),
            asked.solver().name(),
            run.motion.name,
            run.scale
        ),
        remarks: vec![
            one::headline(run),
            format!("The wall after {when:.2} s, in its true size."),
            format!("Seen from the {side}, x = 0 on the {edge}."),
        ],
    }
}

fn page(
    of: &Common<'_>,
    run: &Ran,
    (picture, text): (&Picture, &str),
    warnings: &[String],
) -> Result<String, Failure> {
    let asked = of.asked;
    let source = Source::again(&asked.wall, of.file)?;
    let wall = asked.title();
    let mut given = inputs(asked);
    given.extend([
        ("record", run.motion.name.clone()),
        ("scale", run.scale.to_string()),
        ("lean of the ground", format!("{} deg", asked.lean_deg.unwrap_or(0.0))),
    ]);
    let page = WallPage {
        wall: &wall,
        question: format!("Does the wall stand {}, times {}?", run.motion.name, run.scale),
        answer: text.lines().map(|line| line.trim().to_owned()).collect(),
        warnings,
        read: source.read,
        picture,
        figures: &[],
        views: &views(asked, of.file),
        moved: None,
        replay: &run.replay,
        about_tables: "Displacements, turns, openings and slips are those at the end, since the wall was built. blocks.csv holds all digits.",
        tables: vec![
            WallTable { name: "Blocks", heads: BLOCKS, rows: blocks(of, run).map(|own| own.row()).collect() },
            WallTable { name: "Joints", heads: JOINTS, rows: joints(of, run) },
        ],
        inputs: given,
        solver: asked.solver().name(),
        sha256: source.sha256,
        origin: &Origin::now(&asked.wall, None).of_page(),
    };
    wall_page(&page).map_err(|error| Failure::Run(format!("{error:#}")))
}

fn joints(of: &Common<'_>, run: &Ran) -> Vec<Vec<String>> {
    let Some(last) = run.replay.states.last() else { return Vec::new() };
    let rows = run.replay.joints.iter().zip(&last.joints).map(|(joint, reading)| {
        let [a, b] = joint.blocks.map(|id| of.name(id as usize).to_owned());
        let numbers = [reading.opening, reading.slip].map(|x| significant(1e3 * x, DIGITS));
        [a, b].into_iter().chain(numbers).collect()
    });
    rows.collect()
}
