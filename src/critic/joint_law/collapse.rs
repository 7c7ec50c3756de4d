//! The collapse angle that a learnt law predicts of a wall that was not tested.

use nalgebra::DVector;
use rayon::prelude::*;

use crate::critic::joint_law::fit::{Fit, SPECIMEN};
use crate::critic::joint_law::learnt::Known;
use crate::critic::joint_law::tested::{KNOTS, Tested};
use crate::random::Streams;
use crate::random::standard_normal::quantile;
use crate::stats;

/// Draws of the law, each with stones of its own.
const DRAWS: u64 = 60;
/// Of these so many must have been solved.
const LEAST: usize = 40;
const SEED: u64 = 23;
/// Walls of other stones than those that the law was fitted with.
const FIRST_MEMBER: u64 = 1000;

/// The median and the 90 % interval of the collapse angle (rad) of one more wall of each family, over what is left open of the law, of
/// friction and of the specimen's own stiffness, and over its stones; 0 for a wall that does not stand. `None` where too few could be
/// solved.
pub(super) fn collapse(tested: &Tested<'_>, fit: &Fit) -> Vec<Option<Known>> {
    let Some(root) = fit.covariance.clone().cholesky() else { return vec![None; tested.families.len()] };
    let root = root.l();
    let drawn = |family: usize, k: u64| {
        let mut stream = Streams::new(SEED, k).of("law of one more wall");
        let mut normal = || quantile(stream.uniform());
        let scores = DVector::from_fn(fit.unknowns.len(), |_, _| normal());
        let mut unknowns = &fit.unknowns + &root * scores;
        let own = SPECIMEN * normal();
        unknowns.rows_mut(0, KNOTS).add_scalar_mut(own);
        tested.collapse(family, &fit.tried_at(&unknowns), FIRST_MEMBER + k)
    };
    let of = |family: &usize| {
        let all: Vec<f64> = (0..DRAWS).into_par_iter().filter_map(|k| drawn(*family, k)).collect();
        let at = |p: f64| stats::quantile(&all, p).filter(|_| all.len() >= LEAST);
        Some(Known { median: at(0.5)?, interval: [at(0.05)?, at(0.95)?] })
    };
    tested.families.iter().map(of).collect()
}
