//! From the raw tree of study.toml to checked parts.

use crate::math::radians;
use crate::protocol::{
    BaseMotion, Direction, Ends, EventShares, Fill, History, Lateral, Lifts, NoFill, Protocol, Rate,
    Retained, Retaining, Shear, Tilting, Turning, WATER,
};
use crate::random::{Design, RANDOMISATIONS};
use crate::solve::explicit::Rayleigh;
use crate::solve::nonsmooth::{Normal, StepSolver};
use crate::solve::{Solver, explicit, implicit, limit, nonsmooth};
use crate::study::arm;
use crate::study::averaged;
use crate::study::catalogue::Catalogue;
use crate::study::cause::CAUSES;
use crate::study::checked::Arm;
use crate::study::demands::{unfit_arms, unfit_for};
use crate::study::earthquakes::Earthquakes;
use crate::study::fault::{Fault, Found, Place};
use crate::study::keys;
use crate::study::raw::Node;
use crate::study::reader::{Notes, Reader};
use crate::study::schema::suggestion;
use crate::study::setting::Setting;
use crate::study::uncertain::parameters;

/// The checked parts of study.toml.
pub struct Parts {
    pub question: String,
    pub seed: u64,
    pub design: Design,
    pub arms: Vec<Arm>,
    pub protocol: Protocol,
    pub earthquakes: Option<Earthquakes>,
    pub solver: Solver,
    pub agreement: bool,
}

/// Reads everything, notes every fault, and answers only when no part is faulty.
pub fn parts(root: &Node, notes: &mut Notes, catalogue: &mut Catalogue) -> Option<Parts> {
    let mut top = Reader::open(root, "", &keys::STUDY, notes)?;
    let study = top.table("study").and_then(|mut t| {
        let (question, seed) = (t.text("question"), t.whole("seed"));
        let only = t.has("arms").then(|| t.names("arms"));
        let design = if t.has("design") { t.choice("design") } else { Some(Design::Plain) };
        Some((question?, seed?, only, design))
    });
    let shared = Setting::of_study(&mut top, catalogue);
    let loaded = top.table("load").and_then(|mut t| load(&mut t, catalogue));
    let (protocol, earthquakes) = loaded.unzip();
    let solved = top.table("solver").and_then(|mut t| {
        let agreement = t.flag("agreement");
        solver(&mut t).zip(agreement)
    });
    let arms = arm::arms(&mut top, &shared, protocol.as_ref(), catalogue);
    let (question, seed, only, design) = study?;
    let design = design?;
    let (solver, agreement) = solved?;
    let arms = match only {
        Some(only) => chosen(&mut top, arms?, &only?)?,
        None => arms?,
    };
    let protocol = protocol?;
    let earthquakes = earthquakes.flatten().map(|own| own.seeded(seed));
    check_shear(&mut top, &arms, &protocol)?;
    check_mechanisms(&mut top, &arms, &protocol, agreement)?;
    check_design(&mut top, &arms, design)?;
    averaged::warn(root, &arms, top.notes);
    for unfit in unfit_for(&solver, &arms, &protocol, agreement) {
        let place = top.place_of("solver").clone();
        top.notes.faults.push(beyond(&place, &solver, unfit));
    }
    Some(Parts { question, seed, design, arms, protocol, earthquakes, solver, agreement })
}

/// The fault of a study that asks a solver for what it does not have.
pub fn beyond(place: &Place, solver: &Solver, unfit: String) -> Fault {
    let found = Found::Words(format!("is \"{}\", which does not go with {unfit}", solver.name()));
    let allowed = match unfit.contains("base_motion") {
        true => "nonsmooth or explicit for that",
        false => "explicit or implicit for that",
    };
    Fault::at(place, "solver.name", found, allowed, "take another solver, or remove it")
}

