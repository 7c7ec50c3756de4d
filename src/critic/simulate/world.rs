//! Campaigns that could have been measured, from a bank: truth in, readings out.

mod apart;
mod likely;
mod scopes;
mod standing;
#[cfg(test)]
mod tests;

use likely::Likely;
pub(in crate::critic) use likely::MayShow;
pub use scopes::Scored;
use scopes::kinds;
pub(in crate::critic) use standing::standing;

use std::collections::{BTreeMap, BTreeSet};

use crate::critic::compare::of_points;
use crate::critic::simulate::bank::{
    Bank, Curves, Emulator, NUMBERS, PRIOR_WIDENING, Path, Plan, Pushes, Test, stand_in,
};
use crate::critic::simulate::causes::Causes;
use crate::critic::simulate::design::{Campaign, Design};
use crate::critic::simulate::truth::Truth;
use crate::critic::simulate::unmodelled::Unmodelled;
use crate::ensemble::{build, is_random, weight};
use crate::interrupt;
use crate::math::exp;
use crate::model::Outcome;
use crate::protocol::Ends;
use crate::random::standard_normal::quantile;
use crate::random::{Family, Streams};
use crate::study::{Acts, Described, Earthquakes, MeasuredQuantity, Measurement, Nuisance, Study};

/// The mechanism that has a side, uphill or downhill.
const SIDED: &str = "lean";

/// So many walls of a family are tried for one that can be built and weighed.
const BUILT: u64 = 20;

/// The walls of a family: in the base model, or what a cause changes of them.
#[derive(Debug)]
struct Walls {
    emulator: Emulator,
    /// Whether walls of one family differ.
    random: bool,
}

/// The walls of a bank that an emulator is fitted through.
#[derive(Default)]
struct Learnt {
    scores: Vec<Vec<f64>>,
    walls: Vec<[f64; NUMBERS]>,
    /// Scores of those that do not stand at rest.
    fallen: Vec<Vec<f64>>,
    random: bool,
}

/// All that campaigns of a study are simulated from.
#[derive(Debug)]
pub struct World<'s> {
    study: &'s Study,
    test: Test,
    mechanisms: &'s [Described],
    nuisances: &'s [Nuisance; 3],
    /// The family whose walls stand for those of each arm, see [`stand_in`].
    stands_for: Vec<usize>,
    /// The base model, by family; of families that share their walls by the first.
    base: BTreeMap<usize, Walls>,
    /// What a cause changes, by family and cause. A point of the bank has the same stones and joints under every cause: the
    /// difference that a cause makes is known far better than either wall, and dies away with the cause.
    changes: BTreeMap<(usize, usize), Walls>,
    /// Causes that were to have walls in the bank.
    planned: BTreeSet<usize>,
    /// Weight of a wall as it is stated, and of its stones in the mean (N), by family.
    weights: BTreeMap<usize, [f64; 2]>,
    /// Kind of joint of each arm: arms whose joints are stated the same share one.
    kinds: Vec<usize>,
    /// Kinds of joint in whose families each mechanism changes walls, ascending.
    acted: Vec<Vec<usize>>,
    /// What is sought under the motions of a base; `None` where it does not move.
    sought: Option<Earthquakes>,
}

