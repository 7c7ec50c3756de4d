//! How likely a campaign is under a truth: the readings of a wall are as those of the paths that it may have, with their errors
//! (a synthetic likelihood: multivariate Student's t with the mean and the covariance of these paths).

use std::f64::consts::PI;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::critic::compare::reading_variance;
use crate::critic::simulate::{Campaign, Design, Queries, Seen, Truth, World};
use crate::interrupt;
use crate::math::{ln, ln_gamma};
use crate::random::standard_normal::cdf;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

/// Share of the walls' variance that counts as a reading's own: few paths do not span all that walls may do.
const LEAST: f64 = 0.02;

/// The likelihood of a campaign.
pub struct Likelihood<'c> {
    world: &'c World<'c>,
    families: Vec<Family<'c>>,
    /// What was measured apart: the family, the reading and what it showed.
    apart: Vec<(usize, &'c Measurement, Seen)>,
    /// [Instruments](MeasuredQuantity::instrument) whose readings share an error.
    common: Vec<MeasuredQuantity>,
    /// Those of them where nobody knows how much.
    unknown: Vec<MeasuredQuantity>,
}

/// The errors of readings.
struct Errors<'l> {
    of: &'l Likelihood<'l>,
    /// Scores of the shared errors, then of how much of the error they are.
    scores: &'l [f64],
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
struct Family<'c> {
    family: usize,
    queries: Queries,
    /// By specimen, where every one is a wall of its own.
    each: Vec<Wall<'c>>,
    /// All as if they had been read on one wall, where walls do not differ.
    all: [Wall<'c>; 1],
}

