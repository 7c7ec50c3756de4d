//! How likely a campaign is under a truth: the readings of a wall are as those of the paths that it may have, with their errors
//! (a synthetic likelihood: multivariate Student's t with the mean and the covariance of these paths).

use std::rc::Rc;

use crate::critic::causes::density::{Density, Paths};
use crate::critic::compare::reading_variance;
use crate::critic::simulate::{Campaign, Design, MayShow, Queries, Seen, Side, Truth, World};
use crate::interrupt;
use crate::math::{exp, ln};
use crate::random::standard_normal::cdf;
use crate::study::{Earthquakes, MeasuredQuantity, Measurement};

/// The likelihood of a campaign.
pub struct Likelihood<'c> {
    world: &'c World<'c>,
    pub(super) families: Vec<Family<'c>>,
    /// What was measured apart: the family, the reading and what it showed.
    apart: Vec<(usize, &'c Measurement, Seen)>,
    /// [Instruments](MeasuredQuantity::instrument) whose readings share an error.
    common: Vec<MeasuredQuantity>,
    /// Those of them where nobody knows how much.
    unknown: Vec<MeasuredQuantity>,
}

/// The errors of readings.
pub(super) struct Errors<'l> {
    pub(super) of: &'l Likelihood<'l>,
    /// Scores of the shared errors, then of how much of the error they are.
    pub(super) scores: &'l [f64],
}

impl Errors<'_> {
    /// The variance of a reading's own error and rounding, and the error that it shares.
    fn of(&self, m: &Measurement) -> (f64, f64) {
        let Likelihood { common, unknown, .. } = self.of;
        let at =
            |list: &[MeasuredQuantity]| list.iter().position(|shared| *shared == m.quantity.instrument());
        let share = at(unknown).map_or(0.0, |at| cdf(self.scores[common.len() + at]));
        let [random, whole] = m.errors(share);
        let rounding = reading_variance(m) - m.error * m.error;
        (random * random + rounding, at(common).map_or(0.0, |at| whole * self.scores[at]))
    }
}

/// What was read on the specimens of a family.
pub(super) struct Family<'c> {
    family: usize,
    queries: Queries,
    /// By specimen, where every one is a wall of its own.
    each: Vec<Wall<'c>>,
    /// All as if they had been read on one wall, where walls do not differ.
    all: [Wall<'c>; 1],
}

/// Walls on which anything was read, each with the density of what was.
type Densities<'l, 'c> = Vec<(&'l Wall<'c>, Rc<Density>)>;

