//! The verb: read, look where blocks meet, solve, tell.

use std::time::Instant;

use serde_json::json;

use crate::exchange::{
    Choice, Format, Nature, ReadOptions, Unit, Up, WallFaults, WallFile, leaves_units_open, meshes_of,
    read_wall,
};
use crate::law::Coulomb;
use crate::math::compact;
use crate::mend::Mended;
use crate::model::{Outcome, Support, Wall};
use crate::protocol::{Direction, Recorder, Settlement, Witness};
use crate::render::document::Drawing;
use crate::solve::STANDARD_GRAVITY;
use crate::study::Angle;
use crate::study::{self, Fit, bounds, look, wider};
use crate::terminal::answer::Answer;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::analyse::ask::{Analyse, FlowName, Growing, LoadName, UpName};
use crate::verb::analyse::demand::Demanded;
use crate::verb::analyse::fall::Fall;
use crate::verb::analyse::files::Seen;
use crate::verb::analyse::known::{Known, USUAL_STIFFNESS};
use crate::verb::analyse::loads::{loaded, settlements};
use crate::verb::analyse::open::left_open;
use crate::verb::analyse::opinions::{Opinions, opinions};
use crate::verb::analyse::page::Told;
use crate::verb::analyse::shaken::shaken;
use crate::verb::analyse::solve::{law, solve, solve_seen_by};
use crate::verb::analyse::state::State;
use crate::verb::analyse::uncertainty::{uncertainty_figure, uncertainty_text, write_uncertainty};
use crate::verb::analyse::unsure::{Given, asked, refused};
use crate::verb::analyse::verify::{Verification, verified};
use crate::verb::analyse::worst::{Tried, tried, weakest};
use crate::verb::analyse::{as_study, demand, fclib, files, held, known, mended, shaken, upright, verify};
use crate::verb::arguments::SolverName;
use crate::verb::wall::one_wall::MOST_STATES;

/// A prestress above this share of the pressure under the wall's own weight is worth a warning.
const PRESTRESS: f64 = 0.1;

