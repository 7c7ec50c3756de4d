//! How much better the extended model predicts readings that it has not seen. In every fold the cause is chosen anew, from what is
//! known there alone, and both models are fitted with the same effort. Where a fold's readings do not name one cause, the extended
//! model is a mixture of those that they leave open, each by its probability. A plain interval over specimens claims a gain too often,
//! because the choice of the cause is made on the same few specimens: intervals are widened until campaigns without any effect
//! claim one in no more than one case in twenty.

mod between;
mod fold;
mod gained;
#[cfg(test)]
mod tests;

use std::collections::{BTreeMap, BTreeSet};

use rayon::prelude::*;

use crate::critic::causes::{Ranked, evidence};
use crate::critic::discrepancy::{Predicted, SmoothDiscrepancy};
use crate::critic::simulate::{Campaign, Causes, Design, Truth};
use crate::critic::verdict::{Effort, Judge, Limits, MOST_AMBIGUOUS};
use crate::random::Streams;

pub use between::{Between, between};
use fold::Fold;
pub use fold::HeldOut;
pub use gained::{Gained, Interval, Scores};
use gained::{Row, estimates, gained};

/// Causes are taken into a mixture, the likeliest first, until those left out have together no more than this probability; more
/// than a verdict would call ambiguous are not taken.
const LEFT_OUT: f64 = 0.1;

/// What was chosen in a fold.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice {
    /// What was held out.
    pub held_out: HeldOut,
    /// The causes that the extended model has in this fold, each with its scope and its share of it, of sum 1, the largest first;
    /// none where nothing was found.
    pub causes: Vec<(Causes, f64)>,
}

/// The gain on readings that were held out.
#[derive(Clone, Debug, PartialEq)]
pub struct Gain {
    /// Every specimen left out in turn; `None` for fewer than two specimens.
    pub specimens: Option<Gained>,
    /// The largest tilts or drifts of all specimens left out, or each fifth of the motions of the base in turn; `None` where nothing is left
    /// then.
    pub tilts: Option<Gained>,
    /// All families left out but one (its arm, with those that are alike); empty where there is only one.
    pub families: Vec<(usize, Gained)>,
    /// What was chosen, fold by fold.
    pub choices: Vec<Choice>,
    /// Campaigns without any effect that the intervals rest on.
    pub nulls: u64,
}

/// The causes of a fold's extended model: one that would be named, or those that are left open.
fn mixed(ranked: &Ranked, named: f64) -> Vec<(usize, f64)> {
    let causes: Vec<(usize, f64)> =
        ranked.causes.iter().filter_map(|(cause, p)| Some(((*cause)?, *p))).collect();
    let whole = |of: &[(usize, f64)]| of.iter().fold(0.0, |sum, (_, p)| sum + p);
    let enough = |count: &usize| whole(&causes[*count..]) <= LEFT_OUT * whole(&causes);
    let count = match ranked.named(named) {
        Some(_) => 1,
        None => (0..MOST_AMBIGUOUS).find(enough).unwrap_or(MOST_AMBIGUOUS),
    };
    let taken = &causes[..count];
    taken.iter().map(|(cause, p)| (*cause, p / whole(taken))).collect()
}

/// As many draws as of a part alone, of each part its share, spread evenly over it.
fn mixture(parts: Vec<(Vec<Truth>, f64)>) -> Vec<Truth> {
    let each = |(draws, share): (Vec<Truth>, f64)| {
        let count = (share * draws.len() as f64).round() as usize;
        (0..count).map(move |k| draws[k * draws.len() / count].clone())
    };
    parts.into_iter().flat_map(each).collect()
}

/// How a gain is measured.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measuring {
    /// What the judge of each fold learns from.
    pub effort: Effort,
    /// The limits of a verdict: a cause is chosen where something is found.
    pub limits: Limits,
    /// Campaigns without any effect that the intervals are widened by.
    pub nulls: u64,
}

impl Default for Measuring {
    fn default() -> Self {
        // Folds take several judges: each learns from half as many campaigns as that of the verdict.
        let effort = Effort { training: Effort::default().training / 2, ..Effort::default() };
        Measuring { effort, limits: Limits::default(), nulls: 60 }
    }
}

