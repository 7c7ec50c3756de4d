//! What walls are made of and how they are held: the tables that all arms share, and what an arm says otherwise.

use std::collections::BTreeMap;

use crate::law::{ClosureTable, LEAST_KNOTS, MOST_KNOTS, Sampling};
use crate::math::{radians, tan};
use crate::protocol::{Base, Ends, Restraint, Rope};
use crate::random::Family;
use crate::study::arm::{WallKeys, wall};
use crate::study::bearing::Bearing;
use crate::study::catalogue::Catalogue;
use crate::study::cause::Mechanisms;
use crate::study::checked::{Joint, StatedLaw};
use crate::study::fault::Place;
use crate::study::quantity::quantity;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Notes, Reader, join};
use crate::study::schema::{Kind, Section};
use crate::study::uncertain::{Uncertain, uncertain};

/// The tables of a study that an arm may lay its own keys over.
pub const LAID_OVER: [&str; 6] = ["wall", "block", "joint", "restraint", "mechanism", "uncertain"];

/// The checked tables, as far as they are not faulty.
#[derive(Clone, Debug, Default)]
pub struct Setting {
    /// The outer shape.
    pub wall: WallKeys,
    /// Density of a stone (kg/m^3).
    pub density: Option<Family>,
    /// The joints' properties.
    pub joints: Option<Joints>,
    /// What holds a wall.
    pub restraint: Option<Restraint>,
    /// Mechanisms beyond the base model.
    pub mechanisms: Option<Mechanisms>,
    /// What is drawn once per wall.
    pub uncertain: Option<Vec<(Uncertain, Place)>>,
    /// The tables as they stand in the file.
    raw: BTreeMap<&'static str, Node>,
}

/// What `[joint]` says.
#[derive(Clone, Debug)]
pub struct Joints {
    /// Properties other than kn.
    pub joint: Joint,
    /// Normal stiffnesses (Pa/m).
    pub kn_points: Vec<f64>,
    /// Sub-contacts of a joint along its two in-plane axes.
    pub sub_contacts: [u32; 2],
}

impl Setting {
    /// The tables of the study itself.
    pub fn of_study(top: &mut Reader<'_>, catalogue: &mut Catalogue) -> Setting {
        let mut setting = Setting {
            mechanisms: Some(Mechanisms::default()),
            uncertain: Some(Vec::new()),
            ..Setting::default()
        };
        for name in LAID_OVER {
            if let Some((node, _)) = top.given(name) {
                setting.raw.insert(name, node);
            }
            if let Some(mut t) = top.table(name) {
                setting.read(name, &mut t, catalogue);
            }
        }
        setting
    }

    /// The same with what an arm says otherwise. A fault that the study's own table has is not said again.
    pub fn of_arm(&self, arm: &mut Reader<'_>, catalogue: &mut Catalogue) -> Setting {
        let mut setting = self.clone();
        for name in LAID_OVER {
            if !arm.takes(name) {
                continue;
            }
            let Some((own, key)) = arm.given(name) else { continue };
            let Kind::Table(section) = key.kind else { continue };
            let path = join(&arm.path, name);
            let laid = self.raw.get(name).map_or(own.clone(), |shared| laid_over(shared, &own, section));
            let mut notes = Notes::default();
            setting.forget(name);
            if let Some(mut t) = Reader::open(&laid, &path, section, &mut notes) {
                setting.read(name, &mut t, catalogue);
            }
            let known = &mut arm.notes.faults;
            notes.faults.retain(|fault| !known.iter().any(|k| k.is_of_the_shared_table(fault, name)));
            known.append(&mut notes.faults);
            let warned = &mut arm.notes.warnings;
            notes.warnings.retain(|fault| !warned.iter().any(|k| k.is_at_the_place_of(fault)));
            warned.append(&mut notes.warnings);
            arm.notes.effective.append(&mut notes.effective);
        }
        setting
    }

    fn forget(&mut self, name: &str) {
        match name {
            "wall" => self.wall = WallKeys::default(),
            "block" => self.density = None,
            "joint" => self.joints = None,
            "mechanism" => self.mechanisms = None,
            "uncertain" => self.uncertain = None,
            _ => self.restraint = None,
        }
    }

    fn read(&mut self, name: &str, t: &mut Reader<'_>, catalogue: &mut Catalogue) {
        match name {
            "wall" => self.wall = wall(t),
            "block" => self.density = quantity(t, "density_kg_per_m3", catalogue),
            "joint" => self.joints = joints(t, catalogue),
            "mechanism" => self.mechanisms = Mechanisms::read(t),
            "uncertain" => self.uncertain = uncertain(t, catalogue),
            _ => self.restraint = restraint(t),
        }
    }
}

