//! How surely the wall is verified, where parameters are only known within ranges.

use rayon::prelude::*;

use crate::ensemble::{Failing, Met, Observed, given_points, predicted};
use crate::study::Site;
use crate::terminal::doing::doing;
use crate::terminal::failure::Failure;
use crate::verb::analyse::uncertainty::AskedOfWall;
use crate::verb::analyse::unsure::{Given, SEED};
use crate::verb::analyse::verify::work::checked;

/// Walls of the design where no number is asked for, the fewest that a design has: each is followed through its whole fall.
const WALLS: u64 = 32;

/// What came of the walls of a design.
pub(super) struct Over {
    /// One more wall has a ratio between these with a probability of 90 %.
    pub interval: [Option<f64>; 2],
    /// Walls that are not verified.
    pub failing: Failing,
}

/// The check by displacement of the first limit state over a design; `None` where all parameters are known exactly.
pub(super) fn over(given: &Given<'_>, asked: &[AskedOfWall], site: &Site) -> Result<Option<Over>, Failure> {
    if asked.is_empty() {
        return Ok(None);
    }
    let unsure: Vec<_> = asked.iter().map(|own| own.unsure.clone()).collect();
    let walls = given.arguments.walls.unwrap_or(WALLS);
    let points = given_points(&unsure, given.arguments.seed.unwrap_or(SEED), walls);
    let ratio = |values: &Vec<f64>| {
        let (own, wall) = given.varied(asked, values)?;
        let checked = checked(&own, (&wall, given.settlements), given.fit, site, false);
        Ok(checked
            .map_or(Observed::Nothing, |checked| Observed::Value(checked.verified.nonlinear[0].ratio())))
    };
    let ratios: Result<Vec<Observed>, Failure> =
        doing(&format!("verifying {walls} walls over the ranges"), |_| {
            points.par_iter().map(ratio).collect()
        });
    let ratios = ratios?;
    let mut failing = Failing::default();
    ratios.iter().for_each(|own| {
        failing.take(match own {
            Observed::Value(ratio) if *ratio >= 1.0 => Met::Bears,
            Observed::Value(_) => Met::Fails,
            _ => Met::Unknown,
        });
    });
    Ok(Some(Over { interval: predicted(&ratios), failing }))
}
