//! What is said of a cause, in one place: the facts, its keys, where it has no place, and how it acts.

use std::fmt;

use crate::generate::Layout;
use crate::law::Coulomb;
use crate::model::Wall;
use crate::protocol::{Changes, Contacts, Protocol, Restraint};
use crate::random::Streams;
use crate::solve::{Demand, Solver, limit};
use crate::study::cause::mechanisms::Mechanisms;
use crate::study::cause::shaking::Meeting;
use crate::study::checked::{Arm, Joint};
use crate::study::joints::JointSite;
use crate::study::schema::{Key, Section};

/// Most keys of a cause.
pub const MOST_KEYS: usize = 4;

/// The values of a cause's keys, in their order and in their units; 0 behind the last one.
pub type Values = [f64; MOST_KEYS];

/// An imperfection that the base model leaves out; its table `[mechanism.<name>]` switches it on.
pub struct Cause {
    /// Its name, that of its table of keys.
    pub name: &'static str,
    /// Its name in plain words.
    pub title: &'static str,
    /// What would be true of the wall or of the test, with what looks the same and has no entry of its own.
    pub means: &'static str,
    /// Where it acts.
    pub acts: Acts,
    /// What becomes of its effect when the wall is unloaded.
    pub unloading: Unloading,
    /// Whether it has no bearing on rigid blocks and their loads, by what limit analysis is.
    pub(super) no_bearing: bool,
    /// Causes, and keys of the base model, whose effect on a tilting test looks alike.
    pub confounded: &'static [&'static str],
    /// Its table: numbers, four of them at most.
    pub section: Section,
    /// The files of its priors, one for each key, with their text.
    pub(in crate::study) priors: &'static [(&'static str, &'static str)],
    /// A drawing of what it is of a wall or of a test, for pages.
    pub sketch: &'static str,
    /// What the drawing shows, for those who do not see it.
    pub shows: &'static str,
    /// Keys of which it is the stronger, the smaller they are; of every other it is the stronger, the larger they are. Factors
    /// that go either way count as stronger where they weaken the wall.
    pub(super) stronger_below: &'static [&'static str],
    /// Keys that have no effect somewhere between the ends of their priors.
    pub(super) either_way: &'static [&'static str],
    /// Causes that say the same in another way: one of them at most can be on.
    pub(super) instead_of: &'static [&'static str],
    /// Whether it draws random numbers, so that walls of fixed stones and joints differ from member to member.
    pub(super) draws: bool,
    /// Whether it acts before all others, on what these change further.
    pub(super) first: bool,
    /// Whether an arm has what it acts on, and what that is: a study that has it in no arm is refused.
    pub(super) needs: Option<Need>,
    /// Why it cannot act on an arm under a load; `None` where it can.
    pub(super) idle: fn(Values, &Arm, &Protocol) -> Option<&'static str>,
    /// Why an arm that states it is refused.
    pub(super) clashes: fn(Values, &Beside<'_>) -> Vec<Clash>,
    /// What it demands of a solver that not every one has, with the words in which a study states it.
    pub(super) demand: fn(Values) -> Option<(Demand, &'static str)>,
    /// What keeps walls with it from being plates.
    pub(super) plate: fn(Values) -> OnPlate,
    /// What it makes of the layout that walls are drawn from.
    pub(super) layout: fn(Values, &mut Layout),
    /// What it makes of what holds the walls.
    pub(super) restraint: fn(Values, &mut Restraint),
    /// What it makes of a wall as it stands before it is loaded.
    pub(super) built: fn(Values, Wall, &Protocol) -> Wall,
    /// What it makes of how joints are found and divided.
    pub(super) contacts: fn(Values, &mut Contacts),
    /// What it makes of the law of a joint.
    pub(super) law: fn(Values, &mut Coulomb, &JointSite<'_>),
    /// What it changes of a wall on its way.
    pub(super) changes: fn(Values, &mut Changes, &Wall, &Streams),
    /// What it makes of how a wall meets a motion of its base, by the place of the motion in the wall's sequence, from 0.
    pub(super) shaking: fn(Values, u32, &mut Meeting),
    /// What a gauge shows of a displacement (m) since its zero reading.
    pub(super) reading: fn(Values, f64) -> f64,
}

/// Whether an arm under a load has what a cause acts on, and what that is.
pub(super) type Need = (fn(&Arm, &Protocol) -> bool, &'static str);

/// What an arm states beside a cause.
pub(in crate::study) struct Beside<'a> {
    /// Its joints.
    pub joint: &'a Joint,
    /// Its layout, without any cause.
    pub layout: &'a Layout,
    /// All causes that it states.
    pub mechanisms: &'a Mechanisms,
}

/// A fault at the table of a cause: what it is, what is allowed, how to mend it.
pub(in crate::study) struct Clash {
    pub what: String,
    pub allowed: &'static str,
    pub fix: &'static str,
}

/// Whether walls with a cause can be judged as plates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OnPlate {
    /// They can.
    Fits,
    /// A plate would bear more than its weight lets it.
    Bonded,
    /// They stand otherwise than a plate.
    Placed,
}

/// Where a cause acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Acts {
    /// On the wall as it is built.
    Wall,
    /// On the joints.
    Joints,
    /// On what holds the wall.
    Restraint,
    /// On the wall while it is loaded.
    Loading,
    /// On the readings alone.
    Readings,
}

