//! The most likely law, and what is left open about it.

use nalgebra::{DMatrix, DVector};

use crate::critic::joint_law::tested::{KNOTS, Shown, Tested, Try};
use crate::study::MeasuredKind;

/// Standard deviation of the second differences of the logarithm of the compliance, beforehand.
const BENT: f64 = 1.0;
/// And of its level: as good as free. A tighter one leaks into stresses that were not seen.
const LEVEL: f64 = 20.0;
/// Specimens of a family differ by so much in stiffness (logarithm).
pub const SPECIMEN: f64 = 0.1;
/// Steps of finite differences: of the logarithm of the compliance, and of scores.
const STEPS: [f64; 2] = [0.1, 0.3];
/// At most so many rounds, and so many halvings in one.
const ROUNDS: usize = 8;
const HALVINGS: usize = 3;
/// No unknown moves further in a round.
const FURTHEST: f64 = 1.5;
/// No score is taken further from the middle of its prior.
const FARTHEST_SCORE: f64 = 4.0;
/// A round that gains less (logarithm of the posterior) is the last.
const ENOUGH: f64 = 0.1;

/// What is free of the law.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Freedom {
    /// Its level: joints of constant stiffness.
    Level,
    /// All knots.
    Knots,
}

/// What a specimen says at a try: which readings count, what they are off by, how that changes, and its covariance.
struct Said {
    off: DVector<f64>,
    slopes: DMatrix<f64>,
    covariance: DMatrix<f64>,
}

/// The most likely law.
#[derive(Clone, Debug)]
pub struct Fit {
    freedom: Freedom,
    /// The unknowns: of the law first, then the scores.
    pub unknowns: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// What the readings alone know of them.
    pub information: DMatrix<f64>,
}

impl Fit {
    /// Of some of the specimens, from a first guess; `None` where no walls can be simulated.
    pub fn of(
        tested: &Tested<'_>,
        freedom: Freedom,
        specimens: &[usize],
        start: &DVector<f64>,
    ) -> Option<Fit> {
        let prior = freedom.prior();
        let middle = freedom.middle(tested);
        let mut unknowns = start.clone();
        let mut last = None;
        for round in 0..=ROUNDS {
            let said = said(tested, freedom, specimens, &unknowns)?;
            let (information, towards) = weighed(&said)?;
            let covariance = (&information + &prior).cholesky()?.inverse();
            let away = &unknowns - &middle;
            let step = &covariance * (towards - &prior * &away);
            let most = step.amax();
            let own = Fit { freedom, unknowns: unknowns.clone(), covariance, information };
            if round == ROUNDS || most < 1e-3 {
                return Some(own);
            }
            last = Some(own);
            let step = if most > FURTHEST { step * (FURTHEST / most) } else { step };
            let value = |off: &[DVector<f64>], at: &DVector<f64>| {
                let away = at - &middle;
                let misfit = off
                    .iter()
                    .zip(&said)
                    .filter_map(|(off, said)| Some(off.dot(&said.covariance.clone().cholesky()?.solve(off))));
                0.5 * (misfit.sum::<f64>() + away.dot(&(&prior * &away)))
            };
            let before = value(&said.iter().map(|said| said.off.clone()).collect::<Vec<_>>(), &unknowns);
            // All halves of the step at once: they are as many walls as a round has anyhow.
            let ways: Vec<DVector<f64>> =
                (0..HALVINGS).map(|k| &unknowns + &step / f64::from(1u32 << k)).collect();
            let tries: Vec<Try> = ways.iter().map(|way| freedom.tried(way)).collect();
            let shown = tested.shown(&tries);
            let values = ways.iter().zip(shown).filter_map(|(way, shown)| {
                let off: Vec<DVector<f64>> = specimens
                    .iter()
                    .map(|&at| Some(DVector::from_vec(off(tested, at, &shown.as_ref()?[at]))))
                    .collect::<Option<_>>()?;
                Some((value(&off, way), way))
            });
            let best = values.min_by(|a, b| a.0.total_cmp(&b.0));
            match best {
                Some((value, way)) if value < before => {
                    unknowns = way.clone();
                    if before - value < ENOUGH {
                        return last;
                    }
                }
                _ => return last,
            }
        }
        last
    }

    /// The logarithm of the density that it gives to the readings of a specimen that it has not seen; `None` where it cannot tell.
    pub fn predicts(&self, tested: &Tested<'_>, specimen: usize) -> Option<f64> {
        let said = said(tested, self.freedom, &[specimen], &self.unknowns)?.pop()?;
        let covariance = &said.covariance + &said.slopes * &self.covariance * said.slopes.transpose();
        let root = covariance.cholesky()?;
        let halves = root.l_dirty().diagonal().iter().map(|x| crate::math::ln(*x)).sum::<f64>();
        let n = said.off.len() as f64;
        Some(
            -halves
                - 0.5 * said.off.dot(&root.solve(&said.off))
                - 0.5 * n * crate::math::ln(std::f64::consts::TAU),
        )
    }

    /// The logarithms of the compliance at the knots.
    pub fn law(&self) -> Vec<f64> {
        self.freedom.tried(&self.unknowns).ln_compliance
    }

    /// As a try.
    pub fn tried(&self) -> Try {
        self.tried_at(&self.unknowns)
    }

    /// Other unknowns as a try.
    pub fn tried_at(&self, unknowns: &DVector<f64>) -> Try {
        self.freedom.tried(unknowns)
    }
}

