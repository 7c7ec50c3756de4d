//! A study of element types: the same cube filled with spheres, clumps, blocks and polyhedra, shaken one after another.

use std::collections::BTreeMap;
use std::path::Path;

use crate::generate::elements::Elements;
use crate::law::{CohesionAfterSlip, Coulomb, Frictional, NormalLaw, Sampling};
use crate::math::{radians, tan};
use crate::protocol::Shove;
use crate::solve::{explicit, grains};
use crate::study::catalogue::{Catalogue, Used};
use crate::study::checked::InputFile;
use crate::study::fault::{Fault, Faults};
use crate::study::load::{existing, hash_of, parsed, record_revision};
use crate::study::quantity::quantity;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Notes, Reader};
use crate::study::schema::suggestion;
use crate::study::{files, keys, raw};

/// A checked study of element types.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementStudy {
    /// Name: that of its folder.
    pub name: String,
    /// The question it answers, in words.
    pub question: String,
    /// Seed of all random streams.
    pub seed: u64,
    /// Side of the cube (m).
    pub side: f64,
    /// What spheres, clumps and their ground are made of.
    pub spheres: Frictional,
    /// Density of spheres and clumps (kg/m^3).
    pub sphere_density: f64,
    /// Every joint of polyhedra.
    pub joint: Coulomb,
    /// Density of polyhedra (kg/m^3).
    pub polyhedron_density: f64,
    /// Sub-contacts of a joint along its two in-plane axes.
    pub sub_contacts: [u32; 2],
    /// What is done to the elements.
    pub shove: Shove,
    /// How spheres are stepped.
    pub grains: grains::Settings,
    /// How polyhedra are stepped: in true time.
    pub explicit: explicit::Settings,
    /// The types of elements, in the order of the file.
    pub arms: Vec<ElementArm>,
    /// What others report, from published.toml.
    pub published: Vec<Reported>,
    /// What is allowed and yet looks wrong.
    pub warnings: Vec<Fault>,
    /// Every input file with its SHA-256, in the order read.
    pub inputs: Vec<InputFile>,
    /// The entries of `distributions` that it takes, with their provenance.
    pub used: Vec<Used>,
    /// SHA-256 (hex) over every value that decides a result.
    pub hash: String,
    /// Hash of all that decides what an assembly is and comes to: not how many there are.
    pub assemblies_hash: String,
    /// Every value that decides a result, by key.
    pub effective: BTreeMap<String, String>,
}

/// One type of element.
#[derive(Clone, Debug, PartialEq)]
pub struct ElementArm {
    /// Name, unique in the study.
    pub name: String,
    /// Number of assemblies; more than one only where they are random.
    pub members: u64,
    /// The elements.
    pub elements: Elements,
}

/// A row of somebody else's table.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct Reported {
    /// The arm that it is compared with.
    pub name: String,
    /// Where it stands.
    pub source: String,
    /// Number of elements.
    pub elements: u64,
    /// Time step (s).
    pub time_step_s: f64,
    /// Cycles per second of computation.
    pub cycles_per_s: f64,
    /// Number of cycles.
    pub cycles: f64,
    /// Time of computation (s).
    pub time_s: f64,
    /// What became of the assembly.
    pub ends: String,
    /// What a reader should know.
    pub note: String,
}

impl ElementStudy {
    /// Whether the study in a folder is one of element types: its study.toml has a table `[[element]]`.
    pub fn is_in(folder: &Path) -> bool {
        let read = files::read(&folder.join("study.toml"), "study.toml", 0, raw::FORMAT);
        let root = read.ok().and_then(|file| raw::parse(&file.source).ok());
        matches!(root.map(|r| r.value), Some(Value::Table(table)) if table.contains_key("element"))
    }

    /// Loads and checks the study in `folder`.
    ///
    /// # Errors
    /// All faults of all files.
    pub fn load(folder: &Path) -> Result<ElementStudy, Faults> {
        let folder = existing(folder).map_err(|fault| Faults::sorted(vec![*fault]))?;
        let (mut faults, mut inputs, mut notes) = (Vec::new(), Vec::new(), Notes::default());
        let root = parsed(&folder, "study.toml", 0, &mut inputs, &mut faults);
        let reported = match folder.join("published.toml").exists() {
            true => parsed(&folder, "published.toml", 1, &mut inputs, &mut faults),
            false => None,
        };
        let mut catalogue = Catalogue::of_study(&folder);
        let study = root.and_then(|root| study(&root, &mut notes, &mut catalogue));
        // What others report decides no result.
        let mut effective = std::mem::take(&mut notes.effective);
        record_revision(&mut effective);
        let names: Option<Vec<&str>> =
            study.as_ref().map(|s| s.arms.iter().map(|arm| arm.name.as_str()).collect());
        let published =
            reported.map(|root| published(&root, names.as_deref(), &mut notes)).unwrap_or_default();
        faults.append(&mut notes.faults);
        catalogue.hand_over(&mut faults, &mut inputs);
        match study {
            Some(study) if faults.is_empty() => {
                let name = folder.file_name().map(|n| n.to_string_lossy().into_owned()).unwrap_or_default();
                let warnings = Faults::sorted(notes.warnings).faults;
                let (used, hash) = (catalogue.used, hash_of(&effective));
                let of_assemblies = effective.iter().filter(|(key, _)| decides_an_assembly(key));
                let of_assemblies = of_assemblies.map(|(key, value)| (key.clone(), value.clone())).collect();
                let assemblies_hash = hash_of(&of_assemblies);
                let study = ElementStudy { name, published, warnings, inputs, used, ..study };
                Ok(ElementStudy { hash, assemblies_hash, effective, ..study })
            }
            _ => {
                crate::check!(!faults.is_empty(), "the study was refused without a fault");
                Err(Faults::sorted(faults))
            }
        }
    }