/// Who measures the gain on campaigns of a design: the folds, with a judge for all whose known parts are read the same.
pub struct Folds<'j, 'w> {
    judge: &'j Judge<'w>,
    measuring: Measuring,
    folds: Vec<(Fold, usize)>,
    judges: Vec<Judge<'w>>,
    seed: u64,
}

impl<'j, 'w> Folds<'j, 'w> {
    /// The folds of the design of a judge.
    pub fn new(judge: &'j Judge<'w>, measuring: Measuring, seed: u64) -> Folds<'j, 'w> {
        let (mut folds, mut judges): (Vec<(Fold, usize)>, Vec<Judge<'w>>) = (Vec::new(), Vec::new());
        for fold in Fold::all(&judge.design, |family| judge.world.stands_for(family)) {
            let part = fold.design(&judge.design);
            let known = judges.iter().position(|judge| same_readings(&judge.design, &part));
            let index = known.or_else(|| {
                judges.push(Judge::trained(judge.world, &part, measuring.effort, seed)?);
                Some(judges.len() - 1)
            });
            folds.extend(index.map(|index| (fold, index)));
        }
        Folds { judge, measuring, folds, judges, seed }
    }

    /// What is chosen in each fold.
    fn choices(&self, campaign: &Campaign) -> Vec<Vec<(Causes, f64)>> {
        let choice = |(fold, judge): &(Fold, usize)| {
            let (judge, known) = (&self.judges[*judge], fold.campaign(campaign));
            let finding = judge.compare(&known);
            if finding.p_value >= self.measuring.limits.found {
                return Vec::new();
            }
            let (ranked, rough) = judge.weighed(&finding.ranked, &known, self.seed);
            let causes = mixed(&ranked, self.measuring.limits.named).into_iter();
            // Each acts where these readings make it likeliest.
            let models = || rough.iter().map(|rough| rough.causes);
            let scoped = |cause: usize| models().find(|causes| causes.each().eq([cause]));
            causes.filter_map(|(cause, share)| Some((scoped(cause)?, share))).collect()
        };
        self.folds.iter().map(choice).collect()
    }

    /// Measures the gain of a campaign's extended model; a pure function of this and the campaign. `None` where nothing can be held
    /// out.
    pub fn gain(&self, campaign: &Campaign) -> Option<Gain> {
        if self.folds.is_empty() {
            return None;
        }
        let choices = self.choices(campaign);
        let rows = self.rows(campaign, &choices, self.seed, true);
        let nulls = match choices.iter().all(Vec::is_empty) {
            // Both models are the same: there is nothing to claim.
            true => Vec::new(),
            false => self.nulls(campaign),
        };
        let of = |kind: Kind| {
            let nulls: Vec<[[f64; 2]; 3]> = nulls
                .iter()
                .map(|null| null.get(&kind).map_or([[0.0; 2]; 3], |rows| estimates(rows)))
                .collect();
            gained(rows.get(&kind)?, &nulls)
        };
        let families = rows.keys().filter_map(|kind| match kind {
            Kind::Family(family) => Some((*family, of(*kind)?)),
            Kind::Specimens | Kind::Tilts => None,
        });
        let families = families.collect();
        let held_out = self.folds.iter().map(|(fold, _)| fold.held_out);
        let choices = held_out.zip(choices).map(|(held_out, causes)| Choice { held_out, causes }).collect();
        Some(Gain {
            specimens: of(Kind::Specimens),
            tilts: of(Kind::Tilts),
            families,
            choices,
            nulls: nulls.len() as u64,
        })
    }

    /// How campaigns are predicted that the base model, fitted to this one, would show.
    fn nulls(&self, campaign: &Campaign) -> Vec<BTreeMap<Kind, Vec<Row>>> {
        let Folds { judge, measuring, seed, .. } = self;
        let fitted = evidence(judge.world, &judge.design, campaign, None, *seed).draws;
        let null = |k: u64| -> BTreeMap<Kind, Vec<Row>> {
            let streams = Streams::new(seed.wrapping_add(1), k);
            let truth = &fitted[streams.of("null").below(fitted.len())];
            let shown = judge.world.campaign(&judge.design, truth, &streams);
            let choices = self.choices(&shown);
            match choices.iter().all(Vec::is_empty) {
                true => BTreeMap::new(),
                false => self.rows(&shown, &choices, seed.wrapping_add(2 + k), false),
            }
        };
        (0..measuring.nulls).into_par_iter().map(null).collect()
    }

    /// How the readings held out are predicted; without ceilings, where anything was chosen: elsewhere both models are the same.
    fn rows(
        &self,
        campaign: &Campaign,
        choices: &[Vec<(Causes, f64)>],
        seed: u64,
        with_ceiling: bool,
    ) -> BTreeMap<Kind, Vec<Row>> {
        let judge = self.judge;
        let units = judge.reference.scale.units();
        let of = |((fold, index), choice): (&(Fold, usize), &Vec<(Causes, f64)>)| -> (Kind, Vec<Row>) {
            let known = &self.judges[*index].design;
            let seen = fold.campaign(campaign);
            let draws = |causes: Causes| evidence(judge.world, known, &seen, causes, seed).draws;
            let walls = |draws: &[Truth]| Predicted::of(judge.world, &judge.design, draws, seed);
            let base = walls(&draws(Causes::default()));
            let parts = choice.iter().map(|(causes, share)| (draws(*causes), *share)).collect::<Vec<_>>();
            let extended = (!parts.is_empty()).then(|| walls(&mixture(parts)));
            let free = with_ceiling
                .then(|| SmoothDiscrepancy::new(&judge.design, campaign, &fold.known, &base, &units))
                .flatten();
            let ceilings = free.map_or_else(Vec::new, |free| free.scores());
            let mut rows = Vec::new();
            for (specimen, own) in judge.design.specimens.iter().enumerate() {
                for (reading, m) in own.readings.iter().enumerate().filter(|(k, _)| !fold.known[specimen][*k])
                {
                    let at = (specimen, reading);
                    let seen = campaign.specimens[specimen][reading];
                    let score = |walls: &Predicted| walls.score(at, m, seen, units[specimen][reading]);
                    let Some(base) = score(&base) else { continue };
                    let extended = extended.as_ref().and_then(score).unwrap_or(base);
                    let ceiling = ceilings.iter().find(|(other, _)| *other == at).map(|(_, score)| *score);
                    rows.push(Row { specimen, family: own.family, base, extended, ceiling });
                }
            }
            (Kind::of(fold.held_out), rows)
        };
        let kind = |fold: &(Fold, usize)| Kind::of(fold.0.held_out);
        let chosen = self.folds.iter().zip(choices).filter(|(_, choice)| !choice.is_empty());
        let chosen: BTreeSet<Kind> = chosen.map(|(fold, _)| kind(fold)).collect();
        let all = self.folds.par_iter().zip(choices);
        let scored = all.filter(|(fold, _)| with_ceiling || chosen.contains(&kind(fold)));
        let all: Vec<(Kind, Vec<Row>)> = scored.map(of).collect();
        let mut by_kind: BTreeMap<Kind, Vec<Row>> = BTreeMap::new();
        all.into_iter().for_each(|(kind, rows)| by_kind.entry(kind).or_default().extend(rows));
        by_kind
    }
}

/// What is summed up together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Specimens,
    Tilts,
    Family(usize),
}

impl Kind {
    fn of(held_out: HeldOut) -> Kind {
        match held_out {
            HeldOut::Specimen(_) => Kind::Specimens,
            HeldOut::LargestTilts | HeldOut::Motions(_) => Kind::Tilts,
            HeldOut::OtherFamilies(family) => Kind::Family(family),
        }
    }
}

/// Whether the same is read in both, whatever the specimens are called.
fn same_readings(one: &Design, other: &Design) -> bool {
    let plain = |design: &Design| {
        let mut design = design.clone();
        for specimen in &mut design.specimens {
            specimen.name.clear();
            for m in &mut specimen.readings {
                m.specimen.clear();
                m.line = 0;
                if !m.kind.is_censored() {
                    m.value = 0.0;
                }
            }
        }
        design.specimens
    };
    plain(one) == plain(other)
}
