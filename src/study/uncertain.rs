//! What nobody knows exactly of a wall as a whole: parameters that are drawn once per wall.

use std::borrow::Cow;
use std::collections::BTreeMap;

use crate::generate::Arrangement;
use crate::math::radians;
use crate::protocol::{Ends, Fill, Protocol, Retained, Retaining};
use crate::random::Family;
use crate::study::catalogue::Catalogue;
use crate::study::cause::Mechanisms;
use crate::study::checked::{Arm, Study};
use crate::study::fault::{Fault, Found, Place};
use crate::study::quantity::quantity;
use crate::study::raw::{Node, Value};
use crate::study::reader::{Reader, join};

/// A parameter that may be drawn once per wall. Each is one uniform of a stream of its own, through the inverse CDF.
#[derive(Debug)]
pub struct Parameter {
    /// The path of its key: of `[uncertain]`, or where else a study states that it is drawn once per wall.
    pub key: &'static str,
    /// The stream of its uniform.
    pub stream: &'static str,
    /// Where its value goes; `None` of what is drawn elsewhere.
    put: Option<Put>,
}

/// Puts a value, in the key's unit, in the place of the number that is stated; `None` where there is no single one.
#[derive(Clone, Copy, Debug)]
enum Put {
    /// The cause and the key of it that the path names.
    Cause,
    Arm(fn(&mut Arm, f64) -> Option<()>),
    Load(fn(&mut Protocol, f64) -> Option<()>),
}

/// All of them. The place of each is its dimension in a [`Design`](crate::random::Design): further ones come at the end, so that
/// no study changes. The mean size of a wall's stones is drawn by the generator.
pub static PARAMETERS: [Parameter; 19] = [
    Parameter { key: "wall_size_factor", stream: "wall size", put: None },
    // The streams of specimen_scatter, so that a wall is the same, whichever way its stiffness is said to scatter.
    Parameter {
        key: KN,
        stream: "specimen kn",
        put: Some(Put::Arm(|arm, x| {
            let [kn] = &mut arm.kn_points[..] else { return None };
            *kn = x;
            Some(())
        })),
    },
    Parameter { key: FRICTION, stream: "specimen tan_phi", put: Some(Put::Cause) },
    Parameter {
        key: "joint.kn_over_ks",
        stream: "uncertain joint.kn_over_ks",
        put: Some(Put::Arm(|arm, x| {
            arm.joint.kn_over_ks = x;
            Some(())
        })),
    },
    Parameter {
        key: PHI,
        stream: "uncertain joint.phi_deg",
        put: Some(Put::Arm(|arm, x| constant(&mut arm.joint.phi_deg, x))),
    },
    Parameter {
        key: "joint.cohesion_pa",
        stream: "uncertain joint.cohesion_pa",
        put: Some(Put::Arm(|arm, x| constant(&mut arm.joint.cohesion, x))),
    },
    Parameter {
        key: "joint.tension_pa",
        stream: "uncertain joint.tension_pa",
        put: Some(Put::Arm(|arm, x| {
            arm.joint.tension = x;
            Some(())
        })),
    },
    Parameter {
        key: "joint.compressive_strength_pa",
        stream: "uncertain joint.compressive_strength_pa",
        put: Some(Put::Arm(|arm, x| arm.joint.compressive_strength.replace(x).map(|_| ()))),
    },
    Parameter {
        key: "block.density_kg_per_m3",
        stream: "uncertain block.density_kg_per_m3",
        put: Some(Put::Arm(|arm, x| {
            let factor = arm.mechanisms.value("density", "factor").unwrap_or(1.0);
            constant(&mut arm.layout.density, factor * x)
        })),
    },
    Parameter {
        key: "load.mean_pressure_pa",
        stream: "uncertain load.mean_pressure_pa",
        put: Some(Put::Load(|protocol, x| {
            let Protocol::Lateral(lateral) = protocol else { return None };
            lateral.mean_pressure = x;
            Some(())
        })),
    },
    Parameter {
        key: "load.vertical_load_n",
        stream: "uncertain load.vertical_load_n",
        put: Some(Put::Load(|protocol, x| {
            let Protocol::Shear(shear) = protocol else { return None };
            shear.vertical_load = x;
            Some(())
        })),
    },
    Parameter {
        key: "restraint.rope.stiffness_n_per_m",
        stream: "uncertain restraint.rope.stiffness_n_per_m",
        put: Some(Put::Arm(|arm, x| {
            let Ends::Ropes(rope) = &mut arm.restraint.ends else { return None };
            rope.stiffness = x;
            Some(())
        })),
    },
    Parameter {
        key: "mechanism.contact_inset.radius_m",
        stream: "uncertain mechanism.contact_inset.radius_m",
        put: Some(Put::Cause),
    },
    Parameter {
        key: "mechanism.lean.angle_deg",
        stream: "uncertain mechanism.lean.angle_deg",
        put: Some(Put::Cause),
    },
    Parameter {
        key: "mechanism.joint_closure.initial_pa_per_m",
        stream: "uncertain mechanism.joint_closure.initial_pa_per_m",
        put: Some(Put::Cause),
    },
    Parameter {
        key: "mechanism.joint_closure.closure_m",
        stream: "uncertain mechanism.joint_closure.closure_m",
        put: Some(Put::Cause),
    },
    Parameter {
        key: "load.fill_density_kg_per_m3",
        stream: "uncertain load.fill_density_kg_per_m3",
        put: Some(Put::Load(|protocol, x| {
            fill_of(protocol)?.density = x;
            Some(())
        })),
    },
    Parameter {
        key: "load.fill_phi_deg",
        stream: "uncertain load.fill_phi_deg",
        put: Some(Put::Load(|protocol, x| {
            fill_of(protocol)?.phi = radians(x);
            Some(())
        })),
    },
    Parameter {
        key: "load.wall_friction_share",
        stream: "uncertain load.wall_friction_share",
        put: Some(Put::Load(|protocol, x| {
            fill_of(protocol)?.wall_friction = x;
            Some(())
        })),
    },
];

