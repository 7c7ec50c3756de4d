//! The most likely law, and what is left open about it.

use nalgebra::{DMatrix, DVector};

use crate::critic::joint_law::tested::{KNOTS, Shown, Tested, Try};
use crate::study::MeasuredKind;

/// Standard deviation of the second differences of the logarithm of the compliance, beforehand.
const BENT: f64 = 1.0;
/// And of its level: as good as free. A tighter one leaks into stresses that were not seen.
const LEVEL: f64 = 20.0;
/// Specimens of a family differ by so much in stiffness (logarithm): the root of the mean square of what a diagnosis takes for its standard
/// deviation, half-normal with 0.2.
pub const SPECIMEN: f64 = 0.2;
/// Steps of finite differences: of the logarithm of the compliance, and of scores.
const STEPS: [f64; 2] = [0.1, 0.3];
/// At most so many rounds with few walls, so many with all of them, and so many for some of the specimens; and so many halvings in one.
const ROUNDS: usize = 8;
const LAST_ROUNDS: usize = 3;
const SOME_ROUNDS: usize = 2;
const HALVINGS: u32 = 3;
/// Walls of a family in the first rounds, and in the last: as many as there are.
const FEW: u64 = 2;
const ALL: u64 = u64::MAX;
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

/// What walls show at some unknowns, and how that changes with them, by specimen.
#[derive(Clone, Debug)]
struct Local {
    freedom: Freedom,
    unknowns: DVector<f64>,
    shown: Vec<Shown>,
    slopes: Vec<DMatrix<f64>>,
}

/// The most likely law.
#[derive(Clone, Debug)]
pub struct Fit {
    local: Local,
    /// The unknowns: of the law first, then the scores.
    pub unknowns: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// What the readings alone know of them.
    pub information: DMatrix<f64>,
}

impl Local {
    /// By finite differences; `None` where no walls can be simulated.
    fn at(tested: &Tested<'_>, freedom: Freedom, unknowns: &DVector<f64>, most: u64) -> Option<Local> {
        let law = freedom.of_law();
        let step = |k: usize| if k < law { STEPS[0] } else { STEPS[1] };
        let moved = |k: usize| {
            let mut own = unknowns.clone();
            own[k] += step(k);
            freedom.tried(&own)
        };
        let tries: Vec<Try> =
            std::iter::once(freedom.tried(unknowns)).chain((0..unknowns.len()).map(moved)).collect();
        let mut all: Vec<Vec<Shown>> = tested.shown(&tries, most).into_iter().collect::<Option<_>>()?;
        let moved = all.split_off(1);
        let shown = all.pop()?;
        let slopes = shown.iter().enumerate().map(|(at, own)| {
            let change = |row: usize, k: usize| (moved[k][at].means[row] - own.means[row]) / step(k);
            DMatrix::from_fn(own.means.len(), unknowns.len(), change)
        });
        Some(Local { freedom, unknowns: unknowns.clone(), slopes: slopes.collect(), shown })
    }

    /// At other unknowns, the slopes corrected by what the walls show there (Broyden 1965): no wall is simulated for slopes.
    fn moved(&self, unknowns: DVector<f64>, shown: Vec<Shown>) -> Local {
        let by = &unknowns - &self.unknowns;
        let each = self.slopes.iter().zip(self.shown.iter().zip(&shown));
        let slopes = each.map(|(slopes, (before, after))| {
            let changed =
                DVector::from_column_slice(&after.means) - DVector::from_column_slice(&before.means);
            slopes + (changed - slopes * &by) * by.transpose() / by.norm_squared().max(f64::MIN_POSITIVE)
        });
        Local { freedom: self.freedom, slopes: slopes.collect(), unknowns, shown }
    }

