//! The program solved by an interior-point method of its own, which knows that every contact force has a cone to itself.
//!
//! With `x = (lambda, f)`, `A x = -d` the equilibrium, `G x + s = h` the cones and `P` a weight on normal forces, a
//! predictor-corrector step (Mehrotra 1992) with the scaling `W` of Nesterov and Todd (1997) solves
//!
//! ```text
//! P dx + A' dy + G' dz = -r_x      A dx = -r_y      G dx + ds = -r_z      lambda o (W dz + W^-1 ds) = r_c
//! ```
//!
//! as in Vandenberghe (2010, sections 5 and 7). `M = P + G' W^-2 G` has a block of three by three for each contact point,
//! whose inverse is known in closed form; what is left is `A M^-1 A' dy = A M^-1 u + r_y`, see `normal`. The multiplier is
//! kept apart, as its column is full. Every step is refined until equilibrium is exact but for rounding, which normal
//! equations alone do not give.
//!
//! There is no certificate of infeasibility, no pyramid and no force without a cone: for those, and wherever the audit
//! does not accept the answer, clarabel solves the program as a whole.

mod cone;
mod groups;
mod iterate;
mod normal;
mod step;

use clarabel::solver::SolverStatus;

use crate::interrupt;
use crate::math::Vec3;
use crate::solve::limit::interior::groups::Groups;
use crate::solve::limit::interior::iterate::Iterate;
use crate::solve::limit::interior::normal::Normal;
use crate::solve::limit::interior::step::{Scaling, directions};
use crate::solve::limit::loads::Wrench;
use crate::solve::limit::program::{Program, Solved};

/// Steps at most; a wall takes 10 to 30.
const PATIENCE: u32 = 80;
/// Steps without progress after which the best state found is the answer.
const STALLED: u32 = 6;
/// So many times the tolerance are a solution, where rounding ends the search.
const NEARLY: f64 = 100.0;
/// Share of the way to the rim of the cones that a step goes.
const SHORT: f64 = 0.99;

/// The solution; `None` where this method does not apply or loses its way.
pub(super) fn solve(program: &Program) -> Option<Solved> {
    let groups = Groups::of(program)?;
    let mut normal = Normal::new(&groups)?;
    let goal = Goal::of(program);
    let mut now = Iterate::start(&groups, &goal, &mut normal)?;
    let mut best: Option<(f64, Iterate)> = None;
    let (mut iterations, mut stalled) = (0, 0);
    loop {
        let residuals = now.residuals(&groups, &goal);
        let merit = residuals.merit();
        if program.enough && now.lambda >= program.cap && residuals.state() <= program.tolerance {
            now.shrink(program.cap / now.lambda);
            return Some(solved(program, &groups, &now, iterations, 0.0));
        }
        if best.as_ref().is_none_or(|(least, _)| merit < *least) {
            // What gains less than a tenth is no progress.
            stalled =
                if best.as_ref().is_some_and(|(least, _)| merit > 0.9 * least) { stalled + 1 } else { 0 };
            best = Some((merit, now.clone()));
        } else {
            stalled += 1;
        }
        if merit <= program.tolerance || stalled >= STALLED || iterations >= PATIENCE {
            break;
        }
        iterations += 1;
        interrupt::look();
        let Some(scaling) = Scaling::of(&groups, &goal, &now) else { break };
        if !normal.factorise(&groups, &scaling.inverses) {
            break;
        }
        let Some((direction, length)) = directions(&groups, &goal, &normal, &scaling, &now, &residuals)
        else {
            break;
        };
        now.go(&direction, length);
    }
    let (merit, found) = best?;
    merit.is_finite().then(|| solved(program, &groups, &found, iterations, merit))
}

/// What a program asks for, in its units: the largest multiplier, less what normal forces cost.
pub(super) struct Goal {
    /// The multiplier is at most this.
    pub cap: f64,
    /// Cost of normal force.
    pub pressure: f64,
    /// Weight on the squares of the normal forces' distances from given ones.
    pub weight: f64,
    pub near: Vec<f64>,
}

impl Goal {
    fn of(program: &Program) -> Goal {
        let unit = program.blocks.unit;
        let (weight, near) = program.near.map_or((0.0, &[][..]), |near| (near.weight, near.normal));
        Goal {
            // What is enough is reached sooner on the way to more.
            cap: if program.enough { 2.0 * program.cap } else { program.cap },
            pressure: program.pressure,
            weight,
            near: near.iter().map(|n| n / unit).collect(),
        }
    }

    /// The slope of the cost of a normal force.
    fn slope(&self, group: usize, normal: f64) -> f64 {
        self.pressure + self.near.get(group).map_or(0.0, |near| self.weight * (normal - near))
    }
}

/// The solution in SI units.
fn solved(program: &Program, groups: &Groups, found: &Iterate, iterations: u32, merit: f64) -> Solved {
    let blocks = program.blocks;
    let points = program.strengths.len();
    let velocity = |(rigid, moving): (&crate::solve::limit::interfaces::Rigid, &Option<usize>)| {
        let Some(block) = *moving else { return Wrench::default() };
        let [v0, v1, v2, w0, w1, w2] = found.y[block].map(|y| y / blocks.unit);
        Wrench { force: Vec3::new(v0, v1, v2), moment: Vec3::new(w0, w1, w2) / rigid.radius }
    };
    Solved {
        multiplier: found.lambda,
        forces: found.f[..points].iter().map(|f| f.map(|x| x * blocks.unit)).collect(),
        pulls: found.f[points..].iter().map(|f| f[0] * blocks.unit).collect(),
        velocities: blocks.rigid.iter().zip(&groups.moving).map(velocity).collect(),
        iterations,
        status: if merit <= NEARLY * program.tolerance {
            SolverStatus::Solved
        } else {
            SolverStatus::AlmostSolved
        },
    }
}
