//! The questions that limit analysis answers: does it stand, and how much can it bear?

use clarabel::solver::SolverStatus;

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Level, Outcome, Wall};
use crate::solve::Tie;
use crate::solve::limit::audit::audit;
use crate::solve::limit::collapse::{mechanism, thrust};
use crate::solve::limit::interfaces::{Blocks, Rope};
use crate::solve::limit::interior;
use crate::solve::limit::loads::{When, Wrench};
use crate::solve::limit::program::{Program, Solved, axes};
use crate::solve::limit::strength::Strength;
use crate::solve::limit::{Accuracy, BlockMotion, Cone, Flow, Limit, Loads, Settings, Thrust};

/// A wall stands when it bears all but this share of its dead loads: the accuracy of the solver.
const ALL: f64 = 1.0 - 1e-6;

/// Miss of an answer with which no better one is looked for.
const EXACT: f64 = 1e-8;

/// An assembly of rigid blocks whose joints have been found: to be asked for many loads.
///
/// ```
/// use pirca::contact;
/// use pirca::generate::canonical;
/// use pirca::law::{CohesionAfterSlip, Coulomb, NormalLaw, Sampling};
/// use pirca::math::{Vec3, degrees};
/// use pirca::solve::limit::{Analysis, Settings};
///
/// let dry = Coulomb {
///     normal: NormalLaw::Linear { kn: 1e9 },
///     ks: 5e8,
///     tan_phi: 0.6,
///     cohesion: 0.0,
///     tension: 0.0,
///     compressive_strength: None,
///     cohesion_after_slip: CohesionAfterSlip::Kept,
///     weakening: None,
///     sampling: Sampling::Area,
///     bonded: false,
/// };
/// let wall = canonical::running_bond(3, 2).with_base();
/// let contact = contact::Settings::for_size(0.1, [2, 2]);
/// let tilted = Analysis::new(&wall, &dry, contact, Settings::default()).tilt(Vec3::y(), &[]);
/// // Three courses of 0.375 / 9 m topple over an edge at atan(0.114 / 0.125) = 42.4 degrees, but slide at atan(0.6).
/// assert!((degrees(pirca::math::atan(tilted.multiplier)) - 30.9638).abs() < 1e-4);
/// ```
#[derive(Clone, Debug)]
pub struct Analysis {
    pub(crate) blocks: Blocks,
    pub(crate) strengths: Vec<Strength>,
    pub(crate) settings: Settings,
}

/// Whether a statically admissible state exists.
#[derive(Clone, Debug, PartialEq)]
pub struct Standing {
    /// Whether the blocks can stand where they are; `None` when the solver did not find out.
    pub stands: Option<bool>,
    /// The largest share of the dead loads that can be borne, at most 1. Without cohesion 0 or 1.
    pub share: f64,
    /// How the blocks start to move when they do not stand, see [`Limit::mechanism`]; empty when they do.
    pub mechanism: Vec<BlockMotion>,
    /// The joint forces of one admissible state.
    pub thrust: Vec<Thrust>,
    /// What the state is worth.
    pub accuracy: Accuracy,
    /// Iterations of the conic solver.
    pub iterations: u32,
    /// How the conic solver ended, in its words.
    pub status: String,
}

/// A program's solution with all that is reported of it.
pub(crate) struct Answer {
    pub solved: Solved,
    pub accuracy: Accuracy,
    pub mechanism: Vec<BlockMotion>,
    pub thrust: Vec<Thrust>,
    /// Largest excess of the forces over the strengths of the joints' own laws, over the blocks' mean weight.
    pub excess: f64,
    /// Whether the multiplier reached the cap.
    pub capped: bool,
}

impl Answer {
    /// By how much forces and mechanism miss what they should be: the largest of the audit's relative numbers, those of
    /// the mechanism only where there is one.
    fn miss(&self) -> f64 {
        let (a, solved) = (&self.accuracy, &self.solved);
        let gap = a.gap.abs() / solved.multiplier.abs().max(1.0);
        let all = [a.residual, a.excess, a.incompatibility, gap];
        let counted = if self.capped { &all[..2] } else { &all[..] };
        // What is no number is no answer.
        counted.iter().fold(0.0, |most: f64, x| if x.is_nan() { f64::INFINITY } else { most.max(*x) })
    }

    /// Whether forces and mechanism can be believed.
    pub fn is_good(&self) -> bool {
        if self.capped {
            self.accuracy.accepts_state()
        } else {
            self.accuracy.accepts_mechanism(self.solved.multiplier)
        }
    }

    /// The outcome when the solver's answer cannot be believed.
    pub fn not_converged(&self, at: Level) -> Outcome {
        let a = &self.accuracy;
        Outcome::NotConverged {
            at,
            unbalanced_ratio: a.residual,
            why: format!(
                "conic solver: {:?}; gap {:.1e}, excess over the strength {:.1e}, breach of the flow rule {:.1e}",
                self.solved.status, a.gap, a.excess, a.incompatibility
            ),
        }
    }

