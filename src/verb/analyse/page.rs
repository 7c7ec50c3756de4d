//! The page of a wall: the answer, the picture, and the tables of blocks and joints for people.

use std::path::Path;
use std::{fs, io};

use crate::exchange::{WallFile, meshes_of};
use crate::math::Vec3;
use crate::mend::Mended;
use crate::model::{Replay, Support};
use crate::render::document::Drawing;
use crate::render::number::significant;
use crate::render::picture::{Picture, Stone};
use crate::study::{Tolerance, sha256};
use crate::terminal::failure::Failure;
use crate::verb::analyse::answer::Answer;
use crate::verb::analyse::ask::{Analyse, Growing};
use crate::verb::analyse::held::counted;
use crate::verb::analyse::state::State;
use crate::verb::analyse::views::AlongAxes;
use crate::verb::analyse::{closed, drawn, mended};
use crate::verb::arguments::SolverName;
use crate::verb::run::answer::page::{WallPage, WallTable, wall_page};
use crate::verb::run::origin::Origin;

const BLOCKS: &[&str] = &["block", "name", "role", "shift to rest mm", "movement of the fall"];
const JOINTS: &[&str] =
    &["between", "and", "state", "area m2", "opening mm", "slip mm", "force N", "pressure kPa"];
/// Digits of the numbers in the tables.
const DIGITS: usize = 3;

/// What is told of a wall beside its answer.
pub(crate) struct Told<'a> {
    /// What is printed.
    pub text: &'a str,
    /// What looks wrong.
    pub warnings: &'a [String],
    /// What was done to its stones before it was solved.
    pub mended: Option<&'a Mended>,
    /// Figures of the answer.
    pub figures: &'a [Drawing],
}

/// The page; `picture` and `views` are those in the folder, `replay` the states that the wall goes through.
pub(crate) fn page(
    asked: &Analyse,
    (file, source): (&WallFile, &Source),
    (answer, state): (&Answer, &State),
    (picture, views, replay): (&Picture, &AlongAxes, &Replay),
    told: &Told<'_>,
) -> Result<String, Failure> {
    let wall = asked.title();
    let by_rates = asked.solver() == SolverName::Limit && state.falls;
    let mended = told.mended.filter(|done| !done.stones.is_empty());
    let mended = mended.map(|done| WallTable {
        name: "Mended stones",
        heads: mended::HEADS,
        rows: mended::rows(file, done),
    });
    let joints_closed = closed::rows(file);
    let closed = (!joints_closed.is_empty()).then_some(WallTable {
        name: "Joints that were closed",
        heads: closed::HEADS,
        rows: joints_closed,
    });
    let tables = [
        mended,
        closed,
        Some(WallTable { name: "Blocks", heads: BLOCKS, rows: blocks(file, answer, state, by_rates) }),
        Some(WallTable { name: "Joints", heads: JOINTS, rows: joints(file, state) }),
    ];
    let tables = tables.into_iter().flatten().collect();
    let page = WallPage {
        wall: &wall,
        question: question(asked),
        answer: told.text.lines().map(|line| line.trim().to_owned()).collect(),
        warnings: told.warnings,
        read: source.read.clone(),
        picture,
        figures: told.figures,
        views: &views.whole,
        moved: views.moved.as_ref(),
        replay,
        about_tables: match by_rates {
            true => {
                "Openings, slips and movements are those of a mechanism whose fastest corner moves by 1 m: limit analysis knows no size \
                 of it. blocks.csv and joints.csv hold all digits."
            }
            false => {
                "Openings and slips are those of the last state at rest, movements those of the fall as far as it was watched. \
                 blocks.csv and joints.csv hold all digits."
            }
        },
        tables,
        inputs: inputs(asked),
        solver: asked.solver().name(),
        sha256: source.sha256.clone(),
        origin: &Origin::now(&asked.wall, None).of_page(),
    };
    wall_page(&page).map_err(|error| Failure::Run(format!("{error:#}")))
}

