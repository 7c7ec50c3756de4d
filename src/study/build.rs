//! From the raw tree of study.toml to checked parts.

use crate::math::{radians, tan};
use crate::protocol::{Base, Ends, Lateral, Protocol, Rate, Restraint, Rope, Tilting, Turning};
use crate::solve::{Solver, explicit, implicit};
use crate::study::arm;
use crate::study::catalogue::Catalogue;
use crate::study::checked::{Arm, Joint};
use crate::study::keys;
use crate::study::quantity::quantity;
use crate::study::raw::Node;
use crate::study::reader::{Notes, Reader};

/// The checked parts of study.toml.
pub struct Parts {
    pub question: String,
    pub seed: u64,
    pub arms: Vec<Arm>,
    pub joint: Joint,
    pub kn_points: Vec<f64>,
    pub protocol: Protocol,
    pub restraint: Restraint,
    pub sub_contacts: [u32; 2],
    pub solver: Solver,
    pub agreement: bool,
}

/// Reads everything, notes every fault, and answers only when no part is faulty.
pub fn parts(root: &Node, notes: &mut Notes, catalogue: &mut Catalogue) -> Option<Parts> {
    let mut top = Reader::open(root, "", &keys::STUDY, notes)?;
    let study = top.table("study").and_then(|mut t| {
        let (question, seed) = (t.text("question"), t.whole("seed"));
        Some((question?, seed?))
    });
    let wall = top.table("wall").map(|mut t| arm::wall(&mut t));
    let density = top.table("block").and_then(|mut t| quantity(&mut t, "density_kg_per_m3", catalogue));
    let joints = top.table("joint").and_then(|mut t| joint(&mut t, catalogue));
    let protocol = top.table("load").and_then(|mut t| load(&mut t));
    let restraint = top.table("restraint").and_then(|mut t| restraint(&mut t));
    let solved = top.table("solver").and_then(|mut t| {
        let agreement = t.flag("agreement");
        solver(&mut t).zip(agreement)
    });
    let arms = arm::arms(&mut top, &wall.unwrap_or_default(), density.as_ref(), catalogue);
    let (question, seed) = study?;
    let (joint, kn_points, sub_contacts) = joints?;
    let (solver, agreement) = solved?;
    Some(Parts {
        question,
        seed,
        arms: arms?,
        joint,
        kn_points,
        protocol: protocol?,
        restraint: restraint?,
        sub_contacts,
        solver,
        agreement,
    })
}

fn joint(t: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<(Joint, Vec<f64>, [u32; 2])> {
    let kn_points = t.list("kn_pa_per_m");
    let kn_factor = quantity(t, "kn_factor", catalogue);
    let phi_deg = quantity(t, "phi_deg", catalogue);
    let cohesion = quantity(t, "cohesion_pa", catalogue);
    let reals = t.reals(["kn_over_ks", "tension_pa"]);
    let cohesion_after_slip = t.choice("cohesion_after_slip");
    let normal_law = t.choice("normal_law");
    let sampling = t.choice("sampling");
    let sub_contacts = t.pair("sub_contacts");
    let [kn_over_ks, tension] = reals?;
    let joint = Joint {
        kn_factor: kn_factor?,
        kn_over_ks,
        phi_deg: phi_deg?,
        cohesion: cohesion?,
        tension,
        cohesion_after_slip: cohesion_after_slip?,
        normal_law: normal_law?,
        sampling: sampling?,
    };
    Some((joint, kn_points?, sub_contacts?))
}

fn load(t: &mut Reader<'_>) -> Option<Protocol> {
    match t.chosen()? {
        "lateral" => lateral(t).map(Protocol::Lateral),
        _ => tilting(t).map(Protocol::Tilting),
    }
}

fn lateral(t: &mut Reader<'_>) -> Option<Lateral> {
    let reals = t.reals(["mean_pressure_pa", "base_over_top", "collapse_share"]);
    let steps = t.whole32("steps");
    let [mean_pressure, base_over_top, collapse_share] = reals?;
    Some(Lateral { mean_pressure, base_over_top, steps: steps?, collapse_share })
}

fn tilting(t: &mut Reader<'_>) -> Option<Tilting> {
    let towards = t.choice("towards");
    let reals = t.reals(["step_deg", "end_deg", "bracket_deg", "runaway_share"]);
    let turns = t.has("turning");
    let turning = t.table("turning").and_then(|mut t| {
        let [rate, damping, step_safety] = t.reals(["rate_deg_per_s", "damping", "step_safety"])?;
        Some(Turning { rate: radians(rate), damping, step_safety })
    });
    let [step, end, bracket, collapse_share] = reals?;
    let rate = if turns { Rate::Dynamic(turning?) } else { Rate::Static };
    let (step, end, bracket) = (radians(step), radians(end), radians(bracket));
    Some(Tilting { towards: towards?, step, end, bracket, collapse_share, rate })
}

fn restraint(t: &mut Reader<'_>) -> Option<Restraint> {
    let ends = ends(t);
    let phi_deg = t.has("platform_phi_deg").then(|| t.real("platform_phi_deg"));
    let strip = (t.chosen()? == "strip").then(|| t.real("strip_height_m"));
    let tan_phi = match phi_deg {
        Some(phi_deg) => Some(tan(radians(phi_deg?))),
        None => None,
    };
    let strip_height = match strip {
        Some(height) => Some(height?),
        None => None,
    };
    Some(Restraint { base: Base { tan_phi, strip_height }, ends: ends? })
}

fn ends(t: &mut Reader<'_>) -> Option<Ends> {
    let name = t.choice_name("ends");
    let roped = t.has("rope");
    let rope = t.table("rope").and_then(|mut t| rope(&mut t));
    let ends = match name? {
        "ropes" if roped => return rope.map(Ends::Ropes),
        "ropes" => {
            t.fault(
                "ends",
                "this with a table [restraint.rope]",
                "add [restraint.rope] with stiffness_n_per_m",
            );
            return None;
        }
        "fixed_end_blocks" => Ends::FixedEndBlocks,
        "out_of_plane" => Ends::OutOfPlane,
        "joint_springs" => Ends::JointSprings,
        _ => Ends::Free,
    };
    if roped {
        t.fault("rope", "only where ends = \"ropes\"", "remove it, or set ends = \"ropes\"");
        return None;
    }
    Some(ends)
}

fn rope(t: &mut Reader<'_>) -> Option<Rope> {
    let reals = t.reals(["stiffness_n_per_m", "pretension_n", "slack_m", "from_end_m"]);
    let sides = t.choice_name("sides");
    let [stiffness, pretension, slack, from_end] = reals?;
    Some(Rope { stiffness, pretension, slack, from_end, two_sided: sides? == "both" })
}

/// Reads the solver and its settings.
pub fn solver(t: &mut Reader<'_>) -> Option<Solver> {
    match t.chosen()? {
        "explicit" => explicit(t).map(Solver::Explicit),
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
