//! The rows of a study taken one by one, with no more of each than its summary needs.

use crate::ensemble::{Quantity, Row, is_random};
use crate::study::Study;
use crate::verb::run::answer::population::Population;

/// The populations of a study that are being gathered, arm by arm, kn ascending.
pub struct Populations(Vec<Vec<Population>>);

impl Populations {
    /// Without a wall.
    pub fn new(study: &Study) -> Populations {
        let (quantity, randomisations) = (Quantity::of(study), study.randomisations());
        let of_arm = study.arms.iter().map(|arm| {
            let at = |kn: &f64| {
                let own = (&arm.name[..], !is_random(arm));
                Population::new(own, (*kn, arm.members), quantity, randomisations, &study.published)
            };
            arm.kn_points.iter().map(at).collect()
        });
        Populations(of_arm.collect())
    }

    /// Takes a row; those of one arm at one kn come by growing member.
    pub fn take(&mut self, row: &Row) {
        let own = self.0.get_mut(row.arm_index as usize).and_then(|arm| arm.get_mut(row.point as usize));
        crate::check!(own.is_some(), "the study has no arm {} with a point {}", row.arm_index, row.point);
        own.into_iter().for_each(|own| own.take(row));
    }

    /// All of them, of the study with the number of walls that each arm came to.
    pub fn end(self, study: &Study) -> Vec<Population> {
        let come_to = study.arms.iter().zip(self.0).flat_map(|(arm, own)| {
            own.into_iter().map(|mut own| {
                own.planned = arm.members;
                own
            })
        });
        come_to.collect()
    }
}

/// Every population of a study, arm by arm in the order of the study, kn ascending, from rows in the order of the results.
pub fn populations(study: &Study, rows: &[Row]) -> Vec<Population> {
    let mut populations = Populations::new(study);
    rows.iter().for_each(|row| populations.take(row));
    populations.end(study)
}

/// What the results of a study are made of, gathered row by row in the order of the results (arm, point, member), as
/// [`summarise`](crate::verb::run::answer::summary::summarise) and [`write_all`](crate::verb::run::answer::files::write_all) make them from all rows at once.
///
/// A wall that brings a value takes 8 bytes, and where walls between bring none some 16 more per gap; a wall without a value takes
/// none. Only where something was measured, or walls are sheared or shaken, rows are kept whole, with their load steps (0.5 kB each): the
/// measured readings, the curves of push over drift and the runs under records are compared step by step.
pub struct Gathered {
    populations: Populations,
    keeps_rows: bool,
    rows: Vec<Row>,
}

impl Gathered {
    /// Without a wall, of a study.
    pub fn new(study: &Study) -> Gathered {
        let keeps_rows = !study.measured.is_empty()
            || study.earthquakes.is_some()
            || Quantity::of(study) == Quantity::ShearCapacity;
        Gathered { populations: Populations::new(study), keeps_rows, rows: Vec::new() }
    }

    /// Takes the next row.
    pub fn take(&mut self, row: &Row) {
        self.populations.take(row);
        if self.keeps_rows {
            self.rows.push(row.clone());
        }
    }

    /// The populations, and the rows that were kept.
    pub(crate) fn end(self, study: &Study) -> (Vec<Population>, Vec<Row>) {
        (self.populations.end(study), self.rows)
    }
}
