//! The runs of an arm as a campaign of records, stripes and walls.

use crate::ensemble::{Row, ShakenRow};
use crate::stats::fragility::{Campaign, Outcome};
use crate::study::{Earthquakes, Measure};

/// The runs of an arm at one stiffness.
pub(super) struct Runs<'r> {
    rows: Vec<&'r Row>,
    earthquakes: &'r Earthquakes,
}

impl<'r> Runs<'r> {
    /// Of those rows that are of this arm and point.
    pub fn of(rows: &'r [Row], earthquakes: &'r Earthquakes, arm: usize, point: usize) -> Runs<'r> {
        let own = |row: &&Row| (row.arm_index as usize, row.point as usize) == (arm, point);
        Runs { rows: rows.iter().filter(own).collect(), earthquakes }
    }

    /// Number of walls.
    pub fn walls(&self) -> usize {
        self.rows.len()
    }

    /// The walls.
    pub fn rows(&self) -> &[&'r Row] {
        &self.rows
    }

    /// What became of every wall under every record at every intensity, in the study's measure; `None` without a wall.
    pub fn campaign(&self) -> Option<Campaign> {
        let Earthquakes { intensities, records, .. } = self.earthquakes;
        if self.rows.is_empty() {
            return None;
        }
        let cells = records.len() * intensities.len();
        let mut outcomes: Vec<Option<Outcome>> = vec![None; cells * self.rows.len()];
        for (wall, row) in self.rows.iter().enumerate() {
            for run in runs(row) {
                let cell = run.record as usize * intensities.len() + run.stripe as usize;
                outcomes[cell * self.rows.len() + wall] = run.collapse;
            }
        }
        Some(Campaign::of_stripes(intensities, records.len(), self.rows.len(), outcomes))
    }

    /// The study's measure.
    pub fn measure(&self) -> Measure {
        self.earthquakes.measure
    }

    /// The intensity of a run, in the study's measure.
    pub fn intensity(&self, run: &ShakenRow) -> f64 {
        self.earthquakes.intensities[run.stripe as usize]
    }

    /// Intensities in a measure, by record, then stripe.
    pub fn intensities(&self, measure: Measure) -> Vec<f64> {
        let Earthquakes { intensities, records, .. } = self.earthquakes;
        let of = |record: &crate::study::Record| {
            intensities.iter().map(|x| record.peak(measure, *x)).collect::<Vec<f64>>()
        };
        records.iter().flat_map(of).collect()
    }
}

/// The runs of a wall.
pub(super) fn runs(row: &Row) -> impl Iterator<Item = &ShakenRow> {
    row.load_steps.iter().filter_map(|step| step.shaken.as_ref())
}

/// The share of a wall's runs that collapsed, an undecided one by half; `None` without a verdict.
pub(super) fn share<'r>(all: impl Iterator<Item = &'r ShakenRow>) -> Option<f64> {
    let (mut trials, mut collapsed) = (0.0, 0.0);
    for run in all {
        match run.collapse {
            Some(Outcome::Collapsed) => collapsed += 1.0,
            Some(Outcome::Undecided) => collapsed += 0.5,
            Some(Outcome::Stands) => {}
            None => continue,
        }
        trials += 1.0;
    }
    (trials > 0.0).then(|| collapsed / trials)
}
