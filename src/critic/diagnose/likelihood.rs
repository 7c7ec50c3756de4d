//! How likely a campaign is under a truth: the readings of a wall are as those of the paths that it may have, with their errors
//! (a synthetic likelihood: multivariate Student's t with the mean and the covariance of these paths).

use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::critic::compare::reading_variance;
use crate::critic::diagnose::design::{Campaign, Design, Seen};
use crate::critic::diagnose::world::{Truth, World};
use crate::math::ln;
use crate::random::standard_normal::cdf;
use crate::stats;
use crate::study::{MeasuredKind, MeasuredQuantity, Measurement};

/// Share of the walls' variance that counts as a reading's own: few paths do not span all that walls may do.
const LEAST: f64 = 0.02;

/// The likelihood of a campaign.
pub struct Likelihood<'c> {
    world: &'c World<'c>,
    specimens: Vec<Read<'c>>,
    /// What was measured apart: the family and the reading with its value.
    apart: Vec<(usize, &'c Measurement, f64)>,
    /// Quantities whose readings share an error.
    common: Vec<MeasuredQuantity>,
}

/// What was read on a specimen.
struct Read<'c> {
    family: usize,
    /// Readings with a value.
    values: Vec<(&'c Measurement, f64)>,
    /// Readings of which only the bound's side is known.
    bounds: Vec<&'c Measurement>,
}

impl<'c> Likelihood<'c> {
    /// Of what was seen in a campaign.
    pub fn new(world: &'c World<'c>, design: &'c Design, campaign: &Campaign) -> Likelihood<'c> {
        let specimens = design.specimens.iter().zip(&campaign.specimens).map(|(specimen, seen)| {
            let mut read = Read { family: specimen.family, values: Vec::new(), bounds: Vec::new() };
            for (m, seen) in specimen.readings.iter().zip(seen) {
                match seen {
                    Seen::Value(value) => read.values.push((m, *value)),
                    Seen::Beyond => read.bounds.push(m),
                    Seen::Nothing => {}
                }
            }
            read
        });
        let specimens: Vec<Read<'c>> = specimens.collect();
        let apart = design.apart.iter().zip(&campaign.apart);
        let apart: Vec<_> =
            apart.filter_map(|((family, m), seen)| Some((*family, m, seen.told(m)?))).collect();
        let all = specimens.iter().flat_map(Read::all).chain(apart.iter().map(|(_, m, _)| *m));
        let mut common: Vec<MeasuredQuantity> =
            all.filter(|m| m.common_error > 0.0).map(|m| m.quantity).collect();
        common.sort();
        common.dedup();
        Likelihood { world, specimens, apart, common }
    }

    /// How many errors are shared by readings; each is a score beside the truth.
    pub fn common_errors(&self) -> usize {
        self.common.len()
    }

    /// The logarithm of the likelihood, but for a constant that all truths share.
    pub fn log(&self, truth: &Truth, common: &[f64]) -> f64 {
        let shared = |m: &Measurement| {
            let at = self.common.iter().position(|quantity| *quantity == m.quantity);
            at.map_or(0.0, |at| m.common_error * common[at])
        };
        let mut families: BTreeMap<usize, Vec<&Read<'c>>> = BTreeMap::new();
        for read in &self.specimens {
            families.entry(read.family).or_default().push(read);
        }
        let mut log = 0.0;
        for (family, reads) in families {
            let readings: Vec<&Measurement> = reads.iter().flat_map(|read| read.all()).collect();
            let (shown, random) = self.world.may_show(family, &readings, truth);
            let mut first = 0;
            let groups = reads.into_iter().map(|read| {
                let own = first..first + read.count();
                first = own.end;
                Group::of(read, shown.iter().map(|path| &path[own.clone()]), &shared)
            });
            log += match random {
                true => stats::sum(&groups.map(|group| group.log()).collect::<Vec<_>>()),
                false => Group::joined(groups).map_or(0.0, |group| group.log()),
            };
        }
        for (family, m, value) in &self.apart {
            let sd = (reading_variance(m)).sqrt();
            let off = value - shared(m) - self.world.apart(*family, m, truth);
            log -= 0.5 * (off / sd) * (off / sd);
        }
        log
    }
}

impl<'c> Read<'c> {
    fn count(&self) -> usize {
        self.values.len() + self.bounds.len()
    }

