//! The causes that are on in an arm, and what they make of its walls: of the layout, the stones, the joints, the restraint, the way
//! along the load path, and what is read.

use crate::generate::Layout;
use crate::law::Coulomb;
use crate::model::Wall;
use crate::protocol::{Changes, Contacts, Protocol, Restraint};
use crate::random::Streams;
use crate::solve::Demand;
use crate::study::cause::CAUSES;
use crate::study::cause::entry::{Beside, Cause, Clash, OnPlate, Values};
use crate::study::cause::shaking::Meeting;
use crate::study::checked::Arm;
use crate::study::joints::JointSite;
use crate::study::reader::Reader;

/// What a study states, checked; nothing by default. They act in one order, whichever was added first.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mechanisms {
    on: Vec<On>,
}

/// A cause with the values of its keys.
#[derive(Clone, Copy, Debug, PartialEq)]
struct On {
    cause: &'static Cause,
    values: Values,
}

impl Mechanisms {
    /// These with the cause of that name, in the place of what they have of it; its values in the order and in the units of its
    /// keys. Panics where there is no such cause, or where it has another number of keys.
    pub fn with(mut self, name: &str, values: &[f64]) -> Mechanisms {
        let cause = Cause::named(name).filter(|cause| cause.section.all().count() == values.len());
        crate::check!(cause.is_some(), "{name} is no cause of {} values", values.len());
        if let Some(cause) = cause {
            let mut filled = Values::default();
            filled.iter_mut().zip(values).for_each(|(to, value)| *to = *value);
            self.add(On { cause, values: filled });
        }
        self
    }

    fn add(&mut self, one: On) {
        self.on.retain(|on| on.cause != one.cause);
        self.on.push(one);
        self.on.sort_by_key(|on| (!on.cause.first, CAUSES.iter().position(|cause| *cause == on.cause)));
    }

    /// These and others together; where both have one, these.
    pub(in crate::study) fn beside(&self, others: &Mechanisms) -> Mechanisms {
        let mut both = others.clone();
        self.on.iter().for_each(|on| both.add(*on));
        both
    }

    /// Reads `[mechanism]`.
    pub(in crate::study) fn read(t: &mut Reader<'_>) -> Option<Mechanisms> {
        let mut read = Some(Mechanisms::default());
        for cause in CAUSES {
            if t.has(cause.name) {
                // All keys are read before any is missed.
                let values = t.table(cause.name).map(|mut t| {
                    cause.section.all().map(|key| t.real(key.name)).collect::<Vec<Option<f64>>>()
                });
                let values = values.and_then(|values| values.into_iter().collect::<Option<Vec<f64>>>());
                read = read.zip(values).map(|(read, values)| read.with(cause.name, &values));
            }
        }
        read
    }

    /// Whether the cause of that name is on.
    pub fn has(&self, name: &str) -> bool {
        self.on.iter().any(|on| on.cause.name == name)
    }

    /// The value of a key of a cause, in the key's unit; `None` where the cause is not on.
    pub fn value(&self, name: &str, key: &str) -> Option<f64> {
        let on = self.on.iter().find(|on| on.cause.name == name)?;
        Some(on.values[on.cause.place_of(key)?])
    }

    /// Puts a value in the place of that of a key, in the key's unit; `None` where the cause is not on.
    pub(in crate::study) fn put(&mut self, name: &str, key: &str, value: f64) -> Option<()> {
        let on = self.on.iter_mut().find(|on| on.cause.name == name)?;
        on.values[on.cause.place_of(key)?] = value;
        Some(())
    }

    /// Whether one of them draws random numbers, so that walls of fixed stones and joints differ from member to member.
    pub fn draws(&self) -> bool {
        self.on.iter().any(|on| on.cause.draws)
    }

    /// What they demand of a solver, each with the words in which a study states it.
    pub(in crate::study) fn demands(&self) -> impl Iterator<Item = (Demand, &'static str)> {
        self.on.iter().filter_map(|on| (on.cause.demand)(on.values))
    }

    /// Whether one of them keeps walls from being plates in that way.
    pub fn on_plate(&self, way: OnPlate) -> bool {
        self.on.iter().any(|on| (on.cause.plate)(on.values) == way)
    }

    /// Why these cannot act on an arm under a load; `None` where they can.
    pub(in crate::study) fn idle_in(&self, arm: &Arm, protocol: &Protocol) -> Option<&'static str> {
        self.on.iter().find_map(|on| (on.cause.idle)(on.values, arm, protocol))
    }

    /// Why an arm that states them is refused, by the name of the cause.
    pub(in crate::study) fn clashes(&self, beside: &Beside<'_>) -> Vec<(&'static str, Clash)> {
        let clashes = |on: &On| (on.cause.clashes)(on.values, beside).into_iter().map(|c| (on.cause.name, c));
        self.on.iter().flat_map(clashes).collect()
    }

    /// The layout that walls are drawn from.
    pub fn layout(&self, mut layout: Layout) -> Layout {
        self.on.iter().for_each(|on| (on.cause.layout)(on.values, &mut layout));
        layout
    }

    /// What holds the walls.
    pub fn restraint(&self, mut restraint: Restraint) -> Restraint {
        self.on.iter().for_each(|on| (on.cause.restraint)(on.values, &mut restraint));
        restraint
    }

    /// A wall as it stands before it is loaded.
    pub fn built(&self, wall: Wall, protocol: &Protocol) -> Wall {
        self.on.iter().fold(wall, |wall, on| (on.cause.built)(on.values, wall, protocol))
    }

    /// How the joints of a wall are found and divided.
    pub fn contacts(&self, sub_contacts: [u32; 2]) -> Contacts {
        let mut contacts = Contacts::from(sub_contacts);
        self.on.iter().for_each(|on| (on.cause.contacts)(on.values, &mut contacts));
        contacts
    }

    /// The law of a joint, from that of the base model.
    pub(in crate::study) fn law(&self, mut law: Coulomb, site: &JointSite<'_>) -> Coulomb {
        self.on.iter().for_each(|on| (on.cause.law)(on.values, &mut law, site));
        law
    }

    /// What changes a wall on its way.
    pub fn changes(&self, wall: &Wall, streams: &Streams) -> Changes {
        let mut changes = Changes::default();
        self.on.iter().for_each(|on| (on.cause.changes)(on.values, &mut changes, wall, streams));
        changes
    }

    /// How a wall meets the motion of its base at that place in its sequence, from 0.
    pub fn meeting(&self, nth: u32) -> Meeting {
        let mut meeting = Meeting::STATED;
        self.on.iter().for_each(|on| (on.cause.shaking)(on.values, nth, &mut meeting));
        meeting
    }

    /// What a gauge shows of a displacement (m) since its zero reading.
    pub fn reading(&self, displacement: f64) -> f64 {
        self.on.iter().fold(displacement, |shown, on| (on.cause.reading)(on.values, shown))
    }
}

impl Cause {
    /// The place of a key among its values.
    fn place_of(&self, key: &str) -> Option<usize> {
        self.section.all().position(|known| known.name == key)
    }

    /// What an arm must have that it acts on, where some arm has it on and none of these has that.
    pub(in crate::study) fn missing(&self, arms: &[Arm], protocol: &Protocol) -> Option<&'static str> {
        let (is_met, what) = self.needs?;
        let with: Vec<&Arm> = arms.iter().filter(|arm| arm.mechanisms.has(self.name)).collect();
        (!with.is_empty() && !with.iter().any(|arm| is_met(arm, protocol))).then_some(what)
    }
}
