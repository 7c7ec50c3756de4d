//! The path of equilibria followed through its limit point, by arc length (E. Riks, 1979; M. A. Crisfield, 1981).
//!
//! Where the load can grow no further the path turns: further along it the wall leans out more and bears less. Unknown are
//! the positions and the level of the load, and one more equation says how far a step goes along a direction `t`:
//!
//! ```text
//! r(x, l) = 0,   t . W (x - x0) = s        K dx = r + q dl,   q = dr/dl        W: shares of the mass, so s is a mean displacement
//! ```

use crate::solve::bodies::Body;
use crate::solve::implicit::Equilibrium;
use crate::solve::implicit::arc::Arc;
use crate::solve::implicit::newton::Newton;
use crate::solve::joints::Anchor;
use crate::solve::system::System;
use crate::solve::{Ahead, Equilibrate, Followed, Way};

/// Steps along the path before the search is given up.
const MOST_STEPS: u32 = 80;
/// A step that does not converge is halved this often before the search is given up.
const MOST_HALVINGS: u32 = 6;
/// Growth of a step after one that converged within so many iterations.
const GROWTH: f64 = 1.6;
const GOOD: u32 = 8;
/// First step as a share of the way to the level asked for, and longest one as a share of how far a fall is followed.
const FIRST: f64 = 0.5;
const LONGEST: f64 = 0.25;
/// A path that is lost on the way down has been seen for this share of how far a fall is followed, or tells nothing: walls
/// that slide chatter from joint to joint.
const ENOUGH: f64 = 0.2;
/// Unbalanced force ratio along the path, which tells where it turns; the state at rest that comes of it is solved for anew.
const ROUGH: f64 = 1e-5;
/// Share of the bracket by which the level must rise or fall to be more than the scatter of states that were found: a wall that
/// slides moves on and on under the same load.
const FLAT: f64 = 0.05;
/// A step lies on the path when the level changes by no more than so many times what the steeper of the slopes at its ends makes
/// of its length, beside the way to the level asked for.
const STEEPER: f64 = 2.0;
/// Where the highest state cannot be brought to rest at its own level, it is at one so far below it, in brackets.
const BELOW: [f64; 3] = [0.0, 0.25, 0.5];
/// After a peak that is not bracketed yet, steps are shortened to this share of the one that passed it.
const SHORTER: f64 = 0.4;
/// A peak is bracketed to this share of the bracket, so that the levels below the highest state lie within it.
const PEAKED: f64 = 0.5;

/// States that prove unstable on the way up, before the search is given up.
const MOST_DOUBTS: u32 = 4;

/// A state on the path.
#[derive(Clone)]
pub(super) struct State<'a> {
    pub at: Equilibrium<'a>,
    pub level: f64,
    ratio: f64,
    /// Direction in which the path goes on, of unit length.
    along: Vec<f64>,
    /// Growth of the level per length that way.
    pub slope: f64,
    stable: bool,
    /// Length of the step that led here, and its iterations.
    pub length: f64,
    pub iterations: u32,
}