    /// A step of Gauss and Newton for some of the specimens, and what it gains; `None` where none gains anything.
    fn stepped(&self, tested: &Tested<'_>, specimens: &[usize], most: u64) -> Option<(Local, f64)> {
        let (prior, middle) = (self.freedom.prior(), self.freedom.middle(tested));
        let said = said(tested, self, specimens);
        let (information, towards) = weighed(&said)?;
        let away = &self.unknowns - &middle;
        let step = (&information + &prior).cholesky()?.solve(&(towards - &prior * &away));
        let longest = step.amax();
        let step = if longest > FURTHEST { step * (FURTHEST / longest) } else { step };
        let roots: Vec<_> =
            said.iter().map(|said| said.covariance.clone().cholesky()).collect::<Option<_>>()?;
        let value = |at: &DVector<f64>, shown: &[Shown]| {
            let misfit = specimens.iter().zip(&roots).map(|(&specimen, root)| {
                let off = DVector::from_vec(off(tested, specimen, &shown[specimen]));
                off.dot(&root.solve(&off))
            });
            let away = at - &middle;
            0.5 * (misfit.sum::<f64>() + away.dot(&(&prior * &away)))
        };
        let before = value(&self.unknowns, &self.shown);
        (0..HALVINGS).find_map(|halvings| {
            let unknowns = &self.unknowns + &step / f64::from(1u32 << halvings);
            let shown = tested.shown(&[self.freedom.tried(&unknowns)], most).pop()??;
            let gained = before - value(&unknowns, &shown);
            (gained > 0.0).then(|| (self.moved(unknowns, shown), gained))
        })
    }

    /// Steps until one gains too little, so many at most.
    fn settled(mut self, tested: &Tested<'_>, specimens: &[usize], most: u64, rounds: usize) -> Local {
        for _ in 0..rounds {
            let Some((next, gained)) = self.stepped(tested, specimens, most) else { break };
            self = next;
            if gained < ENOUGH {
                break;
            }
        }
        self
    }

    /// What some of the specimens leave open here.
    fn fit(self, tested: &Tested<'_>, specimens: &[usize]) -> Option<Fit> {
        let (information, _) = weighed(&said(tested, &self, specimens))?;
        let covariance = (&information + &self.freedom.prior()).cholesky()?.inverse();
        Some(Fit { unknowns: self.unknowns.clone(), local: self, covariance, information })
    }
}

impl Fit {
    /// Of all specimens, from a first guess: with few walls as far as these lead, then with all, and slopes of their own. `None` where no
    /// walls can be simulated.
    pub fn of(tested: &Tested<'_>, freedom: Freedom, start: &DVector<f64>) -> Option<Fit> {
        let all: Vec<usize> = (0..tested.specimens.len()).collect();
        let few = Local::at(tested, freedom, start, FEW)?.settled(tested, &all, FEW, ROUNDS);
        let mut local = Local::at(tested, freedom, &few.unknowns, ALL)?;
        for _ in 0..LAST_ROUNDS {
            let Some((next, gained)) = local.stepped(tested, &all, ALL) else { break };
            if gained < ENOUGH {
                local = next;
                break;
            }
            local = Local::at(tested, freedom, &next.unknowns, ALL)?;
        }
        local.fit(tested, &all)
    }

    /// Of some of the specimens: their law is near that of all, and so are its slopes.
    pub fn of_some(&self, tested: &Tested<'_>, specimens: &[usize]) -> Option<Fit> {
        self.local.clone().settled(tested, specimens, ALL, SOME_ROUNDS).fit(tested, specimens)
    }

    /// The logarithm of the density that it gives to the readings of a specimen that it has not seen; `None` where it cannot tell.
    pub fn predicts(&self, tested: &Tested<'_>, specimen: usize) -> Option<f64> {
        let said = said(tested, &self.local, &[specimen]).pop()?;
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
        self.local.freedom.tried(&self.unknowns).ln_compliance
    }

    /// As a try.
    pub fn tried(&self) -> Try {
        self.tried_at(&self.unknowns)
    }

    /// Other unknowns as a try.
    pub fn tried_at(&self, unknowns: &DVector<f64>) -> Try {
        self.local.freedom.tried(unknowns)
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
        let scores = other.local.freedom.of_law();
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
fn said(tested: &Tested<'_>, local: &Local, specimens: &[usize]) -> Vec<Said> {
    let law = local.freedom.of_law();
    let of = |at: &usize| {
        let readings = &tested.specimens[*at].readings;
        let own = &local.shown[*at];
        let off = off(tested, *at, own);
        let mut slopes = local.slopes[*at].clone();
        for (row, m) in readings.iter().enumerate() {
            // A bound that is kept says nothing.
            if m.kind.is_censored() && off[row] == 0.0 {
                slopes.row_mut(row).fill(0.0);
            }
        }
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
    specimens.iter().map(of).collect()
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
