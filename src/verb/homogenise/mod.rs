//! `pirca homogenise`: what masonry of a study's kinds is as a plate.

pub(crate) mod answer;
pub(crate) mod ask;

use crate::ensemble::{AskedOfCells, AskedOfWalls, check_plate, run_cells, run_walls};
use crate::homogenise::{AskedOfCell, Method};
use crate::study::Study;
use crate::terminal::answer::Answer;
use crate::terminal::failure::Failure;
use crate::terminal::{output, threads};
use crate::verb::homogenise::ask::Directions;
pub(crate) use crate::verb::homogenise::ask::Homogenise;
use crate::verb::run::page::{Place, told};
use crate::verb::{arms, locate, share};
pub use answer::{
    HeldWalls, HomogenisedSummary, ModulusBounds, NestedCells, PlateArm, PlateCells, PlateUnits, PlateValue,
    SurfaceEntry, ValueBySize, WallSample, WallShare, WallsAsPlates, homogenised_document,
    homogenised_summary,
};

/// What the folder of the results is named by.
const HOMOGENISED: &str = "homogenised";
/// Plates beside walls, if there are as many cells.
const PLATES: u64 = 10;

/// Builds random cells of every arm and says what they are as a plate.
pub(crate) fn homogenise(arguments: &Homogenise) -> Result<Answer, Failure> {
    let loaded = locate::any_study(&arguments.which)?;
    let study = match arguments.seed {
        Some(seed) => loaded.study.clone().with_seed(seed),
        None => loaded.study.clone(),
    };
    let asked = asked(&study, arguments)?;
    let held_against = asked_of_walls(&study, &asked, arguments)?;
    let out = arguments.out.clone().unwrap_or_else(|| output::default_folder(&study, HOMOGENISED));
    output::folder(&out)?;
    let kept = (out.as_path(), arguments.shard);
    let (rows, walls) = threads::on(arguments.threads, || {
        let rows = run_cells(&study, &asked, kept, &share::progress(&study.name, "cells"))?;
        let walls = match &held_against {
            Some(of) => {
                run_walls(&study, (&asked, of), kept, &share::progress(&study.name, "walls and plates"))?
            }
            None => Vec::new(),
        };
        Ok((rows, walls))
    })?;
    if let Some(share) = arguments.shard {
        return share::answer(share, &out);
    }
    if rows.iter().all(|row| row.found.is_err()) {
        let why = rows.iter().find_map(|row| row.found.as_ref().err());
        return Err(Failure::Input(format!("{}: no cell: {}", study.name, why.map_or("", String::as_str))));
    }
    let summary = homogenised_summary(&study, &asked, &rows, &walls);
    let document = homogenised_document((&study, &asked, &rows, &walls), &summary);
    let place = Place {
        out: &out,
        name: HOMOGENISED,
        study: (&study, &loaded),
        of: &arguments.which.study,
        threads: arguments.threads,
        report: arguments.report,
    };
    told(&document, &summary, &place)
}

/// What is asked of walls, checked against the study; `None` where none are.
fn asked_of_walls(
    study: &Study,
    cells: &AskedOfCells,
    arguments: &Homogenise,
) -> Result<Option<AskedOfWalls>, Failure> {
    if arguments.walls == 0 {
        return Ok(None);
    }
    let plates = arguments.plates.unwrap_or(PLATES.min(arguments.cells));
    if plates > arguments.cells {
        return Err(Failure::Usage(format!(
            "--plates {plates}: there are {} cells of each size; ask for no more plates than --cells",
            arguments.cells
        )));
    }
    for &arm in &cells.arms {
        let own = &study.arms[arm as usize];
        let refused =
            |why: String| Failure::Input(format!("{}: --walls: arm `{}`: {why}", study.name, own.name));
        check_plate(own, &study.protocol_of(own)).map_err(|fault| refused(fault.to_string()))?;
        if own.joint.is_smooth() {
            return Err(refused(
                "joint.phi_deg is 0, so that walls and plates slide apart; give the joints friction"
                    .to_owned(),
            ));
        }
    }
    Ok(Some(AskedOfWalls {
        walls: arguments.walls,
        plates,
        non_associative: cells.of.methods.contains(&Method::NonAssociative),
    }))
}

/// What is asked, checked against the study before anything is computed.
fn asked(study: &Study, arguments: &Homogenise) -> Result<AskedOfCells, Failure> {
    let sizes = arguments.stones.clone();
    let number = |[along, courses]: [u32; 2]| u64::from(along) * u64::from(courses);
    if let Some(pair) = sizes.windows(2).find(|pair| number(pair[0]) >= number(pair[1])) {
        let shown = |[along, courses]: [u32; 2]| format!("{along} x {courses}");
        return Err(Failure::Usage(format!(
            "--stones: {} does not come after {}; give the sizes from small to large",
            shown(pair[1]),
            shown(pair[0])
        )));
    }
    let arms = arms::named(study, &arguments.arms)?;
    for &arm in &arms {
        let own = &study.arms[arm as usize];
        arms::has_point(own, arguments.point)?;
        for size in &sizes {
            if let Err(fault) = crate::ensemble::check_cell(own, *size) {
                return Err(Failure::Input(format!("{}: arm `{}`: {fault}", study.name, own.name)));
            }
        }
    }
    let mut directions = Vec::new();
    let strength = !arguments.directions.contains(&Directions::None);
    let smooth = arms.iter().map(|&arm| &study.arms[arm as usize]).find(|arm| arm.joint.is_smooth());
    if let (true, Some(arm)) = (strength, smooth) {
        return Err(Failure::Input(format!(
            "{}: arm `{}`: joint.phi_deg and joint.cohesion_pa are 0, so nothing but pressure is borne and there is no surface; give the \
             joints friction, or ask for --directions none",
            study.name, arm.name
        )));
    }
    for set in &arguments.directions {
        if *set == Directions::None && arguments.directions.len() > 1 {
            return Err(Failure::Usage(
                "--directions: none goes with no other set; leave it out, or ask for it alone".to_owned(),
            ));
        }
        directions.extend(set.all());
    }
    let mut methods = Vec::new();
    for method in arguments.method.iter().copied().map(Into::into) {
        if !methods.contains(&method) {
            methods.push(method);
        }
    }
    Ok(AskedOfCells {
        sizes,
        cells: arguments.cells,
        arms,
        point: arguments.point,
        of: AskedOfCell { directions, methods },
        pressure: arguments.pressure_pa,
    })
}