    /// The result with this outcome.
    pub fn into_limit(mut self, outcome: Outcome, multiplier: f64, flow: Flow, before: u32) -> Limit {
        if matches!(outcome, Outcome::Equilibrium | Outcome::Unbounded) {
            // What a solver leaves among its velocities where nothing collapses is no mechanism.
            self.mechanism.fill(BlockMotion::default());
        }
        let a = &self.accuracy;
        let verified =
            a.accepts_state() && a.incompatibility <= EXACT && a.kinematic >= self.solved.multiplier;
        let lost = matches!(outcome, Outcome::NotConverged { .. });
        Limit {
            between: (lost && verified).then(|| [self.solved.multiplier.max(0.0), a.kinematic]),
            outcome,
            multiplier,
            flow,
            mechanism: self.mechanism,
            thrust: self.thrust,
            accuracy: self.accuracy,
            iterations: before + self.solved.iterations,
            fixed_point: None,
        }
    }
}

/// Loads as the program takes them.
pub(crate) struct Applied {
    pub dead: Vec<Wrench>,
    pub live: Vec<Wrench>,
    pub axes: Vec<[Vec3; 2]>,
}

impl Analysis {
    /// Finds the joints of the blocks where the wall has them: what is built apart carries nothing, see
    /// [`contact::Settings::closed`], as no gap closes in a mechanism. `laws` gives friction, cohesion, tensile strength and bond;
    /// stiffnesses play no part.
    pub fn new(wall: &Wall, laws: &dyn JointLaws, contact: contact::Settings, settings: Settings) -> Self {
        if let Cone::Linearised { sides } = settings.cone {
            crate::check!(sides >= 4 && sides % 2 == 0, "a friction pyramid of {sides} sides");
        }
        let blocks = Blocks::of(wall, laws, &contact);
        let strengths = blocks.points().map(|(joint, point)| Strength::of(&joint.law, point.area)).collect();
        Analysis { blocks, strengths, settings }
    }

    /// The same blocks with ties, which are ropes that do not stretch: each bears any pull. Stiffness, pretension and slack
    /// play no part; a rope that is slack at first holds as if it were taut, so that the multiplier stays an upper bound.
    pub fn with_ties(mut self, ties: &[Tie]) -> Self {
        let (origin, leads) = (self.blocks.origin, &self.blocks.leads);
        let rope = |t: &Tie| Rope {
            block: leads[t.body],
            at: t.point - origin,
            direction: t.direction,
            two_sided: t.two_sided,
        };
        self.blocks.ties = ties.iter().map(rope).collect();
        self
    }

    /// Number of joints between blocks that touch.
    pub fn joints(&self) -> usize {
        self.blocks.interfaces.len()
    }

    /// Number of contact points.
    pub fn points(&self) -> usize {
        self.strengths.len()
    }

    /// Whether any statically admissible state exists under the dead loads, for the blocks where they are: contact forces
    /// within their strength, in equilibrium. For a moved wall, hand the moved shapes to [`Analysis::new`].
    ///
    /// Asked as the largest share of the dead loads that can be borne, which always has an answer.
    pub fn stands(&self, loads: &Loads) -> Standing {
        let answer = self.at_rest(&self.applied(loads));
        Standing {
            stands: answer.is_good().then_some(answer.capped),
            share: answer.solved.multiplier.clamp(0.0, 1.0),
            mechanism: if answer.capped { Vec::new() } else { answer.mechanism },
            thrust: answer.thrust,
            accuracy: answer.accuracy,
            iterations: answer.solved.iterations,
            status: format!("{:?}", answer.solved.status),
        }
    }

    /// The largest multiplier of the live loads, from 0 up.
    pub fn multiplier(&self, loads: &Loads) -> Limit {
        let applied = self.applied(loads);
        match self.stands_at_rest(&applied, Level::Multiplier(0.0)) {
            Ok(spent) => self.multiplier_beside(&applied, spent),
            Err(limit) => *limit,
        }
    }

    /// The largest multiplier of the live loads beside dead ones that are borne, as `before` iterations have shown.
    pub(crate) fn multiplier_beside(&self, applied: &Applied, before: u32) -> Limit {
        let flow = self.settings.flow;
        let cap = self.settings.largest_multiplier;
        let answer = self.largest(applied, &self.strengths, cap);
        // It stands at rest: what is below 0 is so by the solver's accuracy.
        let found = answer.solved.multiplier.max(0.0);
        if !answer.is_good() {
            let outcome = answer.not_converged(Level::Multiplier(found));
            return answer.into_limit(outcome, found, flow, before);
        }
        if answer.capped {
            let (outcome, more) = self.beyond(applied);
            return answer.into_limit(outcome, cap, flow, before + more);
        }
        match flow {
            Flow::Associative => {
                let outcome = Outcome::Collapsed { at: Level::Multiplier(found) };
                answer.into_limit(outcome, found, flow, before)
            }
            Flow::NonAssociative => self.without_dilatancy(applied, answer, before, cap, Level::Multiplier),
        }
    }