/// The fill behind the walls of a study, where there is one.
fn fill_of(protocol: &mut Protocol) -> Option<&mut Fill> {
    match protocol {
        Protocol::Retaining(Retaining { retained: Retained::Fill(fill), .. }) => Some(fill),
        _ => None,
    }
}

/// Keys that the mechanism specimen_scatter draws as well.
const KN: &str = "joint.kn_pa_per_m";
const PHI: &str = "joint.phi_deg";
const FRICTION: &str = "mechanism.friction.factor";

/// Puts a value in the place of another; `None` where that is a distribution.
fn constant(family: &mut Family, value: f64) -> Option<()> {
    let was_constant = matches!(family, Family::Constant { .. });
    *family = Family::Constant { value };
    was_constant.then_some(())
}

/// A parameter with its distribution, in the unit of its key.
#[derive(Clone, Debug, PartialEq)]
pub struct Uncertain {
    /// The path of its key.
    pub key: &'static str,
    /// Its distribution.
    pub family: Family,
}

/// A wall of an arm with what is drawn of it as a whole.
#[derive(Clone, Debug)]
pub struct AsDrawn<'s> {
    /// The arm with the values in the place of the numbers stated.
    pub arm: Cow<'s, Arm>,
    /// What is done to the wall.
    pub protocol: Protocol,
    /// The values by the path of their key, in its unit.
    pub values: BTreeMap<String, f64>,
}

impl Study {
    /// A member of an arm with what is drawn of it as a whole; a pure function of study, seed and member.
    pub fn as_drawn(&self, arm: u32, member: u64) -> AsDrawn<'_> {
        let own = &self.arms[arm as usize];
        let mut drawn =
            AsDrawn { arm: Cow::Borrowed(own), protocol: self.protocol_of(own), values: BTreeMap::new() };
        if own.uncertain.is_empty() {
            return drawn;
        }
        let streams = self.streams(member);
        for Uncertain { key, family } in &own.uncertain {
            let Some(parameter) = Parameter::of(key) else { continue };
            let value = family.sample(&mut streams.of(parameter.stream));
            let put = match parameter.put {
                Some(Put::Cause) => parameter.put_in(&mut drawn.arm.to_mut().mechanisms, value),
                Some(Put::Arm(put)) => put(drawn.arm.to_mut(), value),
                Some(Put::Load(put)) => put(&mut drawn.protocol, value),
                None => None,
            };
            crate::check!(put.is_some(), "{key} of {} takes no drawn value", own.name);
            drawn.values.insert((*key).to_owned(), value);
        }
        drawn
    }
}

impl Parameter {
    /// The one of that key.
    pub fn of(key: &str) -> Option<&'static Parameter> {
        PARAMETERS.iter().find(|parameter| parameter.key == key)
    }

    /// Puts a value in the place of that of the cause that its path names.
    fn put_in(&self, mechanisms: &mut Mechanisms, value: f64) -> Option<()> {
        let (name, key) = self.key.strip_prefix("mechanism.")?.split_once('.')?;
        mechanisms.put(name, key, value)
    }

    /// Its dimension in a design.
    pub fn number(&self) -> u32 {
        PARAMETERS.iter().zip(0..).find(|(own, _)| own.key == self.key).map_or(0, |(_, number)| number)
    }
}

/// What is drawn once per wall in some of these arms, in the order of [`PARAMETERS`].
pub fn parameters(arms: &[Arm]) -> Vec<&'static Parameter> {
    let is_drawn = |parameter: &&Parameter| arms.iter().any(|arm| arm.draws_per_wall(parameter));
    PARAMETERS.iter().filter(is_drawn).collect()
}

