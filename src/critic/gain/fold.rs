//! What is held out of a campaign: each specimen in turn, the largest tilts of all or some of the motions, and all families but one.

use std::collections::BTreeSet;

use crate::critic::simulate::{Campaign, Design, Specimen, motions};
use crate::study::Measurement;

/// Of a specimen's tilts this share, the largest, is held out.
const LARGEST: f64 = 1.0 / 3.0;
/// Motions are held out in so many parts, each of every so manieth.
const PARTS: usize = 5;

/// What is held out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum HeldOut {
    /// All that was read on a specimen (its place in the design).
    Specimen(usize),
    /// The upper third of every specimen's tilts or drifts, at least one of them, and its collapse angle.
    LargestTilts,
    /// A part of the motions of the base (from 0), as every specimen met them: what one did is no reading of the next.
    Motions(usize),
    /// All that was read on other families than this one (its arm), and those that are alike.
    OtherFamilies(usize),
}

/// A campaign in two parts.
#[derive(Clone, Debug, PartialEq)]
pub struct Fold {
    /// What is held out.
    pub held_out: HeldOut,
    /// Whether a reading is known, by specimen and reading.
    pub known: Vec<Vec<bool>>,
}

impl Fold {
    /// All folds that leave something to learn from: specimens, tilts, families. `stands_for` says which family's walls
    /// [stand](crate::critic::World::stands_for) for those of each: of two that are alike none is known without the other.
    pub fn all(design: &Design, stands_for: impl Fn(usize) -> usize) -> Vec<Fold> {
        let specimens = 0..design.specimens.len();
        let mut folds: Vec<Fold> = specimens
            .map(|out| Fold { held_out: HeldOut::Specimen(out), known: whole(design, |index| index != out) })
            .collect();
        let known = design.specimens.iter().map(|specimen| {
            let tilts = specimen.tilts();
            let out = (LARGEST * tilts.len() as f64).ceil() as usize;
            let last = tilts.len().checked_sub(out + 1).map_or(f64::NEG_INFINITY, |last| tilts[last]);
            specimen.readings.iter().map(|m| m.at().is_some_and(|tilt| tilt <= last)).collect()
        });
        folds.push(Fold { held_out: HeldOut::LargestTilts, known: known.collect() });
        let motions = motions(design.readings().map(|(_, m)| m));
        let parts = 0..if motions.len() < PARTS { 0 } else { PARTS };
        folds.extend(parts.map(|part| {
            let is_known = |m: &Measurement| {
                let own = motions.iter().position(|motion| Some(*motion) == m.under.as_ref());
                own.is_none_or(|own| own % PARTS != part)
            };
            let known = |specimen: &Specimen| specimen.readings.iter().map(is_known).collect();
            Fold { held_out: HeldOut::Motions(part), known: design.specimens.iter().map(known).collect() }
        }));
        let families: BTreeSet<usize> = design.families().into_iter().map(&stands_for).collect();
        folds.extend(families.into_iter().map(|family| {
            let known = whole(design, |index| stands_for(design.specimens[index].family) == family);
            Fold { held_out: HeldOut::OtherFamilies(family), known }
        }));
        folds.retain(|fold| {
            let all = || fold.known.iter().flatten();
            all().any(|known| *known) && all().any(|known| !known)
        });
        folds
    }

    /// The design that is known.
    pub fn design(&self, design: &Design) -> Design {
        design_of(design, &self.known)
    }

    /// What is known of a campaign, in the order of [`Self::design`].
    pub fn campaign(&self, campaign: &Campaign) -> Campaign {
        campaign_of(campaign, &self.known)
    }
}

/// All readings of the specimens that are kept.
pub(super) fn whole(design: &Design, keeps: impl Fn(usize) -> bool) -> Vec<Vec<bool>> {
    let specimens = design.specimens.iter().enumerate();
    specimens.map(|(index, specimen)| vec![keeps(index); specimen.readings.len()]).collect()
}

/// The design of the readings that are known; specimens of which nothing is known are not in it.
pub(super) fn design_of(design: &Design, known: &[Vec<bool>]) -> Design {
    let mut part = design.clone();
    for (specimen, known) in part.specimens.iter_mut().zip(known) {
        specimen.readings = kept(&specimen.readings, known);
    }
    part.specimens.retain(|specimen| !specimen.readings.is_empty());
    part
}

/// What is known of a campaign, in the order of [`design_of`].
pub(super) fn campaign_of(campaign: &Campaign, known: &[Vec<bool>]) -> Campaign {
    let specimens = campaign.specimens.iter().zip(known).map(|(seen, known)| kept(seen, known));
    Campaign { specimens: specimens.filter(|seen| !seen.is_empty()).collect(), apart: campaign.apart.clone() }
}

fn kept<T: Clone>(all: &[T], known: &[bool]) -> Vec<T> {
    all.iter().zip(known).filter(|(_, known)| **known).map(|(one, _)| one.clone()).collect()
}