/// What was read on a wall. Columns are those of [`Queries`].
#[derive(Clone, Default)]
pub(super) struct Wall<'c> {
    /// Readings with a value, by column.
    values: Vec<(usize, &'c Measurement, f64)>,
    /// Where the readings of each specimen end among these.
    ends: Vec<usize>,
    /// Readings of which only the side of their value is known.
    bounds: Vec<(usize, &'c Measurement, Side)>,
    /// The first wall of the family on which the same has a value, with the same errors; they share a density.
    same_as: usize,
}

impl<'c> Likelihood<'c> {
    /// Of what was seen in a campaign.
    pub fn new(world: &'c World<'c>, design: &'c Design, campaign: &Campaign) -> Likelihood<'c> {
        let families = design.families().into_iter().map(|family| {
            let own = design.specimens.iter().zip(&campaign.specimens);
            let own = own.filter(|(specimen, _)| specimen.family == family);
            let own = own.map(|(specimen, seen)| (&specimen.readings[..], &seen[..])).collect();
            Family::new(family, own, world.sought())
        });
        let families: Vec<Family<'c>> = families.collect();
        let apart = design.apart.iter().zip(&campaign.apart);
        let apart = apart.filter(|(_, seen)| **seen != Seen::Nothing);
        let apart: Vec<_> = apart.map(|((family, m), seen)| (*family, m, *seen)).collect();
        let all = families.iter().flat_map(|own| own.all[0].readings());
        let all: Vec<&Measurement> = all.chain(apart.iter().map(|(_, m, _)| *m)).collect();
        let those = |is: fn(&&&Measurement) -> bool| {
            let mut those: Vec<MeasuredQuantity> =
                all.iter().filter(is).map(|m| m.quantity.instrument()).collect();
            those.sort();
            those.dedup();
            those
        };
        let (common, unknown) = (those(|m| m.common_error > 0.0), those(|m| m.unknown_share));
        Likelihood { world, families, apart, common, unknown }
    }

    /// How many scores beside the truth it takes: one for each error that readings share, and one for each share that is not known.
    pub fn common_errors(&self) -> usize {
        self.common.len() + self.unknown.len()
    }

    /// The logarithm of the likelihood, but for a constant that all truths share, whatever causes they have.
    pub fn log(&self, truth: &Truth, common: &[f64]) -> f64 {
        interrupt::look();
        let errors = Errors { of: self, scores: common };
        let mut log = self.apart_log(truth, &errors);
        for family in &self.families {
            let Some((paths, walls)) = self.walls(family, truth, &errors) else { return f64::NEG_INFINITY };
            for (wall, density) in walls {
                log += density.log(&wall.off(&paths, &errors)) + wall.bounds_log(&paths, &errors, || 0.0);
            }
        }
        log
    }

    /// The walls of a family on which anything was read, with the density of what was; `None` where that is no number. Where walls do
    /// not differ it is one.
    pub(super) fn walls<'l>(
        &self,
        Family { family, queries, each, all }: &'l Family<'c>,
        truth: &Truth,
        errors: &Errors<'_>,
    ) -> Option<(Paths, Densities<'l, 'c>)> {
        let MayShow { paths, random, by_stiffness } =
            self.world.may_show(*family, queries, truth, each.len());
        let paths = Paths::of(paths, by_stiffness);
        let walls = if random { &each[..] } else { &all[..] };
        let mut densities: Vec<Rc<Density>> = Vec::with_capacity(walls.len());
        for (k, wall) in walls.iter().enumerate() {
            let density = match wall.same_as == k {
                true => Rc::new(Density::of(&wall.read(errors), &wall.ends, &paths)?),
                false => densities[wall.same_as].clone(),
            };
            densities.push(density);
        }
        Some((paths, walls.iter().zip(densities).collect()))
    }

    /// The same of what was measured apart.
    pub(super) fn apart_log(&self, truth: &Truth, errors: &Errors<'_>) -> f64 {
        let one = |(family, m, seen): &(usize, &Measurement, Seen)| {
            let (variance, shared) = errors.of(m);
            let expected = shared + self.world.apart(*family, m, truth);
            match seen {
                Seen::Value(value) => {
                    let off = value - expected;
                    -0.5 * (off * off / variance + ln(variance))
                }
                other => other.side(m).map_or(0.0, |side| side_log(side, m.value - expected, variance)),
            }
        };
        self.apart.iter().fold(0.0, |sum, apart| sum + one(apart))
    }
}

impl<'c> Family<'c> {
    /// Of what was planned and seen, specimen by specimen.
    fn new(
        family: usize,
        specimens: Vec<(&'c [Measurement], &[Seen])>,
        sought: Option<&Earthquakes>,
    ) -> Family<'c> {
        let readings: Vec<&Measurement> = specimens.iter().flat_map(|(readings, _)| *readings).collect();
        let queries = Queries::by(&readings, sought);
        let mut columns = queries.by_reading.iter().copied();
        let (mut each, mut all): (Vec<Wall<'c>>, Wall<'c>) = (Vec::new(), Wall::default());
        for (readings, seen) in specimens {
            let mut wall = Wall::default();
            for ((m, seen), column) in readings.iter().zip(seen).zip(&mut columns) {
                match seen {
                    Seen::Value(value) => wall.values.push((column, m, *value)),
                    other => wall.bounds.extend(other.side(m).map(|side| (column, m, side))),
                }
            }
            wall.ends.push(wall.values.len());
            all.values.extend(&wall.values);
            all.ends.push(all.values.len());
            all.bounds.extend(&wall.bounds);
            wall.same_as = each.iter().position(|other| other.has_readings_of(&wall)).unwrap_or(each.len());
            each.push(wall);
        }
        Family { family, queries, each, all: [all] }
    }
}

impl<'c> Wall<'c> {
    /// Its readings that show anything.
    fn readings(&self) -> impl Iterator<Item = &'c Measurement> {
        self.values.iter().map(|(_, m, _)| *m).chain(self.bounds.iter().map(|(_, m, _)| *m))
    }

    fn has_readings_of(&self, other: &Wall<'_>) -> bool {
        let read = |(column, m, _): &(usize, &Measurement, f64)| {
            (*column, m.quantity, reading_variance(m), m.common_error)
        };
        self.values.iter().map(read).eq(other.values.iter().map(read))
    }

    /// Columns of its readings with a value, with the variances of their own errors.
    fn read(&self, errors: &Errors<'_>) -> Vec<(usize, f64)> {
        self.values.iter().map(|(column, m, _)| (*column, errors.of(m).0)).collect()
    }

    /// How far these are off what the paths show in the mean.
    pub(super) fn off(&self, paths: &Paths, errors: &Errors<'_>) -> Vec<f64> {
        let off =
            |(column, m, value): &(usize, &Measurement, f64)| value - errors.of(m).1 - paths.mean[*column];
        self.values.iter().map(off).collect()
    }

    /// Logarithm of the probability of its bounds' sides, where each has so much more variance.
    pub(super) fn bounds_log(
        &self,
        paths: &Paths,
        errors: &Errors<'_>,
        mut more: impl FnMut() -> f64,
    ) -> f64 {
        let outcomes = self.bounds.iter().filter(|(_, m, _)| m.quantity == MeasuredQuantity::Outcome);
        let share = paths.shared(outcomes.map(|(column, ..)| *column));
        let (mut log, mut together) = (0.0, Vec::new());
        for (column, m, side) in &self.bounds {
            let (variance, shared) = errors.of(m);
            let by_stiffness = paths.by_stiffness[*column];
            let (walls, more) = (paths.variance[*column], more());
            let own = variance + by_stiffness * by_stiffness;
            let off = m.value - paths.mean[*column] - shared;
            match m.quantity {
                MeasuredQuantity::Outcome => together.push(Outcome {
                    side: *side,
                    off,
                    own: own + (1.0 - share) * walls + (1.0 - OF_ALL) * more,
                    shared: (share * walls + OF_ALL * more).sqrt(),
                }),
                _ => log += side_log(*side, off, own + walls + more),
            }
        }
        log + together_log(&together)
    }
}

