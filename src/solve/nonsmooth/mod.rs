//! The non-smooth solver: rigid blocks with unilateral contact and Coulomb friction, stepped in time on velocities (Moreau 1988;
//! Jean 1999; the method of LMGC90).
//!
//! # One step
//!
//! Unknown are the velocities `v` after the step and the impulses `r` at the corners of the joints, normal part `r_N` and
//! tangential part `r_T`. With the relative velocities `u` and the gaps `g` at the start of the step
//!
//! ```text
//! M (v - v_free) = H r        v_free = v_before + h M^-1 loads        q_after = q_before + h v
//! rigid       0 <= max(g, 0) / h + u_N    perp    r_N >= 0
//! compliant   r_N = h A sigma(-(g + h u_N))                  kn -> infinity gives the rigid law
//! friction    |r_T| <= h c A + r_N tan(phi),   r_T against u_T where it slides
//! ```
//!
//! Velocities are those of the middle of a step, as with central differences, and impulses act as loads do where the step begins: `H` is that of its
//! start. Relative velocities are taken half a step ahead, where the velocities before the step lead: `u = H^T v + w`, in which `w` is by how much
//! points turn until then. A step in which something hits is divided there, see `impact`. So a stone that rocks on its edges keeps its
//! energy to second order in `h`, through impacts as well.
//!
//! A step of steady loads gains no energy: velocities gain what loads give them, `u . r <= 0` and `-1/2 |v - v_before|^2`. Of that `-w . r` is left,
//! which is no gain where stones turn about a point that presses on them: `w` then leads from the point into the stone, as `r` does.
//!
//! Friction is Coulomb's, without dilatancy: `u + |u_T| tan(phi) n` lies in the dual of the cone in which `r` lies (De Saxcé and
//! Feng 1998). Without that term sliding dilates, and a block that slides hops; [`Friction::Dilating`] is there to compare.
//!
//! # Solvers of a step
//!
//! | [`StepSolver`] | method |
//! |---|---|
//! | `Newton` | Newton's method on the augmented Lagrangian of Alart and Curnier (1991), one sparse factorisation an iteration |
//! | `ConeProgram` | fixed point on `tan(phi) |u_T|`, a cone program each (Acary, Cadoux, Lemaréchal and Malick 2011) |
//! | `Sweeps` | non-linear Gauss-Seidel, one contact after the other (Jourdan, Alart and Jean 1998) |
//!
//! All stop where the natural map is small, see [`Residual`].

mod cone_program;
mod contacts;
mod global;
mod impact;
mod newton;
mod part;
mod point;
mod problem;
mod project;
mod residual;
mod step;
mod sweeps;

pub use global::{GlobalProblem, Solution, Triplets};
pub use problem::Problem;
pub use residual::Residual;
pub use step::{Simulation, Stepped};

use crate::solve::Demand;

/// How joints bear pressure.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Normal {
    /// Rigid, on velocities: where a joint touches, it opens after the step with at least `restitution` times the velocity with which it
    /// closed.
    Velocity {
        /// In [0, 1]. With many contacts at once a value above 0 may gain energy.
        restitution: f64,
    },
    /// Rigid, on gaps: a joint may close within the step as far as it is open.
    Gap,
    /// The joint's own normal and shear stiffness, at the points at which the other solvers follow shear.
    Compliant,
}

/// How joints slide.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Friction {
    /// Without dilatancy.
    Coulomb,
    /// Opening by tan(phi) as they slide: the convex problem that is sometimes solved instead. Of rigid joints, by cone programs only.
    Dilating,
}

/// How the contact problem of a step is solved.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StepSolver {
    /// Newton's method; cone programs where it does not converge, or sweeps where joints are springs.
    Newton,
    /// A fixed point of cone programs; sweeps where joints are springs.
    ConeProgram,
    /// Non-linear Gauss-Seidel.
    Sweeps,
}

/// Settings of the non-smooth solver.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Settings {
    /// Time step (s); default 2e-3.
    pub time_step: f64,
    /// Normal law of joints; default [`Normal::Gap`].
    pub normal: Normal,
    /// Friction; default [`Friction::Coulomb`].
    pub friction: Friction,
    /// How the problem of a step is solved; default [`StepSolver::Newton`].
    pub solver: StepSolver,
    /// Largest natural map, an impulse over that of all weights in a step; default 1e-8.
    pub tolerance: f64,
    /// Iterations (sweeps) of a step before it counts as not solved; default 100 (a thousand times as many sweeps).
    pub max_iterations: u32,
    /// At rest when no body moves faster than this (m/s, of its centroid or at its radius); default 1e-8.
    pub rest_speed: f64,
    /// Steps per load step before the run is called not converged; default 20 000.
    pub max_steps: u64,
}

impl Settings {
    /// Whether joints have no stiffness.
    pub fn is_rigid(&self) -> bool {
        self.normal != Normal::Compliant
    }

    /// What it does not have, with the reason.
    pub fn refuses(&self, demand: Demand) -> Option<&'static str> {
        let if_rigid = |why| self.is_rigid().then_some(why);
        match demand {
            Demand::Closure | Demand::StressStiffening | Demand::ClosureTable => {
                if_rigid("rigid blocks have joints without closure")
            }
            Demand::ContactArea => if_rigid("rigid joints of contact dynamics touch over their whole area"),
            Demand::Displacements | Demand::Remainders => {
                if_rigid("rigid blocks do not move before they fall")
            }
            Demand::ServiceDisplacement => if_rigid(
                "rigid blocks do not move before they fall (normal = \"compliant\" has joints that give way)",
            ),
            Demand::CompressiveStrength => Some("joints of contact dynamics bear any pressure"),
            Demand::Weakening => Some("friction of contact dynamics does not weaken with slip"),
            Demand::Creep => Some("shear of contact dynamics does not relax"),
            Demand::Turning => {
                Some("a platform that turns steadily is followed by the explicit solver alone")
            }
            Demand::RayleighDamping => Some("impacts and friction take the energy"),
            Demand::Restitution if !self.is_rigid() => Some("joints that give way have no impacts"),
            Demand::Restitution => None,
            Demand::BaseCompliance | Demand::WedgeLoss | Demand::BaseMotion | Demand::Agreement => None,
        }
    }
}

impl Default for Settings {
    fn default() -> Self {
        Settings {
            time_step: 2e-3,
            normal: Normal::Gap,
            friction: Friction::Coulomb,
            solver: StepSolver::Newton,
            tolerance: 1e-8,
            max_iterations: 100,
            rest_speed: 1e-8,
            max_steps: 20_000,
        }
    }
}