    /// The same study with another seed.
    pub fn with_seed(mut self, seed: u64) -> ElementStudy {
        let changed = |hash| changed(hash, "seed", seed);
        (self.seed, self.hash) = (seed, changed(self.hash));
        self.assemblies_hash = changed(self.assemblies_hash);
        self
    }

    /// The same study with another number of assemblies of every random type; at least one.
    pub fn with_members(mut self, members: u64) -> ElementStudy {
        for arm in self.arms.iter_mut().filter(|arm| !arm.elements.is_fixed()) {
            arm.members = members.max(1);
        }
        self.hash = changed(self.hash, "members", members);
        self
    }
}

/// The hash of a study with another value of a key.
fn changed(hash: String, key: &str, value: u64) -> String {
    hash_of(&BTreeMap::from([("study".to_owned(), hash), (key.to_owned(), value.to_string())]))
}

/// Whether a key decides what an assembly comes to, beside its type and its index. How many there are and what is asked decides none.
fn decides_an_assembly(key: &str) -> bool {
    key != "study.question" && !key.ends_with(".members")
}

/// Everything but what comes from other files and the folder.
fn study(root: &Node, notes: &mut Notes, catalogue: &mut Catalogue) -> Option<ElementStudy> {
    let mut top = Reader::open(root, "", &keys::ELEMENT_STUDY, notes)?;
    let question = top.table("study").and_then(|mut t| {
        let (question, seed) = (t.text("question"), t.whole("seed"));
        Some((question?, seed?))
    });
    let side = top.table("cube").and_then(|mut t| t.real("side_m"));
    let spheres = top.table("spheres").and_then(|mut t| spheres(&mut t));
    let polyhedra = top.table("polyhedra").and_then(|mut t| polyhedra(&mut t));
    let shove = top.table("shove").and_then(|mut t| shove(&mut t, side));
    let steps = top.table("solver").and_then(|mut t| steps(&mut t));
    let arms = arms(&mut top, catalogue);
    let (question, seed) = question?;
    let (spheres, sphere_density) = spheres?;
    let (joint, polyhedron_density, sub_contacts) = polyhedra?;
    let (grains, explicit) = steps?;
    Some(ElementStudy {
        name: String::new(),
        question,
        seed,
        side: side?,
        spheres,
        sphere_density,
        joint,
        polyhedron_density,
        sub_contacts,
        shove: shove?,
        grains,
        explicit,
        arms: arms?,
        published: Vec::new(),
        warnings: Vec::new(),
        inputs: Vec::new(),
        used: Vec::new(),
        hash: String::new(),
        assemblies_hash: String::new(),
        effective: BTreeMap::new(),
    })
}

fn spheres(t: &mut Reader<'_>) -> Option<(Frictional, f64)> {
    let [young, ks_over_kn, phi, density] =
        t.reals(["young_pa", "ks_over_kn", "phi_deg", "density_kg_per_m3"])?;
    Some((Frictional { young, ks_over_kn, phi: radians(phi) }, density))
}

fn polyhedra(t: &mut Reader<'_>) -> Option<(Coulomb, f64, [u32; 2])> {
    let reals = t.reals(["kn_pa_per_m", "kn_over_ks", "phi_deg", "density_kg_per_m3"]);
    let sub_contacts = t.pair("sub_contacts");
    let [kn, kn_over_ks, phi, density] = reals?;
    let joint = Coulomb {
        normal: NormalLaw::Linear { kn },
        ks: kn / kn_over_ks,
        tan_phi: tan(radians(phi)),
        cohesion: 0.0,
        tension: 0.0,
        compressive_strength: None,
        cohesion_after_slip: CohesionAfterSlip::Kept,
        weakening: None,
        sampling: Sampling::Area,
        bonded: false,
    };
    Some((joint, density, sub_contacts?))
}