    /// The loads as forces on the blocks, and the joints' axes that belong to them.
    pub(crate) fn applied(&self, loads: &Loads) -> Applied {
        Applied {
            dead: self.blocks.wrenches(loads, When::Dead),
            live: self.blocks.wrenches(loads, When::Live),
            axes: axes(&self.blocks, [loads.push(), loads.dead]),
        }
    }

    /// The iterations that it took to find that the wall stands under the dead loads; else how it does not.
    pub(crate) fn stands_at_rest(&self, applied: &Applied, at: Level) -> Result<u32, Box<Limit>> {
        let flow = self.settings.flow;
        let rest = self.at_rest(applied);
        let share = rest.solved.multiplier.clamp(0.0, 1.0);
        if !rest.is_good() {
            let outcome = rest.not_converged(at);
            return Err(Box::new(rest.into_limit(outcome, share, flow, 0)));
        }
        if !rest.capped {
            return Err(Box::new(rest.into_limit(Outcome::UnstableAtRest, share, flow, 0)));
        }
        let spent = rest.solved.iterations;
        if flow == Flow::Associative {
            return Ok(spent);
        }
        let (share, more) = self.share_without_dilatancy(applied, &rest);
        if share < 1.0 {
            return Err(Box::new(rest.into_limit(Outcome::UnstableAtRest, share, flow, more)));
        }
        Ok(spent + more)
    }

    /// The largest share of the dead loads, at most 1.
    pub(crate) fn at_rest(&self, applied: &Applied) -> Answer {
        let none = vec![Wrench::default(); applied.dead.len()];
        let program = self.program(&none, &applied.dead, &applied.axes, &self.strengths, 1.0);
        self.answer(&Program { enough: true, ..program })
    }

    /// The largest multiplier up to a cap, for given strengths.
    pub(crate) fn largest(&self, applied: &Applied, strengths: &[Strength], cap: f64) -> Answer {
        self.answer(&self.program(&applied.dead, &applied.live, &applied.axes, strengths, cap))
    }

    /// Whether the live loads can grow without end: they can if they have an equilibrium of their own within the cones that
    /// are left for forces without bound. Also the iterations spent.
    fn beyond(&self, applied: &Applied) -> (Outcome, u32) {
        let none = vec![Wrench::default(); applied.live.len()];
        let cones: Vec<Strength> = self.strengths.iter().map(Strength::recession).collect();
        let program = self.program(&none, &applied.live, &applied.axes, &cones, 1.0);
        let answer = self.answer(&Program { enough: true, ..program });
        let unbounded = answer.solved.multiplier >= ALL && answer.accuracy.accepts_state();
        let outcome = if unbounded { Outcome::Unbounded } else { Outcome::Equilibrium };
        (outcome, answer.solved.iterations)
    }

    pub(crate) fn program<'p>(
        &'p self,
        dead: &'p [Wrench],
        live: &'p [Wrench],
        axes: &'p [[Vec3; 2]],
        strengths: &'p [Strength],
        cap: f64,
    ) -> Program<'p> {
        Program {
            blocks: &self.blocks,
            axes,
            strengths,
            dead,
            live,
            cap,
            cone: self.settings.cone,
            tolerance: self.settings.tolerance,
            enough: false,
            pressure: 0.0,
            near: None,
        }
    }

    /// The program's solution by the method made for it or, where that does not apply or is not exact, by clarabel: the
    /// better of the two.
    pub(crate) fn answer(&self, program: &Program) -> Answer {
        let quick = interior::solve(program).map(|solved| self.audited(program, solved));
        match quick {
            Some(quick) if quick.miss() <= EXACT => quick,
            // The audit knows of the multiplier alone, not of what else is asked for.
            Some(quick) if program.has_preference() && quick.solved.status == SolverStatus::Solved => quick,
            quick => {
                let slow = self.audited(program, program.solve());
                // Clarabel alone can prove that there is no state at all.
                let better = |quick: &Answer| quick.is_good() && quick.miss() < slow.miss();
                quick.filter(better).unwrap_or(slow)
            }
        }
    }

    pub(crate) fn audited(&self, program: &Program, solved: Solved) -> Answer {
        Answer {
            accuracy: audit(program, &solved),
            mechanism: mechanism(program, &solved),
            thrust: thrust(program, &solved),
            excess: crate::solve::limit::audit::excess(&self.strengths, program, &solved),
            capped: solved.multiplier >= program.cap * ALL,
            solved,
        }
    }
}