/// What was asked, as a question.
fn question(asked: &Analyse) -> String {
    let towards = asked.direction;
    match (asked.growing(), asked.worst_direction) {
        (Growing::Tilt, false) => format!("At which tilt towards {towards} does the wall fall?"),
        (Growing::Tilt, true) => "In which direction can the wall be tilted least, and how far?".to_owned(),
        (Growing::Lateral, false) => {
            format!("Which share of its weight, pushing towards {towards}, does the wall bear?")
        }
        (Growing::Height, _) => {
            format!(
                "Up to which height does the wall hold {} that pushes towards {towards}?",
                asked.load.name()
            )
        }
        (Growing::Factor, _) => {
            format!("How many times {} does the wall bear towards {towards}?", counted(asked))
        }
        (Growing::Lateral, true) => {
            "In which direction does the wall bear the least push, and how much?".to_owned()
        }
    }
}

/// What was given, with what was not as it is by default.
pub(crate) fn inputs(asked: &Analyse) -> Vec<(&'static str, String)> {
    let mut all = vec![
        ("solver", asked.solver().name().to_owned()),
        ("load", asked.load.name().to_owned()),
        ("direction", asked.direction.to_string()),
        (
            "friction angle of the joints",
            asked.phi_deg.said(|phi| format!("{} deg", (1e3 * phi).round() / 1e3)),
        ),
        ("cohesion of the joints", format!("{} Pa", asked.cohesion)),
    ];
    all.extend(asked.demanded.demand.as_ref().map(|own| ("demand", own.stated.clone())));
    let stiffness = |own: f64| format!("{own:.3e} Pa/m");
    if let Some(kn) = asked.kn.as_ref().filter(|_| asked.solver().is_elastic()) {
        all.push(("normal stiffness of the joints", kn.said(stiffness)));
        let ks = asked.ks.map_or_else(|| "half the normal one".to_owned(), stiffness);
        all.push(("shear stiffness of the joints", ks));
    }
    let density = |own: f64| format!("{} kg/m3", own.round());
    all.extend(asked.density.as_ref().map(|own| ("mean density of the blocks that move", own.said(density))));
    if asked.solver() == SolverName::Limit {
        all.push(("flow", asked.flow.map_or("associative", |flow| flow.name()).to_owned()));
    }
    all.extend(asked.unit.map(|unit| ("unit of the file", unit.name().to_owned())));
    all.extend(asked.up.map(|up| ("axis of the file that points up", up.name().to_owned())));
    all.extend(asked.density_kg_per_m3.map(|own| ("density where the file states none", density(own))));
    let length = |own: f64| format!("{} mm", significant(1e3 * own, 4));
    if let Tolerance::Length(own) = asked.touch_tolerance {
        all.push(("gaps up to which blocks touch", length(own)));
    }
    all.extend(asked.flatness.map(|own| ("warped faces made plane within", length(own))));
    all.extend(asked.mend.map(|own| ("joints mended within", length(own))));
    all.extend(asked.scan_bearing.map(|own| ("scans bear up to above their lowest point", length(own))));
    all.extend(asked.thickness.map(|own| ("depth of stones where the file states none", length(own))));
    all.extend(asked.pixel.map(|own| ("size of a pixel", length(own))));
    all.extend(asked.width.map(|own| ("length of all stones together", length(own))));
    if asked.section {
        all.push(("what the file shows", "a section".to_owned()));
    }
    if asked.parts {
        all.push(("concave blocks", "divided into convex parts".to_owned()));
    }
    if !asked.fixed.is_empty() {
        let ids: Vec<String> = asked.fixed.iter().map(u64::to_string).collect();
        all.push(("blocks fixed besides those of the file", ids.join(", ")));
    }
    let behind = &asked.behind;
    let of_behind = [
        ("density of the fill", behind.fill_density, "kg/m3"),
        ("friction angle of the fill", behind.fill_phi_deg, "deg"),
        ("share of it on the back of the wall", behind.wall_friction, ""),
        ("slope of the fill", behind.fill_slope_deg, "deg"),
        ("weight on the fill", behind.surcharge_pa, "Pa"),
        ("mean pressure on the back", behind.pressure_pa, "Pa"),
        ("pressure at the base over that at the top", behind.base_over_top, ""),
        ("force on the crest", behind.crest_force, "N"),
        ("its place from the left, seen from behind", behind.crest_at, "m"),
        ("force along the crest", behind.crest_line, "N/m"),
        ("its angle below the horizontal", behind.crest_down_deg, "deg"),
    ];
    let stated =
        of_behind.into_iter().filter_map(|(name, own, unit)| Some((name, format!("{} {unit}", own?))));
    all.extend(stated.map(|(name, own)| (name, own.trim_end().to_owned())));
    if behind.undrained {
        all.push(("water in the fill", "up to its surface".to_owned()));
    }
    all.extend(asked.vertical.map(|share| ("vertical share of the load", share.to_string())));
    let listed = |of: &[(u64, f64)], unit: &str| {
        let said: Vec<String> = of.iter().map(|(id, x)| format!("block {id}: {x} {unit}")).collect();
        (!said.is_empty()).then(|| said.join(", "))
    };
    all.extend(listed(&asked.dead_loads, "N").map(|said| ("dead loads", said)));
    all.extend(listed(&asked.settlements, "m down").map(|said| ("settlements", said)));
    all
}