impl<'a> Equilibrium<'a> {
    /// Follows the path from this state at rest: up to the level that is asked for, or through a limit point below it as far
    /// down as tells a fall from a jump. `None` where the path is lost, or loses its stability without a limit point.
    pub(super) fn followed(&self, ahead: &Ahead<'_>) -> Option<Followed<Self>> {
        let mut highest = State::at_rest(self, ahead)?;
        let longest = LONGEST * ahead.far;
        let mut length = (FIRST * (ahead.to - ahead.from) / highest.slope).min(longest);
        let mut state = highest.clone();
        // The state from which on the path is flat.
        let mut flat = highest.clone();
        let scatter = FLAT * ahead.bracket;
        // The peak's upper bound, once the path has passed it.
        let mut above = None;
        let mut doubts = 0;
        for _ in 0..MOST_STEPS {
            let Some(next) = state.next(ahead, length) else {
                return Some(state.fallen(highest, ahead, above?, ENOUGH * ahead.far)?.since(self));
            };
            if next.level > flat.level + scatter {
                flat = next.clone();
            } else if next.level >= flat.level - scatter && next.at.moved_since(&flat.at) > ahead.far {
                let above = flat.level + scatter;
                return Some(next.slid(flat, ahead, above)?.since(self));
            }
            if next.level > highest.level && next.slope > 0.0 {
                // One sign alone may come from a sub-contact at the corner of its law, and two from much that slips: whether
                // it is stable is asked of the state at rest.
                if !next.stable && !state.stable && next.at_rest_near(ahead, next.level).is_none() {
                    if doubts == MOST_DOUBTS {
                        return None;
                    }
                    // A long step may have leapt over the peak.
                    doubts += 1;
                    length = SHORTER * next.length;
                    continue;
                }
                // What had been passed before was a jump.
                above = None;
                highest = next.clone();
                if highest.level >= ahead.to {
                    let there = state.at_level(ahead).or_else(|| {
                        let (rest, level) = highest.at_rest_near(ahead, ahead.to)?;
                        Some(rest.ended(level, Way::Stands))
                    });
                    return Some(there?.since(self));
                }
            }
            let is_past = next.slope <= 0.0 || next.level < state.level - scatter;
            if is_past && above.is_none() {
                let peak = state.peak(&next);
                if peak - highest.level > PEAKED * ahead.bracket {
                    // Once more from before the peak, in shorter steps.
                    length = SHORTER * next.length;
                    state = highest.clone();
                    continue;
                }
                above = Some(peak);
            }
            if let Some(above) = above
                && next.at.moved_since(&highest.at) > ahead.far
            {
                return Some(next.fallen(highest, ahead, above, ahead.far)?.since(self));
            }
            let growth = if next.iterations <= GOOD { GROWTH } else { 1.0 };
            length = (growth * next.length).min(longest);
            state = next;
        }
        None
    }

    /// Largest displacement of a block's centroid since another state (m).
    pub(super) fn moved_since(&self, other: &Self) -> f64 {
        let (now, then) = (&self.assembly().bodies.all, &other.assembly().bodies.all);
        let square = |(a, b): (&Body, &Body)| (a.position - b.position).norm_squared();
        now.iter().zip(then).map(square).fold(0.0, f64::max).sqrt()
    }

    /// Goes a length along a direction. Contacts are found anew before, where the step that led here went far enough: what is
    /// out of balance by that is brought back by the step itself. A solve of its own would let all that slips stick again,
    /// and tell nothing of how the path goes on.
    fn step_along(&mut self, ahead: &Ahead<'_>, from: f64, along: &[f64], length: f64) -> Option<Arc> {
        if self.assembly().has_moved() {
            self.assembly_mut().refresh();
        }
        let anchors = self.assembly().joints.anchors(&self.assembly().bodies.all);
        let mut newton = self.newton(&anchors);
        let ratio = ROUGH.max(newton.settings.unbalanced_ratio);
        let reached = newton.along(ahead.loads, from, along, length, ratio)?;
        newton.onward(ahead.loads, reached)
    }

    /// Newton's method on the assembly as it stands.
    fn newton<'s>(&'s mut self, anchors: &'s [Anchor]) -> Newton<'s, 'a> {
        let (assembly, system, settings, effort, loose) = self.parts();
        if !system.fits(&assembly.joints) {
            *system = System::new(&assembly.bodies.all, &assembly.joints);
        }
        Newton { assembly, system, anchors, settings, effort, loose }
    }
}

impl<'a> Followed<Equilibrium<'a>> {
    /// With the steps counted from a state on.
    fn since(self, start: &Equilibrium<'a>) -> Self {
        Followed { steps: self.steps - start.effort().steps, ..self }
    }
}

impl<'a> State<'a> {
    /// At rest where the path begins.
    pub fn at_rest(at: &Equilibrium<'a>, ahead: &Ahead<'_>) -> Option<Self> {
        let mut at = at.clone();
        let here = at.step_along(ahead, ahead.from, &[], 0.0)?;
        Some(State::of(at, here))
    }

    fn of(at: Equilibrium<'a>, arc: Arc) -> Self {
        let Arc { level, ratio, along, slope, stable, length, iterations } = arc;
        State { at, level, ratio, along, slope, stable, length, iterations }
    }