/// What becomes of a cause's effect when the wall is unloaded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Unloading {
    /// It goes: elastic, or a factor on what is read.
    Reversible,
    /// It stays.
    Irreversible,
    /// It changes the wall for good, and no law: what comes back is what comes back without it.
    AsWithout,
}

/// How limit analysis takes a cause.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InLimitAnalysis {
    /// It counts.
    Honoured,
    /// It has no bearing on rigid blocks and their loads, by what limit analysis is.
    NoBearing,
    /// A study that asks for both is refused.
    Refused,
}

impl Cause {
    /// How limit analysis takes it: that refuses what it demands, or has it. What is demanded at some values alone is nothing that limit
    /// analysis refuses.
    pub fn limit(&self) -> InLimitAnalysis {
        let solver = Solver::Limit(limit::Settings::default());
        match (self.demand)(Values::default()) {
            Some((demand, _)) if solver.refuses(demand).is_some() => InLimitAnalysis::Refused,
            _ if self.no_bearing => InLimitAnalysis::NoBearing,
            _ => InLimitAnalysis::Honoured,
        }
    }

    /// A cause without a name that does nothing: what a cause does not say of itself.
    pub(super) const NOTHING: Cause = Cause {
        name: "",
        title: "",
        means: "",
        acts: Acts::Wall,
        unloading: Unloading::AsWithout,
        no_bearing: false,
        confounded: &[],
        section: table("", "", &[]),
        priors: &[],
        sketch: "",
        shows: "",
        stronger_below: &[],
        either_way: &[],
        instead_of: &[],
        draws: false,
        first: false,
        needs: None,
        idle: |_, _, _| None,
        clashes: |_, _| Vec::new(),
        demand: |_| None,
        plate: |_| OnPlate::Fits,
        layout: |_, _| {},
        restraint: |_, _| {},
        built: |_, wall, _| wall,
        contacts: |_, _| {},
        law: |_, _, _| {},
        changes: |_, _, _, _| {},
        shaking: |_, _, _| {},
        reading: |_, displacement| displacement,
    };
}

impl PartialEq for Cause {
    fn eq(&self, other: &Cause) -> bool {
        self.name == other.name
    }
}

impl fmt::Debug for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name)
    }
}

/// Whether the platform tilts.
pub(super) fn tilts(protocol: &Protocol) -> bool {
    matches!(protocol, Protocol::Tilting(_))
}

/// A reason where the walls are sheared.
pub(super) fn sheared(protocol: &Protocol, why: &'static str) -> Option<&'static str> {
    matches!(protocol, Protocol::Shear(_)).then_some(why)
}

/// A reason where the base moves.
pub(super) fn shaken(protocol: &Protocol, why: &'static str) -> Option<&'static str> {
    matches!(protocol, Protocol::BaseMotion(_)).then_some(why)
}

/// The table of a cause: how it is called, what it is, and its keys.
pub(super) const fn table(
    title: &'static str,
    doc: &'static str,
    keys: &'static [&'static [Key]],
) -> Section {
    Section { title, doc, chooser: None, keys }
}

impl Acts {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            Acts::Wall => "the wall as it is built",
            Acts::Joints => "the joints",
            Acts::Restraint => "what holds the wall",
            Acts::Loading => "the wall while it is loaded",
            Acts::Readings => "the readings alone",
        }
    }
}

impl Unloading {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            Unloading::Reversible => "its effect goes",
            Unloading::Irreversible => "its effect stays",
            Unloading::AsWithout => "as without it",
        }
    }
}

impl InLimitAnalysis {
    /// In words.
    pub fn words(&self) -> &'static str {
        match self {
            InLimitAnalysis::Honoured => "honoured",
            InLimitAnalysis::NoBearing => "has no bearing on it",
            InLimitAnalysis::Refused => "refused",
        }
    }
}

impl serde::Serialize for InLimitAnalysis {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(match self {
            InLimitAnalysis::Honoured => "honoured",
            InLimitAnalysis::NoBearing => "no_bearing",
            InLimitAnalysis::Refused => "refused",
        })
    }
}
