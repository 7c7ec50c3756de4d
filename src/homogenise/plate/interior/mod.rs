//! The program solved by an interior-point method of its own, which knows that every place has its stresses and planes to itself.
//!
//! With the stresses `x` of a place, its slacks `s` and flows `z` of the planes (normals `F`, bounds `b`), its rates `B v`, the
//! multiplier and the loads' powers `l` and `d`, an optimum has
//!
//! ```text
//! F x + s = b     sum of B' x = d + lambda l     B v = F' z     l . v = 1     s z = 0     s >= 0     z >= 0
//! ```
//!
//! A predictor-corrector step (Mehrotra 1992) with steps of their own for state (lambda, x, s) and mechanism (v, z) leaves for every
//! place `H = F' (z/s) F`, six by six, and for the velocities `sum of B' H^-1 B`, see `normal`. A general solver has a row for every
//! plane at every place instead, and takes four times as long for a hundred facets.
//!
//! There is no certificate that a program has no solution: for that, and wherever this method loses its way, clarabel solves it.

mod iterate;
mod normal;
mod problem;
mod step;

use super::program::{Program, Solved, TOLERANCE};
use crate::interrupt;

use iterate::Iterate;
use normal::Normal;
use problem::Problem;

/// Steps at most; a wall takes 10 to 60.
const PATIENCE: u32 = 100;
/// Steps without progress after which the best state found is the answer.
const STALLED: u32 = 8;
/// So many times the tolerance are a solution, where rounding ends the search.
const NEARLY: f64 = 10.0;

/// The solution; `None` where this method loses its way, as it does where there is none.
pub(super) fn solve(program: &Program) -> Option<Solved> {
    let problem = Problem::of(program);
    if problem.count == 0 {
        return None;
    }
    let mut normal = Normal::new(&problem)?;
    let mut now = Iterate::start(&problem, &mut normal)?;
    let mut best: Option<(f64, f64, Iterate)> = None;
    let (mut iterations, mut stalled) = (0, 0);
    loop {
        let missed = now.residuals(&problem);
        let merit = missed.merit(&problem, &now);
        if best.as_ref().is_none_or(|(least, ..)| merit < *least) {
            stalled = 0;
            best = Some((merit, missed.kinematic, now.clone()));
        } else {
            stalled += 1;
        }
        let enough = merit <= TOLERANCE || stalled >= STALLED || iterations >= PATIENCE;
        if enough || !normal.factorise(&problem, &now.weights()) {
            break;
        }
        iterations += 1;
        interrupt::look();
        let (direction, lengths) = step::step(&problem, &normal, &now, &missed);
        now.go(&direction, lengths);
    }
    let (merit, kinematic, found) = best?;
    (merit <= NEARLY * TOLERANCE).then(|| solved(program, &found, kinematic, iterations))
}

/// The solution in SI units.
fn solved(program: &Program, found: &Iterate, kinematic: f64, iterations: u32) -> Solved {
    let unit = program.units.stress();
    let (places, ropes) = found.stresses.split_at(program.places.len());
    Solved {
        multiplier: kinematic,
        gap: kinematic - found.lambda,
        velocities: found.velocities.iter().map(|v| v / program.units.force).collect(),
        stresses: places.iter().map(|s| std::array::from_fn(|c| s[c] * unit[c])).collect(),
        ropes: ropes.iter().map(|s| s[0] * program.units.force).collect(),
        iterations,
    }
}