/// Solves a wall from a file.
pub(crate) fn analyse(arguments: &Analyse) -> Result<Answer, Failure> {
    let begun = Instant::now();
    let arguments = &with_usual_stiffness(arguments);
    let mut warnings = asked_in_vain(arguments)?;
    warnings.extend(usual(arguments));
    let site = verify::site(arguments)?;
    let (read, fit, done) = match read(arguments) {
        Ok(found) => found,
        Err(faults) if arguments.json => {
            return Err(Failure::Said(json!({
                "outcome": "invalid_geometry",
                "faults": faults.faults,
                "more": faults.more,
                "warnings": warnings,
            })));
        }
        Err(faults) => return Err(Failure::Input(faults.to_string())),
    };
    let density = arguments.density.as_ref().map(Known::middle);
    let file = WallFile { wall: loaded(&read, density, &arguments.dead_loads)?, ..read.clone() };
    warnings.extend(file.warnings.iter().cloned());
    warnings.extend(fit.warnings.iter().cloned());
    warnings.extend(prestress(arguments, &file.wall, &fit));
    let law = law(arguments);
    let demand = arguments.demanded.demand.as_ref().map(|own| demand::level(arguments, own)).transpose()?;
    if arguments.load == LoadName::BaseMotion {
        return shaken(arguments, &file, (&law, &fit), warnings, begun);
    }
    held::checked(arguments, &file.wall)?;
    let settlements = settlements(&file, &arguments.settlements)?;
    let wall = (&file.wall, &settlements[..]);
    let directions = directions(arguments, wall, &law, &fit);
    let towards = weakest(&directions).map_or(arguments.direction, |of| Direction::at(of.direction_deg));
    let arguments = &Analyse { direction: towards, ..arguments.clone() };
    let page = arguments.page_alone();
    let is_seen = arguments.out.is_some() || page.is_some();
    let recorder = is_seen.then(|| Recorder::new(MOST_STATES));
    let (mut answer, found) = solve(arguments, wall, &law, &fit, recorder.as_ref());
    answer.undecided = answer.undecided.or_else(|| left_open(arguments, &file.wall, &law, &fit, &found));
    warnings.extend(answer.warning(&file));
    if answer.outcome == Outcome::UnstableAtRest {
        warnings.extend(upright::question(&file.wall, &law, &fit, up(arguments), is_turned(arguments)));
    }
    let others = opinions(arguments, wall, &fit, (&answer, begun.elapsed().as_secs_f64()));
    warnings.extend(others.as_ref().and_then(Opinions::warning));
    let given = Given { arguments, file: &read, fit: &fit, settlements: &settlements };
    let verification = site.map(|site| verified(&given, &file.wall, &asked(arguments), site)).transpose()?;
    warnings.extend(verification.iter().flat_map(|own| own.site.warnings.iter().cloned()));
    let sure = given.how_sure(asked(arguments), (&file.wall, &answer, &found))?;
    let state = (is_seen || demand.is_some()).then(|| State::of(&file.wall, &fit.contact, &found));
    let fall = state.as_ref().and_then(|state| Fall::of(state, &answer.moving));
    let demanded = demand.map(|level| Demanded::of(arguments, level, (&answer, fall), sure.as_ref()));
    let seconds = begun.elapsed().as_secs_f64();
    if let Some(path) = &arguments.fclib {
        fclib::write(path, arguments, &file, (&law, &fit), &answer)?;
    }
    if let Some(folder) = &arguments.study {
        as_study::write(arguments, &fit, folder)?;
    }
    let mut object = answer.object(arguments, &file, &fit, (&warnings, &directions), seconds);
    if let Some(held) = &answer.held {
        object["held"] = held.object(&answer.outcome);
    }
    if let Some(sure) = &sure {
        object["uncertain"] = json!(sure);
    }
    if let Some(own) = &demanded {
        object["demand"] = own.object();
    }
    if let Some(own) = &verification {
        object["verification"] = own.object();
    }
    if let Some(done) = &done {
        object["mended"] = mended::object(&read, done, arguments.mend);
    }
    if let Some(folder) = &arguments.study {
        object["study"] = json!(folder);
    }
    if let Some(others) = &others {
        object["opinions"] = others.object();
    }
    let mut text = demanded.as_ref().map(Demanded::text).unwrap_or_default();
    text += &verification.as_ref().map(Verification::text).unwrap_or_default();
    text += &answer.text(arguments, &file, &fit, seconds);
    text += &others.as_ref().map_or_else(String::new, |others| others.text(arguments));
    text += &arguments.study.as_ref().map_or_else(String::new, |folder| {
        format!("  the same question as a study written to {0}; next: pirca run {0}\n", folder.display())
    });
    text += &sure.as_ref().map(uncertainty_text).unwrap_or_default();
    text += &arguments.fclib.as_ref().map_or_else(String::new, |path| {
        format!("  contact problem of a step written to {}\n", path.display())
    });
    if arguments.worst_direction {
        text += &match weakest(&directions) {
            Some(_) => format!("  the weakest of {} directions that were tried\n", directions.len()),
            None => format!("  it falls in none of {} directions that were tried\n", directions.len()),
        };
    }
    if let Some(state) = state.as_ref().filter(|_| is_seen) {
        let replay = recorder.map(|own| own.replay(file.wall.blocks.len())).unwrap_or_default();
        let figures =
            [sure.as_ref().map(uncertainty_figure), verification.as_ref().and_then(Verification::drawing)];
        let figures: Vec<Drawing> = figures.into_iter().flatten().collect();
        let told = Told { text: &text, warnings: &warnings, mended: done.as_ref(), figures: &figures };
        let of = Seen { asked: arguments, file: &file, fit: &fit, answer: &answer, state, replay: &replay };
        if let Some(folder) = &arguments.out {
            files::write(folder, &of, &object, &told)?;
            let written = sure.as_ref().map_or(Ok(()), |sure| write_uncertainty(sure, folder));
            written.map_err(|error| Failure::Run(format!("{error:#}")))?;
            verification.as_ref().map_or(Ok(()), |own| own.write(folder))?;
        }
        if let Some(page) = &page {
            files::write_page(page, &of, &told)?;
        }
    }
    let judged = |answer: Answer| match &demanded {
        Some(own) => arguments.demanded.judged(answer, own.at_most()),
        None => answer,
    };
    let Some(place) = arguments.out.as_ref().or(page.as_ref()) else {
        return Ok(judged(Answer::of(text, &object)?.with_warnings(warnings)));
    };
    text += &format!("written to {}\n", place.display());
    Ok(judged(Answer::of(text, &object)?.in_place(place).with_warnings(warnings)))
}

/// All directions that are tried where the weakest one is asked for, with what the wall bears in each.
fn directions(arguments: &Analyse, wall: (&Wall, &[Settlement]), law: &Coulomb, fit: &Fit) -> Vec<Tried> {
    if !arguments.worst_direction {
        return Vec::new();
    }
    doing("looking for the weakest direction", |_| {
        tried(&|direction| {
            let towards = Analyse { direction, ..arguments.clone() };
            solve_seen_by(&towards, wall, law, fit, Witness::NOBODY).0.outcome
        })
    })
}

