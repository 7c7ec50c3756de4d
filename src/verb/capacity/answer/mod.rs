//! What an engineer may count on: the probability that a wall of a kind fails below a level, a low fractile, characteristic and
//! design values; the numbers, and how they are told.

mod document;
mod figure;
mod group;
mod known;
mod text;
mod values;

use serde::Serialize;

pub use document::capacity_document;
pub use figure::Rung;
pub use group::{CapacityGroup, Failed, Repeats, Screen, Target};
pub use text::capacity_warnings;
pub use values::{Supported, SupportedValue};

use crate::ensemble::{Quantity, Row};
use crate::math::degrees;
use crate::stats::{DESIGN_PROBABILITY, Variation};
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement, Study};
use crate::verb::question::Question;
use crate::verb::run::answer::gathered::populations;
use crate::verb::run::answer::population::Population;
use crate::verb::run::answer::undecided::LeftOpenAnswer;

/// The answer to a question, group by group.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CapacitySummary {
    /// Name of the study.
    pub study: String,
    /// Its variant.
    pub variant: Option<String>,
    /// What was asked.
    pub question: Question,
    /// What is described, and its unit.
    pub quantity: &'static str,
    /// See `quantity`.
    pub unit: &'static str,
    /// Probability at which design values are given.
    pub design_probability: f64,
    /// Coefficient of variation that was stated as known.
    pub known_cov: Option<f64>,
    /// One entry per arm and kn of a simulated study, per family of a measured one.
    pub groups: Vec<CapacityGroup>,
    /// How the quantity is shown.
    #[serde(skip)]
    pub shown: Quantity,
}

impl CapacitySummary {
    /// From the rows of a study.
    pub fn simulated(study: &Study, rows: &[Row], question: Question, known: Variation) -> CapacitySummary {
        let groups = populations(study, rows);
        let until = |own: &Population| study.arms.iter().find(|arm| arm.name == own.arm)?.until;
        let place = |own: &Population| study.arms.iter().position(|arm| arm.name == own.arm);
        let of = |own: &Population| CapacityGroup {
            place: place(own).unwrap_or_default(),
            ..CapacityGroup::simulated(own, question, known, study.solver.name(), until(own))
        };
        let mut all: Vec<CapacityGroup> = groups.iter().map(of).collect();
        if groups.iter().any(|own| own.left_open().is_some()) {
            let stiff: Vec<Row> = rows.iter().map(Row::with_stiff_joints).collect();
            let stiff = populations(study, &stiff);
            for ((group, own), stiff) in all.iter_mut().zip(&groups).zip(&stiff) {
                let CapacityGroup { answer, interval, .. } = of(stiff);
                let open = own.left_open();
                group.left_open = open.map(|open| LeftOpenAnswer { walls: open.walls, answer, interval });
            }
        }
        CapacitySummary::new(study, Quantity::of(study), question, known, all)
    }

    /// From the collapse angles of a study's specimens alone; families without any are left out.
    pub fn measured(study: &Study, question: Question, known: Variation) -> CapacitySummary {
        let mut families: Vec<&str> = Vec::new();
        let angles = || study.measured.iter().filter(|m| m.quantity == MeasuredQuantity::CollapseAngle);
        for m in angles() {
            if !families.contains(&&m.family[..]) {
                families.push(&m.family);
            }
        }
        let of = |(place, family): (usize, &&str)| {
            let own = || angles().filter(|m| m.family == *family);
            let angle = |m: &Measurement| degrees(m.value);
            let read = own().filter(|m| !m.kind.is_censored()).map(angle).collect();
            let above = own().filter(|m| m.kind == MeasuredKind::Above).map(angle).collect();
            let unread = own().filter(|m| m.kind == MeasuredKind::Below).count() as u64;
            let group = CapacityGroup::measured(family, read, above, unread, question, known);
            CapacityGroup { place, ..group }
        };
        let groups = families.iter().enumerate().map(of).collect();
        CapacitySummary::new(study, Quantity::CollapseAngle, question, known, groups)
    }

    /// The upper end of the interval of the answer, the largest of all groups: the answer itself of walls that are all alike, and 1 where
    /// nothing is known. Walls that brought no value count as failing.
    pub fn at_most(&self) -> f64 {
        let of = |group: &CapacityGroup| match group.random || group.kn_pa_per_m.is_none() {
            true => group.failed.whatever().or(group.interval).map_or(1.0, |[_, high]| high),
            false => group.answer.value().filter(|_| group.failed.walls == 0).unwrap_or(1.0),
        };
        self.groups.iter().map(of).fold(0.0, f64::max)
    }

    /// The groups whose walls can answer.
    pub(crate) fn spread(&self) -> impl Iterator<Item = &CapacityGroup> {
        self.groups.iter().filter(|group| group.is_spread())
    }

    fn new(
        study: &Study,
        quantity: Quantity,
        question: Question,
        known: Variation,
        groups: Vec<CapacityGroup>,
    ) -> CapacitySummary {
        let known_cov = match known {
            Variation::Known(cov) => Some(cov),
            Variation::Unknown => None,
        };
        CapacitySummary {
            study: study.name.clone(),
            variant: study.variant.clone(),
            question,
            quantity: quantity.name(),
            unit: quantity.unit(),
            design_probability: DESIGN_PROBABILITY,
            known_cov,
            groups,
            shown: quantity,
        }
    }
}