    /// At rest at the very level that was asked for, from a state not far below it.
    fn at_level(&self, ahead: &Ahead<'_>) -> Option<Followed<Equilibrium<'a>>> {
        let mut at = self.at.clone();
        let (gravity, factor) = (ahead.loads)(ahead.to);
        at.set_loads(gravity, factor);
        let (solved, ratio) = at.solve();
        let steps = at.effort().steps;
        // No further than a step along the path goes: else it is another equilibrium.
        let near = solved && at.moved_since(&self.at) <= LONGEST * ahead.far;
        near.then_some(Followed { rest: at, level: ahead.to, ratio, steps, way: Way::Stands })
    }

    /// The fall that began at the highest state, seen as far as here; `None` where that is not far enough (m).
    fn fallen(
        self,
        highest: State<'a>,
        ahead: &Ahead<'_>,
        above: f64,
        enough: f64,
    ) -> Option<Followed<Equilibrium<'a>>> {
        if self.level >= highest.level || self.at.moved_since(&highest.at) <= enough {
            return None;
        }
        self.slid(highest, ahead, above)
    }

    /// The fall of a wall that has slid as far as here, under the load of a state where that began.
    fn slid(self, from: State<'a>, ahead: &Ahead<'_>, above: f64) -> Option<Followed<Equilibrium<'a>>> {
        let steps = self.at.effort().steps;
        let (rest, level) = from.at_rest_near(ahead, above)?;
        let bodies = Box::new(self.at.into_assembly().bodies);
        let way = Way::Falls { above, at: self.level, ratio: self.ratio, bodies };
        Some(Followed { steps, ..rest.ended(level, way) })
    }

    /// The state brought to rest, contacts found anew, at its own level or a little below it, within a bracket of `above`.
    fn at_rest_near(&self, ahead: &Ahead<'_>, above: f64) -> Option<(Self, f64)> {
        let levels = BELOW.map(|brackets| self.level - brackets * ahead.bracket);
        levels
            .into_iter()
            .filter(|level| *level >= ahead.from && above - level <= ahead.bracket * (1.0 + 1e-9))
            .find_map(|level| {
                let mut at = self.at.clone();
                let (gravity, factor) = (ahead.loads)(level);
                at.set_loads(gravity, factor);
                let (solved, ratio) = at.solve();
                (solved && at.moved_since(&self.at) <= ahead.far)
                    .then(|| (State { at, ratio, ..self.clone() }, level))
            })
    }

    fn ended(self, level: f64, way: Way) -> Followed<Equilibrium<'a>> {
        Followed { level, ratio: self.ratio, steps: self.at.effort().steps, rest: self.at, way }
    }

    /// The level at which the tangents of the path here and at a later state, past the peak, meet: an upper bound of a peak
    /// that is rounded like a hill.
    fn peak(&self, after: &State<'_>) -> f64 {
        let (rise, gone) = (self.slope.max(0.0), after.length);
        let highest = self.level.max(after.level);
        // At a corner of the path the slope behind it says nothing of the way to it.
        let fall = if after.slope < 0.0 { -after.slope } else { f64::INFINITY };
        if fall.is_infinite() || rise + fall <= 0.0 {
            return highest.max(self.level + rise * gone);
        }
        let meet = ((after.level - self.level + fall * gone) / (rise + fall)).clamp(0.0, gone);
        (self.level + rise * meet).max(highest)
    }

    /// Whether a state that was found lies on the path from here. A block that slides bears the same load wherever it is, and
    /// so the level can come out as anything: a tilt by whole turns of the platform. Levels lie between none and the one that
    /// is asked for, give or take the way to that.
    fn leads_to(&self, found: &Arc, ahead: &Ahead<'_>) -> bool {
        let way = ahead.to - ahead.from;
        let steepest = f64::max(self.slope.abs(), found.slope.abs());
        (-way..=ahead.to + way).contains(&found.level)
            && (found.level - self.level).abs() <= STEEPER * steepest * found.length + way
    }

    /// The next state along the path; a step that does not converge is halved.
    pub fn next(&self, ahead: &Ahead<'_>, mut length: f64) -> Option<Self> {
        for _ in 0..=MOST_HALVINGS {
            let mut at = self.at.clone();
            let found = at.step_along(ahead, self.level, &self.along, length);
            if let Some(arc) = found.filter(|arc| self.leads_to(arc, ahead)) {
                return Some(State::of(at, arc));
            }
            length *= 0.5;
        }
        None
    }
}
