//! The load increments between two equilibria.

use crate::contact;
use crate::math::Vec3;
use crate::model::{JointLaws, Wall};
use crate::solve::bodies::Bodies;
use crate::solve::implicit::Settings;
use crate::solve::implicit::loose::land;
use crate::solve::implicit::newton::{Effort, Newton};
use crate::solve::system::System;
use crate::solve::{Ahead, Assembly, Equilibrate, Followed, Settled, Status};

/// Rounds of looking for contacts anew and solving again at the same loads.
const ROUNDS: u32 = 20;

/// An assembly led from equilibrium to equilibrium.
#[derive(Clone)]
pub struct Equilibrium<'a> {
    assembly: Assembly<'a>,
    settings: Settings,
    system: System,
    /// The loads of the last equilibrium; none before the first.
    borne: Option<(Vec3, f64)>,
    effort: Effort,
    loose: Vec<u32>,
}

impl<'a> Equilibrium<'a> {
    /// Blocks in the positions of the wall, under gravity along -z; not yet at rest.
    pub fn new(wall: &Wall, laws: &'a dyn JointLaws, settings: Settings, contact: contact::Settings) -> Self {
        Equilibrium::of(Assembly::new(wall, laws, contact), settings)
    }

    /// Goes on from an assembly as it stands.
    pub fn of(assembly: Assembly<'a>, settings: Settings) -> Self {
        let system = System::new(&assembly.bodies.all, &assembly.joints);
        Equilibrium { assembly, settings, system, borne: None, effort: Effort::default(), loose: Vec::new() }
    }

    /// The same solver on the assembly in another state at rest.
    pub fn again(&self, assembly: Assembly<'a>) -> Self {
        Equilibrium { effort: self.effort, ..Equilibrium::of(assembly, self.settings) }
    }

    /// The assembly as it stands, for another solver to go on from.
    pub fn into_assembly(self) -> Assembly<'a> {
        self.assembly
    }

    /// What has been done so far.
    pub fn effort(&self) -> Effort {
        self.effort
    }

    /// The blocks that some motion is left free for, by the tangent that was assembled last: stones that carry nothing and
    /// wedges that rattle. Only the stabilisation holds them, in the matrix; their balance is exact.
    pub fn loose(&self) -> &[u32] {
        &self.loose
    }

    /// The assembly and what it takes to solve for it.
    pub(super) fn parts(
        &mut self,
    ) -> (&mut Assembly<'a>, &mut System, &Settings, &mut Effort, &mut Vec<u32>) {
        (&mut self.assembly, &mut self.system, &self.settings, &mut self.effort, &mut self.loose)
    }

    /// Equilibrium at the loads as they are: solves, looks for contacts anew, and solves again until none moves on.
    pub(super) fn solve(&mut self) -> (bool, f64) {
        let mut ratio = f64::INFINITY;
        // A wall that has been at rest closes no joint by much any more.
        let closes = self.assembly.joints.are_unloaded() && self.assembly.joints.close_softly();
        for _ in 0..ROUNDS {
            if !land(&mut self.assembly) {
                return (false, ratio);
            }
            if !self.system.fits(&self.assembly.joints) {
                self.system = System::new(&self.assembly.bodies.all, &self.assembly.joints);
            }
            let anchors = self.assembly.joints.anchors(&self.assembly.bodies.all);
            let mut newton = Newton {
                assembly: &mut self.assembly,
                system: &mut self.system,
                anchors: &anchors,
                settings: &self.settings,
                effort: &mut self.effort,
                loose: &mut self.loose,
            };
            let fresh = newton.system.is_factorised();
            let start = closes.then(|| newton.assembly.bodies.all.clone());
            let mut solved;
            (solved, ratio) = newton.solve(fresh);
            if let (false, Some(start)) = (solved, start) {
                (solved, ratio) = newton.solve_stiffening(&start);
            }
            if !solved {
                return (false, ratio);
            }
            if !self.assembly.has_moved() {
                return (true, ratio);
            }
            self.assembly.refresh();
        }
        (false, ratio)
    }
}

impl<'a> Equilibrate<'a> for Equilibrium<'a> {
    fn assembly(&self) -> &Assembly<'a> {
        &self.assembly
    }

    fn assembly_mut(&mut self) -> &mut Assembly<'a> {
        &mut self.assembly
    }

    fn follow(&self, ahead: &Ahead<'_>) -> Option<Followed<Self>> {
        self.followed(ahead)
    }

    fn settle(&mut self, stop: &mut dyn FnMut(&Bodies) -> bool) -> Settled {
        let (gravity, load_factor) = (self.assembly.gravity, self.assembly.load_factor);
        let steps_before = self.effort.steps;
        let ended = |status, unbalanced_ratio, effort: &Effort| Settled {
            status,
            unbalanced_ratio,
            steps: effort.steps - steps_before,
        };
        let (from, from_factor) = self.borne.unwrap_or((gravity, load_factor));
        let (mut done, mut share) = (0.0, 1.0);
        let mut halvings = 0;
        loop {
            let before = self.assembly.clone();
            let to = f64::min(done + share, 1.0);
            self.set_loads(from + (gravity - from) * to, from_factor + (load_factor - from_factor) * to);
            let (solved, ratio) = self.solve();
            if solved {
                done = to;
                self.borne = Some((self.assembly.gravity, self.assembly.load_factor));
                if stop(&self.assembly.bodies) {
                    return ended(Status::Stopped, ratio, &self.effort);
                }
                if done >= 1.0 {
                    return ended(Status::Equilibrium, ratio, &self.effort);
                }
                share *= 2.0;
                halvings = u32::saturating_sub(halvings, 1);
            } else if self.borne.is_none() || halvings == self.settings.max_halvings {
                let status = if ratio.is_nan() { Status::NonFinite } else { Status::NoEquilibrium };
                return ended(status, ratio, &self.effort);
            } else {
                self.assembly = before;
                share *= 0.5;
                halvings += 1;
            }
        }
    }
}
