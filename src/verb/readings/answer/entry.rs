//! What a reading gives: every statement with its verdict.

use crate::ensemble::Row;
use crate::study::Study;
use crate::verb::run::answer::gathered::populations;
use crate::verb::run::answer::published::{Published, Verdict, judge_all};

/// The readings of a study and what each of them explains.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ReadingsSummary {
    /// Name of the study.
    pub study: String,
    /// Seed of all random streams.
    pub seed: u64,
    /// Hash of the base.
    pub study_hash: String,
    /// Most variants that were read together.
    pub departures: u64,
    /// So many walls of each arm decided, at the lowest and the highest kn, whether a reading was evaluated in full.
    pub first_walls: u64,
    /// The statements, in the order of published.toml.
    pub statements: Vec<String>,
    /// The readings: those that reproduce most statements first; of these the ones with the fewest variants; of these the ones
    /// that refute the fewest.
    pub readings: Vec<ReadingEntry>,
}

/// On how many walls the verdicts on a reading rest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Extent {
    /// On all walls of the study.
    Full,
    /// On the first walls at the lowest and the highest kn, which refute too much.
    FirstWalls,
    /// On none: the variants do not go together.
    Refused,
}

impl Extent {
    /// As it is written in files.
    pub fn name(self) -> &'static str {
        match self {
            Extent::Full => "full",
            Extent::FirstWalls => "first_walls",
            Extent::Refused => "refused",
        }
    }
}

/// One reading.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct ReadingEntry {
    /// The variants that are read together; none of the base.
    pub variants: Vec<String>,
    /// On how many walls the verdicts rest.
    pub extent: Extent,
    /// Statements that are reproduced; null unless all walls were evaluated.
    pub reproduced: Option<usize>,
    /// Statements that are not.
    pub refuted: usize,
    /// Every statement beside the reading's numbers; empty of a reading that was refused.
    pub statements: Vec<Published>,
    /// Why the reading was refused.
    pub why: Option<String>,
}

impl ReadingEntry {
    /// A reading judged by the walls that have been evaluated.
    pub fn judged(variants: &[String], extent: Extent, study: &Study, rows: &[Row]) -> Self {
        ReadingEntry::of(variants, extent, judge_all(&study.published, &populations(study, rows)))
    }

    fn of(variants: &[String], extent: Extent, statements: Vec<Published>) -> Self {
        let with = |verdict| statements.iter().filter(|one| one.verdict == verdict).count();
        ReadingEntry {
            variants: variants.to_vec(),
            extent,
            reproduced: (extent == Extent::Full).then_some(with(Verdict::Reproduced)),
            refuted: with(Verdict::NotReproduced),
            statements,
            why: None,
        }
    }

    /// A reading whose variants do not go together.
    pub fn refused(variants: &[String], why: &str) -> Self {
        let why = Some(why.to_string());
        ReadingEntry { why, ..ReadingEntry::of(variants, Extent::Refused, Vec::new()) }
    }

    /// The variants as they are given to `--variant`.
    pub fn name(&self) -> String {
        if self.variants.is_empty() { "main reading".to_string() } else { self.variants.join("+") }
    }
}

impl ReadingsSummary {
    /// From the readings of a study, in any order.
    pub fn of(base: &Study, departures: u64, first_walls: u64, mut readings: Vec<ReadingEntry>) -> Self {
        readings.sort_by_key(|one| {
            let missing = base.published.len() - one.reproduced.unwrap_or(0);
            (
                one.extent == Extent::Refused,
                one.reproduced.is_none(),
                missing,
                one.variants.len(),
                one.refuted,
            )
        });
        ReadingsSummary {
            study: base.name.clone(),
            seed: base.seed,
            study_hash: base.hash.clone(),
            departures,
            first_walls,
            statements: base.published.iter().map(|claim| claim.claim.clone()).collect(),
            readings,
        }
    }

    /// The readings that were evaluated in full, the best ones first.
    pub fn in_full(&self) -> impl Iterator<Item = &ReadingEntry> {
        self.readings.iter().filter(|one| one.extent == Extent::Full)
    }

    /// The readings that reproduce all statements or all but one.
    pub fn explaining(&self) -> impl Iterator<Item = &ReadingEntry> {
        self.in_full().filter(|one| one.reproduced.is_some_and(|n| n + 1 >= self.statements.len()))
    }
}