/// The file, fit to be solved.
fn read(arguments: &Analyse) -> Result<(WallFile, Fit, Option<Mended>), WallFaults> {
    let format = format(arguments);
    // A folder holds a mesh for each stone.
    let is_mesh = format.is_some_and(Format::is_mesh) || arguments.wall.is_dir();
    let unit = arguments.unit.map(|unit| Unit::named(unit.name()).unwrap_or_default());
    let options = ReadOptions {
        unit,
        // What is scaled to a mean may as well begin there.
        density: arguments.density_kg_per_m3.or(arguments.density.as_ref().map(Known::middle)),
        up: arguments.up.and_then(|up| Up::named(up.name())),
        any_shape: is_mesh,
        flatness: wider(arguments.flatness, arguments.mend),
        scan_bearing: arguments.scan_bearing,
        parts: arguments.parts,
        thickness: arguments.thickness,
        pixel: arguments.pixel,
        width: arguments.width,
        closing: arguments.mend,
        section: arguments.section,
        fixed: arguments.fixed.clone(),
        turn: 0.0,
        on_platform: arguments.scan_bearing.is_some() || is_mesh,
    };
    let mut file = read_wall(&arguments.wall, &options)?;
    if arguments.scan_bearing.is_some() || is_mesh || format.is_some_and(Format::is_elevation) {
        file = file.on_ground();
    }
    let name = arguments.wall.display().to_string();
    let mut done = None;
    if let Some(within) = arguments.mend.filter(|_| !format.is_some_and(Format::is_drawn)) {
        let (sound, all) = study::mended(&file, within, &name)?;
        (file, done) = (sound, Some(all));
    }
    let fit = look(&file, arguments.touch_tolerance, &name)?;
    Ok((file, fit, done))
}

fn format(arguments: &Analyse) -> Option<Format> {
    Format::of(&arguments.wall.display().to_string())
}

/// The axis of the file that points up; in a folder that of the first mesh.
fn up(arguments: &Analyse) -> UpName {
    let first = || Format::of(&meshes_of(&arguments.wall).ok()?.first()?.display().to_string());
    let usual = match format(arguments).or_else(first).map_or(Up::Z, Up::usual) {
        Up::X => UpName::X,
        Up::Y => UpName::Y,
        Up::Z => UpName::Z,
    };
    arguments.up.unwrap_or(usual)
}

/// Whether any axis of the file may point up.
fn is_turned(arguments: &Analyse) -> bool {
    arguments.wall.is_dir() || format(arguments).is_some_and(|own| own == Format::Obj || own.is_mesh())
}

/// Arguments that are missing, and warnings of those that mean nothing for what is asked.
fn asked_in_vain(arguments: &Analyse) -> Result<Vec<String>, Failure> {
    refused(arguments)?;
    shaken::refused(arguments)?;
    held::refused(arguments)?;
    verify::refused(arguments)?;
    as_study::refused(arguments)?;
    let solver = arguments.solver().name();
    let is_asked = |own: SolverName| arguments.solvers.contains(&own);
    let elastic = arguments.solvers.iter().find(|solver| solver.is_elastic());
    let mut warnings = in_radians(arguments);
    if arguments.solvers.len() > 1 && arguments.load == LoadName::BaseMotion {
        return Err(Failure::Usage("--load base-motion takes one solver: ask for each in turn".to_owned()));
    }
    read_in_vain(arguments)?;
    if arguments.vertical.is_some() && arguments.growing() != Growing::Lateral {
        return Err(Failure::Usage(
            "--vertical is for --load lateral, whose force has a direction; a tilt turns the whole weight: ask for that load, or leave --vertical out"
                .to_owned(),
        ));
    }
    if arguments.fclib.is_some() && arguments.cohesion > 0.0 {
        return Err(Failure::Usage(
            "--fclib is for dry joints: its form knows no cohesion; leave --cohesion out".to_owned(),
        ));
    }
    if elastic.is_none() && (arguments.kn.is_some() || arguments.ks.is_some()) {
        let method = arguments.solver().method();
        warnings.push(format!("{method} is of rigid blocks: --kn and --ks do not matter"));
    }
    if is_asked(SolverName::Nonsmooth) && !arguments.settlements.is_empty() {
        return Err(Failure::Usage(
            "--settle is for elastic joints: rigid blocks drop after a support that goes down, and what their impacts leave is another state \
             than that of a gradual settlement; ask --solver implicit --kn PA_PER_M, or move the support in the file"
                .to_owned(),
        ));
    }
    if is_asked(SolverName::Limit) && !arguments.settlements.is_empty() {
        return Err(Failure::Usage(
            "--settle is for elastic joints: to rigid blocks a small settlement is a movement without forces, which no multiplier \
             depends on; ask --solver implicit --kn PA_PER_M, or move the support in the file"
                .to_owned(),
        ));
    }
    if let Some(elastic) = elastic.filter(|_| arguments.kn.is_none()) {
        return Err(Failure::Usage(format!(
            "--kn PA_PER_M is required for the {} solver: the normal stiffness of the joints per area, for example --kn 1e9; --solver limit and nonsmooth need none",
            elastic.name()
        )));
    }
    if arguments.solver() == SolverName::Limit {
        if arguments.step_deg.is_some() {
            warnings.push("limit analysis takes no steps: --step-deg does not matter".to_owned());
        }
        return Ok(warnings);
    }
    if arguments.flow == Some(FlowName::Associative) {
        warnings.push(format!("--flow is for limit analysis; joints of the {solver} solver do not dilate"));
    }
    if arguments.growing() == Growing::Lateral && arguments.step_deg.is_some() {
        warnings.push("the steps of the multiplier are the tangent of --step-deg".to_owned());
    }
    Ok(warnings)
}

