//! The angle to which a table can be tilted.
//!
//! Gravity turns from straight down towards a direction `d`; on the wall, `g (cos a down + sin a d)`. With gravity and live load at
//! the angle `a` both scaled by `cos a` the wall bears the multiplier `lambda(a)`, and it falls where `lambda(a) = tan a`. Without
//! cohesion, tensile strength and dead forces the scale does not count and `a = atan(lambda(0))`. Else the angle is bracketed
//! between one at which the wall stands and one at which it falls, by false position (Illinois method, Dowell and Jarratt 1971) safeguarded by bisection.

use std::f64::consts::FRAC_PI_2;

use clarabel::solver::SolverStatus;

use crate::math::{Vec3, atan, cos, tan};
use crate::model::{Level, Outcome};
use crate::solve::limit::analysis::{Analysis, Answer, Applied};
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{Flow, Limit, Loads, PointLoad};

/// Width of the bracket on the angle (rad): 1e-7 degrees.
const BRACKET: f64 = 1e-7 * std::f64::consts::PI / 180.0;
/// Angles that are looked at most.
const PATIENCE: u32 = 100;

/// A look at one angle.
struct Tried {
    /// The angle (rad).
    angle: f64,
    /// `atan(lambda(a)) - a`: positive where the wall stands; a right angle below where it bears no load at all.
    margin: f64,
    answer: Answer,
    applied: Applied,
}

impl Analysis {
    /// The largest tilt of the table towards `direction` (horizontal, any length but zero): the angle is
    /// `Level::Tilt` of the outcome, its tangent the multiplier. `dead` forces keep their direction in the wall's axes,
    /// which turn with the table.
    pub fn tilt(&self, direction: Vec3, dead: &[PointLoad]) -> Limit {
        let mut loads = Loads::lateral(direction);
        loads.points = dead.to_vec();
        let spent = match self.stands_at_rest(&self.applied(&loads), Level::Tilt(0.0)) {
            Ok(spent) => spent,
            Err(limit) => return *limit,
        };
        let tried = self.try_angle(0.0, &loads);
        if self.strengths.iter().all(Strength::is_cone) && dead.is_empty() {
            return self.finish(tried, spent, FRAC_PI_2);
        }
        self.bracket(tried, &loads, spent)
    }

    /// The multiplier with gravity and live load scaled to what they are at an angle.
    fn try_angle(&self, angle: f64, loads: &Loads) -> Tried {
        let scale = cos(angle);
        let scaled =
            Loads { dead: loads.dead * scale, live: loads.live * scale, points: loads.points.clone() };
        let applied = self.applied(&scaled);
        let answer = self.largest(&applied, &self.strengths, tan(self.settings.largest_tilt));
        let nothing = answer.solved.status == SolverStatus::PrimalInfeasible;
        let margin = if nothing { -FRAC_PI_2 } else { atan(answer.solved.multiplier) - angle };
        Tried { angle, margin, answer, applied }
    }

    /// Closes in on the angle at which the margin vanishes, from a first try at rest.
    fn bracket(&self, first: Tried, loads: &Loads, mut spent: u32) -> Limit {
        // At the largest tilt the multiplier is capped at its tangent: the margin is at most zero there.
        let end = self.try_angle(self.settings.largest_tilt, loads);
        spent += first.answer.solved.iterations;
        if end.answer.is_good() && end.answer.capped {
            return self.finish(end, spent, FRAC_PI_2);
        }
        let (mut low, mut high) = ((first.angle, first.margin), (end.angle, end.margin.min(-BRACKET)));
        let mut last = end;
        let mut kept_high = 0;
        for trial in 0..PATIENCE {
            let between = low.0 + (high.0 - low.0) * low.1 / (low.1 - high.1);
            let usable = between > low.0 && between < high.0 && trial % 3 != 2;
            let angle = if usable { between } else { 0.5 * (low.0 + high.0) };
            spent += last.answer.solved.iterations;
            last = self.try_angle(angle, loads);
            if last.margin.abs() <= 0.5 * BRACKET || high.0 - low.0 <= BRACKET {
                break;
            }
            if last.margin > 0.0 {
                low = (angle, last.margin);
                kept_high += 1;
                if kept_high > 1 {
                    high.1 *= 0.5;
                }
            } else {
                high = (angle, last.margin);
                kept_high = 0;
            }
        }
        if !last.answer.is_good() {
            spent += last.answer.solved.iterations;
            last = self.try_angle(low.0, loads);
        }
        let angle = last.angle;
        self.finish(last, spent, angle)
    }

    /// The result from the look at the angle of collapse, or at any angle where the scale does not count; `most` is an angle
    /// beyond which the wall is known not to stand.
    fn finish(&self, tried: Tried, spent: u32, most: f64) -> Limit {
        let Tried { answer, applied, .. } = tried;
        let flow = self.settings.flow;
        // It stands at rest: what is below 0 is so by the solver's accuracy.
        let found = answer.solved.multiplier.min(tan(most)).max(0.0);
        let level: fn(f64) -> Level = |lambda| Level::Tilt(atan(lambda));
        if !answer.is_good() {
            let outcome = answer.not_converged(level(found));
            return answer.into_limit(outcome, found, flow, spent);
        }
        let cap = tan(self.settings.largest_tilt);
        if answer.capped {
            return answer.into_limit(Outcome::Equilibrium, cap, flow, spent);
        }
        match flow {
            Flow::Associative => {
                answer.into_limit(Outcome::Collapsed { at: level(found) }, found, flow, spent)
            }
            Flow::NonAssociative => self.without_dilatancy(&applied, answer, spent, cap, level),
        }
    }
}