/// What is seen of an outcome: on which side of its scale the wall just falls.
struct Outcome {
    side: Side,
    /// How much more that scale is than what is expected (its logarithm).
    off: f64,
    /// Variance of what it has of its own: rocking is decided by chance.
    own: f64,
    /// Standard deviation of what all outcomes of the wall share: a stone that is weaker than the emulator says is so under every motion.
    shared: f64,
}

/// Share of a discrepancy's variance that is the same under every motion: what is in no catalogue acts on motions of one kind more than on
/// others.
const OF_ALL: f64 = 0.5;

/// Nodes and weights of Gauss and Hermite for a standard normal, by their size.
const NODES: [(f64, f64); 4] = [
    (0.0, 0.457_142_857_142_857),
    (1.154_405_394_739_968, 0.240_123_178_605_013),
    (2.366_759_410_734_541, 0.030_757_123_967_586),
    (3.750_439_717_725_742, 0.000_548_268_855_972),
];

/// Logarithm of the probability of some outcomes together: normals with one factor in common (Dunnett and Sobel 1955).
fn together_log(outcomes: &[Outcome]) -> f64 {
    if outcomes.is_empty() {
        return 0.0;
    }
    let at = |z: f64| {
        outcomes.iter().fold(0.0, |sum, own| sum + side_log(own.side, own.off - own.shared * z, own.own))
    };
    let both = NODES.iter().flat_map(|&(z, weight)| match z {
        0.0 => vec![ln(weight) + at(0.0)],
        _ => [z, -z].map(|z| ln(weight) + at(z)).to_vec(),
    });
    let logs: Vec<f64> = both.collect();
    let largest = logs.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    largest + ln(logs.iter().fold(0.0, |sum, log| sum + exp(log - largest)))
}