/// The arms of these names, in the order of the names. What the others say decides nothing.
fn chosen(top: &mut Reader<'_>, arms: Vec<Arm>, only: &[String]) -> Option<Vec<Arm>> {
    let names: Vec<String> = arms.iter().map(|arm| arm.name.clone()).collect();
    let mut study = top.table("study")?;
    for name in only.iter().filter(|name| !names.contains(name)) {
        study.fault("arms", format!("names of arms: {}", names.join(", ")), suggestion(name, &names));
    }
    for name in names.iter().filter(|name| !only.contains(name)) {
        let own = format!("arm.{name}.");
        top.notes.effective.retain(|path, _| !path.starts_with(&own));
    }
    top.record("arm", only.join(", "));
    only.iter().map(|name| arms.iter().find(|arm| arm.name == *name).cloned()).collect()
}

/// What a design needs: something that is drawn once per wall, and as many walls in each randomisation of every arm.
fn check_design(top: &mut Reader<'_>, arms: &[Arm], design: Design) -> Option<()> {
    if design == Design::Plain {
        return Some(());
    }
    let mut study = top.table("study")?;
    if parameters(arms).is_empty() {
        let allowed = "plain where nothing is drawn once per wall";
        study.fault("design", allowed, "add [uncertain], or remove it");
        return None;
    }
    if let Err(fits) = members_fit(design, arms) {
        study.fault("design", fits, "mend members of the arms, or remove it");
        return None;
    }
    Some(())
}

/// Whether every arm of more than one wall has walls that a design can share out evenly.
///
/// # Errors
/// What is allowed, in words.
pub fn members_fit(design: Design, arms: &[Arm]) -> Result<(), String> {
    let mut several = arms.iter().map(|arm| arm.members).filter(|members| *members > 1);
    let Some(first) = several.next() else { return Ok(()) };
    let is_whole = first.is_multiple_of(RANDOMISATIONS) && first >= 2 * RANDOMISATIONS;
    let most = RANDOMISATIONS * Design::MOST_POINTS;
    if design != Design::Plain && arms.iter().any(|arm| arm.until.is_some()) {
        return Err(
            "this with members = a number: how many walls share a design is known beforehand".to_owned()
        );
    }
    if design == Design::Plain || (is_whole && first <= most && several.all(|members| members == first)) {
        return Ok(());
    }
    Err(format!(
        "this with as many walls in every arm of several, a multiple of {RANDOMISATIONS} from {} to {most}",
        2 * RANDOMISATIONS
    ))
}

/// What a beam on the wall's top needs: room above every wall and free ends; and nothing for it to do where there is none.
fn check_shear(top: &mut Reader<'_>, arms: &[Arm], protocol: &Protocol) -> Option<()> {
    let before = top.notes.faults.len();
    let mut fault = |table: &str, key: &str, found: String, allowed: &str, fix: &str| {
        let place = top.place_of(table).clone();
        top.notes.faults.push(Fault::at(&place, key, Found::Words(found), allowed, fix));
    };
    for arm in arms {
        match protocol {
            Protocol::Shear(shear) => {
                let height = arm.top();
                if shear.force_height <= height {
                    let found = format!("pushes at or below the top of {}, {height} m high", arm.name);
                    let allowed = "more than the height of every wall";
                    fault(
                        "load",
                        "load.force_height_m",
                        found,
                        allowed,
                        "push higher: at the middle of the beam",
                    );
                }
                if arm.restraint.ends != Ends::Free {
                    let found = format!("hold {} while a beam pushes it along", arm.name);
                    fault(
                        "restraint",
                        "restraint.ends",
                        found,
                        "\"free\" where walls are sheared",
                        "free them",
                    );
                }
            }
            Protocol::Lateral(_)
            | Protocol::Tilting(_)
            | Protocol::BaseMotion(_)
            | Protocol::Retaining(_)
                if arm.vertical_load.is_some() =>
            {
                let (key, found) =
                    (format!("arm.{}.vertical_load_n", arm.name), "has no beam to weigh".to_owned());
                fault("arm", &key, found, "load.protocol = \"shear\"", "remove it, or shear the walls");
            }
            Protocol::Lateral(_)
            | Protocol::Tilting(_)
            | Protocol::BaseMotion(_)
            | Protocol::Retaining(_) => {}
        }
    }
    (top.notes.faults.len() == before).then_some(())
}