impl Arm {
    fn draws_per_wall(&self, parameter: &Parameter) -> bool {
        let size_factor = match &self.layout.arrangement {
            Arrangement::Coursed { wall_size_factor, .. } | Arrangement::Cut { wall_size_factor, .. } => {
                wall_size_factor.sd() > 0.0
            }
            Arrangement::Continuous { .. } | Arrangement::Discontinuous { .. } | Arrangement::File { .. } => {
                false
            }
        };
        let scatters =
            |key: &str| self.mechanisms.value("specimen_scatter", key).is_some_and(|cov| cov > 0.0);
        match parameter.key {
            "wall_size_factor" => size_factor,
            KN if scatters("kn_cov") => true,
            FRICTION if scatters("friction_cov") => true,
            key => self.uncertain.iter().any(|own| own.key == key),
        }
    }
}

/// Reads `[uncertain]`: each parameter with the place where it stands.
pub(super) fn uncertain(t: &mut Reader<'_>, catalogue: &mut Catalogue) -> Option<Vec<(Uncertain, Place)>> {
    let mut all = Some(Vec::new());
    for parameter in PARAMETERS.iter().filter(|own| own.put.is_some() && t.has(own.key)).collect::<Vec<_>>() {
        let place = t.place_of(parameter.key).clone();
        let read = quantity(t, parameter.key, catalogue)
            .map(|family| (Uncertain { key: parameter.key, family }, place));
        all = all.zip(read).map(|(mut all, one)| {
            all.push(one);
            all
        });
    }
    all
}

/// Takes what an arm draws once per wall into it, if each takes the place of one number that the study states, is drawn in no other
/// way, and the arm itself states no other number. `protocol` is `None` where it is faulty itself.
pub(super) fn take_up(
    t: &mut Reader<'_>,
    mut arm: Arm,
    stated: Vec<(Uncertain, Place)>,
    protocol: Option<&Protocol>,
) -> Option<Arm> {
    let before = t.notes.faults.len();
    for (own, place) in &stated {
        let is_own = draws_itself(t, own.key);
        if let Some([found, allowed, fix]) = contradiction(&arm, own, protocol) {
            let key = join(if is_own { &t.path } else { "" }, &format!("uncertain.{}", own.key));
            t.notes.faults.push(Fault::at(place, &key, Found::Words(found), allowed, fix));
        }
        if let Some((place, key)) = stated_by_the_arm(t, own.key).filter(|_| !is_own) {
            let found = Found::Words("is stated here, and drawn in the study's [uncertain]".to_owned());
            let fix = format!("write \"{}\" in [arm.uncertain] too, or remove it here", own.key);
            let allowed = "a number that the arm draws itself";
            t.notes.faults.push(Fault::at(&place, &key, found, allowed, fix));
        }
    }
    let is_sound = t.notes.faults.len() == before;
    arm.uncertain = stated.into_iter().map(|(own, _)| own).collect();
    is_sound.then_some(arm)
}

/// What is wrong with a parameter of an arm: found, allowed, and how to mend it.
fn contradiction(arm: &Arm, own: &Uncertain, protocol: Option<&Protocol>) -> Option<[String; 3]> {
    if arm.mechanisms.has("specimen_scatter") && [KN, FRICTION, PHI].contains(&own.key) {
        let found = "is drawn here, and by mechanism.specimen_scatter";
        return Some([found, "one of the two", "remove mechanism.specimen_scatter"].map(str::to_owned));
    }
    let value = own.family.mean();
    let parameter = Parameter::of(own.key)?;
    let put = match parameter.put? {
        Put::Cause => parameter.put_in(&mut arm.mechanisms.clone(), value),
        Put::Arm(put) => put(&mut arm.clone(), value),
        Put::Load(put) => put(&mut protocol?.clone(), value),
    };
    match put {
        Some(()) => None,
        None => Some([
            "is drawn here, and has no single number to take the place of".to_owned(),
            format!("one number at {}, which is drawn nowhere else", own.key),
            format!("state one number there, or remove \"{}\" here", own.key),
        ]),
    }
}

/// Whether an arm has a parameter in an `[uncertain]` of its own.
fn draws_itself(t: &mut Reader<'_>, key: &str) -> bool {
    let draws = |node: &Node| matches!(&node.value, Value::Table(own) if own.contains_key(key));
    t.has("uncertain") && t.given("uncertain").is_some_and(|(node, _)| draws(&node))
}

/// Where an arm states a number of that key, with its path.
fn stated_by_the_arm(t: &mut Reader<'_>, key: &str) -> Option<(Place, String)> {
    let mut path = key.split('.');
    let (table, name) = (path.next()?, path.next()?);
    if table == "load" {
        return t.has(name).then(|| (t.place_of(name).clone(), join(&t.path, name)));
    }
    let node = if t.has(table) { t.given(table)?.0 } else { return None };
    let Value::Table(own) = &node.value else { return None };
    let entry = own.get(name)?;
    Some((entry.key_place.clone(), join(&t.path, &format!("{table}.{name}"))))
}
