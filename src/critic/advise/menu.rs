//! The menu of measurements that could be made next: what each reads, and what it costs.

use crate::critic::compare::reading_variance;
use crate::critic::simulate::{Design, Specimen, Test};
use crate::critic::verdict::Judge;
use crate::math::radians;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

/// Random error of a displacement read with a dial gauge (m), unless the campaign was read better.
pub(super) const FINE: f64 = 0.3e-3;
/// Random error of a weight, as a share of it.
const WEIGHED: f64 = 5e-3;

/// A measurement that could be made. What is read finely has an error of [`Offered::fine`](crate::critic::Offered::fine).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Offer {
    /// kn (10 %) and friction angle (1 deg) of two stones' joints, of every family.
    TwoStones,
    /// The weight of a specimen of every family, to 0.5 %.
    Weights,
    /// What the gauge shows of a target that does not move, read finely.
    FixedTarget,
    /// What is left at three points, read finely, when the platform goes back from the largest tilt of the campaign's readings, on
    /// as many specimens of every family as there were.
    Remainders,
    /// The readings of the campaign but its collapse angles, on walls that are turned round.
    TurnedWalls,
    /// Six readings up to 3 deg at three points, read finely, on as many specimens of every family as there were.
    LowTilts,
    /// The tilts of the campaign once more at three points, read finely.
    FinerReadings,
    /// What the campaign reads of displacements at every degree up to the largest tilt, with its errors.
    MoreTilts,
    /// As many specimens again, read as these were.
    MoreSpecimens,
}

/// What hours are counted by.
#[derive(Clone, Copy)]
pub(super) enum Per {
    Campaign,
    Family,
    Specimen,
}

/// All offers with what they cost, in hours of two people (our estimate).
pub(super) const MENU: [(Offer, f64, Per); 9] = [
    (Offer::FixedTarget, 0.5, Per::Campaign),
    (Offer::Weights, 0.33, Per::Family),
    (Offer::TwoStones, 0.67, Per::Family),
    (Offer::Remainders, 0.55, Per::Specimen),
    (Offer::LowTilts, 0.65, Per::Specimen),
    (Offer::TurnedWalls, 1.0, Per::Specimen),
    (Offer::FinerReadings, 0.9, Per::Specimen),
    (Offer::MoreTilts, 0.8, Per::Specimen),
    (Offer::MoreSpecimens, 4.5, Per::Specimen),
];

/// The standard deviation of the best displacement of a campaign, rounding included (m).
pub(super) fn finest(design: &Design) -> Option<f64> {
    let readings = design.specimens.iter().flat_map(|specimen| &specimen.readings);
    let errors = readings.filter(|m| m.tilt.is_some()).map(|m| reading_variance(m).sqrt());
    errors.filter(|error| *error > 0.0).reduce(f64::min)
}

/// Whether a measurement is made of walls that are sheared: what is read of displacements is read on a tilting table.
fn is_in_shear(offer: Offer) -> bool {
    matches!(offer, Offer::TwoStones | Offer::Weights | Offer::MoreSpecimens)
}