/// What mechanisms need of the study as a whole: something in some arm to act on, a load that they go with, and no limit
/// analysis that knows nothing of them.
fn check_mechanisms(top: &mut Reader<'_>, arms: &[Arm], protocol: &Protocol, agreement: bool) -> Option<()> {
    let before = top.notes.faults.len();
    for cause in CAUSES {
        if let Some(what) = cause.missing(arms, protocol) {
            let key = format!("mechanism.{}", cause.name);
            let found = Found::Words("has nothing to act on".to_owned());
            let fault = Fault::at(top.place_of("mechanism"), &key, found, what, "remove it, or add that");
            top.notes.faults.push(fault);
        }
    }
    let unfit = unfit_arms(&Solver::Limit(limit::Settings::default()), arms);
    if agreement && !unfit.is_empty() {
        let key = "solver.agreement";
        let found = Found::Words(format!("asks limit analysis about {}", unfit.join("; ")));
        let fix = "set it to false, or remove them";
        let place = top.place_of("solver").clone();
        top.notes.faults.push(Fault::at(&place, key, found, "what rigid blocks can have", fix));
    }
    (top.notes.faults.len() == before).then_some(())
}

/// What is done to each wall, and the records of a base that shakes.
fn load(t: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<(Protocol, Option<Earthquakes>)> {
    let alone = |protocol| (protocol, None);
    match t.chosen()? {
        "lateral" => lateral(t).map(Protocol::Lateral).map(alone),
        "shear" => shear(t).map(Protocol::Shear).map(alone),
        "retaining" => retaining(t).map(Protocol::Retaining).map(alone),
        "base_motion" => {
            let towards = towards(t);
            let (base, earthquakes) = (base_motion(t, towards), Earthquakes::read(t, towards, catalogue));
            Some((Protocol::BaseMotion(base?), Some(earthquakes?)))
        }
        _ => tilting(t).map(Protocol::Tilting).map(alone),
    }
}

fn base_motion(t: &mut Reader<'_>, towards: Option<Direction>) -> Option<BaseMotion> {
    let (after, twice, shares, rayleigh) = (t.real("after_s"), t.flag("twice"), events(t), rayleigh(t));
    Some(BaseMotion { towards: towards?, after: after?, shares: shares?, rayleigh: rayleigh?, twice: twice? })
}

/// Damping by a ratio at two frequencies; none where neither is given.
fn rayleigh(t: &mut Reader<'_>) -> Option<Rayleigh> {
    let keys = ["rayleigh_ratio", "rayleigh_hz"];
    if !keys.iter().any(|key| t.has(key)) {
        return Some(Rayleigh::default());
    }
    if let Some(missing) = keys.iter().find(|key| !t.has(key)) {
        t.fault(missing, "both rayleigh_ratio and rayleigh_hz, or neither", format!("add {missing}"));
        return None;
    }
    let (ratio, hz) = (t.real("rayleigh_ratio"), t.list("rayleigh_hz")?);
    let [low, high] = hz[..] else {
        t.fault("rayleigh_hz", "two frequencies", "give the lower and the higher one");
        return None;
    };
    Some(Rayleigh::of(ratio?, [low, high]))
}

fn lateral(t: &mut Reader<'_>) -> Option<Lateral> {
    let reals = t.reals(["mean_pressure_pa", "base_over_top", "collapse_share"]);
    let steps = t.whole32("steps");
    let [mean_pressure, base_over_top, collapse_share] = reals?;
    Some(Lateral { mean_pressure, base_over_top, steps: steps?, collapse_share })
}

/// What a wall holds back, and how it rises.
fn retaining(t: &mut Reader<'_>) -> Option<Retaining> {
    let reals = t.reals(["bracket_share", "runaway_share"]);
    let (retained, count) = (retained(t), t.whole32("lifts"));
    let [bracket, collapse_share] = reals?;
    Some(Retaining { retained: retained?, lifts: Lifts { count: count?, bracket }, collapse_share })
}

fn retained(t: &mut Reader<'_>) -> Option<Retained> {
    const NEEDED: [&str; 2] = ["fill_density_kg_per_m3", "fill_phi_deg"];
    const MORE: [&str; 4] = ["wall_friction_share", "fill_slope_deg", "surcharge_pa", "drained"];
    if t.choice_name("retained")? == "water" {
        let stated = NEEDED.iter().chain(&MORE).find(|key| t.has(key));
        return match stated {
            Some(key) => {
                t.fault(key, "none where retained = \"water\"", "remove it, or set retained = \"fill\"");
                None
            }
            None => Some(Retained::Water(WATER)),
        };
    }
    if let Some(missing) = NEEDED.iter().find(|key| !t.has(key)) {
        t.fault(missing, "a number where retained = \"fill\"", format!("add {missing}"));
        return None;
    }
    let [density, phi] = t.reals(NEEDED)?;
    let mut or_none = |key: &str| if t.has(key) { t.real(key) } else { Some(0.0) };
    let [wall_friction, slope, surcharge] = [MORE[0], MORE[1], MORE[2]].map(&mut or_none);
    let (wall_friction, slope, surcharge) = (wall_friction?, slope?, surcharge?);
    let drained = if t.has("drained") { t.flag("drained")? } else { true };
    let fill = Fill { density, phi: radians(phi), wall_friction, slope: radians(slope), surcharge, drained };
    let (key, allowed, fix) = match fill.wrong() {
        None => return Some(Retained::Fill(fill)),
        Some(NoFill::TooSteep) => {
            ("fill_slope_deg", "at most fill_phi_deg: no soil without cohesion lies steeper", "lower it")
        }
        Some(NoFill::TooLight) => (
            "fill_density_kg_per_m3",
            "above that of water, 1000, where drained = false: soil with its pores full of water",
            "raise it, or remove drained",
        ),
    };
    t.fault(key, allowed, fix);
    None
}

/// Percents end here.
fn shear(t: &mut Reader<'_>) -> Option<Shear> {
    let reals =
        t.reals(["vertical_load_n", "force_height_m", "drift_percent", "step_percent", "runaway_share"]);
    let (head, cycles) = (t.choice("head"), t.whole32("cycles"));
    let [vertical_load, force_height, drift, step, collapse_share] = reals?;
    let to = 0.01 * drift;
    let history = match cycles? {
        0 => History::Monotonic { to },
        count => History::Cycles { to, count },
    };
    Some(Shear { vertical_load, force_height, head: head?, history, step: 0.01 * step, collapse_share })
}

/// The side that goes down, by its name or by its angle.
fn towards(t: &mut Reader<'_>) -> Option<Direction> {
    if !t.has("towards_deg") {
        return t.choice_name("towards").and_then(Direction::named);
    }
    if t.has("towards") {
        t.fault("towards_deg", "one of towards and towards_deg", "remove one of the two");
        return None;
    }
    t.real("towards_deg").map(Direction::at)
}

fn tilting(t: &mut Reader<'_>) -> Option<Tilting> {
    let towards = towards(t);
    let reals = t.reals(["step_deg", "end_deg", "bracket_deg", "runaway_share"]);
    let (observes, remainders) = (t.choice("observes"), t.flag("remainders"));
    let events = events(t);
    let turns = t.has("turning");
    let turning = t.table("turning").and_then(|mut t| {
        let [rate, damping, step_safety] = t.reals(["rate_deg_per_s", "damping", "step_safety"])?;
        Some(Turning { rate: radians(rate), damping, step_safety })
    });
    let [step, end, bracket, collapse_share] = reals?;
    let rate = if turns { Rate::Dynamic(turning?) } else { Rate::Static };
    let (step, end, bracket) = (radians(step), radians(end), radians(bracket));
    let (towards, observes, remainders) = (towards?, observes?, remainders?);
    let events = events?;
    if remainders && turns {
        t.fault(
            "remainders",
            "false where the platform turns steadily, as it never stops",
            "remove one of the two",
        );
    }
    Some(Tilting { towards, step, end, bracket, collapse_share, rate, observes, remainders, events })
}

/// The parts of a wall that are seen to fall; each has its default where the study says nothing.
fn events(t: &mut Reader<'_>) -> Option<EventShares> {
    let usual = EventShares::default();
    let part = if t.has("part_share") { t.real("part_share")? } else { usual.part };
    let most = if t.has("most_share") { t.real("most_share")? } else { usual.most };
    let capacity = if t.has("capacity") { t.choice("capacity")? } else { usual.capacity };
    if most < part {
        t.fault("most_share", "at least part_share", "exchange the two");
        return None;
    }
    Some(EventShares { part, most, capacity })
}

/// Reads the solver and its settings.
pub fn solver(t: &mut Reader<'_>) -> Option<Solver> {
    match t.chosen()? {
        "explicit" => explicit(t).map(Solver::Explicit),
        "limit" => {
            let flow = t.choice("flow")?;
            Some(Solver::Limit(limit::Settings { flow, ..limit::Settings::default() }))
        }
        "nonsmooth" => nonsmooth(t).map(Solver::Nonsmooth),
        _ => implicit(t).map(Solver::Implicit),
    }
}

fn explicit(t: &mut Reader<'_>) -> Option<explicit::Settings> {
    let reals = t.reals(["unbalanced_ratio", "damping", "step_safety", "longest_step_s"]);
    let (max_steps, scaled_inertia) = (t.whole("max_steps"), t.flag("scaled_inertia"));
    let [unbalanced_ratio, damping, step_safety, longest_step] = reals?;
    Some(explicit::Settings {
        unbalanced_ratio,
        damping,
        step_safety,
        max_steps: max_steps?,
        scaled_inertia: scaled_inertia?,
        longest_step,
    })
}

fn implicit(t: &mut Reader<'_>) -> Option<implicit::Settings> {
    let reals = t.reals(["unbalanced_ratio", "stabilisation"]);
    let (max_factorisations, max_halvings) = (t.whole32("max_factorisations"), t.whole32("max_halvings"));
    let [unbalanced_ratio, stabilisation] = reals?;
    Some(implicit::Settings {
        unbalanced_ratio,
        max_factorisations: max_factorisations?,
        max_halvings: max_halvings?,
        stabilisation,
    })
}

fn nonsmooth(t: &mut Reader<'_>) -> Option<nonsmooth::Settings> {
    let reals = t.reals(["time_step_s", "tolerance"]);
    let max_steps = t.whole("max_steps");
    let restitution = if t.has("restitution") { Some(t.real("restitution")?) } else { None };
    let (law, solver) = (t.choice_name("normal")?, t.choice::<StepSolver>("step_solver")?);
    if restitution.is_some() && law != "velocity" {
        let fix = "set normal = \"velocity\", or remove it";
        t.fault("restitution", "none but with normal = \"velocity\"", fix);
        return None;
    }
    if law == "compliant" && solver == StepSolver::ConeProgram {
        let fix = "take one of these, or a rigid normal law";
        t.fault("step_solver", "\"newton\" or \"sweeps\" with normal = \"compliant\"", fix);
        return None;
    }
    let normal = match law {
        "velocity" => Normal::Velocity { restitution: restitution.unwrap_or(0.0) },
        "compliant" => Normal::Compliant,
        _ => Normal::Gap,
    };
    let ([time_step, tolerance], max_steps) = (reals?, max_steps?);
    Some(nonsmooth::Settings {
        time_step,
        normal,
        solver,
        tolerance,
        max_steps,
        ..nonsmooth::Settings::default()
    })
}
