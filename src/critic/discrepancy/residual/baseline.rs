//! All readings and groups of a design as the base model shows them, for any campaign of that design.

use std::collections::BTreeMap;

use crate::critic::compare::order_of_tilt;
use crate::critic::discrepancy::residual::group::{Group, GroupBase};
use crate::critic::discrepancy::residual::nested::Nested;
use crate::critic::discrepancy::residual::reading::Residual;
use crate::critic::simulate::{Campaign, Design, Seen, World};
use crate::study::{MeasuredQuantity, Measurement};

/// Readings with their places in the design.
type Places<'d> = Vec<(usize, &'d Measurement)>;

/// What readings and groups are set against.
pub struct Baseline {
    readings: Vec<Residual>,
    groups: Vec<GroupBase>,
}

/// How far a campaign lies from the base model.
#[derive(Clone, Debug, PartialEq)]
pub struct Residuals {
    /// Reading by reading, in the order of [`Design::readings`].
    pub readings: Vec<Residual>,
    /// By family, quantity and tilt, in this order.
    pub groups: Vec<Group>,
}

impl Baseline {
    /// From campaigns of the base model; a pure function of its arguments.
    pub fn new(world: &World<'_>, design: &Design, seed: u64) -> Baseline {
        let nested = Nested::new(world, design, seed);
        let mut grouped: BTreeMap<(usize, MeasuredQuantity, u64), Places<'_>> = BTreeMap::new();
        for (place, (family, m)) in design.readings().enumerate() {
            grouped.entry((family, m.quantity, order_of_tilt(m))).or_default().push((place, m));
        }
        let readings = design.readings().enumerate();
        let readings = readings.map(|(place, (family, m))| Residual::new((family, m), place, &nested, world));
        let groups =
            grouped.iter().filter_map(|((family, ..), members)| GroupBase::new(*family, members, &nested));
        Baseline { readings: readings.collect(), groups: groups.collect() }
    }

    /// How far a campaign of the same design lies from it.
    pub fn residuals(&self, campaign: &Campaign) -> Residuals {
        let seen: Vec<Seen> = campaign.seen().collect();
        Residuals {
            readings: self.readings.iter().zip(&seen).map(|(reading, seen)| reading.with(*seen)).collect(),
            groups: self.groups.iter().map(|group| group.with(&seen)).collect(),
        }
    }
}