/// Logarithm of the probability of a side of a value that is so much more than what is expected.
fn side_log(side: Side, more: f64, variance: f64) -> f64 {
    let inside = more / variance.sqrt().max(f64::MIN_POSITIVE);
    let side = if side == Side::Below { inside } else { -inside };
    ln(cdf(side).max(f64::MIN_POSITIVE))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::made;
    use crate::random::Streams;
    use crate::study::MeasuredKind;

    /// Sum of the likelihood over all that so many walls of a family could show in one reading each.
    fn sum(family: usize, walls: usize) -> f64 {
        let made = made();
        let world = made.world();
        let (mut design, _) = Design::of(&made.study);
        design.specimens.retain(|specimen| specimen.family == family);
        design.specimens.truncate(walls);
        for specimen in &mut design.specimens {
            specimen.readings.retain(|m| m.quantity == MeasuredQuantity::CollapseAngle);
            let angle = &mut specimen.readings[0];
            (angle.kind, angle.resolution, angle.error) = (MeasuredKind::Exact, 0.0, 2e-3);
        }
        let truth = world.truth(None, &vec![0.0; world.inputs(None)]);
        let middle = world.values(&design, &truth, &Streams::new(3, 1))[0][0].expect("it falls");
        let step = 1e-3;
        let grid: Vec<f64> = (-100..=100).map(|k| middle + step * f64::from(k)).collect();
        let mut shown = vec![0; walls];
        let mut sum = 0.0;
        loop {
            let specimens = shown.iter().map(|&k: &usize| vec![Seen::Value(grid[k])]).collect();
            let campaign = Campaign { specimens, apart: Vec::new() };
            sum += exp(Likelihood::new(&world, &design, &campaign).log(&truth, &[]));
            let Some(at) = shown.iter().position(|k| k + 1 < grid.len()) else { break };
            shown[at] += 1;
            shown[..at].fill(0);
        }
        (0..walls).fold(sum, |sum, _| sum * step)
    }

    #[test]
    fn the_likelihoods_of_all_that_could_be_seen_sum_up_to_one_whether_walls_differ_or_share_a_path() {
        for (family, walls) in [(0, 1), (1, 1), (0, 2), (1, 2)] {
            // Trapezia of a thirtieth of the width, out to where one in a million lies beyond.
            let sum = sum(family, walls);
            assert!((sum - 1.0).abs() < 1e-3, "{walls} walls of family {family}: {sum}");
        }
    }

    #[test]
    fn outcomes_that_share_all_are_as_likely_as_the_hardest_of_them_and_others_multiply() {
        let seen = |off: f64, own: f64, shared: f64| Outcome { side: Side::Below, off, own, shared };
        // Two sides of one normal: that which is less likely.
        let one = together_log(&[seen(0.5, 1e-3, 1.0), seen(-0.5, 1e-3, 1.0)]);
        assert!((exp(one) - cdf(-0.5)).abs() < 0.05, "{one}");
        let apart = together_log(&[seen(0.5, 1.0, 0.0), seen(-0.5, 1.0, 0.0)]);
        assert!((exp(apart) - cdf(0.5) * cdf(-0.5)).abs() < 1e-9, "{apart}");
        // One outcome has its variance, whatever of it is shared.
        let alone = together_log(&[seen(0.7, 0.6, 0.4_f64.sqrt())]);
        assert!((exp(alone) - cdf(0.7)).abs() < 1e-4, "{alone}");
        assert_eq!(together_log(&[]), 0.0);
    }

    #[test]
    fn what_columns_have_in_common_is_told_from_what_each_has_of_its_own() {
        let mut draws = Streams::new(7, 1).of("columns");
        let mut draw = || crate::random::standard_normal::quantile(draws.uniform());
        let mut shared = |common: f64, own: f64| {
            let path = |_| {
                let all = common * draw();
                (0..40).map(|column| f64::from(column) + all + own * draw()).collect()
            };
            let paths: Vec<Vec<f64>> = (0..400).map(path).collect();
            Paths::of(paths, vec![0.0; 40]).shared(0..40)
        };
        assert!((shared(1.0, 0.0) - 1.0).abs() < 1e-9);
        // Of a variance of 2 one half is common; 400 paths tell it to 7 % of itself.
        let half = shared(1.0, 1.0);
        assert!((half - 0.5).abs() < 0.1, "{half}");
        let none = shared(0.0, 1.0);
        assert!(none < 0.02, "{none}");
    }
}