impl<'s> World<'s> {
    /// From a bank; `None` where a family's base model has too few walls to emulate others from them. A cause that has too few, or
    /// cannot act on a family, has there the walls of the base model.
    pub fn new(
        study: &'s Study,
        mechanisms: &'s [Described],
        nuisances: &'s [Nuisance; 3],
        plan: &Plan,
        bank: &Bank,
    ) -> Option<World<'s>> {
        let test = Test::of(study);
        let stands_for: Vec<usize> = (0..study.arms.len()).map(|family| stand_in(study, family)).collect();
        let mut unchanged: BTreeMap<(usize, u64), &Path> = BTreeMap::new();
        for (place, path) in plan.places.iter().zip(&bank.paths).filter(|(place, _)| place.cause.is_none()) {
            unchanged.extend(path.as_ref().map(|path| ((place.family, place.point), path)));
        }
        let mut grouped: BTreeMap<(usize, Option<usize>), Learnt> = BTreeMap::new();
        let walls = plan.places.iter().zip(&plan.study.arms);
        for ((place, arm), (path, ending)) in walls.zip(bank.paths.iter().zip(&bank.endings)) {
            let learnt = grouped.entry((place.family, place.cause)).or_default();
            learnt.random |= is_random(arm);
            let joints = place.joints.into_iter().map(|score| score / PRIOR_WIDENING);
            let parameters = place.parameters.iter().copied().map(quantile);
            let scores: Vec<f64> = joints.chain(varying(mechanisms, place.cause, parameters)).collect();
            let Some(path) = path else {
                if *ending == Outcome::UnstableAtRest.name() {
                    learnt.fallen.push(scores);
                }
                continue;
            };
            let Some(before) = unchanged.get(&(place.family, place.point)) else { continue };
            learnt.scores.push(scores);
            let (own, before) = (path.adding(), before.adding());
            learnt.walls.push(match place.cause {
                None => own,
                Some(_) => std::array::from_fn(|k| own[k] - before[k]),
            });
        }
        let planned: BTreeSet<usize> = grouped.keys().filter_map(|(_, cause)| *cause).collect();
        let (mut base, mut changes) = (BTreeMap::new(), BTreeMap::new());
        for ((family, cause), Learnt { scores, walls, fallen, random }) in grouped {
            let emulator = Emulator::fit(test, &scores, &walls).map(|emulator| emulator.beside(&fallen));
            let walls = emulator.map(|emulator| Walls { emulator, random });
            match cause {
                None => drop(base.insert(family, walls?)),
                Some(cause) => changes.extend(walls.map(|walls| ((family, cause), walls))),
            }
        }
        let weighed = |family: usize| {
            let wall = (0..BUILT).find_map(|member| build(study, family as u32, member).ok())?.wall;
            let whole = weight(&wall);
            Some((family, [whole, whole / wall.stones().count() as f64]))
        };
        let weights = base.keys().map(|&family| weighed(family)).collect::<Option<BTreeMap<_, _>>>()?;
        let kinds = match test {
            // A stone stands on one stand as it does not on another.
            Test::Shaking => (0..study.arms.len()).collect(),
            Test::Tilting | Test::Shear { .. } => kinds(&study.arms),
        };
        let sought = match test {
            Test::Shaking => study.clone().seeking_what_was_measured().earthquakes,
            Test::Tilting | Test::Shear { .. } => None,
        };
        let measured = study.measured_arms();
        let acted = |cause: usize| -> BTreeSet<usize> {
            let changed = changes.keys().filter(|(_, acting)| *acting == cause);
            let arms = changed.flat_map(|(family, _)| standing_for(&stands_for, *family));
            arms.filter(|arm| measured.contains(arm)).map(|arm| kinds[arm]).collect()
        };
        let acted = (0..mechanisms.len()).map(|cause| acted(cause).into_iter().collect()).collect();
        Some(World {
            study,
            test,
            stands_for,
            mechanisms,
            nuisances,
            base,
            changes,
            planned,
            weights,
            kinds,
            acted,
            sought,
        })
    }

    /// The truth with these causes, drawn from the search priors, those of the joints wider by [`PRIOR_WIDENING`], such that walls
    /// [stand](Self::stands).
    pub fn drawn(&self, causes: impl Into<Causes>, streams: &Streams) -> Truth {
        self.drawn_as(causes.into(), streams, |truth| truth)
    }

    /// The truth of the base model, drawn from the priors as they are stated.
    pub fn stated(&self, streams: &Streams) -> Truth {
        let mut truth = self.drawn(None, streams);
        truth.joints.iter_mut().flatten().for_each(|score| *score /= PRIOR_WIDENING);
        truth
    }

    /// Scores that a truth with these causes has: three for each kind of joint, one of how specimens differ, then
    /// [those of the causes](Self::scored).
    pub fn inputs(&self, causes: impl Into<Causes>) -> usize {
        3 * self.joint_kinds() + 1 + self.scored(causes).count()
    }

    /// The truth with these causes and these scores; those of the joints count [`PRIOR_WIDENING`] times.
    pub fn truth(&self, causes: impl Into<Causes>, scores: &[f64]) -> Truth {
        let causes = causes.into();
        crate::check!(scores.len() == self.inputs(causes), "{} scores for {causes:?}", scores.len());
        let (joints, others) = scores.split_at(3 * self.joint_kinds());
        let joints = joints
            .chunks_exact(3)
            .map(|c| [PRIOR_WIDENING * c[0], PRIOR_WIDENING * c[1], PRIOR_WIDENING * c[2]])
            .collect();
        Truth { causes, parameters: others[1..].to_vec(), joints, scatter: others[0] }
    }

    /// A campaign of a design under a truth: a pure function of these and the streams.
    pub fn campaign(&self, design: &Design, truth: &Truth, streams: &Streams) -> Campaign {
        let values = self.values(design, truth, streams);
        Campaign::read(design, &values, &self.values_apart(design, truth), streams)
    }

    /// A campaign in which something is off that is in no catalogue, with joints drawn from their priors: a pure function of the
    /// design and the streams.
    pub fn unmodelled(&self, design: &Design, streams: &Streams) -> Campaign {
        let truth = self.drawn(None, streams);
        let values = self.values_with(design, &truth, &Unmodelled::drawn(design, streams), streams);
        Campaign::read(design, &values, &self.values_apart(design, &truth), streams)
    }

    /// What the specimens of a campaign show of each reading (SI, gauges included) before the readings' errors; `None` where the
    /// wall has fallen. The walls are those of [`Self::campaign`] with the same streams.
    pub fn values(&self, design: &Design, truth: &Truth, streams: &Streams) -> Vec<Vec<Option<f64>>> {
        self.values_with(design, truth, &Unmodelled::default(), streams)
    }

    fn values_with(
        &self,
        design: &Design,
        truth: &Truth,
        unmodelled: &Unmodelled,
        streams: &Streams,
    ) -> Vec<Vec<Option<f64>>> {
        interrupt::look();
        let gauge = self.gauge(truth);
        // Specimens of a family are walls of one kind, those that are turned round of another.
        let mut kinds: BTreeMap<(usize, usize, bool), Likely> = BTreeMap::new();
        let specimens = design.specimens.iter().enumerate();
        specimens
            .map(|(index, specimen)| {
                let own = (self.stands_for[specimen.family], self.kinds[specimen.family]);
                let kind = kinds.entry((own.0, own.1, specimen.turned));
                let likely = kind.or_insert_with(|| match specimen.turned {
                    true => self.likely(specimen.family, &self.turned(truth)),
                    false => self.likely(specimen.family, truth),
                });
                let mut numbers = likely.wall(index, streams);
                unmodelled.act(index, &mut numbers);
                if let Some(sought) = &self.sought {
                    return specimen.readings.iter().map(|m| sought.shown(&numbers, m)).collect();
                }
                if let Test::Shear { widest } = self.test {
                    let pushes = Pushes::of(&numbers, widest);
                    return specimen.readings.iter().map(|m| pushes.at(m.drift?)).collect();
                }
                let curves = Curves::of(&numbers);
                let seen = |tilt: f64, points: [f64; 3]| {
                    unmodelled.shown(index, tilt, points.map(|x| gauge.reading(x)))
                };
                specimen.readings.iter().map(|m| shown(&curves, m, &seen)).collect()
            })
            .collect()
    }

    /// What the emulators explain of walls of the base model that they do not know, by family: share of the variance of two
    /// numbers of their path. The rest is the stones' own and the emulator's error.
    pub fn explained(&self) -> Vec<(usize, [(&'static str, f64); 2])> {
        let shares = |walls: &Walls| {
            self.test.telling().map(|(number, words)| (words, walls.emulator.explained()[number]))
        };
        self.base.iter().map(|(family, walls)| (*family, shares(walls))).collect()
    }

    /// Whether the ends of a family's walls are held.
    pub fn is_held(&self, family: usize) -> bool {
        self.study.arms[family].restraint.ends != Ends::Free
    }

    /// Whether a wall that is turned round stands as another one of its family does, but for a lean.
    pub fn can_turn(&self, family: usize) -> bool {
        self.study.arms[family].is_alike_from_both_sides()
    }

    /// What is true of a wall that is turned round: it leans the other way. The prior of that is the same for both.
    fn turned(&self, truth: &Truth) -> Truth {
        let sides = self.scored(truth.causes).map(|score| match self.mechanisms[score.cause].name {
            SIDED => -1.0,
            _ => 1.0,
        });
        let parameters = truth.parameters.iter().zip(sides).map(|(score, side)| side * score).collect();
        Truth { parameters, ..truth.clone() }
    }

    /// Factors on the joints of a family (its arm's index) under a truth, in the order of
    /// [`NUISANCES`](crate::study::NUISANCES).
    pub fn factors(&self, truth: &Truth, family: usize) -> [f64; 3] {
        let scores = truth.joints[self.kinds[family]];
        std::array::from_fn(|k| self.nuisances[k].prior.at_score(scores[k]))
    }

    /// What is sought under the motions of the base; `None` where it does not move.
    pub fn sought(&self) -> Option<&Earthquakes> {
        self.sought.as_ref()
    }

    /// The study whose campaigns these are.
    pub fn study(&self) -> &'s Study {
        self.study
    }

    /// The family whose walls stand for those of another: itself, unless arms that are alike share their walls.
    pub fn stands_for(&self, family: usize) -> usize {
        self.stands_for[family]
    }

    /// What is done to its walls.
    pub fn test(&self) -> Test {
        self.test
    }

    /// The mechanisms that its causes are indices of.
    pub fn mechanisms(&self) -> &'s [Described] {
        self.mechanisms
    }

    /// Causes that cannot be diagnosed, as too few of their walls in the bank have a path.
    pub fn too_few(&self) -> Vec<usize> {
        self.planned.iter().copied().filter(|cause| !self.has_walls(*cause)).collect()
    }

    /// The causes that a diagnosis considers: those with walls of their own in some family, and those that act on readings.
    pub fn causes(&self) -> Vec<usize> {
        let is_known = |(index, m): &(usize, &Described)| m.acts == Acts::Readings || self.has_walls(*index);
        self.mechanisms.iter().enumerate().filter(is_known).map(|(index, _)| index).collect()
    }

    /// Whether the walls that a cause changes are known in some family.
    fn has_walls(&self, cause: usize) -> bool {
        self.changes.keys().any(|(_, own)| *own == cause)
    }
}