/// Refuses what is said of how the file is read and means nothing for it.
fn read_in_vain(arguments: &Analyse) -> Result<(), Failure> {
    let stated = |choice: &Choice| match choice {
        Choice::Unit => arguments.unit.is_some(),
        Choice::Up => arguments.up.is_some(),
        Choice::Density => arguments.density_kg_per_m3.is_some(),
        Choice::Thickness => arguments.thickness.is_some(),
        Choice::Pixel => arguments.pixel.is_some(),
        Choice::Width => arguments.width.is_some(),
        Choice::Section => arguments.section,
        Choice::Flatness => arguments.flatness.is_some(),
        Choice::Parts => arguments.parts,
        Choice::ScanBearing => arguments.scan_bearing.is_some(),
        Choice::Mend => arguments.mend.is_some(),
    };
    let stated: Vec<Choice> = Choice::ALL.into_iter().filter(stated).collect();
    let nature = Nature {
        format: format(arguments),
        // A file that is not there is told as such.
        states_units: arguments.wall.is_file() && !leaves_units_open(&arguments.wall),
    };
    let why = |choice: &Choice| choice.in_vain(nature, &stated).map(|why| (choice.option(), why));
    match stated.iter().find_map(why) {
        Some((option, why)) => Err(Failure::Usage(format!("{option} is {why}"))),
        None => Ok(()),
    }
}

/// The arguments, with a range of stiffnesses where implicit answers alone and none is stated: several solvers are compared at one, and runs of explicit
/// take too long for a range.
fn with_usual_stiffness(arguments: &Analyse) -> Analyse {
    let is_open = arguments.kn.is_none() && arguments.solvers == [SolverName::Implicit];
    let usual = || known::stiffness(USUAL_STIFFNESS).ok();
    Analyse { kn: if is_open { usual() } else { arguments.kn.clone() }, ..arguments.clone() }
}

/// Says which ranges are taken where nothing is stated.
fn usual(arguments: &Analyse) -> Option<String> {
    let all = [
        ("friction", "deg", "--phi-deg", Some(&arguments.phi_deg)),
        ("stiffness", "Pa/m", "--kn", arguments.kn.as_ref()),
    ];
    let taken = all.into_iter().filter_map(|(what, unit, option, known)| {
        Some(format!("{what} {} {unit} ({option})", known?.usual()?))
    });
    let taken: Vec<String> = taken.collect();
    (!taken.is_empty()).then(|| {
        format!(
            "taken where nothing is stated: {}, the range of published joints of stone; a narrower one makes the answer surer",
            taken.join(" and ")
        )
    })
}

/// Angles that look as if they were not in degrees.
fn in_radians(arguments: &Analyse) -> Vec<String> {
    let direction = arguments.direction.angle_deg();
    let asked = [
        ("--phi-deg", Angle::Friction.doubt(arguments.phi_deg.middle())),
        ("--direction", Angle::Direction.doubt(direction)),
    ];
    asked.into_iter().filter_map(|(option, doubt)| Some(format!("{option}: {}", doubt?))).collect()
}

/// Blocks that overlap as built press on each other from the start: how hard, for the solvers that are elastic.
fn prestress(arguments: &Analyse, wall: &Wall, fit: &Fit) -> Option<String> {
    let kn = arguments.kn.as_ref().filter(|_| arguments.solver().is_elastic())?.middle();
    let (low, high) = bounds(wall);
    let moving = wall.blocks.iter().filter(|b| b.support != Support::Fixed);
    let heaviest = moving.map(|b| b.density).fold(0.0, f64::max);
    let (pressure, weight) = (kn * fit.deepest, heaviest * STANDARD_GRAVITY * (high.z - low.z));
    (pressure > PRESTRESS * weight).then(|| {
        format!(
            "the deepest overlap as built, {:.1e} m, starts with a pressure of {:.3} kPa at kn = {} Pa/m; the weight of the wall's height makes {:.3} kPa: trim the blocks, or ask --solver limit, which takes shapes only",
            fit.deepest,
            1e-3 * pressure,
            compact(kn),
            1e-3 * weight
        )
    })
}