impl Freedom {
    /// Unknowns of the law.
    pub fn of_law(self) -> usize {
        match self {
            Freedom::Level => 1,
            Freedom::Knots => KNOTS,
        }
    }

    /// The joints as they are stated.
    pub fn middle(self, tested: &Tested<'_>) -> DVector<f64> {
        let law = self.of_law();
        DVector::from_fn(law + 2, |k, _| if k < law { tested.stated() } else { 0.0 })
    }

    /// The same law, or a straight one, with other unknowns.
    pub fn from(self, other: &Fit) -> DVector<f64> {
        let (law, from) = (self.of_law(), other.law());
        let scores = other.freedom.of_law();
        DVector::from_fn(law + 2, |k, _| if k < law { from[k] } else { other.unknowns[scores + k - law] })
    }

    fn tried(self, unknowns: &DVector<f64>) -> Try {
        let law = self.of_law();
        let ln_compliance = match self {
            Freedom::Level => vec![unknowns[0]; KNOTS],
            Freedom::Knots => unknowns.iter().take(KNOTS).copied().collect(),
        };
        // Far from its middle a prior has no quantile that a number could tell from its end.
        let score = |k: usize| unknowns[law + k].clamp(-FARTHEST_SCORE, FARTHEST_SCORE);
        Try { ln_compliance, scores: [score(0), score(1)] }
    }

    /// What is known of the unknowns beforehand.
    fn prior(self) -> DMatrix<f64> {
        let law = self.of_law();
        let mut prior = DMatrix::identity(law + 2, law + 2);
        for k in 0..law {
            prior[(k, k)] = 1.0 / (LEVEL * LEVEL);
        }
        for k in 1..law.max(1) - 1 {
            for (i, x) in [(k - 1, 1.0), (k, -2.0), (k + 1, 1.0)] {
                for (j, y) in [(k - 1, 1.0), (k, -2.0), (k + 1, 1.0)] {
                    prior[(i, j)] += x * y / (BENT * BENT);
                }
            }
        }
        prior
    }
}

/// What specimens say at these unknowns.
fn said(
    tested: &Tested<'_>,
    freedom: Freedom,
    specimens: &[usize],
    unknowns: &DVector<f64>,
) -> Option<Vec<Said>> {
    let (law, n) = (freedom.of_law(), unknowns.len());
    let step = |k: usize| if k < law { STEPS[0] } else { STEPS[1] };
    let moved = |k: usize| {
        let mut own = unknowns.clone();
        own[k] += step(k);
        freedom.tried(&own)
    };
    let tries: Vec<Try> = std::iter::once(freedom.tried(unknowns)).chain((0..n).map(moved)).collect();
    let shown: Vec<Vec<Shown>> = tested.shown(&tries).into_iter().collect::<Option<_>>()?;
    let of = |at: &usize| {
        let readings = &tested.specimens[*at].readings;
        let own = &shown[0][*at];
        let off = off(tested, *at, own);
        let slopes = DMatrix::from_fn(readings.len(), n, |row, k| {
            // A bound that is kept says nothing.
            let counts = !readings[row].kind.is_censored() || off[row] != 0.0;
            if counts { (shown[k + 1][*at].means[row] - own.means[row]) / step(k) } else { 0.0 }
        });
        let mut covariance = DMatrix::zeros(readings.len(), readings.len());
        for (k, m) in readings.iter().enumerate() {
            let [random, common] = m.errors(0.5);
            let grain =
                if m.kind == MeasuredKind::Rounded { m.resolution * m.resolution / 12.0 } else { 0.0 };
            // Reading and solver agree to no better than this share.
            let least = 0.005 * own.means[k];
            covariance[(k, k)] += random * random + grain + least * least;
            for (j, other) in readings.iter().enumerate() {
                if other.quantity.instrument() == m.quantity.instrument() {
                    covariance[(k, j)] += common * other.errors(0.5)[1];
                }
            }
        }
        // Specimens that are all softer or all stiffer, and stones of their own.
        let level =
            DVector::from_fn(readings.len(), |row, _| (0..law).map(|k| slopes[(row, k)]).sum::<f64>());
        covariance += &level * level.transpose() * (SPECIMEN * SPECIMEN);
        let walls = own.apart.len();
        for apart in own.apart.iter().filter(|_| walls > 1) {
            let apart = DVector::from_column_slice(apart);
            covariance += &apart * apart.transpose() / (walls - 1) as f64 * (1.0 + 1.0 / walls as f64);
        }
        Said { off: DVector::from_vec(off), slopes, covariance }
    };
    Some(specimens.iter().map(of).collect())
}

/// What a specimen's readings are below what its walls show; 0 of a bound that is kept.
fn off(tested: &Tested<'_>, specimen: usize, shown: &Shown) -> Vec<f64> {
    let readings = tested.specimens[specimen].readings.iter().zip(&shown.means);
    let below = readings.map(|(m, mean)| match m.kind {
        MeasuredKind::Below if *mean < m.value => 0.0,
        MeasuredKind::Above if *mean > m.value => 0.0,
        _ => m.value - mean,
    });
    below.collect()
}

/// What all specimens know, and towards where they pull.
fn weighed(said: &[Said]) -> Option<(DMatrix<f64>, DVector<f64>)> {
    let n = said.first()?.slopes.ncols();
    let (mut information, mut towards) = (DMatrix::zeros(n, n), DVector::zeros(n));
    for Said { off, slopes, covariance } in said {
        let root = covariance.clone().cholesky()?;
        information += slopes.transpose() * root.solve(slopes);
        towards += slopes.transpose() * root.solve(off);
    }
    Some((information, towards))
}