fn shove(t: &mut Reader<'_>, side: Option<f64>) -> Option<Shove> {
    let [acceleration, coarse_ratio, fine_ratio, runaway] =
        t.reals(["acceleration_m_per_s2", "coarse_ratio", "fine_ratio", "runaway_share"])?;
    if fine_ratio > coarse_ratio {
        t.fault("fine_ratio", format!("at most coarse_ratio = {coarse_ratio}"), "reduce it");
        return None;
    }
    Some(Shove { acceleration, coarse_ratio, fine_ratio, runaway: runaway * side? })
}

fn steps(t: &mut Reader<'_>) -> Option<(grains::Settings, explicit::Settings)> {
    let reals = t.reals(["damping", "step_safety", "skin_share", "longest_step_s"]);
    let max_steps = t.whole("max_steps")?;
    let [damping, step_safety, skin_share, longest_step] = reals?;
    let explicit = explicit::Settings {
        damping,
        step_safety,
        max_steps,
        scaled_inertia: false,
        longest_step,
        ..explicit::Settings::default()
    };
    Some((grains::Settings { damping, step_safety, skin_share, max_steps }, explicit))
}

fn arms(top: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<Vec<ElementArm>> {
    let mut arms: Vec<Option<ElementArm>> = Vec::new();
    let mut names: Vec<String> = Vec::new();
    for (node, path) in top.tables("element") {
        let arm = Reader::open(&node, &path, &keys::ELEMENT, top.notes).and_then(|mut t| {
            let name = t.name("name");
            if let Some(name) = &name {
                if names.contains(name) {
                    t.fault("name", "every name once", "rename one of the elements");
                }
                names.push(name.clone());
            }
            let (members, elements) = (t.whole("members"), elements(&mut t, catalogue));
            let elements = elements?;
            if elements.is_fixed() && members.is_some_and(|n| n > 1) {
                t.fault("members", "1 where nothing is random", "leave it out");
            }
            Some(ElementArm { name: name?, members: members?, elements })
        });
        arms.push(arm);
    }
    let arms: Vec<ElementArm> = arms.into_iter().collect::<Option<_>>()?;
    (!arms.is_empty()).then_some(arms)
}

fn elements(t: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<Elements> {
    let chosen = t.chosen()?;
    Some(match chosen {
        "aligned_spheres" => Elements::AlignedSpheres { along: along(t)? },
        "blocks" => Elements::Blocks { along: along(t)? },
        "mesh_clumps" | "compact_clumps" => {
            let (along, across) = (along(t), t.whole32("across"));
            let (along, across) = (along?, across?);
            match chosen {
                "mesh_clumps" => Elements::MeshClumps { along, across },
                _ => Elements::CompactClumps { along, across },
            }
        }
        "sphere_cloud" => {
            let (count, max_draws) = (t.whole32("count"), t.whole32("max_draws"));
            let radius = quantity(t, "radius_m", catalogue);
            Elements::SphereCloud { count: count?, radius: radius?, max_draws: max_draws? }
        }
        "rough_stones" => {
            let (count, per_layer, core_share) =
                (t.whole32("count"), t.pair("per_layer"), t.real("core_share"));
            let corner_share = quantity(t, "corner_share", catalogue);
            Elements::RoughStones {
                count: count?,
                per_layer: per_layer?,
                core_share: core_share?,
                corner_share: corner_share?,
            }
        }
        _ => {
            let (count, max_draws) = (t.whole32("count"), t.whole32("max_draws"));
            let [least_distance_share, gap] = t.reals(["least_distance_share", "gap_m"])?;
            Elements::RandomPolyhedra { count: count?, least_distance_share, gap, max_draws: max_draws? }
        }
    })
}

fn along(t: &mut Reader<'_>) -> Option<[u32; 3]> {
    let [x, y, z] = ["along_x", "along_y", "along_z"].map(|key| t.whole32(key));
    Some([x?, y?, z?])
}

/// Reads published.toml; `names` is `None` when the study is faulty itself.
fn published(root: &Node, names: Option<&[&str]>, notes: &mut Notes) -> Vec<Reported> {
    let Some(mut top) = Reader::open(root, "", &keys::ELEMENTS_PUBLISHED, notes) else { return Vec::new() };
    let rows = top.tables("element");
    let read = |(node, path): &(Node, String)| {
        let mut t = Reader::open(node, path, &keys::REPORTED, top.notes)?;
        let (name, source, note) = (t.name("name"), t.text("source"), t.text("note"));
        if let Some((name, names)) = name.as_ref().zip(names)
            && !names.contains(&name.as_str())
        {
            t.fault("name", "an element of study.toml", suggestion(name, names));
        }
        let (elements, ends) = (t.whole("elements"), t.choice_name("ends"));
        let [time_step_s, cycles_per_s, cycles, time_s] =
            t.reals(["time_step_s", "cycles_per_s", "cycles", "time_s"])?;
        Some(Reported {
            name: name?,
            source: source?,
            elements: elements?,
            time_step_s,
            cycles_per_s,
            cycles,
            time_s,
            ends: ends?.to_owned(),
            note: note?,
        })
    };
    rows.iter().filter_map(read).collect()
}
