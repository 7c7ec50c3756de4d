//! From the raw tree of study.toml to checked parts.

use crate::protocol::{Ends, Lateral, Protocol, Restraint};
use crate::solve::Solver;
use crate::solve::explicit::Settings;
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
    let ends = top.table("restraint").and_then(|mut t| {
        let (base, ends) = (t.choice_name("base"), t.choice("ends"));
        base.and::<Ends>(ends)
    });
    let solver = top.table("solver").and_then(|mut t| solver(&mut t));
    let arms = arm::arms(&mut top, &wall.unwrap_or_default(), density.as_ref(), catalogue);
    let (question, seed) = study?;
    let (joint, kn_points, sub_contacts) = joints?;
    Some(Parts {
        question,
        seed,
        arms: arms?,
        joint,
        kn_points,
        protocol: protocol?,
        restraint: Restraint::at_ends(ends?),
        sub_contacts,
        solver: solver?,
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
    let protocol = t.choice_name("protocol");
    let reals = t.reals(["mean_pressure_pa", "base_over_top", "collapse_share"]);
    let steps = t.whole32("steps");
    let [mean_pressure, base_over_top, collapse_share] = reals?;
    protocol?;
    Some(Protocol::Lateral(Lateral { mean_pressure, base_over_top, steps: steps?, collapse_share }))
}

fn solver(t: &mut Reader<'_>) -> Option<Solver> {
    let name = t.choice_name("name");
    let reals = t.reals(["unbalanced_ratio", "damping", "step_safety", "longest_step_s"]);
    let (max_steps, scaled_inertia) = (t.whole("max_steps"), t.flag("scaled_inertia"));
    let [unbalanced_ratio, damping, step_safety, longest_step] = reals?;
    name?;
    Some(Solver::Explicit(Settings {
        unbalanced_ratio,
        damping,
        step_safety,
        max_steps: max_steps?,
        scaled_inertia: scaled_inertia?,
        longest_step,
    }))
}
