//! `analyse --study`: the same question as a study, whose one arm is the wall's file, so that all that many walls can do may follow.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::ensemble::{Scale, Spread, replace_file};
use crate::exchange::{Format, leaves_units_open, wall_bytes};
use crate::study::{Fit, Study, TOUCH, Tolerance};
use crate::terminal::failure::Failure;
use crate::terminal::output;
use crate::verb::analyse::ask::{Analyse, FlowName, Growing, LoadName};
use crate::verb::analyse::known::Known;
use crate::verb::analyse::solve::{BRACKET_DEG, LARGEST_TILT_DEG, RUNS_AWAY, STEP_DEG, law};
use crate::verb::analyse::uncertainty::AskedOfWall;
use crate::verb::analyse::unsure::{SEED, WALLS, asked};
use crate::verb::arguments::{SolverName, quoted};
use crate::verb::locate;

/// Friction angles (deg) that a study takes.
const FRICTION_OF_STUDIES: [f64; 2] = [0.0, 85.0];

/// What a study cannot ask as `analyse` does, before anything is solved.
pub(crate) fn refused(arguments: &Analyse) -> Result<(), Failure> {
    let Some(folder) = &arguments.study else { return Ok(()) };
    let is_log = |known: &Known| matches!(known, Known::Within { spread, .. } if spread.is_log());
    let reasons = [
        (
            arguments.load == LoadName::Lateral,
            "--load lateral pushes with a share of the weight, and load.protocol = \"lateral\" of a study with a pressure on one face",
        ),
        (
            arguments.load == LoadName::BaseMotion,
            "--load base-motion asks about one motion, and load.protocol = \"base_motion\" of a study about the intensity at which walls fall",
        ),
        (
            matches!(arguments.growing(), Growing::Height | Growing::Factor),
            "it is for --load tilt; fill and water are load.protocol = \"retaining\" of a study, and a pressure is \"lateral\": write those with an arm of this file",
        ),
        (
            arguments.wall.is_dir(),
            "an arm reads one file, and not a folder: ask --out FOLDER without --study, and then for a study of the wall.json in it",
        ),
        (
            !arguments.dead_loads.is_empty(),
            "--dead-load: a wall.json states no loads; make that block as much denser in the file",
        ),
        (
            !arguments.settlements.is_empty(),
            "--settle: no load path of a study begins with a support that goes down",
        ),
        (
            arguments.kn.as_ref().is_some_and(is_log),
            "--kn LOW..HIGH is even in the logarithm, which no distribution of a study is: give --kn \"lognormal(MEAN, SD)\"",
        ),
    ];
    if let Some((_, why)) = reasons.iter().find(|(holds, _)| *holds) {
        return Err(Failure::Usage(format!("--study: {why}")));
    }
    if let Some(Err(why)) = asked(arguments).iter().map(family).find(Result::is_err) {
        return Err(Failure::Usage(format!("--study: {why}")));
    }
    if !locate::is_free(folder) {
        let text = "is there already; name another folder, or remove it first";
        return Err(Failure::Usage(format!("--study {0}: {0} {text}", folder.display())));
    }
    Ok(())
}

/// Writes the study with a copy of the wall's file, and reads it once.
pub(crate) fn write(arguments: &Analyse, fit: &Fit, folder: &Path) -> Result<(), Failure> {
    let bytes = wall_bytes(&arguments.wall, &arguments.wall.display().to_string())
        .map_err(|faults| Failure::Run(faults.to_string()))?;
    output::folder(folder)?;
    replace_file(&folder.join(arguments.title()), &bytes)?;
    replace_file(&folder.join("study.toml"), text(arguments, fit).as_bytes())?;
    // What a study does not take leaves nothing behind: the folder was not there, or empty.
    Study::load(folder, None).inspect_err(|_| drop(fs::remove_dir_all(folder)))?;
    Ok(())
}

/// The distribution of what is not known exactly, in a study, where friction angles go less far.
fn family(own: &AskedOfWall) -> Result<String, String> {
    let spread = match own.unsure.name {
        "phi_deg" => Spread::spelled(&own.stated, FRICTION_OF_STUDIES, Scale::Linear)
            .map_err(|why| format!("--phi-deg {}: {why}; a study takes 0 to 85 degrees", own.stated))?,
        _ => own.unsure.spread.clone(),
    };
    let written = toml::Value::try_from(spread.family()).map_err(|error| error.to_string())?;
    Ok(written.to_string())
}

