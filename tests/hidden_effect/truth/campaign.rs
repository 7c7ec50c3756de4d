//! A campaign: its walls, solved once, and what each design sees of them.

use pirca::math::radians;
use pirca::random::Streams;
use pirca::study::{Nuisance, Study};

use super::designs::{Design, FAMILIES, PER_FAMILY, order};
use super::effect::{Effect, Specimen};
use super::label::Label;
use super::readings::{Entry, Series};
use super::walls::{Way, alike, refined, solved};

/// A wall that does not stand, or does not end in a collapse that the solver found, is built of other stones, so many times.
const REBUILT: u64 = 3;
/// A wall that falls within the protractor's first step (deg) does not stand: a tilt of 0 is no tilt.
const STANDS_DEG: f64 = 0.5;

/// The campaign of a label, by design; `None` where one of its walls cannot be made to fall.
pub fn campaign(
    study: &Study,
    nuisances: &[Nuisance; 3],
    label: &Label,
) -> Option<Vec<(Design, Vec<Entry>)>> {
    let effects = label.effects();
    let base = refined(jointed(study, nuisances, label));
    let acted = effects.iter().fold(base, |study, effect| effect.study(study));
    let mut series = Vec::new();
    for arm in 0..FAMILIES.len() {
        let first = (arm * PER_FAMILY) as u64;
        let ways: Vec<Way> = match alike(&acted, arm as u32, &effects) {
            true => vec![solved(&acted, arm as u32, first, &effects)?; PER_FAMILY],
            false => (first..first + PER_FAMILY as u64)
                .map(|member| fallen(&acted, arm as u32, member, &effects))
                .collect::<Option<_>>()?,
        };
        let gauge = |displacement: f64| acted.arms[arm].mechanisms.reading(displacement);
        for (number, way) in ways.iter().enumerate() {
            let index = arm * PER_FAMILY + number;
            let streams = Streams::new(label.seed, index as u64);
            let specimen = Specimen { number: index as u64, order: order(index), streams };
            series.push(Series::of(way, gauge, &effects, &specimen));
        }
    }
    let streams = Streams::new(label.seed, 0);
    let rows = |design: Design| (design, design.rows(Some(&series), &effects, &streams));
    Some(Design::ALL.map(rows).to_vec())
}

/// Every row that a design may have.
pub fn planned(design: Design) -> Vec<Entry> {
    design.rows(None, &[], &Streams::new(0, 0))
}

/// The study with a campaign's seed and joints: those of stones are the same with and without ropes.
fn jointed(study: &Study, nuisances: &[Nuisance; 3], label: &Label) -> Study {
    let mut study = study.clone().with_seed(label.seed);
    study.arms.truncate(FAMILIES.len());
    for (arm, kind) in study.arms.iter_mut().zip([0, 1, 1]) {
        let factors = [0, 1, 2].map(|k| nuisances[k].prior.at_score(label.joints[kind][k]));
        *arm = arm.with_joints(arm.kn_points[arm.middle_point()], factors);
    }
    study
}

/// A wall that falls.
fn fallen(study: &Study, arm: u32, member: u64, effects: &[Box<dyn Effect>]) -> Option<Way> {
    let again = (FAMILIES.len() * PER_FAMILY) as u64;
    let stands = |way: &Way| way.collapse >= radians(STANDS_DEG);
    let tried = |attempt| solved(study, arm, member + again * attempt, effects).filter(stands);
    (0..=REBUILT).find_map(tried)
}
