//! What the walls of a world do between the tilts or drifts that were read: bands over them, for figures.

use crate::critic::causes::evidence;
use crate::critic::discrepancy::Band;
use crate::critic::simulate::{Campaign, Design, Specimen, Test, Truth, World};
use crate::critic::verdict::Diagnosis;
use crate::random::Streams;
use crate::study::{MeasuredQuantity, Measurement};

/// Steps of the tilt or the drift.
const STEPS: usize = 60;
/// Walls of a band, and sets of stones under every truth of the base model.
const WALLS: u64 = 1000;
const SETS: u64 = 2;

/// The walls of a family.
#[derive(Clone, Debug, PartialEq)]
pub struct FamilyCurves {
    /// Index of its arm.
    pub family: usize,
    /// The collapse angle (rad); `None` of walls that are sheared.
    pub collapse: Option<Band>,
    /// What was read of it at some tilt or drift, quantity by quantity.
    pub curves: Vec<Curve>,
}

/// A quantity over the tilt or the drift, without errors of reading.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// What was read.
    pub quantity: MeasuredQuantity,
    /// Tilt (rad) and what the walls show that still stand, from upright to where half of them have fallen; of walls that are sheared
    /// drift and what they bear, up to the widest one.
    pub bands: Vec<(f64, Band)>,
}

/// Bands of the base model, family by family; a pure function of its arguments.
pub fn base_curves(world: &World<'_>, design: &Design, seed: u64) -> Vec<FamilyCurves> {
    let truths: Vec<Truth> = (0..WALLS / SETS).map(|k| world.stated(&Streams::new(seed, k))).collect();
    over_the_tilt(world, design, &truths, seed)
}

/// Bands of the base model at its best fit: with draws of the joints from what the readings leave of their priors, if nothing else is
/// wrong. A pure function of its arguments.
pub fn fitted_curves(
    world: &World<'_>,
    design: &Design,
    measured: &Campaign,
    seed: u64,
) -> Vec<FamilyCurves> {
    let fitted = evidence(world, design, measured, None, seed);
    over_the_tilt(world, design, &fitted.draws, seed)
}

/// Bands of the best cause of a diagnosis, or of its pair, with draws of the parameters and the joints; see [`Diagnosis::best`]. Those of
/// the verdict are there already, from [`cause_curves`] with the same seed.
pub fn best_curves(
    world: &World<'_>,
    design: &Design,
    diagnosis: &Diagnosis,
    of_verdict: &[(Vec<usize>, Vec<FamilyCurves>)],
    seed: u64,
) -> Option<(Vec<usize>, Vec<FamilyCurves>)> {
    let (causes, draws) = diagnosis.best()?;
    let known = of_verdict.iter().find(|(own, _)| *own == causes).cloned();
    Some(known.unwrap_or_else(|| (causes, over_the_tilt(world, design, draws, seed))))
}

/// Bands of every cause that a verdict speaks of, or of a pair together, with draws of the parameters and the joints.
pub fn cause_curves(
    world: &World<'_>,
    design: &Design,
    diagnosis: &Diagnosis,
    seed: u64,
) -> Vec<(Vec<usize>, Vec<FamilyCurves>)> {
    let explained = diagnosis.explained_by().into_iter();
    explained.map(|(causes, draws)| (causes, over_the_tilt(world, design, draws, seed))).collect()
}

/// Bands over all given truths.
pub fn over_the_tilt(world: &World<'_>, design: &Design, truths: &[Truth], seed: u64) -> Vec<FamilyCurves> {
    design.families().into_iter().filter_map(|family| curves(world, design, family, truths, seed)).collect()
}

fn curves(
    world: &World<'_>,
    design: &Design,
    family: usize,
    truths: &[Truth],
    seed: u64,
) -> Option<FamilyCurves> {
    let own = design.specimens.iter().filter(|specimen| specimen.family == family);
    let read: Vec<&Measurement> = own.flat_map(|specimen| &specimen.readings).collect();
    let mut quantities: Vec<MeasuredQuantity> =
        read.iter().filter(|m| m.at().is_some()).map(|m| m.quantity).collect();
    quantities.sort_unstable();
    quantities.dedup();
    let of = |quantity, tilt, drift| Measurement { quantity, tilt, drift, ..(*read[0]).clone() };
    let walls = |readings: Vec<Measurement>| -> Vec<Vec<Option<f64>>> {
        let wall = Specimen { name: String::new(), family, order: None, turned: false, readings };
        let one = Design { specimens: vec![wall], apart: Vec::new(), unused: Vec::new() };
        let sets = WALLS / truths.len().max(1) as u64;
        let drawn =
            truths.iter().zip(0..).flat_map(|(truth, k)| (0..sets).map(move |set| (truth, sets * k + set)));
        drawn.flat_map(|(truth, k)| world.values(&one, truth, &Streams::new(seed, k))).collect()
    };
    let steps = |end: f64| (0..=STEPS).map(|k| k as f64 / STEPS as f64 * end).collect::<Vec<f64>>();
    let (tilts, collapse) = match world.test() {
        Test::Shear { widest } => (steps(widest), None),
        // Outcomes are no curve.
        Test::Shaking => return None,
        Test::Tilting => {
            let angles = walls(vec![of(MeasuredQuantity::CollapseAngle, None, None)]);
            let collapse = Band::of(&angles.concat().into_iter().flatten().collect::<Vec<_>>())?;
            (steps(collapse.median), Some(collapse))
        }
    };
    let at = |quantity: MeasuredQuantity, place: f64| match collapse {
        Some(_) => of(quantity, Some(place), None),
        None => of(quantity, None, Some(place)),
    };
    let places = quantities.iter().flat_map(|q| tilts.iter().map(|place| at(*q, *place)));
    let shown = walls(places.collect());
    let curve = |(index, quantity): (usize, &MeasuredQuantity)| {
        let at = |k: usize| -> Vec<f64> {
            shown.iter().filter_map(|wall| wall[index * tilts.len() + k]).collect()
        };
        let bands = tilts.iter().enumerate().filter_map(|(k, tilt)| Some((*tilt, Band::of(&at(k))?)));
        Curve { quantity: *quantity, bands: bands.collect() }
    };
    let curves = quantities.iter().enumerate().map(curve).collect();
    Some(FamilyCurves { family, collapse, curves })
}
