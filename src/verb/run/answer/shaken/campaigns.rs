//! The runs of an arm as a campaign of records, stripes and walls.

use crate::ensemble::{Row, ShakenRow};
use crate::stats;
use crate::stats::fragility::{Campaign, Outcome};
use crate::study::{Earthquakes, Measure};

/// The runs of an arm at one stiffness.
pub(crate) struct Runs<'r> {
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
            for run in row.runs() {
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

/// The share of runs that collapsed, an undecided one by half; `None` without a verdict.
pub(crate) fn share<'r>(runs: impl Iterator<Item = &'r ShakenRow>) -> Option<f64> {
    stats::mean(&runs.filter_map(|run| run.collapse.map(Outcome::collapses)).collect::<Vec<f64>>())
}