    /// Its readings, those with a value first.
    fn all(&self) -> impl Iterator<Item = &'c Measurement> {
        self.values.iter().map(|(m, _)| *m).chain(self.bounds.iter().copied())
    }
}

/// Readings of walls that share a path.
struct Group {
    /// What was read less what the paths show, by path and reading.
    off: Vec<Vec<f64>>,
    /// Variance of each reading's own error.
    variance: Vec<f64>,
    /// Log likelihood of its bounds.
    bounds: f64,
}

impl Group {
    /// What was read, beside what its paths show of [`Read::all`].
    fn of<'s>(
        read: &Read<'_>,
        shown: impl Iterator<Item = &'s [f64]>,
        shared: &impl Fn(&Measurement) -> f64,
    ) -> Group {
        let values = read.values.len();
        let shown: Vec<&[f64]> = shown.collect();
        let off = shown.iter().map(|shown| {
            read.values.iter().zip(*shown).map(|((m, value), shown)| value - shared(m) - shown).collect()
        });
        let bounds = read.bounds.iter().enumerate().map(|(k, m)| {
            let column: Vec<f64> = shown.iter().map(|shown| shown[values + k]).collect();
            let sigma = stats::sigma(&column).unwrap_or(0.0);
            let sd = (reading_variance(m) + sigma * sigma).sqrt().max(f64::MIN_POSITIVE);
            let inside = (m.value - stats::mean(&column).unwrap_or(0.0) - shared(m)) / sd;
            let side = if m.kind == MeasuredKind::Below { inside } else { -inside };
            ln(cdf(side).max(f64::MIN_POSITIVE))
        });
        Group {
            bounds: stats::sum(&bounds.collect::<Vec<_>>()),
            off: off.collect(),
            variance: read.values.iter().map(|(m, _)| reading_variance(m)).collect(),
        }
    }

    /// Readings of several walls as those of one.
    fn joined(groups: impl Iterator<Item = Group>) -> Option<Group> {
        groups.reduce(|mut one, other| {
            one.off.iter_mut().zip(other.off).for_each(|(one, other)| one.extend(other));
            one.variance.extend(other.variance);
            one.bounds += other.bounds;
            one
        })
    }

    /// Student's t: the covariance is that of few paths and not known exactly.
    fn log(&self) -> f64 {
        let (paths, readings) = (self.off.len(), self.variance.len());
        if readings == 0 {
            return self.bounds;
        }
        let freedom = (paths - 1) as f64;
        // Path by path, as they lie in memory.
        let mut mean = vec![0.0; readings];
        for off in &self.off {
            mean.iter_mut().zip(off).for_each(|(sum, off)| *sum += off);
        }
        mean.iter_mut().for_each(|sum| *sum /= paths as f64);
        let mut square = vec![0.0; readings];
        for off in &self.off {
            let apart = off.iter().zip(&mean).map(|(off, mean)| off - mean);
            square.iter_mut().zip(apart).for_each(|(sum, apart)| *sum += apart * apart);
        }
        // In units of each reading's own error, of which no reading is free.
        let own = self.variance.iter().zip(&square);
        let sd: Vec<f64> =
            own.map(|(own, square)| (own + LEAST * square / freedom).sqrt().max(f64::MIN_POSITIVE)).collect();
        let unit: Vec<f64> = sd.iter().map(|sd| 1.0 / (sd * freedom.sqrt())).collect();
        let spread = DMatrix::from_fn(readings, paths, |k, path| (self.off[path][k] - mean[k]) * unit[k]);
        let off = DVector::from_fn(readings, |k, _| mean[k] / sd[k]);
        // Woodbury: of the readings' covariance 1 + spread spread' only the paths' side is factored.
        let mut inner = spread.tr_mul(&spread);
        for k in 0..paths {
            inner[(k, k)] += 1.0;
        }
        let Some(inner) = inner.cholesky() else { return f64::NEG_INFINITY };
        let along = spread.tr_mul(&off);
        let square = off.dot(&off) - along.dot(&inner.solve(&along));
        let lower = inner.l_dirty();
        let half_log_determinant = (0..paths).fold(0.0, |sum, k| sum + ln(lower[(k, k)]));
        let own = sd.iter().fold(0.0, |sum, sd| sum + ln(*sd));
        self.bounds
            - half_log_determinant
            - own
            - 0.5 * (freedom + readings as f64) * ln(1.0 + square / freedom)
    }
}