/// The file of a wall as its page shows it.
pub(crate) struct Source {
    /// SHA-256 of it, or of all files of a folder one after another.
    pub sha256: String,
    /// What was read of a drawing or a picture, as SVG.
    pub read: Option<String>,
}

impl Source {
    /// The file at a path, from which a wall was read.
    pub fn again(path: &Path, file: &WallFile) -> Result<Source, Failure> {
        let bytes = bytes(path)
            .map_err(|error| Failure::Run(format!("cannot read {} again: {error}", path.display())))?;
        Ok(Source { sha256: sha256(&bytes), read: drawn::svg(file, path, &bytes) })
    }
}

fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    if !path.is_dir() {
        return fs::read(path);
    }
    let files: io::Result<Vec<Vec<u8>>> = meshes_of(path)?.iter().map(fs::read).collect();
    Ok(files?.concat())
}

fn blocks(file: &WallFile, answer: &Answer, state: &State, by_rates: bool) -> Vec<Vec<String>> {
    let size = |v: &Vec3| significant(v.norm(), DIGITS);
    let row = |(at, stone): (usize, &Stone)| {
        let role = match file.wall.blocks[at].support {
            Support::Fixed => "fixed",
            _ if answer.moving.contains(&at) => "moves",
            _ => "stays",
        };
        let rest = if state.falls { stone.before } else { stone.movement };
        let fall = if state.falls { size(&stone.movement.shift) } else { "-".to_owned() };
        let rest = if by_rates { "-".to_owned() } else { significant(1e3 * rest.shift.norm(), DIGITS) };
        vec![file.ids[at].to_string(), file.names[at].clone(), role.to_owned(), rest, fall]
    };
    state.stones.iter().enumerate().map(row).collect()
}

fn joints(file: &WallFile, state: &State) -> Vec<Vec<String>> {
    let rows = state.joints.iter().zip(&state.conditions).map(|(joint, condition)| {
        let [a, b] = joint.blocks.map(|at| file.names[at as usize].clone());
        let numbers =
            [joint.area, 1e3 * joint.opening, 1e3 * joint.slip, joint.force.norm(), 1e-3 * joint.pressure];
        let names = [a, b, condition.name().to_owned()];
        names.into_iter().chain(numbers.map(|x| significant(x, DIGITS))).collect()
    });
    rows.collect()
}