/// The readings of an offer, displacements with such an error where they are read finely; `None` where it adds nothing to a design.
pub(super) fn planned(offer: Offer, judge: &Judge<'_>, fine: f64) -> Option<Design> {
    use MeasuredQuantity as Q;
    let design = &judge.design;
    let is_possible = match judge.world.test() {
        Test::Tilting => true,
        Test::Shear { .. } => is_in_shear(offer),
        Test::Shaking => offer == Offer::MoreSpecimens,
    };
    if !is_possible {
        return None;
    }
    let mut new = Design { specimens: Vec::new(), apart: Vec::new(), unused: Vec::new() };
    let pattern = design.specimens.iter().flat_map(|specimen| &specimen.readings).next()?;
    let reading = |quantity, tilt: Option<f64>, error: f64| Measurement {
        quantity,
        tilt,
        error,
        kind: MeasuredKind::Exact,
        common_error: 0.0,
        unknown_share: false,
        resolution: 0.0,
        ..pattern.clone()
    };
    let middle = judge.world.truth(None, &vec![0.0; judge.world.inputs(None)]);
    let points = [Q::DisplacementLeft, Q::DisplacementCentre, Q::DisplacementRight];
    let finely = |points: [Q; 3], tilts: &[f64]| -> Vec<Measurement> {
        tilts.iter().flat_map(|tilt| points.map(|point| reading(point, Some(*tilt), fine))).collect()
    };
    let largest = |own: &Specimen| own.tilts().last().copied().filter(|tilt| *tilt > 0.0);
    let again = |readings: &dyn Fn(&Specimen) -> Vec<Measurement>| -> Vec<Specimen> {
        let specimens = design.specimens.iter();
        specimens.map(|own| Specimen { readings: readings(own), ..own.clone() }).collect()
    };
    match offer {
        Offer::Weights => {
            for family in design.families() {
                let mut weight = reading(Q::SpecimenWeight, None, 0.0);
                weight.error = WEIGHED * judge.world.apart(family, &weight, &middle);
                new.apart.push((family, weight));
            }
        }
        Offer::FixedTarget => {
            let family = design.specimens.first()?.family;
            new.apart.push((family, reading(Q::FixedTarget, None, fine)));
        }
        Offer::TwoStones => {
            for family in design.families() {
                let mut kn = reading(Q::JointKn, None, 0.0);
                kn.error = 0.1 * judge.world.apart(family, &kn, &middle);
                new.apart.push((family, kn));
                new.apart.push((family, reading(Q::JointPhi, None, radians(1.0))));
            }
        }
        Offer::Remainders => {
            let left = [Q::RemainderLeft, Q::RemainderCentre, Q::RemainderRight];
            new.specimens = again(&|own| finely(left, largest(own).as_slice()));
        }
        Offer::TurnedWalls => {
            new.specimens = again(&|own| own.readings.iter().filter(|m| m.tilt.is_some()).cloned().collect());
            new.specimens.retain(|own| judge.world.can_turn(own.family));
            new.specimens.iter_mut().for_each(|own| own.turned = true);
        }
        Offer::LowTilts => {
            let tilts = [0.5, 1.0, 1.5, 2.0, 2.5, 3.0].map(radians);
            new.specimens = again(&|_| finely(points, &tilts));
        }
        Offer::FinerReadings => {
            let is_fine = |own: &Specimen, m: &Measurement| {
                let read = |other: &Measurement| (other.quantity, other.tilt) == (m.quantity, m.tilt);
                own.readings.iter().any(|other| read(other) && reading_variance(other) <= fine * fine)
            };
            new.specimens = again(&|own| {
                let all = finely(points, &own.tilts());
                if all.iter().all(|m| is_fine(own, m)) { Vec::new() } else { all }
            });
        }
        Offer::MoreTilts => {
            new.specimens = again(&|own| {
                let largest = largest(own).unwrap_or(0.0);
                let mut patterns: Vec<&Measurement> = Vec::new();
                for m in own.readings.iter().filter(|m| m.tilt.is_some() && !m.quantity.is_remainder()) {
                    if patterns.iter().all(|known| known.quantity != m.quantity) {
                        patterns.push(m);
                    }
                }
                let degrees = (1..90).map(|deg| radians(f64::from(deg)));
                let tilts = degrees.take_while(|tilt| *tilt <= largest + 1e-9);
                let at = |tilt: f64| {
                    patterns.iter().map(move |m| Measurement { tilt: Some(tilt), ..(*m).clone() })
                };
                tilts.flat_map(at).collect()
            });
        }
        Offer::MoreSpecimens => new.specimens.clone_from(&design.specimens),
    }
    new.specimens.retain(|specimen| !specimen.readings.is_empty());
    (!new.specimens.is_empty() || !new.apart.is_empty()).then_some(new)
}