/// Its study.toml.
fn text(arguments: &Analyse, fit: &Fit) -> String {
    let title = arguments.title();
    let unsure = asked(arguments);
    let random = !unsure.is_empty();
    let mut text = format!(
        "# The question of `pirca analyse {}` as a study: `pirca run`, `capacity`, `sensitivity` and `shards` take it.\n\n[study]\n\
         question = {:?}\nseed = {}\n",
        quoted(&title),
        format!("At which tilt towards {} does the wall of {title} fall?", arguments.direction),
        arguments.seed.unwrap_or(SEED),
    );
    let mut line = |one: String| {
        let _ = writeln!(text, "{one}");
    };
    let law = law(arguments);
    let kn = law.normal.largest_stiffness();
    line(format!("\n[joint]\nkn_pa_per_m = [{kn:?}]\nkn_over_ks = {:?}", kn / law.ks));
    line(format!("phi_deg = {:?}\ncohesion_pa = {:?}", arguments.phi_deg.middle(), law.cohesion));
    line(format!("sub_contacts = {:?}", fit.contact.sub_contacts));
    line("\n[load]\nprotocol = \"tilting\"".to_owned());
    line(format!("towards_deg = {:?}", arguments.direction.angle_deg()));
    line(format!("step_deg = {:?}", arguments.step_deg.unwrap_or(STEP_DEG)));
    line(format!(
        "end_deg = {LARGEST_TILT_DEG:?}\nbracket_deg = {BRACKET_DEG:?}\nrunaway_share = {RUNS_AWAY:?}\ncapacity = \"first_stone\""
    ));
    line("\n[restraint]\nbase = \"fixed\"\nends = \"free\"".to_owned());
    line(format!("\n[solver]\nname = \"{}\"", arguments.solver().name()));
    if arguments.solver() == SolverName::Limit {
        line(format!("flow = \"{}\"", arguments.flow.unwrap_or(FlowName::Associative).name()));
    }
    if random {
        line("\n[uncertain]".to_owned());
    }
    for own in &unsure {
        let key = match own.unsure.name {
            "density_kg_per_m3" => "block.density_kg_per_m3".to_owned(),
            name => format!("joint.{name}"),
        };
        line(format!("{key:?} = {}", family(own).unwrap_or_default()));
    }
    text + &arm_text(arguments, fit)
}

/// What the face of a wall does not show, to be filled in.
const UNSEEN: &str = "\n# What the face does not show. Without the marks it is drawn for each wall; raise members then.\n# [arm.unseen]\n\
# through_share = { family = \"uniform\", low = 0, high = 0.3 }    # share of stones that go through the wall: a judgement\n\
# depth_share = { family = \"uniform\", low = 0.35, high = 0.65 }  # depth of the others over the thickness: a judgement\n\
# core_share = 0                                                 # thickness of an empty core, as a share\n\
# dip_deg = 0                                                    # of all beds through the wall; above 0 they rise from the face";

/// Its arm.
fn arm_text(arguments: &Analyse, fit: &Fit) -> String {
    let title = arguments.title();
    // One wall, or those of the design over ranges.
    let members = if asked(arguments).is_empty() { 1 } else { arguments.walls.unwrap_or(WALLS) };
    let mut text = String::new();
    let mut line = |one: String| {
        let _ = writeln!(text, "{one}");
    };
    line(format!("\n[[arm]]\nname = \"wall\"\nmembers = {members}"));
    line(format!("arrangement = \"file\"\nfile = {title:?}"));
    let mut stated = |key: &str, value: Option<String>| {
        value.into_iter().for_each(|value| line(format!("{key} = {value}")));
    };
    stated("unit", arguments.unit.map(|unit| format!("\"{}\"", unit.name())));
    stated("up_axis", arguments.up.map(|up| format!("\"{}\"", up.name())));
    stated("flatness_m", arguments.flatness.map(|own| format!("{own:?}")));
    stated("thickness_m", arguments.thickness.map(|own| format!("{own:?}")));
    stated("pixel_m", arguments.pixel.map(|own| format!("{own:?}")));
    stated("width_m", arguments.width.map(|own| format!("{own:?}")));
    stated("section", arguments.section.then(|| "true".to_owned()));
    stated("parts", arguments.parts.then(|| "true".to_owned()));
    stated("fixed", (!arguments.fixed.is_empty()).then(|| format!("{:?}", arguments.fixed)));
    stated("mend_m", arguments.mend.map(|own| format!("{own:?}")));
    stated("scan_bearing_m", arguments.scan_bearing.map(|own| format!("{own:?}")));
    let touch = match arguments.touch_tolerance {
        Tolerance::Share(share) if share == TOUCH => None,
        Tolerance::Share(_) => Some(format!("{:?}", fit.contact.closed)),
        Tolerance::Length(length) => Some(format!("{length:?}")),
    };
    stated("touch_tolerance_m", touch);
    // What is scaled to a mean begins there, as `analyse` reads it.
    let unstated = arguments.density_kg_per_m3.or(arguments.density.as_ref().map(Known::middle));
    stated(
        "unstated_density_kg_per_m3",
        unstated.filter(|_| leaves_units_open(&arguments.wall)).map(|own| format!("{own:?}")),
    );
    if let Some(Known::Exactly(density)) = &arguments.density {
        line(format!("\n[arm.block]\ndensity_kg_per_m3 = {density:?}"));
    }
    if Format::of(&title).is_some_and(Format::is_elevation) && !arguments.section {
        line(UNSEEN.to_owned());
    }
    text
}