/// A table with an arm's keys in the place of its own. Where the arm chooses otherwise, keys that mean nothing for its choice
/// are left out.
fn laid_over(shared: &Node, own: &Node, section: &Section) -> Node {
    let (Value::Table(shared_keys), Value::Table(own_keys)) = (&shared.value, &own.value) else {
        return own.clone();
    };
    let chosen =
        section.chooser.and_then(|chooser| match own_keys.get(chooser).map(|entry| &entry.node.value) {
            Some(Value::Text(text)) => Some(text.as_str()),
            _ => None,
        });
    let mut keys = shared_keys.clone();
    keys.retain(|name, _| chosen.is_none() || section.key(name, chosen).is_some());
    keys.extend(own_keys.iter().map(|(name, entry)| (name.clone(), entry.clone())));
    Node { value: Value::Table(keys), ..own.clone() }
}

fn joints(t: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<Joints> {
    let kn_points = t.list("kn_pa_per_m");
    let kn_factor = quantity(t, "kn_factor", catalogue);
    let phi_deg = quantity(t, "phi_deg", catalogue);
    let cohesion = quantity(t, "cohesion_pa", catalogue);
    let reals = t.reals(["kn_over_ks", "tension_pa"]);
    let cohesion_after_slip = t.choice("cohesion_after_slip");
    let compressive_strength = if t.has("compressive_strength_pa") {
        t.real("compressive_strength_pa").map(Some)
    } else {
        Some(None)
    };
    let normal_law = normal_law(t);
    let sampling = t.choice("sampling");
    let bearing = bearing(t, sampling);
    let sub_contacts = t.pair("sub_contacts");
    let [kn_over_ks, tension] = reals?;
    let joint = Joint {
        kn_factor: kn_factor?,
        kn_over_ks,
        phi_deg: phi_deg?,
        cohesion: cohesion?,
        tension,
        compressive_strength: compressive_strength?,
        cohesion_after_slip: cohesion_after_slip?,
        normal_law: normal_law?,
        sampling: sampling?,
        bearing: bearing?,
    };
    Some(Joints { joint, kn_points: kn_points?, sub_contacts: sub_contacts? })
}

fn bearing(t: &mut Reader<'_>, sampling: Option<Sampling>) -> Option<Option<Bearing>> {
    if !t.has("bearing") {
        return Some(None);
    }
    let bearing = t.table("bearing").and_then(|mut t| Bearing::read(&mut t));
    if sampling == Some(Sampling::Vertices) {
        let allowed = "only where sampling = \"area\"";
        t.fault("bearing", allowed, "remove it, or set sampling = \"area\"");
        return None;
    }
    bearing.map(Some)
}

fn normal_law(t: &mut Reader<'_>) -> Option<StatedLaw> {
    if t.chosen()? != "table" {
        return Some(StatedLaw::Linear);
    }
    let (closures, stresses) = (t.list("table_closure_m"), t.list("table_stress_pa"));
    let (closures, stresses) = (closures?, stresses?);
    if closures.len() < LEAST_KNOTS {
        let allowed = format!("{LEAST_KNOTS} to {MOST_KNOTS} knots");
        t.fault("table_closure_m", allowed, "add knots; one is a linear law, which kn_pa_per_m states");
        return None;
    }
    if closures.len() != stresses.len() {
        let allowed = format!("{} stresses, one for each closure", closures.len());
        t.fault("table_stress_pa", allowed, format!("it has {}", stresses.len()));
        return None;
    }
    let table = ClosureTable::through(&closures, &stresses);
    crate::check!(table.is_some(), "lists that ascend make no table: {closures:?} {stresses:?}");
    table.map(Box::new).map(StatedLaw::Table)
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
    Some(Restraint { base: Base { tan_phi, strip_height, compliance: None }, ends: ends? })
}

fn ends(t: &mut Reader<'_>) -> Option<Ends> {
    let name = t.choice_name("ends");
    let roped = t.has("rope");
    let rope = t.table("rope").and_then(|mut t| rope(&mut t));
    let ends = match name? {
        "ropes" if roped => return rope.map(Ends::Ropes),
        "ropes" => {
            let allowed = "this with a table [restraint.rope]";
            t.fault("ends", allowed, "add [restraint.rope] with stiffness_n_per_m");
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