/// The arms whose walls are those of a family.
fn standing_for(stands_for: &[usize], family: usize) -> impl Iterator<Item = usize> {
    stands_for.iter().enumerate().filter(move |(_, own)| **own == family).map(|(arm, _)| arm)
}

impl Earthquakes {
    /// What a wall of these numbers shows of a reading before its errors: of an outcome the logarithm of the scale at which it would just
    /// fall. `None` of what is not sought.
    pub(in crate::critic) fn shown(&self, numbers: &[f64; NUMBERS], m: &Measurement) -> Option<f64> {
        let number = numbers.get(1 + self.place_of(m.quantity, m.under.as_ref()?)?)?;
        Some(if m.quantity == MeasuredQuantity::Outcome { *number } else { exp(*number) })
    }
}

/// What a wall shows of a reading before its errors; `None` where it has fallen. `seen` is what gauges make of the three points at a
/// tilt.
fn shown(wall: &Curves, m: &Measurement, seen: &impl Fn(f64, [f64; 3]) -> [f64; 3]) -> Option<f64> {
    if m.quantity == MeasuredQuantity::CollapseAngle {
        return Some(wall.collapse());
    }
    let tilt = m.tilt?;
    let points = match m.quantity.is_remainder() {
        false => wall.displacements(tilt),
        true => wall.remainders(tilt),
    };
    of_points(m.quantity, seen(tilt, points?))
}

fn varies(prior: &Family) -> bool {
    !matches!(prior, Family::Constant { .. })
}

/// Scores of the parameters that vary.
fn varying(mechanisms: &[Described], cause: Option<usize>, scores: impl Iterator<Item = f64>) -> Vec<f64> {
    let parameters = cause.map_or(&[][..], |index| &mechanisms[index].parameters);
    parameters.iter().zip(scores).filter(|(p, _)| varies(&p.search)).map(|(_, score)| score).collect()
}