/// What was read on a wall. Columns are those of [`Queries`].
#[derive(Clone, Default)]
struct Wall<'c> {
    /// Readings with a value, by column.
    values: Vec<(usize, &'c Measurement, f64)>,
    /// Readings of which only the bound's side is known.
    bounds: Vec<(usize, &'c Measurement)>,
    /// The first wall of the family on which the same has a value, with the same errors; they share a density.
    same_as: usize,
}

impl<'c> Likelihood<'c> {
    /// Of what was seen in a campaign.
    pub fn new(world: &'c World<'c>, design: &'c Design, campaign: &Campaign) -> Likelihood<'c> {
        let families = design.families().into_iter().map(|family| {
            let own = design.specimens.iter().zip(&campaign.specimens);
            let own = own.filter(|(specimen, _)| specimen.family == family);
            Family::new(family, own.map(|(specimen, seen)| (&specimen.readings[..], &seen[..])).collect())
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
        let mut log = 0.0;
        for Family { family, queries, each, all } in &self.families {
            let (shown, random) = self.world.may_show(*family, queries, truth, each.len());
            let paths = Paths::of(shown);
            let walls = if random { &each[..] } else { &all[..] };
            let first = |(k, wall): (usize, &Wall<'_>)| {
                (wall.same_as == k).then(|| Density::of(wall, &paths, &errors))?
            };
            let densities: Vec<Option<Density>> = walls.iter().enumerate().map(first).collect();
            for wall in walls {
                let density = densities[wall.same_as].as_ref();
                log += density.map_or(f64::NEG_INFINITY, |density| density.log(wall, &paths, &errors));
                log += wall.bounds_log(&paths, &errors);
            }
        }
        for (family, m, seen) in &self.apart {
            let (variance, shared) = errors.of(m);
            let expected = shared + self.world.apart(*family, m, truth);
            log += match seen {
                Seen::Value(value) => {
                    let off = value - expected;
                    -0.5 * (off * off / variance + ln(variance))
                }
                Seen::Beyond | Seen::Nothing => side_log(m, expected, variance),
            };
        }
        log
    }
}

impl<'c> Family<'c> {
    /// Of what was planned and seen, specimen by specimen.
    fn new(family: usize, specimens: Vec<(&'c [Measurement], &[Seen])>) -> Family<'c> {
        let readings: Vec<&Measurement> = specimens.iter().flat_map(|(readings, _)| *readings).collect();
        let queries = Queries::by(&readings);
        let mut columns = queries.by_reading.iter().copied();
        let (mut each, mut all): (Vec<Wall<'c>>, Wall<'c>) = (Vec::new(), Wall::default());
        for (readings, seen) in specimens {
            let mut wall = Wall::default();
            for ((m, seen), column) in readings.iter().zip(seen).zip(&mut columns) {
                match seen {
                    Seen::Value(value) => wall.values.push((column, m, *value)),
                    Seen::Beyond => wall.bounds.push((column, m)),
                    Seen::Nothing => {}
                }
            }
            all.values.extend(&wall.values);
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
        self.values.iter().map(|(_, m, _)| *m).chain(self.bounds.iter().map(|(_, m)| *m))
    }

    fn has_readings_of(&self, other: &Wall<'_>) -> bool {
        let read = |(column, m, _): &(usize, &Measurement, f64)| {
            (*column, m.quantity, reading_variance(m), m.common_error)
        };
        self.values.iter().map(read).eq(other.values.iter().map(read))
    }

    /// Logarithm of the probability of its bounds' sides.
    fn bounds_log(&self, paths: &Paths, errors: &Errors<'_>) -> f64 {
        let one = |(column, m): &(usize, &Measurement)| {
            let (variance, shared) = errors.of(m);
            side_log(m, paths.mean[*column] + shared, variance + paths.variance[*column])
        };
        self.bounds.iter().fold(0.0, |sum, bound| sum + one(bound))
    }
}

/// Logarithm of the probability of a bound's side.
fn side_log(m: &Measurement, expected: f64, variance: f64) -> f64 {
    let inside = (m.value - expected) / variance.sqrt().max(f64::MIN_POSITIVE);
    let side = if m.kind == MeasuredKind::Below { inside } else { -inside };
    ln(cdf(side).max(f64::MIN_POSITIVE))
}

/// What the paths that a wall may have show, by column.
struct Paths {
    /// By path.
    shown: Vec<Vec<f64>>,
    mean: Vec<f64>,
    variance: Vec<f64>,
}

impl Paths {
    fn of(shown: Vec<Vec<f64>>) -> Paths {
        let columns = shown[0].len();
        // Path by path, as they lie in memory.
        let mut mean = vec![0.0; columns];
        for path in &shown {
            mean.iter_mut().zip(path).for_each(|(sum, x)| *sum += x);
        }
        mean.iter_mut().for_each(|sum| *sum /= shown.len() as f64);
        let mut variance = vec![0.0; columns];
        for path in &shown {
            let off = path.iter().zip(&mean).map(|(x, mean)| x - mean);
            variance.iter_mut().zip(off).for_each(|(sum, off)| *sum += off * off);
        }
        let freedom = (shown.len() - 1) as f64;
        variance.iter_mut().for_each(|sum| *sum /= freedom);
        Paths { shown, mean, variance }
    }
}

/// The density of readings with a value: Student's t, as the covariance is that of few paths and not known exactly.
struct Density {
    /// Degrees of freedom of the covariance.
    freedom: f64,
    /// Each reading's own standard deviation, of which none is free.
    sd: Vec<f64>,
    /// What the paths are off their mean in units of it, by reading and path, such that the readings' covariance is
    /// 1 + spread spread'.
    spread: DMatrix<f64>,
    /// Woodbury: only the paths' side of that, 1 + spread' spread, is factored.
    inner: Cholesky<f64, Dyn>,
    /// Logarithm of the density where nothing is off: models that share a path among walls, and models that do not, are compared.
    top: f64,
}

impl Density {
    /// `None` where the paths are no numbers.
    fn of(wall: &Wall<'_>, paths: &Paths, errors: &Errors<'_>) -> Option<Density> {
        let (readings, count) = (wall.values.len(), paths.shown.len());
        let freedom = (count - 1) as f64;
        let sd = wall.values.iter().map(|(column, m, _)| {
            (errors.of(m).0 + LEAST * paths.variance[*column]).sqrt().max(f64::MIN_POSITIVE)
        });
        let sd: Vec<f64> = sd.collect();
        let unit: Vec<f64> = sd.iter().map(|sd| 1.0 / (sd * freedom.sqrt())).collect();
        let spread = DMatrix::from_fn(readings, count, |k, path| {
            let column = wall.values[k].0;
            (paths.mean[column] - paths.shown[path][column]) * unit[k]
        });
        // The lower triangle is all that is asked for.
        let mut inner = DMatrix::identity(count, count);
        for column in 0..count {
            for row in column..count {
                inner[(row, column)] += spread.column(row).dot(&spread.column(column));
            }
        }
        let inner = inner.cholesky()?;
        let own = sd.iter().fold(0.0, |sum, sd| sum + ln(*sd));
        let lower = inner.l_dirty();
        let half_log_determinant = (0..count).fold(own, |sum, k| sum + ln(lower[(k, k)]));
        let n = readings as f64;
        let top = ln_gamma(0.5 * (freedom + n)) - ln_gamma(0.5 * freedom) - 0.5 * n * ln(PI * freedom);
        Some(Density { freedom, sd, spread, inner, top: top - half_log_determinant })
    }

    /// Its logarithm, of a wall that is the [same](Wall::same_as).
    fn log(&self, wall: &Wall<'_>, paths: &Paths, errors: &Errors<'_>) -> f64 {
        let off = wall.values.iter().zip(&self.sd);
        let off =
            off.map(|((column, m, value), sd)| (value - errors.of(m).1 - paths.mean[*column]) / sd).collect();
        let off = DVector::from_vec(off);
        let along = self.spread.tr_mul(&off);
        let square = off.dot(&off) - along.dot(&self.inner.solve(&along));
        let power = 0.5 * (self.freedom + off.len() as f64);
        self.top - power * ln(1.0 + square / self.freedom)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::critic::fixture::made;
    use crate::math::exp;
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
}
