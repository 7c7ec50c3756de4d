//! The linear program: the greatest multiplier whose loads a field of stress bears, in balance against every motion of the mesh and
//! within the facets at every place. Its dual is the mechanism of the least multiplier. Solved by a method of its own, or by clarabel
//! (Goulart and Chen 2024), both on one thread: the same bits on the same machine.

use clarabel::algebra::CscMatrix;
use clarabel::solver::SupportedConeT::{NonnegativeConeT, ZeroConeT};
use clarabel::solver::{DefaultSolver, IPSolver, SolverStatus};

use super::facet::{Facet, Units};
use super::interior;
use super::motion::{Place, Term};
use super::wall::PlateFault;
use crate::solve::conic::{Entries, settings};

/// Relative gap and residuals of a solution: well below what the mesh and the facets leave open.
pub(super) const TOLERANCE: f64 = 1e-7;
/// Those of clarabel, which measures its residuals against larger numbers: of its multipliers at 1e-7 some are wrong by 3e-5.
const ITS_TOLERANCE: f64 = 1e-9;

/// The program of a plate.
pub(super) struct Program<'a> {
    pub places: &'a [Place],
    pub facets: &'a [Facet],
    /// The facets that bound the stress at every place, by their numbers.
    pub own: &'a [Vec<usize>],
    /// Power of the dead and of the live load on every velocity.
    pub dead: &'a [f64],
    pub live: &'a [f64],
    /// The deflection at every rope, from the velocities.
    pub ropes: &'a [Vec<Term<f64>>],
    pub units: Units,
}

/// Its solution.
pub(super) struct Solved {
    /// The multiplier of the mechanism.
    pub multiplier: f64,
    /// By how much that is above the multiplier of the stresses.
    pub gap: f64,
    /// Velocities of the mechanism; the live load has the power 1 on them.
    pub velocities: Vec<f64>,
    /// Stress resultants (N/m and N) at every place.
    pub stresses: Vec<[f64; 6]>,
    /// Force (N) of every rope, along -y.
    pub ropes: Vec<f64>,
    pub iterations: u32,
}

impl Program<'_> {
    /// Solves it by the method of its own, and as a whole where that finds no solution.
    pub fn solve(&self) -> Result<Solved, PlateFault> {
        interior::solve(self).map_or_else(|| self.solve_whole(), Ok)
    }

    /// Solves it by clarabel. The unknowns are the multiplier, six stress resultants for every place, and the ropes' forces.
    pub fn solve_whole(&self) -> Result<Solved, PlateFault> {
        let balance = self.dead.len();
        let first_rope = 1 + 6 * self.places.len();
        let unknowns = first_rope + self.ropes.len();
        let mut matrix = Entries::default();
        let mut right: Vec<f64> = self.dead.iter().map(|d| d / self.units.force).collect();
        self.balance(&mut matrix, first_rope);
        self.strength(&mut matrix, &mut right);
        for rope in 0..self.ropes.len() {
            matrix.add(right.len(), first_rope + rope, -1.0);
            right.push(0.0);
        }
        let rows = right.len();
        let constraints = matrix.matrix(rows, unknowns);
        let mut objective = vec![0.0; unknowns];
        objective[0] = -1.0;
        let cones = [ZeroConeT(balance), NonnegativeConeT(rows - balance)];
        let quadratic = CscMatrix::zeros((unknowns, unknowns));
        let mut solver =
            DefaultSolver::new(&quadratic, &objective, &constraints, &right, &cones, settings(ITS_TOLERANCE))
                .expect("the program's dimensions agree");
        solver.solve();
        self.read(&solver.solution, first_rope)
    }

    /// Stresses and ropes against the loads, for every velocity.
    fn balance(&self, matrix: &mut Entries, first_rope: usize) {
        let scale = self.units.stress().map(|s| s / self.units.force);
        for (velocity, live) in self.live.iter().enumerate() {
            matrix.add(velocity, 0, -live / self.units.force);
        }
        for (k, place) in self.places.iter().enumerate() {
            for (velocity, rate) in &place.rate {
                for c in 0..6 {
                    matrix.add(*velocity, 1 + 6 * k + c, place.size * rate[c] * scale[c]);
                }
            }
        }
        for (k, rope) in self.ropes.iter().enumerate() {
            rope.iter().for_each(|&(velocity, share)| matrix.add(velocity, first_rope + k, share));
        }
    }

    /// The facets of every place.
    fn strength(&self, matrix: &mut Entries, right: &mut Vec<f64>) {
        let planes: Vec<_> = self.facets.iter().map(|f| self.units.plane(f)).collect();
        for (k, own) in self.own.iter().enumerate() {
            for (normal, bound) in own.iter().map(|&facet| &planes[facet]) {
                (0..6).for_each(|c| matrix.add(right.len(), 1 + 6 * k + c, normal[c]));
                right.push(*bound);
            }
        }
    }

    fn read(
        &self,
        solution: &clarabel::solver::DefaultSolution<f64>,
        first_rope: usize,
    ) -> Result<Solved, PlateFault> {
        match solution.status {
            SolverStatus::Solved | SolverStatus::AlmostSolved => {}
            SolverStatus::DualInfeasible | SolverStatus::AlmostDualInfeasible => {
                return Err(PlateFault::Unbounded);
            }
            SolverStatus::PrimalInfeasible | SolverStatus::AlmostPrimalInfeasible => {
                return Err(PlateFault::FallsAtRest);
            }
            other => return Err(PlateFault::NotSolved(format!("{other:?}"))),
        }
        let (x, z) = (&solution.x, &solution.z);
        let unit = self.units.stress();
        Ok(Solved {
            multiplier: -solution.obj_val_dual,
            gap: solution.obj_val - solution.obj_val_dual,
            velocities: z[..self.dead.len()].iter().map(|v| -v / self.units.force).collect(),
            stresses: x[1..first_rope]
                .chunks_exact(6)
                .map(|s| std::array::from_fn(|c| s[c] * unit[c]))
                .collect(),
            ropes: x[first_rope..].iter().map(|pull| pull * self.units.force).collect(),
            iterations: solution.iterations,
        })
    }
}
